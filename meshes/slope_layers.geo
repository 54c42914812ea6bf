// A slope of three layers in plane strain, to be copied: triangles that are fine at the
// toe and the crest. It is read by prm/safety/slope_layers.prm, and by gmsh:
//   gmsh slope_layers.geo       # a window, to look at it
//   gmsh -2 slope_layers.geo    # writes slope_layers.msh, which geocone reads as data
// Lengths are m, x to the right from below the middle of the embankment, y upwards from
// the toe.
crest  = 10;   // width of the ground behind the crest
front  = 14;   // width of the ground before the toe
height = 8;    // of the slope
run    = 2;    // of the face: length along x per height
middle = 4;    // y of the boundary between silt and fill, in the face
base   = -4;   // y of the rock
If(!Exists(fine))  // a file that includes this one may have its own
  fine   = 0.4;  // size of triangles along the face
  coarse = 1.5;  // far from it
EndIf

toe = crest + run * height;
end = toe + front;
Point(1) = {0, base, 0, coarse};
Point(2) = {end, base, 0, coarse};
Point(3) = {end, 0, 0, coarse};
Point(4) = {toe, 0, 0, fine};
Point(5) = {toe - run * middle, middle, 0, fine};
Point(6) = {crest, height, 0, fine};
Point(7) = {0, height, 0, coarse};
Point(8) = {0, middle, 0, coarse};
Point(9) = {0, 0, 0, coarse};

// Around the whole body, counter-clockwise, and then the boundaries between layers. A
// boundary is one curve of both of its layers, so that their triangles share nodes.
Line(1)  = {1, 2};
Line(2)  = {2, 3};
Line(3)  = {3, 4};
Line(4)  = {4, 5};
Line(5)  = {5, 6};
Line(6)  = {6, 7};
Line(7)  = {7, 8};
Line(8)  = {8, 9};
Line(9)  = {9, 1};
Line(10) = {9, 4};
Line(11) = {8, 5};
Curve Loop(1) = {1, 2, 3, -10, 9};
Curve Loop(2) = {10, 4, -11, 8};
Curve Loop(3) = {11, 5, 6, 7};
For i In {1 : 3}
  Plane Surface(i) = {i};
EndFor

// Layers: 'Region number' of a material takes the number or the name. With any physical
// surface gmsh leaves out those that have none, so each layer needs one.
Physical Surface("clay", 1) = {1};
Physical Surface("silt", 2) = {2};
Physical Surface("fill", 3) = {3};

// Sides: boundary conditions, tractions and the like take these names.
Physical Curve("rock", 11)   = {1};
Physical Curve("right", 12)  = {2};
Physical Curve("ground", 13) = {3};
Physical Curve("face", 14)   = {4, 5};
Physical Curve("crest", 15)  = {6};
Physical Curve("left", 16)   = {7, 8, 9};
