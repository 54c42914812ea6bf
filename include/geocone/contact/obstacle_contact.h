// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_contact_obstacle_contact_h
#define geocone_contact_obstacle_contact_h

#include <geocone/base/state_row.h>
#include <geocone/conditions/constraints.h>
#include <geocone/contact/body_contact.h>
#include <geocone/contact/contact.h>
#include <geocone/scene/scene.h>
#include <geocone/space/space.h>
#include <geocone/surfaces/node_sides.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Contact statistics of a step, reduced over all ranks. */
  struct ContactReport
  {
    unsigned int open = 0, stick = 0, slip = 0; ///< numbers of nodes
    double       error       = 0.; ///< largest |F| / sum of (|r| + rho |u|)
    double       penetration = 0.; ///< maximum penetration (m)
    /** Width of closed and of sticking contact (m), maximum contact pressure and
     *  shear traction (Pa). For body-fitted meshes only. */
    double width = 0., stick_width = 0., pressure = 0., shear = 0.;
    double work        = 0.; ///< work of contact forces on the body (J/m)
    double dissipation = 0.; ///< dissipation by friction and impact (J/m)

    /** Correction of the work of impact forces on rebounding nodes (J/m, not
     *  positive). It is the work computed with the mean of the velocities before
     *  and after impact, minus the work computed with the final velocity, which
     *  `work` and `dissipation` include. */
    double of_rebound = 0.;

    void
    take_worse(const ContactReport &other)
    {
      error       = std::max(error, other.error);
      penetration = std::max(penetration, other.penetration);
    }

    void
    state(StateRow &row)
    {
      row(open,
          stick,
          slip,
          error,
          penetration,
          width,
          stick_width,
          pressure,
          shear,
          work,
          dissipation);
    }
  };

  /**
   * Moving obstacles of a scene and all potential contact nodes. In a body-fitted
   * mesh these are boundary nodes, with the gap at their current position. In a
   * background mesh they are the nodes in or on the obstacle, with the gap of the
   * nearest particle that they move.
   */
  class ObstacleContact
  {
  public:
    /** Places the obstacles at their initial positions. Collective.
     *  @param supports for a body-fitted mesh, which must outlive this object;
     *  null for particles
     *  @throws InputError if the body overlaps with an obstacle */
    ObstacleContact(const Scene          &scene,
                    const BackgroundMesh &mesh,
                    const Space          &space,
                    const Unknowns       *supports);

    /**
     * Redefines the cells of the body in a body-fitted mesh, and hence the boundary
     * of the body. New nodes of the body have zero displacement. Collective.
     * @param cells of the body on this rank
     * @throws InputError if an obstacle overlaps with the cells
     */
    void
    set_body_cells(const std::vector<BackgroundMesh::Cell> &cells);

    /** Returns true if the scene contains obstacles or contacts between bodies. */
    bool
    exists() const
    {
      return scene.has_contact();
    }

    /**
     * Determines the potential contact nodes and the motions of the obstacles in a
     * step from t to t + h.
     * @param velocity_n at t_n, with ghosts
     * @param solved_h time increment of the solution: theta h by the
     * theta-scheme
     * @param gaps for a background mesh: per obstacle, the gap of the nearest
     * particle moved by a node, by its first dof, with ghosts
     * @param facing for a background mesh: potential contact nodes between bodies
     * @throws StepFailure if a node has three contacts at once; also see
     * BodyContact::find(), ParticleBodies::find()
     */
    ContactStep
    begin(const Vector              &velocity_n,
          const double               t,
          const double               h,
          const double               solved_h,
          const std::vector<Vector> &gaps   = {},
          std::vector<FacingNode>    facing = {}) const;

    /** Computes the contact statistics of a step. To be called before commit().
     *  Collective. */
    ContactReport
    report(const Contact &contact, const Vector &v, const double h) const;

    /** Resultant contact forces on the body: first those from each obstacle,
     *  then those of each contact between bodies. For contacts between bodies, the force acts
     *  on the first body. Moments are about the given centre, the centre of the
     *  obstacle, or the origin. Collective. */
    std::vector<Reaction>
    reactions(const Contact &contact) const;

    /** Subtracts from the forces in the rows of prescribed dofs what obstacles push
     *  into the supports, so that reactions() and those of supports are the forces
     *  that act on the body. */
    static void
    relieve_supports(const Contact  &contact,
                     const Unknowns &unknowns,
                     Vector         &reaction);

    /** Adds the displacement increments of obstacles and bodies in a step to
     *  the support displacements @p supports. They are the displacements of
     *  each obstacle, then, for each contact between bodies, of the first body
     *  relative to the other one, averaged over active contact nodes.
     *  Collective. @param first index of the first obstacle in @p supports */
    void
    add_displacements(const Contact                       &contact,
                      const Vector                        &v,
                      const double                         h,
                      const unsigned int                   first,
                      std::vector<dealii::Tensor<1, dim>> &supports) const;

    /**
     * Prevents artificial rebound: limits the relative velocity of contact
     * nodes at the end of a step of the theta-scheme. Nodes in contact retain
     * the velocity at theta if the extrapolated velocity is larger. Otherwise
     * they would rebound in each step, with alternating forces.
     * @param unknowns prescribed dofs do not change @param v velocity at theta
     * @param mass of the nodes @param[in,out] v_end
     * @return the kinetic energy removed (J/m), >= 0. Collective.
     */
    double
    settle(const Contact  &contact,
           const Unknowns &unknowns,
           const Vector   &v,
           const Vector   &mass,
           Vector         &v_end) const;

    /** Accepts the velocities of a step and moves the obstacles. In a body-fitted
     *  mesh, the nodes are moved as well.
     *  @param moves whether to change positions, in addition to velocities
     *  @throws StepFailure if an obstacle penetrates supported nodes.
     *  Collective. */
    void
    commit(const Contact &contact,
           const Vector  &v,
           const double   h,
           const double   solved_h,
           const bool     moves);

    /** Distance (m) below which the boundaries of two obstacles are treated as
     *  continuous, see Neighbours. */
    double
    margin() const
    {
      return continuity_tolerance * size;
    }

    /** Displacements of the obstacles since the start of the run. */
    const std::vector<RigidMotion> &
    moved() const
    {
      return displacement;
    }

    /** @name State variables for checkpoints: displacements and velocities of the
     *  obstacles; for a body-fitted mesh also displacements and bonds of nodes */
    /** @{ */
    void
    state(StateRow &row)
    {
      row(displacement, velocity);
    }
    Vector &
    displacement_of_nodes()
    {
      return nodal_displacement;
    }

    /** Returns true if any interface has tensile strength, so that contacts can
     *  carry tension. */
    bool
    has_bonds() const;

    /** Bond of each node: 1 + index of the obstacle or contact pair in contact
     *  with the node at the end of the last step; 0 without contact. Stored at
     *  the first dof of the node. Without bonds, tension would depend on the
     *  second-order error of the gap to a rotating obstacle. */
    Vector &
    bonds_of_nodes()
    {
      return bonds;
    }
    /** @} */

  private:
    const Scene          &scene;
    const BackgroundMesh &mesh;
    const Space          &space;
    const MPI_Comm        comm;
    const bool            mesh_is_body;
    const Unknowns       *supports;

    /** Checks that no obstacle passes between nodes of a background mesh.
     *  Collective. @throws InputError for one that is thinner than a cell, unless it
     *  stays where nodes of each cell that it crosses are in or on it */
    void
    check_thin() const;

    /** Checks that no given node of a body-fitted mesh lies inside an obstacle.
     *  Collective. @throws InputError if an obstacle does */
    void
    check_overlap(const std::vector<unsigned int> &nodes) const;

    /** Returns true if boundary conditions prescribe the velocity component of
     *  a node along a given normal. */
    bool
    is_prescribed(const unsigned int            node,
                  const dealii::Tensor<1, dim> &normal) const;

    /** Position of a node: current position in a body-fitted mesh, fixed position
     *  in a background mesh. */
    dealii::Point<dim>
    place(const unsigned int node) const;

    /** Current position of an obstacle's centre. */
    dealii::Point<dim>
    centre(const unsigned int obstacle) const
    {
      return scene.obstacles.list[obstacle]->centre() +
             displacement[obstacle].centre;
    }

    /** A potential contact of a node and its gap (m). */
    struct PotentialContact
    {
      ContactNode contact;
      double      gap;
      double      closable_gap; ///< largest gap that the step can close (m)
    };
    /** Largest gap that can close during a step (m), see PotentialContact::closable_gap.
     *  @param u_n relative normal velocity at the beginning of the step h */
    double
    closable_gap(const double h, const double u_n) const;

    using NearBodies = std::map<unsigned int, PotentialContact>; ///< by node

    /** Computes the distance and the normal from a node to the nearest part of an
     *  obstacle's boundary.
     *  @param approach displacement of the obstacle relative to the node (m) */
    Obstacle::Nearest
    nearest(const unsigned int            obstacle,
            const unsigned int            node,
            const dealii::Tensor<1, dim> &approach,
            const Neighbours             &others) const;

    /** Checks that no obstacle has penetrated a supported node of a body-fitted mesh
     *  in a step. Such penetration causes no contact force. Collective.
     *  @throws StepFailure if an obstacle has penetrated a node that is supported
     *  along the contact normal */
    void
    check_held(const Contact &contact, const Vector &v, const double h) const;

    /** Appends all potential contacts of nodes with obstacles and other bodies to
     *  the list of the step. Collective. */
    void
    add_nodes(const Vector              &velocity_n,
              const double               h,
              const std::vector<Vector> &gaps,
              const NearBodies          &bodies,
              ContactStep               &step) const;

    /** Refuses contact of a node whose dofs are not along the axes.
     *  @param[in,out] refusal reason, if it is one */
    void
    refuse_turned(const unsigned int node,
                  const Obstacle    &obstacle,
                  std::string       &refusal) const;

    /** Appends the nearest potential contact of a node to the step. A second contact
     *  is appended if it has another normal and can also close.
     *  @param[in,out] refusal reason if that is impossible */
    void
    add_nearest(std::vector<PotentialContact> &near,
                std::string                   &refusal,
                ContactStep                   &step) const;

    /** Finds the potential contact nodes between bodies in a body-fitted mesh.
     *  Collective. */
    std::vector<FacingNode>
    find_facing(const Vector &velocity_n, const double h) const;

    /** Finds the potential contacts of nodes with other bodies. */
    NearBodies
    near_bodies(const Vector                  &velocity_n,
                const double                   h,
                const std::vector<FacingNode> &facing) const;

    /** Sets the friction coefficient, adhesion and tensile strength of a
     *  contact node from the interface law. */
    void
    apply_law(const InterfaceLaw &law, ContactNode &node) const;

    /** Contact force on a node, without components carried by supports (N/m). */
    static dealii::Tensor<1, dim>
    force(const Contact &contact, const unsigned int i);

    std::vector<unsigned int> candidates; ///< local nodes, with ghosts
    std::vector<bool> had_cells; ///< nodes of the body, before set_body_cells()
    std::optional<NodeSides> sides;     ///< for a body-fitted mesh only
    double                   size = 0.; ///< cell size (m)
    std::vector<RigidMotion> displacement, velocity;
    Vector                   nodal_displacement; ///< nodal displacements (m)
    Vector                   bonds; ///< bonds_of_nodes(), with ghosts

    std::optional<BodyContact> bodies; ///< empty without contact pairs
  };
} // namespace geocone::GEOCONE_DIM

#endif
