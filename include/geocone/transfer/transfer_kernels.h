// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_transfer_transfer_kernels_h
#define geocone_transfer_transfer_kernels_h

#include <geocone/kernels/point_block.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * One direction of a uniform grid with splines (or hats) of degree p, in the
   * layout of the kernels. On the interval i, with xi in [0, 1],
   *   N_f = sum_k coefficients[type[i]][k][f] xi^k,   k = 0 ... p,
   *   dN_f/dx = sum_k coefficients[type[i]][p + 1 + k][f] xi^k,  k = 0 ... p - 1,
   * f = 0 ... p (padded by zeros to 4) for the functions i, ..., i + p.
   */
  struct GridAxis
  {
    double               origin       = 0.; ///< (m)
    double               inverse_size = 1.; ///< 1/h (1/m)
    int                  n_intervals  = 0;
    int                  first        = 0; ///< lowest stored function
    const unsigned char *type         = nullptr;
    const double        *coefficients = nullptr;
    const double        *places = nullptr; ///< Greville abscissae (m), for APIC
  };

  /**
   * Number of doubles of a node, for vectors of four: in the plane (v_x, v_y,
   * dv_x, dv_y) to read and (m v, force) to write; in space (v, 0) and (dv, 0),
   * (m v, 0) and (force, 0). The second quantity begins at change_of_node.
   */
  constexpr unsigned int node_size      = 4 * (dim - 1);
  constexpr unsigned int change_of_node = node_size / 2;

  /**
   * Stored part of a grid: functions axes[d].first, ... per direction,
   * contiguous in the last direction. A node has node_size doubles and a mass.
   */
  struct GridView
  {
    GridAxis              axes[dim];
    std::array<long, dim> stride = {}; ///< between the functions of a direction
    const double         *read   = nullptr;
    double               *write  = nullptr;
    double               *mass   = nullptr;
  };

  /** Data of a block of points between the stages of a pass; fits into the
   *  cache. */
  struct BlockScratch
  {
    static constexpr unsigned int size = PointBlock::capacity;

    /** Values gathered at each point: the interpolated doubles of a node, then
     *  for each direction the derivatives of the first four, which begin with
     *  those of v. */
    static constexpr unsigned int n_gathered = node_size + 4 * dim;
    alignas(32) double gathered[n_gathered * size];

    /** Values scattered to nodes: (m v, 0, ...), which is multiplied by N, then
     *  for each direction d four values, which are multiplied by dN/dx_d and
     *  contain -V s_d in the place of the force. */
    static constexpr unsigned int n_given = 4 + 4 * dim;
    alignas(32) double given[n_given * size];

    alignas(32) double l[dim * dim][size];

    /** Axisymmetric: hoop strain increment, and the force along x of the hoop
     *  stress, -V s_zz/r (N). */
    alignas(32) double l_zz[size];
    alignas(32) double hoop_force[size];

    /** For B-bar: the divergence of v (1/s) and the mean stress tr s/dim (Pa),
     *  of each point or averaged over the points of its cell. */
    alignas(32) double divergence[size];
    alignas(32) double mean_stress[size];
    alignas(32) double work[size], wave_modulus[size];
  };

  /** Arrays of a block of points and of their affine velocities (APIC). */
  struct TransferBlock
  {
    unsigned int              n;     ///< a multiple of PointBlock::lanes
    unsigned int              group; ///< the arrays that they are part of
    unsigned int              first; ///< and the place of the first one there
    std::array<double *, dim> x, v;
    std::array<double *, n_mandel>  s; ///< in the order of tensor_component
    double                         *volume, *mass;
    std::array<double *, dim * dim> c; ///< C_ij at dim i + j; null without APIC
    const unsigned int             *cell; ///< null if points do not store cells
  };

  /** Sums and extrema of a pass, for the time stepper. */
  struct PassSums
  {
    double work         = 0.; ///< stress work (J/m)
    double wave_speed2  = 0.; ///< largest M V/m ((m/s)^2)
    double speed2       = 0.; ///< largest v^2 ((m/s)^2)
    double strain       = 0.; ///< largest |dt dv_i/dx_j|
    double least_volume = 1.; ///< least det(I + dt grad v)
    /** Bounds of the positions, of which there are dim (m). */
    double lower[3] = {1e300, 1e300, 1e300};
    double upper[3] = {-1e300, -1e300, -1e300};

    /** Sum of values, which is not finite if one of the points is not. */
    double check = 0.;

    /** Reads or writes a checkpoint; Row: StateRow. */
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

  /** Options of update_points() for the gathered values. */
  struct Update
  {
    bool strain, velocity, position;
  };

  /**
   * Innermost loops of the explicit material point method, in several versions
   * for different instruction sets. All kernels process blocks of at most
   * PointBlock::capacity points, without allocations and without a function
   * call per point.
   */
  struct TransferKernels
  {
    const char *name; ///< of the instruction set

    /** @name By the degree of the functions, 1 to 3 */
    /** @{ */

    /** Gathers values and slopes from the nodes: sum_i q_i (N_i, dN_i/dx,
     *  ...). */
    void (*gather[4])(const GridView &, const TransferBlock &, BlockScratch &);

    /** Gathers the values only. */
    void (*gather_values[4])(const GridView &,
                             const TransferBlock &,
                             BlockScratch &);

    /**
     * Computes the affine velocity of APIC: per direction d the column
     *   C_d = sum_i v_i N_i (x_i - x)_d / sum_i N_i (x_i - x)_d^2,
     * for a tensor product the usual B D^{-1}; the gradient if the sum
     * vanishes, as it does at the ends of the grid. Not for degree 1, where C
     * is the gradient and noise of low-mass nodes grows from step to step.
     */
    void (*gather_affine[4])(const GridView &,
                             const TransferBlock &,
                             BlockScratch &);

    /**
     * Scatters the values (a | b_x | b_y ...) to the nodes, see BlockScratch:
     *   node += N a + sum_d dN/dx_d b_d,
     * and N m to the masses unless they are null.
     */
    void (*scatter[4])(const GridView &, const TransferBlock &, BlockScratch &);

    /** Scatters a and the masses only. */
    void (*scatter_values[4])(const GridView &,
                              const TransferBlock &,
                              BlockScratch &);

    /** Adds m N C (x_i - x) to the momentum, after scatter(). */
    void (*scatter_affine[4])(const GridView &,
                              const TransferBlock &,
                              BlockScratch &);
    /** @} */

    /**
     * Updates points from the gathered (v, dv), with v_p the velocity of a
     * point:
     *   strain:   l = dt grad v
     *   velocity: v_p <- f (v_p + dv) + (1 - f) v
     *   position: x <- x + dt v.
     */
    void (*update_points)(const Update,
                          const double dt,
                          const double flip_part,
                          const TransferBlock &,
                          BlockScratch &);

    /** Computes BlockScratch::divergence from the gathered slopes. */
    void (*find_divergence)(const TransferBlock &, BlockScratch &);

    /** Replaces the divergence by its mean (B-bar):
     *    l <- l + (dt BlockScratch::divergence - tr l)/dim I. */
    void (*replace_divergence)(const double dt,
                               const TransferBlock &,
                               BlockScratch &);

    /** Updates volumes, V <- det(I + l) V, times 1 + l_zz around an axis,
     *  stress work and extrema. */
    void (*finish)(const TransferBlock &, BlockScratch &, PassSums &);

    /** Bounds of positions and velocities. */
    void (*bound)(const TransferBlock &, PassSums &);

    /** Computes the values scattered by scatter(): (m v, -V s) and the hoop
     *  force; momentum, force or both. */
    void (*prepare_scatter)(const bool momentum,
                            const bool force,
                            const TransferBlock &,
                            BlockScratch &);

    /** Replaces the mean stress in these values (B-bar):
     *    s <- s + (BlockScratch::mean_stress - tr s/dim) I. */
    void (*replace_mean_stress)(const TransferBlock &, BlockScratch &);
  };

  /** Fastest version supported by this machine; see machine_has_avx2(). */
  const TransferKernels &
  transfer_kernels();
} // namespace geocone::GEOCONE_DIM

#endif
