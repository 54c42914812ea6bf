// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/discretisation/coarse_mesh.h>

#include <deal.II/grid/reference_cell.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace geocone
{
  using dealii::Point;

  bool
  CoarseMesh::has_simplices() const
  {
    return std::any_of(cells.begin(), cells.end(), [](const auto &cell) {
      return cell.vertices.size() == dim + 1;
    });
  }

  Point<dim>
  CoarseMesh::centre(const dealii::CellData<dim> &cell) const
  {
    Point<dim> sum;
    for (const unsigned int v : cell.vertices)
      sum += points[v];
    return sum / double(cell.vertices.size());
  }

  std::vector<CoarseMesh::Face>
  CoarseMesh::outer_faces() const
  {
    const auto sorted = [](Face face) {
      std::sort(face.begin(), face.end());
      return face;
    };
    // By their sorted vertices, which neighbours share.
    std::vector<std::pair<Face, Face>> faces;
    for (const auto &cell : cells)
      {
        const auto reference =
          dealii::ReferenceCell::n_vertices_to_type(dim, cell.vertices.size());
        for (const unsigned int f : reference.face_indices())
          {
            Face face;
            face.fill(no_vertex);
            for (unsigned int i = 0;
                 i < reference.face_reference_cell(f).n_vertices();
                 ++i)
              face[i] =
                cell.vertices[reference.face_to_cell_vertices(f, i, true)];
            faces.emplace_back(sorted(face), dim == 2 ? sorted(face) : face);
          }
      }
    std::sort(faces.begin(), faces.end());
    std::vector<Face> outer;
    for (std::size_t i = 0, j; i < faces.size(); i = j)
      {
        for (j = i; j < faces.size() && faces[j].first == faces[i].first;)
          ++j;
        if (j == i + 1)
          outer.push_back(faces[i].second);
      }
    return outer;
  }

  Point<dim>
  CoarseMesh::centre(const Face &face) const
  {
    Point<dim>   sum;
    unsigned int n = 0;
    for (const unsigned int v : face)
      if (v != no_vertex)
        {
          sum += points[v];
          ++n;
        }
    return sum / double(n);
  }

  void
  CoarseMesh::add_boundary(const Face                      &face,
                           const dealii::types::boundary_id side)
  {
    if constexpr (dim == 2)
      {
        dealii::CellData<1> line(2);
        line.vertices    = {face[0], face[1]};
        line.boundary_id = side;
        boundary.boundary_lines.push_back(line);
      }
    else
      {
        dealii::CellData<2> quad(face.back() == no_vertex ? 3 : 4);
        std::copy_n(face.begin(), quad.vertices.size(), quad.vertices.begin());
        quad.boundary_id = side;
        boundary.boundary_quads.push_back(quad);
      }
  }

  MeshParameters::MeshParameters()
    : dealii::ParameterAcceptor("/Mesh")
  {
    type.declare(*this,
                 "Type",
                 ". The first two are for boxes, the others are made by gmsh, "
                 "the last one with sizes that a limit analysis of the scene "
                 "asks for. Not used where the domain is a .msh file.");
    add_parameter("Box",
                  box,
                  "MPM: lower left and upper right corner x, y; x, y (m) of "
                  "the background mesh; empty: the smallest box around the "
                  "body, or the body itself for an unstructured mesh. Leave "
                  "room for what moves out of it. An unstructured mesh has "
                  "edges on the border of the body.");
    cells.declare(*this,
                  "Cells",
                  dim == 2
                    ? ". Automatic: triangles for FEM, quadrilaterals for MPM."
                    : ". Boxes have hexahedra; files what they hold.");
    diagonals.declare(
      *this,
      "Diagonals",
      ": how the rectangles of a uniform or graded mesh are cut into "
      "triangles, two by alternating or parallel diagonals, four by crossed "
      "ones.");
    add_parameter("Cell size",
                  cell_size,
                  "Side of the squares of a uniform mesh (m); it is rounded to "
                  "a whole number of cells.");
    add_parameter("Grading points",
                  grading_points,
                  "Points x, y; x, y; ... (m) around which graded and "
                  "unstructured meshes are fine. Each becomes a vertex.");
    add_parameter(
      "Smallest size", smallest, "Cell size at the grading points (m).");
    add_parameter("Largest size", largest, "Largest cell size (m).");
    add_parameter("Growth factor",
                  growth,
                  "Graded meshes: ratio of a cell to its smaller neighbour, "
                  "> 1.");
    add_parameter("Size ratio",
                  size_ratio,
                  "Unstructured meshes: cell size over distance to the nearest "
                  "grading point, > 0.");
    add_parameter("Number of cells",
                  number,
                  "From the bounds: the mesh has about so many triangles.");
    add_parameter("Gmsh algorithm",
                  algorithm,
                  "gmsh's number of the 2D algorithm: 5 Delaunay, 6 "
                  "frontal-Delaunay, 1 MeshAdapt, 8 frontal for "
                  "quadrilaterals.");
  }

  void
  MeshParameters::choose_outline(const Geometry &geometry, const Method &method)
  {
    fits_body = !method.is_mpm() || (is_unstructured() && box.empty() &&
                                     geometry.shape != Geometry::Shape::discs);
    if (fits_body)
      {
        outline = geometry.outline;
        return;
      }
    if (is_unstructured())
      body = geometry.outline;
    const auto [lower, upper] = geometry.bounding_box();
    if (box.empty())
      box = {lower, upper};
    if (box.size() == 2)
      check_coordinates(box, "Mesh/Box");
    const double tolerance = 1e-9 * lower.distance(upper);
    if (box.size() != 2 || box[0][0] > lower[0] + tolerance ||
        box[0][1] > lower[1] + tolerance || box[1][0] < upper[0] - tolerance ||
        box[1][1] < upper[1] - tolerance)
      throw InputError("Mesh/Box",
                       dealii::Patterns::Tools::to_string(box),
                       "lower left; upper right corner of a box around the "
                       "body",
                       "the body reaches from " +
                         dealii::Patterns::Tools::to_string(lower) + " to " +
                         dealii::Patterns::Tools::to_string(upper));
    outline = outline_of_box(box[0], box[1]);
  }

  void
  MeshParameters::prepare(const Geometry &geometry, const Method &method)
  {
    const auto positive = [](const std::string &entry, const double value) {
      if (!(value > 0.))
        throw InputError("Mesh/" + entry, value, "> 0", "give it in m");
    };
    if (type == Type::from_bounds)
      {
        if (geometry.outline.empty() || method.is_explicit() ||
            (method.is_mpm() && !box.empty()))
          throw InputError("Mesh/Type",
                           type.word(),
                           "a mesh of the body, a box or a polygon, for FEM "
                           "and implicit MPM without Mesh/Box",
                           "set Mesh/Type = unstructured");
        if (cells == Cells::quadrilaterals)
          throw InputError("Mesh/Cells",
                           cells.word(),
                           "triangles where the mesh is from the bounds",
                           "set Mesh/Cells = triangles");
        if (number < 20 || number > 200000)
          throw InputError(
            "Mesh/Number of cells", number, "20 to 200000", "1500 are usual");
        cells = Cells::triangles;
      }
    if (dim == 3 && geometry.shape != Geometry::Shape::file)
      {
        const Cells only =
          is_unstructured() ? Cells::triangles : Cells::quadrilaterals;
        if (cells != Cells::automatic && cells != only)
          throw InputError(
            "Mesh/Cells",
            cells.word(),
            "automatic: tetrahedra for Mesh/Type = unstructured, "
            "hexahedra for the others",
            "set Mesh/Cells = automatic");
        cells = only;
      }
    if (cells == Cells::automatic)
      cells = method.is_mpm() ? Cells::quadrilaterals : Cells::triangles;
    positive("Cell size", cell_size);
    positive("Smallest size", smallest);
    positive("Largest size", largest);
    positive("Size ratio", size_ratio);
    if (largest < smallest)
      throw InputError("Mesh/Largest size",
                       largest,
                       ">= the smallest size",
                       "exchange the two");
    if (type == Type::graded && !(growth > 1.))
      throw InputError("Mesh/Growth factor",
                       growth,
                       "> 1",
                       "1.3 is usual; for equal cells take a uniform mesh");
    if (geometry.shape == Geometry::Shape::discs && !method.is_mpm())
      throw InputError("Geometry/Shape",
                       "discs",
                       "box | polygon | file with FEM",
                       "set Discretisation/Method = MPM, or mesh the discs "
                       "with gmsh");
    if (!method.is_mpm())
      geometry.refuse_where("FEM",
                            "set Discretisation/Method = MPM, or mesh the body "
                            "with gmsh");
    if (geometry.shape != Geometry::Shape::file)
      choose_outline(geometry, method);
    if (!is_unstructured() && !method.is_mpm() &&
        geometry.shape == Geometry::Shape::polygon)
      throw InputError("Mesh/Type",
                       type.word(),
                       "unstructured, where the domain is a polygon",
                       "set Mesh/Type = unstructured");
    if (type == Type::graded && grading_points.empty())
      throw InputError("Mesh/Grading points",
                       "",
                       "one or more points for a graded mesh",
                       "give e.g. the edge of the footing: 0.1, 0");
    if (geometry.shape != Geometry::Shape::file)
      for (const Point<dim> &x : grading_points)
        {
          double distance = 1e300;
          for (std::size_t i = 0; i < outline.size() && dim == 2; ++i)
            distance =
              std::min(distance,
                       distance_to_segment(
                         x, outline[i], outline[(i + 1) % outline.size()]));
          if (distance > 1e-9 && !contains(outline, x))
            throw InputError("Mesh/Grading points",
                             dealii::Patterns::Tools::to_string(x),
                             "points of the domain",
                             "move it into the domain or onto its border");
        }
    if (geometry.shape != Geometry::Shape::file)
      check_sizes();
  }

  void
  MeshParameters::check_sizes() const
  {
    const double resolved   = resolved_length(outline);
    const bool   by_grading = type == Type::graded || !grading_points.empty();
    const bool   uniform    = type == Type::uniform || !by_grading;
    const std::string entry = uniform ? "Mesh/Cell size" : "Mesh/Smallest size";
    const double      size  = uniform ? cell_size : smallest;
    if (size < resolved)
      throw InputError(
        entry,
        size,
        format(">= %g at the coordinates of the domain", resolved),
        "take larger cells, or put the origin nearer to the "
        "body: double precision resolves no smaller cells there");
    double n_cells;
    if (is_unstructured())
      n_cells = unstructured_size(*this);
    else
      {
        const std::array<double, dim> n = grid_size(*this);
        n_cells                         = 1.;
        for (const double intervals : n)
          n_cells *= intervals;
        n_cells *= (cells == Cells::quadrilaterals    ? 1.
                    : diagonals == Diagonals::crossed ? 4.
                                                      : 2.);
      }
    if (!(n_cells <= most_cells))
      throw InputError(entry,
                       size,
                       format("sizes that give up to %g cells; these would "
                              "give about %.3g",
                              most_cells,
                              n_cells),
                       uniform ? std::string("take larger cells")
                               : "raise it, or 'Mesh/Largest size', or " +
                                   std::string(type == Type::graded
                                                 ? "'Mesh/Growth factor'"
                                                 : "'Mesh/Size ratio'"));
  }

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

    /** An interval between two grading points, or one and the border. */
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
     * to largest, scaled together so that they fill the length.
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

    /** The number of sizes that growing_sizes() gives, in closed form. */
    double
    number_of_sizes(const double length, const MeshParameters &parameters)
    {
      const double s = parameters.smallest, l = parameters.largest;
      const double d = parameters.growth - 1., log_growth = std::log1p(d);
      const double k    = std::ceil(std::log(l / s) / log_growth);
      const double grow = s * (std::expm1(k * log_growth) / d);
      // The same relative tolerance as there.
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
  } // namespace

  namespace
  {
    /** The lowest and the highest corner of the domain. */
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

  namespace
  {
    /** Integrates 1/h^2 over triangles, 1/h^3 over boxes, by parts in which h hardly
     *  varies. */
    class IntegralOfSizes
    {
    public:
      explicit IntegralOfSizes(const MeshParameters &parameters)
        : parameters(parameters)
      {}

      /** The integral, with the sign of the triangle's orientation. */
      double
      over(const std::array<Point<dim>, 3> &corners, const int depth = 60) const
      {
        const auto &[a, b, c]   = corners;
        const Point<dim> centre = a + (b - a) / 3. + (c - a) / 3.;
        const double     radius = std::max(
          {centre.distance(a), centre.distance(b), centre.distance(c)});
        double distance = std::numeric_limits<double>::max();
        for (const Point<dim> &x : parameters.grading_points)
          distance = std::min(distance, centre.distance(x));
        // The size is monotonic in the distance, which changes by the radius.
        if (depth == 0 ||
            size(distance + radius) <= 1.5 * size(distance - radius))
          {
            const double h = size(distance);
            return ((b[0] - a[0]) * (c[1] - a[1]) -
                    (b[1] - a[1]) * (c[0] - a[0])) /
                   2. / (h * h);
          }
        const Point<dim> ab = a + (b - a) / 2., bc = b + (c - b) / 2.,
                         ca = c + (a - c) / 2.;
        return over({{a, ab, ca}}, depth - 1) + over({{ab, b, bc}}, depth - 1) +
               over({{ca, bc, c}}, depth - 1) + over({{ab, bc, ca}}, depth - 1);
      }

      /** Of 1/h^3 over a box. */
      double
      over_box(const std::array<Point<dim>, 2> &corners,
               const int                        depth = 20) const
      {
        const auto &[a, b]        = corners;
        const Point<dim> centre   = a + (b - a) / 2.;
        const double     radius   = a.distance(b) / 2.;
        double           distance = std::numeric_limits<double>::max();
        for (const Point<dim> &x : parameters.grading_points)
          distance = std::min(distance, centre.distance(x));
        if (depth == 0 ||
            size(distance + radius) <= 1.5 * size(distance - radius))
          {
            double part = 1.;
            for (unsigned int c = 0; c < dim; ++c)
              part *= (b[c] - a[c]) / size(distance);
            return part;
          }
        double sum = 0.;
        for (unsigned int v = 0; v < (1U << dim); ++v)
          {
            std::array<Point<dim>, 2> part;
            for (unsigned int c = 0; c < dim; ++c)
              {
                const bool upper = (v >> c) % 2 == 1;
                part[0][c]       = upper ? centre[c] : a[c];
                part[1][c]       = upper ? b[c] : centre[c];
              }
            sum += over_box(part, depth - 1);
          }
        return sum;
      }

    private:
      double
      size(const double distance) const
      {
        return parameters.grading_points.empty()
                 ? parameters.cell_size
                 : std::clamp(parameters.size_ratio * distance,
                              parameters.smallest,
                              parameters.largest);
      }

      const MeshParameters &parameters;
    };
  } // namespace

  double
  unstructured_size(const MeshParameters &parameters)
  {
    const Polygon        &outline = parameters.outline;
    const IntegralOfSizes integral(parameters);
    if (dim == 3) // a regular tetrahedron of edge h has the volume h^3/6 sqrt2
      return std::max(
        6., 6. * sqrt2 * integral.over_box({{outline[0], outline[1]}}));
    double sum = 0.;
    for (std::size_t i = 1; i + 1 < outline.size(); ++i)
      sum += integral.over({{outline[0], outline[i], outline[i + 1]}});
    const double n_triangles =
      std::max(4. / std::sqrt(3.) * std::abs(sum), outline.size() - 2.);
    return (parameters.cells == MeshParameters::Cells::quadrilaterals ? 2.
                                                                      : 1.) *
           n_triangles;
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

    CoarseMesh                    mesh;
    std::array<unsigned int, dim> n;
    for (unsigned int c = 0; c < dim; ++c)
      n[c] = x[c].size();
    const unsigned int nx = n[0] - 1, ny = n[1] - 1, nz = n[dim - 1] - 1;
    for (unsigned int k = 0; k <= (dim == 3 ? nz : 0); ++k)
      for (unsigned int j = 0; j <= ny; ++j)
        for (unsigned int i = 0; i <= nx; ++i)
          {
            Point<dim> vertex;
            vertex[dim - 1] = x[dim - 1][k];
            vertex[0]       = x[0][i];
            vertex[1]       = x[1][j];
            mesh.points.push_back(vertex);
          }

    const auto add_cell = [&](const std::vector<unsigned int> &vertices) {
      dealii::CellData<dim> cell(vertices.size());
      cell.vertices = vertices;
      mesh.cells.push_back(cell);
    };
    if (dim == 3)
      {
        for (unsigned int k = 0; k < nz; ++k)
          for (unsigned int j = 0; j < ny; ++j)
            for (unsigned int i = 0; i < nx; ++i)
              {
                const unsigned int row = nx + 1, layer = row * (ny + 1);
                const unsigned int a = k * layer + j * row + i;
                add_cell({a,
                          a + 1,
                          a + row,
                          a + row + 1,
                          a + layer,
                          a + layer + 1,
                          a + layer + row,
                          a + layer + row + 1});
              }
        mesh.grid = x;
        return mesh;
      }
    const bool crossed =
      parameters.diagonals == MeshParameters::Diagonals::crossed;
    for (unsigned int j = 0; j < ny; ++j)
      for (unsigned int i = 0; i < nx; ++i)
        {
          const unsigned int a = j * (nx + 1) + i, b = a + 1;
          const unsigned int c = a + nx + 1, d = c + 1;
          if (parameters.cells == MeshParameters::Cells::quadrilaterals)
            add_cell({a, b, c, d});
          else if (crossed)
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
    if (parameters.cells == MeshParameters::Cells::quadrilaterals)
      mesh.grid = x;
    return mesh;
  }
} // namespace geocone
