// The slope of meshes/slope.geo, with larger cells.
across = 8;     // cells from the back to the face
up     = 6;     // cells from the base to the top
along  = 4;     // from the middle to the end
ratio  = 1.5;   // of a cell along z to the one nearer to the end
front  = 1.05;  // of a cell to the one nearer to the face
low    = 1.3;   // of a cell to the one below it
Include "../../meshes/slope.geo";
