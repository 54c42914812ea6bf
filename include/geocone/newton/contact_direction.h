// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_newton_contact_direction_h
#define geocone_newton_contact_direction_h

#include <geocone/newton/step_workspace.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * Josephy-Newton direction (Josephy 1979): the momentum balance is
   * linearised, but the contact laws remain exact. The end point of the
   * direction satisfies the contact laws exactly, whichever nodes are in
   * contact, stick or slide. The body is condensed to the potential contact
   * nodes, with one right-hand side per velocity component of these nodes
   * (CondensedContact); the motions of free obstacles are eliminated.
   */
  class ContactDirection
  {
  public:
    /** Maximum number of contact velocity components for static
     *  condensation. */
    static constexpr unsigned int most_components = 1500;

    /**
     * Selects the potential contact nodes and removes their contact laws from
     * the Jacobian. Must be called before the Jacobian is factorised.
     * Collective.
     */
    explicit ContactDirection(const StepWorkspace &work);

    /** Returns true if the Josephy-Newton contact direction is used. The number
     *  of velocity components must be positive and at most most_components. */
    bool
    is_used() const
    {
      return n_components > 0;
    }

    /** Computes the Josephy-Newton direction, using the factorised Jacobian;
     *  the contact laws are not linearised. The arguments are those of
     *  StepWorkspace::solve(). Nodes not selected that would penetrate an
     *  obstacle are added to the contact set. */
    void
    solve(const Vector          *prescribed,
          const Eigen::VectorXd &defect,
          Vector                &direction);

    /**
     * Directional residual R.d along the direction d at the iterate, minus the
     * work of the contact forces. The contact forces at the end of the
     * direction act as loads. For associated flow the derivative of a convex
     * function, with its minimum at the end of the direction if the momentum
     * balance is linear. Collective.
     */
    double
    slope(const Vector &direction) const;

  private:
    /** Velocity component of a contact node owned by this rank. */
    struct Component
    {
      unsigned int           node; ///< index in Contact::nodes()
      dealii::Tensor<1, dim> axis;
      bool                   is_normal;
      unsigned int           number     = 0; ///< index over all ranks
      bool                   is_relaxed = false;
    };

    /** Appends the velocity components of the selected contact nodes on this
     *  rank. Collective. */
    void
    add(const std::vector<unsigned int> &chosen, const bool relaxed);

    /** Subtracts the contact forces from the nodal residuals and solves the
     *  linear system. */
    void
    solve_with(const Eigen::VectorXd &force,
               const Vector          *prescribed,
               const Eigen::VectorXd &defect,
               Vector                &direction) const;

    /** Contact forces for which the full Newton step satisfies the contact
     *  laws, with the corresponding motion increments of free obstacles.
     *  Collective.
     *  @param without relative velocity increments du of the direction without
     *  contact forces */
    struct End
    {
      Eigen::VectorXd force, motion;
    };
    End
    end(const Eigen::VectorXd &without) const;

    /** Nodes on this rank that were not selected as contact nodes but would
     *  penetrate an obstacle. */
    std::vector<unsigned int>
    penetrating_nodes(Vector &direction) const;

    /** Increment of the relative velocity between a contact node on this rank
     *  and its obstacle. @param direction with ghost values */
    dealii::Tensor<1, dim>
    relative_change(const ContactNode &node, const Vector &direction) const;

    /** Increments of the relative velocities of all contact nodes, by velocity
     *  component. Components on other ranks are zero.
     *  @param direction receives ghost values */
    Eigen::VectorXd
    relative_change(Vector &direction) const;

    /** Compliance matrix of the contact nodes: increments of relative velocity
     *  due to unit contact forces. Collective. */
    Eigen::MatrixXd
    compliance() const;

    const StepWorkspace   &work;
    const Contact         &contact;
    std::vector<Component> own;
    std::vector<bool>      is_chosen; ///< of Contact::nodes()
    std::vector<dealii::Tensor<1, dim>>
                 end_force;        ///< per node of Contact::nodes() (N/m)
    unsigned int n_components = 0; ///< total over all ranks
  };
} // namespace geocone::GEOCONE_DIM

#endif
