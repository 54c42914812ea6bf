// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Ghost stiffness of light splines. Linear velocities must have no force; the
// forces of any velocity must neither push nor turn the body, and their power must
// be the work that is booked. The matrix must be the tangent, which is the same as
// the forces. All ranks together must find the same stencils, and none where all
// functions are full; only towards the material may a function be held.

#include <geocone/conditions/constraints.h>
#include <geocone/terms/ghost_stiffness.h>

#include "../discretisation/setup.h"
#include "../test.h"

#include <cmath>

namespace mechanics_ghost_stiffness_01
{
  using namespace discretisation_tests;
  using namespace geocone;
  using dealii::Point;

  /** How full a function at x is: below a surface that rises to the right, between
   *  half and nothing in a band, and full below. */
  double
  filled(const Point<dim> &x, const double height)
  {
    const double depth = height + 0.2 * x[0] - x[1];
    return std::clamp(0.5 + depth / 0.2, 0., 1.);
  }

  /** Numbers without a pattern, the same for a position on every rank. */
  double
  some(const Point<dim> &x, const unsigned int c)
  {
    return std::sin(7. * x[0] + 11. * x[1] * x[1] + 3. * c);
  }

  void
  check(const std::string &element, const double height)
  {
    Setup setup("mechanics/ghost_stiffness.prm",
                {"Discretisation/Element = " + element});
    setup.prepare();
    const Space &space = setup.space;
    const auto  &x     = space.node_positions();
    if (speaks())
      std::printf("%s, surface at %g m\n", element.c_str(), height);

    Vector volume(space.partitioner()), mass(space.partitioner());
    const std::vector<double> integral = space.spline_integrals();
    const double              E        = 1e6;
    for (unsigned int node = 0; node < space.n_owned_nodes(); ++node)
      {
        const double V = filled(x[node], height) * integral[node];
        volume.local_element(dim * node)     = V;
        volume.local_element(dim * node + 1) = E * V;
        for (unsigned int d = 0; d < dim; ++d)
          mass.local_element(dim * node + d) = 1000. * V;
      }
    volume.update_ghost_values();
    mass.update_ghost_values();
    Constraints unknowns(
      setup.scene, setup.mesh, space, setup.scene.loading.list.front()->name);
    unknowns.number_unknowns(&mass);

    const GhostPlaces places(setup.mesh, space);
    const auto        stencils = places.stencils(volume, unknowns, {}, 1e-3);
    double            sums[3]  = {double(stencils.size()), 0., 0.};
    bool              inwards  = true;
    for (const GhostStencil &stencil : stencils)
      {
        sums[1] += stencil.stiffness;
        inwards = inwards && places.fill(volume, stencil.node[0]) > 0.4 &&
                  places.fill(volume, stencil.node[1]) >
                    places.fill(volume, stencil.node[2]);
      }
    mpi::sum(sums, comm, sums);
    const unsigned int n_light = places.n_light(volume, unknowns);
    if (speaks())
      std::printf("  %g stencils, %u light functions, stiffness %.6g Pa\n",
                  sums[0],
                  n_light,
                  sums[1]);
    print("held by fuller ones only", inwards);

    GhostStiffness ghost(stencils, unknowns);
    const double   h = 0.1;
    ghost.begin_step(h);
    Vector v(space.partitioner()), f(space.partitioner()), df(f);
    for (unsigned int node = 0; node < space.n_owned_nodes(); ++node)
      for (unsigned int d = 0; d < dim; ++d)
        v.local_element(dim * node + d) =
          1. + d - (2. + d) * x[node][0] + 3. * x[node][1];
    v.update_ghost_values();
    ghost.residual(f, v, {});
    const double linear = f.linfty_norm();

    for (unsigned int node = 0; node < space.n_owned_nodes(); ++node)
      for (unsigned int d = 0; d < dim; ++d)
        v.local_element(dim * node + d) = some(x[node], d);
    v.update_ghost_values();
    ghost.residual(f, v, {});
    const double largest = f.linfty_norm();
    print("no force in linear velocities", linear <= 1e-12 * (1. + largest));
    double resultants[4] = {}; // x, y, moment, power
    for (unsigned int node = 0; node < space.n_owned_nodes(); ++node)
      {
        const double fx = f.local_element(dim * node),
                     fy = f.local_element(dim * node + 1);
        resultants[0] += fx;
        resultants[1] += fy;
        resultants[2] += x[node][0] * fy - x[node][1] * fx;
        resultants[3] += fx * v.local_element(dim * node) +
                         fy * v.local_element(dim * node + 1);
      }
    mpi::sum(resultants, comm, resultants);
    print("neither push nor turn",
          std::abs(resultants[0]) + std::abs(resultants[1]) +
              std::abs(resultants[2]) <=
            1e-10 * (1. + largest));
    const double work = ghost.work(v);
    print("work is power",
          work >= 0. &&
            std::abs(work - h * resultants[3]) <= 1e-12 * (1e-12 + work));
    df = 0.;
    ghost.apply_tangent(df, v);
    df -= f;
    print("tangent", df.linfty_norm() <= 1e-14 * (1. + largest));
    Vector diagonal(space.partitioner());
    ghost.add_elastic_diagonal(diagonal);

    // The matrix: its product with v, and its diagonal. Of cells nothing.
    MaterialPoints none;
    none.n_nodes = space.nodes_per_cell();
    if (mpi::n_mpi_processes(comm) > 1)
      return;
    for (const bool one_triangle : {false, true})
      {
        SparseMatrix          matrix;
        const JacobianPattern pattern(none,
                                      unknowns,
                                      comm,
                                      ghost.node_groups(),
                                      {},
                                      one_triangle,
                                      false,
                                      matrix);
        ghost.linearise(pattern, 0., matrix);
        std::vector<double> row_v(matrix.n_rows()),
          product(matrix.n_rows(), 0.);
        for (unsigned int i = 0; i < v.locally_owned_size(); ++i)
          if (unknowns.is_free(i))
            row_v[unknowns.free_row[i]] = v.local_element(i);
        for (int row = 0; row < matrix.n_rows(); ++row)
          for (int k = matrix.row_start[row]; k < matrix.row_start[row + 1];
               ++k)
            {
              const int column = matrix.column[k];
              product[row] += matrix.value[k] * row_v[column];
              if (one_triangle && column != row)
                product[column] += matrix.value[k] * row_v[row];
            }
        double error = 0.;
        for (unsigned int i = 0; i < v.locally_owned_size(); ++i)
          if (unknowns.is_free(i))
            {
              const int row = unknowns.free_row[i];
              error         = std::max({error,
                                        std::abs(product[row] - f.local_element(i)),
                                        std::abs(matrix.value[matrix.entry(row, row)] -
                                         diagonal.local_element(i))});
            }
        print(one_triangle ? "one triangle of the matrix" : "matrix",
              error <= 1e-12 * (1. + largest));
      }
  }

  void
  test(int argc, char **argv)
  {
    mpi::MPI_InitFinalize mpi_init(argc, argv, 1);
    check("B-spline 3", 1.);
    check("B-spline 2", 0.7);
    check("B-spline 3", 5.); // all are full
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace mechanics_ghost_stiffness_01
