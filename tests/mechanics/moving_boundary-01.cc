// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Sums over the points of a line must be the integrals over its part in the
// mesh: of polynomials, and of products of the functions, also where the line
// runs between cells, through vertices, or leaves the mesh. Sides of a body must
// become lines with the body to the left.

#include <geocone/base/exceptions.h>
#include <geocone/surfaces/moving_surface.h>
#include <geocone/surfaces/sides_of_body.h>

#include "../discretisation/setup.h"
#include "../test.h"

#include <cmath>

namespace mechanics_moving_boundary_01
{
  using namespace discretisation_tests;
  using namespace geocone;
  using dealii::Point;

  /** int_from^to (s x + t y)^k along a + r (b - a) with respect to r. */
  double
  integral(const unsigned int k,
           const Point<dim>  &a,
           const Point<dim>  &b,
           const double       from,
           const double       to)
  {
    const auto f = [](const Point<dim> &x) { return 0.7 * x[0] - 0.4 * x[1]; };
    const double c = f(a), d = f(b) - f(a);
    double       sum = 0., binomial = 1.;
    for (unsigned int j = 0; j <= k; ++j)
      {
        sum += binomial * std::pow(c, k - j) * std::pow(d, j) *
               (std::pow(to, j + 1) - std::pow(from, j + 1)) / (j + 1);
        binomial *= double(k - j) / (j + 1);
      }
    return sum;
  }

  /** @param from, to the part of the line that lies in the mesh */
  void
  check(const Setup      &setup,
        const char       *name,
        const Point<dim> &a,
        const Point<dim> &b,
        const double      from,
        const double      to)
  {
    const auto points  = points_on(setup.mesh, setup.space, {{a, b}});
    double     sums[7] = {}, N = 0., linear = 0., on_line = 0.;
    for (const BoundaryPoint &p : points)
      {
        const double f = 0.7 * p.position[0] - 0.4 * p.position[1];
        for (unsigned int k = 0; k < 7; ++k)
          sums[k] += p.weight * std::pow(f, k);
        double     sum = 0.;
        Point<dim> x;
        for (unsigned int i = 0; i < p.nodes.size(); ++i)
          {
            sum += p.values[i];
            x +=
              p.values[i] *
              setup.space.node_positions()[setup.space.local_node(p.nodes[i])];
          }
        N += p.weight * sum;
        linear  = std::max(linear, x.distance(p.position));
        on_line = std::max(on_line, distance_to_segment(p.position, a, b));
      }
    if (speaks())
      std::printf("%s\n", name);
    double error = 0.;
    for (unsigned int k = 0; k < 7; ++k)
      error = std::max(
        error, std::abs(mpi::sum(sums[k], comm) - integral(k, a, b, from, to)));
    const double weights = mpi::sum(sums[0], comm);
    N                    = mpi::sum(N, comm);
    if (speaks())
      std::printf("  sum of weights %.6f\n", weights);
    print("polynomials up to degree 6 exact", error < 1e-8);
    print("functions sum up to the weights", std::abs(N - weights) < 1e-12);
    print("and belong to the places", linear < 1e-10);
    print("places on the line", on_line < 1e-8);
  }

  /** The integral of the square of some field over a line (m). */
  double
  energy(const Setup &setup, const Point<dim> &a, const Point<dim> &b)
  {
    double sum = 0.;
    for (const BoundaryPoint &p : points_on(setup.mesh, setup.space, {{a, b}}))
      {
        double u = 0.;
        for (unsigned int i = 0; i < p.nodes.size(); ++i)
          {
            const Point<dim> &x =
              setup.space.node_positions()[setup.space.local_node(p.nodes[i])];
            u += p.values[i] * std::sin(3. * x[0] + 5. * x[1] * x[1]);
          }
        sum += p.weight * u * u;
      }
    return a.distance(b) * mpi::sum(sum, comm);
  }

