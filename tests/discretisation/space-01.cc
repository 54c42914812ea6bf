// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// The functions of every space must sum up to 1 and their gradients to 0, must
// reproduce linear fields from the node positions with exact gradients, on
// distorted cells too, and must agree on the faces that cells share. Every node
// must belong to one rank, and all ranks must know the same of it.

#include "../test.h"
#include "setup.h"

#include <cmath>

namespace discretisation_space_01
{
  using namespace discretisation_tests;
  using namespace geocone;
  using dealii::Point;
  using dealii::Tensor;

  void
  check(const std::string              &name,
        const std::vector<std::string> &overrides,
        const bool                      may_divide = false)
  {
    Setup setup("discretisation/box.prm", overrides);
    setup.prepare(may_divide);
    const BackgroundMesh &mesh  = setup.mesh;
    const Space          &space = setup.space;
    const unsigned int    n     = space.nodes_per_cell();
    const auto           &X     = space.node_positions();

    if (speaks())
      std::printf("%s: %u nodes, %u per cell, degree %u\n",
                  name.c_str(),
                  static_cast<unsigned int>(space.n_nodes()),
                  n,
                  space.degree());

    // Some field that is not linear, by its coefficients.
    const auto coefficient = [&](const unsigned int local) {
      return std::sin(3. * X[local][0] + 5. * X[local][1] * X[local][1]);
    };
    double sum = 0., slopes = 0., linear = 0., jump = 0., kink = 0.;
    bool   negative = false;
    std::vector<unsigned int>                    seen(space.n_nodes(), 0);
    std::vector<dealii::types::global_dof_index> nodes, others;
    std::vector<double>                          N(n);
    std::vector<Tensor<1, dim>>                  gradient(n);
    /** The field and its gradient at a unit point of a cell. */
    const auto field = [&](const Space::Cell &cell, const Point<dim> &unit) {
      space.cell_nodes(cell, others);
      space.evaluate(cell, unit, N.data(), gradient.data());
      const Tensor<2, dim> inverse = mesh.inverse_jacobian(cell, unit);
      std::pair<double, Tensor<1, dim>> u;
      for (unsigned int i = 0; i < n; ++i)
        {
          const double c = coefficient(space.local_node(others[i]));
          u.first += N[i] * c;
          u.second += c * (gradient[i] * inverse);
        }
      return u;
    };
    for (const auto &cell : mesh.own_cells())
      {
        space.cell_nodes(cell, nodes);
        for (const auto node : nodes)
          seen[node] = 1;
        for (const double xi : {0., 0.3, 0.6, 1.})
          for (const double eta : {0., 0.45, 0.8, 1.})
            {
              const Point<dim> unit(mesh.is_simplicial() ? xi * (1. - eta) : xi,
                                    eta);
              const Tensor<2, dim> inverse = mesh.inverse_jacobian(cell, unit);
              space.evaluate(cell, unit, N.data(), gradient.data());
              double         all = -1.;
              Tensor<1, dim> slope;
              Tensor<1, dim> x =
                -1. * mesh.mapping().transform_unit_to_real_cell(cell, unit);
              Tensor<2, dim> dx;
              for (unsigned int i = 0; i < n; ++i)
                {
                  const Tensor<1, dim> g = gradient[i] * inverse;
                  const Point<dim>    &y = X[space.local_node(nodes[i])];
                  negative |= N[i] < -1e-12;
                  all += N[i];
                  slope += g;
                  x += N[i] * y;
                  dx += outer_product(Tensor<1, dim>(y), g);
                }
              for (unsigned int c = 0; c < dim; ++c)
                dx[c][c] -= 1.;
              sum    = std::max(sum, std::abs(all));
              slopes = std::max(slopes, slope.norm());
              linear = std::max({linear, x.norm(), dx.norm()});
              // Values without gradients are the same.
              std::vector<double> again(n);
              space.evaluate(cell, unit, again.data(), nullptr);
              if (again != N)
                sum = 1.;
            }
        for (const unsigned int f : cell->face_indices())
          if (!cell->at_boundary(f) && cell->neighbor(f)->is_locally_owned())
            for (const double s : {0.2, 0.5, 0.9})
              {
                const Point<dim> x =
                  cell->face(f)->vertex(0) +
                  s * (cell->face(f)->vertex(1) - cell->face(f)->vertex(0));
                const Space::Cell other = cell->neighbor(f);
                const auto here = field(cell, mesh.unit_point(cell, x).value());
                const auto there =
                  field(other, mesh.unit_point(other, x).value());
                jump = std::max(jump, std::abs(here.first - there.first));
                kink = std::max(kink, (here.second - there.second).norm());
              }
      }
    print("sum N = 1, sum grad N = 0", sum < 1e-13 && slopes < 1e-11);
    print("linear fields and their gradients exact", linear < 1e-11);
    print("negative only where admitted", negative != space.is_non_negative());
    print("continuous over the faces", jump < 1e-12);
    print("gradients continuous over the faces for splines only",
          (kink < 1e-9) == space.is_spline());

    mpi::max(seen, comm, seen);
    bool all_seen = true;
    for (const unsigned int s : seen)
      all_seen &= s == 1;
    print("every node is one of a cell", all_seen);
    const auto n_owned = mpi::sum(space.n_owned_nodes(), comm);
    // What the owner says arrives at the ghosts.
    Vector x(space.partitioner()), number(space.partitioner());
    for (unsigned int i = 0; i < space.n_owned_nodes(); ++i)
      for (unsigned int c = 0; c < dim; ++c)
        {
          x.local_element(dim * i + c) = X[i][c];
          number.local_element(dim * i + c) =
            space.partitioner()->local_to_global(dim * i + c);
        }
    x.update_ghost_values();
    number.update_ghost_values();
    bool same = n_owned == space.n_nodes() && X.size() == space.n_local_nodes();
    for (unsigned int i = 0; i < X.size(); ++i)
      {
        for (unsigned int c = 0; c < dim; ++c)
          same &= std::abs(x.local_element(dim * i + c) - X[i][c]) < 1e-14 &&
                  number.local_element(dim * i + c) ==
                    space.partitioner()->local_to_global(dim * i + c);
        same &= space.local_node(space.partitioner()->local_to_global(dim * i) /
                                 dim) == i;
      }
    print("every node on one rank, and ghosts as their owners", same);

    bool ghosts_agree = true;
    if (speaks())
      std::printf("  nodes on");
    for (const auto &condition : setup.scene.dirichlet.list)
      {
        const std::vector<unsigned int> found =
          space.nodes_on_sides(mesh.side_ids(*condition));
        Vector       mark(space.partitioner());
        unsigned int own = 0;
        for (const unsigned int i : found)
          if (i < space.n_owned_nodes())
            {
              mark.local_element(dim * i) = 1.;
              ++own;
            }
        mark.update_ghost_values();
        for (unsigned int i = 0; i < space.n_local_nodes(); ++i)
          ghosts_agree &= (mark.local_element(dim * i) == 1.) ==
                          std::binary_search(found.begin(), found.end(), i);
        const unsigned int n_found = mpi::sum(own, comm);
        if (speaks())
          std::printf(" %s %u", condition->name.c_str(), n_found);
      }
    if (speaks())
      std::printf("\n");
    print("all ranks agree on them", ghosts_agree);
  }

