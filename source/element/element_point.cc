// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/types.h>
#include <geocone/element/element_point.h>
#include <geocone/materials/material.h>
#include <geocone/materials/modified_cam_clay.h>
#include <geocone/materials/subloading.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace geocone
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

    /** Mandel vector, compression positive, of a tensor, tension positive. */
    template <int n>
    typename SubloadingModel<n>::Vector
    to_model(const Tensor6 &x)
    {
      typename SubloadingModel<n>::Vector y;
      for (unsigned int i = 0; i < n; ++i)
        y[i] = -(i < 3 ? 1. : sqrt2) * x[i];
      return y;
    }

    /** @param sign -1 turns compression positive into tension positive. */
    template <int n>
    Tensor6
    from_model(const Eigen::Matrix<double, n, 1> &x, const double sign)
    {
      Tensor6 y{};
      for (unsigned int i = 0; i < n; ++i)
        y[i] = sign * x[i] / (i < 3 ? 1. : sqrt2);
      return y;
    }

    /**
     * The curve fbar(a + (sigma - a)/R) = 0 with sigma = p I + q sqrt(2/3) d: a
     * quadratic in q for each p.
     */
    template <int n>
    Surface
    section(const std::string                         &name,
            const SubloadingModel<n>                  &model,
            const SubloadingState<n>                  &y,
            const double                               R,
            const typename SubloadingModel<n>::Vector &d)
    {
      using Vector    = typename SubloadingModel<n>::Vector;
      Vector identity = Vector::Zero();
      identity.template head<3>().setOnes();
      const double pa    = y.a.dot(identity) / 3.;
      const double xi    = model.constants().xi;
      const auto   value = [&](const double p, const double q) {
        const Vector sigma = p * identity + q * std::sqrt(2. / 3.) * d;
        return model.yield_function(y.a + (sigma - y.a) / R, y.beta, y.pcb);
      };
      std::vector<std::pair<double, double>> upper, lower;
      const unsigned int                     n_points = 120;
      for (unsigned int i = 0; i <= n_points; ++i)
        {
          const double part = (1. - std::cos(pi * i / n_points)) / 2.;
          const double p    = pa + R * ((part - xi) * y.pcb - pa);
          const double q = y.pcb, f = value(p, 0.);
          const double plus = value(p, q), minus = value(p, -q);
          const double A = (plus + minus - 2. * f) / (2. * q * q);
          const double B = (plus - minus) / (2. * q);
          // At both ends of p the roots meet, up to rounding.
          const double D = B * B - 4. * A * f;
          if (!(D >= -1e-9 * (B * B + std::abs(4. * A * f))))
            continue;
          const double root = std::sqrt(std::max(0., D));
          upper.emplace_back(p, (-B + root) / (2. * A));
          lower.emplace_back(p, (-B - root) / (2. * A));
        }
      Surface surface{name, upper};
      surface.p_and_q.insert(
        surface.p_and_q.end(), lower.rbegin(), lower.rend());
      if (!upper.empty())
        surface.p_and_q.push_back(upper.front());
      return surface;
    }

    template <int n>
    std::vector<Surface>
    subloading_surfaces(const SubloadingModel<n> &model,
                        const SubloadingState<n> &y,
                        const Tensor6            &stress,
                        const unsigned int        axis)
    {
      typename SubloadingModel<n>::Vector d = to_model<n>(stress);
      const double                        p = (d[0] + d[1] + d[2]) / 3.;
      d.template head<3>().array() -= p;
      if (d.norm() < 1e-9 * std::abs(p))
        {
          d.setZero();
          d.template head<3>().setConstant(-0.5);
          d[axis < 3 ? axis : 1] = 1.;
        }
      d *= (axis < 3 && d[axis] < 0. ? -1. : 1.) / d.norm();
      std::vector<Surface> surfaces = {section("yield", model, y, 1., d)};
      const double         R        = model.ratio(y);
      if (R > 1e-6)
        surfaces.push_back(section("subloading", model, y, R, d));
      return surfaces;
    }

    /** The ellipse q^2 = M^2 (p + a) (pc - p). */
    Surface
    ellipse(const ModifiedCamClay &law, const double pc)
    {
      const double           size = pc + law.attraction();
      Surface                surface{"yield", {}};
      constexpr unsigned int n_points = 240;
      for (unsigned int i = 0; i <= n_points; ++i)
        {
          const double angle = 2. * pi * i / n_points;
          surface.p_and_q.emplace_back(
            size / 2. * (1. + std::cos(angle)) - law.attraction(),
            law.critical_slope() * size / 2. * std::sin(angle));
        }
      return surface;
    }

    /** Any law in plane strain: xx, yy, xy; or with zz, too; by its explicit step
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
        , subloading(dynamic_cast<const Subloading *>(&law))
        , shown(law.shown())
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
        // Kernels may take as many points as a vector has lanes.
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
        for (const ConstitutiveLaw::Shown &one : shown)
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
            // Those of the plane, on which yielding depends.
            const double half = (now.stress[0] - now.stress[1]) / 2.;
            all               = {-(now.stress[0] + now.stress[1]) / 2.,
                                 2. * std::hypot(half, now.stress[2])};
          }
        std::vector<double> values(shown.size());
        law.show(now.stress, now.history.data(), values.data());
        all.insert(all.end(), values.begin(), values.end());
        all.push_back(now.plastic_strain);
        return all;
      }

      std::vector<Surface>
      surfaces(const Tensor6     &stress,
               const unsigned int axis,
               const double       largest_p) const override
      {
        if (subloading != nullptr)
          return subloading_surfaces(
            subloading->model<4>(),
            subloading->state(now.stress, now.history.data()),
            stress,
            axis);
        if (const auto *cam_clay = dynamic_cast<const ModifiedCamClay *>(&law))
          return {
            ellipse(*cam_clay, cam_clay->preconsolidation(now.history.data()))};
        const auto *material = dynamic_cast<const Material *>(&law);
        if (material == nullptr || !material->flow_cone(now.history.data()))
          return {};
        // |s_t| <= a s_n + k with s_n = sqrt2 p, |s_t| = q/sqrt2.
        const FlowCone cone = *material->flow_cone(now.history.data());
        const double   tip =
          cone.a > 0. ? -cone.k / (sqrt2 * cone.a) : std::min(0., -largest_p);
        const double q      = 2. * cone.a * largest_p + sqrt2 * cone.k;
        const double at_tip = cone.a > 0. ? 0. : sqrt2 * cone.k;
        return {
          {"yield",
           {{largest_p, -q}, {tip, -at_tip}, {tip, at_tip}, {largest_p, q}}}};
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

      /** Whether the law has a pressure of its own. */
      bool
      shows_pressure() const
      {
        return std::any_of(shown.begin(), shown.end(), [](const auto &one) {
          return one.name == "mean_pressure";
        });
      }

      const ConstitutiveLaw                    &law;
      const bool                                has_zz;     ///< strain along z
      const Subloading *const                   subloading; ///< or null
      const std::vector<ConstitutiveLaw::Shown> shown;
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

      std::vector<Surface>
      surfaces(const Tensor6     &stress,
               const unsigned int axis,
               const double) const override
      {
        return subloading_surfaces(model, now, stress, axis);
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
} // namespace geocone
