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
   * The points of one material on this rank, as explicit steps want them: a
   * contiguous array per number. Arrays are filled up to a multiple of
   * PointBlock::lanes with copies of the last point that have no mass and no
   * volume, so that kernels need no remainder loops.
   */
  class PointArrays : public PointState<PointComponents>
  {
  public:
    /**
     * @param of_material index of the material
     * @param n_history history variables of its law
     * @param affine whether there are the components of APIC
     * @param in_cells whether a transfer keeps the cells of the points here
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

    /** Points with the copies that fill up the last vector. */
    unsigned int
    n_padded() const
    {
      return volume.size();
    }

    /** The history variables of a point, n_history() of them. */
    void
    copy_history(const unsigned int p, double *values) const
    {
      for (unsigned int k = 0; k < n_history(); ++k)
        values[k] = history[k][p];
    }

    /** In the order of tensor_component (Pa). */
    std::array<double, n_mandel>
    stress_components(const unsigned int p) const
    {
      std::array<double, n_mandel> s;
      for (int i = 0; i < n_mandel; ++i)
        s[i] = stress[i][p];
      return s;
    }

    /** For @p n points, and what fills up the last vector, memory is taken at once. */
    void
    set_capacity(const std::size_t n);

    /** Adds a point with all numbers zero; pad() must follow before kernels see the
     *  arrays. @return its number */
    unsigned int
    append();

    /** Adds one with the numbers of a row. */
    void
    append(const double *row)
    {
      set(append(), row);
    }

    /** Fills up the arrays; clears nothing else. */
    void
    pad();

    /** Point i becomes what point order[i] was; those not in it are removed. */
    void
    reorder(const std::vector<unsigned int> &order);

    const unsigned int of_material;

    /** Whether these points are being taken away (see Stage). */
    bool fading = false;

  private:
    unsigned int n = 0;
  };
} // namespace geocone::GEOCONE_DIM

#endif
