// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_points_point_state_h
#define geocone_points_point_state_h

#include <geocone/base/types.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/point.h>

#include <algorithm>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Number and memory address of the components of a scalar, vector or
   *  tensor. */
  template <typename T>
  struct Components
  {
    static constexpr unsigned int n = T::n_independent_components;
    static auto
    of(T &x)
    {
      // The rows of a second-order tensor are contiguous.
      static_assert(sizeof(T) == n * sizeof(double));
      if constexpr (T::rank == 1)
        return &x[0];
      else
        return &x[0][0];
    }
  };
  template <>
  struct Components<double>
  {
    static constexpr unsigned int n = 1;
    static double *
    of(double &x)
    {
      return &x;
    }
  };
  template <>
  struct Components<unsigned int>
  {
    static constexpr unsigned int n = 1;
    static unsigned int *
    of(unsigned int &x)
    {
      return &x;
    }
  };
  template <>
  struct Components<Mandel>
  {
    static constexpr unsigned int n = n_mandel;
    static double *
    of(Mandel &x)
    {
      return x.data();
    }
  };

  /**
   * Reorders the values of a variable: new point i is old point order[i]. The
   * number of points must not increase. The memory of @p values is reused;
   * @p old is a work array.
   */
  template <typename T>
  void
  put_in_order(std::vector<T>                  &values,
               const unsigned int               width,
               const std::vector<unsigned int> &order,
               std::vector<T>                  &old)
  {
    old.assign(values.begin(), values.end());
    values.resize(width * order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
      for (unsigned int k = 0; k < width; ++k)
        values[width * i + k] = old[std::size_t(width) * order[i] + k];
  }

  /** State variable of material points in point-wise layout: the components of
   *  a point are contiguous. */
  template <typename T>
  class PointValues : public std::vector<T>
  {
  public:
    using std::vector<T>::vector;
    using std::vector<T>::operator=;

    /** Number of values per point; 0 if the variable is not in use. */
    unsigned int width = 1;

    unsigned int
    n_numbers() const
    {
      return width * Components<T>::n;
    }

    /** Resizes the array to @p n points; new points have zero values. */
    void
    set_size(const std::size_t n)
    {
      T zero;
      std::fill_n(Components<T>::of(zero), Components<T>::n, 0);
      this->resize(width * n, zero);
    }

    void
    set_capacity(const std::size_t n)
    {
      this->reserve(width * n);
    }

    /** Copies the components of the variable at point @p p to or from a row of
     *  numbers, and advances @p row. */
    void
    get(const std::size_t p, double *&row) const
    {
      for (unsigned int k = 0; k < width; ++k)
        {
          T value = (*this)[width * p + k];
          row = std::copy_n(Components<T>::of(value), Components<T>::n, row);
        }
    }
    void
    set(const std::size_t p, const double *&row)
    {
      for (unsigned int k = 0; k < width; ++k, row += Components<T>::n)
        std::copy_n(
          row, Components<T>::n, Components<T>::of((*this)[width * p + k]));
    }

    void
    reorder(const std::vector<unsigned int> &order, std::vector<double> &buffer)
    {
      if constexpr (std::is_same_v<T, double>)
        put_in_order<double>(*this, width, order, buffer);
      else
        {
          std::vector<T> old;
          put_in_order<T>(*this, width, order, old);
        }
    }

    std::size_t
    memory() const
    {
      return this->capacity() * sizeof(T);
    }
  };

  /** State variable of material points in component-wise layout: one array per
   *  component. Component c of value k has the index Components<T>::n k + c. */
  template <typename T>
  class PointComponents
  {
  public:
    unsigned int width = 1;

    unsigned int
    n_numbers() const
    {
      return width * Components<T>::n;
    }

    double *
    operator[](const unsigned int component)
    {
      return arrays[component].data();
    }
    const double *
    operator[](const unsigned int component) const
    {
      return arrays[component].data();
    }

    /** Value of the state variable at point @p p. @pre width = 1 */
    T
    of(const std::size_t p) const
    {
      T value;
      for (unsigned int c = 0; c < Components<T>::n; ++c)
        Components<T>::of(value)[c] = arrays[c][p];
      return value;
    }

    void
    set_size(const std::size_t n)
    {
      arrays.resize(n_numbers());
      for (std::vector<double> &array : arrays)
        array.resize(n, 0.);
    }

    void
    set_capacity(const std::size_t n)
    {
      arrays.resize(n_numbers());
      for (std::vector<double> &array : arrays)
        array.reserve(n);
    }

    void
    get(const std::size_t p, double *&row) const
    {
      for (const std::vector<double> &array : arrays)
        *row++ = array[p];
    }
    void
    set(const std::size_t p, const double *&row)
    {
      for (std::vector<double> &array : arrays)
        array[p] = *row++;
    }

    void
    reorder(const std::vector<unsigned int> &order, std::vector<double> &buffer)
    {
      for (std::vector<double> &array : arrays)
        put_in_order(array, 1, order, buffer);
    }

    std::size_t
    memory() const
    {
      std::size_t bytes = 0;
      for (const std::vector<double> &array : arrays)
        bytes += array.capacity() * sizeof(double);
      return bytes;
    }

  private:
    std::vector<std::vector<double>> arrays;
  };

  /**
   * State variables of material points at t_n, for all methods. The points are
   * quadrature points, or particles of implicit or explicit steps. A new
   * variable is declared here and listed in visit_all(), which is used to sort
   * points, send them to other ranks, write checkpoints and move points between
   * sets in a stage. A set uses the variables whose width is not zero.
   *
   * The layout of tensors is a parameter: PointValues<T> for assembly cell by
   * cell, with Mandel vectors; PointComponents<T> for kernels on vectors of
   * points, with the components in the order of tensor_component, without
   * Mandel factors. Scalars are contiguous in both. Tension positive, SI units.
   */
  template <template <typename> class Layout>
  struct PointState
  {
    Layout<dealii::Point<dim>> position;

    /** Volume of a material point: per unit thickness (m^2), or of its ring in
     *  axisymmetry (m^3). */
    PointValues<double> volume;
    PointValues<double> mass; ///< per unit thickness (kg/m)

    /** Material index of each point. Used if a set of points has several
     *  materials. */
    PointValues<unsigned int> material;

    /** Stress (Pa), plastic strain, and cumulative plastic strain (time
     *  integral of the norm of the plastic strain rate). */
    Layout<Mandel>      stress;
    Layout<Mandel>      plastic_strain;
    PointValues<double> cumulative_plastic_strain;

    /** Norm of the plastic strain rate over the last step (1/s). */
    PointValues<double> plastic_strain_rate;

    /** History variables of the constitutive laws at each point
     *  (ConstitutiveLaw::n_history()). Their number is equal for all points; a
     *  law can use fewer. */
    Layout<double> history;

    /** @name Particles */
    /** @{ */
    Layout<dealii::Tensor<1, dim>> velocity;
    Layout<dealii::Tensor<1, dim>> displacement; ///< since the last reset
    Layout<dealii::Point<dim>>     start;  ///< position at zero displacement
    Layout<dealii::Tensor<2, dim>> affine; ///< dv/dx of APIC
    PointValues<unsigned int>      id;     ///< unique over all ranks
    /** Boundary condition that controls the motion of a particle: its index
     *  plus 1, or 0 for none. */
    PointValues<unsigned int> held_by;
    /** Active index of the cell that contains a particle, and unit coordinates
     *  in the cell. */
    PointValues<unsigned int>       cell;
    PointValues<dealii::Point<dim>> unit;
    /** @} */

    /** Calls the function visit(name, variable) for each state variable. */
    template <typename Visit>
    void
    visit(const Visit &visit)
    {
      visit_all(*this, visit);
    }
    template <typename Visit>
    void
    visit(const Visit &visit) const
    {
      visit_all(*this, visit);
    }

    PointState()
    {
      history.width = 0;
    }

    /** Names of the state variables in use, with the number of components of
     *  each. */
    std::string
    variables() const
    {
      std::string text;
      visit([&](const char *name, const auto &variable) {
        if (variable.width > 0)
          text += std::string(text.empty() ? "" : ", ") + name + " " +
                  std::to_string(variable.n_numbers());
      });
      return text;
    }

    /** Selects the same state variables as another set of points. */
    void
    use_as(const PointState &other)
    {
      std::vector<unsigned int> widths;
      other.visit([&](const char *, const auto &variable) {
        widths.push_back(variable.width);
      });
      std::size_t i = 0;
      visit(
        [&](const char *, auto &variable) { variable.width = widths[i++]; });
    }

    /** Number of history variables of each point. */
    unsigned int
    n_history() const
    {
      return history.width;
    }

    /** Total number of components of all state variables of a point. */
    unsigned int
    n_numbers() const
    {
      unsigned int n = 0;
      visit(
        [&](const char *, const auto &variable) { n += variable.n_numbers(); });
      return n;
    }

    /** Copies all state variables of a point to or from a row of numbers, in
     *  the order of variables(). The position comes first. */
    void
    get(const std::size_t p, double *row) const
    {
      visit([&](const char *, const auto &variable) { variable.get(p, row); });
    }
    void
    set(const std::size_t p, const double *row)
    {
      visit([&](const char *, auto &variable) { variable.set(p, row); });
    }

    /** Appends the state variables of a point, as a row of numbers, to a list
     *  of rows. */
    void
    add_row(const std::size_t p, std::vector<double> &rows) const
    {
      rows.resize(rows.size() + n_numbers());
      get(p, &rows[rows.size() - n_numbers()]);
    }

    /** Resizes all arrays to @p n points; new points have zero values. */
    void
    set_size(const std::size_t n)
    {
      visit([&](const char *, auto &variable) { variable.set_size(n); });
    }

    /** Reserves memory for @p n points. */
    void
    set_capacity(const std::size_t n)
    {
      visit([&](const char *, auto &variable) { variable.set_capacity(n); });
    }

    /** Reorders the points: new point i is old point order[i]. Points not
     *  listed are removed. */
    void
    reorder(const std::vector<unsigned int> &order)
    {
      visit(
        [&](const char *, auto &variable) { variable.reorder(order, buffer); });
    }

    /** Memory consumption of the arrays (bytes). */
    std::size_t
    memory() const
    {
      std::size_t bytes = buffer.capacity() * sizeof(double);
      visit([&](const char *, const auto &variable) {
        bytes += variable.memory();
      });
      return bytes;
    }

  private:
    template <typename State, typename Visit>
    static void
    visit_all(State &state, const Visit &visit)
    {
      visit("position", state.position);
      visit("volume", state.volume);
      visit("mass", state.mass);
      visit("material", state.material);
      visit("stress", state.stress);
      visit("plastic strain", state.plastic_strain);
      visit("cumulative plastic strain", state.cumulative_plastic_strain);
      visit("plastic strain rate", state.plastic_strain_rate);
      visit("history", state.history);
      visit("velocity", state.velocity);
      visit("displacement", state.displacement);
      visit("start", state.start);
      visit("affine", state.affine);
      visit("id", state.id);
      visit("held by", state.held_by);
      visit("cell", state.cell);
      visit("unit", state.unit);
    }

    std::vector<double> buffer; ///< work array of reorder(), kept
  };

  /** Invalid rank number that marks points to be removed. */
  constexpr unsigned int nobody = dealii::numbers::invalid_unsigned_int;

  /**
   * Sends material points to the ranks that own them and removes points without
   * an owner. Points that stay keep their order and precede those that arrive.
   * @p Points is a set of points with n_points(), reorder() and append(row).
   * Collective.
   * @param owner rank that owns each point
   */
  template <typename Points>
  void
  migrate(Points                          &points,
          const std::vector<unsigned int> &owner,
          const MPI_Comm                   comm)
  {
    namespace mpi           = dealii::Utilities::MPI;
    const unsigned int rank = mpi::this_mpi_process(comm);
    std::map<unsigned int, std::vector<double>> leaving;
    std::vector<unsigned int>                   staying;
    for (unsigned int p = 0; p < owner.size(); ++p)
      if (owner[p] == rank)
        staying.push_back(p);
      else if (owner[p] != nobody)
        points.add_row(p, leaving[owner[p]]);
    if (staying.size() < owner.size())
      points.reorder(staying);
    if (!mpi::logical_or(!leaving.empty(), comm))
      return;
    const unsigned int size     = points.n_numbers();
    const auto         arriving = mpi::some_to_some(comm, leaving);
    std::size_t        n        = points.n_points();
    for (const auto &from_rank : arriving)
      n += from_rank.second.size() / size;
    points.set_capacity(n);
    for (const auto &from_rank : arriving)
      for (std::size_t i = 0; i < from_rank.second.size(); i += size)
        points.append(&from_rank.second[i]);
  }
} // namespace geocone::GEOCONE_DIM

#endif
