// Half of a slope of finite length on a rigid base: H = 1 m high, 60 degrees, from the
// middle (z = 0) to its end (m), hexahedra. It is read by prm/three/slope.prm, and by
// gmsh: gmsh -3 slope.geo
half   = 1;     // of the length
angle  = 60;    // of the face, degrees
crest  = 1.5;   // width of the ground behind the crest
If(!Exists(tetrahedra))  // a file that includes this one may have its own
  tetrahedra = 0;  // instead of hexahedra
EndIf
If(!Exists(across))
  across = 14;    // cells from the back to the face
  up     = 10;    // cells from the base to the top
  along  = 6;     // from the middle to the end
  ratio  = 1.3;   // of a cell along z to the one nearer to the end
  front  = 1.05;  // of a cell to the one nearer to the face
  low    = 1.2;   // of a cell to the one below it
EndIf

toe = crest + 1 / Tan(angle * Pi / 180);
Point(1) = {0, 0, 0};
Point(2) = {toe, 0, 0};
Point(3) = {crest, 1, 0};
Point(4) = {0, 1, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve {1, -3} = across + 1 Using Progression 1 / front;
Transfinite Curve {2, -4} = up + 1 Using Progression low;
Transfinite Surface {1};
If(!tetrahedra)
  Recombine Surface {1};
EndIf

// Layers of one cell each, at these parts of the half.
sum = 0;
all = 0;
For i In {0 : along - 1}
  all = all + ratio ^ (along - 1 - i);
EndFor
For i In {0 : along - 1}
  sum    = sum + ratio ^ (along - 1 - i) / all;
  one[i] = 1;
  at[i]  = sum;
EndFor
at[along - 1] = 1;
If(tetrahedra)
  out[] = Extrude {0, 0, half} { Surface{1}; Layers{ one[], at[] }; };
Else
  out[] = Extrude {0, 0, half} { Surface{1}; Layers{ one[], at[] }; Recombine; };
EndIf
Physical Surface("middle") = {1};
Physical Surface("end")    = {out[0]};
Physical Surface("base")   = {out[2]};
Physical Surface("face")   = {out[3]};
Physical Surface("top")    = {out[4]};
Physical Surface("back")   = {out[5]};
Physical Volume("clay")    = {out[1]};
