// The ground of meshes/quarter_disc.geo, with larger cells.
n      = 2;  // cells along the half of the arc
inner  = 2;  // rings in the footing
outer  = 3;  // rings beyond
layers = 3;
ratio  = 3;  // of a cell to its neighbour that is nearer to the edge
Include "../../meshes/quarter_disc.geo";
