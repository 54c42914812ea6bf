// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/element/mixed_control.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  MixedControl::MixedControl()
    : dealii::ParameterAcceptor("/Element")
  {
    add_parameter("Tolerance",
                  tolerance,
                  "Largest deviation of a stress from its target, relative to "
                  "the norm of the stress [-].");
    add_parameter("Maximum iterations",
                  max_iterations,
                  "Newton iterations after which an increment is halved.");
    add_parameter("Maximum halvings",
                  max_halvings,
                  "Maximum number of successive halvings of an increment, <= "
                  "30; beyond it the run fails.");
  }

  void
  MixedControl::prepare()
  {
    if (!(tolerance >= 1e-13 && tolerance < 1.))
      throw InputError(
        "Element/Tolerance", tolerance, "1e-13 to 1", "1e-10 is usual");
    if (max_iterations == 0)
      throw InputError(
        "Element/Maximum iterations", max_iterations, "> 0", "25 is usual");
    if (max_halvings > 30)
      throw InputError(
        "Element/Maximum halvings", max_halvings, "0 to 30", "12 is usual");
  }

  namespace
  {
    /** Difference between stresses and their targets. */
    class StressResidual
    {
    public:
      StressResidual(ElementPoint              &point,
                     const std::array<bool, 6> &by_stress,
                     const Tensor6             &target)
        : point(point)
        , target(target)
        , start(point.stress())
        , modulus(point.modulus())
      {
        for (unsigned int i = 0; i < 6; ++i)
          if (by_stress[i])
            unknown.push_back(i);
        r.resize(unknown.size());
        for (const unsigned int i : unknown)
          change = std::max(change, std::abs(target[i] - start[i]));
      }

      /** Computes the residual and its scale. @return NaN if the law fails */
      double
      evaluate(const Tensor6 &e)
      {
        const Tensor6 s = point.try_strain(e);
        scale           = std::max({norm(s), norm(start), norm(target)});
        // For zero initial and target stress, the scale is the elastic stress.
        if (scale == 0.)
          scale = std::max(modulus * norm(e), 1e-300);
        for (int i = 0; i < r.size(); ++i)
          r[i] = s[unknown[i]] - target[unknown[i]];
        return r.size() > 0 ? r.cwiseAbs().maxCoeff() : 0. * norm(s);
      }

      /** Newton update of the unknown strains, by finite differences. */
      Eigen::VectorXd
      newton_step(const Tensor6 &strain)
      {
        const Eigen::VectorXd r0 = r;
        const int             n  = r.size();
        Eigen::MatrixXd       J(n, n);
        const double          small =
          1e-4 * std::max({norm(strain), change / modulus, 1e-9});
        for (int j = 0; j < n; ++j)
          {
            Tensor6 moved = strain;
            moved[unknown[j]] += small;
            evaluate(moved);
            J.col(j) = (r - r0) / small;
          }
        return J.fullPivLu().solve(-r0);
      }

      Tensor6
      moved(Tensor6                strain,
            const double           length,
            const Eigen::VectorXd &step) const
      {
        for (int j = 0; j < step.size(); ++j)
          strain[unknown[j]] += length * step[j];
        return strain;
      }

      double scale = 0.;

    private:
      ElementPoint             &point;
      const Tensor6            &target;
      std::vector<unsigned int> unknown;
      const Tensor6             start;
      const double              modulus;
      double                    change = 0.; ///< of the controlled stresses
      Eigen::VectorXd           r;
    };
  } // namespace

  ControlReport
  MixedControl::solve(ElementPoint              &point,
                      const std::array<bool, 6> &by_stress,
                      const Tensor6             &target,
                      Tensor6                   &strain) const
  {
    ControlReport  report;
    StressResidual stresses(point, by_stress, target);
    double         residual = stresses.evaluate(strain);
    while (!(residual <= tolerance * stresses.scale))
      {
        report.residual = residual / stresses.scale;
        if (report.iterations == max_iterations)
          {
            report.reason = format("%u iterations leave a relative residual of "
                                   "%.3g",
                                   max_iterations,
                                   report.residual);
            return report;
          }
        ++report.iterations;
        const Eigen::VectorXd step = stresses.newton_step(strain);
        if (!step.allFinite() || step.norm() > 1.)
          {
            report.reason = "the stresses do not determine the strains: the "
                            "material cannot carry them, or has no stiffness "
                            "there";
            return report;
          }
        const Tensor6 from   = strain;
        double        length = 1., now = 0.;
        for (; length > 1e-3; length /= 2.)
          {
            strain = stresses.moved(from, length, step);
            now    = stresses.evaluate(strain);
            if (now < residual || now <= tolerance * stresses.scale)
              break;
          }
        if (!(length > 1e-3))
          {
            report.reason = format("no step lowers the relative residual of "
                                   "%.3g",
                                   report.residual);
            return report;
          }
        residual = now;
      }
    report.residual  = residual / stresses.scale;
    report.converged = true;
    return report;
  }
} // namespace geocone::GEOCONE_DIM
