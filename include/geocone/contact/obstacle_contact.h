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
  /** What touches in a step, of all ranks. */
  struct ContactReport
  {
    unsigned int open = 0, stick = 0, slip = 0; ///< nodes
    double       error = 0.; ///< largest |F| over the sum of |r| + rho |u|
    double       penetration = 0.; ///< greatest (m)
    /** Where the mesh is the body: width of what is closed, and of what of it sticks
     *  (m), greatest pressure and shear traction (Pa). */
    double width = 0., stick_width = 0., pressure = 0., shear = 0.;
    double work        = 0.; ///< of the step, of the forces on the body (J/m)
    double dissipation = 0.; ///< of the step, of friction and impact (J/m)

    /** What the force of an impact on a node that rebounds does at the mean of its
     *  velocities before and after, over what it does at the last one, which work and
     *  dissipation count (J/m, not positive). */
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
   * The obstacles of a scene as they move, and the nodes that may touch them or other
   * bodies: of a mesh that is the body those of its boundary, which carry the gap with them; of
   * a background mesh those in or on the obstacle, with the gap of the nearest
   * particle that they move.
   */
  class ObstacleContact
  {
  public:
    /** @param supports of a mesh that is the body, which has to stay; null where
     *  particles are
     *  @throws InputError if the body overlaps with an obstacle. Collective. */
    ObstacleContact(const Scene          &scene,
                    const BackgroundMesh &mesh,
                    const Space          &space,
                    const Unknowns       *supports);

    /**
     * Of a mesh that is the body: these cells of this rank are there from now on, with
     * what bounds them. Nodes that come to the body have moved nothing.
     * @throws InputError if an obstacle overlaps with them. Collective.
     */
    void
    take_body(const std::vector<BackgroundMesh::Cell> &cells);

    /** Whether there are obstacles, or bodies that may touch each other. */
    bool
    exists() const
    {
      return scene.has_contact();
    }

    /**
     * The nodes and the obstacles of a step from t to t + h.
     * @param velocity_n at t_n, with ghosts
     * @param solved_h what is solved for: theta h by the theta-scheme
     * @param gaps of a background mesh: per obstacle the gap to it of the nearest
     * particle that a node moves, by its first dof, with ghosts
     * @param facing of a background mesh: the nodes of bodies that may touch
     * @throws StepFailure if a node touches three things at once, or see
     * BodyContact::find(), ParticleBodies::find()
     */
    ContactStep
    begin(const Vector              &velocity_n,
          const double               t,
          const double               h,
          const double               solved_h,
          const std::vector<Vector> &gaps   = {},
          std::vector<FacingNode>    facing = {}) const;

    /** What came of a step, before commit(). Collective. */
    ContactReport
    report(const Contact &contact, const Vector &v, const double h) const;

    /** The force of each obstacle on the body, then of each other body on the first one
     *  of a contact, and their moments, about the given centre or that of the obstacle,
     *  or the origin. Collective. */
    std::vector<Reaction>
    reactions(const Contact &contact) const;

    /** Adds to the displacements of supports those of a step: of the obstacles, then of
     *  the first body of each contact against the other one, the mean of what touches.
     *  @param first number of the first of these supports. Collective. */
    void
    add_displacements(const Contact                       &contact,
                      const Vector                        &v,
                      const double                         h,
                      const unsigned int                   first,
                      std::vector<dealii::Tensor<1, dim>> &supports) const;

    /**
     * For the theta-scheme: nodes that touch keep the velocity against the obstacle
     * that was solved for, where the one at the end of the step is larger. Extrapolated
     * like others they would rebound in each step, and their forces alternate.
     * @param unknowns what is held stays as it is @param v solved for @param mass of the
     *  nodes @param[in,out] v_end
     * @return the kinetic energy that this takes (J/m), >= 0. Collective.
     */
    double
    settle(const Contact  &contact,
           const Unknowns &unknowns,
           const Vector   &v,
           const Vector   &mass,
           Vector         &v_end) const;

    /** Takes the velocities of the obstacles, and moves them and, where the mesh is
     *  the body, its nodes.
     *  @param moves whether places change, and not velocities only
     *  @throws StepFailure if an obstacle enters what is held. Collective. */
    void
    commit(const Contact &contact,
           const Vector  &v,
           const double   h,
           const double   solved_h,
           const bool     moves);

    /** Up to which distance boundaries of obstacles meet, see Neighbours (m). */
    double
    margin() const
    {
      return meeting * size;
    }

    /** What the obstacles have moved. */
    const std::vector<RigidMotion> &
    moved() const
    {
      return displacement;
    }

    /** @name The state: of the obstacles what they have moved, and their velocities;
     *  where the mesh is the body, displacements of its nodes, since the start */
    /** @{ */
    void
    state(StateRow &row)
    {
      row(displacement, velocity);
    }
    Vector &
    displacement_of_nodes()
    {
      return path;
    }

    /** Whether what touches may bear a pull. */
    bool
    has_bonds() const;

    /** By the first dof of each node one more than the number of what it touched at the
     *  end of the last step, or 0. What it bears by that must not depend on a gap that
     *  is an error of the second order, of an obstacle that turns. */
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

    /** @throws InputError if an obstacle overlaps with these nodes of a body whose mesh
     *  it is. Collective. */
    void
    check_overlap(const std::vector<unsigned int> &nodes) const;

    /** Whether boundary conditions hold a node of the mesh against something with this
     *  normal. */
    bool
    is_held(const unsigned int            node,
            const dealii::Tensor<1, dim> &normal) const;

    /** Where a node of the body is, or of the background mesh. */
    dealii::Point<dim>
    place(const unsigned int node) const;

    /** The obstacle's centre as it is. */
    dealii::Point<dim>
    centre(const unsigned int obstacle) const
    {
      return scene.obstacles.list[obstacle]->centre() +
             displacement[obstacle].centre;
    }

    /** A contact of a node, and its gap (m). */
    struct Near
    {
      ContactNode contact;
      double      gap;
      double      reach; ///< what the gap may be to be closed in the step (m)
    };
    /** Near::reach. @param u_n relative velocity at the beginning of the step, of h */
    double
    reach(const double h, const double u_n) const;

    using NearBodies = std::map<unsigned int, Near>; ///< by node

    /** The part of an obstacle's boundary that is nearest to a node.
     *  @param approach of the obstacle against the node (m) */
    Obstacle::Nearest
    nearest(const unsigned int            obstacle,
            const unsigned int            node,
            const dealii::Tensor<1, dim> &approach,
            const Neighbours             &others) const;

    /** Of a mesh that is the body, after a step. No force would tell it.
     *  @throws StepFailure if an obstacle has entered a node that boundary conditions
     *  hold against it. Collective. */
    void
    check_held(const Contact &contact, const Vector &v, const double h) const;

    /** The nodes that may touch obstacles, or other bodies. Collective. */
    void
    add_nodes(const Vector              &velocity_n,
              const double               h,
              const std::vector<Vector> &gaps,
              const NearBodies          &bodies,
              ContactStep               &step) const;

    /** Of a node: the contact that is nearest, and where another one may be closed with
     *  it, with another normal, that one, too.
     *  @param[in,out] refusal why that cannot be */
    void
    add_nearest(std::vector<Near> &near,
                std::string       &refusal,
                ContactStep       &step) const;

    /** The nodes of bodies whose mesh they are that may touch. Collective. */
    std::vector<FacingNode>
    find_facing(const Vector &velocity_n, const double h) const;

    /** The nodes that may touch other bodies. */
    NearBodies
    near_bodies(const Vector                  &velocity_n,
                const double                   h,
                const std::vector<FacingNode> &facing) const;

    /** Sets what the interface bears at a node, of which the rest is known. */
    void
    bear(const InterfaceLaw &law, ContactNode &node) const;

    /** The force on a node: what supports hold of it is theirs. */
    static dealii::Tensor<1, dim>
    force(const Contact &contact, const unsigned int i);

    std::vector<unsigned int> candidates; ///< local nodes, with ghosts
    std::vector<bool> had_cells;    ///< nodes of the body, before take_body()
    std::optional<NodeSides> sides; ///< of a mesh that is the body
    double                   size = 0.; ///< of a cell (m)
    std::vector<RigidMotion> displacement, velocity;
    Vector                   path;  ///< of the nodes of the body (m)
    Vector                   bonds; ///< see bonds_of_nodes(), with ghosts

    std::optional<BodyContact> bodies; ///< where there are contacts
  };
} // namespace geocone::GEOCONE_DIM

#endif
