// Stiffener B: an upright bracket that ends exactly on the wall y = width and crosses stiffener A outside
// the box. Lengths in mm.
SetFactory("OpenCASCADE");

wall = 1100; x = 955; low = 110; high = 530; depth = 140; chamfer = 60;
size = 52;

Point(1) = {x, wall, low};
Point(2) = {x, wall + depth, low + chamfer};
Point(3) = {x, wall + depth, high - chamfer};
Point(4) = {x, wall, high};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};

Physical Surface("STIFFENER_B") = {1};
Physical Surface("STIFFENERS") = {1};
Physical Curve("B_TIP") = {2};

Mesh.CharacteristicLengthMin = size;
Mesh.CharacteristicLengthMax = size;
Mesh.Algorithm = 6;
Mesh.SaveGroupsOfNodes = 1;
