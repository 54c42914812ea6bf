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
  /** Number of components of a value, and their address. */
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
   * Sets point i to the former point order[i], of which there are not more. The
   * memory of @p values is kept; @p old holds their copy.
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

  /** A variable of points, with the numbers of a point contiguous. */
  template <typename T>
  class PointValues : public std::vector<T>
  {
  public:
    using std::vector<T>::vector;
    using std::vector<T>::operator=;

    /** Values per point; 0 if the variable is not in use. */
    unsigned int width = 1;

    unsigned int
    n_numbers() const
    {
      return width * Components<T>::n;
    }

    /** Resizes to @p n points, new ones with zeros. */
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

    /** Copies the numbers of point @p p to or from @p row, and advances it. */
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

  /** A variable of points, with one array over all points for each number:
   *  component c of value k at Components<T>::n k + c. */
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

    /** Value of point @p p. @pre width = 1 */
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
   * State of points at t_n, for all methods: quadrature points, particles of
   * implicit and of explicit steps. A new variable is declared here and listed
   * in visit_all(), which serves sorting, sending to other ranks, checkpoints
   * and stages that move points between sets. A set uses the variables whose
   * width is not zero.
   *
   * Tensors have a layout: PointValues<T> for assembly cell by cell, with
   * Mandel vectors; PointComponents<T> for kernels on vectors of points, with
   * the components in the order of tensor_component, without Mandel factors.
   * Numbers are contiguous in both. Tension positive, SI units.
   */
  template <template <typename> class Layout>
  struct PointState
  {
    Layout<dealii::Point<dim>> position;

    /** Volume of a point, per unit thickness (m^2), or of its ring in
     *  axisymmetry (m^3). */
    PointValues<double> volume;
    PointValues<double> mass; ///< (kg/m)

    /** Index of the material, if the points of a set have several. */
    PointValues<unsigned int> material;

    /** Stress (Pa), plastic strain, and time integral of the norm of the
     *  plastic strain rate. */
    Layout<Mandel>      stress;
    Layout<Mandel>      plastic_strain;
    PointValues<double> cumulative_plastic_strain;

    /** Norm of the plastic strain rate over the last step (1/s). */
    PointValues<double> plastic_strain_rate;

    /** History variables of the laws (ConstitutiveLaw::n_history()), the same
     *  number for each point; laws can use fewer. */
    Layout<double> history;

    /** @name Particles */
    /** @{ */
    Layout<dealii::Tensor<1, dim>> velocity;
    Layout<dealii::Tensor<1, dim>> displacement; ///< since the last reset
    Layout<dealii::Point<dim>>     start;  ///< or the origin of displacements
    Layout<dealii::Tensor<2, dim>> affine; ///< of APIC: dv/dx about it
    PointValues<unsigned int>      id;     ///< unique over all ranks
    /** 1 + the condition that controls a particle, or 0. */
    PointValues<unsigned int> held_by;
    /** Active cell index, and unit coordinates in the cell. */
    PointValues<unsigned int>       cell;
    PointValues<dealii::Point<dim>> unit;
    /** @} */

    /** Calls visit(name, variable) for each. */
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

    /** Variables in use, with their number of components. */
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

    /** Uses the same variables as another set. */
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

    /** History variables of a point. */
    unsigned int
    n_history() const
    {
      return history.width;
    }

    /** Numbers of a point. */
    unsigned int
    n_numbers() const
    {
      unsigned int n = 0;
      visit(
        [&](const char *, const auto &variable) { n += variable.n_numbers(); });
      return n;
    }

    /** Copies all numbers of a point, in the order of variables(), to or from a
     *  row. The first are those of its position. */
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

    /** Appends a point to a list of rows. */
    void
    add_row(const std::size_t p, std::vector<double> &rows) const
    {
      rows.resize(rows.size() + n_numbers());
      get(p, &rows[rows.size() - n_numbers()]);
    }

    /** Resizes to @p n points, new ones with zeros. */
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

    /** Point i becomes the former point order[i]; points not in it are
     *  removed. */
    void
    reorder(const std::vector<unsigned int> &order)
    {
      visit(
        [&](const char *, auto &variable) { variable.reorder(order, buffer); });
    }

    /** Size of the arrays (bytes). */
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

    std::vector<double> buffer; ///< of reorder(): kept and shared by all arrays
  };

  /** Owner of points to be removed. */
  constexpr unsigned int nobody = dealii::numbers::invalid_unsigned_int;

  /**
   * Sends points to the ranks that own them, and removes those without an
   * owner. Points that stay keep their order and precede those that arrive.
   * Points: a set of points with n_points(), reorder() and append(row).
   * Collective.
   * @param owner of each point
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
