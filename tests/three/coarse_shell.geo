// The thick sphere of meshes/eighth_shell.geo, with larger cells.
n      = 3;  // cells along the half of an arc of 90 degrees
layers = 4;
Include "../../meshes/eighth_shell.geo";
