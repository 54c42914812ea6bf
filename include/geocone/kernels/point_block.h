// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_kernels_point_block_h
#define geocone_kernels_point_block_h

#include <geocone/base/types.h>

#include <array>

namespace geocone::GEOCONE_DIM
{
  /**
   * State of a block of points of one material, updated in place by an explicit
   * step. Structure of arrays: all quantities of a point have the same index.
   * Tensor components (no Mandel factors), tension positive, SI units.
   *
   * The arrays are read and written up to the next multiple of
   * PointBlock::lanes; entries beyond the last point are copies of the last
   * point without mass. The arrays need not be aligned.
   */
  struct PointBlock
  {
    /** Number of points that a kernel updates at once (SIMD lanes). */
    static constexpr unsigned int lanes = 4;

    /** Maximum number of points per block. Temporary arrays of this size fit
     *  into the cache. */
    static constexpr unsigned int capacity = 64;

    unsigned int n_points = 0;

    /** Increment of the displacement gradient, dt grad v. The component dt
     *  dv_i/dx_j is stored at index dim i + j. */
    std::array<const double *, dim *dim> l = {};

    /** @name State variables, updated in place: stress (Pa) in the order of
     *  tensor_component (without zz in two dimensions), history variables, and
     *  accumulated plastic strain (integral of the norm of the rate) */
    /** @{ */
    std::array<double *, n_mandel> s       = {};
    double *const                 *history = nullptr; ///< array per variable
    double                        *plastic_strain = nullptr;
    /** @} */

    /** @name Results */
    /** @{ */
    /** Stress work per unit volume in the step (Pa). It is the strain increment
     *  times the mean of the rotated stress before the step and the stress
     *  after the step. */
    double *work = nullptr;

    /** P-wave modulus M after the step (Pa); the wave speed is sqrt(M/rho). */
    double *wave_modulus = nullptr;
    /** @} */

    double step = 0.; ///< time step dt (s), for rate-dependent laws

    /** Hoop strain increments in axisymmetric problems; null in other
     *  problems. */
    const double *l_zz = nullptr;

    /** @name Access to one point */
    /** @{ */
    std::array<double, dim * dim>
    gradient(const unsigned int p) const
    {
      std::array<double, dim * dim> values;
      for (unsigned int i = 0; i < dim * dim; ++i)
        values[i] = l[i][p];
      return values;
    }
    std::array<double, n_mandel>
    stress(const unsigned int p) const
    {
      std::array<double, n_mandel> values;
      for (int i = 0; i < n_mandel; ++i)
        values[i] = s[i][p];
      return values;
    }
    void
    set_stress(const unsigned int                  p,
               const std::array<double, n_mandel> &values) const
    {
      for (int i = 0; i < n_mandel; ++i)
        s[i][p] = values[i];
    }
    /** @} */
  };

  /** Statistics of the stress updates at all points. */
  struct LawCounts
  {
    unsigned long long updates  = 0; ///< points updated, summed over steps
    unsigned long long substeps = 0; ///< substeps of laws with error control
    unsigned long long forced   = 0; ///< substeps accepted above the tolerance
    unsigned long long limited  = 0; ///< states limited to retain a stiffness
    unsigned int       most     = 0; ///< most substeps of a point in a step

    /** Reads or writes the counters in a checkpoint. @tparam Row StateRow */
    template <typename Row>
    void
    state(Row &row)
    {
      row(updates, substeps, forced, limited, most);
    }

    void
    add(const LawCounts &other)
    {
      updates += other.updates;
      substeps += other.substeps;
      forced += other.forced;
      limited += other.limited;
      most = most > other.most ? most : other.most;
    }
  };
} // namespace geocone::GEOCONE_DIM

#endif
