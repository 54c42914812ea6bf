// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Points of the subloading law: their history, explicit steps and output.
// Parameters and initial states: subloading.cc.
#include <geocone/base/types.h>
#include <geocone/kernels/spin.h>
#include <geocone/kernels/subloading_curves.h>
#include <geocone/kernels/subloading_kernel.h>
#include <geocone/laws/subloading.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    using Components = ConstitutiveLaw::Components;
    using Model      = SubloadingModel<n_spatial>;

    /** Indices in the history of a point; s_zz only in the plane. */
    enum
    {
      stress_zz,
      centre      = stress_zz + (dim == 2),
      inclination = centre + n_spatial,
      size        = inclination + n_spatial,
      structure
    };

    /** Names of the components in the order of the model, and their indices
     *  among those of the strain; the plane has no zz. */
    constexpr const char *component[6] = {"xx", "yy", "zz", "xy", "yz", "zx"};
    constexpr int place_in_motion[6]   = {0, 1, dim == 2 ? -1 : 3, 2, 4, 5};

    /** Mandel factor of component k of the model. */
    constexpr double
    factor(const int k)
    {
      return k < 3 ? 1. : sqrt2;
    }

    /** Copies a stress of the scene to that of the model, without changing
     *  other components. */
    void
    take_stress(const Components &s, Model::Vector &stress)
    {
      for (int k = 0; k < n_spatial; ++k)
        if (const int i = place_in_motion[k]; i >= 0)
          stress[k] = -factor(k) * s[i];
    }

    Components
    motion_of(const Model::Vector &t, const double sign)
    {
      Components s;
      for (int k = 0; k < n_spatial; ++k)
        if (const int i = place_in_motion[k]; i >= 0)
          s[i] = sign * (t[k] / factor(k));
      return s;
    }

    /** State of a point from its history h_k, k = 0, 1, ... */
    template <typename History>
    SubloadingState<n_spatial>
    state_of(const Components &s, const History &h)
    {
      SubloadingState<n_spatial> state;
      if (dim == 2)
        state.stress[2] = -h(stress_zz);
      take_stress(s, state.stress);
      for (int k = 0; k < n_spatial; ++k)
        {
          state.a[k]    = -factor(k) * h(centre + k);
          state.beta[k] = factor(k) * h(inclination + k);
        }
      state.pcb = h(size);
      state.Rb  = h(structure);
      return state;
    }

    template <typename History>
    void
    store(const SubloadingState<n_spatial> &state, const History &h)
    {
      if (dim == 2)
        h(stress_zz) = -state.stress[2];
      for (int k = 0; k < n_spatial; ++k)
        {
          const double per_factor = k < 3 ? 1. : 1. / sqrt2;
          h(centre + k)           = -per_factor * state.a[k];
          h(inclination + k)      = per_factor * state.beta[k];
        }
      h(size)      = state.pcb;
      h(structure) = state.Rb;
    }
  } // namespace

  std::string
  Subloading::initialise(const Stress &stress,
                         const double,
                         double *history) const
  {
    Model::Vector s;
    for (int k = 0; k < n_spatial; ++k)
      s[k] = -factor(k) * stress[k];
    SubloadingState<n_spatial> state;
    const std::string          changed = initial_state<n_spatial>(s, state);
    store(state, [&](const unsigned int k) -> double & { return history[k]; });
    return changed;
  }

  namespace
  {
    /** Rotated state and strain increment of a point. */
    void
    begin(const PointBlock           &block,
          const unsigned int          i,
          SubloadingState<n_spatial> &y,
          Model::Vector              &strain)
    {
      y            = state_of(block.stress(i),
                   [&](const unsigned int k) { return block.history[k][i]; });
      const auto l = block.gradient(i);
      const Spin spin(l);
      const auto turn = [&](Model::Vector &x) {
        Components s = motion_of(x, -1.);
        spin.turn(s);
        take_stress(s, x);
      };
      turn(y.stress);
      turn(y.a);
      turn(y.beta);

      strain = Model::Vector::Zero();
      if (block.l_zz != nullptr)
        strain[2] = -block.l_zz[i];
      for (unsigned int d = 0; d < dim; ++d)
        strain[d] = -l[(dim + 1) * d];
      for (unsigned int k = 0; k < n_shears; ++k)
        {
          const auto [place, a, b] = shears[k];
          strain[3 + k]            = -(l[dim * a + b] + l[dim * b + a]) / sqrt2;
        }
    }
  } // namespace

  void
  Subloading::advance(const PointBlock &block, LawCounts &counts) const
  {
    counts.updates += block.n_points;
    constexpr unsigned int     n_lanes = SubloadingLanes<n_spatial>::size;
    const Model               &law     = model<n_spatial>();
    SubloadingLanes<n_spatial> lanes;
    SubloadingState<n_spatial> y[n_lanes];
    Model::Vector              strain[n_lanes];
    for (unsigned int first = 0; first < block.n_points; first += n_lanes)
      {
        // Lanes beyond the last point copy it, and their results are ignored.
        const unsigned int n = std::min(n_lanes, block.n_points - first);
        for (unsigned int j = 0; j < n_lanes; ++j)
          {
            if (j < n)
              begin(block, first + j, y[j], strain[j]);
            lanes.put(y[std::min(j, n - 1)], strain[std::min(j, n - 1)], j);
          }
        take_single_substeps(law.constants(), lanes);
        for (unsigned int j = 0; j < n; ++j)
          {
            const Model::Vector before = y[j].stress;
            SubloadingReport    report;
            if (lanes.is_done[j])
              {
                report.substeps       = 1;
                report.plastic_strain = lanes.plastic_strain[j];
                lanes.take(j, y[j]);
              }
            else
              report = law.integrate(y[j], strain[j]);
            counts.substeps += report.substeps;
            counts.forced += report.forced;
            counts.limited += report.limited;
            counts.most = std::max(counts.most, report.substeps);

            const unsigned int i      = first + j;
            const auto         stress = y[j].stress;
            block.work[i]             = 0.5 * strain[j].dot(before + stress);
            block.plastic_strain[i] += report.plastic_strain;
            block.wave_modulus[i] =
              law.wave_modulus((stress[0] + stress[1] + stress[2]) / 3.);
            block.set_stress(i, motion_of(stress, -1.));
            store(y[j], [&](const unsigned int k) -> double & {
              return block.history[k][i];
            });
          }
      }
  }

  double
  Subloading::wave_modulus(const Stress &stress, const double *) const
  {
    return model<n_spatial>().wave_modulus(
      -(stress[0] + stress[1] + stress[2]) / 3.);
  }

  SubloadingState<n_spatial>
  Subloading::state(const Components &stress, const double *history) const
  {
    return state_of(stress, [&](const unsigned int k) { return history[k]; });
  }

  std::vector<ConstitutiveLaw::OutputQuantity>
  Subloading::output_quantities() const
  {
    std::vector<OutputQuantity> all;
    if (dim == 2)
      all.push_back({"stress_zz", "stress zz (Pa)"});
    for (const OutputQuantity &shown :
         std::vector<OutputQuantity>{{"mean_pressure", "p (Pa)"},
                                     {"deviatoric_stress", "q (Pa)"},
                                     {"subloading_ratio", "R (-)"},
                                     {"structure_ratio", "Rb (-)"},
                                     {"yield_surface_size", "pcb (Pa)"},
                                     {"anisotropy", "anisotropy (-)"}})
      all.push_back(shown);
    if (output_tensors)
      for (const bool is_centre : {false, true})
        for (int k = 0; k < n_spatial; ++k)
          all.push_back(
            {std::string(is_centre ? "centre_" : "inclination_") + component[k],
             std::string(is_centre ? "a " : "beta ") + component[k] +
               (is_centre ? " (Pa)" : " (-)")});
    return all;
  }

  void
  Subloading::output(const Components &stress,
                     const double     *history,
                     double           *values) const
  {
    const SubloadingState<n_spatial> y = state(stress, history);
    const double p = (y.stress[0] + y.stress[1] + y.stress[2]) / 3.;
    if (dim == 2)
      *values++ = -y.stress[2];
    *values++ = p;
    // sqrt(3/2) ||s|| and the same of beta, a stress ratio q/p.
    *values++ =
      std::sqrt(1.5 * std::max(0., y.stress.squaredNorm() - 3. * p * p));
    *values++ = model<n_spatial>().ratio(y);
    *values++ = y.Rb;
    *values++ = y.pcb;
    *values++ = std::sqrt(1.5) * y.beta.norm();
    if (output_tensors)
      for (const int first : {inclination, centre})
        for (int k = 0; k < n_spatial; ++k)
          *values++ = history[first + k];
  }

  std::vector<YieldCurve>
  Subloading::yield_curves(const Components   &stress,
                           const double       *history,
                           const SectionPlane &plane) const
  {
    return subloading_curves(model<n_spatial>(), state(stress, history), plane);
  }
} // namespace geocone::GEOCONE_DIM
