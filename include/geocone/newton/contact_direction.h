// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_newton_contact_direction_h
#define geocone_newton_contact_direction_h

#include <geocone/newton/step_workspace.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * Direction of Newton's method that linearises the momentum balance only and
   * keeps the exact laws of contact (Josephy 1979): its end satisfies them
   * exactly, whichever nodes come into contact, stick or slide. The body is
   * condensed to the potential contact nodes, with one right-hand side for each
   * of their components (CondensedContact); motions of free obstacles are
   * eliminated there.
   */
  class ContactDirection
  {
  public:
    /** Largest number of components that is condensed. */
    static constexpr unsigned int most_components = 1500;

    /**
     * Chooses the nodes and removes their laws from the Jacobian. Must be
     * called before its factorisation. Collective.
     */
    explicit ContactDirection(const StepWorkspace &work);

    /** Whether the number of components is positive and not too large. */
    bool
    is_used() const
    {
      return n_components > 0;
    }

    /** As StepWorkspace::solve(), by the factorised Jacobian. Omitted nodes
     *  that would be penetrated are added to the contact set. */
    void
    solve(const Vector          *prescribed,
          const Eigen::VectorXd &defect,
          Vector                &direction);

    /**
     * Slope: R.d at the iterate less the work of the contact forces at the end
     * of the direction, which count as loads. For associated flow it is the
     * slope of a convex function, with its minimum at the end if the balance is
     * linear. Collective.
     */
    double
    slope(const Vector &direction) const;

  private:
    /** A velocity component of a node of this rank. */
    struct Component
    {
      unsigned int           node; ///< index in Contact::nodes()
      dealii::Tensor<1, dim> axis;
      bool                   is_normal;
      unsigned int           number     = 0; ///< among those of all ranks
      bool                   is_relaxed = false;
    };

    /** Adds the components of nodes of this rank. Collective. */
    void
    add(const std::vector<unsigned int> &chosen, const bool relaxed);

    /** Solves the linear system with the residuals r at the nodes minus these
     *  forces. */
    void
    solve_with(const Eigen::VectorXd &force,
               const Vector          *prescribed,
               const Eigen::VectorXd &defect,
               Vector                &direction) const;

    /** Forces for which the end of the direction satisfies the laws, and
     *  changes of the motions of free obstacles. Collective.
     *  @param without du of the direction without forces */
    struct End
    {
      Eigen::VectorXd force, motion;
    };
    End
    end(const Eigen::VectorXd &without) const;

    /** Nodes of this rank that were not chosen and would be penetrated. */
    std::vector<unsigned int>
    entered(Vector &direction) const;

    /** Relative velocity change of a node of this rank, in a direction with
     *  ghosts. */
    dealii::Tensor<1, dim>
    relative_change(const ContactNode &node, const Vector &direction) const;

    /** Relative velocity changes of the nodes of this rank; zero for others.
     *  @param direction receives ghosts */
    Eigen::VectorXd
    relative_change(Vector &direction) const;

    /** Compliance: du by component for unit forces. Collective. */
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
