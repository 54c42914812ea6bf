// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/over_ranks.h>
#include <geocone/mesh/cell_search.h>
#include <geocone/terms/bars.h>
#include <geocone/terms/plate_points.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** Nonzero entries of a vector, the first n local ones. */
    std::vector<std::pair<unsigned int, double>>
    entries_of(const Vector &b, const unsigned int n)
    {
      std::vector<std::pair<unsigned int, double>> row;
      for (unsigned int i = 0; i < n; ++i)
        if (b.local_element(i) != 0.)
          row.emplace_back(i, b.local_element(i));
      return row;
    }
  } // namespace

  Bars::Bars(const Structures     &structures,
             const BackgroundMesh &mesh,
             const Space          &space)
    : structures(structures)
    , space(space)
  {
    if (structures.list.empty())
      return;
    const CellSearch                     cells(mesh);
    std::vector<types::global_dof_index> nodes;
    std::vector<double>                  values;
    const auto ties_of = [&](const Structure               &structure,
                             const std::vector<Point<dim>> &points) {
      std::vector<Tie> ties;
      unsigned int     n_outside = 0;
      for (const Point<dim> &x : points)
        {
          const std::optional<CellSearch::Location> place = cells.find(x);
          n_outside += !place;
          if (n_outside > (structure.may_be_fixed() ? 1u : 0u))
            throw InputError(
              structure.parameter("Points"),
              text_of_place(x),
              structure.may_be_fixed() ? "one point at least in the body"
                                       : "points in the body",
              structure.is_plate() ? "let the plate end where the body ends"
                                   : "move the point into the body");
          ties.emplace_back();
          if (!place || !place->cell->is_locally_owned())
            continue;
          space.cell_nodes(place->cell, nodes);
          values.resize(nodes.size());
          space.evaluate(place->cell, place->unit, values.data(), nullptr);
          // At a node, all others have no part.
          for (unsigned int n = 0; n < nodes.size(); ++n)
            if (std::abs(values[n]) > 1e-9)
              ties.back().emplace_back(space.local_node(nodes[n]), values[n]);
        }
      return ties;
    };
    for (const auto &structure : structures.list)
      if (!structure->is_plate())
        {
          const std::vector<Point<dim>> &points = structure->points;
          const std::vector<Tie>         ties   = ties_of(*structure, points);
          for (unsigned int i = 1; i < points.size(); ++i)
            {
              const Tensor<1, dim> along = points[i] - points[i - 1];
              const Tensor<1, dim> unit  = along / along.norm();
              add_bar(*structure,
                      false,
                      structure->stiffness / along.norm(),
                      {{&ties[i], unit}, {&ties[i - 1], -unit}});
            }
        }
    for (const Structure *plate : structures.plates())
      {
        std::vector<Point<dim>> points =
          points_of_plate(*plate, mesh, space.degree());
        const std::vector<Tie> ties = ties_of(*plate, points);
        add_plate(*plate, std::move(points), ties);
      }
  }

  std::vector<std::string>
  warn_of_fixed_ends(const Structures &structures, const BackgroundMesh &mesh)
  {
    std::vector<std::string> warnings;
    if (structures.list.empty())
      return warnings;
    constexpr double near = 0.01; // part of the length
    const CellSearch cells(mesh);
    for (const auto &structure : structures.list)
      if (structure->may_be_fixed())
        for (const unsigned int end : {0, 1})
          {
            const Point<dim> &x     = structure->points[end];
            const Point<dim>  other = structure->points[1 - end];
            if (!cells.find(x) && cells.find(x + near * (other - x)))
              warnings.push_back(
                "the end (" + text_of_place(x) + ") of the structure '" +
                structure->name +
                format("' lies outside of the body by less than %g %% of the "
                       "length: it is fixed. If it is to move with the body, "
                       "move it into the body",
                       100. * near));
          }
    return warnings;
  }

  std::vector<std::string>
  warn_of_moved_plates(const Structures              &structures,
                       const std::vector<PlateState> &plates,
                       const BackgroundMesh          &mesh)
  {
    std::vector<std::string> warnings;
    if (plates.empty())
      return warnings;
    double size = std::numeric_limits<double>::infinity();
    for (const auto &cell : mesh.triangulation().active_cell_iterators())
      size = std::min(size, side_length(cell->measure()));
    for (unsigned int i = 0; i < plates.size(); ++i)
      if (plates[i].acts)
        if (const double moved =
              plates[i].largest(size_of_displacement).displacement.norm();
            moved > size / 2.)
          warnings.push_back(
            "the plate '" + structures.plates()[i]->name +
            format("' has moved by %.3g m, %.2g cells, but its points stay in "
                   "the grid, which is accurate to half a cell: take larger "
                   "cells, or Discretisation/Method = FEM",
                   moved,
                   moved / size));
    return warnings;
  }

  Vector
  Bars::row_of(const Factors &factors) const
  {
    Vector b(space.partitioner());
    for (const auto &[tie, factor] : factors)
      for (const auto &[node, weight] : *tie)
        for (unsigned int d = 0; d < dim; ++d)
          b.local_element(dim * node + d) += weight * factor[d];
    b.compress(VectorOperation::add);
    b.update_ghost_values();
    return b;
  }

  void
  Bars::add_bar(const Structure &structure,
                const bool       bends,
                const double     k,
                const Factors   &factors)
  {
    const Vector       b       = row_of(factors);
    const MPI_Comm     comm    = space.partitioner()->get_mpi_communicator();
    const unsigned int n_owned = space.partitioner()->locally_owned_size();
    const unsigned int n_local =
      n_owned + space.partitioner()->n_ghost_indices();
    Bar bar;
    bar.structure  = &structure;
    bar.bends      = bends;
    bar.k          = k;
    bar.along_axes = entries_of(b, n_owned);
    if (structure.is_chain())
      {
        const unsigned int rank    = Utilities::MPI::this_mpi_process(comm);
        const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm);
        const bool         has_all = entries_of(b, n_local).size() ==
                             Utilities::MPI::sum(bar.along_axes.size(), comm);
        const unsigned int one =
          Utilities::MPI::min(has_all ? rank : n_ranks, comm);
        bar.is_assembled      = one < n_ranks;
        bar.is_assembled_here = one == rank;
        if (bar.is_assembled_here) // for the pattern, before any step
          bar.assembled = entries_of(b, n_local);
      }
    bars.push_back(std::move(bar));
  }

  void
  Bars::add_plate(const Structure        &structure,
                  std::vector<Point<dim>> points,
                  const std::vector<Tie> &ties)
  {
    Plate plate;
    plate.points           = std::move(points);
    plate.first_segment    = bars.size();
    const unsigned int   n = plate.n_segments();
    std::vector<double>  lengths;
    std::vector<Factors> rotations; // of segments
    for (unsigned int i = 0; i < n; ++i)
      {
        Tensor<1, dim> along  = plate.points[i + 1] - plate.points[i];
        const double   length = along.norm();
        along /= length;
        add_bar(structure,
                false,
                structure.stiffness / length,
                {{&ties[i + 1], along}, {&ties[i], -along}});
        Tensor<1, dim> normal; // to the left
        normal[0] = -along[1];
        normal[1] = along[0];
        rotations.push_back(
          {{&ties[i + 1], normal / length}, {&ties[i], -normal / length}});
        lengths.push_back(length);
      }
    plate.bending.resize(n + 1);
    for (unsigned int i = 0; i <= n; ++i)
      {
        const bool at_first = i == 0, at_last = i == n;
        if (at_last && structure.is_closed())
          {
            plate.bending[i] = plate.bending[0];
            continue;
          }
        if ((at_first || at_last) && !structure.is_closed() &&
            !structure.is_clamped(at_last))
          continue;
        // Change of the rotation, which is zero beyond a clamped end.
        Factors factors;
        double  length = 0.;
        if (!at_first || structure.is_closed())
          {
            const unsigned int before = at_first ? n - 1 : i - 1;
            length += lengths[before] / 2.;
            for (const auto &[tie, factor] : rotations[before])
              factors.emplace_back(tie, -factor);
          }
        if (!at_last)
          {
            length += lengths[i] / 2.;
            factors.insert(
              factors.end(), rotations[i].begin(), rotations[i].end());
          }
        plate.bending[i] = bars.size();
        add_bar(structure, true, structure.bending / length, factors);
      }
    const unsigned int n_owned = space.partitioner()->locally_owned_size();
    for (const Tie &tie : ties)
      {
        plate.components.emplace_back();
        for (unsigned int d = 0; d < dim; ++d)
          plate.components.back()[d].along_axes =
            entries_of(row_of({{&tie, Point<dim>::unit_vector(d)}}), n_owned);
      }
    plate.displacement.resize(n + 1);
    plate.velocity.resize(n + 1);
    if (structure.interacts())
      pair_forces(plate);
    plates.push_back(std::move(plate));
  }

  void
  Bars::pair_forces(Plate &plate) const
  {
    const unsigned int n = plate.n_segments();
    const bool is_closed = bars[plate.first_segment].structure->is_closed();
    for (unsigned int i = 0; i < n + (is_closed ? 0 : 1); ++i)
      if (plate.bending[i])
        {
          if (i > 0 || is_closed)
            plate.interacting.push_back(
              {{*plate.bending[i], plate.first_segment + (i + n - 1) % n}});
          if (i < n)
            plate.interacting.push_back(
              {{*plate.bending[i], plate.first_segment + i}});
        }
  }

  void
  Bars::check_body() const
  {
    std::vector<double> n_missing; // nodes without cells, by bar
    for (const Bar &bar : bars)
      n_missing.push_back(
        bar.acts ? std::count_if(bar.along_axes.begin(),
                                 bar.along_axes.end(),
                                 [&](const auto &entry) {
                                   return !constraints->has_mass(entry.first);
                                 })
                 : 0.);
    sum_over_ranks(n_missing, space.partitioner()->get_mpi_communicator());
    for (unsigned int i = 0; i < bars.size(); ++i)
      if (n_missing[i] > 0.)
        throw RunError(
          "the structure '" + bars[i].structure->name +
          "' is tied to a part of the body that is not there in the stage '" +
          stage + "'\n  remedy:  leave the stage out of '" +
          bars[i].structure->parameter("Active in") +
          "', or move its points; where particles have moved away from it, "
          "take larger cells, or Discretisation/Method = FEM");
  }

  void
  Bars::begin_step(const std::string &of_step,
                   const double       step,
                   const Constraints &of_problem)
  {
    h           = step;
    constraints = &of_problem;
    const bool is_new = stage != of_step;
    if (is_new)
      {
        stage = of_step;
        for (Plate &plate : plates)
          if (const Bar &bar = bars[plate.first_segment];
              bar.acts != bar.structure->stages.include(stage))
            std::fill(plate.displacement.begin(),
                      plate.displacement.end(),
                      Tensor<1, dim>());
        for (Bar &bar : bars)
          {
            const bool acts = bar.structure->stages.include(stage);
            if (acts != bar.acts)
              {
                bar.n       = {};
                bar.n.force = acts ? bar.initial_force() : 0.;
              }
            bar.acts = acts;
          }
      }
    check_body();
    if (is_new || !of_problem.turned_nodes.empty())
      set_rows();
  }

  void
  Bars::set_rows()
  {
    const unsigned int n_owned = space.partitioner()->locally_owned_size();
    const unsigned int n_local =
      n_owned + space.partitioner()->n_ghost_indices();
    Vector     b(space.partitioner());
    const auto turn = [&](Functional &functional, const bool with_ghosts) {
      b = 0.;
      for (const auto &[dof, value] : functional.along_axes)
        b.local_element(dof) = value;
      constraints->turn(b);
      functional.row = entries_of(b, n_owned);
      if (with_ghosts)
        b.update_ghost_values();
    };
    for (Bar &bar : bars)
      {
        turn(bar, bar.is_assembled);
        if (bar.is_assembled_here)
          bar.assembled = entries_of(b, n_local);
        b.zero_out_ghost_values();
      }
    for (Plate &plate : plates)
      for (auto &components : plate.components)
        for (Functional &component : components)
          turn(component, false);
  }

  std::vector<double>
  Bars::products(const Vector &x) const
  {
    std::vector<double> sums;
    for (const Bar &bar : bars)
      sums.push_back(bar.product(x));
    sum_over_ranks(sums, space.partitioner()->get_mpi_communicator());
    return sums;
  }

  void
  Bars::residual(Vector &part, const Vector &v, const LocalLaw &)
  {
    part = 0.;
    std::vector<double> rates; // of bars, and the velocities of plates
    for (const Bar &bar : bars)
      rates.push_back(bar.product(v));
    for (const Plate &plate : plates)
      for (const auto &components : plate.components)
        for (const Functional &component : components)
          rates.push_back(component.product(v));
    sum_over_ranks(rates, space.partitioner()->get_mpi_communicator());
    for (unsigned int i = 0; i < bars.size(); ++i)
      {
        Bar &bar = bars[i];
        if (!bar.acts)
          continue;
        bar.rate = rates[i];
        bar.force =
          bar.elastic_force(bar.n.elongation + h * bar.rate - bar.n.plastic);
      }
    return_to_strength();
    for (const Bar &bar : bars)
      if (bar.acts)
        for (const auto &[dof, value] : bar.row)
          part.local_element(dof) += bar.force * value;
    auto rate = rates.begin() + bars.size();
    for (Plate &plate : plates)
      for (Tensor<1, dim> &velocity : plate.velocity)
        for (unsigned int d = 0; d < dim; ++d)
          velocity[d] = *rate++;
  }

  void
  Bars::return_to_strength()
  {
    yielding.clear();
    for (Bar &bar : bars)
      {
        bar.is_coupled = false;
        if (!bar.acts || bar.structure->interacts())
          continue;
        const double trial = bar.force;
        bar.force          = bar.admissible(trial);
        bar.elastic        = bar.force == trial;
      }
    for (const Plate &plate : plates)
      if (!plate.interacting.empty() && bars[plate.first_segment].acts)
        return_to_strength(plate);
  }

  void
  Bars::return_to_strength(const Plate &plate)
  {
    // The bars of a plate follow each other.
    const unsigned int first = plate.first_segment;
    unsigned int       end   = first + plate.n_segments();
    for (const auto &bending : plate.bending)
      if (bending)
        end = std::max(end, *bending + 1);
    std::vector<PlateForce> forces;
    for (unsigned int i = first; i < end; ++i)
      forces.push_back({bars[i].force / bars[i].strength(),
                        bars[i].strength() * bars[i].strength() / bars[i].k});
    auto pairs = plate.interacting;
    for (auto &[m, n] : pairs)
      {
        m -= first;
        n -= first;
      }
    for (unsigned int i = first; i < end; ++i)
      bars[i].elastic = true;
    for (YieldingForces &group : return_to_interaction(forces, pairs))
      {
        Yielding one;
        for (const unsigned int k : group.forces)
          {
            Bar         &bar   = bars[first + k];
            const double trial = bar.force;
            bar.force          = forces[k].value * bar.strength();
            bar.elastic        = bar.force == trial;
            bar.is_coupled     = true;
            one.bars.push_back(first + k);
          }
        one.stiffness = std::move(group.derivative);
        for (unsigned int k = 0; k < one.bars.size(); ++k)
          for (unsigned int l = 0; l < one.bars.size(); ++l)
            one.stiffness(k, l) *= bars[one.bars[k]].strength() /
                                   bars[one.bars[l]].strength() *
                                   bars[one.bars[l]].k;
        yielding.push_back(std::move(one));
      }
  }

  void
  Bars::apply_tangent(Vector &dst, const Vector &dv) const
  {
    const std::vector<double> rates = products(dv);
    for (unsigned int i = 0; i < bars.size(); ++i)
      if (bars[i].acts && bars[i].elastic && !bars[i].is_coupled)
        for (const auto &[dof, value] : bars[i].row)
          dst.local_element(dof) += bars[i].k * h * rates[i] * value;
    for (const Yielding &one : yielding)
      for (unsigned int k = 0; k < one.bars.size(); ++k)
        {
          double force = 0.;
          for (unsigned int l = 0; l < one.bars.size(); ++l)
            force += one.stiffness(k, l) * h * rates[one.bars[l]];
          for (const auto &[dof, value] : bars[one.bars[k]].row)
            dst.local_element(dof) += force * value;
        }
  }

  void
  Bars::add_elastic_diagonal(Vector &dst) const
  {
    for (const Bar &bar : bars)
      if (bar.acts)
        for (const auto &[dof, value] : bar.row)
          dst.local_element(dof) += bar.k * h * value * value;
  }

  std::vector<std::vector<unsigned int>>
  Bars::node_groups() const
  {
    std::vector<std::vector<unsigned int>> groups;
    for (const Bar &bar : bars)
      if (bar.is_assembled_here)
        {
          groups.emplace_back();
          for (const auto &entry : bar.assembled)
            groups.back().push_back(entry.first / dim);
        }
    return groups;
  }

  void
  Bars::linearise(const JacobianPattern &pattern,
                  const double           elastic_blend,
                  SparseMatrix          &matrix) const
  {
    for (const Bar &bar : bars)
      if (bar.acts && bar.is_assembled_here && bar.tangent(elastic_blend) > 0.)
        {
          const double size = bar.tangent(elastic_blend) * h;
          for (const auto &[i, a] : bar.assembled)
            if (const int row = constraints->free_row[i]; row >= 0)
              for (const auto &[j, b] : bar.assembled)
                if (const int column = constraints->free_row[j]; column >= 0)
                  pattern.add_entry(row, column, size * a * b, matrix);
        }
  }

  LowRank
  Bars::low_rank(const double elastic_blend) const
  {
    // Coupled bars differ from elastic ones, which are assembled or below.
    std::vector<unsigned int> those;
    for (unsigned int i = 0; i < bars.size(); ++i)
      if (bars[i].acts &&
          (bars[i].is_coupled ||
           (!bars[i].is_assembled && bars[i].tangent(elastic_blend) > 0.)))
        those.push_back(i);
    Eigen::MatrixXd stiffness =
      Eigen::MatrixXd::Zero(those.size(), those.size());
    std::vector<unsigned int> column_of(bars.size());
    for (unsigned int column = 0; column < those.size(); ++column)
      {
        const Bar &bar           = bars[those[column]];
        column_of[those[column]] = column;
        if (!bar.is_assembled)
          stiffness(column, column) = bar.tangent(elastic_blend);
      }
    for (const Yielding &one : yielding)
      for (unsigned int k = 0; k < one.bars.size(); ++k)
        for (unsigned int l = 0; l < one.bars.size(); ++l)
          stiffness(column_of[one.bars[k]], column_of[one.bars[l]]) +=
            (1. - elastic_blend) *
            (one.stiffness(k, l) - (k == l ? bars[one.bars[k]].k : 0.));
    LowRank update;
    update.W = Eigen::MatrixXd::Zero(constraints->n_owned_rows, those.size());
    for (unsigned int column = 0; column < those.size(); ++column)
      for (const auto &[dof, value] : bars[those[column]].row)
        if (const int row = constraints->free_row[dof]; row >= 0)
          update.W(row, column) = value;
    update.U = update.W * (h * stiffness);
    return update;
  }

  double
  Bars::power() const
  {
    double sum = 0.;
    for (const Bar &bar : bars)
      if (bar.acts)
        sum -= bar.force * bar.rate;
    return sum;
  }

  void
  Bars::commit()
  {
    for (Bar &bar : bars)
      if (bar.acts)
        {
          bar.n.elongation += h * bar.rate;
          const double trial =
            bar.elastic_force(bar.n.elongation - bar.n.plastic);
          bar.n.yields = !bar.elastic && !bar.is_slack(trial);
          if (bar.n.yields)
            bar.n.plastic += (trial - bar.force) / bar.k;
          bar.n.force = bar.force;
        }
    for (Plate &plate : plates)
      if (bars[plate.first_segment].acts)
        for (unsigned int i = 0; i < plate.points.size(); ++i)
          plate.displacement[i] += h * plate.velocity[i];
  }

  std::vector<BarState>
  Bars::states_of_bars() const
  {
    std::vector<BarState> states;
    for (const Bar &bar : bars)
      if (!bar.structure->is_plate())
        states.push_back(bar.n);
    return states;
  }

  std::vector<PlateState>
  Bars::states_of_plates() const
  {
    std::vector<PlateState> states;
    for (const Plate &plate : plates)
      {
        PlateState state;
        state.acts = bars[plate.first_segment].acts;
        double arc = 0.;
        for (unsigned int i = 0; i < plate.n_segments(); ++i)
          {
            std::array<PlatePoint, 2> ends;
            for (const unsigned int end : {0u, 1u})
              {
                ends[end].x            = plate.points[i + end];
                ends[end].displacement = plate.displacement[i + end];
                ends[end].normal       = bars[plate.first_segment + i].n.force;
                if (plate.bending[i + end])
                  {
                    const BarState &bending = bars[*plate.bending[i + end]].n;
                    ends[end].moment        = bending.force;
                    ends[end].hinge         = bending.plastic;
                  }
              }
            const double length = ends[0].x.distance(ends[1].x);
            const double shear  = (ends[1].moment - ends[0].moment) / length;
            ends[0].arc         = arc;
            ends[1].arc         = arc += length;
            for (PlatePoint &end : ends)
              {
                end.shear = shear;
                state.points.push_back(end);
              }
          }
        const bool is_closed = bars[plate.first_segment].structure->is_closed();
        for (unsigned int i = is_closed ? 1 : 0; i < plate.bending.size(); ++i)
          state.n_hinges +=
            plate.bending[i] && bars[*plate.bending[i]].n.yields;
        states.push_back(std::move(state));
      }
    return states;
  }

  void
  Bars::state(StateRow &row)
  {
    for (Bar &bar : bars)
      row(bar.acts, bar.n);
    for (Plate &plate : plates)
      row(plate.displacement);
  }
} // namespace geocone::GEOCONE_DIM
