// An eighth of a thick sphere, x, y, z >= 0 (m), of hexahedra: three blocks around
// (1, 1, 1), in layers from the inner to the outer radius. It is read by
// prm/three/sphere.prm, and by gmsh: gmsh -3 eighth_shell.geo
inner  = 1;
outer  = 2;
If(!Exists(tetrahedra))  // a file that includes this one may have its own
  tetrahedra = 0;  // instead of hexahedra
EndIf
If(!Exists(n))
  n      = 8;  // cells along the half of an arc of 90 degrees
  layers = 20;
EndIf

// The faces are flat; those of a little larger spheres enclose the same volume.
larger = 1 + 0.0898 / n ^ 2;

s = 1 / Sqrt(2);
t = 1 / Sqrt(3);
Point(100) = {0, 0, 0};
For k In {0 : 1}
  r = larger * ((k == 0) ? inner : outer);
  p = 10 * k;
  Point(p + 1) = {r, 0, 0};
  Point(p + 2) = {0, r, 0};
  Point(p + 3) = {0, 0, r};
  Point(p + 4) = {r * s, r * s, 0};
  Point(p + 5) = {0, r * s, r * s};
  Point(p + 6) = {r * s, 0, r * s};
  Point(p + 7) = {r * t, r * t, r * t};
  Circle(p + 1) = {p + 1, 100, p + 4};
  Circle(p + 2) = {p + 4, 100, p + 2};
  Circle(p + 3) = {p + 2, 100, p + 5};
  Circle(p + 4) = {p + 5, 100, p + 3};
  Circle(p + 5) = {p + 3, 100, p + 6};
  Circle(p + 6) = {p + 6, 100, p + 1};
  Circle(p + 7) = {p + 4, 100, p + 7};
  Circle(p + 8) = {p + 5, 100, p + 7};
  Circle(p + 9) = {p + 6, 100, p + 7};
  Curve Loop(p + 1) = {p + 1, p + 7, -(p + 9), p + 6};
  Curve Loop(p + 2) = {p + 2, p + 3, p + 8, -(p + 7)};
  Curve Loop(p + 3) = {p + 4, p + 5, p + 9, -(p + 8)};
  For i In {1 : 3}
    Surface(p + i) = {p + i} In Sphere {100};
  EndFor
EndFor
For i In {1 : 7}
  Line(20 + i) = {i, 10 + i};
EndFor
// Sides over the arcs of the inner sphere, 1 to 9.
ends[] = {1, 4, 4, 2, 2, 5, 5, 3, 3, 6, 6, 1, 4, 7, 5, 7, 6, 7};
For i In {1 : 9}
  Curve Loop(30 + i)    = {i, 20 + ends[2 * i - 1], -(10 + i), -(20 + ends[2 * i - 2])};
  Surface(30 + i)       = {30 + i};
EndFor
Surface Loop(1) = {1, 11, 31, 37, 39, 36};
Surface Loop(2) = {2, 12, 32, 33, 38, 37};
Surface Loop(3) = {3, 13, 34, 35, 39, 38};
For i In {1 : 3}
  Volume(i) = {i};
EndFor
For k In {0 : 1}
  Transfinite Curve {10 * k + 1 : 10 * k + 9} = n + 1;
EndFor
Transfinite Curve {21 : 27} = layers + 1;
Transfinite Surface "*";
If(!tetrahedra)  // transfinite tetrahedra of two blocks would not fit
  Recombine Surface "*";
  Transfinite Volume "*";
EndIf
Physical Surface("inside")  = {1, 2, 3};
Physical Surface("outside") = {11, 12, 13};
Physical Surface("z = 0")   = {31, 32};
Physical Surface("x = 0")   = {33, 34};
Physical Surface("y = 0")   = {35, 36};
Physical Volume("metal")    = {1, 2, 3};
