// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/over_ranks.h>
#include <geocone/mesh/cell_search.h>
#include <geocone/problem/bars.h>

#include <algorithm>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    using RowOfBar = std::vector<std::pair<unsigned int, double>>;

    /** Axial force of an elastic elongation. */
    double
    force_of_bar(const Structure &structure,
                 const double     k,
                 const double     elongation)
    {
      return structure.pre_stress + k * elongation;
    }

    /** Whether a bar is slack under a trial force, instead of yielding: it has no
     *  strength in this direction, and carries forces again at its former length. */
    bool
    is_slack(const Structure &structure, const double trial)
    {
      return structure.admissible(trial > 0. ? 1. : -1.) == 0.;
    }

    /** Nonzero owned entries of a vector. */
    RowOfBar
    owned_entries(const Vector &b)
    {
      RowOfBar row;
      for (unsigned int i = 0; i < b.locally_owned_size(); ++i)
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
    for (unsigned int s = 0; s < structures.list.size(); ++s)
      {
        const Structure &structure = *structures.list[s];
        std::vector<std::optional<CellSearch::Place>> places;
        unsigned int                                  n_outside = 0;
        for (const Point<dim> &x : structure.points)
          {
            places.push_back(cells.find(x));
            n_outside += !places.back();
            if (n_outside > (structure.may_be_fixed() ? 1u : 0u))
              throw InputError(structure.parameter("Points"),
                               text_of_place(x),
                               structure.may_be_fixed()
                                 ? "one point at least in the body"
                                 : "points in the body",
                               "move the point into the body");
          }
        for (unsigned int i = 1; i < places.size(); ++i)
          {
            const Tensor<1, dim> along =
              structure.points[i] - structure.points[i - 1];
            Bar bar;
            bar.structure = s;
            bar.k         = structure.stiffness / along.norm();
            Vector b(space.partitioner());
            for (const unsigned int end : {i - 1, i})
              if (places[end] && places[end]->cell->is_locally_owned())
                {
                  space.cell_nodes(places[end]->cell, nodes);
                  values.resize(nodes.size());
                  space.evaluate(places[end]->cell,
                                 places[end]->unit,
                                 values.data(),
                                 nullptr);
                  for (unsigned int n = 0; n < nodes.size(); ++n)
                    for (unsigned int d = 0; d < dim; ++d)
                      b.local_element(dim * space.local_node(nodes[n]) + d) +=
                        (end == i ? 1. : -1.) * values[n] * along[d] /
                        along.norm();
                }
            b.compress(VectorOperation::add);
            bar.along_axes = owned_entries(b);
            bars.push_back(std::move(bar));
          }
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
          "the structure '" + structures.list[bars[i].structure]->name +
          "' is tied to a removed part of the body in the stage '" + stage +
          "'\n  remedy:  leave the stage out of '" +
          structures.list[bars[i].structure]->parameter("Acts in") +
          "', or move its points");
  }

  void
  Bars::begin_step(const std::string &of_step,
                   const double       step,
                   const Constraints &of_problem)
  {
    h           = step;
    constraints = &of_problem;
    if (stage != of_step)
      {
        stage = of_step;
        for (Bar &bar : bars)
          {
            const Structure &structure = *structures.list[bar.structure];
            const bool       acts      = structure.acts_in(stage);
            if (acts != bar.acts)
              {
                bar.n       = {};
                bar.n.force = acts ? structure.pre_stress : 0.;
              }
            bar.acts = acts;
          }
        check_body();
      }
    if (of_problem.turned_nodes.empty())
      {
        for (Bar &bar : bars)
          bar.row = bar.along_axes;
        return;
      }
    Vector b(space.partitioner());
    for (Bar &bar : bars)
      {
        b = 0.;
        for (const auto &[dof, value] : bar.along_axes)
          b.local_element(dof) = value;
        constraints->turn(b);
        bar.row = owned_entries(b);
      }
  }

  std::vector<double>
  Bars::products(const Vector &x) const
  {
    std::vector<double> sums;
    for (const Bar &bar : bars)
      {
        double sum = 0.;
        for (const auto &[dof, value] : bar.row)
          sum += value * x.local_element(dof);
        sums.push_back(sum);
      }
    sum_over_ranks(sums, space.partitioner()->get_mpi_communicator());
    return sums;
  }

  void
  Bars::residual(Vector &part, const Vector &v, const LocalLaw &)
  {
    part                            = 0.;
    const std::vector<double> rates = products(v);
    for (unsigned int i = 0; i < bars.size(); ++i)
      {
        Bar &bar = bars[i];
        if (!bar.acts)
          continue;
        bar.rate                   = rates[i];
        const Structure &structure = *structures.list[bar.structure];
        const double     trial     = force_of_bar(
          structure, bar.k, bar.n.elongation + h * bar.rate - bar.n.plastic);
        bar.force   = structure.admissible(trial);
        bar.elastic = bar.force == trial;
        for (const auto &[dof, value] : bar.row)
          part.local_element(dof) += bar.force * value;
      }
  }

  void
  Bars::apply_tangent(Vector &dst, const Vector &dv) const
  {
    const std::vector<double> rates = products(dv);
    for (unsigned int i = 0; i < bars.size(); ++i)
      if (bars[i].acts && bars[i].elastic)
        for (const auto &[dof, value] : bars[i].row)
          dst.local_element(dof) += bars[i].k * h * rates[i] * value;
  }

  void
  Bars::add_elastic_diagonal(Vector &dst) const
  {
    for (const Bar &bar : bars)
      if (bar.acts)
        for (const auto &[dof, value] : bar.row)
          dst.local_element(dof) += bar.k * h * value * value;
  }

  LowRank
  Bars::low_rank(const double elastic_blend) const
  {
    std::vector<unsigned int> those;
    for (unsigned int i = 0; i < bars.size(); ++i)
      if (bars[i].acts && (bars[i].elastic || elastic_blend > 0.))
        those.push_back(i);
    LowRank update;
    update.U = update.W =
      Eigen::MatrixXd::Zero(constraints->n_owned_rows, those.size());
    for (unsigned int column = 0; column < those.size(); ++column)
      {
        const Bar   &bar  = bars[those[column]];
        const double size = bar.k * h * (bar.elastic ? 1. : elastic_blend);
        for (const auto &[dof, value] : bar.row)
          if (const int row = constraints->free_row[dof]; row >= 0)
            {
              update.U(row, column) = size * value;
              update.W(row, column) = value;
            }
      }
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

  std::vector<BarState>
  Bars::commit()
  {
    std::vector<BarState> states;
    for (Bar &bar : bars)
      {
        if (bar.acts)
          {
            const Structure &structure = *structures.list[bar.structure];
            bar.n.elongation += h * bar.rate;
            const double trial =
              force_of_bar(structure, bar.k, bar.n.elongation - bar.n.plastic);
            bar.n.yields = !bar.elastic && !is_slack(structure, trial);
            if (bar.n.yields)
              bar.n.plastic += (trial - bar.force) / bar.k;
            bar.n.force = bar.force;
          }
        states.push_back(bar.n);
      }
    return states;
  }

  void
  Bars::state(StateRow &row)
  {
    for (Bar &bar : bars)
      row(bar.acts, bar.n);
  }
} // namespace geocone::GEOCONE_DIM
