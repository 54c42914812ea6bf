// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mechanics_constraints_h
#define geocone_mechanics_constraints_h

#include <geocone/discretisation/space.h>
#include <geocone/scene/scene.h>

#include <vector>

namespace geocone
{
  /**
   * Prescribed velocities of nodes. These dofs are eliminated; the others, the
   * free dofs, are the unknowns. A multiplier, the reaction of the support on
   * the body, is the residual in the row of its dof.
   */
  class Constraints
  {
  public:
    /**
     * @throws InputError if a condition selects no node
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

    bool
    is_free(const unsigned int local_dof) const
    {
      return free_row[local_dof] >= 0;
    }

    /** Per local dof its row among the free ones, or -1 if prescribed. */
    std::vector<int> free_row;

    /** Global row numbers of the local free rows; the owned ones come first. */
    std::vector<int> global_row;
    int              n_owned_rows = 0;
    int              n_rows       = 0; ///< unknowns of all ranks

    /**
     * Resultant of a nodal force over the nodes of a condition (N/m).
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

  private:
    struct Prescribed
    {
      unsigned int local_dof;
      unsigned int condition;
      unsigned int component;
    };

    const Scene                           &scene;
    const Space                           &space;
    std::vector<Prescribed>                prescribed;
    std::vector<std::vector<unsigned int>> owned_nodes; ///< per condition
    std::vector<unsigned int>              n_nodes;     ///< of all ranks
  };
} // namespace geocone

#endif
