// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_problem_bars_h
#define geocone_problem_bars_h

#include <geocone/base/state_row.h>
#include <geocone/conditions/constraints.h>
#include <geocone/contact/low_rank.h>
#include <geocone/problem/term.h>
#include <geocone/scene/structures.h>

#include <utility>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** A bar at the end of a step; zero where it is not installed. */
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

  /**
   * Bars between points of the body, or a point of it and a fixed one outside:
   * anchors, struts and geogrids. With the row b of a bar, b.v the rate of its
   * elongation e, the axial force at the end of a step is the projection
   *   N = P(N_0 + k (e + h b.v - e_p)),  k = EA/L,  P on [-N_c, N_t],
   * the closed form of the complementarity between force and plastic
   * elongation e_p, see doc/theory/structures.md. Without compressive strength
   * a bar is slack instead of yielding. The term is R = sum N b. Its derivative
   * h k b b' for elastic bars couples nodes that share no cell and may belong to
   * different ranks; it is a low-rank update of the Jacobian (LowRank).
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

    /** Derivative of the term at the last residual(), by owned free rows.
     *  @param elastic_blend as in linearise() */
    LowRank
    low_rank(const double elastic_blend) const;

    /** Power of the bars on the body at the last residual() (W/m). */
    double
    power() const;

    /** Accepts the forces of the last residual(). @return state of all bars */
    std::vector<BarState>
    commit();

    /** Variables for checkpoints. */
    void
    state(StateRow &row);

  private:
    /** A bar, the same on all ranks except for its row. */
    struct Bar
    {
      unsigned int structure = 0;
      double       k         = 0.; ///< EA/L (N/m^2)

      /** Nonzero entries of b of owned dofs, along x and y, and along the dofs
       *  of the step. */
      std::vector<std::pair<unsigned int, double>> along_axes, row;

      bool     acts = false;
      BarState n;            ///< at t_n
      double   force   = 0.; ///< of the last residual() (N/m)
      double   rate    = 0.; ///< b.v of the last residual() (m/s)
      bool     elastic = true;
    };

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
    std::vector<Bar>   bars;
    std::string        stage; ///< of the last step
    double             h = 0.;
  };
} // namespace geocone::GEOCONE_DIM

#endif
