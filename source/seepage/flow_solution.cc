// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/linear/linear_solver.h>
#include <geocone/seepage/flow_solution.h>

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
    using Kind           = FlowConditions::Kind;
    using Permeabilities = std::vector<SymmetricTensor<2, 2>>;

    /** psi of unsaturated vertices is a tiny negative multiple of 1 - chi, of the height
     *  of the body: this determines chi where no water arrives and none can leave. */
    constexpr double regularisation = 1e-8;

    /** Values at a vertex with their derivatives by s. */
    struct Values
    {
      double psi, dpsi, chi, dchi, outflow, doutflow;
    };

    /** Equations of a flow: the balance of water of each vertex. */
    class Balance
    {
    public:
      Balance(const Triangles           &triangles,
              const Permeabilities      &permeability,
              const std::vector<double> &measure,
              const FlowConditions      &conditions)
        : conditions(conditions)
        , n(triangles.vertices.size())
        , conductance(triangles.edges.size(), 0.)
        , edges(triangles.edges)
        , diagonal(n, 0.)
      {
        double lowest  = triangles.vertices[0][1],
               highest = triangles.vertices[0][1];
        for (const auto &x : triangles.vertices)
          {
            lowest  = std::min(lowest, x[1]);
            highest = std::max(highest, x[1]);
            y.push_back(x[1]);
          }
        height = highest - lowest;
        for (unsigned int c = 0; c < triangles.cells.size(); ++c)
          {
            const auto   g      = triangles.gradients(c);
            const double factor = triangles.area(c) * measure[c];
            const auto  &k      = permeability[triangles.material[c]];
            for (unsigned int i = 0; i < 3; ++i)
              {
                const Tensor<1, 2> &a = g[(i + 1) % 3], &b = g[(i + 2) % 3];
                conductance[triangles.edges_of_cell[c][i]] -=
                  factor * (a * (k * b));
              }
          }
        for (unsigned int e = 0; e < edges.size(); ++e)
          for (const unsigned int v : edges[e].vertices)
            diagonal[v] += std::abs(conductance[e]);
        set_pattern();
      }

      /** Sets the negative pressure of unsaturated vertices, as a part of the height of
       *  the body. */
      void
      regularise(const double epsilon)
      {
        suction = epsilon * height;
      }

      /** Imbalance of each vertex at s. */
      std::vector<double>
      residual(const std::vector<double> &s)
      {
        std::vector<double> r(n, 0.);
        inflow.assign(n, 0.);
        scale.assign(n, 0.);
        set_values(s);
        for (unsigned int e = 0; e < edges.size(); ++e)
          {
            const auto [i, j] = edges[e].vertices;
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
          {
            inflow[v] = conditions.kind[v] == Kind::head
                          ? -r[v]
                          : conditions.rain[v] - values[v].outflow;
            if (conditions.kind[v] == Kind::head)
              r[v] = diagonal[v] * (conditions.head[v] - s[v]);
            else
              {
                r[v] += inflow[v];
                scale[v] += conditions.rain[v] + values[v].outflow;
              }
          }
        return r;
      }

      /** Largest entry of a residual over the flow through the vertex's edges. */
      double
      error(const std::vector<double> &r) const
      {
        double largest = 0.;
        for (unsigned int v = 0; v < n; ++v)
          {
            if (!std::isfinite(r[v] + scale[v]))
              return std::numeric_limits<double>::infinity();
            if (r[v] != 0.)
              largest = std::max(largest, std::abs(r[v]) / scale[v]);
          }
        return largest;
      }

      const SparseMatrix &
      derivative_pattern() const
      {
        return matrix;
      }

      /** Derivative of residual() at its last argument. */
      const SparseMatrix &
      derivative()
      {
        std::fill(matrix.value.begin(), matrix.value.end(), 0.);
        const auto add = [&](const unsigned int row,
                             const unsigned int column,
                             const double       value) {
          if (conditions.kind[row] != Kind::head)
            matrix.value[matrix.entry(row, column)] += value;
        };
        for (unsigned int e = 0; e < edges.size(); ++e)
          {
            const auto [i, j]    = edges[e].vertices;
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
        for (unsigned int v = 0; v < n; ++v)
          {
            double &entry = matrix.value[matrix.entry(v, v)];
            if (conditions.kind[v] == Kind::head)
              entry -= diagonal[v];
            else
              entry -=
                values[v].doutflow +
                (is_transient() ? conditions.storage[v] * values[v].dchi : 0.);
          }
        return matrix;
      }

      /** Flow into the body at each vertex at the last argument of residual(). */
      std::vector<double> inflow;

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
        const auto [i, j] = edges[e].vertices;
        return conductance[e] * (y[j] - y[i]) > 0. ? j : i;
      }

      void
      set_pattern()
      {
        std::vector<std::vector<int>> columns(n);
        for (unsigned int v = 0; v < n; ++v)
          columns[v].push_back(v);
        for (const auto &edge : edges)
          {
            const auto [i, j] = edge.vertices;
            columns[i].push_back(j);
            columns[j].push_back(i);
          }
        matrix.n_global = matrix.n_owned = n;
        for (unsigned int v = 0; v < n; ++v)
          {
            std::sort(columns[v].begin(), columns[v].end());
            matrix.column.insert(
              matrix.column.end(), columns[v].begin(), columns[v].end());
            matrix.row_start.push_back(matrix.column.size());
            matrix.global_index.push_back(v);
          }
        matrix.value.resize(matrix.column.size());
      }

      const FlowConditions               &conditions;
      const unsigned int                  n;
      std::vector<double>                 conductance; ///< of edges (m/s)
      const std::vector<Triangles::Edge> &edges;
      std::vector<double> diagonal; ///< sums of absolute conductances
      std::vector<double> y, scale;
      double              height = 0., suction = 0.;
      SparseMatrix        matrix;
    };

    double
    norm(const std::vector<double> &r)
    {
      double sum = 0.;
      for (const double x : r)
        sum += x * x;
      return std::sqrt(sum);
    }

    /** Nonsmooth Newton method with a line search, for a given regularisation.
     *  @param[in,out] flow its s, iterations and error
     *  @return whether it has converged */
    bool
    iterate(Balance      &balance,
            LinearSolver &solver,
            const double  epsilon,
            FlowSolution &flow)
    {
      constexpr unsigned int most_iterations = 60;
      constexpr double       wanted = 1e-11, accepted = 1e-10,
                       smallest_step = 1. / 64.;
      balance.regularise(epsilon);
      auto residual = balance.residual(flow.s);
      flow.error    = balance.error(residual);
      for (unsigned int i = 0; i < most_iterations && !(flow.error <= wanted);
           ++i)
        {
          if (!std::isfinite(flow.error) ||
              !solver.factorise(balance.derivative()))
            return false;
          ++flow.iterations;
          std::vector<double> step = residual;
          solver.solve(step);
          const double before  = norm(residual);
          bool         is_less = false;
          for (double part = 1.; !is_less && part >= smallest_step; part /= 2.)
            {
              std::vector<double> next(flow.s);
              for (unsigned int v = 0; v < next.size(); ++v)
                next[v] -= part * step[v];
              residual = balance.residual(next);
              is_less  = norm(residual) < before;
              if (is_less || part / 2. < smallest_step)
                flow.s = std::move(next);
            }
          flow.error = balance.error(residual);
          if (!is_less && flow.error <= accepted) // rounding
            return true;
        }
      return flow.error <= accepted;
    }
  } // namespace

  FlowSolution
  solve_flow(const Triangles           &triangles,
             const Permeabilities      &permeability,
             const std::vector<double> &measure,
             const FlowConditions      &conditions,
             std::vector<double>        start)
  {
    for (unsigned int v = 0; v < start.size(); ++v)
      if (conditions.kind[v] == Kind::head)
        start[v] = conditions.head[v];
    Balance      balance(triangles, permeability, measure, conditions);
    FlowSolution flow;
    const auto   solver = make_umfpack();
    solver->analyse(balance.derivative_pattern());
    flow.s = start;
    if (!iterate(balance, *solver, regularisation, flow))
      {
        // Continuation from soil that conducts a suction of the height of the body.
        flow.s         = start;
        double epsilon = 1., ratio = 0.25;
        double last      = epsilon;
        bool   converged = iterate(balance, *solver, epsilon, flow);
        while (converged && last > regularisation && ratio < 0.9)
          {
            const std::vector<double> before = flow.s;
            epsilon = std::max(last * ratio, regularisation);
            if (iterate(balance, *solver, epsilon, flow))
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
  darcy_velocity(const Triangles      &triangles,
                 const Permeabilities &permeability,
                 const FlowSolution   &flow,
                 const unsigned int    cell)
  {
    const auto   g = triangles.gradients(cell);
    Tensor<1, 2> gradient;
    for (unsigned int i = 0; i < 3; ++i)
      {
        const unsigned int v = triangles.cells[cell][i];
        gradient += flow.head[v] * g[i];
        gradient[1] += flow.saturation[v] / 3.;
      }
    return -1. * (permeability[triangles.material[cell]] * gradient);
  }
} // namespace geocone::GEOCONE_DIM
