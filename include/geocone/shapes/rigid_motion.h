// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_shapes_rigid_motion_h
#define geocone_shapes_rigid_motion_h

#include <geocone/base/state_row.h>
#include <geocone/base/types.h>

#include <deal.II/base/tensor.h>

#include <Eigen/Geometry>

namespace geocone::GEOCONE_DIM
{
  /** Displacement, velocity or load of a rigid body. It consists of the
   *  translation of the centre, or the force (m, m/s, N/m), and the
   *  counterclockwise rotation about the centre, or the moment (rad, rad/s, N).
   *  In three dimensions the rotation is a rotation vector. */
  struct RigidMotion
  {
    static constexpr unsigned int n_components = dim + n_rotations;

    dealii::Tensor<1, dim>         centre;
    dealii::Tensor<1, n_rotations> rotation;

    double &
    operator[](const unsigned int k)
    {
      return k < dim ? centre[k] : rotation[k - dim];
    }
    double
    operator[](const unsigned int k) const
    {
      return k < dim ? centre[k] : rotation[k - dim];
    }

    /** Velocity V + w x arm of a body point for a unit component k of the rigid
     *  motion.
     *  @param arm from the centre to the point (m) */
    static dealii::Tensor<1, dim>
    of_point(const unsigned int k, const dealii::Tensor<1, dim> &arm)
    {
      dealii::Tensor<1, dim> v;
      if (k < dim)
        v[k] = 1.;
      else
        {
          const auto [a, b] = plane_of_rotation[k - dim];
          v[a]              = -arm[b];
          v[b]              = arm[a];
        }
      return v;
    }

    /** Velocity of a point of the rigid body. @param arm from the centre to the
     *  point (m) */
    dealii::Tensor<1, dim>
    at(const dealii::Tensor<1, dim> &arm) const
    {
      dealii::Tensor<1, dim> v = centre;
      for (unsigned int r = 0; r < n_rotations; ++r)
        v += rotation[r] * of_point(dim + r, arm);
      return v;
    }

    /** Rotates a vector by the rotation of the rigid body. If @p back, the
     *  rotation is inverse. */
    dealii::Tensor<1, dim>
    turned(const dealii::Tensor<1, dim> &x, const bool back = false) const
    {
      const double angle = rotation.norm();
      if (angle == 0.)
        return x;
      if constexpr (dim == 2)
        {
          const double c = std::cos(rotation[0]), s = back
                                                        ? -std::sin(rotation[0])
                                                        : std::sin(rotation[0]);
          return dealii::Tensor<1, dim>(
            {c * x[0] - s * x[1], s * x[0] + c * x[1]});
        }
      // Rodrigues' formula: w x (.) is at() of the rotation alone.
      const RigidMotion axis = {{}, rotation / (back ? -angle : angle)};
      const auto        once = axis.at(x);
      return x + std::sin(angle) * once +
             (1. - std::cos(angle)) * axis.at(once);
    }

    /** Composes this rigid motion with the subsequent motion @p next.
     *  Displacements and, in the plane, angles are summed. */
    void
    add(const RigidMotion &next)
    {
      centre += next.centre;
      if (dim == 2 || rotation.norm() == 0. || next.rotation.norm() == 0.)
        {
          rotation += next.rotation;
          return;
        }
      const Eigen::AngleAxisd sum(next.quaternion() * quaternion());
      for (unsigned int r = 0; r < n_rotations; ++r)
        rotation[r] = sum.angle() * sum.axis()[axis_number(r)];
    }

    void
    state(StateRow &row)
    {
      row(centre, rotation);
    }

  private:
    static unsigned int
    axis_number(const unsigned int rotation)
    {
      return 3 - plane_of_rotation[rotation][0] -
             plane_of_rotation[rotation][1];
    }

    Eigen::Quaterniond
    quaternion() const
    {
      Eigen::Vector3d w = Eigen::Vector3d::Zero();
      for (unsigned int r = 0; r < n_rotations; ++r)
        w[axis_number(r)] = rotation[r];
      return Eigen::Quaterniond(Eigen::AngleAxisd(w.norm(), w.normalized()));
    }
  };

  /** Number of components of a rigid motion, which are translations followed by
   *  rotations. */
  constexpr unsigned int n_motions = RigidMotion::n_components;
} // namespace geocone::GEOCONE_DIM

#endif
