// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_bounds_safety_search_h
#define geocone_bounds_safety_search_h

#include <geocone/base/state_row.h>

#include <array>
#include <optional>
#include <string>

namespace geocone
{
  /**
   * Strict bounds on the factor of safety F of a body. The limit state is
   * reached if c and tan(phi) of all materials are divided by F. Let
   * lambda^-(F) and lambda^+(F) be the bounds on the factor of all loads. F is
   * safe if lambda^- >= 1: the zero stress and the stresses in equilibrium with
   * lambda^- times the loads are both admissible, and so are their convex
   * combinations, one of which carries the loads. The body fails for F if
   * lambda^+ <= 1. Both are certificates that need no convergence.
   *
   * On each mesh the roots of both bounds are found by secants of log lambda over log
   * F, and each is confirmed by one more solution a thousandth on the safe side.
   */
  class SafetySearch
  {
  public:
    enum Side
    {
      lower,
      upper
    };

    /** A bound on the load factor for a given strength reduction factor F. */
    struct Attempt
    {
      double       load           = 0.;
      bool         certified      = false;
      bool         grows          = false; ///< the load seems unbounded
      unsigned int factorisations = 0;
      std::string  rejection; ///< reason for rejection, if not certified

      /** True if the bound is certified and positive. */
      bool
      is_usable() const;
    };

    /** Base class of solvers for limit analyses on a mesh, with the strength
     *  divided by a factor F. one() and keep() are called for both sides at the same
     *  time (run_both()). */
    class Solver
    {
    public:
      virtual ~Solver() = default;

      /** Computes both bounds on the load factor for a given strength reduction
       *  factor F. @return by Side */
      virtual std::array<Attempt, 2>
      both(const double F) = 0;

      /** Computes the lower or upper bound on the load factor for a given
       *  strength reduction factor F. */
      virtual Attempt
      one(const double F, const Side side) = 0;

      /** Stores the last lower-bound or upper-bound solution, which certifies a
       *  bound on the factor of safety. */
      virtual void
      keep(const Side side) = 0;
    };

    /** Bounds on the factor of safety computed on one mesh, with the
     *  computational cost. */
    struct Level
    {
      double factor = 1.; ///< last F for which both bounds were computed

      /** Certified bounds on the factor of safety, computed on this mesh; empty
       *  if not certified. */
      std::optional<double> lower, upper;

      /** Number of matrix factorisations on the mesh for the lower and for the
       *  upper bound, indexed by Side. */
      std::array<unsigned int, 2> iterations = {{0, 0}};
    };

    /** Computes both bounds on the factor of safety, using a given mesh.
     *  @throws StepFailure if the body fails for no factor F, or for all
     *  factors */
    Level
    on_mesh(Solver &solver);

    /** Proves a factor near the root of one bound alone. @param start initial guess
     *  @return nothing if the bound is not certified there */
    std::optional<double>
    proven(Solver &solver, const Side side, const double start);

    void
    state(StateRow &row)
    {
      row(factor, exponent);
    }

  private:
    /** Strength reduction factor F certified by one bound. It is near the root
     *  of lambda(F) = 1, with the load factor lambda.
     *  @param load the bound for `factor` */
    std::optional<double>
    prove(Solver       &solver,
          const Side    side,
          double        load,
          unsigned int &iterations) const;

    double factor   = 1.; ///< initial guess for the next mesh
    double exponent = 1.; ///< -d log lambda/d log F
  };
} // namespace geocone

#endif
