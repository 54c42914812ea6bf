// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/over_ranks.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/output/exact_solution.h>
#include <geocone/points/quadrature_points.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    const UsedWhere used_exact_solution[] = {
      {"Exact solution/*", "Discretisation/Method", {"FEM", "MPM"}}};
  } // namespace

  namespace
  {
    const std::vector<std::string> names_of_components = [] {
      std::vector<std::string> list;
      for (unsigned int d = 0; d < dim; ++d)
        list.push_back(std::string("Displacement ") + coordinate[d]);
      for (int i = 0; i < n_mandel; ++i)
        list.push_back(std::string("Stress ") + tensor_component[i]);
      return list;
    }();
  }

  ExactSolution::ExactSolution()
    : dealii::ParameterAcceptor("/Exact solution")
  {
    texts.fill("none");
    for (unsigned int i = 0; i < names_of_components.size(); ++i)
      add_parameter(names_of_components[i],
                    texts[i],
                    std::string("Exact ") +
                      (i < dim ? "displacement [m]" : "stress [Pa]") +
                      " at the end of the run as a formula in " + coordinates +
                      " (m) and t (s), or none. Coordinates are initial "
                      "positions of particles. All components or none are "
                      "given; relative L2 errors are written to summary.json.");
  }

  void
  ExactSolution::prepare()
  {
    const auto n_none = std::count(texts.begin(), texts.end(), "none");
    given             = n_none == 0;
    if (n_none != 0 && n_none != long(texts.size()))
      throw InputError("Exact solution/Displacement x",
                       texts[0],
                       "formulas for all fields, or none for all",
                       "complete the section");
    if (given)
      for (unsigned int i = 0; i < names_of_components.size(); ++i)
        fields[i].prepare(
          texts[i], std::string("Exact solution/") + names_of_components[i]);
  }

  FieldErrors
  ExactSolution::errors(const BackgroundMesh &mesh,
                        const Space          &space,
                        const MaterialPoints &points,
                        const Vector         &displacement,
                        const bool            points_move,
                        const double          t) const
  {
    // Integrals of the squares of |u_h - u|, |u|, |s_h - s|, |s|.
    std::array<double, 4> sums  = {};
    const auto add_displacement = [&](const dealii::Tensor<1, dim> &u_h,
                                      const dealii::Point<dim>     &x,
                                      const double                  weight) {
      for (unsigned int c = 0; c < dim; ++c)
        {
          const double exact = fields[c].value(x, t);
          sums[0] += weight * (u_h[c] - exact) * (u_h[c] - exact);
          sums[1] += weight * exact * exact;
        }
    };
    if (displacement.size() > 0)
      {
        Vector u = displacement;
        u.update_ghost_values();
        CellValues values(
          space,
          mesh,
          mesh.is_simplicial()
            ? dealii::Quadrature<dim>(dealii::QWitherdenVincentSimplex<dim>(4))
            : dealii::Quadrature<dim>(dealii::QGauss<dim>(space.degree() + 2)));
        std::vector<dealii::types::global_dof_index> nodes;
        for (const auto &cell : points.cells)
          {
            values.reinit(cell);
            space.cell_nodes(cell, nodes);
            for (unsigned int q = 0; q < values.weight.size(); ++q)
              {
                dealii::Tensor<1, dim> u_h;
                for (unsigned int i = 0; i < nodes.size(); ++i)
                  for (unsigned int c = 0; c < dim; ++c)
                    u_h[c] +=
                      values.value(i, q) *
                      u.local_element(dim * space.local_node(nodes[i]) + c);
                add_displacement(u_h, values.position[q], values.weight[q]);
              }
          }
      }
    for (unsigned int p = 0; p < points.n_points(); ++p)
      {
        dealii::Point<dim> x = points.position[p];
        if (points_move)
          x -= points.displacement[p];
        if (!points.displacement.empty())
          add_displacement(points.displacement[p], x, points.weight[p]);
        std::array<double, n_mandel> values;
        for (int i = 0; i < n_mandel; ++i)
          values[i] = fields[dim + i].value(x, t);
        const Mandel exact = mandel_of_components(values);
        sums[2] += points.weight[p] * (points.stress[p] - exact).squaredNorm();
        sums[3] += points.weight[p] * exact.squaredNorm();
      }
    sum_over_ranks(sums, mesh.triangulation().get_communicator());
    for (const double sum : sums)
      if (!std::isfinite(sum))
        throw StepFailure("the exact solution, or the error against it, is not "
                          "a finite number\n  remedy:  check the formulas in "
                          "'Exact solution'");
    return {std::sqrt(sums[0] / sums[1]), std::sqrt(sums[2] / sums[3])};
  }
} // namespace geocone::GEOCONE_DIM
