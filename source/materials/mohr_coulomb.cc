// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/materials/cone_kernel.h>
#include <geocone/materials/mohr_coulomb.h>
#include <geocone/materials/varying_cone.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>

namespace geocone
{
  MohrCoulomb::MohrCoulomb(const std::string &section)
    : Material(section)
  {
    given.declare(*this);
    add_parameter("Friction memory",
                  memory_text,
                  "Time (s) in which the strength follows the normal stress, "
                  ">= 0; it makes flow with little dilatancy well-posed. 0: at "
                  "once, the exact law. Automatic: 0, but for FEM (for MPM if "
                  "nu > 0.49) and a soil with theta below about phi/2 and "
                  "sin(phi) - sin(theta) > 0.2 that a part of the boundary is "
                  "pushed into: B/1000 over its speed, B its length (twice "
                  "that with 'Observation/Factor' = -2 or 2); and with 'Time "
                  "stepping/Friction' = exact it is 0 always.");
  }

  MohrCoulomb::MohrCoulomb(const std::string &section, const WithoutFriction &)
    : Material(section)
    , given(FrictionalStrength::without_friction())
    , memory_text("0")
  {
    given.declare_cohesion(*this, "Undrained shear strength c (Pa), > 0.");
  }

  void
  MohrCoulomb::prepare()
  {
    Material::prepare();
    given.check(parameter());
    set_cone(1.);
    prepare_memory();
  }

  void
  MohrCoulomb::set_cone(const double F)
  {
    const FrictionalStrength now = given.reduced(F);
    cone                         = cone_of(now.c, now.phi, now.theta);
  }

  FlowCone
  MohrCoulomb::cone_of(const double cohesion,
                       const double phi,
                       const double theta)
  {
    FlowCone cone;
    cone.a = std::sin(radians(phi));
    cone.b = std::min(std::sin(radians(theta)), cone.a);
    cone.k = sqrt2 * cohesion * std::cos(radians(phi));
    return cone;
  }

  void
  MohrCoulomb::reduce_strength(const double F)
  {
    if (has_history() && n_history() > MohrCoulomb::n_history())
      Material::reduce_strength(F);
    set_cone(F);
  }

  void
  MohrCoulomb::prepare_memory()
  {
    tau = 0.;
    if (memory_text == "automatic")
      return;
    std::optional<double> given;
    try
      {
        given = dealii::Utilities::string_to_double(memory_text);
      }
    catch (const dealii::ExceptionBase &)
      {}
    if (!given || !(*given >= 0.) || !std::isfinite(*given))
      throw InputError(parameter("Friction memory"),
                       memory_text,
                       "automatic | a time >= 0 s",
                       "0 is the exact law; take a time in which what is "
                       "loaded moves by a thousandth of its length");
    if (cone.b < cone.a) // or else nothing is to be remembered
      tau = *given;
  }

  void
  MohrCoulomb::set_friction_memory(const double time)
  {
    // As strong as theta = 0 at phi = 12: less is easy without.
    constexpr double least = 0.2;
    if (memory_text == "automatic" && non_associativity() > hard_flow &&
        cone.a - cone.b > least)
      tau = time;
  }

  std::string
  MohrCoulomb::initialise(const Stress &stress,
                          const double  size,
                          double       *history) const
  {
    if (tau > 0.)
      history[memory] = -(stress[0] + stress[1]) / sqrt2;
    return Material::initialise(stress, size, history);
  }

  std::vector<ConstitutiveLaw::Shown>
  MohrCoulomb::shown() const
  {
    std::vector<Shown> all = Material::shown();
    if (tau > 0.)
      all.push_back({"remembered_normal_stress", "remembered s_n (Pa)"});
    return all;
  }

  void
  MohrCoulomb::show(const Components &stress,
                    const double     *history,
                    double           *values) const
  {
    Material::show(stress, history, values);
    if (tau > 0.)
      values[Material::shown().size()] = history[memory];
  }

