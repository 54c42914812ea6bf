// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Rows H v = q on the free dofs: as many are kept as are independent, and what
// satisfies these satisfies all that were given; contradictions and places
// without mass are refused. Prescribed dofs count with their values, massless
// ones not at all. The fitted multipliers leave a residual that is orthogonal to
// the rows in the metric asked for. All ranks together find the same.

#include <geocone/base/exceptions.h>
#include <geocone/conditions/constraints.h>

#include "../discretisation/setup.h"
#include "../test.h"

#include <cmath>

namespace mechanics_multipliers_01
{
  using namespace discretisation_tests;
  using namespace geocone;
  using dealii::Point;

  const unsigned int plate = 1, wall = 2; // conditions

  /** A velocity asked for at a point. */
  struct Asked
  {
    unsigned int condition, component;
    Point<dim>   x;
    double       value;
  };

  /** N at a point inside one of this rank's cells, or nothing. */
  bool
  evaluate(const Setup                                  &setup,
           const Point<dim>                             &x,
           std::vector<dealii::types::global_dof_index> &nodes,
           std::vector<double>                          &N)
  {
    for (const auto &cell : setup.mesh.own_cells())
      if (cell->bounding_box().point_inside(x))
        {
          setup.space.cell_nodes(cell, nodes);
          N.resize(nodes.size());
          setup.space.evaluate(
            cell,
            setup.mesh.mapping().transform_real_to_unit_cell(cell, x),
            N.data(),
            nullptr);
          return true;
        }
    return false;
  }

  /** Numbers without a pattern, the same for a position on every rank. */
  double
  some(const Point<dim> &x, const unsigned int c)
  {
    return std::sin(7. * x[0] + 11. * x[1] * x[1] + 3. * c);
  }

  /** @param massless_above nodes higher than this have no mass */
  void
  check(const std::string        &name,
        const double              massless_above,
        const std::vector<Asked> &asked)
  {
    Setup setup("mechanics/multipliers.prm", {});
    setup.prepare();
    const Space &space = setup.space;
    if (speaks())
      std::printf("%s\n", name.c_str());

    Constraints constraints(
      setup.scene, setup.mesh, space, setup.scene.loading.list.front()->name);
    Vector         mass(space.partitioner()), v(space.partitioner());
    const auto    &X = space.node_positions();
    const unsigned n = space.n_owned_nodes();
    for (unsigned int dof = 0; dof < dim * n; ++dof)
      mass.local_element(dof) = X[dof / dim][1] > massless_above ? 0. : 1.;
    mass.update_ghost_values();
    constraints.number_unknowns(&mass);

    Multipliers                                 &rows = constraints.multipliers;
    std::vector<dealii::types::global_dof_index> nodes;
    std::vector<double>                          N;
    unsigned int                                 number = 0;
    rows.clear();
    for (const Asked &a : asked)
      {
        const Multipliers::Key key{a.condition, a.component, number++};
        if (evaluate(setup, a.x, nodes, N))
          {
            for (unsigned int i = 0; i < N.size(); ++i)
              rows.add_coefficient(key, nodes[i], N[i]);
            rows.add_target(key, a.value);
          }
      }
    constraints.set_values(v, 0.);
    if (const auto refusal = rows.assemble(space, constraints, v))
      {
        if (speaks() && refusal->is_supported)
          std::printf(
            "  row %u of condition %u asks for %g m/s, but %g m/s is left\n",
            refusal->key.number,
            refusal->key.condition,
            refusal->prescribed,
            refusal->implied);
        else if (speaks())
          std::printf("  row %u of condition %u has no function with mass\n",
                      refusal->key.number,
                      refusal->key.condition);
        return;
      }
    if (speaks())
      std::printf("  %u rows of %u\n", rows.n_rows(), rows.n_given());

    // Some velocity, projected on H v = q: it must be what was asked, in the rows
    // that were left out as well.
    for (unsigned int dof = 0; dof < dim * n; ++dof)
      if (constraints.is_free(dof))
        v.local_element(dof) = some(X[dof / dim], dof % dim);
    const unsigned int m = rows.n_rows();
    Eigen::MatrixXd G = rows.coefficients() * rows.coefficients().transpose();
    mpi::sum(dealii::ArrayView<const double>(G.data(), G.size()),
             comm,
             dealii::ArrayView<double>(G.data(), G.size()));
    if (m > 0)
      rows.add_transposed(v, 1., G.llt().solve(rows.defect(v)));
    print("no defect is left", rows.defect(v).norm() < 1e-13);
    v.update_ghost_values();
    double error = 0.;
    for (const Asked &a : asked)
      if (evaluate(setup, a.x, nodes, N))
        {
          double value = 0., supported = 0.;
          for (unsigned int i = 0; i < N.size(); ++i)
            {
              const unsigned int dof =
                dim * space.local_node(nodes[i]) + a.component;
              if (constraints.is_free(dof) || constraints.is_prescribed(dof))
                {
                  value += N[i] * v.local_element(dof);
                  supported += N[i];
                }
            }
          error = std::max(error, std::abs(value / supported - a.value));
        }
    print("all points move as asked", error < 1e-8);

    for (unsigned int d = 0; d < dim; ++d)
      if (speaks())
        std::printf("  mean velocities %c asked for: %.9f %.9f\n",
                    "xy"[d],
                    rows.mean_target(plate, d),
                    rows.mean_target(wall, d));
    if (m == 0)
      return;

    // The fit, in the metrics 1 and D.
    Vector R(space.partitioner()), D(space.partitioner());
    for (unsigned int dof = 0; dof < dim * n; ++dof)
      {
        R.local_element(dof) = some(X[dof / dim], dof % dim + 2);
        D.local_element(dof) = 2. + some(X[dof / dim], dof % dim + 5);
      }
    for (const Vector *scale : {static_cast<const Vector *>(nullptr),
                                static_cast<const Vector *>(&D)})
      {
        Vector                left   = R;
        const Eigen::VectorXd lambda = rows.remove(left, rows.factorise(scale));
        Vector                force(space.partitioner());
        rows.add_transposed(force, 1., lambda);
        if (scale != nullptr)
          for (unsigned int dof = 0; dof < dim * n; ++dof)
            left.local_element(dof) /= D.local_element(dof);
        print(scale == nullptr ? "the fit leaves nothing along the rows"
                               : "nor in the metric of D",
              rows.multiply(left).norm() < 1e-12);

        // Resultants are sums of nodal forces.
        double difference = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          {
            double sum = 0.;
            for (unsigned int dof = d; dof < dim * n; dof += dim)
              sum += force.local_element(dof);
            const double of_plate = rows.resultant(lambda, plate, d),
                         of_wall  = rows.resultant(lambda, wall, d);
            difference            = std::max(
              difference, std::abs(mpi::sum(sum, comm) - of_plate - of_wall));
            if (speaks())
              std::printf(
                "  resultants %c: %.9f %.9f\n", "xy"[d], of_plate, of_wall);
          }
        print("together they are the sum of all forces", difference < 1e-12);
      }
  }

