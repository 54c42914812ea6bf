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
  /** Contact statistics of a step, over all ranks. */
  struct ContactReport
  {
    unsigned int open = 0, stick = 0, slip = 0; ///< nodes
    double       error = 0.; ///< largest |F| over the sum of |r| + rho |u|
    double       penetration = 0.; ///< greatest (m)
    /** For body-fitted meshes: width of closed and of sticking contact (m),
     *  largest pressure and shear traction (Pa). */
    double width = 0., stick_width = 0., pressure = 0., shear = 0.;
    double work        = 0.; ///< of the contact forces on the body (J/m)
    double dissipation = 0.; ///< by friction and impact (J/m)

    /** Work of impact forces on rebounding nodes by the mean of the velocities
     *  before and after, less their work by the final velocity, which is
     *  included in work and dissipation (J/m, not positive). */
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
   * Moving obstacles of a scene and the nodes that may contact them or other
   * bodies. In a body-fitted mesh these are boundary nodes, which carry the gap
   * with them. In a background mesh they are the nodes in or on the obstacle,
   * with the gap of the nearest particle that they move.
   */
  class ObstacleContact
  {
  public:
    /** @param supports for a body-fitted mesh, which must outlive this object;
     *  null for particles
     *  @throws InputError if the body overlaps with an obstacle. Collective. */
    ObstacleContact(const Scene          &scene,
                    const BackgroundMesh &mesh,
                    const Space          &space,
                    const Unknowns       *supports);

    /**
     * Sets the cells of the body in a body-fitted mesh from now on: those of
     * this rank, with their boundary. New nodes of the body have zero
     * displacement.
     * @throws InputError if an obstacle overlaps with them. Collective.
     */
    void
    take_body(const std::vector<BackgroundMesh::Cell> &cells);

    /** Whether there are obstacles or contacts between bodies. */
    bool
    exists() const
    {
      return scene.has_contact();
    }

    /**
     * Potential contact nodes and obstacles of a step from t to t + h.
     * @param velocity_n at t_n, with ghosts
     * @param solved_h time increment of the solution: theta h by the
     * theta-scheme
     * @param gaps for a background mesh: per obstacle, the gap of the nearest
     * particle moved by a node, by its first dof, with ghosts
     * @param facing for a background mesh: the nodes of bodies that may touch
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

    /** Statistics of a step, before commit(). Collective. */
    ContactReport
    report(const Contact &contact, const Vector &v, const double h) const;

    /** Forces of each obstacle on the body, then of each other body on the
     *  first one of a contact, with moments about the given centre, that of the
     *  obstacle, or the origin. Collective. */
    std::vector<Reaction>
    reactions(const Contact &contact) const;

    /** Adds the displacements of supports in a step: of the obstacles, then,
     *  for each contact, of the first body relative to the other one, averaged
     *  over active contacts.
     *  @param first number of the first of these supports. Collective. */
    void
    add_displacements(const Contact                       &contact,
                      const Vector                        &v,
                      const double                         h,
                      const unsigned int                   first,
                      std::vector<dealii::Tensor<1, dim>> &supports) const;

    /**
     * Limits the final velocity of contact nodes relative to the obstacle, for
     * the theta-scheme: nodes in contact retain the velocity at theta if the
     * extrapolated one is larger. Otherwise they would rebound in each step,
     * with alternating forces.
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

    /** Adopts the velocities of the obstacles and moves them and, for a
     *  body-fitted mesh, its nodes.
     *  @param moves whether to change positions, in addition to velocities
     *  @throws StepFailure if an obstacle penetrates supported nodes.
     *  Collective. */
    void
    commit(const Contact &contact,
           const Vector  &v,
           const double   h,
           const double   solved_h,
           const bool     moves);

    /** Distance up to which boundaries of obstacles are joined, see Neighbours
     *  (m). */
    double
    margin() const
    {
      return meeting * size;
    }

    /** Displacements of the obstacles since the start. */
    const std::vector<RigidMotion> &
    moved() const
    {
      return displacement;
    }

    /** @name State: displacements since the start and velocities of the
     *  obstacles; for a body-fitted mesh also the displacements of its nodes */
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

    /** Whether contacts may carry tension. */
    bool
    has_bonds() const;

    /** Bonds of nodes: by the first dof, one plus the number of the contact at
     *  the end of the last step, or 0. The tension of a bond must not depend on
     *  the second-order error of the gap to a rotating obstacle. */
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

    /** @throws InputError if an obstacle overlaps with these nodes of a
     *  body-fitted mesh. Collective. */
    void
    check_overlap(const std::vector<unsigned int> &nodes) const;

    /** Whether boundary conditions prescribe the velocity of a node along this
     *  normal. */
    bool
    is_held(const unsigned int            node,
            const dealii::Tensor<1, dim> &normal) const;

    /** Current position of a node of a body-fitted mesh, or position in a
     *  background mesh. */
    dealii::Point<dim>
    place(const unsigned int node) const;

    /** Current centre of the obstacle. */
    dealii::Point<dim>
    centre(const unsigned int obstacle) const
    {
      return scene.obstacles.list[obstacle]->centre() +
             displacement[obstacle].centre;
    }

    /** A contact of a node and its gap (m). */
    struct Near
    {
      ContactNode contact;
      double      gap;
      double      reach; ///< largest gap closed in the step (m)
    };
    /** Near::reach. @param u_n relative normal velocity at the beginning of the
     *  step h */
    double
    reach(const double h, const double u_n) const;

    using NearBodies = std::map<unsigned int, Near>; ///< by node

    /** Part of an obstacle's boundary that is nearest to a node.
     *  @param approach of the obstacle relative to the node (m) */
    Obstacle::Nearest
    nearest(const unsigned int            obstacle,
            const unsigned int            node,
            const dealii::Tensor<1, dim> &approach,
            const Neighbours             &others) const;

    /** Checks supported nodes of a body-fitted mesh after a step, which
     *  penetration would not affect otherwise.
     *  @throws StepFailure if an obstacle has penetrated a node supported
     *  against it. Collective. */
    void
    check_held(const Contact &contact, const Vector &v, const double h) const;

    /** Adds the nodes that may contact obstacles or other bodies.
     *  Collective. */
    void
    add_nodes(const Vector              &velocity_n,
              const double               h,
              const std::vector<Vector> &gaps,
              const NearBodies          &bodies,
              ContactStep               &step) const;

    /** Adds the nearest contact of a node and, if it may also be closed, a
     *  second one with another normal.
     *  @param[in,out] refusal reason if that is impossible */
    void
    add_nearest(std::vector<Near> &near,
                std::string       &refusal,
                ContactStep       &step) const;

    /** Potential contact nodes between bodies with body-fitted meshes.
     *  Collective. */
    std::vector<FacingNode>
    find_facing(const Vector &velocity_n, const double h) const;

    /** Potential contacts of nodes with other bodies. */
    NearBodies
    near_bodies(const Vector                  &velocity_n,
                const double                   h,
                const std::vector<FacingNode> &facing) const;

    /** Sets the strength of the interface at a node, by its other data. */
    void
    apply_law(const InterfaceLaw &law, ContactNode &node) const;

    /** Contact force on a node, without the part carried by supports. */
    static dealii::Tensor<1, dim>
    force(const Contact &contact, const unsigned int i);

    std::vector<unsigned int> candidates; ///< local nodes, with ghosts
    std::vector<bool> had_cells;    ///< nodes of the body, before take_body()
    std::optional<NodeSides> sides; ///< of a body-fitted mesh only
    double                   size = 0.; ///< of a cell (m)
    std::vector<RigidMotion> displacement, velocity;
    Vector                   path;  ///< of the nodes of the body (m)
    Vector                   bonds; ///< see bonds_of_nodes(), with ghosts

    std::optional<BodyContact> bodies; ///< where there are contacts
  };
} // namespace geocone::GEOCONE_DIM

#endif
