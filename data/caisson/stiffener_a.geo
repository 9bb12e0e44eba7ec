// Stiffener A: a shelf that passes through the wall y = width, over the bulkhead's edge on that wall and
// over the border of its thicker plate. It leans by 8 degrees. Lengths in mm.
SetFactory("OpenCASCADE");

wall = 1100; height = 290; lean = 8*Pi/180;
inside = 95; outside = 165; from = 375; to = 1305; chamfer = 70;
size = 58;

Point(1) = {from, wall - inside, height};
Point(2) = {to, wall - inside, height};
Point(3) = {to, wall + outside - chamfer, height};
Point(4) = {to - chamfer, wall + outside, height};
Point(5) = {from + chamfer, wall + outside, height};
Point(6) = {from, wall + outside - chamfer, height};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4};
Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 1};
Curve Loop(1) = {1:6};
Plane Surface(1) = {1};
Rotate { {1, 0, 0}, {0, wall, height}, lean } { Surface{1}; }

Physical Surface("STIFFENER_A") = {1};
Physical Surface("STIFFENERS") = {1};
Physical Curve("A_FREE_EDGE") = {3, 4, 5};

Mesh.CharacteristicLengthMin = size;
Mesh.CharacteristicLengthMax = size;
Mesh.Algorithm = 6;
Mesh.SaveGroupsOfNodes = 1;
