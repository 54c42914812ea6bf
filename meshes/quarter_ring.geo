// A quarter of a thick cylinder around y, x, z >= 0 (m), of hexahedra: one layer of cells
// along y. It is read by prm/three/thick_cylinder.prm, and by gmsh:
// gmsh -3 quarter_ring.geo
inner  = 1;
outer  = 2;
height = 0.25;
If(!Exists(n))  // a file that includes this one may have its own
  n      = 12;  // cells along the arc of 90 degrees
  layers = 10;  // from the inner to the outer radius
EndIf

// Chords of circles that are a little larger, so that they enclose the same area.
chord  = Pi / 2 / n;
larger = Sqrt(chord / Sin(chord));

Point(1) = {0, 0, 0};
Point(2) = {inner * larger, 0, 0};
Point(3) = {outer * larger, 0, 0};
Point(4) = {0, 0, outer * larger};
Point(5) = {0, 0, inner * larger};
Line(1)   = {2, 3};
Circle(2) = {3, 1, 4};
Line(3)   = {4, 5};
Circle(4) = {5, 1, 2};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve {1, 3} = layers + 1;
Transfinite Curve {2, 4} = n + 1;
Transfinite Surface {1};
Recombine Surface {1};
out[] = Extrude {0, -height, 0} { Surface{1}; Layers{1}; Recombine; };
Physical Surface("top")     = {1};
Physical Surface("bottom")  = {out[0]};
Physical Surface("z = 0")   = {out[2]};
Physical Surface("outside") = {out[3]};
Physical Surface("x = 0")   = {out[4]};
Physical Surface("inside")  = {out[5]};
Physical Volume("metal")    = {out[1]};
