// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// The incremental problem over particles in an elastoplastic state, with and
// without mean gradients (B-bar), pressures of cells that are polynomials, a consistent
// mass and a fluid in the pores: the assembled Jacobian and apply_tangent() must be the derivative of the residual, one stored
// triangle must be that of the whole matrix, products with rows that share columns too, B-bar must give every point of a
// cell the mean volumetric strain of the cell and leave the deviator as it is,
// with pressures of cells the total mean stress of a cell must be a polynomial and the
// projection of its volumetric strains that of B-bar, also where particles are too few
// for all polynomials, and the mass must be that of the particles.

#include <geocone/conditions/constraints.h>
#include <geocone/linear/preconditioner.h>
#include <geocone/problem/incremental_problem.h>

#include "../discretisation/setup.h"
#include "../test.h"

#include <cmath>

namespace mechanics_b_bar_01
{
  using namespace discretisation_tests;
  using namespace geocone;

  /** Numbers without a pattern. */
  double
  some(const unsigned int i)
  {
    return std::sin(12.9898 * i + 0.3) * std::cos(4.1414 * i);
  }

  /** The means of the gradients of each cell, weighted by volume, for each point. */
  std::vector<double>
  mean_gradients(const MaterialPoints &points)
  {
    const unsigned int  m = dim * points.n_nodes;
    std::vector<double> means;
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      {
        std::vector<double> mean(m, 0.);
        double              volume = 0.;
        for (unsigned int p = points.first_point[c];
             p < points.first_point[c + 1];
             ++p)
          {
            volume += points.weight[p];
            for (unsigned int i = 0; i < m; ++i)
              mean[i] += points.weight[p] * points.gradients[p * m + i];
            for (unsigned int i = 0; i < points.n_nodes && !points.hoop.empty();
                 ++i)
              mean[i] += points.weight[p] * points.hoop[p * points.n_nodes + i];
          }
        for (double &value : mean)
          value /= volume;
        for (unsigned int p = points.first_point[c];
             p < points.first_point[c + 1];
             ++p)
          means.insert(means.end(), mean.begin(), mean.end());
      }
    return means;
  }

  enum class Volume
  {
    of_points,
    b_bar,
    cell_pressures
  };

