// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_axisymmetric_bounds_axisymmetric_bounds_h
#define geocone_axisymmetric_bounds_axisymmetric_bounds_h

#include <geocone/bounds/bernstein.h>
#include <geocone/bounds/facet_condition.h>
#include <geocone/conic/conic_solver.h>
#include <geocone/plane_bounds/bound_problem.h>

#include <array>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Input of an axisymmetric limit analysis on a mesh, in scaled units: geometry,
   * prescribed velocities and loads. x is the radius r and y the coordinate z along the
   * axis. All integrals are per radian.
   */
  class AxisymmetricScene
  {
  public:
    /** @throws InputError if strict bounds cannot be computed */
    explicit AxisymmetricScene(const BoundScene &bound);

    /** Checks the supports. @throws InputError if the body can move along the axis */
    void
    check_support() const;

    /** Returns true if the load factor multiplies a load that is not zero. */
    bool
    has_live_load() const;

    /** Returns the scene with the weight of one material as its only load, which is
     *  live. */
    AxisymmetricScene
    with_weight_of(const unsigned int material) const;

    /** Returns the scene with one traction as its only load, which is live. */
    AxisymmetricScene
    with_traction(const BoundaryCondition &load) const;

    /** Body force or traction. The dead part is constant; the live part is multiplied
     *  by the load factor. */
    struct Load
    {
      dealii::Tensor<1, dim> dead, live;
    };

    /** Edge between cells, or on the boundary. */
    struct Edge
    {
      static constexpr unsigned int none = -1;

      std::array<unsigned int, 2> cells = {{none, none}};
      double                      length;
      dealii::Tensor<1, dim>      normal; ///< outward from the first cell
      bernstein::Linear<2>        radius;
      FacetCondition              condition;
      std::array<Load, 2>         traction; ///< at the vertices

      bool
      is_inner() const
      {
        return cells[1] != none;
      }
      /** Returns true if the edge has no area: it is on the axis. */
      bool
      is_on_axis() const
      {
        return radius[0] == 0. && radius[1] == 0.;
      }
      /** Returns the tangent of the edge. */
      dealii::Tensor<1, dim>
      tangent() const
      {
        return dealii::Tensor<1, dim>({-normal[1], normal[0]});
      }
    };

    struct Cell
    {
      double                                area;
      std::array<dealii::Tensor<1, dim>, 3> gradients; ///< of the coordinates
      bernstein::Linear<3>                  radius, strength;
      Load                                  body_force;
    };

    /** Returns the material whose strength limits the jump at an edge. Between two
     *  materials it is the one with the smaller cohesion, since the crack may be in
     *  either. @param[out] cohesion at the vertices of the edge */
    const SpatialStrength &
    strength_of_jump(const unsigned int    edge,
                     bernstein::Linear<2> &cohesion) const;

    const BoundScene &bound;
    std::vector<Cell> cells;
    std::vector<Edge> edges;

  private:
    /** Place of an edge, without units. */
    FacetPlace
    place_of(const unsigned int edge) const;

    void
    add_traction(const BoundaryCondition &load, const bool is_live);

    AxisymmetricScene
    without_loads() const;
  };

  /**
   * Velocities of the upper bound: u_r = r v and u_z = w in each triangle, with
   * polynomials v of the order 2 and w of the order 3 in the Bernstein basis. The strain
   * rates (e_rr, e_zz, sqrt2 e_rz, e_tt) are then polynomials of order 2, and jumps at
   * edges of order 3. The space contains all incompressible velocities of order 3: where
   * div u = 0, u_r is divisible by r.
   *
   * Dofs: v and w of each triangle, then two for each velocity of a held side.
   */
  namespace axisymmetric_velocity
  {
    constexpr unsigned int order   = 2; ///< of the strain rates
    constexpr unsigned int n_v     = bernstein::n_in_triangle(order);
    constexpr unsigned int n_w     = bernstein::n_in_triangle(order + 1);

    inline unsigned int
    dof_of_v(const unsigned int cell, const bernstein::Exponents<3> &a)
    {
      return (n_v + n_w) * cell + bernstein::position(a);
    }
    inline unsigned int
    dof_of_w(const unsigned int cell, const bernstein::Exponents<3> &a)
    {
      return (n_v + n_w) * cell + n_v + bernstein::position(a);
    }
  } // namespace axisymmetric_velocity

  /**
   * Assembles the upper-bound problem of an axisymmetric body, with velocities that jump
   * at all edges. Rates and jumps are in the hull of their coefficients, so flow that is
   * admissible for these is admissible everywhere, and the integral of the dissipation is
   * at most that of the coefficients, since it is convex and homogeneous.
   */
  ConicProblem
  upper_problem(const AxisymmetricScene &scene);

  /** Stresses r (s_rr, s_zz, sqrt2 s_rz, s_tt) of the lower bound: polynomials of the
   *  order 2 in each triangle, in the Bernstein basis. Polynomials without the factor r
   *  would be too stiff: with a free surface the force along the axis could not decrease
   *  with the radius but as r^2. */
  namespace axisymmetric_stress
  {
    constexpr unsigned int order = 2;
    constexpr unsigned int n     = bernstein::n_in_triangle(order);
  } // namespace axisymmetric_stress

  /**
   * Assembles the lower-bound problem of an axisymmetric body, with stresses that are
   * discontinuous at all edges. With S = r s, equilibrium is
   *   r (d S_rr/dr + d S_rz/dz) - S_tt + r^2 b_r = 0,
   *   d S_rz/dr + d S_zz/dz + r b_z = 0,
   * polynomials whose coefficients vanish; so do those of the difference of the tractions
   * on each edge. The coefficients of S are in the cone for those of r k, where r k is
   * the strength times r, and hence S is so everywhere. On the axis S vanishes, so that s
   * is bounded.
   *
   * Dofs, dual to the equations: nine for each triangle, then two for each coefficient of
   * each edge.
   */
  ConicProblem
  lower_problem(const AxisymmetricScene &scene);

  /** Returns a problem with its dofs and forces, and without points. */
  ConicProblem
  forces_of(const AxisymmetricScene &scene, const BoundSide side);

  /** Returns a coefficient of the traction on a boundary edge times r. */
  AxisymmetricScene::Load
  traction_coefficient(const AxisymmetricScene::Edge &edge,
                       const unsigned int             k);
} // namespace geocone::GEOCONE_DIM

#endif
