// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/seepage/flow_balance.h>
#include <geocone/seepage/unsaturated_flow.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace geocone::GEOCONE_DIM
{
  using dealii::SymmetricTensor;

  namespace
  {
    /** Part of the conductance of an edge that is of one material. */
    struct ConductancePart
    {
      unsigned int     edge;
      const Retention *curve;
      double           conductance; ///< (m/s)
    };

    /** Equations of a steady flow, or of a time step, in unsaturated soil. */
    class RichardsBalance : public FlowBalance
    {
    public:
      /** @param step size (s); 0: steady
       *  @param water_before at the vertices (m^2) */
      RichardsBalance(const FlowMesh                             &mesh,
                      const std::vector<SymmetricTensor<2, dim>> &permeability,
                      const std::vector<double>                  &measure,
                      const std::vector<const Retention *>       &curves,
                      const std::vector<UnsaturatedFlow::Part>   &volumes,
                      const FlowConditions                       &conditions,
                      const double                                step,
                      const std::vector<double>                  &water_before)
        : FlowBalance(mesh, permeability, measure, conditions)
        , volumes(volumes)
        , step(step)
        , water_before(water_before)
      {
        std::map<std::pair<unsigned int, const Retention *>, double> sums;
        for (unsigned int c = 0; c < mesh.cells.size(); ++c)
          for (unsigned int i = 0; i < FlowMesh::n_connections; ++i)
            {
              const unsigned int m = mesh.material[c];
              sums[{mesh.connections_of_cell[c][i], curves[m]}] +=
                edge_conductance(mesh, permeability[m], measure[c], c, i);
            }
        for (const auto &[key, sum] : sums)
          flows.push_back({key.first, key.second, sum});
      }

      std::vector<double>
      residual(const std::vector<double> &s) override
      {
        std::vector<double> r(n, 0.), outflow(n, 0.);
        scale.assign(n, 0.);
        psi.assign(n, 0.);
        is_fixed.assign(n, false);
        for (unsigned int v = 0; v < n; ++v)
          {
            is_fixed[v] = conditions.kind[v] == Kind::seepage_face && s[v] > 0.;
            psi[v]      = is_fixed[v] ? 0. : s[v];
            outflow[v]  = is_fixed[v] ? diagonal[v] * s[v] : 0.;
          }
        for (const ConductancePart &part : flows)
          {
            const auto [i, j] = connections[part.edge];
            const double head = psi[j] - psi[i], rise = y[j] - y[i],
                         k = part.curve->at(psi[upstream(part)]).permeability,
                         flow = part.conductance * k * (head + rise),
                         size = std::abs(part.conductance) * k *
                                (std::abs(head) + std::abs(rise));
            r[i] += flow;
            r[j] -= flow;
            scale[i] += size;
            scale[j] += size;
          }
        if (step > 0.)
          {
            std::vector<double> water(n, 0.);
            for (const auto &part : volumes)
              water[part.vertex] +=
                part.volume * part.curve->at(psi[part.vertex]).content;
            for (unsigned int v = 0; v < n; ++v)
              {
                const double stored = (water[v] - water_before[v]) / step;
                r[v] -= stored;
                // Contents are rounded to 1e-16 of themselves.
                scale[v] += std::abs(stored) + 1e-4 * water[v] / step;
              }
          }
        add_boundary(s, outflow, r);
        return r;
      }

      const SparseMatrix &
      derivative() override
      {
        std::vector<double> doutflow(n, 0.);
        for (unsigned int v = 0; v < n; ++v)
          doutflow[v] = is_fixed[v] ? diagonal[v] : 0.;
        begin_derivative(doutflow);
        const auto add_free = [&](const unsigned int row,
                                  const unsigned int column,
                                  const double       value) {
          if (!is_fixed[column])
            add(row, column, value);
        };
        for (const ConductancePart &part : flows)
          {
            const auto [i, j]     = connections[part.edge];
            const unsigned int u  = upstream(part);
            const auto         at = part.curve->at(psi[u]);
            const double       t  = part.conductance * at.permeability,
                         by_k     = part.conductance * at.slope *
                                (psi[j] - psi[i] + y[j] - y[i]);
            add_free(i, j, t);
            add_free(i, i, -t);
            add_free(i, u, by_k);
            add_free(j, j, -t);
            add_free(j, i, t);
            add_free(j, u, -by_k);
          }
        if (step > 0.)
          for (const auto &part : volumes)
            add_free(part.vertex,
                     part.vertex,
                     -part.volume * part.curve->at(psi[part.vertex]).capacity /
                       step);
        return matrix;
      }

      /** Pressure heads at the last argument of residual() (m). */
      std::vector<double> psi;

    private:
      /** The end of an edge from which the water comes. */
      unsigned int
      upstream(const ConductancePart &part) const
      {
        const auto [i, j] = connections[part.edge];
        return part.conductance * (psi[j] + y[j] - psi[i] - y[i]) > 0. ? j : i;
      }

      const std::vector<UnsaturatedFlow::Part> &volumes;
      const double                              step;
      const std::vector<double>                &water_before;
      std::vector<ConductancePart>              flows;
      std::vector<bool> is_fixed; ///< psi = 0: an active seepage face
    };

    std::vector<UnsaturatedFlow::Part>
    parts_of_vertices(const FlowMesh                       &mesh,
                      const std::vector<double>            &measure,
                      const std::vector<const Retention *> &curves)
    {
      std::map<std::pair<unsigned int, const Retention *>, double> sums;
      for (unsigned int c = 0; c < mesh.cells.size(); ++c)
        for (const unsigned int v : mesh.cells[c])
          sums[{v, curves[mesh.material[c]]}] +=
            mesh.cell_size(c) / FlowMesh::n_corners * measure[c];
      std::vector<UnsaturatedFlow::Part> parts;
      for (const auto &[key, sum] : sums)
        parts.push_back({key.first, key.second, sum});
      return parts;
    }
  } // namespace

  UnsaturatedFlow::UnsaturatedFlow(
    const FlowMesh                             &mesh,
    const std::vector<SymmetricTensor<2, dim>> &permeability,
    const std::vector<double>                  &measure,
    const std::vector<const Retention *>       &curves)
    : mesh(mesh)
    , permeability(permeability)
    , measure(measure)
    , curves(curves)
    , parts(parts_of_vertices(mesh, measure, curves))
  {}

  std::pair<FlowSolution, bool>
  UnsaturatedFlow::step(const FlowConditions      &conditions,
                        const double               step,
                        const std::vector<double> &before,
                        const std::vector<double> &start) const
  {
    const unsigned int most_iterations = step > 0. ? 20 : 60;
    // Errors of all vertices add to that of the balance of a step.
    constexpr double          wanted = 1e-13;
    const std::vector<double> water_before =
      step > 0. ? water(before) : std::vector<double>();
    RichardsBalance balance(mesh,
                            permeability,
                            measure,
                            curves,
                            parts,
                            conditions,
                            step,
                            water_before);
    FlowSolution    flow;
    flow.s = start;
    for (unsigned int v = 0; v < flow.s.size(); ++v)
      if (conditions.kind[v] == FlowConditions::Kind::head)
        flow.s[v] = conditions.head[v];
    const auto solver = make_umfpack();
    solver->analyse(balance.derivative_pattern());
    const bool converged =
      iterate(balance, *solver, most_iterations, wanted, flow);
    flow.inflow = balance.inflow;
    flow.head   = balance.psi;
    return {flow, converged};
  }

  FlowSolution
  UnsaturatedFlow::steady(const FlowConditions &conditions,
                          std::vector<double>   start) const
  {
    auto [flow, converged] = step(conditions, 0., {}, start);
    if (converged)
      return flow;
    // Time steps from the initial guess approach the steady flow.
    double volume = 0., fastest = 0.;
    for (const Part &part : parts)
      volume += part.volume;
    for (const auto &k : permeability)
      fastest = std::max(fastest, trace(k));
    std::vector<double> head = start;
    for (unsigned int v = 0; v < head.size(); ++v)
      if (conditions.kind[v] == FlowConditions::Kind::seepage_face)
        head[v] = std::min(head[v], 0.);
    double h =
      1e-3 * (dim == 2 ? std::sqrt(volume) : std::cbrt(volume)) / fastest;
    const double           longest    = 1e9 * h;
    constexpr unsigned int most_steps = 300;
    for (unsigned int i = 0; i < most_steps && h < longest; ++i)
      {
        auto [next, is_found] = step(conditions, h, head, start);
        if (is_found)
          {
            head  = next.head;
            start = next.s;
          }
        h *= is_found ? 3. : 0.25;
      }
    std::tie(flow, converged) = step(conditions, 0., {}, start);
    if (!converged)
      throw RunError(
        format("the steady flow in unsaturated soil was not found: the balance "
               "of a vertex is missed by %.2g of its flow\n  remedy:  check "
               "the retention curves, change 'Seepage/Cells', or give a "
               "'Seepage/Initial water table'",
               flow.error));
    return flow;
  }

  std::vector<double>
  UnsaturatedFlow::water(const std::vector<double> &head) const
  {
    std::vector<double> all(head.size(), 0.);
    for (const Part &part : parts)
      all[part.vertex] +=
        part.volume * part.curve->at(head[part.vertex]).content;
    return all;
  }

  double
  UnsaturatedFlow::change(const std::vector<double> &from,
                          const std::vector<double> &to,
                          std::vector<double>       &change) const
  {
    change.resize(parts.size(), 0.);
    double largest = 0.;
    for (std::size_t i = 0; i < parts.size(); ++i)
      {
        const Retention   &curve  = *parts[i].curve;
        const unsigned int v      = parts[i].vertex;
        const double       actual = curve.at(to[v]).effective_saturation -
                              curve.at(from[v]).effective_saturation;
        largest   = std::max(largest, std::abs(actual - change[i]));
        change[i] = actual;
      }
    return largest;
  }

  dealii::Tensor<1, dim>
  unsaturated_velocity(const FlowMesh                             &mesh,
                       const std::vector<SymmetricTensor<2, dim>> &permeability,
                       const Retention                            &curve,
                       const std::vector<double>                  &head,
                       const unsigned int                          cell)
  {
    const auto             g = mesh.gradients(cell);
    dealii::Tensor<1, dim> gradient;
    gradient[1] = 1.;
    double k    = 0.;
    for (unsigned int i = 0; i < FlowMesh::n_corners; ++i)
      {
        const double psi = head[mesh.cells[cell][i]];
        gradient += psi * g[i];
        k += curve.at(psi).permeability / FlowMesh::n_corners;
      }
    return -k * (permeability[mesh.material[cell]] * gradient);
  }
} // namespace geocone::GEOCONE_DIM
