// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mechanics_constraints_h
#define geocone_mechanics_constraints_h

#include <geocone/mechanics/unknowns.h>

#include <vector>

namespace geocone
{
  /**
   * Prescribed velocities of nodes. These dofs are eliminated; the others, the
   * free dofs, are the unknowns. A multiplier, the reaction of the support on
   * the body, is the residual in the row of its dof. Linear constraints on free
   * dofs stand beside them, as rows with multipliers.
   */
  class Constraints : public Unknowns
  {
  public:
    /**
     * Takes the conditions that are imposed on nodes.
     * @throws InputError if one of them selects no node
     */
    Constraints(const Scene          &scene,
                const BackgroundMesh &mesh,
                const Space          &space);

    /**
     * Checks that the prescribed dofs hold every connected part of the body
     * against translation and rotation, which a body without inertia needs.
     * @throws InputError naming the free rigid motion and the dofs
     */
    void
    check_support(const BackgroundMesh &mesh, const Space &space) const;

    /** Sets the prescribed components of v to their values at time t. */
    void
    set_values(Vector &v, const double t) const;

    /**
     * Numbers the unknowns: the dofs that are not prescribed and have mass.
     * @param mass lumped mass with ghosts, or null if all have
     * @throws InputError if there is none
     */
    void
    number_unknowns(const Vector *mass);

    /**
     * Resultant of a nodal force over the nodes whose component the condition
     * prescribes (N/m); where several do, the last of them in the list.
     * @param residual residual of the momentum balance in all rows
     */
    double
    resultant(const Vector      &residual,
              const unsigned int condition,
              const unsigned int component) const;

    /** Mean of a nodal field over the nodes of a condition. */
    double
    mean(const Vector      &field,
         const unsigned int condition,
         const unsigned int component) const;

    /** A component of a node, which one of the conditions prescribes. */
    struct Prescribed
    {
      unsigned int node; ///< local
      unsigned int component;
      unsigned int condition;
    };

    /** All that this rank knows, with ghosts. */
    const std::vector<Prescribed> &
    prescribed_components() const
    {
      return prescribed;
    }

  private:
    const Scene                           &scene;
    const Space                           &space;
    const MPI_Comm                         comm;
    std::vector<Prescribed>                prescribed;
    std::vector<std::vector<unsigned int>> owned_nodes; ///< per condition
    std::vector<unsigned int>              n_nodes;     ///< of all ranks
  };
} // namespace geocone

#endif
