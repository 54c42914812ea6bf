// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_points_point_arrays_h
#define geocone_points_point_arrays_h

#include <geocone/points/point_state.h>

#include <array>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Material points of one material on this rank, with one contiguous array per
   * component. Explicit steps use this layout. Arrays are padded to a multiple
   * of PointBlock::lanes with copies of the last point without mass and volume,
   * so that kernels need no remainder loops.
   */
  class PointArrays : public PointState<PointComponents>
  {
  public:
    /**
     * Creates an empty set of points.
     * @param of_material index of the material
     * @param n_history number of history variables of the law
     * @param affine whether the components of APIC are used
     * @param in_cells whether the cells of the points are stored, for the
     * transfer
     */
    PointArrays(const unsigned int of_material,
                const unsigned int n_history,
                const bool         affine,
                const bool         in_cells);

    unsigned int
    n_points() const
    {
      return n;
    }

    /** Number of points including the padding. */
    unsigned int
    n_padded() const
    {
      return volume.size();
    }

    /** Copies the history variables of a point to an array. */
    void
    copy_history(const unsigned int p, double *values) const
    {
      for (unsigned int k = 0; k < n_history(); ++k)
        values[k] = history[k][p];
    }

    /** Stress components of a point in the order of tensor_component (Pa). */
    std::array<double, n_mandel>
    stress_components(const unsigned int p) const
    {
      std::array<double, n_mandel> s;
      for (int i = 0; i < n_mandel; ++i)
        s[i] = stress[i][p];
      return s;
    }

    /** Reserves memory for @p n points and the padding. */
    void
    set_capacity(const std::size_t n);

    /** Appends a point whose state variables are zero. Before kernels use the
     *  arrays, pad() must be called. @return index of the point */
    unsigned int
    append();

    /** Appends a point, given the values of its state variables in the order of
     *  variables(). */
    void
    append(const double *row)
    {
      set(append(), row);
    }

    /** Pads the arrays with copies of the last point that have neither mass nor
     *  volume. */
    void
    pad();

    /** Reorders the points: new point i is old point order[i]. Points not
     *  listed are removed. */
    void
    reorder(const std::vector<unsigned int> &order);

    const unsigned int of_material;

    /** True if the points of this array are being removed gradually, by ramping
     *  down their mass (see Stage). */
    bool ramped = false;

  private:
    unsigned int n = 0;
  };
} // namespace geocone::GEOCONE_DIM

#endif