  std::optional<FlowCone>
  MohrCoulomb::step_cone(const Mandel  &stress_n,
                         const double  *history_n,
                         const StepLaw &step) const
  {
    return with_memory(*flow_cone(history_n), stress_n, history_n, step);
  }

  FlowCone
  MohrCoulomb::with_memory(const FlowCone &exact,
                           const Mandel   &stress_n,
                           const double   *history_n,
                           const StepLaw  &step) const
  {
    // A solver's lag takes more of the past.
    if (tau > 0.)
      {
        const double part = remembered(step.size);
        return exact.delayed(part + (1. - part) * step.friction_lag,
                             history_n[memory]);
      }
    return step.friction_lag > 0.
             ? exact.delayed(step.friction_lag, to_cone_axes(stress_n)[0])
             : exact;
  }

  Mode
  MohrCoulomb::return_to_cone(const Mandel  &trial,
                              const Mandel  &stress_n,
                              const double  *history_n,
                              const StepLaw &step,
                              Mandel        &stress,
                              double        &slip,
                              MandelMatrix  *tangent) const
  {
    const double K     = elasticity().normal_stiffness(),
                 two_G = elasticity().two_G;
    if (varies())
      return return_map_varying(
        [&](const double g) { return *end_cone(stress_n, history_n, step, g); },
        K,
        two_G,
        trial,
        stress,
        tangent,
        slip);
    const Mode mode = return_map(
      *step_cone(stress_n, history_n, step), K, two_G, trial, stress, tangent);
    slip = FlowCone::tangential_norm(Mandel(trial - stress)) / two_G;
    return mode;
  }

  std::optional<FlowCone>
  MohrCoulomb::strength(const double *history) const
  {
    const std::optional<FlowCone> exact = flow_cone(history);
    return tau > 0. ? exact->delayed(1., history[memory]) : exact;
  }

  void
  MohrCoulomb::advance(const PointBlock &block, LawCounts &counts) const
  {
    const bool only_remembers =
      tau > 0. && n_history() == MohrCoulomb::n_history();
    if (!only_remembers)
      return Material::advance(block, counts);
    counts.updates += block.n_points;
    advance_cone(cone, elasticity(), block, remembered(block.step), memory);
  }

  void
  MohrCoulomb::update(const Increment &increment,
                      const Response  &response) const
  {
    const double       K               = elasticity().normal_stiffness();
    const double       two_G           = elasticity().two_G;
    const bool         linear          = response.tangent.size() > 0;
    const MandelMatrix elastic_tangent = elasticity().stiffness();
    const bool         fixed           = !has_history();
    const bool         is_plain = fixed && increment.step.friction_lag == 0.;
    const double       part     = remembered(increment.step.size);
    for (std::size_t p = 0; p < increment.strain.size(); ++p)
      {
        const std::size_t first = increment.n_history * p;
        const Mandel      trial =
          increment.stress_n[p] + elasticity().stress(increment.strain[p]);
        const Mandel        in_axes = to_cone_axes(trial);
        Mandel              returned;
        MandelMatrix        tangent;
        MandelMatrix *const wanted = linear ? &tangent : nullptr;
        double              slip   = 0.;
        response.mode[p] =
          is_plain ? return_map(cone, K, two_G, in_axes, returned, wanted)
                   : return_to_cone(in_axes,
                                    increment.stress_n[p],
                                    increment.history_n + first,
                                    increment.step,
                                    returned,
                                    slip,
                                    wanted);
        if (!fixed && response.history != nullptr)
          {
            double *history = response.history + first;
            if (tau > 0.)
              history[memory] =
                part * history[memory] + (1. - part) * returned[0];
            add_to_history(slip, history);
          }
        // An elastic point keeps its trial stress to the last digit.
        const bool elastic = response.mode[p] == Mode::elastic;
        response.stress[p] = elastic ? trial : from_cone_axes(returned);
        if (linear)
          response.tangent[p] =
            elastic ? elastic_tangent : from_cone_axes(tangent);
      }
  }
} // namespace geocone
