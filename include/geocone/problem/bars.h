// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_problem_bars_h
#define geocone_problem_bars_h

#include <geocone/base/state_row.h>
#include <geocone/conditions/constraints.h>
#include <geocone/contact/low_rank.h>
#include <geocone/problem/term.h>
#include <geocone/scene/structures.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** A bar at the end of a step; zero where it is not installed. Or the bending
   *  at a node of a plate: a moment (N) and rotations. */
  struct BarState
  {
    double force      = 0.; ///< axial, tension positive (N/m)
    double elongation = 0.; ///< since it was installed (m)
    double plastic    = 0.; ///< plastic part of the elongation (m)
    bool   yields     = false;

    void
    state(StateRow &row)
    {
      row(force, elongation, plastic, yields);
    }
  };

  /** One end of a segment of a plate. Moments are positive with tension on the
   *  right-hand side of the polyline, shear forces are their derivative. */
  struct PlatePoint
  {
    double                 arc = 0.;     ///< distance along the polyline (m)
    dealii::Point<dim>     x;            ///< initial place (m)
    dealii::Tensor<1, dim> displacement; ///< since it was installed (m)
    double                 normal = 0.;  ///< tension positive (N/m)
    double                 shear  = 0.;  ///< (N/m)
    double                 moment = 0.;  ///< (N)
    double                 hinge  = 0.;  ///< plastic rotation (-)

    void
    state(StateRow &row)
    {
      row(arc, x, displacement, normal, shear, moment, hinge);
    }
  };

  inline double
  size_of_moment(const PlatePoint &point)
  {
    return std::abs(point.moment);
  }

  inline double
  size_of_displacement(const PlatePoint &point)
  {
    return point.displacement.norm();
  }

  /** A plate at the end of a step; zero where it is not installed. */
  struct PlateState
  {
    bool         acts     = false;
    unsigned int n_hinges = 0; ///< where it yields in bending

    /** Both ends of each segment, in which normal and shear forces are
     *  constant. */
    std::vector<PlatePoint> points;

    /** The point of a largest value, of those that are equal the first one. */
    template <typename Value>
    const PlatePoint &
    largest(const Value &value) const
    {
      return *std::max_element(points.begin(),
                               points.end(),
                               [&](const PlatePoint &a, const PlatePoint &b) {
                                 return value(a) < value(b);
                               });
    }

    void
    state(StateRow &row)
    {
      row(acts, n_hinges, points);
    }
  };

  /**
   * Bars between points of the body, or a point of it and a fixed one outside:
   * anchors, struts, geogrids, and the segments of plates. With the row b of a bar, b.v the rate of its
   * elongation e, the axial force at the end of a step is the projection
   *   N = P(N_0 + k (e + h b.v - e_p)),  k = EA/L,  P on [-N_c, N_t],
   * the closed form of the complementarity between force and plastic
   * elongation e_p, see doc/theory/structures.md. Without compressive strength
   * a bar is slack instead of yielding. The term is R = sum N b.
   *
   * The bending at a node of a plate follows the same law: b.v is the rate of the
   * change of slope between its segments, N the moment, k = EI over their mean
   * length.
   *
   * The derivative h k b b' for elastic bars couples nodes that share no cell.
   * It is assembled for the bars of chains, which are short; for long ones, or if
   * no rank has all nodes, it is a low-rank update of the Jacobian (LowRank).
   */
  class Bars : public Term
  {
  public:
    /** @throws InputError for a point outside of the body that is not the fixed
     *  end of an anchor or strut. Collective. */
    Bars(const Structures     &structures,
         const BackgroundMesh &mesh,
         const Space          &space);

    /** Installs and removes bars at the beginning of a stage, and sets the step
     *  size h (s) and the rows along rotated dofs. Collective.
     *  @throws RunError if a bar is tied to a removed part of the body */
    void
    begin_step(const std::string &stage,
               const double       h,
               const Constraints &constraints);

    void
    residual(Vector &part, const Vector &v, const LocalLaw &law) override;

    void
    apply_tangent(Vector &dst, const Vector &dv) const override;

    void
    add_elastic_diagonal(Vector &dst) const override;

    std::vector<std::vector<unsigned int>>
    node_groups() const override;

    /** Adds the derivative of the assembled bars. */
    void
    linearise(const JacobianPattern &pattern,
              const double           elastic_blend,
              SparseMatrix          &matrix) const override;

    /** Derivative of the other bars at the last residual(), by owned free rows.
     *  @param elastic_blend as in linearise() */
    LowRank
    low_rank(const double elastic_blend) const;

    /** Power of the bars on the body at the last residual() (W/m). */
    double
    power() const;

    /** Accepts the forces of the last residual(). */
    void
    commit();

    /** Bars of all structures but plates, as Structures::names_of_bars(). */
    std::vector<BarState>
    states_of_bars() const;

    /** All plates, as Structures::plates(). */
    std::vector<PlateState>
    states_of_plates() const;

    /** Variables for checkpoints. */
    void
    state(StateRow &row);

  private:
    using Row = std::vector<std::pair<unsigned int, double>>;

    /** Nonzero entries of a row b of owned dofs, along x and y, and along the dofs
     *  of the step. */
    struct Functional
    {
      Row along_axes, row;

      double
      product(const Vector &x) const
      {
        double sum = 0.;
        for (const auto &[dof, value] : row)
          sum += value * x.local_element(dof);
        return sum;
      }
    };

    /** A bar, the same on all ranks except for its row. */
    struct Bar : Functional
    {
      const Structure *structure = nullptr;
      bool             bends     = false; ///< bending at a node of a plate
      double           k = 0.; ///< EA/L (N/m^2), or EI over a length (N)

      /** Whether its derivative is assembled by one of the ranks, and the entries
       *  of the step there, with those of ghosts. */
      bool is_assembled = false, is_assembled_here = false;
      Row  assembled;

      bool     acts = false;
      BarState n;            ///< at t_n
      double   force   = 0.; ///< of the last residual() (N/m)
      double   rate    = 0.; ///< b.v of the last residual() (m/s)
      bool     elastic = true;

      double
      admissible(const double trial) const
      {
        return bends ? structure->admissible_moment(trial)
                     : structure->admissible(trial);
      }

      double
      initial_force() const
      {
        return bends ? 0. : structure->pre_stress;
      }

      /** Axial force or moment of an elastic elongation or rotation. */
      double
      elastic_force(const double elongation) const
      {
        return initial_force() + k * elongation;
      }

      /** Whether it is slack under a trial force, instead of yielding: it has no
       *  strength in this direction, and carries forces again at its former
       *  length. */
      bool
      is_slack(const double trial) const
      {
        return admissible(trial > 0. ? 1. : -1.) == 0.;
      }
    };

    /** A plate: the points at which it is tied to the body, its segments between
     *  them, and the bending at all points but free ends. */
    struct Plate
    {
      std::vector<dealii::Point<dim>> points;
      unsigned int first_segment = 0;                   ///< in the list of bars
      std::vector<std::optional<unsigned int>> bending; ///< bar of each point

      /** Displacement of its points at t_n, and their velocity at the last
       *  residual(). */
      std::vector<dealii::Tensor<1, dim>> displacement, velocity;

      /** Components of the displacement of each point. */
      std::vector<std::array<Functional, dim>> components;

      unsigned int
      n_segments() const
      {
        return points.size() - 1;
      }
    };

    /** Weights of nodes in the displacement of a point of the body, on the rank
     *  of its cell; empty on other ranks, and outside. */
    using Tie = std::vector<std::pair<unsigned int, double>>;

    /** Factors of the displacements of some points. */
    using Factors = std::vector<std::pair<const Tie *, dealii::Tensor<1, dim>>>;

    /** Row of a sum of displacements, with its ghosts. Collective. */
    Vector
    row_of(const Factors &factors) const;

    /** Adds a bar. Collective. */
    void
    add_bar(const Structure &structure,
            const bool       bends,
            const double     k,
            const Factors   &factors);

    /** Adds a plate with all of its bars. Collective. */
    void
    add_plate(const Structure                &structure,
              std::vector<dealii::Point<dim>> points,
              const std::vector<Tie>         &ties);

    /** Sets the entries of the step. Collective. */
    void
    set_rows();

    /** Products b.x of all bars. Collective. */
    std::vector<double>
    products(const Vector &x) const;

    /** @throws StepFailure if a bar is tied to nodes without cells.
     *  Collective. */
    void
    check_body() const;

    const Structures  &structures;
    const Space       &space;
    const Constraints *constraints = nullptr;
    std::vector<Bar>   bars; ///< those of plates are the last ones
    std::vector<Plate> plates;
    std::string        stage; ///< of the last step
    double             h = 0.;
  };
} // namespace geocone::GEOCONE_DIM

#endif
