// The slope of slope.geo, of tetrahedra that bounds bisect. It is read by
// prm/three/bounds_slope.prm.
tetrahedra = 1;
across = 5;    // cells from the back to the face
up     = 5;    // cells from the base to the top
along  = 3;    // from the middle to the end
ratio  = 1;    // of a cell along z to the one nearer to the end
front  = 1;    // of a cell to the one nearer to the face
low    = 1;    // of a cell to the one below it
Include "slope.geo";
