// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/parameter_file.h>
#include <geocone/implicit/particle_checks.h>
#include <geocone/scene/drainage.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  void
  check_water_at_rest(const Scene          &scene,
                      const MaterialPoints &points,
                      const MPI_Comm        comm)
  {
    const double weight = scene.water.weight();
    unsigned int is_dry = 0;
    for (unsigned int p = 0; p < points.n_points(); ++p)
      {
        Point<dim> x = points.position[p]; // just below the top of the point
        x[1] += 0.49 * scene.geometry.size_of_point(x, points.volume[p]);
        Tensor<1, dim> other = scene.water.force(x);
        other[1] -= weight;
        if (!(scene.water.pressure(x) > 0.) || other.norm() > 1e-6 * weight)
          is_dry = 1;
      }
    if (Utilities::MPI::max(is_dry, comm) > 0)
      throw InputError(
        Drainage::parameter,
        "true",
        "false with particles and water, unless all soil is below a level "
        "'Water/Table' at the start",
        "raise the table above the soil, give soil its buoyant density "
        "without a table, or set Discretisation/Method = FEM");
  }

  unsigned int
  points_per_direction(const MaterialPoints &points, const MPI_Comm comm)
  {
    unsigned int n = 0;
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      n = std::max(n, points.first_point[c + 1] - points.first_point[c]);
    return std::ceil(std::pow(Utilities::MPI::max(n, comm), 1. / dim) - 1e-6);
  }

  std::string
  check_width_of_body(const BackgroundMesh &mesh,
                      const Space          &space,
                      const unsigned int    k,
                      const MaterialPoints &points)
  {
    const MPI_Comm comm = mesh.triangulation().get_communicator();
    // Least places of cells, and largest ones with the opposite sign.
    std::vector<double> ends(2 * dim, 1e300);
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      {
        const auto place = mesh.place_in_grid(points.cells[c]);
        for (unsigned int d = 0; d < dim; ++d)
          {
            ends[2 * d]     = std::min(ends[2 * d], double(place[d]));
            ends[2 * d + 1] = std::min(ends[2 * d + 1], -double(place[d]));
          }
      }
    Utilities::MPI::min(ends, comm, ends);
    // Gauss points integrate the forces of all functions exactly, until they
    // move; those of files are as they are.
    const bool in_sub_cells =
      ParameterFile::value("Particles/Layout") == "sub-cells";
    std::string warning;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double n      = 1. - ends[2 * d] - ends[2 * d + 1],
                     unseen = n + space.degree() - k * n;
        const std::string what =
          format("across a body %g cell%s wide along %c %s has %g functions, "
                 "more than %g moving particles can tell apart",
                 n,
                 n > 1. ? "s" : "",
                 "xyz"[d],
                 space.element().c_str(),
                 n + space.degree(),
                 k * n);
        const std::string parameter = "Particles/Points per direction",
                          remedy =
                            "take more of them, a lower degree, or smaller "
                            "cells";
        if (unseen > 1.5 && (k > 1 || n < 2.) && in_sub_cells)
          throw InputError(
            parameter,
            k,
            format("at least %g: ", std::ceil((n + space.degree() - 1.) / n)) +
              what + ", so that some have no stiffness",
            remedy);
        if (unseen > 0.5 && k > 1)
          warning = what +
                    (unseen > 1.5 ? ": displacements are wrong as soon as "
                                    "particles have left their places; "
                                  : ": displacements may be off by 2 %; ") +
                    remedy;
      }
    return warning;
  }
} // namespace geocone::GEOCONE_DIM
