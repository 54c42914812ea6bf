// A sector of a layer around a well along y (m), of hexahedra that grow with the distance. It is
// read by prm/three/seepage_well.prm, and by gmsh: gmsh -3 well_sector.geo
inner  = 1;
outer  = 30;
height = 10;
angle  = Pi / 6;
n      = 6;   // cells along the arc
layers = 24;  // from the well to the outer radius
up     = 15;  // cells along y
growth = (outer / inner)^(1 / layers);

// Chords of circles that are a little larger, so that they enclose the same area.
chord  = angle / n;
larger = Sqrt(chord / Sin(chord));
a      = inner * larger;
b      = outer * larger;

Point(1) = {0, 0, 0};
Point(2) = {a, 0, 0};
Point(3) = {b, 0, 0};
Point(4) = {b * Cos(angle), 0, b * Sin(angle)};
Point(5) = {a * Cos(angle), 0, a * Sin(angle)};
Line(1)   = {2, 3};
Circle(2) = {3, 1, 4};
Line(3)   = {5, 4};
Circle(4) = {5, 1, 2};
Curve Loop(1) = {1, 2, -3, 4};
Plane Surface(1) = {1};
Transfinite Curve {1, 3} = layers + 1 Using Progression growth;
Transfinite Curve {2, 4} = n + 1;
Transfinite Surface {1};
Recombine Surface {1};
out[] = Extrude {0, height, 0} { Surface{1}; Layers{up}; Recombine; };
Physical Surface("bottom") = {1};
Physical Surface("top")    = {out[0]};
Physical Surface("cut 0")  = {out[2]};
Physical Surface("far")    = {out[3]};
Physical Surface("cut 1")  = {out[4]};
Physical Surface("well")   = {out[5]};
Physical Volume("sand")    = {out[1]};
