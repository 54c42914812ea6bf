// The thick sphere of eighth_shell.geo, of tetrahedra. It is read by
// prm/three/bounds_sphere.prm.
tetrahedra = 1;
n      = 3;  // cells along the half of an arc of 90 degrees
layers = 3;
Include "eighth_shell.geo";
