// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_conditions_constraints_h
#define geocone_conditions_constraints_h

#include <geocone/conditions/linear_stress.h>
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
   * Prescribed nodal velocities. Prescribed dofs are eliminated; all others, the
   * free dofs, are the unknowns. The reaction of the support on the body is the
   * residual in the row of the dof. Linear constraints on free dofs are
   * additional rows with multipliers.
   *
   * A normal velocity rotates the dofs of its nodes to the normal n of the
   * boundary, the mean over its faces at the node weighted by int N_i. If
   * another condition prescribes another direction, both dofs of the node are
   * prescribed.
   *
   * If several conditions prescribe the same component of a node, the last of
   * them in the list determines its value. Conditions with the same value there
   * share the nodal force: each carries the traction of the adjacent stress on
   * its own faces,
   *   f_c = int_c N_i (s n) dA,  s the mean over each cell,
   * and a part of the remainder proportional to int_c N_i dA. Hence each nodal
   * force counts once, and no support reports the load carried by an adjacent
   * one.
   *
   * A condition is active in selected stages only; in all other stages the dofs
   * are free.
   */
  class Constraints : public Unknowns
  {
  public:
    /**
     * Collects the boundary conditions imposed on nodes and activates those of
     * the given stage.
     * @throws InputError if a condition selects no node
     */
    Constraints(const Scene          &scene,
                const BackgroundMesh &mesh,
                const Space          &space,
                const std::string    &stage);

    /** Activates the boundary conditions of a stage. Thereafter the unknowns must be
     *  numbered and incremental problems created again. Collective.
     *  @return whether the set of active conditions has changed */
    bool
    begin_stage(const BackgroundMesh &mesh, const std::string &stage);

    /**
     * Checks that the prescribed dofs prevent every rigid-body motion of each
     * connected part of the body. Required for analyses without inertia.
     * @param points in the cells of the body
     * @throws InputError naming the free rigid motion and the dofs
     */
    void
    check_support(const BackgroundMesh &mesh,
                  const Space          &space,
                  const MaterialPoints &points) const;

    /** Checks that nodes on the axis of an axisymmetric body cannot move away
     *  from the axis. @throws InputError if a node can */
    void
    check_axis(const BackgroundMesh &mesh, const Space &space) const;

    /** Returns a warning if prescribed velocities are nonlinear in space and the
     *  shape functions are not interpolatory (Bernstein polynomials, splines).
     *  Such velocities are only as accurate as with linear shape functions. Empty
     *  otherwise. Collective. */
    std::string
    warn_of_nonlinear_values() const;

    /** Sets the prescribed components of the velocity vector v to their values at
     *  time t. */
    void
    set_values(Vector &v, const double t) const;

    /**
     * Numbers the unknowns: the dofs without prescribed values at nodes with
     * mass.
     * @param mass lumped mass with ghosts; null if all nodes have mass. Without
     * inertia any positive value marks a node with mass
     * @throws InputError if there are no unknowns
     */
    void
    number_unknowns(const Vector *mass);

    /**
     * Computes the support reaction of each boundary condition. Collective.
     * @param residual residual of the momentum balance in all rows
     * @param stress of the points, to divide the forces of shared nodes
     * @param t time of the prescribed velocities (s)
     */
    std::vector<Reaction>
    reactions(const Vector              &residual,
              const MaterialPoints      &points,
              const BackgroundMesh      &mesh,
              const std::vector<Mandel> &stress,
              const double               t) const;

    /** Averages a component of a nodal field over the nodes of a boundary
     *  condition. */
    double
    mean(const Vector      &field,
         const unsigned int condition,
         const unsigned int component) const;

    /** Reference point for the reaction moment of a boundary condition. */
    const dealii::Point<dim> &
    centre(const unsigned int condition) const
    {
      return centres[condition];
    }

    /** @name Rotation of the owned entries of a vector from Cartesian components
     *  to components along the dofs, and back */
    /** @{ */
    void
    turn(Vector &v) const;
    void
    turn_back(Vector &v) const;
    /** @} */

    /** Nodes of this rank, including ghosts, with velocity components prescribed
     *  along the coordinate axes. */
    const std::vector<PrescribedNode> &
    prescribed_nodes() const
    {
      return prescribed;
    }

  private:
    /** A direction in which a boundary condition prescribes the velocity
     *  component of a node. */
    struct Direction
    {
      unsigned int           condition;
      unsigned int           component; ///< dim for the normal
      dealii::Tensor<1, dim> d;
    };

    /** A node at which the velocity is prescribed in directions other than the
     *  coordinate axes. Fewer than dim directions are the first axes of the
     *  node's rotated dofs; dim independent directions fix the node completely. */
    struct Oblique
    {
      unsigned int           node;
      std::vector<Direction> directions;
      /** Orthonormal axes of the node, stored by rows. The first i + 1 axes span
       *  the first i + 1 prescribed directions. */
      dealii::Tensor<2, dim> axes;

      /** Returns true if a velocity normal to the boundary is prescribed at the
       *  node. */
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

    /** A nodal velocity component that is prescribed by more than one boundary
     *  condition. */
    struct Shared
    {
      std::vector<unsigned int> conditions; ///< the last one governs
      std::vector<double>       size;       ///< int |N_i|, by condition (m)
      std::vector<double>       normal;     ///< int |N_i| n_d, by condition (m)
      unsigned int              first = 0;  ///< offset of FaceIntegral::place
    };

    /** Integrals over those faces of a cell on which a boundary condition is
     *  active. */
    struct FaceIntegral
    {
      unsigned int place; ///< number, starts at Shared::first
      unsigned int component;
      FaceMoments  faces;
    };

    /** Computes the mean unit normal at each node of the boundary on which a
     *  boundary condition is active. Collective.
     *  @throws InputError if faces of the condition meet in a sharp corner */
    std::map<unsigned int, dealii::Tensor<1, dim>>
    normals_of(const BoundaryCondition         &condition,
               const BackgroundMesh            &mesh,
               const std::vector<unsigned int> &nodes) const;

    /** Selects the linearly independent directions of the prescribed velocities
     *  at a node. Later directions take precedence. */
    static Oblique
    independent(const unsigned int            node,
                const std::vector<Direction> &directions);

    /** Finds the nodes with prescribed normal velocities.
     *  @param of_dof conditions on Cartesian components, by dof */
    void
    find_oblique_nodes(
      const BackgroundMesh                              &mesh,
      std::map<unsigned int, std::vector<unsigned int>> &of_dof);

    /** Finds the dofs prescribed by the boundary conditions of the current stage.
     *  Collective. */
    void
    find_prescribed(const BackgroundMesh &mesh);

    /** Finds and numbers the velocity components that are prescribed by more
     *  than one boundary condition. Collective. */
    void
    number_shared(
      const std::map<unsigned int, std::vector<unsigned int>> &of_dof);

    /** Finds the boundary faces that contribute to the reactions at nodes
     *  shared by several boundary conditions. Collective. */
    void
    find_shared(
      const BackgroundMesh                                    &mesh,
      const std::map<unsigned int, std::vector<unsigned int>> &of_dof);

    /** Finds PrescribedNode::carrier of a prescribed dof. */
    unsigned int
    carrier_of(const unsigned int               dof,
               const std::vector<unsigned int> &conditions) const;

    /** Computes the nodal forces on boundary faces due to the stresses in the
     *  adjacent cells, linear in each (LinearStress), at nodes shared by several
     *  boundary conditions. Nodes
     *  are shared if several conditions prescribe the same component. The
     *  forces are ordered by FaceIntegral::place. Collective. */
    std::vector<double>
    exerted_on_faces(const MaterialPoints      &points,
                     const BackgroundMesh      &mesh,
                     const std::vector<Mandel> &stress) const;

    /** Divides a nodal force among the boundary conditions that prescribe the
     *  same velocity component. */
    void
    divide(const PrescribedNode      &node,
           const Shared              &among,
           const double               force,
           const std::vector<double> &exerted,
           const double               t,
           std::vector<Reaction>     &result) const;

    /** Adds a component of a nodal force to the support reaction of a boundary
     *  condition. */
    void
    add_force(const unsigned int     condition,
              const unsigned int     node,
              const unsigned int     component,
              const double           force,
              std::vector<Reaction> &result) const;

    /** Velocity component that a boundary condition prescribes at a node at time
     *  t (m/s). */
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
    std::vector<bool>                      is_active;   ///< per condition
    std::vector<std::vector<unsigned int>> nodes;       ///< per condition
    std::vector<std::vector<unsigned int>> owned_nodes; ///< per condition
    std::vector<unsigned int>              n_nodes;     ///< over all ranks
    std::vector<dealii::Point<dim>>        centres;     ///< per condition

    /** Velocity components that are prescribed by more than one boundary
     *  condition, by global dof. The total number of conditions over all shared
     *  components is n_shares, the same on all ranks. */
    std::map<dealii::types::global_dof_index, Shared> shared;
    unsigned int                                      n_shares = 0;

    /** Integrals over boundary faces (FaceIntegral), ordered by active cell index. The
     *  integrals of cell c begin at first_part[c]. */
    std::vector<unsigned int> first_part;
    std::vector<FaceIntegral> parts;
  };
} // namespace geocone::GEOCONE_DIM

#endif
