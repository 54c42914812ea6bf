// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/resources.h>
#include <geocone/run/run_estimate.h>
#include <geocone/space/space.h>

#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    std::string
    number(const double x)
    {
      return x < 1e4   ? format("%.0f", x)
             : x < 1e6 ? format("%.3g thousand", x / 1e3)
             : x < 1e9 ? format("%.3g million", x / 1e6)
                       : format("%.2g", x);
    }

    std::string
    size(const double bytes)
    {
      return bytes < 1e9    ? format("%.0f MB", std::ceil(bytes / 1e6))
             : bytes < 1e15 ? format("%.3g GB", bytes / 1e9)
                            : format("%.2g GB", bytes / 1e9);
    }
  } // namespace

  std::string
  RunEstimate::text() const
  {
    return "about " + number(cells) + " cells, " + number(unknowns) +
           " unknowns, " + number(points) + " points, " + number(steps) +
           " steps, " + size(memory) + " of memory, " +
           (files > 0.
              ? number(files) + " files of fields (" + size(file_bytes) + ")"
              : "no fields");
  }

  void
  RunEstimate::check(const bool force) const
  {
    constexpr double largest_integer = std::numeric_limits<int>::max();
    const auto       refuse          = [&](const std::string &allowed,
                            const std::string &remedy) {
      throw InputError(driver,
                       ParameterFile::value(driver),
                       allowed,
                       "the run would have " + text() + ": " + remedy);
    };
    for (const double n : {cells, unknowns, points})
      if (!(n < largest_integer))
        refuse("what gives fewer than 2^31 cells, unknowns and points",
               "make it coarser");
    const double available = 1048576. * available_memory();
    if (!force && memory > available)
      refuse("what fits into the " + size(available) +
               " of memory that are free",
             "make it coarser, or call geocone with --force");
  }

  namespace
  {
    /** Numbers of nodes, basis functions and points per cell. */
    struct CellCounts
    {
      unsigned int degree;
      bool         is_spline;
      double       nodes, functions, points; ///< `points` for FEM only
    };

    CellCounts
    counts_of_cell(const BackgroundMesh::Expected &expected,
                   const Method                   &method)
    {
      std::string element = ParameterFile::value("Discretisation/Element");
      if (element == "automatic")
        // Whether friction has a memory is unknown before the mesh exists: P3 is the
        // more expensive choice.
        element = Space::automatic_element(
          expected.is_simplicial, expected.is_grid, method, false);
      const bool         spline = element[0] == 'B';
      const unsigned int p      = element.back() - '0';
      // For triangles and tetrahedra, by Euler's formula and typical meshes.
      const double of_simplex     = dim == 2 ? (p == 1   ? 0.5
                                                : p == 2 ? 2.
                                                         : 4.5)
                                             : (p == 1 ? 0.2 : 1.4);
      const double nodes_per_cell = expected.is_simplicial ? of_simplex
                                    : spline               ? 1.
                                                           : std::pow(p, dim);
      double       functions =
        expected.is_simplicial ? (p + 1) * (p + 2) / 2. : std::pow(p + 1., dim);
      if (dim == 3 && expected.is_simplicial)
        functions *= (p + 3) / 3.;
      const double points = !expected.is_simplicial ? std::pow(p + 1., dim)
                            : p == 1                ? 1.
                            : p == 2                ? 6.
                                                    : 7.;
      return {p, spline, nodes_per_cell, functions, points};
    }

    /** Memory of the points and of the nodes in implicit steps (bytes). */
    std::pair<double, double>
    memory_of_implicit(const RunEstimate &e,
                       const CellCounts  &of_cell,
                       const bool         has_p_multigrid)
    {
      // Columns per row: the functions that overlap a function's support.
      const double row =
        dim * (of_cell.is_spline ? std::pow(2. * of_cell.degree + 1., dim)
                                 : 3.5 * of_cell.functions);
      if (has_p_multigrid)
        return {e.points * (600. + 30. * of_cell.functions),
                e.unknowns * (1000. + 14. * row)};
      // In three dimensions fill-in grows as n^(4/3).
      const double filled = dim == 3 ? 60. * std::pow(e.unknowns, 4. / 3.) : 0.;
      return {e.points * (1000. + 100. * of_cell.functions),
              e.unknowns * (1500. + 60. * row) + filled};
    }
  } // namespace

  RunEstimate
  estimate_run(const Scene                  &scene,
               const Method                 &method,
               BackgroundMesh               &mesh,
               Seeding                      *seeding,
               const FieldsAsked            &fields,
               const LinearSolverParameters *linear_solver)
  {
    RunEstimate e;
    if (seeding != nullptr)
      seeding->prepare(scene);
    const BackgroundMesh::Expected expected = mesh.expect(scene, method);
    e.cells                                 = expected.n_cells;
    e.driver                                = expected.parameter;

    const CellCounts   of_cell = counts_of_cell(expected, method);
    const unsigned int p       = of_cell.degree;
    double             nodes   = e.cells * of_cell.nodes;
    e.unknowns                 = dim * nodes;
    e.points = seeding != nullptr ? seeding->expected_number(scene, expected)
                                  : e.cells * of_cell.points;
    if (seeding != nullptr) // each body of particles adds a layer of the mesh
      for (double *number : {&e.cells, &e.unknowns, &nodes})
        *number *= scene.contacts.n_bodies();
    double outputs = seeding != nullptr ? 1. : 0.;
    for (const auto &stage : scene.loading.list)
      {
        const double n = stage->expected_steps();
        e.steps += n;
        outputs +=
          stage->output_every > 0 ? std::ceil(n / stage->output_every) : 1.;
      }

    e.memory         = method.is_explicit() ? 80e6 : 160e6;
    double of_points = 280. * e.points, of_nodes = 200. * nodes;
    if (!method.is_explicit())
      std::tie(of_points, of_nodes) = memory_of_implicit(
        e,
        of_cell,
        linear_solver != nullptr && p > 1 && !method.is_mpm() &&
          linear_solver->selects_p_multigrid(
            dim == 3 && scene.obstacles.list.empty() ? e.unknowns : 0));
    e.memory += of_points + of_nodes;
    if (seeding != nullptr && of_points > of_nodes &&
        !seeding->size_parameter().empty())
      e.driver = seeding->size_parameter();
    if (fields.are_written)
      {
        e.files =
          outputs * fields.n_formats *
          ((method.is_explicit() ? 1 : 2) + !scene.obstacles.list.empty());
        e.file_bytes =
          outputs * fields.n_formats *
          (60. * e.points +
           (method.is_explicit()
              ? 0.
              : 60. * e.cells * std::pow(p, dim) *
                  (expected.is_simplicial ? dim + 1. : std::pow(2., dim))));
      }
    return e;
  }
} // namespace geocone::GEOCONE_DIM
