// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_terms_bars_h
#define geocone_terms_bars_h

#include <geocone/base/state_row.h>
#include <geocone/conditions/constraints.h>
#include <geocone/contact/low_rank.h>
#include <geocone/scene/structures.h>
#include <geocone/terms/plate_strength.h>
#include <geocone/terms/term.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** State of a bar at the end of a step; zero if the bar is not installed. For
   *  the bending at a node of a plate, the force is a moment (N) and the
   *  elongations are rotations. */
  struct BarState
  {
    double force      = 0.; ///< axial force, tension positive (N/m)
    double elongation = 0.; ///< since installation (m)
    double plastic    = 0.; ///< plastic part of the elongation (m)
    bool   yields     = false;

    void
    state(StateRow &row)
    {
      row(force, elongation, plastic, yields);
    }
  };

  /** Displacement and internal forces at one end of a plate segment. Moments are
   *  positive with tension on the right-hand side of the polyline; the shear
   *  force is the derivative of the moment. */
  struct PlatePoint
  {
    double                 arc = 0.;     ///< distance along the polyline (m)
    dealii::Point<dim>     x;            ///< initial position (m)
    dealii::Tensor<1, dim> displacement; ///< since installation (m)
    double                 normal = 0.;  ///< axial force, tension > 0 (N/m)
    double                 shear  = 0.;  ///< shear force (N/m)
    double                 moment = 0.;  ///< bending moment (N)
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

  /** State of a plate at the end of a step; zero if the plate is not installed. */
  struct PlateState
  {
    bool         acts     = false;
    unsigned int n_hinges = 0; ///< number of nodes that yield in bending

    /** Displacements and internal forces at both ends of each segment, segment by
     *  segment. Normal and shear forces are constant in a segment. */
    std::vector<PlatePoint> points;

    /** Returns the plate point with the largest value of a quantity, e.g.
     *  size_of_moment(). Of several points the first is returned. */
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
   * Bars between two points of the body, or between a point of the body and a
   * fixed point outside the body. They represent anchors, struts, geogrids, and
   * the segments of plates. With b.v the rate of elongation of a bar, the axial
   * force at the end of a step is the projection
   *   N = P(N_0 + k (e + h b.v - e_p)),  k = EA/L,  P on [-N_c, N_t],
   * the closed form of the complementarity between force and plastic
   * elongation e_p, see doc/theory/structures.md. Without compressive strength
   * a bar is slack instead of yielding. The term is R = sum N b.
   *
   * The bending at a node of a plate follows the same law: b.v is the rate of
   * rotation between the adjacent segments, N the moment, and k is EI divided by
   * the mean length of the two segments. If the axial force reduces the moment
   * capacity of a plate, its forces are projected together.
   *
   * The derivative h k b b' for elastic bars couples nodes that share no cell.
   * It is assembled for the bars of chains, which are short; for long bars, or if
   * no rank has all nodes, it is a low-rank update of the Jacobian (LowRank).
   */
  class Bars : public Term
  {
  public:
    /** Connects the ends of the bars to the nodes of the body. Collective.
     *  @throws InputError for a point outside the body that is not the fixed end
     *  of an anchor or strut */
    Bars(const Structures     &structures,
         const BackgroundMesh &mesh,
         const Space          &space);

    /** Prepares the bars for a step: installation or removal, step size and
     *  coefficient vectors. Bars are installed and removed at the beginning of
     *  a stage; the step size h (s) and the vectors b along rotated dofs are
     *  set. Collective.
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

    /** Adds the tangent stiffness of the bars with assembled stiffness to the
     *  Jacobian. */
    void
    linearise(const JacobianPattern &pattern,
              const double           elastic_blend,
              SparseMatrix          &matrix) const override;

    /** Low-rank tangent stiffness of the bars that are not assembled into the
     *  Jacobian, on the owned free dofs. It belongs to the last call of
     *  residual().
     *  @param elastic_blend as in linearise() */
    LowRank
    low_rank(const double elastic_blend) const;

    /** Power of the bar forces acting on the body at the state of the last call
     *  to residual() (W/m). */
    double
    power() const;

    /** Accepts the bar forces of the last call to residual() as the state at
     *  t_n. */
    void
    commit();

    /** States of the bars of all structures except plates, in the order of
     *  Structures::names_of_bars(). */
    std::vector<BarState>
    states_of_bars() const;

    /** States of all plates, in the order of Structures::plates(). */
    std::vector<PlateState>
    states_of_plates() const;

    /** Saves the state variables of all bars to a checkpoint, or restores them
     *  from one. */
    void
    state(StateRow &row);

  private:
    using Row = std::vector<std::pair<unsigned int, double>>;

    /** Nonzero coefficients of a linear functional b.x of the dofs x owned by
     *  this rank. They are stored for the x and y components, and for the
     *  (rotated) dofs of the step. */
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

    /** Bar of a structure. It is identical on all ranks except for the
     *  coefficients b. */
    struct Bar : Functional
    {
      const Structure *structure = nullptr;
      bool             bends     = false; ///< bending at a node of a plate
      double           k = 0.; ///< EA/L (N/m^2), or EI over a length (N)

      /** Flags that state whether the bar's tangent stiffness is assembled on
       *  any rank and on this rank. The member assembled contains the
       *  coefficients b on this rank, including ghosts. */
      bool is_assembled = false, is_assembled_here = false;
      Row  assembled;

      bool     acts = false;
      BarState n;            ///< state at t_n
      double   force   = 0.; ///< axial force in the last residual() call (N/m)
      double   rate    = 0.; ///< b.v in the last residual() call (m/s)
      bool     elastic = true;

      /** Whether the force yields together with others (yielding). */
      bool is_coupled = false;

      double
      admissible(const double trial) const
      {
        return bends ? structure->admissible_moment(trial)
                     : structure->admissible(trial);
      }

      double
      strength() const
      {
        return bends ? structure->moment_capacity()
                     : structure->axial_strength()[1];
      }

      /** Tangent stiffness, without couplings: of coupled bars the elastic one.
       *  @param elastic_blend as in linearise() */
      double
      tangent(const double elastic_blend) const
      {
        return k * (elastic || is_coupled ? 1. : elastic_blend);
      }

      double
      initial_force() const
      {
        return bends ? 0. : structure->pre_stress;
      }

      /** Axial force due to an elastic elongation, or bending moment due to an
       *  elastic rotation. */
      double
      elastic_force(const double elongation) const
      {
        return initial_force() + k * elongation;
      }

      /** Returns true if the bar is slack, and not yielding, under a trial force.
       *  A bar without strength in this direction carries forces again as soon as
       *  it returns to its former length. */
      bool
      is_slack(const double trial) const
      {
        return admissible(trial > 0. ? 1. : -1.) == 0.;
      }
    };

    /** Plate: the points tied to the body, the segments between these points,
     *  and the bending stiffness at all points except free ends. */
    struct Plate
    {
      std::vector<dealii::Point<dim>> points;
      unsigned int                    first_segment = 0; ///< bar of segment 0
      std::vector<std::optional<unsigned int>> bending; ///< bar of each point

      /** Bending and segments beside each point whose forces interact. */
      std::vector<std::array<unsigned int, 2>> interacting;

      /** Displacements of the plate points at t_n (m), and velocities of these
       *  points at the state of the last call to residual() (m/s). */
      std::vector<dealii::Tensor<1, dim>> displacement, velocity;

      /** Displacement components of each plate point, as linear functionals of the
       *  dofs. */
      std::vector<std::array<Functional, dim>> components;

      unsigned int
      n_segments() const
      {
        return points.size() - 1;
      }
    };

    /** Nodal weights that interpolate the displacement at a point of the body.
     *  They are stored on the rank that owns the cell, and are empty on other
     *  ranks and for points outside the body. */
    using Tie = std::vector<std::pair<unsigned int, double>>;

    /** Points whose displacements enter a linear functional (e.g. an
     *  elongation), each with a vector of weights. */
    using Factors = std::vector<std::pair<const Tie *, dealii::Tensor<1, dim>>>;

    /** Coefficients b of a weighted sum of point displacements, in terms of the
     *  dofs including ghosts. Collective. */
    Vector
    row_of(const Factors &factors) const;

    /** Appends a bar to the list. Collective. */
    void
    add_bar(const Structure &structure,
            const bool       bends,
            const double     k,
            const Factors   &factors);

    /** Appends a plate and all its bars to the list. Collective. */
    void
    add_plate(const Structure                &structure,
              std::vector<dealii::Point<dim>> points,
              const std::vector<Tie>         &ties);

    /** Computes the coefficient vectors b of all bars in terms of the (possibly
     *  rotated) dofs of the step. Collective. */
    void
    set_rows();

    /** Lists the pairs of a moment and an axial force that interact. */
    void
    pair_forces(Plate &plate) const;

    /** Computes the forces within the strength from elastic ones. */
    void
    return_to_strength();

    /** The same for a plate whose axial forces and moments interact. */
    void
    return_to_strength(const Plate &plate);

    /** Bars that yield together in the last residual() call, and the derivative
     *  of their forces by their elongations. */
    struct Yielding
    {
      std::vector<unsigned int> bars;
      Eigen::MatrixXd           stiffness;
    };

    /** Scalar products b.x of the coefficient vector b of each bar and a dof
     *  vector x, summed over the ranks. Collective. */
    std::vector<double>
    products(const Vector &x) const;

    /** Checks that all nodes tied to bars belong to cells. Collective.
     *  @throws StepFailure if a node does not */
    void
    check_body() const;

    const Structures  &structures;
    const Space       &space;
    const Constraints *constraints = nullptr;
    std::vector<Bar>   bars; ///< bars of plates at the end of the list
    std::vector<Plate> plates;
    std::vector<Yielding> yielding;
    std::string        stage; ///< stage of the last step
    double             h = 0.;
  };

  /** Returns warnings about ends of anchors and struts outside of the body that are
   *  close to its boundary. Such an end is fixed, which may not be intended. */
  std::vector<std::string>
  warn_of_fixed_ends(const Structures &structures, const BackgroundMesh &mesh);

  /** Returns warnings about plates that have moved by more than half a cell in a grid
   *  through which the body moves: their points stay where they were. */
  std::vector<std::string>
  warn_of_moved_plates(const Structures              &structures,
                       const std::vector<PlateState> &plates,
                       const BackgroundMesh          &mesh);
} // namespace geocone::GEOCONE_DIM

#endif