  void
  check(const std::string &element,
        const Volume       volume_rule,
        const double       consistent_part,
        const std::string &dilatancy,
        const std::string &fluid       = "0",
        const unsigned int n_points    = 300,
        const bool         around_axis = false)
  {
    std::vector<std::string> values = {
      "Discretisation/Element = " + element,
      "Boundary conditions/Names = bottom, left",
      "Particles/Layout = random",
      "Particles/Number = " + std::to_string(n_points),
      "Materials/soil/Cohesion = 50",
      "Materials/soil/Dilatancy angle = " + dilatancy,
      "Materials/soil/Pore fluid bulk modulus = " + fluid};
    if (around_axis)
      {
        values.push_back("Geometry/Symmetry = axisymmetric");
        values.push_back("Materials/soil/Type = Drucker-Prager");
      }
    Setup setup("discretisation/box.prm", values);
    setup.prepare();
    MaterialPoints points;
    setup.particles.prepare(setup.scene, setup.mesh, setup.space, points);
    const bool b_bar          = volume_rule != Volume::of_points;
    const bool cell_pressures = volume_rule == Volume::cell_pressures;
    points.volumetric_gradients.clear();
    points.n_volumetric_modes = 0;
    if (cell_pressures)
      project_gradients(setup.space.volumetric_degree(), points);
    else if (b_bar)
      points.volumetric_gradients = mean_gradients(points);
    const unsigned int n_modes = points.n_volumetric_modes;
    const double       h       = 0.01;
    for (unsigned int p = 0; p < points.n_points(); ++p)
      points.stress[p] = {-300. + 50. * some(7 * p),
                          -300. + 50. * some(7 * p + 1),
                          30. * some(7 * p + 2)};
    if (speaks())
      std::printf("%s, %s, consistent part %g, dilatancy %s%s%s%s\n",
                  element.c_str(),
                  cell_pressures ? "pressures of cells"
                  : b_bar        ? "B-bar"
                                 : "plain",
                  consistent_part,
                  dilatancy.c_str(),
                  fluid == "0" ? "" : ", undrained",
                  n_points == 300 ? "" : ", few points",
                  around_axis ? ", around an axis" : "");

    const auto &layout = setup.space.partitioner();
    Vector      mass(layout);
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      for (unsigned int p = points.first_point[c];
           p < points.first_point[c + 1];
           ++p)
        for (unsigned int i = 0; i < points.n_nodes; ++i)
          for (unsigned int d = 0; d < dim; ++d)
            mass.local_element(dim * points.nodes[c * points.n_nodes + i] +
                               d) +=
              points.mass[p] * points.values[p * points.n_nodes + i];
    Constraints constraints(setup.scene,
                            setup.mesh,
                            setup.space,
                            setup.scene.loading.list.front()->name);
    constraints.number_unknowns(&mass);
    IncrementalProblem problem(points,
                               setup.scene.materials,
                               constraints,
                               layout,
                               &mass,
                               consistent_part);

    const unsigned int n = mass.locally_owned_size();
    Vector v(layout), vL(layout), dv(layout), one(layout), R(layout);
    for (unsigned int i = 0; i < n; ++i)
      {
        v.local_element(i)  = 1e-4 * some(i);
        vL.local_element(i) = 1e-4 * some(i + 1000);
        if (constraints.is_free(i))
          dv.local_element(i) = 1e-4 * some(i + 2000);
        one.local_element(i) = i % dim == 0;
      }
    problem.begin_step(h, nullptr, vL, Vector(layout));

    // The mass: of a unit velocity, all that the particles have.
    problem.inertia_term().apply_mass(R, one);
    double total = 0., of_points = 0.;
    for (unsigned int i = 0; i < n; ++i)
      total += R.local_element(i);
    for (const double m : points.mass)
      of_points += m;
    print("the mass is that of the particles",
          std::abs(total - of_points) < 1e-12 * of_points);

    const ResidualReport report = problem.residual(R, v);
    const auto           modes  = problem.internal_forces().modes();
    print("there are elastic and plastic points",
          report.n_cone > n_points / 15 &&
            report.n_cone + report.n_apex + n_points / 15 < n_points);

    // Strains: those of B v, with the mean of their traces, which around an axis have the
    // hoop strains.
    const unsigned int nn = points.n_nodes;
    double trace_error = 0., shear_error = 0., spread = 0., pressure_error = 0.;
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      {
        std::vector<Mandel> e;
        std::vector<double> hoop;
        double              mean = 0., volume = 0.;
        for (unsigned int p = points.first_point[c];
             p < points.first_point[c + 1];
             ++p)
          {
            e.push_back(Mandel::Zero());
            hoop.push_back(0.);
            for (unsigned int i = 0; i < nn; ++i)
              {
                const unsigned int dof = dim * points.nodes[c * nn + i];
                const double       gx  = points.gradients[2 * p * nn + i],
                             gy        = points.gradients[(2 * p + 1) * nn + i];
                const double vx        = h * v.local_element(dof),
                             vy        = h * v.local_element(dof + 1);
                e.back() +=
                  Mandel(gx * vx, gy * vy, (gy * vx + gx * vy) / sqrt2);
                if (around_axis)
                  hoop.back() += points.hoop[p * nn + i] * vx;
              }
            mean +=
              points.weight[p] * (e.back()[0] + e.back()[1] + hoop.back());
            volume += points.weight[p];
          }
        mean /= volume;
        // Polynomials of volumetric strains, of those given and of pressures.
        std::vector<double> got_part(n_modes), part(n_modes), pressure(n_modes);
        const auto          mode = [&](const unsigned int q) {
          return &points
                    .volumetric_modes[n_modes * (points.first_point[c] + q)];
        };
        for (unsigned int q = 0; q < e.size(); ++q)
          {
            const unsigned int p = points.first_point[c] + q;
            const Mandel &got = problem.internal_forces().strain_increment()[p];
            const Mandel &total = problem.internal_forces().total_stress()[p];
            for (unsigned int j = 0; j < n_modes; ++j)
              {
                const double weight = points.weight[p] * mode(q)[j];
                got_part[j] += weight * (got[0] + got[1] + hoop[q]);
                part[j] += weight * (e[q][0] + e[q][1] + hoop[q]);
                pressure[j] += weight * (total[0] + total[1]);
              }
            const double trace = e[q][0] + e[q][1] + hoop[q];
            spread             = std::max(spread, std::abs(trace - mean));
            if (!cell_pressures)
              trace_error = std::max(
                trace_error,
                std::abs(got[0] + got[1] + hoop[q] - (b_bar ? mean : trace)));
            shear_error =
              std::max({shear_error,
                        std::abs(got[0] - got[1] - e[q][0] + e[q][1]),
                        std::abs(got[2] - e[q][2])});
          }
        for (unsigned int q = 0; q < e.size() && cell_pressures; ++q)
          {
            const Mandel &total = problem.internal_forces()
                                    .total_stress()[points.first_point[c] + q];
            double difference = total[0] + total[1], rest = 0.;
            for (unsigned int j = 0; j < n_modes; ++j)
              {
                difference -= mode(q)[j] * pressure[j];
                rest += mode(q)[j] * (got_part[j] - part[j]);
              }
            pressure_error = std::max(pressure_error, std::abs(difference));
            trace_error    = std::max(trace_error, std::abs(rest));
          }
      }
    if (cell_pressures)
      print("mean stresses of a cell are a polynomial",
            pressure_error < 1e-10 * 300.);
    print(cell_pressures ? "projected volumetric strains are those given"
          : b_bar        ? "volumetric strains are the means"
                         : "volumetric strains are those of the points",
          trace_error < 1e-12 * spread);
    print("deviators are those of the points", shear_error < 1e-12 * spread);

    // Central differences of the residual, along one direction, where no point
    // changes its mode.
    const double e = 1e-6;
    Vector       above(layout), below(layout), difference(layout), moved = v;
    moved.add(e, dv);
    problem.residual(above, moved);
    bool same = problem.internal_forces().modes() == modes;
    moved.add(-2. * e, dv);
    problem.residual(below, moved);
    same &= problem.internal_forces().modes() == modes;
    print("no mode changes", same);
    difference.add(1. / (2. * e), above, -1. / (2. * e), below);

    problem.residual(R, v);
    Vector tangent(layout);
    problem.apply_tangent(tangent, dv);
    double error = 0., size = 0.;
    for (unsigned int i = 0; i < n; ++i)
      {
        error = std::max(
          error,
          std::abs(tangent.local_element(i) - difference.local_element(i)));
        size = std::max(size, std::abs(tangent.local_element(i)));
      }
    print("the tangent is the derivative, in all rows", error < 1e-7 * size);

    SparseMatrix whole = problem.make_pattern(false);
    problem.linearise(whole);
    error = 0.;
    for (unsigned int i = 0; i < n; ++i)
      if (constraints.is_free(i))
        {
          const int row = constraints.free_row[i];
          double    sum = 0.;
          for (unsigned int j = 0; j < n; ++j)
            if (constraints.is_free(j))
              {
                const int  column = constraints.free_row[j];
                const auto begin  = whole.column.begin() + whole.row_start[row],
                           end =
                             whole.column.begin() + whole.row_start[row + 1];
                const auto place = std::lower_bound(begin, end, column);
                if (place != end && *place == column)
                  sum += whole.value[place - whole.column.begin()] *
                         dv.local_element(j);
              }
          error = std::max(error, std::abs(sum - tangent.local_element(i)));
        }
    print("so is the matrix", error < 1e-12 * size);

    // Products of a matrix in which the rows of a node share their columns.
    const auto is_product_of_compact = [&](const bool one_triangle) {
      SparseMatrix compact = problem.make_pattern(one_triangle, true);
      problem.linearise(compact);
      RowOperator rows;
      rows.reinit(compact);
      RowVector x(rows.layout()), product(rows.layout());
      for (unsigned int i = 0; i < n; ++i)
        if (constraints.is_free(i))
          x.local_element(constraints.free_row[i]) = dv.local_element(i);
      rows.vmult(product, x);
      double difference = 0.;
      for (unsigned int i = 0; i < n; ++i)
        if (constraints.is_free(i))
          difference =
            std::max(difference,
                     std::abs(product.local_element(constraints.free_row[i]) -
                              tangent.local_element(i)));
      return difference < 1e-12 * size &&
             compact.column.size() < compact.value.size();
    };
    print("so is the matrix whose rows share columns",
          is_product_of_compact(false));

    if (problem.is_symmetric())
      {
        SparseMatrix triangle = problem.make_pattern(true);
        problem.linearise(triangle);
        double      asymmetry = 0., other = 0., largest = 0.;
        const int   n_rows  = whole.n_rows();
        std::size_t n_lower = 0;
        for (int row = 0; row < n_rows; ++row)
          for (int k = whole.row_start[row]; k < whole.row_start[row + 1]; ++k)
            {
              const int    column = whole.column[k];
              const double x      = whole.value[k];
              largest             = std::max(largest, std::abs(x));
              asymmetry           = std::max(
                asymmetry, std::abs(x - whole.value[whole.entry(column, row)]));
              if (column <= row)
                {
                  ++n_lower;
                  other = std::max(
                    other,
                    std::abs(x - triangle.value[triangle.entry(row, column)]));
                }
            }
        print("the matrix is symmetric", asymmetry < 1e-13 * largest);
        print("one triangle is that of the whole",
              other < 1e-13 * largest && triangle.column.size() == n_lower);
        print("so is one triangle whose rows share columns",
              is_product_of_compact(true));
      }
  }

