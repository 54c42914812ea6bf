// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_newton_contact_direction_h
#define geocone_newton_contact_direction_h

#include <geocone/newton/step_workspace.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * The direction of Newton's method in which only the momentum balance is made linear,
   * and the laws of contact stay as they are (Josephy 1979): its end fulfils them
   * exactly, whichever nodes come down, stick or slide on the way. The body is condensed
   * to the nodes that may touch, with one right-hand side for each of their components
   * (CondensedContact); the motions of free obstacles are eliminated there.
   */
  class ContactDirection
  {
  public:
    /** More components than this are not condensed. */
    static constexpr unsigned int most_components = 1500;

    /**
     * Chooses the nodes, and takes their laws out of the Jacobian. To be called before
     * it is factorised. Collective.
     */
    explicit ContactDirection(const StepWorkspace &work);

    /** Whether there are nodes, not too many of them. */
    bool
    is_used() const
    {
      return n_components > 0;
    }

    /** As StepWorkspace::solve(), by the factorised Jacobian. Nodes that were left out
     *  and would be entered come in. */
    void
    solve(const Vector          *prescribed,
          const Eigen::VectorXd &defect,
          Vector                &direction);

    /**
     * R.d at the iterate less the work of the forces of contact at the end of the
     * direction, which count as loads: for associated flow the slope of a convex
     * function, whose least value is at the end where the balance is linear. Collective.
     */
    double
    slope(const Vector &direction) const;

  private:
    /** A component of the velocity of a node of this rank. */
    struct Component
    {
      unsigned int           node; ///< in Contact::nodes()
      dealii::Tensor<1, dim> axis;
      bool                   is_normal;
      unsigned int           number     = 0; ///< among those of all ranks
      bool                   is_relaxed = false;
    };

    /** Adds the components of nodes of this rank. Collective. */
    void
    add(const std::vector<unsigned int> &chosen, const bool relaxed);

    /** Solves with residuals at the nodes that are r less these forces. */
    void
    solve_with(const Eigen::VectorXd &force,
               const Vector          *prescribed,
               const Eigen::VectorXd &defect,
               Vector                &direction) const;

    /** The forces for which the direction ends where the laws hold, and how the motions
     *  of free obstacles change. Collective.
     *  @param without du of the direction without forces */
    struct End
    {
      Eigen::VectorXd force, motion;
    };
    End
    end(const Eigen::VectorXd &without) const;

    /** Nodes of this rank that are not among the chosen ones, and would be entered. */
    std::vector<unsigned int>
    entered(Vector &direction) const;

    /** Of a node of this rank, in a direction with ghosts. */
    dealii::Tensor<1, dim>
    relative_change(const ContactNode &node, const Vector &direction) const;

    /** Of the nodes of this rank; zero for others. @param direction gets ghosts */
    Eigen::VectorXd
    relative_change(Vector &direction) const;

    /** du by component for unit forces. Collective. */
    Eigen::MatrixXd
    compliance() const;

    const StepWorkspace   &work;
    const Contact         &contact;
    std::vector<Component> own;
    std::vector<bool>      is_chosen; ///< of Contact::nodes()
    std::vector<dealii::Tensor<1, dim>>
                 end_force;        ///< of Contact::nodes() (N/m)
    unsigned int n_components = 0; ///< of all ranks
  };
} // namespace geocone::GEOCONE_DIM

#endif
