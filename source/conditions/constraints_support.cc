// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Checks that conditions support each part of the body against rigid motions,
// and nodes of axisymmetric bodies on the axis.
#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/over_ranks.h>
#include <geocone/conditions/constraints.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** Connected parts of a body, by its nodes. */
    struct Parts
    {
      std::vector<int>        of_node; ///< per owned node, or -1
      std::vector<double>     n_nodes;
      std::vector<Point<dim>> centre; ///< mean of its nodes
      std::vector<double>     size;   ///< root mean square radius
    };

    Parts
    parts_of_body(const BackgroundMesh &mesh,
                  const Space          &space,
                  const MaterialPoints &points,
                  const MPI_Comm        comm)
    {
      const std::vector<unsigned int> of_cell =
        mesh.connected_parts(points.cells);
      unsigned int n_parts = 0;
      for (const unsigned int part : of_cell)
        n_parts = std::max(n_parts, part + 1);
      n_parts = Utilities::MPI::max(n_parts, comm);

      // All cells of a node may be on other ranks; -1 if it has none.
      Vector found(space.partitioner());
      for (unsigned int i = 0; i < dim * space.n_local_nodes(); ++i)
        found.local_element(i) = -1.;
      for (unsigned int c = 0; c < points.n_cells(); ++c)
        for (unsigned int i = 0; i < points.n_nodes; ++i)
          found.local_element(dim * points.nodes[c * points.n_nodes + i]) =
            of_cell[c];
      found.compress(VectorOperation::max);

      Parts                  parts;
      constexpr unsigned int n_sums = dim + 2; // 1, x, x^2
      std::vector<double>    sums(n_sums * n_parts, 0.);
      for (unsigned int i = 0; i < space.n_owned_nodes(); ++i)
        {
          parts.of_node.push_back(std::lround(found.local_element(dim * i)));
          if (parts.of_node[i] < 0)
            continue;
          const Point<dim> &x = space.node_positions()[i];
          double           *s = &sums[n_sums * parts.of_node[i]];
          s[0] += 1.;
          for (unsigned int d = 0; d < dim; ++d)
            s[1 + d] += x[d];
          s[1 + dim] += x.norm_square();
        }
      sum_over_ranks(sums, comm);
      for (unsigned int p = 0; p < n_parts; ++p)
        {
          const double *s      = &sums[n_sums * p];
          double        square = s[1 + dim] / s[0];
          Point<dim>    centre;
          for (unsigned int d = 0; d < dim; ++d)
            {
              centre[d] = s[1 + d] / s[0];
              square -= centre[d] * centre[d];
            }
          parts.n_nodes.push_back(s[0]);
          parts.centre.push_back(centre);
          parts.size.push_back(std::sqrt(std::max(1e-300, square)));
        }
      return parts;
    }

    /** Rigid velocities along the axes, and rotations w x (x - x_c)/size about
     *  z or about x, y and z. */
    constexpr unsigned int n_rigid = dim + n_rotations;
    using Rigid                    = Eigen::Matrix<double, n_rigid, 1>;
    using Gram                     = Eigen::Matrix<double, n_rigid, n_rigid>;

    /** Component along d of each rigid velocity, at r from the centre of its
     *  part. */
    Rigid
    rigid_velocities(const Tensor<1, dim> &d,
                     const Tensor<1, dim> &r,
                     const double          size)
    {
      Rigid row;
      for (unsigned int c = 0; c < dim; ++c)
        row[c] = d[c];
      for (unsigned int k = 0; k < n_rotations; ++k)
        {
          const auto [a, b] = plane_of_rotation[k];
          row[dim + k]      = (d[b] * r[a] - d[a] * r[b]) / size;
        }
      return row;
    }

    /** Description of a free rigid motion of a part around its centre. */
    std::string
    text_of_motion(const Rigid &m, const Point<dim> &centre, const double size)
    {
      if (m.template tail<n_rotations>().norm() < 1e-6)
        {
          Point<dim>  along;
          std::string only;
          for (unsigned int d = 0; d < dim; ++d)
            {
              along[d] = m[d];
              if (std::abs(std::abs(m[d]) - 1.) < 1e-6)
                only = std::string(": no node of it has its velocity ") +
                       coordinate[d] + " prescribed";
            }
          return "translate along (" + text_of_place(along) + ")" + only;
        }
      // Rotation about the fixed point in the plane of the fastest rotation.
      unsigned int k = 0;
      for (unsigned int i = 1; i < n_rotations; ++i)
        if (std::abs(m[dim + i]) > std::abs(m[dim + k]))
          k = i;
      const auto [a, b]  = plane_of_rotation[k];
      const auto rounded = [&](const double x) {
        return std::abs(x) < 1e-9 * size ? 0. : x;
      };
      const double w = m[dim + k] / size;
      return format("rotate about (%.3g, %.3g)",
                    rounded(centre[a] - m[b] / w),
                    rounded(centre[b] + m[a] / w)) +
             (dim == 3 ? std::string(" in the plane of ") + coordinate[a] +
                           " and " + coordinate[b]
                       : std::string()) +
             ": too few nodes are prescribed to stop it";
    }
  } // namespace

  void
  Constraints::check_axis(const BackgroundMesh &mesh, const Space &space) const
  {
    if (!mesh.is_axisymmetric())
      return;
    std::string where;
    for (unsigned int node = 0; node < space.n_owned_nodes(); ++node)
      if (const Point<dim> &x = space.node_positions()[node];
          std::abs(x[0]) < 1e-12 && !is_prescribed(dim * node))
        where = format("(%g, %g)", x[0], x[1]);
    where = text_of_any_rank(comm, where);
    if (!where.empty())
      throw InputError("Geometry/Symmetry",
                       "axisymmetric",
                       "a condition with Velocity x = 0 on the axis, and the "
                       "node at " +
                         where + " is free to leave it",
                       "name the side at x = 0 in 'Boundary conditions' and "
                       "set its Velocity x = 0");
  }

  void
  Constraints::check_support(const BackgroundMesh &mesh,
                             const Space          &space,
                             const MaterialPoints &points) const
  {
    const Parts parts = parts_of_body(mesh, space, points, comm);

    // A motion is free if it moves no prescribed dof.
    constexpr unsigned int size    = n_rigid * n_rigid;
    const unsigned int     n_parts = parts.centre.size();
    std::vector<double>    gram(size * n_parts, 0.);
    const auto             of_part = [&](const unsigned int p) {
      return Eigen::Map<Gram>(&gram[size * p]);
    };
    const auto hold = [&](const unsigned int node, const Tensor<1, dim> &d) {
      if (node >= space.n_owned_nodes() || parts.of_node[node] < 0)
        return;
      const int   p   = parts.of_node[node];
      const Rigid row = rigid_velocities(
        d, space.node_positions()[node] - parts.centre[p], parts.size[p]);
      of_part(p) += row * row.transpose();
    };
    for (const PrescribedNode &p : prescribed)
      hold(p.node, Point<dim>::unit_vector(p.component));
    for (const Oblique &o : oblique)
      for (const Direction &direction : o.directions)
        hold(o.node, direction.d);
    sum_over_ranks(gram, comm);
    for (unsigned int p = 0; p < n_parts; ++p)
      {
        // An axisymmetric body has one rigid motion, along its axis.
        if (mesh.is_axisymmetric())
          {
            of_part(p)(0, 0) += 1.;
            of_part(p)(dim, dim) += 1.;
          }
        const Eigen::SelfAdjointEigenSolver<Gram> eigen(of_part(p));
        if (eigen.eigenvalues()[0] > 1e-10)
          continue;
        const std::string which = n_parts == 1
                                    ? std::string("the body")
                                    : "the part of the body around (" +
                                        text_of_place(parts.centre[p]) + ")";
        throw InputError(
          "singular system (rigid body motion): " + which + " can " +
          text_of_motion(
            eigen.eigenvectors().col(0), parts.centre[p], parts.size[p]) +
          format(" (%.0f nodes)", parts.n_nodes[p]) +
          "\n  remedy:  add a boundary condition that holds it, "
          "or switch the inertia on "
          "('Time stepping/Inertia')");
      }
  }
} // namespace geocone::GEOCONE_DIM
