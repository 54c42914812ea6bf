// Sector of 30 degrees of the ground under a circular footing of R = 0.1 m, between two planes of
// symmetry that are oblique to the axes. Chords of the circle enclose the area of the footing.
// It is read by prm/three/bounds_sector.prm.
first = 10. * Pi / 180.;  // angle of the first plane
step  = 15. * Pi / 180.;  // of a chord
R     = 0.1 * Sqrt(step / Sin(step));
W     = 0.3;
H     = 0.2;
fine  = 0.03;
wide  = 0.15;
Point(1) = {0, 0, 0, 0.06};
Point(2) = {0, -H, 0, wide};
For i In {0:2}
  a = first + i * step;
  Point(10 + i) = {R * Cos(a), 0, R * Sin(a), fine};
  Point(20 + i) = {W * Cos(a), 0, W * Sin(a), wide};
  Point(30 + i) = {W * Cos(a), -H, W * Sin(a), wide};
  Line(10 + i)  = {1, 10 + i};
  Line(20 + i)  = {10 + i, 20 + i};
  Line(30 + i)  = {20 + i, 30 + i};
  Line(40 + i)  = {2, 30 + i};
EndFor
Line(1) = {1, 2};
For i In {0:1}
  Line(50 + i) = {10 + i, 11 + i};
  Line(60 + i) = {20 + i, 21 + i};
  Line(70 + i) = {30 + i, 31 + i};
  Line Loop(60 + i) = {60 + i, 31 + i, -(70 + i), -(30 + i)};
  Plane Surface(60 + i) = {60 + i};
EndFor
Line Loop(1) = {10, 50, 51, -12};
Line Loop(2) = {20, 60, 61, -22, -51, -50};
Line Loop(3) = {40, 70, 71, -42};
Line Loop(4) = {10, 20, 30, -40, -1};
Line Loop(5) = {12, 22, 32, -42, -1};
For i In {1:5}
  Plane Surface(i) = {i};
EndFor
Surface Loop(1) = {1:5, 60, 61};
Volume(1) = {1};
Physical Surface("footing")  = {1};
Physical Surface("top")      = {2};
Physical Surface("far")      = {3, 60, 61};
Physical Surface("symmetry") = {4, 5};
Physical Volume("soil")      = {1};
