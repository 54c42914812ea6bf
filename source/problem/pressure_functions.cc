// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/points/point_elasticity.h>
#include <geocone/points/quadrature_points.h>
#include <geocone/problem/pressure_functions.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** Linear shape functions of the vertices of a cell and their gradients in
     *  unit coordinates. */
    struct VertexFunctions
    {
      std::vector<double>         value;
      std::vector<Tensor<1, dim>> gradient;
    };

    VertexFunctions
    vertex_functions(const bool simplicial, const Point<dim> &unit)
    {
      const double x = unit[0], y = unit[1];
      const auto   vector = [](const double a, const double b) {
        return Tensor<1, dim>({a, b});
      };
      if (simplicial)
        return {{1. - x - y, x, y},
                {vector(-1., -1.), vector(1., 0.), vector(0., 1.)}};
      return {{(1. - x) * (1. - y), x * (1. - y), (1. - x) * y, x * y},
              {vector(y - 1., x - 1.),
               vector(1. - y, -x),
               vector(-y, 1. - x),
               vector(y, x)}};
    }

    /** Mobility k/gamma of each material (m^2/(Pa s)).
     *  @throws InputError for a material without pore fluid or permeability */
    std::vector<SymmetricTensor<2, dim>>
    mobilities(const Scene &scene)
    {
      std::vector<SymmetricTensor<2, dim>> all;
      for (unsigned int m = 0; m < scene.materials.size(); ++m)
        {
          const ConstitutiveLaw &law = scene.materials.law(m);
          if (!(law.fluid_modulus() > 0.))
            throw InputError("Materials/" + scene.materials.name(m) +
                               "/Pore fluid bulk modulus",
                             law.fluid_modulus(),
                             "> 0 Pa with 'Time stepping/Consolidation'",
                             "water has 2.2 GPa; divide it by the porosity");
          all.push_back(law.permeability() / scene.water.weight());
        }
      return all;
    }

    /** Pressures without flow. */
    PressureFunctions
    empty_pressures(const BackgroundMesh &mesh,
                    const Space          &space,
                    const MaterialPoints &points)
    {
      PressureFunctions  all;
      const unsigned int n = all.n_vertices = mesh.is_simplicial() ? 3 : 4;
      all.flow.assign(n * n * points.n_cells(), 0.);
      all.is_drained.assign(space.n_local_nodes(), false);
      for (unsigned int c = 0; c < points.n_cells(); ++c)
        {
          std::array<unsigned int, 4> node = {{0, 1, 2, 3}};
          if (space.is_spline())
            {
              const unsigned int p     = space.degree();
              const auto         place = mesh.place_in_grid(points.cells[c]);
              std::array<unsigned int, dim> step; // to the next vertex
              for (unsigned int d = 0; d < dim; ++d)
                {
                  const SplineBasis &basis = space.splines_along(d);
                  step[d]                  = place[d] + 1 == basis.n_intervals()
                                               ? 1
                                               : basis.n_leaving(place[d]);
                }
              for (unsigned int i = 0; i < 4; ++i)
                node[i] = i % 2 * step[0] + i / 2 * step[1] * (p + 1);
            }
          for (unsigned int i = 0; i < n; ++i)
            all.nodes.push_back(points.nodes[c * points.n_nodes + node[i]]);
        }
      return all;
    }

    /** Adds weight grad N' K grad N to the matrix of a cell, with the gradients
     *  in unit coordinates. */
    void
    add_flow(const double                       weight,
             const SymmetricTensor<2, dim>     &K,
             const std::vector<Tensor<1, dim>> &unit_gradients,
             const Tensor<2, dim>              &to_unit,
             double                            *matrix)
    {
      const unsigned int            n = unit_gradients.size();
      std::array<Tensor<1, dim>, 4> gradient;
      for (unsigned int i = 0; i < n; ++i)
        gradient[i] = unit_gradients[i] * to_unit;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          matrix[n * i + j] += weight * (gradient[i] * (K * gradient[j]));
    }

    /** Rectangular cell of a grid that particles fill wholly or in part, seen
     *  from a surface where p = 0. */
    struct FilledCell
    {
      /** @param volume of its particles */
      FilledCell(const BackgroundMesh       &mesh,
                 const BackgroundMesh::Cell &cell,
                 const double                volume,
                 const std::vector<bool>    &has_points,
                 const DrainedAt            &is_drained)
        : mesh(mesh)
        , cell(cell)
      {
        std::array<bool, 2 * dim> ends{}; // where the soil ends in the mesh
        for (const unsigned int f : cell->face_indices())
          if (const auto face = cell->face(f); face->at_boundary())
            is_open[f] = is_drained(face->boundary_id(), face->center());
          else
            is_open[f] = ends[f] =
              !has_points[cell->neighbor(f)->active_cell_index()];
        const double fill =
          std::clamp(volume / (cell->measure() * mesh.measure(cell->center())),
                     least_fill,
                     1.);
        const auto ends_at_one_face = [&](const unsigned int d) {
          return ends[2 * d] != ends[2 * d + 1];
        };
        const double n = int(ends_at_one_face(0)) + int(ends_at_one_face(1));
        for (unsigned int d = 0; d < dim; ++d)
          if (ends_at_one_face(d))
            {
              filled[d]     = std::pow(fill, 1. / n);
              from_above[d] = ends[2 * d];
            }
      }

      /** Coordinates of a place in the filled part, from 0 to 1. */
      Point<dim>
      in_filled_part(Point<dim> unit) const
      {
        for (unsigned int d = 0; d < dim; ++d)
          unit[d] = from_above[d]
                      ? std::max(0., 1. - (1. - unit[d]) / filled[d])
                      : std::min(1., unit[d] / filled[d]);
        return unit;
      }

      /** Adds the flow through the filled part and out of its open faces to the
       *  matrix of the cell. @param K mobility */
      void
      add_flow_to(const SymmetricTensor<2, dim> &K, double *matrix) const
      {
        constexpr unsigned int n = 4;
        Tensor<2, dim>         stretch; // of the gradients
        for (unsigned int d = 0; d < dim; ++d)
          {
            const int n_open = int(is_open[2 * d]) + int(is_open[2 * d + 1]);
            stretch[d][d] =
              1. / std::sqrt(filled[d] * (filled[d] - n_open / outflow));
          }
        const QGauss<dim> quadrature(2);
        for (unsigned int q = 0; q < quadrature.size(); ++q)
          {
            const Point<dim>    &unit    = quadrature.point(q);
            const Tensor<2, dim> to_unit = mesh.inverse_jacobian(cell, unit);
            const double         radius  = mesh.measure(
              mesh.mapping().transform_unit_to_real_cell(cell, unit));
            add_flow(quadrature.weight(q) / determinant(to_unit) * radius *
                       filled[0] * filled[1],
                     K,
                     vertex_functions(false, unit).gradient,
                     stretch * to_unit,
                     matrix);
          }
        const auto box = cell->bounding_box();
        for (const unsigned int f : cell->face_indices())
          if (is_open[f])
            {
              const unsigned int d = f / 2, along = 1 - d;
              const double       out = outflow * K[d][d] / box.side_length(d) *
                                 filled[along] * box.side_length(along);
              // Integral of the vertex function over the face, linear in the measure.
              for (unsigned int i = 0; i < n; ++i)
                if ((d == 0 ? i % 2 : i / 2) == f % 2)
                  matrix[(n + 1) * i] +=
                    out / 6. *
                    (mesh.measure(cell->vertex(i)) +
                     2. * mesh.measure(cell->face(f)->center()));
            }
      }

    private:
      /** Outflow per area through open faces, in (k/gamma) p/(size of the cell);
       *  least part of a cell that counts as filled. */
      static constexpr double outflow = 20., least_fill = 0.2;

      const BackgroundMesh       &mesh;
      const BackgroundMesh::Cell &cell;
      std::array<bool, 2 * dim>   is_open{}; ///< faces with p = 0
      std::array<double, dim>     filled = {{1., 1.}};
      std::array<bool, dim>       from_above{}; ///< filled from unit = 1
    };
  } // namespace

  PressureFunctions
  pressures_of_elements(const Scene          &scene,
                        const BackgroundMesh &mesh,
                        const Space          &space,
                        const MaterialPoints &points,
                        std::vector<bool>     is_drained)
  {
    PressureFunctions            all = empty_pressures(mesh, space, points);
    const auto                   mobility   = mobilities(scene);
    const Quadrature<dim>        quadrature = stress_quadrature(space, mesh);
    std::vector<VertexFunctions> functions;
    for (const Point<dim> &unit : quadrature.get_points())
      functions.push_back(vertex_functions(mesh.is_simplicial(), unit));
    const unsigned int n = all.n_vertices;
    const double       slowest =
      (mesh.is_simplicial() ? 8. : 4.) * numbers::PI * numbers::PI;
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      for (unsigned int q = 0; q < quadrature.size(); ++q)
        {
          const unsigned int   p = points.first_point[c] + q;
          const Tensor<2, dim> to_unit =
            mesh.inverse_jacobian(points.cells[c], quadrature.point(q));
          const auto &K = mobility[points.material[p]];
          // Without B-bar quadrilaterals would lock within cells.
          if (mesh.is_simplicial() || space.has_b_bar())
            all.leakage.push_back(slowest * trace(to_unit * Tensor<2, dim>(K) *
                                                  transpose(to_unit)));
          all.N.insert(
            all.N.end(), functions[q].value.begin(), functions[q].value.end());
          add_flow(points.weight[p],
                   K,
                   functions[q].gradient,
                   to_unit,
                   &all.flow[n * n * c]);
        }
    all.is_drained = std::move(is_drained);
    return all;
  }

  PressureFunctions
  pressures_of_particles(const Scene          &scene,
                         const BackgroundMesh &mesh,
                         const Space          &space,
                         const MaterialPoints &points,
                         const DrainedAt      &is_drained)
  {
    PressureFunctions       all        = empty_pressures(mesh, space, points);
    const auto              mobility   = mobilities(scene);
    const std::vector<bool> has_points = mesh.marked_cells(points.cells);
    const unsigned int      n          = all.n_vertices;
    constexpr double        beta       = 0.5;
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      {
        const unsigned int begin       = points.first_point[c],
                           end         = points.first_point[c + 1];
        double                  volume = 0., compliance = 0.;
        SymmetricTensor<2, dim> K;
        for (unsigned int p = begin; p < end; ++p)
          {
            const double V = points.volume[p];
            volume += V;
            K += V * mobility[points.material[p]];
            compliance +=
              V / elasticity_at_start(scene.materials, points, p).two_G;
          }
        const FilledCell cell(
          mesh, points.cells[c], volume, has_points, is_drained);
        cell.add_flow_to(K / volume, &all.flow[n * n * c]);
        for (unsigned int p = begin; p < end; ++p)
          for (const double N :
               vertex_functions(false, cell.in_filled_part(points.unit[p]))
                 .value)
            all.N.push_back(N);
        // The integrals of products of bilinear functions and of means, per area.
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            all.smoothing.push_back(beta * compliance *
                                    ((i == j       ? 4.
                                      : i + j == 3 ? 1.
                                                   : 2.) /
                                       36. -
                                     1. / 16.));
      }
    return all;
  }
} // namespace geocone::GEOCONE_DIM
