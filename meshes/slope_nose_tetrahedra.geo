// Half of a public slope of four soils around a nose (Beremi/slope_stability_petsc4py,
// 3d_hetero_slope): 30 m high, on 30 m of ground, 205 m long and 86.603 m wide. z = middle
// is its plane of symmetry. It is read by prm/three/bounds_slope_nose.prm.
middle = 43.30127018922193;
fine   = 7;   // size of cells at the face
coarse = 40;  // far from it
// Corners in the planes z = 0 and z = middle: numbers 1 to 11 and 101 to 111.
For k In {0 : 1}
  n = 100 * k;
  z = k * middle;
  p = -25 * k;  // the nose
  Point(n + 1)  = {-175, 0, z, coarse};
  Point(n + 2)  = {30, 0, z, coarse};
  Point(n + 3)  = {30, 20, z, coarse};
  Point(n + 4)  = {-175, 20, z, coarse};
  Point(n + 5)  = {30, 30, z, coarse};
  Point(n + 6)  = {-175, 30, z, coarse};
  Point(n + 7)  = {-120 + p, 30, z, fine};
  Point(n + 8)  = {-115 + p, 30, z, fine};
  Point(n + 9)  = {-60 + p, 60, z, fine};
  Point(n + 10) = {-55 + p, 60, z, fine};
  Point(n + 11) = {30, 60, z, coarse};
EndFor
// Edges of both planes, and the edges between them.
from[] = {1, 2, 3, 4, 3, 4, 6, 7, 8, 7, 9, 8, 10, 11};
to[]   = {2, 3, 4, 1, 5, 6, 7, 8, 5, 9, 10, 10, 11, 5};
For i In {1 : 11}
  Line(200 + i) = {i, 100 + i};
EndFor
For i In {1 : 14}
  Line(i)       = {from[i - 1], to[i - 1]};
  Line(100 + i) = {100 + from[i - 1], 100 + to[i - 1]};
  Curve Loop(200 + i) = {i, 200 + to[i - 1], -(100 + i), -(200 + from[i - 1])};
  Plane Surface(200 + i) = {200 + i};
EndFor
For k In {0 : 1}
  n = 100 * k;
  Curve Loop(n + 1) = {n + 1, n + 2, n + 3, n + 4};
  Curve Loop(n + 2) = {-(n + 3), n + 5, -(n + 9), -(n + 8), -(n + 7), -(n + 6)};
  Curve Loop(n + 3) = {n + 8, n + 12, -(n + 11), -(n + 10)};
  Curve Loop(n + 4) = {n + 9, -(n + 14), -(n + 13), -(n + 12)};
  For i In {1 : 4}
    Plane Surface(n + i) = {n + i};
  EndFor
EndFor
Surface Loop(1) = {1, 101, 201, 202, 203, 204};
Surface Loop(2) = {2, 102, 203, 205, 209, 208, 207, 206};
Surface Loop(3) = {3, 103, 208, 212, 211, 210};
Surface Loop(4) = {4, 104, 209, 214, 213, 212};
For i In {1 : 4}
  Volume(i) = {i};
EndFor
Physical Volume("general", 1) = {1};
Physical Volume("weak", 2)    = {2};
Physical Volume("cover", 3)   = {3};
Physical Volume("mass", 4)    = {4};
Physical Surface("base", 11)   = {201};
Physical Surface("ends", 12)   = {202, 204, 205, 206, 214};
Physical Surface("planes", 13) = {1 : 4, 101 : 104};
Physical Surface("ground", 14) = {207, 210, 211, 213};
