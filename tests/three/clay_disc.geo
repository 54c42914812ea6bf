// The ground of meshes/quarter_disc.geo, with larger cells.
n      = 2;    // cells along the half of the arc
inner  = 2;    // rings in the footing
outer  = 4;    // rings beyond
layers = 4;
ratio  = 2.2;  // of a cell to its neighbour that is nearer to the edge
Include "../../meshes/quarter_disc.geo";
