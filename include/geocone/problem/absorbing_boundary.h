// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_problem_absorbing_boundary_h
#define geocone_problem_absorbing_boundary_h

#include <geocone/conditions/unknowns.h>
#include <geocone/points/material_points.h>
#include <geocone/problem/term.h>
#include <geocone/scene/scene.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Absorbing boundaries, which transmit outgoing and incoming elastic waves
   * (Lysmer and Kuhlemeyer 1969; Joyner and Chen 1975): dashpots with the
   * traction
   *   rho (c_p n n' + c_s (1 - n n')) (2 v_in - v),
   * c_p and c_s the speeds of pressure and shear waves in the adjacent cell,
   * v_in the velocity of the incoming wave. Waves along the normal are absorbed
   * completely. Integrated with row sums, so that each node has its dashpot
   * C_i, dim x dim.
   */
  class AbsorbingBoundary : public Term
  {
  public:
    /** @param body points in the cells of the body, which determine the soil;
     *  null if they move: then the soil is that of the regions @throws
     *  InputError if a part has no face */
    AbsorbingBoundary(const Scene          &scene,
                      const BackgroundMesh &mesh,
                      const Space          &space,
                      const MaterialPoints *body);

    /** Whether the scene has absorbing boundaries. */
    bool
    exists() const
    {
      return !conditions.list.empty();
    }

    /** @throws InputError if dofs of one of its nodes are rotated.
     *  Collective. */
    void
    check(const Unknowns &unknowns) const;

    /** @param t time for which the step is solved @param unknowns of the
     *  problem */
    void
    begin_step(const double t, const Unknowns &unknowns);

    void
    residual(Vector &part, const Vector &v, const LocalLaw &law) override;

    void
    linearise(const JacobianPattern &pattern,
              const double           elastic_blend,
              SparseMatrix          &matrix) const override;

    void
    apply_tangent(Vector &dst, const Vector &dv) const override;

    void
    add_elastic_diagonal(Vector &dst) const override;

    /** Power of the dashpot forces on the body (W/m). Collective. */
    double
    power(const Vector &v) const;

    /** Dashpot of a node of this rank, by one condition. */
    struct Dashpot
    {
      unsigned int           node, condition;
      dealii::Tensor<2, dim> C; ///< kg/(m s), per thickness
    };
    const std::vector<Dashpot> &
    all() const
    {
      return dashpots;
    }

    /** Force of incoming waves at time t: 2 C v_in (N/m). */
    void
    incoming_force(const double t, Vector &force) const;

  private:
    /** Computes dst_i += C_i x_i. */
    void
    add_product(Vector &dst, const Vector &x) const;

    const BoundaryConditions &conditions;
    const Space              &space;
    std::vector<Dashpot>      dashpots;
    Vector                    incoming; ///< forces 2 C v_in
    const Unknowns           *unknowns = nullptr;
  };
} // namespace geocone::GEOCONE_DIM

#endif
