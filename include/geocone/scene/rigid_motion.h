// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_scene_rigid_motion_h
#define geocone_scene_rigid_motion_h

#include <geocone/base/state_row.h>
#include <geocone/base/types.h>

#include <deal.II/base/tensor.h>

namespace geocone
{
  /** What a rigid body has moved, its velocity, or its forces: of its centre along x
   *  and y (m, m/s, N/m), and about it, counterclockwise (rad, rad/s, N). */
  struct RigidMotion
  {
    static constexpr unsigned int n_components = dim + 1;

    dealii::Tensor<1, dim> centre;
    double                 angle = 0.;

    double &
    operator[](const unsigned int k)
    {
      return k < dim ? centre[k] : angle;
    }
    double
    operator[](const unsigned int k) const
    {
      return k < dim ? centre[k] : angle;
    }

    /** Component k of a point's velocity per component of the body's: V + w x arm.
     *  @param arm from the centre to the point (m) */
    static dealii::Tensor<1, dim>
    of_point(const unsigned int k, const dealii::Tensor<1, dim> &arm)
    {
      dealii::Tensor<1, dim> v;
      if (k < dim)
        v[k] = 1.;
      else
        v = dealii::Tensor<1, dim>({-arm[1], arm[0]});
      return v;
    }

    /** The velocity of a point of the body. */
    dealii::Tensor<1, dim>
    at(const dealii::Tensor<1, dim> &arm) const
    {
      return centre + angle * of_point(dim, arm);
    }

    void
    state(StateRow &row)
    {
      row(centre, angle);
    }
  };
} // namespace geocone

#endif
