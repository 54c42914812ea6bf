// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/discretisation/quadrature_points.h>
#include <geocone/output/exact_solution.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>

namespace geocone
{
  namespace
  {
    const std::array<const char *, 5> names = {{"Displacement x",
                                                "Displacement y",
                                                "Stress xx",
                                                "Stress yy",
                                                "Stress xy"}};
  }

  ExactSolution::ExactSolution()
    : dealii::ParameterAcceptor("/Exact solution")
  {
    for (unsigned int i = 0; i < names.size(); ++i)
      add_parameter(
        names[i],
        texts[i],
        std::string("Formula in x, y (m) and t (s) for the exact ") +
          (i < dim ? "displacement (m)" : "stress (Pa)") +
          " at the end of the run, or none. All five or none are "
          "given; the relative L2 errors go to summary.json.");
  }

  void
  ExactSolution::prepare()
  {
    const auto n_none = std::count(texts.begin(), texts.end(), "none");
    given             = n_none == 0;
    if (n_none != 0 && n_none != 5)
      throw InputError("Exact solution/Displacement x",
                       texts[0],
                       "formulas for all five fields, or none for all",
                       "complete the section");
    if (given)
      for (unsigned int i = 0; i < names.size(); ++i)
        fields[i].prepare(texts[i], std::string("Exact solution/") + names[i]);
  }

  FieldErrors
  ExactSolution::errors(const BackgroundMesh &mesh,
                        const Space          &space,
                        const MaterialPoints &points,
                        const Vector         &displacement,
                        const double          t) const
  {
    // Squares of |u_h - u|, |u|, |s_h - s|, |s|, integrated.
    std::array<double, 4> sums = {};
    Vector                u    = displacement;
    u.update_ghost_values();
    CellValues values(
      space,
      mesh,
      mesh.is_simplicial()
        ? dealii::Quadrature<dim>(dealii::QWitherdenVincentSimplex<dim>(4))
        : dealii::Quadrature<dim>(dealii::QGauss<dim>(space.degree() + 2)));
    std::vector<dealii::types::global_dof_index> nodes;
    for (const auto &cell : mesh.own_cells())
      {
        values.reinit(cell);
        space.cell_nodes(cell, nodes);
        for (unsigned int q = 0; q < values.weight.size(); ++q)
          for (unsigned int c = 0; c < dim; ++c)
            {
              double u_h = 0.;
              for (unsigned int i = 0; i < nodes.size(); ++i)
                u_h += values.value(i, q) *
                       u.local_element(dim * space.local_node(nodes[i]) + c);
              const double exact = fields[c].value(values.position[q], t);
              sums[0] += values.weight[q] * (u_h - exact) * (u_h - exact);
              sums[1] += values.weight[q] * exact * exact;
            }
      }
    for (unsigned int p = 0; p < points.n_points(); ++p)
      {
        const Mandel exact(fields[2].value(points.position[p], t),
                           fields[3].value(points.position[p], t),
                           sqrt2 * fields[4].value(points.position[p], t));
        sums[2] += points.weight[p] * (points.stress[p] - exact).squaredNorm();
        sums[3] += points.weight[p] * exact.squaredNorm();
      }
    dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(sums.data(), 4),
                                displacement.get_mpi_communicator(),
                                dealii::ArrayView<double>(sums.data(), 4));
    return {std::sqrt(sums[0] / sums[1]), std::sqrt(sums[2] / sums[3])};
  }
} // namespace geocone