  void
  check_mesh(const std::string &name, const std::vector<std::string> &overrides)
  {
    Setup setup("discretisation/box.prm", overrides);
    setup.prepare();
    if (speaks())
      std::printf("== %s\n", name.c_str());
    const auto test = [&](const char       *text,
                          const Point<dim> &a,
                          const Point<dim> &b,
                          const double      from = 0.,
                          const double      to   = 1.) {
      check(setup, text, a, b, from, to);
    };
    test("inside one cell", {0.3, 0.3}, {0.4, 0.35});
    test("diagonal", {0.1, 0.1}, {1.1, 1.1});
    test("diagonal, backwards", {1.1, 1.1}, {0.1, 0.1});
    test("through many cells", {0.07, 0.93}, {1.13, 0.21});
    test("horizontal on a grid line", {0.1, 0.5}, {1.15, 0.5});
    test("horizontal on a grid line, backwards", {1.15, 0.5}, {0.1, 0.5});
    test("vertical on a grid line", {0.75, 0.02}, {0.75, 0.97});
    test("from vertex to vertex", {0.25, 0.25}, {0.75, 0.25});
    test("on the border, mesh to the left", {0., 0.}, {1., 0.});
    test("leaving the mesh", {0.5, 0.5}, {-0.5, 0.5}, 0., 0.5);
    test("across the corner of the mesh",
         {-0.1, 0.2},
         {0.2, -0.1},
         1. / 3.,
         2. / 3.);
    test("outside", {-0.1, -0.2}, {1., -0.2}, 0., 0.);

    const Point<dim> a(0.07, 0.93), b(1.13, 0.21), m = a + 0.37 * (b - a);
    const double     whole = energy(setup, a, b);
    print("squares of fields do not depend on the direction",
          std::abs(whole - energy(setup, b, a)) < 1e-7);
    print("nor on cuts",
          std::abs(whole - energy(setup, a, m) - energy(setup, m, b)) < 1e-7);
  }

  /** The lines of the condition "top" of the body. */
  void
  check_lines(const std::string              &name,
              const std::vector<std::string> &overrides,
              const double                    longest)
  {
    Setup setup("discretisation/box.prm", overrides);
    setup.prepare();
    if (speaks())
      std::printf("%s\n", name.c_str());
    try
      {
        const MovingSurface surface(
          segments_of_body(*setup.scene.dirichlet.list[2],
                           setup.scene.geometry),
          longest);
        const std::vector<SidePart> lines  = surface.facets();
        double                      length = 0., covered = 0.;
        bool                        left = true, chain = true;
        for (std::size_t i = 0; i < lines.size(); ++i)
          {
            const Point<dim> &a = lines[i].corners[0], &b = lines[i].corners[1];
            const double      size = surface.size_at_start(i);
            length += size;
            chain &= std::abs(size - a.distance(b)) < 1e-12 &&
                     size <= longest * (1. + 1e-8);
            const dealii::Tensor<1, dim> along = b - a;
            left &= setup.scene.geometry.contains(
              a + 0.5 * along +
              1e-3 * dealii::Tensor<1, dim>({-along[1], along[0]}));
            for (const auto &p : points_on(setup.mesh, setup.space, lines[i]))
              covered += p.weight * size;
          }
        covered = mpi::sum(covered, comm);
        if (speaks())
          {
            std::printf("  %zu lines of %.6f m, of which %.6f m in the mesh\n",
                        lines.size(),
                        length,
                        covered);
            const Point<dim> first = lines.front().corners[0],
                             last  = lines.back().corners[1];
            std::printf("  from %.4f %.4f to %.4f %.4f\n",
                        first[0],
                        first[1],
                        last[0],
                        last[1]);
          }
        print("the body lies to the left", left);
        print("lengths are right", chain);
      }
    catch (const InputError &error)
      {
        if (speaks())
          std::printf("  %s\n", error.what());
      }
  }

  void
  test(int argc, char **argv)
  {
    dealii::Utilities::MPI::MPI_InitFinalize mpi_session(argc, argv, 1);
    for (const std::string element : {"Q1", "Q3", "B-spline 2", "B-spline 3"})
      check_mesh(element, {"Discretisation/Element = " + element});

    const std::string sides = "Boundary conditions/top/Sides = ",
                      box   = "Boundary conditions/top/Box = ",
                      shape = "Geometry/Shape = polygon",
                      house = "Geometry/Polygon = 0, 0; 1, 0; 1, 0.5; 0.5, 1; "
                              "0, 0.5",
                      back = "Geometry/Polygon = 0, 0; 0, 0.5; 0.5, 1; 1, 0.5; "
                             "1, 0";
    check_lines("top of the box", {}, 9.);
    check_lines("top of the box, cut", {}, 0.3);
    check_lines("a part of it", {box + "0.2, 0.9; 0.6, 2"}, 9.);
    check_lines("a part of it, cut", {box + "0.2, 0.9; 0.6, 2"}, 0.1);
    check_lines("two sides", {sides + "top, left"}, 9.);
    check_lines("all sides", {sides + "all"}, 0.25);
    check_lines("a roof", {shape, house, sides + "2, 3"}, 0.25);
    check_lines("a roof, clockwise", {shape, back, sides + "1, 2"}, 0.25);
    check_lines("no side of the body", {shape, house}, 9.);
    check_lines("box without a side", {box + "0.2, 0.3; 0.6, 0.7"}, 9.);
    check_lines("no outline",
                {"Geometry/Shape = discs",
                 "Geometry/Centres = 0.5, 0.5",
                 "Geometry/Radii = 0.4"},
                9.);
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace mechanics_moving_boundary_01
