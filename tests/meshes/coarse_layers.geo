// The slope of meshes/slope_layers.geo, with larger triangles.
fine   = 1;  // size of triangles along the face
coarse = 2;  // far from it
Include "../../meshes/slope_layers.geo";
