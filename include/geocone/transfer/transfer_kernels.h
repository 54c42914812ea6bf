// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_transfer_transfer_kernels_h
#define geocone_transfer_transfer_kernels_h

#include <geocone/kernels/point_block.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * One direction of a uniform grid with B-splines (or hat functions) of degree
   * p, in the memory layout of the transfer kernels. On the interval i, with xi
   * in [0, 1],
   *   N_f = sum_k coefficients[type[i]][k][f] xi^k,   k = 0 ... p,
   *   dN_f/dx = sum_k coefficients[type[i]][p + 1 + k][f] xi^k,  k = 0 ... p - 1,
   * f = 0 ... p (padded by zeros to 4) for the basis functions i, ..., i + p.
   */
  struct GridAxis
  {
    double               origin       = 0.; ///< first coordinate (m)
    double               inverse_size = 1.; ///< 1/h (1/m)
    int                  n_intervals  = 0;
    int                  first        = 0; ///< first stored basis function
    const unsigned char *type         = nullptr;
    const double        *coefficients = nullptr;
    const double        *greville = nullptr; ///< Greville abscissae (m), APIC
  };

  /**
   * Number of doubles stored per node: a multiple of the vector length four. In
   * two dimensions: (v_x, v_y, dv_x, dv_y) to read, (m v, force) to write; in
   * three: (v, 0, dv, 0) and (m v, 0, force, 0). The second quantity begins at
   * change_of_node.
   */
  constexpr unsigned int node_size      = 4 * (dim - 1);
  constexpr unsigned int change_of_node = node_size / 2;

  /**
   * Part of a grid that is stored on this rank. The stored nodes begin at
   * axes[d].first in each direction d and are contiguous in memory in the last
   * direction. A node has node_size doubles and a mass.
   */
  struct GridView
  {
    GridAxis              axes[dim];
    std::array<long, dim> stride = {}; ///< memory stride per direction
    const double         *read   = nullptr;
    double               *write  = nullptr;
    double               *mass   = nullptr;
  };

  /** Temporary data of a block of points during a loop over the points. The
   *  data fit into the cache. */
  struct BlockScratch
  {
    static constexpr unsigned int size = PointBlock::capacity;

    /** Values interpolated from the nodes to each point. First the node_size
     *  interpolated nodal values are stored, then for each direction the
     *  derivatives of the first four nodal values (the first dim are the
     *  derivatives of v). */
    static constexpr unsigned int n_gathered = node_size + 4 * dim;
    alignas(32) double gathered[n_gathered * size];

    /** Values that each point scatters to the nodes. The first four, (m v, 0,
     *  ...), are multiplied by N. For each direction d four values follow,
     *  multiplied by dN/dx_d, with -V s_d at the position of the force. */
    static constexpr unsigned int n_scattered = 4 + 4 * dim;
    alignas(32) double scattered[n_scattered * size];

    alignas(32) double l[dim * dim][size];

    /** Hoop strain increment and radial force of the hoop stress, -V s_zz/r
     *  (N), in axisymmetry. */
    alignas(32) double l_zz[size];
    alignas(32) double hoop_force[size];

    /** Divergence of v (1/s) and mean stress tr s/dim (Pa) of each point, for
     *  the B-bar method. The values are replaced by their averages over the
     *  points of a cell. */
    alignas(32) double divergence[size];
    alignas(32) double mean_stress[size];
    alignas(32) double work[size], wave_modulus[size];
  };

  /** Arrays of a block of material points, including affine velocities
   *  (APIC). */
  struct TransferBlock
  {
    unsigned int              n;     ///< multiple of PointBlock::lanes
    unsigned int              group; ///< index of the group of points
    unsigned int              first; ///< index of the first point in the group
    std::array<double *, dim> x, v;
    std::array<double *, n_mandel>  s; ///< stress, order of tensor_component
    double                         *volume, *mass;
    std::array<double *, dim * dim> c; ///< C_ij at dim i + j; null without APIC
    const unsigned int             *cell; ///< null if points do not store cells
  };

  /** Sums and extrema of point quantities, accumulated in a loop over the
   *  points for the explicit time stepper. */
  struct PassSums
  {
    double work         = 0.; ///< stress work (J/m)
    double wave_speed2  = 0.; ///< largest M V/m ((m/s)^2)
    double speed2       = 0.; ///< largest v^2 ((m/s)^2)
    double strain       = 0.; ///< largest |dt dv_i/dx_j|
    double least_volume = 1.; ///< smallest det(I + dt grad v)
    /** Bounding box of the point positions (m). The first dim entries are
     *  used. */
    double lower[3] = {1e300, 1e300, 1e300};
    double upper[3] = {-1e300, -1e300, -1e300};

    /** Checksum of the positions and velocities of the points. It is not finite
     *  if the data of any point are not finite. */
    double check = 0.;

    /** Reads or writes the sums in a checkpoint. @tparam Row StateRow */
    template <typename Row>
    void
    state(Row &row)
    {
      row(work, wave_speed2, speed2, strain, least_volume, check);
      for (unsigned int d = 0; d < dim; ++d)
        row(lower[d], upper[d]);
    }

    void
    add(const PassSums &other);
  };

  /** Selection of the quantities updated by
   *  TransferKernels::update_points(). */
  struct Update
  {
    bool strain, velocity, position;
  };

  /**
   * Inner loops of the explicit material point method, compiled for different
   * instruction sets. All kernels process blocks of at most
   * PointBlock::capacity points, without allocations and without a function
   * call per point.
   */
  struct TransferKernels
  {
    const char *name; ///< name of the instruction set

    /** @name Kernels by the degree of the basis functions, 1 to 3 */
    /** @{ */

    /** Interpolates nodal values q_i and their gradients at the points: sum_i
     *  q_i N_i and sum_i q_i dN_i/dx. */
    void (*gather[4])(const GridView &, const TransferBlock &, BlockScratch &);

    /** Interpolates nodal values at the points, without gradients. */
    void (*gather_values[4])(const GridView &,
                             const TransferBlock &,
                             BlockScratch &);

    /**
     * Computes the affine velocity matrix C of APIC at each point. Column d is
     *   C_d = sum_i v_i N_i (x_i - x)_d / sum_i N_i (x_i - x)_d^2,
     * so that C equals the usual B D^{-1} for tensor-product functions. If the
     * denominator vanishes, as at the ends of the grid, C_d is the velocity
     * gradient. Not for degree 1, where C is the gradient and noise of low-mass
     * nodes grows from step to step.
     */
    void (*gather_affine[4])(const GridView &,
                             const TransferBlock &,
                             BlockScratch &);

    /**
     * Scatters the point values (a | b_x | b_y ...), stored in
     * BlockScratch::scattered, to the nodes. Each node is incremented by
     *   N a + sum_d dN/dx_d b_d,
     * and the nodal mass by N m, unless the pointer to the masses is null.
     */
    void (*scatter[4])(const GridView &, const TransferBlock &, BlockScratch &);

    /** Scatters only the point values a and the masses to the nodes, not the
     *  values b_d that multiply the gradients of the basis functions. */
    void (*scatter_values[4])(const GridView &,
                              const TransferBlock &,
                              BlockScratch &);

    /** Adds the affine momentum m N_i C (x_i - x) of each point (APIC) to the
     *  nodes i. To be called after scatter(). */
    void (*scatter_affine[4])(const GridView &,
                              const TransferBlock &,
                              BlockScratch &);
    /** @} */

    /**
     * Updates points from the interpolated velocity v and velocity increment
     * dv. With the velocity v_p of the point and the FLIP fraction f, the
     * updates are:
     *   strain:   l = dt grad v
     *   velocity: v_p <- f (v_p + dv) + (1 - f) v
     *   position: x <- x + dt v.
     */
    void (*update_points)(const Update,
                          const double dt,
                          const double flip_part,
                          const TransferBlock &,
                          BlockScratch &);

    /** Computes the divergence of the velocity at each point (stored in
     *  BlockScratch::divergence). */
    void (*find_divergence)(const TransferBlock &, BlockScratch &);

    /** Replaces the volumetric strain increment of each point with the cell
     *  mean (B-bar method). The update is
     *    l <- l + (dt BlockScratch::divergence - tr l)/dim I. */
    void (*replace_divergence)(const double dt,
                               const TransferBlock &,
                               BlockScratch &);

    /** Updates the volumes of the points, and the stress work and extrema in
     *  PassSums. The volume is V <- det(I + l) V (times 1 + l_zz in
     *  axisymmetry). */
    void (*finish)(const TransferBlock &, BlockScratch &, PassSums &);

    /** Updates the bounding box of the positions, the maximum speed and the
     *  checksum. */
    void (*bound)(const TransferBlock &, PassSums &);

    /** Computes the point values that scatter() transfers to the nodes. These
     *  are the momentum m v, the force terms -V s and the hoop force, or only
     *  momentum or force. */
    void (*prepare_scatter)(const bool momentum,
                            const bool force,
                            const TransferBlock &,
                            BlockScratch &);

    /** In the point values to be scattered, replaces the mean stress of each
     *  point with the mean over its cell (B-bar method). The update is
     *    s <- s + (BlockScratch::mean_stress - tr s/dim) I. */
    void (*replace_mean_stress)(const TransferBlock &, BlockScratch &);
  };

  /** Returns the fastest version of the transfer kernels supported by the
   *  processor, see machine_has_avx2(). */
  const TransferKernels &
  transfer_kernels();
} // namespace geocone::GEOCONE_DIM

#endif
