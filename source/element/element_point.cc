// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/types.h>
#include <geocone/element/element_point.h>
#include <geocone/kernels/subloading_curves.h>
#include <geocone/laws/subloading.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  const std::array<const char *, 6> component_names = {
    {"xx", "yy", "zz", "xy", "yz", "zx"}};

  double
  norm(const Tensor6 &x)
  {
    double sum = 0.;
    for (unsigned int i = 0; i < 6; ++i)
      sum += (i < 3 ? 1. : 2.) * x[i] * x[i];
    return std::sqrt(sum);
  }

  namespace
  {
    double
    pressure(const Tensor6 &stress)
    {
      return -(stress[0] + stress[1] + stress[2]) / 3.;
    }

    /** q = sqrt(3/2) ||s||. */
    double
    deviatoric_stress(Tensor6 stress)
    {
      const double p = pressure(stress);
      for (unsigned int i = 0; i < 3; ++i)
        stress[i] += p;
      return std::sqrt(1.5) * norm(stress);
    }

    /** Any law in plane strain: xx, yy, xy, optionally zz; by its explicit step
     *  without spin. */
    class InPlanePoint : public ElementPoint
    {
    public:
      InPlanePoint(const ConstitutiveLaw &law,
                   const bool             has_zz,
                   const Tensor6         &stress,
                   std::string           &changed)
        : law(law)
        , has_zz(has_zz)
        , shown(law.output_quantities())
      {
        now.stress = {{stress[0], stress[1], stress[3]}};
        now.history.resize(law.n_history());
        const ConstitutiveLaw::Stress s = {
          {stress[0], stress[1], stress[2], stress[3]}};
        changed  = law.initialise(s, 0., now.history.data());
        now.wave = law.wave_modulus(s, now.history.data());
        trial    = now;
      }

      bool
      has(const unsigned int component) const override
      {
        return component < 2 || component == 3 || (has_zz && component == 2);
      }

      Tensor6
      try_strain(const Tensor6 &strain) override
      {
        // Kernels may access as many points as a vector has lanes.
        using Lanes      = std::array<double, PointBlock::lanes>;
        const auto lanes = [](const double value) {
          Lanes all;
          all.fill(value);
          return all;
        };
        trial          = now;
        const Lanes xx = lanes(strain[0]), yy = lanes(strain[1]),
                    zz = lanes(strain[2]), xy = lanes(strain[3]);
        Lanes s_xx = lanes(now.stress[0]), s_yy = lanes(now.stress[1]),
              s_xy    = lanes(now.stress[2]), work, wave,
              plastic = lanes(now.plastic_strain);
        std::vector<Lanes>    values;
        std::vector<double *> history;
        for (const double h : now.history)
          values.push_back(lanes(h));
        for (Lanes &h : values)
          history.push_back(h.data());
        trial_counts = {};
        law.advance({1,
                     {{xx.data(), xy.data(), xy.data(), yy.data()}},
                     {{s_xx.data(), s_yy.data(), s_xy.data()}},
                     history.data(),
                     plastic.data(),
                     work.data(),
                     wave.data(),
                     0.,
                     has_zz ? zz.data() : nullptr},
                    trial_counts);
        trial.stress = {{s_xx[0], s_yy[0], s_xy[0]}};
        for (std::size_t k = 0; k < values.size(); ++k)
          trial.history[k] = values[k][0];
        trial.plastic_strain = plastic[0];
        trial.wave           = wave[0];
        return stress_of(trial);
      }

      void
      accept() override
      {
        now = trial;
        counts.add(trial_counts);
      }

      Tensor6
      stress() const override
      {
        return stress_of(now);
      }

      double
      modulus() const override
      {
        return now.wave;
      }

      std::vector<std::string>
      names() const override
      {
        std::vector<std::string> all;
        if (!shows_pressure())
          all = {"p (Pa)", "q (Pa)"};
        for (const ConstitutiveLaw::OutputQuantity &one : shown)
          all.push_back(one.title);
        all.push_back("plastic strain (-)");
        return all;
      }

      std::vector<double>
      values() const override
      {
        std::vector<double> all;
        if (!shows_pressure() && has_zz)
          all = {pressure(stress()), deviatoric_stress(stress())};
        else if (!shows_pressure())
          {
            // In-plane stresses, which control yielding.
            const double half = (now.stress[0] - now.stress[1]) / 2.;
            all               = {-(now.stress[0] + now.stress[1]) / 2.,
                                 2. * std::hypot(half, now.stress[2])};
          }
        std::vector<double> values(shown.size());
        law.output(now.stress, now.history.data(), values.data());
        all.insert(all.end(), values.begin(), values.end());
        all.push_back(now.plastic_strain);
        return all;
      }

      std::vector<YieldCurve>
      yield_curves(const SectionPlane &plane) const override
      {
        return law.yield_curves(now.stress, now.history.data(), plane);
      }

      void
      state(StateRow &row) override
      {
        row(now.stress, now.history, now.plastic_strain, now.wave, counts);
      }

    private:
      struct State
      {
        std::array<double, 3> stress{};
        std::vector<double>   history;
        double                plastic_strain = 0.;
        double                wave           = 0.;
      };

      Tensor6
      stress_of(const State &state) const
      {
        return {{state.stress[0],
                 state.stress[1],
                 law.stress_zz(state.stress, state.history.data()),
                 state.stress[2]}};
      }

      /** Whether the law outputs a pressure. */
      bool
      shows_pressure() const
      {
        return std::any_of(shown.begin(), shown.end(), [](const auto &one) {
          return one.name == "mean_pressure";
        });
      }

      const ConstitutiveLaw                    &law;
      const bool                                has_zz; ///< strain along z
      const std::vector<ConstitutiveLaw::OutputQuantity> shown;
      State                                     now, trial;
    };

    /** The subloading model with all six components. */
    class InSpacePoint : public ElementPoint
    {
    public:
      InSpacePoint(const Subloading &law,
                   const Tensor6    &stress,
                   std::string      &changed)
        : model(law.model<6>())
      {
        changed = law.initial_state<6>(to_model<6>(stress), now);
        trial   = now;
      }

      bool
      has(const unsigned int) const override
      {
        return true;
      }

      Tensor6
      try_strain(const Tensor6 &strain) override
      {
        trial = now;
        const SubloadingReport report =
          model.integrate(trial, to_model<6>(strain));
        trial_plastic_strain = plastic_strain + report.plastic_strain;
        trial_counts         = {
                  1, report.substeps, report.forced, report.limited, report.substeps};
        return from_model<6>(trial.stress, -1.);
      }

      void
      accept() override
      {
        now            = trial;
        plastic_strain = trial_plastic_strain;
        counts.add(trial_counts);
      }

      Tensor6
      stress() const override
      {
        return from_model<6>(now.stress, -1.);
      }

      double
      modulus() const override
      {
        return model.wave_modulus(pressure(stress()));
      }

      std::vector<std::string>
      names() const override
      {
        std::vector<std::string> all = {
          "p (Pa)", "q (Pa)", "R (-)", "Rb (-)", "pcb (Pa)", "anisotropy (-)"};
        for (const char *component : component_names)
          all.push_back(std::string("beta ") + component + " (-)");
        for (const char *component : component_names)
          all.push_back(std::string("a ") + component + " (Pa)");
        all.push_back("plastic strain (-)");
        return all;
      }

      std::vector<double>
      values() const override
      {
        const Tensor6       sigma = stress();
        std::vector<double> all   = {pressure(sigma),
                                     deviatoric_stress(sigma),
                                     model.ratio(now),
                                     now.Rb,
                                     now.pcb,
                                     std::sqrt(1.5) * now.beta.norm()};
        for (const double x : from_model<6>(now.beta, 1.))
          all.push_back(x);
        for (const double x : from_model<6>(now.a, -1.))
          all.push_back(x);
        all.push_back(plastic_strain);
        return all;
      }

      std::vector<YieldCurve>
      yield_curves(const SectionPlane &plane) const override
      {
        return subloading_curves(model, now, plane);
      }

      void
      state(StateRow &row) override
      {
        row(now.stress, now.a, now.beta, now.pcb, now.Rb);
        row(plastic_strain, counts);
      }

    private:
      const SubloadingModel<6> &model;
      SubloadingState<6>        now, trial;
      double                    plastic_strain = 0., trial_plastic_strain = 0.;
    };
  } // namespace

  std::unique_ptr<ElementPoint>
  make_element_point(const ConstitutiveLaw &law,
                     const StressComponents components,
                     const Tensor6         &stress,
                     std::string           &changed)
  {
    const auto *subloading = dynamic_cast<const Subloading *>(&law);
    if (components == StressComponents::all && subloading == nullptr)
      throw InputError("Element/Components",
                       "3D",
                       "automatic | plane strain | axisymmetric for this "
                       "material",
                       "a point of it has the stresses of the plane and zz");
    const bool has_zz = components == StressComponents::axisymmetric;
    if (has_zz || components == StressComponents::plane_strain ||
        subloading == nullptr)
      {
        if (stress[4] != 0. || stress[5] != 0.)
          throw InputError("Element/Initial stress",
                           stress[4] != 0. ? stress[4] : stress[5],
                           has_zz ? "yz = zx = 0 around an axis"
                                  : "yz = zx = 0 in plane strain",
                           "set 'Element/Components = 3D' if the material has "
                           "it");
        return std::make_unique<InPlanePoint>(law, has_zz, stress, changed);
      }
    return std::make_unique<InSpacePoint>(*subloading, stress, changed);
  }
} // namespace geocone::GEOCONE_DIM
