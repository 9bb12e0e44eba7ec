// Stiffener A: a shelf that passes through the wall y = width, over the bulkhead's edge on that wall and
// over the border of its thicker plate. It leans by 8 degrees. Lengths in mm.
SetFactory("OpenCASCADE");

wall = 1100; a_height = 290; lean = 8*Pi/180;
inside = 95; outside = 165; from = 375; to = 1305; a_chamfer = 70;
DefineConstant[ size = 58, algorithm = 6 ];

p = newp; l = newl; stiffener_a = news;
Point(p) = {from, wall - inside, a_height};
Point(p + 1) = {to, wall - inside, a_height};
Point(p + 2) = {to, wall + outside - a_chamfer, a_height};
Point(p + 3) = {to - a_chamfer, wall + outside, a_height};
Point(p + 4) = {from + a_chamfer, wall + outside, a_height};
Point(p + 5) = {from, wall + outside - a_chamfer, a_height};
For k In {0:5}
  Line(l + k) = {p + k, p + (k + 1) % 6};
EndFor
Curve Loop(stiffener_a) = {l : l + 5};
Plane Surface(stiffener_a) = {stiffener_a};
Rotate { {1, 0, 0}, {0, wall, a_height}, lean } { Surface{stiffener_a}; }

If (!Exists(assembled))
  Physical Surface("STIFFENER_A") = {stiffener_a};
  Physical Surface("STIFFENERS") = {stiffener_a};
  Physical Curve("A_FREE_EDGE") = {l + 2, l + 3, l + 4};

  Mesh.CharacteristicLengthMin = size;
  Mesh.CharacteristicLengthMax = size;
  Mesh.Algorithm = algorithm;
  Mesh.SaveGroupsOfNodes = 1;
EndIf