  void
  test(int argc, char **argv)
  {
    dealii::Utilities::MPI::MPI_InitFinalize mpi_session(argc, argv, 1);
    for (const double consistent_part : {0., 0.6, 1.})
      {
        check("Q1", Volume::b_bar, consistent_part, "25");
        check("Q1", Volume::b_bar, consistent_part, "10");
      }
    check("Q1", Volume::of_points, 0.6, "25");
    check("B-spline 2", Volume::of_points, 0.6, "25");
    check("B-spline 3", Volume::of_points, 0.6, "25");
    check("B-spline 3", Volume::of_points, 0.6, "10");
    check("Q1", Volume::b_bar, 0.6, "25", "1e8");
    check("B-spline 3", Volume::of_points, 0.6, "10", "1e8");
    check("Q1", Volume::cell_pressures, 0.6, "25");
    check("Q1", Volume::cell_pressures, 0.6, "10");
    check("B-spline 2", Volume::cell_pressures, 0.6, "25");
    check("Q2", Volume::cell_pressures, 0.6, "25");
    check("Q2", Volume::cell_pressures, 0.6, "10");
    check("Q3", Volume::cell_pressures, 0.6, "25");
    check("Q3", Volume::cell_pressures, 0.6, "10", "1e8");
    check("Q2", Volume::cell_pressures, 0.6, "25", "0", 60);
    check("Q3", Volume::cell_pressures, 0.6, "10", "0", 60);
    check("B-spline 3", Volume::cell_pressures, 0., "10");
    check("B-spline 3", Volume::cell_pressures, 0.6, "25", "1e8");
    const unsigned int n = 300;
    check("Q1", Volume::of_points, 0.6, "25", "0", n, true);
    check("Q1", Volume::b_bar, 0.6, "25", "0", n, true);
    check("Q1", Volume::b_bar, 0.6, "10", "1e8", n, true);
    check("Q1", Volume::cell_pressures, 0.6, "25", "0", n, true);
    check("B-spline 3", Volume::cell_pressures, 0.6, "10", "0", n, true);
    check("Q2", Volume::cell_pressures, 0.6, "25", "1e8", n, true);
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace mechanics_b_bar_01
