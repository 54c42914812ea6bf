// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/seepage/flow_balance.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace geocone::GEOCONE_DIM
{
  using dealii::SymmetricTensor;
  using dealii::Tensor;

  namespace
  {
    using Permeabilities = std::vector<SymmetricTensor<2, dim>>;

    /** psi of unsaturated vertices is a tiny negative multiple of 1 - chi, of the height
     *  of the body: this determines chi where no water arrives and none can leave. */
    constexpr double regularisation = 1e-8;

    /** Values at a vertex with their derivatives by s. */
    struct Values
    {
      double psi, dpsi, chi, dchi, outflow, doutflow;
    };

    /** Equations of a flow with a free surface and without suction. */
    class FreeSurfaceBalance : public FlowBalance
    {
    public:
      FreeSurfaceBalance(const FlowMesh            &mesh,
                         const Permeabilities      &permeability,
                         const std::vector<double> &measure,
                         const FlowConditions      &conditions)
        : FlowBalance(mesh, permeability, measure, conditions)
      {}

      /** Sets the negative pressure of unsaturated vertices, as a part of the height of
       *  the body. */
      void
      regularise(const double epsilon)
      {
        suction = epsilon * height;
      }

      std::vector<double>
      residual(const std::vector<double> &s) override
      {
        std::vector<double> r(n, 0.), outflow(n);
        scale.assign(n, 0.);
        set_values(s);
        for (unsigned int e = 0; e < connections.size(); ++e)
          {
            const auto [i, j] = connections[e];
            const double head = values[j].psi - values[i].psi,
                         rise = y[j] - y[i],
                         flow = conductance[e] *
                                (head + values[upstream(e)].chi * rise);
            r[i] += flow;
            r[j] -= flow;
            const double size =
              std::abs(conductance[e]) * (std::abs(head) + std::abs(rise));
            scale[i] += size;
            scale[j] += size;
          }
        if (is_transient())
          for (unsigned int v = 0; v < n; ++v)
            {
              const double stored =
                conditions.storage[v] *
                (values[v].chi - conditions.saturation_before[v]);
              r[v] -= stored;
              scale[v] += std::abs(stored);
            }
        for (unsigned int v = 0; v < n; ++v)
          outflow[v] = values[v].outflow;
        add_boundary(s, outflow, r);
        return r;
      }

      const SparseMatrix &
      derivative() override
      {
        std::vector<double> doutflow(n);
        for (unsigned int v = 0; v < n; ++v)
          doutflow[v] = values[v].doutflow;
        begin_derivative(doutflow);
        for (unsigned int e = 0; e < connections.size(); ++e)
          {
            const auto [i, j]    = connections[e];
            const unsigned int u = upstream(e);
            const double       t = conductance[e],
                         gravity = t * (y[j] - y[i]) * values[u].dchi;
            add(i, j, t * values[j].dpsi);
            add(i, i, -t * values[i].dpsi);
            add(i, u, gravity);
            add(j, j, -t * values[j].dpsi);
            add(j, i, t * values[i].dpsi);
            add(j, u, -gravity);
          }
        if (is_transient())
          for (unsigned int v = 0; v < n; ++v)
            add(v, v, -conditions.storage[v] * values[v].dchi);
        return matrix;
      }

      /** psi and chi at the last argument of residual(). */
      std::vector<Values> values;

    private:
      bool
      is_transient() const
      {
        return !conditions.storage.empty();
      }

      void
      set_values(const std::vector<double> &s)
      {
        values.resize(n);
        for (unsigned int v = 0; v < n; ++v)
          {
            const bool is_wet     = s[v] > 0.,
                       is_face    = conditions.kind[v] == Kind::seepage_face;
            const double positive = std::max(s[v], 0.),
                         negative = std::min(s[v], 0.);
            Values &at            = values[v];
            at.psi      = (is_face ? 0. : positive) + suction * negative;
            at.dpsi     = is_wet ? (is_face ? 0. : 1.) : suction;
            at.chi      = 1. + negative;
            at.dchi     = is_wet ? 0. : 1.;
            at.outflow  = is_face ? diagonal[v] * positive : 0.;
            at.doutflow = is_face && is_wet ? diagonal[v] : 0.;
          }
      }

      /** The end of an edge from which the gravity part of its flow comes. */
      unsigned int
      upstream(const unsigned int e) const
      {
        const auto [i, j] = connections[e];
        return conductance[e] * (y[j] - y[i]) > 0. ? j : i;
      }

      double suction = 0.;
    };

    constexpr unsigned int most_full_steps = 30, most_iterations = 60;
    constexpr double       wanted          = 1e-11;
  } // namespace

  FlowSolution
  solve_flow(const FlowMesh            &mesh,
             const Permeabilities      &permeability,
             const std::vector<double> &measure,
             const FlowConditions      &conditions,
             std::vector<double>        start)
  {
    for (unsigned int v = 0; v < start.size(); ++v)
      if (conditions.kind[v] == FlowConditions::Kind::head)
        start[v] = conditions.head[v];
    FreeSurfaceBalance balance(mesh, permeability, measure, conditions);
    FlowSolution       flow;
    const auto         solver = make_umfpack();
    solver->analyse(balance.derivative_pattern());
    flow.s               = start;
    const auto converges = [&](const double epsilon) {
      balance.regularise(epsilon);
      const std::vector<double> before = flow.s;
      if (iterate(balance, *solver, most_full_steps, wanted, flow, 1.))
        return true;
      flow.s = before;
      return iterate(balance, *solver, most_iterations, wanted, flow);
    };
    if (!converges(regularisation))
      {
        // Continuation from soil that conducts a suction of the height of the body.
        flow.s         = start;
        double epsilon = 1., ratio = 0.25;
        double last      = epsilon;
        bool   converged = converges(epsilon);
        while (converged && last > regularisation && ratio < 0.9)
          {
            const std::vector<double> before = flow.s;
            epsilon = std::max(last * ratio, regularisation);
            if (converges(epsilon))
              last = epsilon;
            else
              {
                flow.s = before;
                ratio  = std::sqrt(ratio);
              }
          }
        if (!converged || last > regularisation)
          throw RunError(
            format("the flow of water was not found: after %u iterations the "
                   "balance of a vertex is missed by %.2g of its flow\n  "
                   "remedy:  check the permeabilities and the levels of "
                   "'Seepage', or change 'Seepage/Cells'",
                   flow.iterations,
                   flow.error));
      }
    flow.inflow = balance.inflow;
    for (const Values &at : balance.values)
      {
        flow.head.push_back(std::max(at.psi, 0.));
        flow.saturation.push_back(std::max(at.chi, 0.));
      }
    return flow;
  }

  Tensor<1, dim>
  darcy_velocity(const FlowMesh       &mesh,
                 const Permeabilities &permeability,
                 const FlowSolution   &flow,
                 const unsigned int    cell)
  {
    const auto     g = mesh.gradients(cell);
    Tensor<1, dim> gradient;
    for (unsigned int i = 0; i < FlowMesh::n_corners; ++i)
      {
        const unsigned int v = mesh.cells[cell][i];
        gradient += flow.head[v] * g[i];
        gradient[1] += flow.saturation[v] / FlowMesh::n_corners;
      }
    return -1. * (permeability[mesh.material[cell]] * gradient);
  }
} // namespace geocone::GEOCONE_DIM
