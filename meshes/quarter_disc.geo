// A quarter of the ground under a round footing: x, z >= 0, y <= 0 (m), hexahedra in
// rings that are fine at the footing's edge and layers that are fine at the ground.
// It is read by prm/three/circular_footing.prm, and by gmsh: gmsh -3 quarter_disc.geo
radius = 0.1;  // of the footing
If(!Exists(width))  // a file that includes this one may have its own
  width = 0.6;  // of the ground
  depth = 0.4;
EndIf
If(!Exists(tetrahedra))
  tetrahedra = 0;  // instead of hexahedra
EndIf
If(!Exists(n))
  n      = 2;    // cells along the half of the arc
  inner  = 4;    // rings in the footing
  outer  = 7;    // rings beyond
  layers = 6;
  ratio  = 2;    // of a cell to its neighbour that is nearer to the edge
EndIf

// Chords of a circle that is a little larger, so that they enclose the footing's area.
chord  = Pi / 4 / n;
radius = radius * Sqrt(chord / Sin(chord));

a = 0.45 * radius;
b = 0.40 * radius;
c = radius / Sqrt(2);
Point(1)  = {0, 0, 0};
Point(2)  = {a, 0, 0};
Point(3)  = {b, 0, b};
Point(4)  = {0, 0, a};
Point(5)  = {radius, 0, 0};
Point(6)  = {c, 0, c};
Point(7)  = {0, 0, radius};
Point(8)  = {width, 0, 0};
Point(9)  = {width, 0, width};
Point(10) = {0, 0, width};
Line(1)   = {1, 2};
Line(2)   = {2, 3};
Line(3)   = {3, 4};
Line(4)   = {4, 1};
Line(5)   = {2, 5};
Line(6)   = {3, 6};
Line(7)   = {4, 7};
Circle(8) = {5, 1, 6};
Circle(9) = {6, 1, 7};
Line(10)  = {5, 8};
Line(11)  = {6, 9};
Line(12)  = {7, 10};
Line(13)  = {8, 9};
Line(14)  = {9, 10};
Curve Loop(1) = {1, 2, 3, 4};
Curve Loop(2) = {5, 8, -6, -2};
Curve Loop(3) = {6, 9, -7, -3};
Curve Loop(4) = {10, 13, -11, -8};
Curve Loop(5) = {11, 14, -12, -9};
For i In {1 : 5}
  Plane Surface(i) = {i};
EndFor
Transfinite Curve {1, 2, 3, 4, 8, 9, 13, 14} = n + 1;
Transfinite Curve {5, 6, 7} = inner + 1 Using Progression 1 / ratio;
Transfinite Curve {10, 11, 12} = outer + 1 Using Progression ratio;
Transfinite Surface {1 : 5};
If(!tetrahedra)
  Recombine Surface {1 : 5};
EndIf

// Layers of one cell each, at these parts of the depth.
part = (ratio - 1) / (ratio ^ layers - 1);
sum  = 0;
For i In {0 : layers - 1}
  sum   = sum + part * ratio ^ i;
  one[i] = 1;
  at[i]  = sum;
EndFor
at[layers - 1] = 1;
For i In {1 : 5}
  If(tetrahedra)
    out~{i}[] = Extrude {0, -depth, 0} {
      Surface{i}; Layers{ one[], at[] };
    };
  Else
    out~{i}[] = Extrude {0, -depth, 0} {
      Surface{i}; Layers{ one[], at[] }; Recombine;
    };
  EndIf
EndFor
// Of each block: the bottom, the volume, the sides in the order of its curves.
Physical Surface("footing") = {1, 2, 3};
Physical Surface("ground")  = {4, 5};
Physical Surface("bottom")  = {out_1[0], out_2[0], out_3[0], out_4[0], out_5[0]};
Physical Surface("symmetry z") = {out_1[2], out_2[2], out_4[2]};
Physical Surface("symmetry x") = {out_1[5], out_3[4], out_5[4]};
Physical Surface("far")     = {out_4[3], out_5[3]};
Physical Volume("soil")     = {out_1[1], out_2[1], out_3[1], out_4[1], out_5[1]};
