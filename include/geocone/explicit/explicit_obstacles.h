// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_explicit_explicit_obstacles_h
#define geocone_explicit_explicit_obstacles_h

#include <geocone/conditions/prescribed_node.h>
#include <geocone/contact/contact.h>
#include <geocone/contact/particle_contact.h>
#include <geocone/explicit/exchange.h>
#include <geocone/scene/scene.h>
#include <geocone/transfer/grid_transfer.h>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Contact of the points with rigid obstacles in explicit steps. Contact nodes are those
   * in an obstacle or within half a cell of it, with the gap g of the nearest particle
   * that they move. After the forces have changed the
   * nodal velocities to v*, the force q of the obstacle follows from Signorini's and
   * Coulomb's laws (Contact) with the lumped mass m of the node,
   *   v = v* + dt q/m,   0 <= q_N  _|_  u_N >= -g/dt,   |q_T| <= mu q_N,
   * where u is the velocity relative to the obstacle. Free motions y of an obstacle
   * satisfy M (y - y_0)/dt + sum G' q = 0 (ObstacleMotions). Nodes in a corner of two
   * obstacles have the forces of both, by sweeps over them.
   */
  class ExplicitObstacles
  {
  public:
    /** @param transfer of the points; must outlive this object */
    ExplicitObstacles(const Scene   &scene,
                      GridTransfer  &transfer,
                      const MPI_Comm comm);

    /** Checks the obstacles and that no point is in one of them. Collective.
     *  @throws InputError for interface laws that explicit steps do not have */
    void
    check(const std::vector<PointArrays> &groups) const;

    /** Lists the points near the obstacles, after the points or nodes were sorted. */
    void
    list_points(const std::vector<PointArrays> &groups);

    /** Finds the potential contact nodes of a step and the motions of the obstacles
     *  without contact. Collective.
     *  @param points speeds and bounding box of the points */
    void
    begin_step(const std::vector<PointArrays> &groups,
               const PassSums                 &points,
               const double                    t,
               const double                    dt);

    /** Marks the velocity components of the potential contact nodes of the step. */
    void
    mark(std::vector<unsigned char> &components) const;

    /** Adds the contact forces to the nodal velocities and their increments
     *  (GridTransfer::read). Collective if obstacles are free.
     *  @param is_prescribed per velocity component
     *  @param least_mass nodes with this mass or less are skipped
     *  @param[in,out] sum impulses, work and dissipation of this rank */
    void
    push(const std::vector<unsigned char> &is_prescribed,
         const double                      least_mass,
         Exchange                         &sum);

    /** Imposes the contacts of push() on the velocities with which the points move,
     *  where those are computed anew. */
    void
    hold(const std::vector<unsigned char> &is_prescribed,
         const double                      least_mass);

    /** Moves the obstacles at the end of a step. */
    void
    move();

    /** Returns the contribution of this rank to the impulse of each obstacle on the
     *  body since the last call, with moments about the given centre or that of the
     *  obstacle. */
    std::vector<Reaction>
    take_impulses();

    /** Impulses of the obstacles in the last step that went into supports, by node of
     *  this rank. */
    const std::map<unsigned int, dealii::Tensor<1, dim>> &
    impulses_on_supports() const
    {
      return on_supports;
    }

    /** Displacements of the obstacles since the start of the run. */
    const std::vector<RigidMotion> &
    moved() const
    {
      return displacement;
    }

    /** @name State in a checkpoint */
    /** @{ */
    void
    state_of_all(StateRow &row)
    {
      for (unsigned int o = 0; o < displacement.size(); ++o)
        row(displacement[o], velocity[o]);
    }
    void
    state_of_ranks(StateRow &row)
    {
      for (Reaction &one : impulse)
        row(one);
    }
    /** @} */

  private:
    /** Contacts of a node: a range of `contacts`, more than one in corners. */
    struct Node
    {
      unsigned int number, begin, end;
    };

    /** Largest velocity of any obstacle at the points (m/s). */
    double
    fastest(const PassSums &points) const;

    /** Computes the gaps of the nodes that move points near an obstacle.
     *  @return their numbers, in increasing order. Collective. */
    std::vector<unsigned int>
    find_gaps(const std::vector<PointArrays> &groups);

    /** Appends the contacts of a node with the obstacles on whose surface it is: the
     *  nearest one, and others with other normals, as many as there are directions. */
    void
    add_contacts(const unsigned int             number,
                 const std::vector<Neighbours> &others);

    /** Removes the prescribed components of a vector at a node. */
    dealii::Tensor<1, dim>
    free_part(dealii::Tensor<1, dim>            x,
              const unsigned int                node,
              const std::vector<unsigned char> &is_prescribed) const;

    /** Removes nodes without mass, restricts contacts to the free directions, and takes
     *  the velocities of the nodes. */
    void
    drop_supported(const std::vector<unsigned char> &is_prescribed,
                   const double                      least_mass);

    /** Adds the contact forces to the velocity of a node.
     *  @return mean of its velocities before and after the step */
    dealii::Tensor<1, dim>
    act_on(const Node &node);

    /** Contact forces of a node for given motions of the obstacles, in `forces`. */
    void
    solve(const Node &node);

    dealii::Tensor<1, dim>
    centre(const unsigned int obstacle) const;

    /** Distance below which the boundaries of two obstacles are continuous (m). */
    double
    margin() const
    {
      return continuity_tolerance * transfer.cell_size();
    }

    const Scene   &scene;
    GridTransfer  &transfer;
    const MPI_Comm comm;

    std::vector<RigidMotion> displacement, velocity;
    std::vector<Reaction>    impulse; ///< of this rank, since take_impulses()

    /** Point near some obstacles. */
    struct NearPoint
    {
      unsigned int group, index;
      ObstacleSet  obstacles;
    };
    /** Points that may touch an obstacle before they and it have `travelled` by some
     *  cells. */
    std::vector<NearPoint>                   near;
    double                                   travelled = 0.; ///< (m)
    std::vector<dealii::Point<dim>>          positions;      ///< of the nodes
    ParticleGaps                             particle;

    /** Gap of the nearest particle (m), by obstacle and node; infinite outside of
     *  begin_step(). */
    std::vector<std::vector<double>> gaps;

    /** @name Of the current step */
    /** @{ */
    double                           dt       = 0.;
    double                   closable = 0.; ///< larger gaps stay open (m)
    std::vector<ContactNode> contacts;
    std::vector<Contact::Projection> forces; ///< of `contacts`

    std::map<unsigned int, dealii::Tensor<1, dim>>
                on_supports; ///< of impulses_on_supports()
    std::string refusal; ///< contacts that cannot be resolved
    std::vector<Node>                nodes;
    std::vector<Contact::Local>      locals; ///< of `nodes`
    ObstacleMotions                  motions;
    /** @} */
  };
} // namespace geocone::GEOCONE_DIM

#endif