  void
  test(int argc, char **argv)
  {
    dealii::Utilities::MPI::MPI_InitFinalize mpi_session(argc, argv, 1);

    // 5 x 5 squares; 3 x 3 cells that are no parallelograms and begin at
    // different corners; the squares cut into triangles; a graded grid.
    const std::string              spot = "Mesh/Grading points = 0.3, 1.1";
    const std::vector<std::string> squares,
      distorted     = {"Geometry/Shape = file",
                       "Geometry/File = distorted.msh",
                       "Mesh/Box ="},
      triangles     = {"Mesh/Cells = triangles"},
      graded        = {"Mesh/Type = graded",
                       spot,
                       "Mesh/Smallest size = 0.1",
                       "Mesh/Largest size = 0.4",
                       "Mesh/Growth factor = 1.5"};
    const auto with = [](std::vector<std::string> overrides,
                         const std::string       &element,
                         const std::string       &basis) {
      overrides.push_back("Discretisation/Element = " + element);
      overrides.push_back("Discretisation/Basis = " + basis);
      return overrides;
    };
    for (const std::string element : {"Q1", "Q2", "Q3"})
      for (const std::string basis : {"Bernstein", "Lagrange"})
        {
          check(element + " " + basis + ", squares",
                with(squares, element, basis));
          check(element + " " + basis + ", distorted cells",
                with(distorted, element, basis));
        }
    for (const std::string element : {"P1", "P2", "P3"})
      for (const std::string basis : {"Bernstein", "Lagrange"})
        check(element + " " + basis + ", triangles",
              with(triangles, element, basis));
    for (const std::string element : {"P2", "P3"})
      check(element + ", triangles, divided mesh",
            with(triangles, element, "automatic"),
            true);
    for (const std::string element : {"Q1", "Q3"})
      check(element + ", distorted cells, divided mesh",
            with(distorted, element, "automatic"),
            true);
    for (const std::string element : {"B-spline 2", "B-spline 3"})
      {
        check(element + ", squares", with(squares, element, "automatic"));
        check(element + ", graded grid", with(graded, element, "automatic"));
      }
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace discretisation_space_01
