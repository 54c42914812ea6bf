// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/lexicographic.h>
#include <geocone/base/log.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/space/space.h>

#include <deal.II/base/mpi.h>

#include <deal.II/fe/fe_bernstein.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_tools.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    const UsedWhere used_space[] = {
      {"Discretisation/Element",
       "Discretisation/Method",
       {"FEM", "MPM", "explicit MPM"}},
      {"Discretisation/B-bar",
       "Discretisation/Method",
       {"FEM", "MPM", "explicit MPM"}},
      {"Discretisation/Basis",
       "Discretisation/Method",
       {"FEM", "MPM", "explicit MPM"}},
      {"Discretisation/Tied sides",
       "Discretisation/Method",
       {"FEM", "MPM", "explicit MPM"}},
      {"Discretisation/Double knots x",
       "Discretisation/Element",
       {"automatic", "B-spline 2", "B-spline 3"}},
      {"Discretisation/Double knots y",
       "Discretisation/Element",
       {"automatic", "B-spline 2", "B-spline 3"}},
      {"Discretisation/Double knots z",
       "Discretisation/Element",
       {"automatic", "B-spline 2", "B-spline 3"}}};
  } // namespace

  namespace
  {
    constexpr const char *tied_parameter = "Discretisation/Tied sides";

    std::string
    double_knots_parameter(const unsigned int direction)
    {
      return std::string("Double knots ") + coordinate[direction];
    }

    /** The dofs of nodes, dim each: owned nodes are a contiguous range. */
    IndexSet
    expand(const IndexSet &nodes)
    {
      IndexSet set(dim * nodes.size());
      for (auto interval = nodes.begin_intervals();
           interval != nodes.end_intervals();
           ++interval)
        set.add_range(dim * *interval->begin(), dim * (interval->last() + 1));
      set.compress();
      return set;
    }
  } // namespace

  Space::Space()
    : ParameterAcceptor("/Discretisation")
  {
    kind.declare(
      *this,
      "Element",
      dim == 2
        ? ". P1 to P3 on triangles, Q1 to Q3 on quadrilaterals, B-splines on "
          "uniform and graded grids of quadrilaterals. Automatic: for FEM P3 "
          "or Q3, but P2 on triangles if a soil without friction memory has (a "
          "- b)/a > 0.51 with a = sin(phi), b = sin(theta); for MPM B-spline 3 "
          "on grids, P3 on triangles, Q1 on other meshes; for explicit MPM "
          "B-spline 2, P1 or Q1."
        : ". P1 and P2 on tetrahedra, Q1 to Q3 on hexahedra, B-splines on "
          "grids of hexahedra. Automatic: P2 or Q2 for FEM; B-spline 2, P2 or "
          "Q1 for MPM.");
    basis.declare(*this,
                  "Basis",
                  ". Basis of P2, P3, Q2 and Q3. Automatic: Lagrange for FEM; "
                  "Bernstein, which is non-negative, for MPM.");
    add_parameter("B-bar",
                  b_bar,
                  "Whether B-bar prevents volumetric locking, for Q1 to Q3 and "
                  "B-splines: the volumetric strain of a cell is its mean over "
                  "the points of the cell, or for Q2 and Q3 its projection "
                  "onto polynomials of one degree less. In implicit steps of "
                  "dilatant soil the pressure is projected in the same way.");
    for (unsigned int c = 0; c < dim; ++c)
      add_parameter(
        double_knots_parameter(c),
        double_knots[c],
        format("B-splines, not with explicit MPM: %c-coordinates [m] of "
               "grid lines on which the velocity is one degree "
               "less continuous (C1 with cubic, C0 with quadratic "
               "B-splines), for instance the edges of a footing. "
               "Empty: none.",
               coordinate[c]));
    add_parameter("Tied sides",
                  tied_sides,
                  "FEM on one rank: SIDE: OTHER, ...: pairs of sides that move "
                  "equally (periodic sides), e.g. left: right for a part of an "
                  "infinite slope or layer. The sides are equal but for a "
                  "translation, and their nodes, too. Empty: none.");
  }

  std::vector<double>
  Space::with_double_knots(const std::vector<double> &lines,
                           const unsigned int         direction) const
  {
    std::vector<double> knots     = lines;
    const double        tolerance = 1e-9 * (lines.back() - lines.front());
    for (const double x : double_knots[direction])
      {
        const auto is_here = [&](const double line) {
          return std::abs(line - x) < tolerance;
        };
        const auto line = std::find_if(knots.begin(), knots.end(), is_here);
        const auto next =
          std::min_element(lines.begin(), lines.end(), [&](double a, double b) {
            return std::abs(a - x) < std::abs(b - x);
          });
        if (line == knots.end() || is_here(lines.front()) ||
            is_here(lines.back()) || is_here(*std::next(line)))
          throw InputError("Discretisation/" +
                             double_knots_parameter(direction),
                           x,
                           "coordinates of inner grid lines, each once; not "
                           "those at the ends",
                           format("the nearest grid line is at %c = %.10g: "
                                  "change the cells so that one is there, or "
                                  "leave the double knot out",
                                  coordinate[direction],
                                  *next));
        knots.insert(line, *line);
      }
    return knots;
  }

  std::string
  Space::automatic_element(const bool    simplicial,
                           const bool    has_grid,
                           const Method &method,
                           const bool    strongly_non_associated)
  {
    if (simplicial)
      return dim == 3 || (strongly_non_associated && !method.is_mpm()) ? "P2"
             : method.is_explicit()                                    ? "P1"
                                                                       : "P3";
    if (!method.is_mpm())
      return dim == 3 ? "Q2" : "Q3";
    if (!has_grid)
      return "Q1";
    return dim == 3 || method.is_explicit() ? "B-spline 2" : "B-spline 3";
  }

  std::vector<std::string>
  Space::warnings(const LawTraits &law, const Method &method) const
  {
    std::vector<std::string> all;
    if (law.undrained && !has_b_bar() && (method.is_mpm() || degree() < 3))
      all.push_back("undrained soil keeps its volume, which " + element() +
                    " cannot everywhere: loads come out too high; take "
                    "quadrilaterals with Discretisation/B-bar = true" +
                    (method.is_mpm() ? "" : ", or a cubic element"));
    // P1 and P2 were not.
    if (dim == 2 && !method.is_mpm() && law.strongly_non_associated &&
        (element() == "P3" || element() == "Q2" || element() == "Q3"))
      all.push_back(
        element() +
        " and the exact law of soil with little dilatancy: where loads drive "
        "the soil, such elements were seen to be off by up to " +
        (element() == "P3" ? "7" : "16") +
        " % with next to no lag (doc/small_dilatancy_family.md); take "
        "triangles with Discretisation/Element = P2, or "
        "'Materials/NAME/Friction memory'");
    return all;
  }

  void
  Space::choose_element(const bool    simplicial,
                        const bool    has_grid,
                        const Method &method,
                        const bool    strongly_non_associated)
  {
    if (kind == Element::automatic)
      kind.set(automatic_element(
        simplicial, has_grid, method, strongly_non_associated));
    const bool on_simplices = kind <= Element::p3;
    if (on_simplices != simplicial || (dim == 3 && kind == Element::p3) ||
        (kind >= Element::spline_2 && !has_grid))
      throw InputError("Discretisation/Element",
                       element(),
                       std::string("automatic | ") +
                         (!simplicial ? "Q1 | Q2 | Q3"
                          : dim == 2  ? "P1 | P2 | P3"
                                      : "P1 | P2") +
                         (has_grid ? " | B-spline 2 | B-spline 3" : "") +
                         " on this mesh",
                       "choose one of them, or change the cells of the mesh");
    p = element().back() - '0';
    if (method.is_explicit() && p > 1 && kind < Element::spline_2)
      throw InputError("Discretisation/Element",
                       element(),
                       "P1 | Q1 | B-spline 2 | B-spline 3 with explicit MPM",
                       "the stable step of elements of higher degree is very "
                       "small: take splines, or P1 or Q1 on an unstructured "
                       "mesh");
    for (unsigned int c = 0; c < dim; ++c)
      if (method.is_explicit() && !double_knots[c].empty())
        throw InputError("Discretisation/" + double_knots_parameter(c),
                         double_knots[c].front(),
                         "empty with explicit MPM",
                         "leave it out, or set Discretisation/Method = MPM");
    for (unsigned int c = 0; c < dim; ++c)
      if (!is_spline() && !double_knots[c].empty())
        throw InputError("Discretisation/" + double_knots_parameter(c),
                         double_knots[c].front(),
                         "empty, as the element is " + element(),
                         "leave it out, or take B-splines on a grid");
    if (basis == Basis::automatic)
      basis = method.is_mpm() ? Basis::bernstein : Basis::lagrange;
    if (has_ties() && method.is_mpm())
      throw InputError(tied_parameter,
                       tied_sides.begin()->first,
                       "empty with particles",
                       "set Discretisation/Method = FEM, or prescribe the "
                       "motion of both sides");
    if (b_bar && simplicial)
      throw InputError(
        "Discretisation/B-bar",
        "true",
        "true on quadrilaterals and hexahedra",
        "set B-bar = false: elements of higher degree lock less");
  }

  void
  Space::prepare(const BackgroundMesh &background,
                 const Method         &method,
                 const bool            strongly_non_associated)
  {
    mesh = &background;
    splines.clear();
    const bool simplicial = mesh->is_simplicial();
    choose_element(
      simplicial, !mesh->grid()[0].empty(), method, strongly_non_associated);

    n_nodes_per_cell = simplicial ? (p + 1) * (p + 2) / 2 : (p + 1) * (p + 1);
    if (dim == 3)
      n_nodes_per_cell = simplicial ? n_nodes_per_cell * (p + 3) / 3
                                    : n_nodes_per_cell * (p + 1);
    follow_ranks();
  }

  void
  Space::follow_ranks()
  {
    const IndexSet owned =
      is_spline() ? prepare_splines(*mesh) : prepare_finite_element(*mesh);
    if (has_ties())
      tie();

    // Only the nodes of own cells are needed, not those of all ghost cells.
    IndexSet                             active(owned.size());
    std::vector<types::global_dof_index> nodes;
    for (const auto &cell : mesh->own_cells())
      {
        cell_nodes(cell, nodes);
        active.add_indices(nodes.begin(), nodes.end());
        // Contact needs the nodes of other bodies at the same position.
        for (unsigned int layer = 0; layer < mesh->n_layers(); ++layer)
          if (layer != mesh->layer_of(cell))
            {
              cell_nodes(mesh->cell_in_layer(cell, layer), nodes);
              active.add_indices(nodes.begin(), nodes.end());
            }
      }
    // Contact can occur anywhere: each rank stores the boundaries of such
    // bodies.
    if (mesh->is_split())
      for (const auto &cell : mesh->triangulation().active_cell_iterators())
        if (cell->at_boundary())
          {
            cell_nodes(cell, nodes);
            active.add_indices(nodes.begin(), nodes.end());
          }
    active.compress();
    layout = std::make_shared<Utilities::MPI::Partitioner>(
      expand(owned), expand(active), mesh->triangulation().get_communicator());

    place_nodes();
  }

  void
  Space::follow_grid()
  {
    if (is_spline())
      {
        for (unsigned int c = 0; c < dim; ++c)
          splines[c].move(mesh->grid()[c]);
      }
    place_nodes();
  }

  void
  Space::place_nodes()
  {
    std::vector<types::global_dof_index> nodes;
    positions.resize(n_local_nodes());
    for (const auto &cell : mesh->triangulation().active_cell_iterators())
      if (!cell->is_artificial())
        {
          untied_nodes(cell, nodes);
          for (unsigned int i = 0; i < nodes.size(); ++i)
            if (layout->in_local_range(dim * nodes[i]) ||
                layout->is_ghost_entry(dim * nodes[i]))
              positions[local_node(nodes[i])] = position_of_node(cell, i);
        }
  }

  Point<dim>
  Space::position_of_node(const Cell &cell, const unsigned int i) const
  {
    Point<dim> x;
    if (is_spline())
      {
        const auto place = mesh->place_in_grid(cell);
        for (unsigned int c = 0; c < dim; ++c)
          x[c] = splines[c].greville(splines[c].first_function(place[c]) +
                                     lattice[i][c]);
        return x;
      }
    if (basis == Basis::bernstein)
      for (unsigned int c = 0; c < dim; ++c)
        x[c] = 1. * lattice[i][c] / p;
    else
      x = fe->unit_support_point(i);
    return mesh->mapping().transform_unit_to_real_cell(cell, x);
  }

  std::vector<std::pair<types::global_dof_index, Point<dim>>>
  Space::nodes_of_tied_side(const std::string &side) const
  {
    const types::boundary_id id =
      mesh->side_id(side, tied_parameter, "choose two");
    std::map<types::global_dof_index, Point<dim>> places;
    std::vector<types::global_dof_index>          nodes;
    for (const auto &cell : mesh->triangulation().active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary() && cell->face(f)->boundary_id() == id)
          {
            untied_nodes(cell, nodes);
            for (unsigned int i = 0; i < nodes.size(); ++i)
              if (is_on_face(i, f))
                places[nodes[i]] = position_of_node(cell, i);
          }
    return {places.begin(), places.end()};
  }

  void
  Space::tie()
  {
    if (Utilities::MPI::n_mpi_processes(
          mesh->triangulation().get_communicator()) > 1)
      throw InputError(tied_parameter,
                       tied_sides.begin()->first,
                       "empty on several ranks",
                       "run on one rank");
    tied.resize(dofs->n_dofs());
    std::iota(tied.begin(), tied.end(), 0);
    for (const auto &[name, other_name] : tied_sides)
      {
        const auto side  = nodes_of_tied_side(name),
                   other = nodes_of_tied_side(other_name);
        // The translation between them: that of their lower left corners.
        const auto corner = [](const auto &all) {
          Point<dim> low = all.front().second;
          for (const auto &[node, x] : all)
            for (unsigned int d = 0; d < dim; ++d)
              low[d] = std::min(low[d], x[d]);
          return low;
        };
        const Tensor<1, dim> shift = corner(other) - corner(side);
        const double         most  = 1e-6 * shift.norm();
        for (const auto &[node, x] : other)
          {
            const auto equal =
              std::find_if(side.begin(), side.end(), [&](const auto &one) {
                return (x - shift).distance(one.second) <= most;
              });
            if (equal == side.end() || side.size() != other.size() ||
                equal->first == node)
              throw InputError(
                tied_parameter,
                name + ": " + other_name,
                "two sides with equal nodes but for a translation",
                format("the sides have %zu and %zu nodes, and the one at (%s) "
                       "has no partner: take Mesh/Type = uniform, or equal "
                       "sizes of cells along both sides",
                       side.size(),
                       other.size(),
                       text_of_place(x).c_str()));
            tied[node] = equal->first;
          }
      }
    // Nodes of several pairs, at corners.
    for (auto &node : tied)
      for (std::size_t n = 0; tied[node] != node && n <= tied_sides.size(); ++n)
        node = tied[node];

    // Matrices of cells are added once per pair of nodes.
    std::vector<types::global_dof_index> nodes;
    for (const auto &cell : mesh->triangulation().active_cell_iterators())
      {
        cell_nodes(cell, nodes);
        if (std::set<types::global_dof_index>(nodes.begin(), nodes.end())
              .size() < nodes.size())
          throw InputError(tied_parameter,
                           tied_sides.begin()->first + ": " +
                             tied_sides.begin()->second,
                           "sides with at least two cells between them",
                           "take smaller cells");
      }
  }

  IndexSet
  Space::prepare_finite_element(const BackgroundMesh &mesh)
  {
    lattice.clear();
    if (!mesh.is_simplicial())
      {
        if (basis == Basis::bernstein)
          fe = std::make_unique<FE_Bernstein<dim>>(p);
        else
          fe = std::make_unique<FE_Q<dim>>(p);
        for (const unsigned int i :
             FETools::hierarchic_to_lexicographic_numbering<dim>(p))
          lattice.push_back(index_in_grid(i, equal_sizes(p + 1)));
      }
    else if (p < 3)
      fe = std::make_unique<FE_SimplexP<dim>>(p);
    else if constexpr (dim == 2)
      fe = make_cubic_simplex();
    if (mesh.is_simplicial())
      for (const Point<dim> &x : fe->get_unit_support_points())
        {
          lattice.emplace_back();
          for (unsigned int c = 0; c < dim; ++c)
            lattice.back()[c] = std::lround(p * x[c]);
        }
    dofs = std::make_unique<DoFHandler<dim>>(mesh.triangulation());
    dofs->distribute_dofs(*fe);
    return dofs->locally_owned_dofs();
  }

  IndexSet
  Space::prepare_splines(const BackgroundMesh &mesh)
  {
    lattice.clear();
    spline_number.clear();
    if (splines.empty()) // not after a repartition: lines may have moved
      for (unsigned int c = 0; c < dim; ++c)
        splines.emplace_back(p, with_double_knots(mesh.grid()[c], c));
    for (unsigned int i = 0; i < n_nodes_per_cell; ++i)
      lattice.push_back(index_in_grid(i, equal_sizes(p + 1)));

    // Nodes belong to the rank of a cell in the middle of their support. The
    // ranks of all cells are needed: supports reach beyond ghost cells.
    const MPI_Comm     comm    = mesh.triangulation().get_communicator();
    const unsigned int rank    = Utilities::MPI::this_mpi_process(comm);
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm);
    GridIndex          n_cells, n_functions;
    for (unsigned int c = 0; c < dim; ++c)
      {
        n_cells[c]     = splines[c].n_intervals();
        n_functions[c] = splines[c].n_functions();
      }
    std::vector<unsigned int> rank_of_cell(
      mesh.triangulation().n_active_cells());
    const std::size_t n_per_layer = grid_volume(n_cells);
    for (const auto &cell : mesh.triangulation().active_cell_iterators())
      rank_of_cell[mesh.layer_of(cell) * n_per_layer +
                   number_in_grid(mesh.place_in_grid(cell), n_cells)] =
        mesh.owner_of_cell()[cell->active_cell_index()];

    std::vector<unsigned int> rank_of_node;
    for (unsigned int layer = 0; layer < mesh.n_layers(); ++layer)
      for (std::size_t i = 0; i < grid_volume(n_functions); ++i)
        {
          GridIndex cell = index_in_grid(i, n_functions);
          for (unsigned int c = 0; c < dim; ++c)
            cell[c] = splines[c].middle_interval(cell[c]);
          rank_of_node.push_back(
            rank_of_cell[layer * n_per_layer + number_in_grid(cell, n_cells)]);
        }
    std::vector<types::global_dof_index> next(n_ranks + 1, 0);
    for (const unsigned int r : rank_of_node)
      ++next[r + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    IndexSet owned(rank_of_node.size());
    owned.add_range(next[rank], next[rank + 1]);
    for (const unsigned int r : rank_of_node)
      spline_number.push_back(next[r]++);
    return owned;
  }

  void
  Space::cell_nodes(const Cell                           &cell,
                    std::vector<types::global_dof_index> &nodes) const
  {
    untied_nodes(cell, nodes);
    if (!tied.empty())
      for (types::global_dof_index &node : nodes)
        node = tied[node];
  }

  void
  Space::untied_nodes(const Cell                           &cell,
                      std::vector<types::global_dof_index> &nodes) const
  {
    nodes.resize(n_nodes_per_cell);
    if (is_spline())
      {
        const GridIndex place = mesh->place_in_grid(cell);
        GridIndex       sizes, function;
        for (unsigned int c = 0; c < dim; ++c)
          sizes[c] = splines[c].n_functions();
        const std::size_t first = mesh->layer_of(cell) * grid_volume(sizes);
        for (unsigned int i = 0; i < n_nodes_per_cell; ++i)
          {
            for (unsigned int c = 0; c < dim; ++c)
              function[c] = splines[c].first_function(place[c]) + lattice[i][c];
            nodes[i] = spline_number[first + number_in_grid(function, sizes)];
          }
        return;
      }
    const DoFHandler<dim>::active_cell_iterator dof_cell(
      &mesh->triangulation(), cell->level(), cell->index(), dofs.get());
    if (fe->n_dofs_per_line() < 2 || !mesh->is_simplicial())
      {
        dof_cell->get_dof_indices(nodes);
        return;
      }
    // The cubic triangle: edge nodes are stored along the edge, and reversed if
    // the cell has the opposite direction.
    unsigned int i = 0;
    for (const unsigned int v : cell->vertex_indices())
      nodes[i++] = dof_cell->vertex_dof_index(v, 0);
    for (unsigned int l = 0; l < 3; ++l)
      {
        const auto line = dof_cell->line(l);
        const bool same_direction =
          line->vertex_index(0) == cell->vertex_index(l);
        nodes[i++] = line->dof_index(same_direction ? 0 : 1);
        nodes[i++] = line->dof_index(same_direction ? 1 : 0);
      }
    nodes[i] = dof_cell->dof_index(0);
  }

  void
  Space::evaluate(const Cell       &cell,
                  const Point<dim> &unit,
                  double           *N,
                  Tensor<1, dim>   *gradient) const
  {
    if (!is_spline() && basis == Basis::lagrange)
      {
        for (unsigned int i = 0; i < n_nodes_per_cell; ++i)
          {
            N[i] = fe->shape_value(i, unit);
            if (gradient != nullptr)
              gradient[i] = fe->shape_grad(i, unit);
          }
        return;
      }
    if (mesh->is_simplicial())
      {
        bernstein_on_simplex(p, unit, lattice, N, gradient);
        return;
      }
    double value[dim][max_degree + 1], slope[dim][max_degree + 1];
    if (is_spline())
      {
        const auto place = mesh->place_in_grid(cell);
        for (unsigned int c = 0; c < dim; ++c)
          splines[c].evaluate(place[c], unit[c], value[c], slope[c]);
      }
    else
      for (unsigned int c = 0; c < dim; ++c)
        bernstein(p, unit[c], value[c], slope[c]);
    for (unsigned int i = 0; i < n_nodes_per_cell; ++i)
      {
        N[i] = 1.;
        for (unsigned int c = 0; c < dim; ++c)
          N[i] *= value[c][lattice[i][c]];
        if (gradient != nullptr)
          for (unsigned int d = 0; d < dim; ++d)
            {
              gradient[i][d] = 1.;
              for (unsigned int c = 0; c < dim; ++c)
                gradient[i][d] *= (c == d ? slope[c] : value[c])[lattice[i][c]];
            }
      }
  }

  std::vector<double>
  Space::spline_integrals() const
  {
    std::vector<double>                  integral(n_local_nodes(), 0.);
    std::vector<types::global_dof_index> nodes;
    for (const auto &cell : mesh->own_cells())
      {
        cell_nodes(cell, nodes);
        const auto place = mesh->place_in_grid(cell);
        for (unsigned int i = 0; i < n_nodes_per_cell; ++i)
          {
            double product = 1.;
            for (unsigned int c = 0; c < dim; ++c)
              product *= splines[c].integral(
                splines[c].first_function(place[c]) + lattice[i][c]);
            integral[local_node(nodes[i])] = product;
          }
      }
    return integral;
  }

  std::vector<unsigned int>
  Space::nodes_on_sides(const std::set<types::boundary_id> &ids) const
  {
    return nodes_on_faces([&](const Cell &cell, const unsigned int f) {
      return cell->face(f)->at_boundary() &&
             ids.count(cell->face(f)->boundary_id()) > 0;
    });
  }

  bool
  Space::is_on_face(const unsigned int i, const unsigned int face) const
  {
    if (mesh->is_simplicial())
      {
        // Barycentric coordinate that vanishes on a face; `rest` is that of
        // the first vertex.
        unsigned int rest = p;
        for (const unsigned int a : lattice[i])
          rest -= a;
        constexpr unsigned int first         = dim;
        constexpr unsigned int of_face[2][4] = {{1, first, 0, 0},
                                                {2, 1, 0, first}};
        const unsigned int     c             = of_face[dim - 2][face];
        return (c == first ? rest : lattice[i][c]) == 0;
      }
    return lattice[i][face / 2] == (face % 2 == 0 ? 0 : p);
  }

  std::vector<unsigned int>
  Space::nodes_on_faces(
    const std::function<bool(const Cell &, const unsigned int)> &holds) const
  {
    // Includes ghost cells: the boundary face at a node of this rank may belong
    // to a cell of another rank.
    std::set<unsigned int>               found;
    std::vector<types::global_dof_index> nodes;
    for (const auto &cell : mesh->triangulation().active_cell_iterators())
      if (!cell->is_artificial())
        for (const unsigned int f : cell->face_indices())
          if (holds(cell, f))
            {
              cell_nodes(cell, nodes);
              for (unsigned int i = 0; i < nodes.size(); ++i)
                if (is_on_face(i, f) &&
                    (layout->in_local_range(dim * nodes[i]) ||
                     layout->is_ghost_entry(dim * nodes[i])))
                  found.insert(local_node(nodes[i]));
            }
    return {found.begin(), found.end()};
  }
} // namespace geocone::GEOCONE_DIM
