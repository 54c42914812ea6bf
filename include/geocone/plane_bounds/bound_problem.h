// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_plane_bounds_bound_problem_h
#define geocone_plane_bounds_bound_problem_h

#include <geocone/bounds/load_factor.h>
#include <geocone/bounds/spatial_strength.h>
#include <geocone/cone/second_order_cone.h>
#include <geocone/cone/strength_ellipse.h>
#include <geocone/functions/enclosed_formula.h>
#include <geocone/mesh/triangles.h>
#include <geocone/plane_bounds/interfaces.h>
#include <geocone/plane_bounds/plastic_bars.h>
#include <geocone/plane_bounds/point_strains.h>
#include <geocone/scene/scene.h>

#include <Eigen/Dense>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Yield cone |s_t| <= a s_n + k of a point, in scaled units. With tensile strength
   *  there is a second cone |s_t| <= s_n + cut_off (FlowCone::cut_off), or in lower
   *  bounds |s_t| <= cut_aperture s_n + cut_off, of a larger aperture than a. A cylinder
   *  without cut-off may have an ellipse as its section. */
  struct PointCone
  {
    double          a = 0., k = 0., cut_off = infinite_tension;
    StrengthEllipse ellipse      = {};
    double          cut_aperture = 1.;

    bool
    is_cut() const
    {
      return cut_off < infinite_tension;
    }

    /** Returns true if the yield cone is a cylinder, as for the Tresca
     *  criterion. */
    bool
    is_cylinder() const
    {
      return a == 0.;
    }

    /** Returns true if the flow is incompressible. The yield surface is then a cylinder,
     *  without a tension cut-off. */
    bool
    is_incompressible() const
    {
      return is_cylinder() && !is_cut();
    }
  };

  /** Placeholder yield cone of points that are excluded from the problem, i.e.
   *  have no dofs and a zero strain matrix. */
  constexpr PointCone inactive_cone = {0., 1.};

  /**
   * Discrete problem of limit analysis for a rigid-plastic body with associated flow. The
   * unknowns are velocities q. The points are the vertices of the triangles, with one
   * third of the area each:
   *   equilibrium  sum_p V_p B_p' s_p = lambda f + F0  in free dofs,
   *   strength     |s_t| <= a s_n + k,
   *   flow         -B_p q in K* = {a |e_t| <= -e_n}.
   * Strain rates and stresses are in cone axes (second_order_cone.h), all variables in
   * scaled units. Either f q = 1 and lambda is the load, or some velocities are
   * prescribed and the load is the power of the reactions.
   *
   * After the triangles come the faces of the interfaces, as cells of the same form: V is
   * a part of the length of an edge, B q the velocity of the body relative to the
   * obstacle. The velocities of the obstacles and then the cut_off rates of the
   * interfaces (Interface::opens()) follow the other dofs. Cells and dofs of structures
   * (bar_cells.h) follow those of interfaces.
   *
   * The last cells are the tension cut-offs of triangles. Their points have the stress of
   * the triangle, in the second cone of PointCone, and a strain rate w; the strain
   * rate of the triangle's points is then B q - w. Equilibrium for w states that both
   * stresses are the same, and the total dissipation is the infimal convolution of the
   * dissipation functions of cone and cut-off.
   */
  struct BoundProblem
  {
    PointStrains           B;      ///< B_p, three points per cell
    std::vector<double>    volume; ///< weight V_p of each point
    std::vector<PointCone> cone;   ///< yield cone of each point

    unsigned int n_triangles = 0;
    /** Index of the triangle that owns each additional cell: first the
     *  interface cells, then those of structures and of the tension cut-off. The
     *  order is that of these cells. */
    std::vector<unsigned int> owner;
    unsigned int n_bar_cells = 0; ///< cells of structures, after interfaces
    std::vector<unsigned int> cut;               ///< triangles with a cut-off
    unsigned int              first_cut_dof = 0; ///< nine dofs per cut-off

    std::vector<bool> is_prescribed; ///< true for prescribed dofs
    std::vector<bool> has_no_force;  ///< prescribed dofs without stresses
    Eigen::VectorXd   prescribed;    ///< prescribed velocities; 0 elsewhere
    Eigen::VectorXd   dead, live;    ///< F0 and f; f = 0: no load factor

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
    bool
    has_factor() const
    {
      return live.squaredNorm() > 0.;
    }
    bool
    has_incompressible() const;

    /** Returns the number of interface cells, which represent slip between the
     *  body and obstacles or fixed sides, and of cells of structures. */
    unsigned int
    n_interfaces() const
    {
      return owner.size() - cut.size();
    }

    /** Returns the index of the first point of structures. */
    unsigned int
    first_bar_point() const
    {
      return 3 * (n_triangles + n_interfaces() - n_bar_cells);
    }

    /** Returns the index of the first point of the cells that represent the
     *  tension cut-off. */
    unsigned int
    first_cut_point() const
    {
      return 3 * (n_triangles + n_interfaces());
    }

    /** Returns the index of the triangle's point that coincides with a given
     *  point of the additional cell for the tension cut-off. */
    unsigned int
    point_of_triangle(const unsigned int cut_point) const
    {
      return 3 * owner[cut_point / 3 - n_triangles] + cut_point % 3;
    }

    /** Returns true if the solver can scale down any equilibrium stresses to
     *  admissible stresses for a smaller load. There is then no dead load,
     *  cohesion is positive everywhere, and no ellipse has its centre off zero. */
    bool
    can_be_scaled() const;
    unsigned int
    n_unknowns() const;
  };

  /** Type of the bound: upper bound (kinematic) or lower bound (static). */
  enum class BoundSide
  {
    upper,
    lower
  };

  /** Cohesions that are formulas, enclosed by linear functions on each triangle. */
  struct EnclosedCohesion
  {
    /** Strength k of a material per unit of its cohesion; 0 for materials without a
     *  formula (scaled units of stress per Pa). */
    std::vector<double> k_per_cohesion;

    /** Cohesion of each triangle (Pa), 0 for materials without a formula. */
    std::vector<EnclosedFormula::OnSimplex> cohesion;

    bool
    has(const unsigned int material) const
    {
      return !k_per_cohesion.empty() && k_per_cohesion[material] > 0.;
    }
  };

  /**
   * Input of a plane or axisymmetric limit analysis on a mesh: scene, triangles, load
   * factor and strength of the materials.
   */
  struct BoundScene
  {
    const Scene           &scene;
    const Triangles       &triangles;
    LoadFactor             factor;
    BoundUnits             units;
    std::vector<PointCone> cones; ///< by material, in scaled units; plane only
    std::vector<Interface> interfaces;

    /** Increase of the strength k with depth, for each material (scaled units of stress,
     *  per m). */
    std::vector<Material::StrengthGradient> growth;

    EnclosedCohesion enclosed; ///< cohesions by formulas; plane only

    /** Strength of each material of an axisymmetric body, in scaled units. */
    std::vector<SpatialStrength> strengths;

    PlasticBars bars; ///< structures; their strengths are given, not reduced

    /** For each material the sine of a larger friction angle, for the same cohesion, whose
     *  cone must contain the stresses of lower bounds, too (IntervalBounds); 0 or no
     *  entry: none. It is the steeper cone near the apex. */
    std::vector<double> steeper = {};

    bool
    is_axisymmetric() const
    {
      return scene.geometry.is_axisymmetric();
    }

    /** Yield cone at a vertex of a triangle. In the triangle strength is linear; where
     *  it is a formula, it is not larger in lower bounds, and not smaller in upper ones.
     *  @param i index of the vertex in the triangle */
    PointCone
    cone_at(const BoundSide    side,
            const unsigned int cell,
            const unsigned int i) const
    {
      const unsigned int material = triangles.material[cell];
      PointCone          cone     = cones[material];
      cone.k +=
        growth[material].at(triangles.vertices[triangles.cells[cell][i]][1]);
      if (enclosed.has(material))
        {
          const auto &c = enclosed.cohesion[cell];
          cone.k += enclosed.k_per_cohesion[material] *
                    (side == BoundSide::lower ? c.below : c.above)[i];
        }
      if (side == BoundSide::lower && !steeper.empty() &&
          steeper[material] > cone.a)
        add_steeper(cone, steeper[material]);
      return cone;
    }

    /** Adds the cone with the sine b of a larger friction angle and the same cohesion as
     *  the second one of a point. A point with tensile strength has two cones already:
     *  its cut-off is reduced to where both cones cross, beyond which it is in both. */
    static void
    add_steeper(PointCone &cone, const double b);

    /** Returns the vector of live loads (multiplied by the load factor) or of
     *  dead loads (constant), depending on the type of the loads. */
    Eigen::VectorXd &
    loads(BoundProblem &problem, const LoadFactor kind) const;

    /** Sets tan(phi) of a material, sets its cohesion to k_factor times the
     *  present k = c cos(phi), and multiplies its tensile strength by
     *  tension_factor. */
    void
    change(const unsigned int material,
           const double       tan_phi,
           const double       k_factor,
           const double       tension_factor);
  };

  /**
   * Assembles the upper-bound problem with quadratic velocities, whose strain
   * rates are evaluated at the vertices of each triangle. Strain rates are
   * linear in a cell, so flow that is admissible at the vertices is admissible
   * everywhere, and the dissipation at the vertices is an upper estimate (exact
   * for a > 0): the result is an upper bound (Makrodimopoulos and Martin 2007).
   * Dofs: x and y of the vertices, then of the edges, then of the obstacles.
   * Points of an interface are coefficients in Bernstein's basis, whose convex
   * hull contains the relative velocity.
   */
  BoundProblem
  upper_problem(const BoundScene &scene);

  /**
   * Assembles the lower-bound problem in dual form, with linear stresses that
   * are discontinuous between triangles. The dual velocities are a translation
   * u of each triangle, and w at both ends of each edge,
   *   B_i q = -3 sym(u x grad lambda_i) + 3/(2A) sum_{e at i} L_e sym(w_ei x n_e).
   * Equilibrium of these rows is that of the continuum, so each admissible state is a
   * lower bound (dual of Makrodimopoulos and Martin 2006). Dofs: x and y of the
   * triangles, then of the two ends of the edges, then of the obstacles. Points of an
   * interface are the ends of its edge, half of its length each, and one that is unused.
   *
   * Cohesionless soil is free of stress at a free surface: tractions vanish there, so the
   * stress is at the apex and tractions vanish on all edges from that vertex. An
   * interior-point method needs stresses inside their cones, so points and ends at such
   * vertices are excluded.
   */
  BoundProblem
  lower_problem(const BoundScene &scene);
} // namespace geocone::GEOCONE_DIM

#endif
