// The ground of quarter_disc.geo in a smaller box, of tetrahedra that bounds bisect.
// It is read by prm/three/bounds_circular_footing.prm.
tetrahedra = 1;
width  = 0.3;  // of the ground
depth  = 0.2;
n      = 2;    // cells along the half of the arc
inner  = 2;    // rings in the footing
outer  = 2;    // rings beyond
layers = 3;
ratio  = 2;    // of a cell to its neighbour that is nearer to the edge
Include "quarter_disc.geo";
