// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/plane_bounds/interface_cells.h>

#include <limits>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;
  using dealii::Tensor;

  unsigned int
  n_dofs_of_interfaces(const BoundScene &bound)
  {
    unsigned int n =
      RigidMotion::n_components * bound.scene.obstacles.list.size();
    for (const Interface &interface : bound.interfaces)
      n += interface.opens() ? 3 : 0;
    return n;
  }

  namespace
  {
    /** Prescribes the velocities of obstacles, or loads those that are free.
     *  @param first_dof of n_dofs_of_interfaces() */
    void
    move_obstacles(const BoundScene  &bound,
                   const unsigned int first_dof,
                   BoundProblem      &problem)
    {
      const Obstacles &obstacles = bound.scene.obstacles;
      const double     L         = bound.units.length;
      for (unsigned int o = 0; o < obstacles.list.size(); ++o)
        {
          const Obstacle   &obstacle = *obstacles.list[o];
          const RigidMotion velocity = obstacle.velocity(0.),
                            force    = obstacle.load(0.);
          const Tensor<1, dim> weight =
            obstacle.inertia(0) *
            bound.scene.gravity.at(std::numeric_limits<double>::max());
          for (unsigned int k = 0; k < n_motions; ++k)
            {
              const unsigned int dof     = first_dof + n_motions * o + k;
              const double       turn    = k < dim ? 1. : L;
              problem.is_prescribed[dof] = !obstacle.is_free(k);
              problem.prescribed[dof] =
                velocity[k] * turn / bound.units.velocity;
              if (!obstacle.is_free(k))
                continue;
              const double unit = bound.units.stress * L * turn;
              bound.loads(problem, LoadFactor::tractions)[dof] +=
                force[k] / unit;
              if (k < dim)
                bound.loads(problem, LoadFactor::weight)[dof] +=
                  weight[k] / unit;
            }
        }
    }

    /** Relative velocity of the nodes of an edge and of the obstacle, if any. */
    PassingVelocity
    velocity_past(const BoundScene     &bound,
                  const Interface      &interface,
                  const InterfacePoint &point,
                  const unsigned int    first_dof)
    {
      PassingVelocity passing;
      for (const auto &[dof, part] : point.nodes)
        for (unsigned int d = 0; d < dim; ++d)
          passing.add(dof + d, part * Point<dim>::unit_vector(d));
      if (const int o = interface.obstacle; o >= 0)
        for (unsigned int k = 0; k < n_motions; ++k)
          passing.add(
            first_dof + n_motions * o + k,
            -1. * RigidMotion::of_point(
                    k,
                    (point.place - bound.scene.obstacles.list[o]->centre()) /
                      bound.units.length));
      return passing;
    }
  } // namespace

  StrainMatrix
  PassingVelocity::strains(const Interface::Face &face,
                           const Tensor<1, dim>  &N) const
  {
    const Tensor<1, dim> T({-N[1], N[0]});
    StrainMatrix         B = StrainMatrix::Zero(3, dofs.size());
    for (unsigned int j = 0; j < dofs.size(); ++j)
      {
        if (face.has_normal)
          B(0, j) = -(G[j] * N);
        if (face.has_tangential)
          B(1, j) = -(G[j] * T);
      }
    return B;
  }

  void
  add_interfaces(const BoundScene   &bound,
                 const PointsOfEdge &points_of,
                 const unsigned int  first_dof,
                 BoundProblem       &problem)
  {
    move_obstacles(bound, first_dof, problem);
    unsigned int opening =
      first_dof + n_motions * bound.scene.obstacles.list.size();
    for (const Interface &interface : bound.interfaces)
      {
        const double length =
          bound.triangles.edge_length(interface.held.edge) / bound.units.length;
        const std::array<InterfacePoint, 3> points = points_of(interface.held);
        const Tensor<1, dim> &N = interface.normal;
        for (const Interface::Face &face : interface.faces)
          {
            for (unsigned int i = 0; i < 3; ++i)
              {
                const InterfacePoint &point = points[i];
                const bool            acts =
                  !point.nodes.empty() &&
                  !problem.has_no_force[point.nodes.front().first];
                problem.volume.push_back(length * point.part);
                problem.cone.push_back(
                  acts ? PointCone{face.a, face.k / bound.units.stress}
                       : inactive_cone);
                PassingVelocity passing;
                if (acts)
                  passing = velocity_past(bound, interface, point, first_dof);
                if (interface.opens())
                  {
                    const bool is_first = &face == &interface.faces.front();
                    if (!is_first)
                      passing = {};
                    if (acts)
                      passing.add(opening + i, is_first ? -1. * N : N);
                    else
                      problem.is_prescribed[opening + i] =
                        problem.has_no_force[opening + i] = true;
                  }
                problem.B.add(passing.strains(face, N), passing.dofs);
              }
            problem.owner.push_back(interface.held.cell);
          }
        opening += interface.opens() ? 3 : 0;
      }
  }
} // namespace geocone::GEOCONE_DIM
