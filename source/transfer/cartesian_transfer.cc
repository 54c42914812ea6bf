// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/lexicographic.h>
#include <geocone/geometry/geometry.h>
#include <geocone/transfer/cartesian_transfer.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <map>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** Number of cells by which points may move until the next sort. */
    constexpr int margin = 2;

    /** Nodes are read and written by four values, up to three beyond the last
     *  mass. */
    constexpr unsigned int mass_padding = 4;

    /** A side of the grid: at the ends of an axis, only the first and the last
     *  function are nonzero. */
    struct GridSide
    {
      std::string  name;
      unsigned int axis, function;
    };

    std::vector<GridSide>
    sides_of_grid(const CartesianGrid &grid)
    {
      std::vector<GridSide> sides;
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int end = 0; end < 2; ++end)
          sides.push_back({side_of_box[d][end],
                           d,
                           end == 0 ? 0 : grid.axes[d].n_functions - 1});
      return sides;
    }

    /** @throws InputError for a condition on sides that are not sides of the
     *  grid */
    void
    check_grid_sides(const BoundaryCondition     &condition,
                     const std::vector<GridSide> &sides)
    {
      std::string known;
      for (const GridSide &side : sides)
        known += side.name + ", ";
      for (const std::string &name : condition.sides)
        if (name != "all" &&
            std::none_of(sides.begin(), sides.end(), [&](const GridSide &side) {
              return side.name == name;
            }))
          throw InputError(condition.parameter("Sides"),
                           name,
                           known + "all: the sides of the background mesh",
                           "choose among them");
    }
  } // namespace

  CartesianTransfer::CartesianTransfer(const MPI_Comm            comm,
                                       const CartesianGrid      &grid,
                                       const BoundaryConditions &conditions,
                                       const std::string        &first_stage)
    : comm(comm)
    , rank(Utilities::MPI::this_mpi_process(comm))
    , n_ranks(Utilities::MPI::n_mpi_processes(comm))
    , grid(grid)
    , kernels(transfer_kernels())
    , conditions(conditions)
    , acts(conditions.acting_in(first_stage))
  {
    const std::vector<GridSide> sides = sides_of_grid(grid);

    std::map<std::array<unsigned int, dim + 1>, std::vector<HeldComponent>>
      of_component;
    for (unsigned int c = 0; c < conditions.list.size(); ++c)
      {
        const BoundaryCondition &condition = *conditions.list[c];
        check_grid_sides(condition, sides);
        unsigned int n_found = 0;
        Point<dim>   lower, upper;
        for (unsigned int d = 0; d < dim; ++d)
          {
            lower[d] = 1e300;
            upper[d] = -1e300;
          }
        for (const GridSide &side : sides)
          if (condition.is_on_side(side.name))
            {
              GridIndex n  = n_functions();
              n[side.axis] = 1;
              for (std::size_t i = 0; i < grid_volume(n); ++i)
                {
                  GridIndex function  = index_in_grid(i, n);
                  function[side.axis] = side.function;
                  PrescribedNode p;
                  p.node      = number_in_grid(function, n_functions());
                  p.condition = p.carrier = c;
                  for (unsigned int d = 0; d < dim; ++d)
                    p.place[d] = grid.axes[d].places[function[d]];
                  if (!condition.holds_at(p.place))
                    continue;
                  ++n_found;
                  std::array<unsigned int, dim + 1> key;
                  for (unsigned int d = 0; d < dim; ++d)
                    {
                      key[d]   = function[d];
                      lower[d] = std::min(lower[d], p.place[d]);
                      upper[d] = std::max(upper[d], p.place[d]);
                    }
                  for (unsigned int d = 0; d < dim; ++d)
                    if (condition.components[d])
                      {
                        key[dim]    = d;
                        p.component = d;
                        of_component[key].push_back({p, side.axis == d});
                      }
                }
            }
        condition.check_selection(n_found);
        centres.push_back(lower + (upper - lower) / 2.);
      }
    for (const auto &entry : of_component)
      prescribed_functions.push_back(entry.second);
  }

  bool
  CartesianTransfer::begin_stage(const std::string &stage)
  {
    std::vector<bool> next    = conditions.acting_in(stage);
    const bool        changes = next != acts;
    acts                      = std::move(next);
    return changes;
  }

  void
  CartesianTransfer::sort(std::vector<PointArrays> &groups)
  {
    if (n_ranks > 1)
      {
        cut_slabs(groups);
        migrate(groups);
      }
    sort_by_cell(groups);
    store_nodes();
  }

  void
  CartesianTransfer::cut_slabs(const std::vector<PointArrays> &groups)
  {
    const CartesianGrid::Axis &axis = grid.axes[0];
    std::vector<std::size_t>   points_in(axis.n_intervals, 0);
    for (const PointArrays &group : groups)
      for (unsigned int p = 0; p < group.n_points(); ++p)
        ++points_in[axis.interval(group.position[0][p])];
    Utilities::MPI::sum(points_in, comm, points_in);
    slab_begin = grid.slabs(points_in, n_ranks);
  }

  void
  CartesianTransfer::migrate(std::vector<PointArrays> &groups) const
  {
    const CartesianGrid::Axis &axis = grid.axes[0];
    for (PointArrays &group : groups)
      {
        std::vector<unsigned int> owner(group.n_points());
        for (unsigned int p = 0; p < group.n_points(); ++p)
          owner[p] = std::upper_bound(slab_begin.begin() + 1,
                                      slab_begin.end() - 1,
                                      axis.interval(group.position[0][p])) -
                     slab_begin.begin() - 1;
        geocone::migrate(group, owner, comm);
        group.pad();
      }
  }

  void
  CartesianTransfer::sort_by_cell(std::vector<PointArrays> &groups)
  {
    // Range of the points, with a margin for motion.
    for (unsigned int d = 0; d < dim; ++d)
      {
        const CartesianGrid::Axis &axis = grid.axes[d];
        cells[d] = {static_cast<int>(axis.n_intervals), 0};
        for (const PointArrays &group : groups)
          for (unsigned int p = 0; p < group.n_points(); ++p)
            {
              const int i    = axis.interval(group.position[d][p]);
              cells[d].begin = std::min(cells[d].begin, i - margin);
              cells[d].end   = std::max(cells[d].end, i + 1 + margin);
            }
        cells[d].begin = std::max(cells[d].begin, 0);
        cells[d].end =
          std::min(cells[d].end, static_cast<int>(axis.n_intervals));
        if (cells[d].end < cells[d].begin)
          cells[d] = {0, 0};
      }
    // Columns have the same rows on all ranks, so that shared ones are
    // identical.
    for (unsigned int d = 1; d < dim; ++d)
      {
        int rows[2] = {cells[d].size() > 0
                         ? -cells[d].begin
                         : -static_cast<int>(grid.axes[d].n_intervals),
                       cells[d].end};
        Utilities::MPI::max(rows, comm, rows);
        if (cells[d].size() > 0)
          cells[d] = {-rows[0], rows[1]};
      }

    std::size_t n_cells = 1;
    for (const Range &range : cells)
      n_cells *= range.size();
    for (PointArrays &group : groups)
      {
        const unsigned int n = group.n_points();
        if (n == 0)
          continue;
        const auto cell_of = [&](const unsigned int p) {
          std::size_t cell = 0;
          for (unsigned int d = 0; d < dim; ++d)
            cell =
              cell * cells[d].size() +
              (grid.axes[d].interval(group.position[d][p]) - cells[d].begin);
          return cell;
        };
        count.assign(n_cells + 1, 0);
        bool        sorted = true;
        std::size_t last   = 0;
        for (unsigned int p = 0; p < n; ++p)
          {
            const std::size_t cell = cell_of(p);
            ++count[cell + 1];
            sorted = sorted && cell >= last;
            last   = cell;
          }
        if (sorted)
          continue;
        for (std::size_t c = 1; c < count.size(); ++c)
          count[c] += count[c - 1];
        order.resize(n);
        for (unsigned int p = 0; p < n; ++p)
          order[count[cell_of(p)]++] = p;
        group.reorder(order);
      }
  }

  void
  CartesianTransfer::store_nodes()
  {
    for (unsigned int d = 0; d < dim; ++d)
      stored[d] =
        cells[d].size() > 0
          ? Range{cells[d].begin, cells[d].end + static_cast<int>(grid.degree)}
          : Range{0, 0};
    const std::size_t n = stored[0].size() * column_size();
    read.resize_fast(node_size * n);
    write.resize_fast(node_size * n);
    mass.resize_fast(n + mass_padding);
    read.fill(0.);
    write.fill(0.);
    mass.fill(0.);

    // A column is counted on the lowest rank that stores it.
    const auto all = Utilities::MPI::all_gather(
      comm, std::array<int, 2>{{stored[0].begin, stored[0].end}});
    stored_columns.clear();
    for (const auto &range : all)
      stored_columns.push_back({range[0], range[1]});
    const auto is_mine = [&](const int column) {
      for (unsigned int r = 0; r < rank; ++r)
        if (column >= stored_columns[r].begin && column < stored_columns[r].end)
          return false;
      return true;
    };
    const unsigned int stride = column_size();
    mine.clear();
    for (int column = stored[0].begin; column < stored[0].end; ++column)
      if (is_mine(column))
        {
          const unsigned int first = (column - stored[0].begin) * stride;
          if (!mine.empty() && mine.back()[1] == first)
            mine.back()[1] += stride;
          else
            mine.push_back({{first, first + stride}});
        }

    prescribed.clear();
    for (const std::vector<HeldComponent> &all : prescribed_functions)
      {
        // The last acting condition in the list determines the component.
        const auto last =
          std::find_if(all.rbegin(), all.rend(), [&](const HeldComponent &one) {
            return acts[one.node.condition];
          });
        if (last == all.rend())
          continue;
        PrescribedNode p       = last->node;
        const auto     formula = [&](const HeldComponent &one) {
          return conditions.list[one.node.condition]->formula(p.component);
        };
        const auto carrier =
          std::find_if(last, all.rend(), [&](const HeldComponent &one) {
            return one.is_normal && acts[one.node.condition] &&
                   formula(one) == formula(*last);
          });
        p.carrier = (carrier == all.rend() ? last : carrier)->node.condition;
        const GridIndex function  = index_in_grid(p.node, n_functions());
        bool            is_stored = true;
        for (unsigned int d = 0; d < dim; ++d)
          is_stored = is_stored &&
                      static_cast<int>(function[d]) >= stored[d].begin &&
                      static_cast<int>(function[d]) < stored[d].end;
        if (!is_stored)
          continue;
        p.node = stored_index_of(function);
        p.mine = is_mine(function[0]);
        prescribed.push_back(p);
      }
  }

  GridIndex
  CartesianTransfer::n_functions() const
  {
    GridIndex n;
    for (unsigned int d = 0; d < dim; ++d)
      n[d] = grid.axes[d].n_functions;
    return n;
  }

  std::size_t
  CartesianTransfer::column_size() const
  {
    std::size_t n = 1;
    for (unsigned int d = 1; d < dim; ++d)
      n *= stored[d].size();
    return n;
  }

  std::size_t
  CartesianTransfer::stored_index_of(
    const std::array<unsigned int, dim> &function) const
  {
    std::size_t place = 0;
    for (unsigned int d = 0; d < dim; ++d)
      place = place * stored[d].size() + (function[d] - stored[d].begin);
    return place;
  }

  bool
  CartesianTransfer::must_sort(const PassSums &sums) const
  {
    if (sums.lower[0] > sums.upper[0])
      return false; // no points
    bool must = false;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const CartesianGrid::Axis &axis = grid.axes[d];
        must                            = must ||
               (cells[d].begin > 0 &&
                axis.interval(sums.lower[d]) <= cells[d].begin) ||
               (cells[d].end < static_cast<int>(axis.n_intervals) &&
                axis.interval(sums.upper[d]) >= cells[d].end - 1);
      }
    return must;
  }

  GridView
  CartesianTransfer::view(const bool with_mass)
  {
    GridView g;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const CartesianGrid::Axis &from = grid.axes[d];
        GridAxis                  &to   = g.axes[d];
        to.origin                       = from.begin;
        to.inverse_size                 = from.inverse_size;
        to.n_intervals                  = from.n_intervals;
        to.first                        = stored[d].begin;
        to.type                         = from.type.data();
        to.coefficients                 = from.coefficients.data();
        to.greville                     = from.places.data();
      }
    g.stride[dim - 1] = 1;
    for (unsigned int d = dim - 1; d-- > 0;)
      g.stride[d] = g.stride[d + 1] * stored[d + 1].size();
    g.read  = read.data();
    g.write = write.data();
    g.mass  = with_mass ? mass.data() : nullptr;
    return g;
  }

  void
  CartesianTransfer::gather(const TransferBlock &points, BlockScratch &scratch)
  {
    kernels.gather[grid.degree](view(false), points, scratch);
  }

  void
  CartesianTransfer::gather_values(const TransferBlock &points,
                                   BlockScratch        &scratch)
  {
    kernels.gather_values[grid.degree](view(false), points, scratch);
  }

  void
  CartesianTransfer::gather_affine(const TransferBlock &points,
                                   BlockScratch        &scratch)
  {
    kernels.gather_affine[grid.degree](view(false), points, scratch);
  }

  void
  CartesianTransfer::scatter(const TransferBlock &points,
                             BlockScratch        &scratch,
                             const bool           with_mass)
  {
    kernels.scatter[grid.degree](view(with_mass), points, scratch);
  }

  void
  CartesianTransfer::scatter_values(const TransferBlock &points,
                                    BlockScratch        &scratch,
                                    const bool           with_mass)
  {
    kernels.scatter_values[grid.degree](view(with_mass), points, scratch);
  }

  void
  CartesianTransfer::scatter_affine(const TransferBlock &points,
                                    BlockScratch        &scratch)
  {
    kernels.scatter_affine[grid.degree](view(false), points, scratch);
  }

  void
  CartesianTransfer::find_cells(const TransferBlock &points,
                                unsigned int        *numbers) const
  {
    for (unsigned int k = 0; k < points.n; ++k)
      {
        std::array<unsigned int, dim> lowest;
        for (unsigned int d = 0; d < dim; ++d)
          lowest[d] = grid.axes[d].interval(points.x[d][k]);
        numbers[k] = stored_index_of(lowest);
      }
  }

  std::size_t
  CartesianTransfer::n_stored_cells() const
  {
    // A cell has the index of the lowest of its functions.
    return n_nodes();
  }

  void
  CartesianTransfer::exchange_cells()
  {
    sum_over_ranks({{sums_of_cells.data(), 2}});
  }

  void
  CartesianTransfer::exchange(const bool with_mass)
  {
    std::vector<Shared> arrays = {{write.data(), node_size}};
    if (with_mass)
      arrays.push_back({mass.data(), 1});
    sum_over_ranks(arrays);
  }

  std::vector<CartesianTransfer::Range>
  CartesianTransfer::shared_columns() const
  {
    std::vector<Range> shared(n_ranks);
    Range              all = {stored[0].end, stored[0].begin};
    for (unsigned int r = 0; r < n_ranks; ++r)
      {
        shared[r] = {std::max(stored[0].begin, stored_columns[r].begin),
                     std::min(stored[0].end, stored_columns[r].end)};
        if (r == rank || shared[r].size() <= 0)
          {
            shared[r] = {0, 0};
            continue;
          }
        all.begin = std::min(all.begin, shared[r].begin);
        all.end   = std::max(all.end, shared[r].end);
      }
    shared[rank] = all;
    return shared;
  }

  template <typename Combine>
  void
  CartesianTransfer::combine_over_ranks(const std::vector<Shared> &arrays,
                                        const double               identity,
                                        const Combine             &combine)
  {
    if (n_ranks == 1)
      return;
    const std::vector<Range> shared = shared_columns();
    const Range             &all    = shared[rank];
    if (all.size() <= 0)
      return;
    const unsigned int       stride = column_size();
    std::vector<MPI_Request> requests;
    receive.resize(n_ranks);

    unsigned int per_node = 0;
    for (const Shared &array : arrays)
      per_node += array.per_node;
    const auto offset = [&](const int column) {
      return static_cast<std::size_t>(column - stored[0].begin) * stride;
    };
    const auto pack = [&](const Range &range, std::vector<double> &buffer) {
      const std::size_t first = offset(range.begin),
                        n     = static_cast<std::size_t>(range.size()) * stride;
      buffer.resize(per_node * n);
      auto to = buffer.begin();
      for (const Shared &array : arrays)
        to = std::copy_n(
          array.values + array.per_node * first, array.per_node * n, to);
    };
    pack(all, receive[rank]);
    sent.resize(n_ranks);
    for (unsigned int r = 0; r < n_ranks; ++r)
      if (r != rank && shared[r].size() > 0)
        {
          pack(shared[r], sent[r]);
          receive[r].resize(sent[r].size());
          const int n = sent[r].size();
          requests.resize(requests.size() + 2);
          MPI_Request *const last = &requests.back();
          MPI_Irecv(receive[r].data(), n, MPI_DOUBLE, r, 0, comm, last - 1);
          MPI_Isend(sent[r].data(), n, MPI_DOUBLE, r, 0, comm, last);
        }
    MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);

    // In the order of the ranks, for identical results on all ranks.
    for (const Shared &array : arrays)
      std::fill_n(array.values + array.per_node * offset(all.begin),
                  array.per_node * static_cast<std::size_t>(all.size()) *
                    stride,
                  identity);
    for (unsigned int r = 0; r < n_ranks; ++r)
      {
        if (shared[r].size() <= 0)
          continue;
        const std::size_t first = offset(shared[r].begin),
                          n =
                            static_cast<std::size_t>(shared[r].size()) * stride;
        const double *from = receive[r].data();
        for (const Shared &array : arrays)
          for (std::size_t i = 0; i < array.per_node * n; ++i)
            {
              double &value = array.values[array.per_node * first + i];
              value         = combine(value, *from++);
            }
      }
  }

  void
  CartesianTransfer::sum_over_ranks(const std::vector<Shared> &arrays)
  {
    combine_over_ranks(arrays, 0., std::plus<double>());
  }

  void
  CartesianTransfer::minimise_over_ranks(std::vector<double> &values)
  {
    combine_over_ranks(
      {{values.data(), 1}},
      std::numeric_limits<double>::infinity(),
      [](const double a, const double b) { return std::min(a, b); });
  }

  std::vector<Point<dim>>
  CartesianTransfer::node_positions() const
  {
    std::vector<Point<dim>> positions(n_nodes());
    for (std::size_t i = 0; i < positions.size(); ++i)
      {
        std::size_t rest = i; // the last direction varies fastest
        for (unsigned int d = dim; d-- > 0; rest /= stored[d].size())
          positions[i][d] =
            grid.axes[d].places[stored[d].begin + rest % stored[d].size()];
      }
    return positions;
  }

  void
  CartesianTransfer::for_each_node(
    const PointArrays &group,
    const unsigned int /* number_of_group */,
    const unsigned int                             p,
    const std::function<void(const unsigned int)> &f) const
  {
    std::array<unsigned int, dim> first;
    GridIndex                     n;
    for (unsigned int d = 0; d < dim; ++d)
      {
        first[d] = grid.axes[d].interval(group.position[d][p]);
        n[d]     = grid.degree + 1;
      }
    for (std::size_t i = 0; i < grid_volume(n); ++i)
      {
        const GridIndex               offset   = index_in_grid(i, n);
        std::array<unsigned int, dim> function = first;
        for (unsigned int d = 0; d < dim; ++d)
          function[d] += offset[d];
        f(stored_index_of(function));
      }
  }

  bool
  CartesianTransfer::covers(const Point<dim> &x) const
  {
    bool inside = grid.contains(x, 0.);
    for (unsigned int d = 0; d < dim; ++d)
      {
        const int i = inside ? grid.axes[d].interval(x[d]) : 0;
        inside      = inside && i >= cells[d].begin && i < cells[d].end;
      }
    return inside;
  }

  Point<dim>
  CartesianTransfer::stored_place() const
  {
    Point<dim> place;
    for (unsigned int d = 0; d < dim; ++d)
      place[d] =
        grid.axes[d].begin + (cells[d].begin + 0.5) * grid.axes[d].size;
    return place;
  }

  Point<dim>
  CartesianTransfer::nearest_in_domain(const Point<dim> &x) const
  {
    Point<dim> nearest;
    for (unsigned int d = 0; d < dim; ++d)
      nearest[d] =
        std::min(std::max(x[d], grid.axes[d].begin), grid.axes[d].end);
    return nearest;
  }

  std::size_t
  CartesianTransfer::memory() const
  {
    return read.memory_consumption() + write.memory_consumption() +
           mass.memory_consumption() +
           sums_of_cells.capacity() * sizeof(double) +
           (count.capacity() + order.capacity()) * sizeof(unsigned int);
  }

  std::string
  CartesianTransfer::description() const
  {
    return std::string("uniform grid, ") + kernels.name + " kernels";
  }
} // namespace geocone::GEOCONE_DIM
