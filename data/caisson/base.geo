// The caisson: a closed welded box with a manhole in its deck, an inner bulkhead with an opening
// and two ribs on its floor. Lengths in mm. Made for Gmsh 4.8 with OpenCASCADE.
SetFactory("OpenCASCADE");

length = 1500; width = 1100; height = 700;      // outer size along x, y, z
bulkhead = 640;                                 // its x
opening = 170;                                  // radius of the hole in the bulkhead
manhole = 210; manhole_x = 1080; manhole_y = 540;
rib_y[] = {330, 760}; rib_height = 130;
DefineConstant[ size = 65 ];                     // edge length
DefineConstant[ algorithm = 6 ];                 // Mesh.Algorithm
DefineConstant[ assembled = 0 ];                 // 1: one conforming mesh with the stiffeners, as from CAD

Box(1) = {0, 0, 0, length, width, height};
walls[] = Boundary{ Volume{1}; };
Delete { Volume{1}; }

Disk(101) = {manhole_x, manhole_y, height, manhole};
Rectangle(102) = {0, 0, 0, height, width};      // bulkhead, turned upright below
Rotate { {0, 1, 0}, {0, 0, 0}, -Pi/2 } { Surface{102}; }
Translate { bulkhead, 0, 0 } { Surface{102}; }
Disk(103) = {0, 0, 0, opening};
Rotate { {0, 1, 0}, {0, 0, 0}, -Pi/2 } { Surface{103}; }
Translate { bulkhead, 0.52*width, 0.55*height } { Surface{103}; }
Rectangle(104) = {0, 0, 0, length, rib_height};
Rotate { {1, 0, 0}, {0, 0, 0}, Pi/2 } { Surface{104}; }
Translate { 0, rib_y[0], 0 } { Surface{104}; }
Rectangle(105) = {0, 0, 0, length, rib_height};
Rotate { {1, 0, 0}, {0, 0, 0}, Pi/2 } { Surface{105}; }
Translate { 0, rib_y[1], 0 } { Surface{105}; }
Rectangle(106) = {450, 180, 0, 620, 300};       // thicker plate inside the wall y = width
Rotate { {1, 0, 0}, {0, 0, 0}, Pi/2 } { Surface{106}; }
Translate { 0, width, 0 } { Surface{106}; }

inner_parts[] = {101:106};
If (assembled)
  Include "stiffener_a.geo";
  Include "stiffener_b.geo";
  inner_parts[] += {stiffener_a, stiffener_b};
EndIf
BooleanFragments{ Surface{walls[]}; Delete; }{ Surface{inner_parts[]}; Delete; }
e = 1;
hole[] = Surface In BoundingBox {manhole_x-manhole-e, manhole_y-manhole-e, height-e, manhole_x+manhole+e, manhole_y+manhole+e, height+e};
hole[] += Surface In BoundingBox {bulkhead-e, 0.52*width-opening-e, 0.55*height-opening-e, bulkhead+e, 0.52*width+opening+e, 0.55*height+opening+e};
Delete { Surface{hole[]}; }

xmin[] = Surface In BoundingBox {-e, -e, -e, e, width+e, height+e};
xmax[] = Surface In BoundingBox {length-e, -e, -e, length+e, width+e, height+e};
ymin[] = Surface In BoundingBox {-e, -e, -e, length+e, e, height+e};
ymax[] = Surface In BoundingBox {-e, width-e, -e, length+e, width+e, height+e};
floor[] = Surface In BoundingBox {-e, -e, -e, length+e, width+e, e};
deck[] = Surface In BoundingBox {-e, -e, height-e, length+e, width+e, height+e};
inner[] = Surface In BoundingBox {bulkhead-e, -e, -e, bulkhead+e, width+e, height+e};
rib_1[] = Surface In BoundingBox {-e, rib_y[0]-e, -e, length+e, rib_y[0]+e, rib_height+e};
rib_2[] = Surface In BoundingBox {-e, rib_y[1]-e, -e, length+e, rib_y[1]+e, rib_height+e};
thick[] = Surface In BoundingBox {450-e, width-e, 180-e, 1070+e, width+e, 480+e};
rim[] = Curve In BoundingBox {manhole_x-manhole-e, manhole_y-manhole-e, height-e, manhole_x+manhole+e, manhole_y+manhole+e, height+e};
clamp[] = Curve In BoundingBox {-e, -e, -e, e, width+e, e};
clamp[] += Curve In BoundingBox {length-e, -e, -e, length+e, width+e, e};
clamp[] += Curve In BoundingBox {-e, -e, -e, length+e, e, e};
clamp[] += Curve In BoundingBox {-e, width-e, -e, length+e, width+e, e};
gauges[] = Point In BoundingBox {-e, -e, height-e, e, e, height+e};
gauges[] += Point In BoundingBox {length-e, -e, height-e, length+e, e, height+e};
gauges[] += Point In BoundingBox {length-e, width-e, height-e, length+e, width+e, height+e};
gauges[] += Point In BoundingBox {-e, width-e, height-e, e, width+e, height+e};

Physical Surface("SHELL_XMIN") = xmin[];
Physical Surface("SHELL_XMAX") = xmax[];
Physical Surface("SHELL_YMIN") = ymin[];
Physical Surface("SHELL_YMAX") = ymax[];
Physical Surface("FLOOR") = floor[];
Physical Surface("DECK") = deck[];
Physical Surface("YMAX_THICK") = thick[];
Physical Surface("BULKHEAD") = inner[];
Physical Surface("RIB_1") = rib_1[];
Physical Surface("RIB_2") = rib_2[];
Physical Surface("PRESSURE") = {xmin[], xmax[], ymin[], ymax[], floor[], deck[]};
Physical Surface("CAISSON") = {xmin[], xmax[], ymin[], ymax[], floor[], deck[], inner[], rib_1[], rib_2[]};
Physical Curve("MANHOLE_RIM") = rim[];
Physical Curve("CLAMP") = clamp[];
Physical Point("N_GAUGES") = gauges[];
If (assembled)
  in_a[] = Surface In BoundingBox {from-e, wall-inside-e, a_height-outside*Sin(lean)-e, to+e, wall+outside+e, a_height+outside*Sin(lean)+e};
  in_b[] = Surface In BoundingBox {b_x-e, wall-e, low-e, b_x+e, wall+depth+e, high+e};
  Physical Surface("STIFFENER_A") = in_a[];
  Physical Surface("STIFFENER_B") = in_b[];
  Physical Surface("STIFFENERS") = {in_a[], in_b[]};
EndIf

Mesh.CharacteristicLengthMin = size;
Mesh.CharacteristicLengthMax = size;
Mesh.Algorithm = algorithm;
Mesh.SaveGroupsOfNodes = 1;
