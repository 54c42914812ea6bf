// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/lexicographic.h>
#include <geocone/base/log.h>
#include <geocone/mesh/structured_mesh.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;

  namespace
  {
    std::vector<double>
    uniform_coordinates(const double begin, const double end, const double size)
    {
      const int n =
        std::max(1, static_cast<int>(std::lround((end - begin) / size)));
      std::vector<double> x(n + 1);
      for (int i = 0; i <= n; ++i)
        x[i] = begin + (end - begin) * i / n;
      return x;
    }

    /** An interval between two grading points, or between one and the
     *  boundary. */
    struct Piece
    {
      double left, right;
      bool   is_fine_left, is_fine_right;
    };

    std::vector<Piece>
    pieces_between(const double        begin,
                   const double        end,
                   std::vector<double> fine)
    {
      const double tolerance = 1e-9 * (end - begin);
      for (double &x : fine)
        x = std::clamp(x, begin, end);
      std::sort(fine.begin(), fine.end());
      std::vector<double> knots = {begin};
      for (const double x : fine)
        if (x > knots.back() + tolerance)
          knots.push_back(x);
      if (end > knots.back() + tolerance)
        knots.push_back(end);
      const auto is_fine = [&](const double x) {
        return std::any_of(fine.begin(), fine.end(), [&](const double f) {
          return std::abs(f - x) < tolerance;
        });
      };
      std::vector<Piece> pieces;
      for (std::size_t i = 0; i + 1 < knots.size(); ++i)
        pieces.push_back(
          {knots[i], knots[i + 1], is_fine(knots[i]), is_fine(knots[i + 1])});
      return pieces;
    }

    /**
     * Sizes from a fine end over a length: smallest, smallest x growth, ... up
     * to largest, scaled together to fill the length.
     */
    std::vector<double>
    growing_sizes(const double length, const MeshParameters &parameters)
    {
      std::vector<double> sizes;
      double              sum = 0.;
      for (double h = parameters.smallest; sum < length * (1. - 1e-9);
           h        = std::min(h * parameters.growth, parameters.largest))
        {
                 sizes.push_back(h);
                 sum += h;
        }
      for (double &size : sizes)
        size *= length / sum;
      return sizes;
    }

    std::vector<double>
    graded_coordinates(const double               begin,
                       const double               end,
                       const std::vector<double> &fine,
                       const MeshParameters      &parameters)
    {
      std::vector<double> x = {begin};
      for (const auto &[left, right, is_fine_left, is_fine_right] :
           pieces_between(begin, end, fine))
        {
          std::vector<double> sizes;
          if (is_fine_left && is_fine_right)
            {
              const std::vector<double> half =
                growing_sizes((right - left) / 2., parameters);
              sizes = half;
              sizes.insert(sizes.end(), half.rbegin(), half.rend());
            }
          else
            {
              sizes = growing_sizes(right - left, parameters);
              if (is_fine_right)
                std::reverse(sizes.begin(), sizes.end());
            }
          for (const double size : sizes)
            x.push_back(x.back() + size);
          x.back() = right; // exactly: conditions select by coordinate
        }
      return x;
    }

    /** Number of sizes of growing_sizes(), in closed form. */
    double
    number_of_sizes(const double length, const MeshParameters &parameters)
    {
      const double s = parameters.smallest, l = parameters.largest;
      const double d = parameters.growth - 1., log_growth = std::log1p(d);
      const double k    = std::ceil(std::log(l / s) / log_growth);
      const double grow = s * (std::expm1(k * log_growth) / d);
      // The same relative tolerance as in growing_sizes().
      const double L = length * (1. - 1e-9);
      return std::max(1.,
                      grow >= L ? std::ceil(std::log1p(L * d / s) / log_growth)
                                : k + std::ceil((L - grow) / l));
    }

    std::vector<double>
    coordinates_of_grading_points(const MeshParameters &parameters,
                                  const unsigned int    c)
    {
      std::vector<double> x;
      for (const Point<dim> &point : parameters.grading_points)
        x.push_back(point[c]);
      return x;
    }

    /** Lowest and highest corner of the domain. */
    std::pair<Point<dim>, Point<dim>>
    corners(const MeshParameters &parameters)
    {
      return {parameters.outline[0], parameters.outline[dim == 2 ? 2 : 1]};
    }
  } // namespace

  std::array<double, dim>
  grid_size(const MeshParameters &parameters)
  {
    const auto [lower, upper] = corners(parameters);
    std::array<double, dim> n;
    for (unsigned int c = 0; c < dim; ++c)
      if (parameters.type == MeshParameters::Type::graded)
        {
          n[c] = 0.;
          for (const Piece &piece :
               pieces_between(lower[c],
                              upper[c],
                              coordinates_of_grading_points(parameters, c)))
            {
              const double length = piece.right - piece.left;
              n[c] += piece.is_fine_left && piece.is_fine_right
                        ? 2. * number_of_sizes(length / 2., parameters)
                        : number_of_sizes(length, parameters);
            }
        }
      else
        n[c] = std::max(
          1., std::round((upper[c] - lower[c]) / parameters.cell_size));
    return n;
  }

  std::array<std::vector<double>, dim>
  grid_lines(const MeshParameters &parameters)
  {
    const auto [lower, upper] = corners(parameters);
    std::array<std::vector<double>, dim> x;
    for (unsigned int c = 0; c < dim; ++c)
      if (parameters.type == MeshParameters::Type::graded)
        x[c] = graded_coordinates(lower[c],
                                  upper[c],
                                  coordinates_of_grading_points(parameters, c),
                                  parameters);
      else
        x[c] = uniform_coordinates(lower[c], upper[c], parameters.cell_size);
    // Sizes are scaled to fill the length between two grading points.
    const double resolved = resolved_length(parameters.outline);
    for (unsigned int c = 0; c < dim; ++c)
      for (std::size_t i = 0; i + 1 < x[c].size(); ++i)
        if (!(x[c][i + 1] - x[c][i] >= 0.1 * resolved))
          throw InputError(
            "Mesh/Grading points",
            dealii::Patterns::Tools::to_string(parameters.grading_points),
            format("cells of %g m or more at the coordinates of the domain",
                   0.1 * resolved),
            format("there are two lines at %c = %.17g: take one of two points "
                   "that are so close together",
                   coordinate[c],
                   x[c][i]));
    return x;
  }

  CoarseMesh
  structured_mesh(const MeshParameters &parameters)
  {
    const std::array<std::vector<double>, dim> x = grid_lines(parameters);

    CoarseMesh mesh;
    GridIndex  n_vertices, n_cells;
    for (unsigned int c = 0; c < dim; ++c)
      {
        n_vertices[c] = x[c].size();
        n_cells[c]    = n_vertices[c] - 1;
      }
    for (std::size_t i = 0; i < grid_volume(n_vertices); ++i)
      {
        const GridIndex index = index_in_grid(i, n_vertices);
        mesh.points.emplace_back();
        for (unsigned int c = 0; c < dim; ++c)
          mesh.points.back()[c] = x[c][index[c]];
      }

    const auto add_cell = [&](const std::vector<unsigned int> &vertices) {
      dealii::CellData<dim> cell(vertices.size());
      cell.vertices = vertices;
      mesh.cells.push_back(cell);
    };
    if (parameters.cells == MeshParameters::Cells::quadrilaterals)
      {
        mesh.grid = x;
        for (std::size_t i = 0; i < grid_volume(n_cells); ++i)
          {
            const GridIndex           cell = index_in_grid(i, n_cells);
            std::vector<unsigned int> vertices;
            for (unsigned int v = 0; v < (1U << dim); ++v)
              {
                GridIndex corner = cell;
                for (unsigned int c = 0; c < dim; ++c)
                  corner[c] += (v >> c) % 2;
                vertices.push_back(number_in_grid(corner, n_vertices));
              }
            add_cell(vertices);
          }
        return mesh;
      }
    // Triangles in the plane.
    const unsigned int nx = n_cells[0], ny = n_cells[1];
    const bool         crossed =
      parameters.diagonals == MeshParameters::Diagonals::crossed;
    for (unsigned int j = 0; j < ny; ++j)
      for (unsigned int i = 0; i < nx; ++i)
        {
          const unsigned int a = j * (nx + 1) + i, b = a + 1;
          const unsigned int c = a + nx + 1, d = c + 1;
          if (crossed)
            {
              const unsigned int m = mesh.points.size();
              Point<dim>         middle;
              middle[0] = (x[0][i] + x[0][i + 1]) / 2.;
              middle[1] = (x[1][j] + x[1][j + 1]) / 2.;
              mesh.points.push_back(middle);
              add_cell({a, b, m});
              add_cell({b, d, m});
              add_cell({d, c, m});
              add_cell({c, a, m});
            }
          else if (parameters.diagonals ==
                     MeshParameters::Diagonals::parallel ||
                   (i + j) % 2 == 0)
            {
              add_cell({a, b, d});
              add_cell({a, d, c});
            }
          else
            {
              add_cell({a, b, c});
              add_cell({b, d, c});
            }
        }
    return mesh;
  }
} // namespace geocone::GEOCONE_DIM
