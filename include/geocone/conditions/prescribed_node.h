// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_conditions_prescribed_node_h
#define geocone_conditions_prescribed_node_h

#include <geocone/base/state_row.h>
#include <geocone/base/types.h>
#include <geocone/geometry/geometry.h>

#include <deal.II/base/point.h>

namespace geocone::GEOCONE_DIM
{
  /** A nodal velocity component prescribed by a boundary condition. */
  struct PrescribedNode
  {
    unsigned int       node; ///< number, as defined by the list's owner
    unsigned int       component;
    unsigned int       condition; ///< index in Scene::dirichlet
    dealii::Point<dim> place;     ///< position of the node (m)
    bool               mine;      ///< whether this rank includes it in sums

    /** Condition that carries the force in explicit steps: of those that prescribe
     *  the same value, the one on a side along whose normal the component is. */
    unsigned int carrier;
  };

  /** Lever arm: moment about a rotation axis due to a unit force along a
   *  coordinate axis. */
  inline double
  lever(const dealii::Tensor<1, dim> &arm,
        const unsigned int            component,
        const unsigned int            rotation)
  {
    const auto [a, b] = plane_of_rotation[rotation];
    return component == b ? arm[a] : component == a ? -arm[b] : 0.;
  }

  /** Support reaction: resultant force and moment of the nodal forces f_i, or
   *  nodal impulses, on the body. */
  struct Reaction
  {
    dealii::Tensor<1, dim> force; ///< resultant sum f_i (N/m)

    /** Resultant moment sum (x_i - c) x f_i of the nodal forces about a
     *  reference point c, one component per rotation axis (N m/m). */
    dealii::Tensor<1, n_rotations> moment;

    /** Adds one component of a nodal force f_i to the reaction. @param arm x_i -
     *  c (m) */
    void
    add(const dealii::Tensor<1, dim> &arm,
        const unsigned int            component,
        const double                  f)
    {
      force[component] += f;
      for (unsigned int r = 0; r < n_rotations; ++r)
        moment[r] += f * lever(arm, component, r);
    }

    void
    state(StateRow &row)
    {
      row(force, moment);
    }
  };
} // namespace geocone::GEOCONE_DIM

#endif
