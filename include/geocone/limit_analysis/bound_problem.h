// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_bound_problem_h
#define geocone_limit_analysis_bound_problem_h

#include <geocone/limit_analysis/interfaces.h>
#include <geocone/limit_analysis/point_strains.h>
#include <geocone/limit_analysis/triangles.h>
#include <geocone/scene/scene.h>

#include <Eigen/Dense>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** What the load factor of a limit analysis multiplies. */
  enum class LoadFactor
  {
    automatic,
    velocity,  ///< nothing: the load is the reaction to prescribed velocities
    weight,    ///< the weight; tractions are dead loads
    tractions, ///< the tractions; the weight is a dead load
    all        ///< weight and tractions
  };

  /**
   * The units in which a limit analysis computes: all numbers are of order one.
   */
  struct BoundUnits
  {
    double length   = 1.; ///< (m)
    double stress   = 1.; ///< (Pa)
    double velocity = 1.; ///< (m/s)
  };

  /** The cone of a point, in units: |s_t| <= a s_n + k. */
  struct PointCone
  {
    double a = 0., k = 0.;

    /** Tresca's cylinder, whose normal rate is zero. */
    bool
    is_cylinder() const
    {
      return a == 0.;
    }
  };

  /**
   * A rigid-plastic problem with associated flow in a space of velocities q, its
   * points at the vertices of the triangles, one third of the area each:
   *   equilibrium  sum_p V_p B_p' s_p = lambda f + F0  in free dofs,
   *   strength     |s_t| <= a s_n + k,
   *   flow         -B_p q in K* = {a |e_t| <= -e_n}.
   * Strains and stresses are in cone axes (second_order_cone.h), all in units.
   * Either f q = 1, and lambda is the load, or some velocities are prescribed, and
   * the load is the power of their reactions.
   *
   * After the triangles come the faces of the interfaces, as cells of the same form:
   * V is a part of an edge's length, B q the velocity of the body relative to the
   * obstacle, whose own velocity has the last dofs, before how far interfaces open
   * (Interface::opens()).
   */
  struct BoundProblem
  {
    PointStrains           B;      ///< three points of each cell
    std::vector<double>    volume; ///< of each point
    std::vector<PointCone> cone;   ///< of each point

    unsigned int              n_triangles = 0;
    std::vector<unsigned int> owner; ///< the triangle at each later cell

    std::vector<bool> is_prescribed; ///< by dof
    std::vector<bool> has_no_force;  ///< prescribed, too: no stress is there
    Eigen::VectorXd   prescribed;    ///< values there, or 0
    Eigen::VectorXd   dead, live;    ///< F0 and f by dof; f = 0: no factor

    unsigned int
    n_dofs() const
    {
      return prescribed.size();
    }
    unsigned int
    n_points() const
    {
      return volume.size();
    }
    unsigned int
    n_cells() const
    {
      return n_points() / 3;
    }
    bool
    has_factor() const
    {
      return live.squaredNorm() > 0.;
    }
    bool
    has_cylinders() const;

    /** Whether stresses that are scaled down bear a load that is scaled down: no
     *  load is dead, and there is cohesion everywhere. */
    bool
    can_be_scaled() const;
    unsigned int
    n_unknowns() const;
  };

  /** What of a scene a limit analysis is about. */
  struct BoundScene
  {
    const Scene           &scene;
    const Triangles       &triangles;
    LoadFactor             factor;
    BoundUnits             units;
    std::vector<PointCone> cones; ///< of the materials, in units
    std::vector<Interface> interfaces;

    /** How the k of cones grow with depth, of the materials (in units, per m). */
    std::vector<Material::Growth> growth;

    PointCone
    cone_at(const unsigned int material, const dealii::Point<dim> &x) const
    {
      return {cones[material].a, cones[material].k + growth[material].at(x[1])};
    }

    /** Makes a material's strength another one: tan(phi), and k over cos(phi) times a
     *  factor. */
    void
    change(const unsigned int material,
           const double       tan_phi,
           const double       k_factor);
  };

  /**
   * Quadratic velocities with the points at the vertices: strains are linear in a
   * cell, so flow that is admissible at its vertices is so everywhere, and the
   * dissipation of the vertices is an upper estimate (exact for a > 0): what it
   * gives is an upper bound (Makrodimopoulos and Martin 2007). Dofs: x and y of
   * the vertices, then of the edges, then of the obstacles. Points of an interface
   * are the values of Bernstein's basis, between which the relative velocity is.
   */
  BoundProblem
  upper_problem(const BoundScene &scene);

  /**
   * The dual of linear stresses that are discontinuous between triangles, in its
   * velocities: a translation u of each triangle and w at both ends of each edge,
   *   B_i q = -3 sym(u x grad lambda_i) + 3/(2A) sum_{e at i} L_e sym(w_ei x n_e).
   * Equilibrium of these rows is that of the continuum, so each admissible state
   * is a lower bound (dual of Makrodimopoulos and Martin 2006). Dofs: x and y of
   * the triangles, then of the two ends of the edges, then of the obstacles. Points
   * of an interface are the ends of its edge, half of its length each, and one that
   * has no part in anything.
   *
   * At a free surface soil without cohesion has no stress: tractions vanish on the
   * surface, so the stress is at the apex, so they vanish on all edges from there.
   * No stress is inside its cone there, as an interior-point method asks; so points
   * and ends at such vertices have no part in anything either.
   */
  BoundProblem
  lower_problem(const BoundScene &scene);
} // namespace geocone::GEOCONE_DIM

#endif
