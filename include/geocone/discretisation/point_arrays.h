// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_discretisation_point_arrays_h
#define geocone_discretisation_point_arrays_h

#include <geocone/base/types.h>

#include <deal.II/base/point.h>

#include <array>
#include <vector>

namespace geocone
{
  /**
   * The points of one material on this rank, as explicit steps want them: a
   * contiguous array per quantity. Arrays are filled up to a multiple of
   * PointBlock::lanes with copies of the last point that have no mass and no
   * volume, so that kernels need no remainder loops.
   */
  class PointArrays
  {
  public:
    /** The arrays, of vectors and tensors the first of them; components of tensors in
     *  the order of tensor_component, tension positive, SI units. */
    enum Field : unsigned int
    {
      x      = 0,
      v      = x + dim,
      stress = v + dim,
      volume = stress + n_mandel, ///< in the plane per unit thickness (m^2)
      mass,                       ///< (kg/m)
      plastic_strain,
      x_start, ///< where displacements count from
      n_common = x_start + dim
    };

    /**
     * @param material index of the material
     * @param n_history history variables of its law
     * @param affine whether there are the components of APIC
     */
    PointArrays(const unsigned int material,
                const unsigned int n_history,
                const bool         affine);

    unsigned int
    n_points() const
    {
      return id.size();
    }

    /** Points with the copies that fill up the last vector. */
    unsigned int
    n_padded() const
    {
      return data[0].size();
    }

    double *
    operator[](const unsigned int field)
    {
      return data[field].data();
    }
    const double *
    operator[](const unsigned int field) const
    {
      return data[field].data();
    }

    /** The first of the history arrays, and of C_xx, C_xy, ... */
    unsigned int
    first_history() const
    {
      return n_common;
    }
    unsigned int
    first_affine() const
    {
      return n_common + n_history;
    }

    /** The history variables of a point, n_history of them. */
    void
    copy_history(const unsigned int p, double *values) const
    {
      for (unsigned int k = 0; k < n_history; ++k)
        values[k] = data[first_history() + k][p];
    }

    unsigned int
    n_fields() const
    {
      return data.size();
    }

    /** Makes room for @p n points with what fills up the last vector. */
    void
    reserve(const std::size_t n);

    /** Adds a point; pad() must follow before kernels see the arrays. */
    void
    append(const double *values, const unsigned int id);

    /** Removes the copies at the end; append() does it by itself. */
    void
    unpad();

    /** Fills up the arrays; clears nothing else. */
    void
    pad();

    /** Point i becomes what point order[i] was; those not in it are removed. */
    void
    reorder(const std::vector<unsigned int> &order);

    dealii::Point<dim>
    position(const unsigned int p) const
    {
      dealii::Point<dim> place;
      for (unsigned int d = 0; d < dim; ++d)
        place[d] = data[x + d][p];
      return place;
    }

    dealii::Tensor<1, dim>
    velocity(const unsigned int p) const
    {
      dealii::Tensor<1, dim> value;
      for (unsigned int d = 0; d < dim; ++d)
        value[d] = data[v + d][p];
      return value;
    }

    /** In the order of tensor_component (Pa). */
    std::array<double, n_mandel>
    stress_components(const unsigned int p) const
    {
      std::array<double, n_mandel> s;
      for (int i = 0; i < n_mandel; ++i)
        s[i] = data[stress + i][p];
      return s;
    }

    /** Bytes of the arrays. */
    std::size_t
    memory() const;

    const unsigned int material;
    const unsigned int n_history;
    const bool         affine;

    /** Counted through all ranks. */
    std::vector<unsigned int> id;

    /** The cells of the points, where a transfer keeps them here; or empty. */
    std::vector<unsigned int> cell;

    /** Whether these points are being taken away (see Stage). */
    bool fading = false;

  private:
    std::vector<std::vector<double>> data;
    std::vector<double>              buffer; ///< of reorder()
  };
} // namespace geocone

#endif
