// A public homogeneous slope (Beremi/slope_stability_petsc4py, 3d_homo_slope): 10 m high,
// 45 degrees, on 10 m of the same soil, 40 m long. There it is 5 m wide between smooth
// planes, here 1 m: fields of 1 m, mirrored at its planes, are fields of 5 m. It is read by
// prm/three/bounds_slope_45.prm.
width  = 1;
layers = 1;    // of cells along z
fine   = 1.5;  // size of cells at the face
coarse = 6;    // far from it
Point(1) = {-30, 0, 0, coarse};
Point(2) = {10, 0, 0, coarse};
Point(3) = {10, 20, 0, coarse};
Point(4) = {-5, 20, 0, fine};
Point(5) = {-15, 10, 0, fine};
Point(6) = {-30, 10, 0, coarse};
For i In {1 : 6}
  Line(i) = {i, i % 6 + 1};
EndFor
Curve Loop(1) = {1 : 6};
Plane Surface(1) = {1};
out[] = Extrude {0, 0, width} { Surface{1}; Layers{layers}; };
Physical Surface("planes") = {1, out[0]};
Physical Surface("base")   = {out[2]};
Physical Surface("ends")   = {out[3], out[7]};
Physical Surface("ground") = {out[4], out[5], out[6]};
Physical Volume("soil")    = {out[1]};
