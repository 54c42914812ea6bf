// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_terms_absorbing_boundary_h
#define geocone_terms_absorbing_boundary_h

#include <geocone/conditions/unknowns.h>
#include <geocone/points/material_points.h>
#include <geocone/scene/scene.h>
#include <geocone/terms/term.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Absorbing boundaries: dashpots that transmit outgoing and incoming elastic
   * waves (Lysmer and Kuhlemeyer 1969; Joyner and Chen 1975). Their traction is
   * rho (c_p n n' + c_s (1 - n n')) (2 v_in - v), with the speeds c_p and c_s
   * of pressure and shear waves in the adjacent cell and the velocity v_in of
   * the incoming wave. Waves along the normal are absorbed completely. Lumping
   * by row sums yields a dashpot matrix C_i (dim x dim) for each node.
   *   rho (c_p n n' + c_s (1 - n n')) (2 v_in - v),
   * c_p and c_s the speeds of pressure and shear waves in the adjacent cell,
   * v_in the velocity of the incoming wave. Waves along the normal are absorbed
   * completely. Lumping by row sums leaves each node a dashpot C_i, dim x dim.
   */
  class AbsorbingBoundary : public Term
  {
  public:
    /** Computes the dashpots of all nodes on absorbing boundaries.
     *  @param body points in the cells of the body, which determine the soil;
     *  null for moving points: then the regions determine the soil
     *  @throws InputError if a boundary part contains no face */
    AbsorbingBoundary(const Scene          &scene,
                      const BackgroundMesh &mesh,
                      const Space          &space,
                      const MaterialPoints *body);

    /** Returns true if the scene has absorbing boundaries. */
    bool
    exists() const
    {
      return !conditions.list.empty();
    }

    /** Checks that no node of an absorbing boundary has rotated dofs.
     *  Collective. @throws InputError if a node has */
    void
    check(const Unknowns &unknowns) const;

    /** Computes the nodal forces of incoming waves for a step.
     *  @param t time at which the step is solved (s)
     *  @param unknowns of the problem */
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

    /** Power of the dashpot forces acting on the body (W/m). Collective. */
    double
    power(const Vector &v) const;

    /** Dashpot of a locally owned node due to one boundary condition. */
    struct Dashpot
    {
      unsigned int           node, condition;
      dealii::Tensor<2, dim> C; ///< damping, per thickness (kg/(m s))
    };
    const std::vector<Dashpot> &
    all() const
    {
      return dashpots;
    }

    /** Nodal forces 2 C v_in of incoming waves at time t (N/m), with dashpot
     *  coefficients C and wave velocity v_in. */
    void
    incoming_force(const double t, Vector &force) const;

  private:
    /** Adds the dashpot forces C_i x_i of all nodes i to dst, with dashpot
     *  coefficients C_i and nodal velocities x_i. */
    void
    add_product(Vector &dst, const Vector &x) const;

    const BoundaryConditions &conditions;
    const Space              &space;
    std::vector<Dashpot>      dashpots;
    Vector                    incoming; ///< nodal forces 2 C v_in (N/m)
    const Unknowns           *unknowns = nullptr;
  };
} // namespace geocone::GEOCONE_DIM

#endif
