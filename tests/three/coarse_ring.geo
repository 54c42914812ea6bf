// The thick cylinder of meshes/quarter_ring.geo, with larger cells.
n      = 6;
layers = 4;
Include "../../meshes/quarter_ring.geo";
