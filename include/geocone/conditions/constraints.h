// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_conditions_constraints_h
#define geocone_conditions_constraints_h

#include <geocone/conditions/prescribed_node.h>
#include <geocone/conditions/unknowns.h>
#include <geocone/points/material_points.h>

#include <algorithm>
#include <array>
#include <map>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Prescribed velocities of nodes. These dofs are eliminated; the others, the
   * free dofs, are the unknowns. A multiplier, the reaction of the support on
   * the body, is the residual in the row of its dof. Linear constraints on free
   * dofs stand beside them, as rows with multipliers.
   *
   * A normal velocity turns the dofs of its nodes to the normal n of the side,
   * the mean over its faces at the node weighted by int N_i, or, where another
   * condition holds another direction, prescribes both of their dofs.
   *
   * Where several conditions prescribe the same component of a node, the last of
   * them in the list holds it. Those whose value there is the same share its
   * force: each bears what the stress beside it exerts on its own faces,
   *   f_c = int_c N_i (s n) dA,  s the mean over each cell,
   * and of what is left a part that goes as int_c N_i dA. So each nodal force
   * counts once, and a support has no part of what another one beside it bears.
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
     * @param points in the cells of the body
     * @throws InputError naming the free rigid motion and the dofs
     */
    void
    check_support(const BackgroundMesh &mesh,
                  const Space          &space,
                  const MaterialPoints &points) const;

    /** @throws InputError if a node on the axis of a round body can leave it */
    void
    check_axis(const BackgroundMesh &mesh, const Space &space) const;

    /** A warning, or nothing: values that are not linear in space are not interpolated by
     *  functions whose coefficients are not values (Bernstein, splines): they are as
     *  accurate as those of hats. Collective. */
    std::string
    warn_of_bent_values() const;

    /** Sets the prescribed components of v to their values at time t. */
    void
    set_values(Vector &v, const double t) const;

    /**
     * Numbers the unknowns: the dofs that are not prescribed and have mass.
     * @param mass lumped mass with ghosts, or null if all have; of a body without
     * inertia any number > 0 counts
     * @throws InputError if there is none
     */
    void
    number_unknowns(const Vector *mass);

    /**
     * The reaction of each condition. Collective.
     * @param residual residual of the momentum balance in all rows
     * @param stress of the points, to divide the forces of shared nodes
     * @param t time of the values
     */
    std::vector<Reaction>
    reactions(const Vector              &residual,
              const MaterialPoints      &points,
              const std::vector<Mandel> &stress,
              const double               t) const;

    /** Mean of a nodal field over the nodes of a condition. */
    double
    mean(const Vector      &field,
         const unsigned int condition,
         const unsigned int component) const;

    /** What the moment of a condition's reaction is about. */
    const dealii::Point<dim> &
    centre(const unsigned int condition) const
    {
      return centres[condition];
    }

    /** @name From components along the coordinates to those of the dofs, and back, in the
     *  owned entries of a vector */
    /** @{ */
    void
    turn(Vector &v) const;
    void
    turn_back(Vector &v) const;
    /** @} */

    /** All that this rank knows, with ghosts, but those of oblique nodes. */
    const std::vector<PrescribedNode> &
    prescribed_nodes() const
    {
      return prescribed;
    }

  private:
    /** A direction in which a condition holds a node. */
    struct Direction
    {
      unsigned int           condition;
      unsigned int           component; ///< or dim for the normal
      dealii::Tensor<1, dim> d;
    };

    /** A node that is held along other directions than the coordinates: some of them,
     *  the first ones of a turned node, or as many as are independent and hold it
     *  altogether. */
    struct Oblique
    {
      unsigned int           node;
      std::vector<Direction> directions;
      /** Unit vectors by rows, the first i + 1 of which span the first i + 1
       *  directions. */
      dealii::Tensor<2, dim> axes;

      /** Whether it is held along more than coordinates. */
      bool
      has_normal() const
      {
        return std::any_of(
          directions.begin(), directions.end(), [](const Direction &held) {
            return held.component == dim;
          });
      }

      bool
      is_turned() const
      {
        return directions.size() < dim;
      }
    };

    /** A component that several conditions prescribe. */
    struct Shared
    {
      std::vector<unsigned int> conditions; ///< the last one holds it
      std::vector<double>       size;       ///< int N_i over their faces (m)
      unsigned int              first = 0;  ///< of all conditions, see Part
    };

    /** int N_i n dA over the faces of a condition on a cell. */
    struct Part
    {
      unsigned int           place; ///< among the conditions of all shared ones
      unsigned int           component;
      dealii::Tensor<1, dim> weight; ///< (m)
    };

    /** Mean unit normals of a condition's sides at its nodes. Collective.
     *  @throws InputError where its sides meet in a sharp corner */
    std::map<unsigned int, dealii::Tensor<1, dim>>
    normals_of(const BoundaryCondition         &condition,
               const BackgroundMesh            &mesh,
               const std::vector<unsigned int> &nodes) const;

    /** A node, and what holds it: later directions first, as long as they are
     *  independent. */
    static Oblique
    independent(const unsigned int            node,
                const std::vector<Direction> &directions);

    /** Finds the nodes with normal velocities.
     *  @param of_dof what conditions along x and y prescribe */
    void
    find_oblique_nodes(
      const BackgroundMesh                              &mesh,
      const std::vector<std::vector<unsigned int>>      &nodes,
      std::map<unsigned int, std::vector<unsigned int>> &of_dof);

    /** Finds the components that several conditions prescribe, and numbers their
     *  conditions. Collective. */
    void
    number_shared(
      const std::map<unsigned int, std::vector<unsigned int>> &of_dof);

    /** Finds the faces around shared components. Collective. */
    void
    find_shared(
      const BackgroundMesh                                    &mesh,
      const std::map<unsigned int, std::vector<unsigned int>> &of_dof);

    /** What the stress exerts on the faces of each of the conditions that share
     *  nodes. Collective. */
    std::vector<double>
    exerted_on_faces(const MaterialPoints      &points,
                     const std::vector<Mandel> &stress) const;

    /** Divides the force of a shared component among its conditions. */
    void
    divide(const PrescribedNode      &node,
           const Shared              &among,
           const double               force,
           const std::vector<double> &exerted,
           const double               t,
           std::vector<Reaction>     &result) const;

    /** Adds a component of a nodal force to a condition's. */
    void
    add_force(const unsigned int     condition,
              const unsigned int     node,
              const unsigned int     component,
              const double           force,
              std::vector<Reaction> &result) const;

    /** The velocity that a condition asks for at a node. */
    double
    value(const unsigned int condition,
          const unsigned int component,
          const unsigned int node,
          const double       t) const
    {
      return scene.dirichlet.list[condition]->value(
        component, space.node_positions()[node], t);
    }

    const Scene                           &scene;
    const Space                           &space;
    const MPI_Comm                         comm;
    std::vector<PrescribedNode>            prescribed;
    std::vector<Oblique>                   oblique;
    std::vector<std::vector<unsigned int>> owned_nodes; ///< per condition
    std::vector<unsigned int>              n_nodes;     ///< of all ranks
    std::vector<dealii::Point<dim>>        centres;     ///< per condition

    /** Shared components by their global dof, the same on all ranks, and the
     *  number of their conditions in all. */
    std::map<dealii::types::global_dof_index, Shared> shared;
    unsigned int                                      n_shares = 0;

    /** Parts by the active index of their cell: those of cell c begin at
     *  first_part[c]. */
    std::vector<unsigned int> first_part;
    std::vector<Part>         parts;
  };
} // namespace geocone::GEOCONE_DIM

#endif