  void
  test(int argc, char **argv)
  {
    dealii::Utilities::MPI::MPI_InitFinalize mpi_session(argc, argv, 1);
    const double                             everywhere = 2.;

    // In a cell of bilinear functions a horizontal line knows two values.
    const std::vector<Asked> line = {{plate, 1, {0.55, 0.9}, -1.},
                                     {plate, 1, {0.6, 0.9}, -1.2},
                                     {plate, 1, {0.7, 0.9}, -1.6}};
    check("one point", everywhere, {line[0]});
    check("three points on a line in a cell", everywhere, line);
    std::vector<Asked> all = line;
    for (const double y : {0.3, 0.4, 0.6, 0.7, 0.8})
      for (unsigned int c = 0; c < dim; ++c)
        all.push_back({wall, c, {0.1, y}, 0.});
    check("two conditions", everywhere, all);
    auto wrong     = line;
    wrong[2].value = -1.5;
    check("contradiction", everywhere, wrong);

    // Of the lowest cells the lower nodes move by (0.5, 0).
    const std::vector<Asked> low = {{wall, 0, {0.1, 0.05}, 0.3},
                                    {wall, 0, {0.2, 0.05}, 0.4},
                                    {wall, 1, {0.1, 0.05}, 0.3}};
    check("near prescribed nodes", everywhere, low);
    // On them, but for a rounding, nothing is left to be held.
    for (const double y : {0., 1e-9})
      {
        const Asked as_they_move   = {wall, 0, {0.1, y}, 0.5 + 1e-14},
                    in_y           = {wall, 1, {0.1, y}, 1e-14},
                    not_as_they_do = {wall, 0, {0.1, y}, 0.4};
        check("on prescribed nodes, as they move, and elsewhere",
              everywhere,
              {as_they_move, line[0]});
        check("on prescribed nodes, as they move",
              everywhere,
              {as_they_move, in_y});
        check("on prescribed nodes that move otherwise, and elsewhere",
              everywhere,
              {not_as_they_do, line[0]});
        check("on prescribed nodes that move otherwise",
              everywhere,
              {not_as_they_do});
      }

    // The highest nodes have no mass.
    check("upper nodes without mass", 0.9, line);
    check("upper nodes without mass, and two rows of one",
          0.9,
          {{plate, 1, {0.6, 0.8}, -1.}, {plate, 1, {0.6, 0.95}, -1.}});
    check("no mass at all", 0.6, line);
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace mechanics_multipliers_01
