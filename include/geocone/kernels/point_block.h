// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_kernels_point_block_h
#define geocone_kernels_point_block_h

#include <geocone/base/types.h>

#include <array>

namespace geocone::GEOCONE_DIM
{
  /**
   * A block of points of one material that an explicit step updates in place: a
   * structure of arrays, with the same index for all quantities of a point.
   * Tensor components (no Mandel factors), tension positive, SI units.
   *
   * The arrays are read and written up to the next multiple of
   * PointBlock::lanes; entries beyond the last point are copies of it without
   * mass. They need not be aligned.
   */
  struct PointBlock
  {
    /** Points that a kernel updates at once. */
    static constexpr unsigned int lanes = 4;

    /** Maximum number of points per block; scratch arrays of this size stay in
     *  cache. */
    static constexpr unsigned int capacity = 64;

    unsigned int n_points = 0;

    /** Increment of the displacement gradient dt grad v: dt dv_i/dx_j at dim
     *  i + j. */
    std::array<const double *, dim *dim> l = {};

    /** @name State, updated in place: stress (Pa) in the order of
     *  tensor_component, in the plane without zz; history; and the integral of
     *  the norm of the plastic strain rate */
    /** @{ */
    std::array<double *, n_mandel> s       = {};
    double *const                 *history = nullptr; ///< n_history() arrays
    double                        *plastic_strain = nullptr;
    /** @} */

    /** @name Results */
    /** @{ */
    /** Stress work per volume (Pa): strain increment times the mean of the
     *  stresses before (rotated) and after the step. */
    double *work = nullptr;

    /** Modulus M of the elastic pressure wave after the step, c = sqrt(M/rho)
     *  (Pa). */
    double *wave_modulus = nullptr;
    /** @} */

    double step = 0.; ///< dt (s), for rate-dependent laws

    /** Out-of-plane strain increments of axisymmetric scenes; null: none. */
    const double *l_zz = nullptr;

    /** @name Values of one point */
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

  /** Statistics of constitutive updates; sums and extremes over all points. */
  struct LawCounts
  {
    unsigned long long updates  = 0; ///< points times steps
    unsigned long long substeps = 0; ///< of laws with error control
    unsigned long long forced   = 0; ///< accepted despite their error
    unsigned long long limited  = 0; ///< states limited to keep a stiffness
    unsigned int       most     = 0; ///< substeps of one point in one step

    /** Variables for checkpoints; Row: StateRow. */
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
