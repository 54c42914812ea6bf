// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/log.h>
#include <geocone/base/stop_request.h>
#include <geocone/newton/newton_loop.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  std::optional<double>
  NewtonLoop::factorise(const double asked, const StepWorkspace &work)
  {
    // In load stepping to the limit load, the Jacobian without the row of the
    // loads becomes singular, as the body yields. The effect of the blend is
    // negligible, since the row fixes the rate.
    const double wanted = std::max(asked, work.traits.scales_loads ? 1e-8 : 0.);
    // A few apex points can make a Jacobian without mass singular.
    for (const double least : {0., 1e-6, 1e-3, 0.1})
      {
        if (least > 0. && least <= wanted)
          continue;
        const double weight = std::max(wanted, least);
        if (work.factorise(weight))
          {
            work.report.regularised += least > 0.;
            return weight;
          }
      }
    return {};
  }

  void
  NewtonLoop::give_up(const ResidualReport &state, const StepWorkspace &work)
  {
    SolverReport &report = work.report;
    report.reason = format("the residual stopped at %.1e after %u iterations "
                           "(%u points on the cone, "
                           "%u at the apex, %u of them switching)",
                           report.residual,
                           report.iterations,
                           state.n_cone,
                           state.n_apex,
                           state.n_switched);
    report.remedy =
      state.n_cone + state.n_apex > 0 || work.traits.contact.exists
        ? ""
        : format(
            "no point flows, so that the step is linear and smaller ones do "
            "not help: its equations are solved to %.1e only, by rounding. "
            "Stiffnesses differ too much: take a Poisson ratio farther from "
            "0.5, or materials or cells that differ less; or a "
            "'Newton/Tolerance' above that",
            report.residual);
  }

  namespace
  {
    /**
     * Increases the elastic blend until the direction is a descent direction.
     * Otherwise the tangent of non-associated flow is indefinite along it, and
     * the search would fail. (Particles in motion have a mass, and full steps
     * pass such iterates sooner.)
     * @return the blend
     */
    double
    lead_downhill(const StepWorkspace   &work,
                  const Eigen::VectorXd &defect,
                  double                 blend,
                  NewtonLine            &line)
    {
      if (!work.traits.contact.exists && !work.traits.points_move &&
          work.traits.law.non_associativity > 0.)
        for (const double more : {0.01, 0.05, 0.25})
          {
            if (line.slope() < 0. || !work.factorise(more))
              break;
            work.solve(nullptr, defect, line.direction);
            blend = more;
          }
      return blend;
    }
  } // namespace

  namespace
  {
    /**
     * Forcing terms of inexact Newton iterations: tolerances of the linear
     * systems by choice 2 of Eisenstat and Walker (1996), with gamma = 0.9 and
     * alpha = 2. The last systems are solved no more accurately than the
     * tolerance of the step requires. Linear steps have no forcing term, nor
     * have steps with contact, whose law requires accurate compliances.
     */
    class ForcingTerms
    {
    public:
      explicit ForcingTerms(const StepWorkspace &work)
        : work(work)
      {}

      ~ForcingTerms()
      {
        work.system.set_tolerance(0.);
      }

      /** Sets the tolerance of the next linear system.
       *  @param needed sufficient reduction of the residual */
      void
      set(const double norm, const double needed)
      {
        if (!work.traits.law.can_yield || work.traits.contact.exists)
          return;
        const double of_last = 0.9 * term * term;
        term = last_norm > 0. ? 0.9 * std::pow(norm / last_norm, 2) : largest;
        if (of_last > 0.1)
          term = std::max(term, of_last);
        term      = std::min(term, largest);
        last_norm = norm;
        work.system.set_tolerance(std::max(term, 0.3 * needed));
      }

    private:
      static constexpr double largest = 0.9;

      const StepWorkspace &work;
      double               term = 0., last_norm = 0.;
    };
  } // namespace

  namespace
  {
    /**
     * Successive iterations whose linear systems multigrid has solved in more
     * than half of its allowed iterations, or not, and that have not reduced the
     * residual: the matrix is nearly singular as the body fails. Direct solvers
     * have none.
     */
    class HardSystems
    {
    public:
      explicit HardSystems(const StepWorkspace &work)
        : counts(work.system.linear_solver().iterations())
        , n_hard(n_hard_systems())
        , least(work.report.residual)
      {}

      /** Counts an iteration with the residual at its end. */
      void
      count(const double residual)
      {
        const unsigned int before = n_hard;
        n_hard                    = n_hard_systems();
        in_a_row = n_hard > before && residual >= least ? in_a_row + 1 : 0;
        least    = std::min(least, residual);
      }

      /** Returns whether further iterations are not worth their cost. */
      bool
      too_many() const
      {
        return in_a_row >= 3;
      }

    private:
      unsigned int
      n_hard_systems() const
      {
        return counts == nullptr ? 0 : counts->hard;
      }

      const LinearIterations *counts;
      unsigned int            n_hard, in_a_row = 0;
      double                  least;
    };
  } // namespace

  void
  NewtonLoop::run(Globalisation &globalisation, const StepWorkspace &work) const
  {
    SolverReport      &report = work.report;
    const unsigned int start  = report.iterations;
    report.converged          = false;
    report.friction_lag       = law.friction_lag;

    NewtonLine          line(work, law);
    StepWorkspace::Jump jump  = work.jump();
    const bool          jumps = !jump.is_zero();
    line.state                = work.evaluate(law);
    work.record(line.state, 0., 0., law.friction_lag);
    ForcingTerms    forcing(work);
    HardSystems     hard(work);
    for (bool first = true;; first = false)
      {
        stop_if_asked(work.v.get_mpi_communicator());
        if (!std::isfinite(line.state.norm))
          {
            work.report_not_a_number();
            return;
          }
        if (!(first && (jumps || moves)) &&
            line.state.local_error <= tolerance &&
            work.is_balanced(line.state, tolerance, absolute_tolerance))
          {
            report.converged = true;
            report.reason.clear();
            report.remedy.clear();
            return;
          }
        const bool         flows = line.state.n_cone + line.state.n_apex > 0;
        const unsigned int spent = report.iterations - start;
        if (spent >=
              allowed + (report.residual < near_tolerance ? allowed : 0) ||
            (!flows && spent >= allowed_without_flow) ||
            (report.residual > far_threshold && spent >= allowed_if_far) ||
            hard.too_many())
          {
            give_up(line.state, work);
            return;
          }

        std::optional<ContactDirection> contact;
        if (exact_contact)
          contact.emplace(work);
        auto blend = factorise(!first ? globalisation.blend(report.residual)
                               : elastic_first ? 1.
                                               : 0.,
                               work);
        if (!blend)
          {
            report.reason = "the Jacobian is singular";
            report.remedy =
              "a part of the body is not held, or its soil has no strength "
              "left: hold it, set 'Time stepping/Inertia' = true, or take "
              "smaller steps; check whether the body can carry its loads";
            return;
          }
        const Vector *const prescribed =
          first && jumps ? &jump.prescribed : nullptr;
        forcing.set(line.state.norm,
                    tolerance * line.state.force_norm / line.state.norm);
        line.contact = contact && contact->is_used() ? &*contact : nullptr;
        if (line.contact != nullptr)
          contact->solve(prescribed, jump.defect, line.direction);
        else
          work.solve(prescribed, jump.defect, line.direction);
        if (globalisation.needs_descent() && prescribed == nullptr &&
            line.contact == nullptr)
          blend = lead_downhill(work, jump.defect, *blend, line);
        line.begin();
        const double length = first && jumps ? Globalisation().move(line)
                                             : globalisation.move(line);
        jump.defect = work.problem.free_dofs().multipliers.defect(work.v);
        work.record(line.state, length, *blend, law.friction_lag);
        hard.count(report.residual);
      }
  }
} // namespace geocone::GEOCONE_DIM
