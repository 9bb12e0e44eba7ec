// Stiffener B: an upright bracket that ends exactly on the wall y = width and crosses stiffener A outside
// the box. Lengths in mm.
SetFactory("OpenCASCADE");

wall = 1100; b_x = 955; low = 110; high = 530; depth = 140; b_chamfer = 60;
DefineConstant[ size = 52, algorithm = 6 ];

p = newp; l = newl; stiffener_b = news;
Point(p) = {b_x, wall, low};
Point(p + 1) = {b_x, wall + depth, low + b_chamfer};
Point(p + 2) = {b_x, wall + depth, high - b_chamfer};
Point(p + 3) = {b_x, wall, high};
For k In {0:3}
  Line(l + k) = {p + k, p + (k + 1) % 4};
EndFor
Curve Loop(stiffener_b) = {l : l + 3};
Plane Surface(stiffener_b) = {stiffener_b};

If (!Exists(assembled))
  Physical Surface("STIFFENER_B") = {stiffener_b};
  Physical Surface("STIFFENERS") = {stiffener_b};
  Physical Curve("B_TIP") = {l + 1};

  Mesh.CharacteristicLengthMin = size;
  Mesh.CharacteristicLengthMax = size;
  Mesh.Algorithm = algorithm;
  Mesh.SaveGroupsOfNodes = 1;
EndIf
