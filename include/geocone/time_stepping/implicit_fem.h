// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_time_stepping_implicit_fem_h
#define geocone_time_stepping_implicit_fem_h

#include <geocone/mechanics/loads.h>
#include <geocone/solvers/nonsmooth_newton.h>

#include <deal.II/base/timer.h>

namespace geocone
{
  /** Everything that a run advances in time, besides the points' state. */
  struct Kinematics
  {
    Vector velocity;     ///< at t_n (m/s)
    Vector displacement; ///< since the start or the last reset (m)
  };

  /** Energies at the end of a step and what the step has done (J/m). */
  struct Energies
  {
    double kinetic       = 0.; ///< v'Mv/2
    double elastic       = 0.; ///< sum V s'Ss/2
    double external_work = 0.; ///< of the step: loads and supports
    double dissipation   = 0.; ///< of the step: sum V s'(-z) >= 0
  };

  /** What a step came to. Nothing has changed if it did not converge. */
  struct StepReport
  {
    bool         converged = false;
    SolverReport newton;
    Quality      quality;
    Energies     energies;
    Vector       residual; ///< reactions in the rows of prescribed dofs (N/m)
  };

  /**
   * Backward Euler for the finite element method with points that do not move
   * (small strains). This is the only place where state changes, and only when
   * a step is accepted.
   */
  class ImplicitFEM : public dealii::ParameterAcceptor
  {
  public:
    ImplicitFEM();

    /** Whether there is inertia; without it no mass is assembled. */
    bool
    has_inertia() const
    {
      return inertia;
    }

    /** Allocates what a step needs and analyses the Jacobian's pattern. */
    void
    prepare(const Scene           &scene,
            const BackgroundMesh  &mesh,
            const Space           &space,
            const Constraints     &constraints,
            const MaterialPoints  &points,
            const NonsmoothNewton &newton,
            dealii::TimerOutput   &timer);

    /** Tries the step from t to t + h; commits it if it converges. */
    StepReport
    advance(Kinematics            &kinematics,
            MaterialPoints        &points,
            const NonsmoothNewton &newton,
            dealii::TimerOutput   &timer,
            const double           t,
            const double           h);

    std::string
    linear_solver_name() const
    {
      return linear_solver->name();
    }

    std::size_t
    n_nonzeros() const
    {
      return matrix.column.size();
    }

  private:
    Energies
    energies(const IncrementalProblem &problem,
             const MaterialPoints     &points,
             const Vector             &v,
             const Vector             &residual) const;

    bool inertia = false;

    const Scene                        *scene       = nullptr;
    const Constraints                  *constraints = nullptr;
    std::unique_ptr<Loads>              loads;
    std::unique_ptr<IncrementalProblem> problem;
    std::unique_ptr<LinearSolver>       linear_solver;
    SparseMatrix                        matrix;
    Vector                              lumped_mass;
    Vector                              weight_per_g;
    Vector                              force;
  };
} // namespace geocone

#endif
