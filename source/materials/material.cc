// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/kernels/cone_kernel.h>
#include <geocone/kernels/spin.h>
#include <geocone/materials/material.h>

#include <array>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    const UsedWhere used_material[] = {{"Materials/*/Reduce strength",
                                        "Analysis/Kind",
                                        {"strength reduction"},
                                        "Loading/*/Strength factor"}};
  } // namespace

  Material::Material(const std::string &section)
    : Material(section, Stiffness::constant)
  {}

  Material::Material(const std::string &section, const Stiffness stiffness)
    : ConstitutiveLaw(section)
  {
    if (stiffness == Stiffness::constant)
      add_parameter(
        "Young modulus", young_modulus, "Young's modulus E [Pa], > 0.");
    add_parameter(
      "Poisson ratio", poisson_ratio, "Poisson's ratio nu [-], -1 < nu < 0.5.");
    add_parameter("Reduce strength",
                  reduced,
                  "Whether strength reduction ('Analysis/Kind' = strength "
                  "reduction, or 'Strength factor' of a stage) applies to this "
                  "material; false for structures.");
  }

  void
  Material::prepare()
  {
    ConstitutiveLaw::prepare();
    if (!(young_modulus > 0.))
      throw InputError(parameter("Young modulus"),
                       young_modulus,
                       "E > 0 Pa",
                       "soils have 1 MPa to 1 GPa");
    if (!(poisson_ratio > -1. && poisson_ratio < 0.5))
      throw InputError(parameter("Poisson ratio"),
                       poisson_ratio,
                       "-1 < nu < 0.5",
                       "for a nearly incompressible material take 0.49");
    elastic = Elasticity(young_modulus, poisson_ratio);
  }

  std::string
  Material::initialise(const Stress &stress,
                       const double,
                       double *history) const
  {
    if (dim == 2)
      history[0] = stress[2] - poisson_ratio * (stress[0] + stress[1]);
    return "";
  }

  double
  Material::stress_zz(const Components &stress, const double *history) const
  {
    return history[0] + poisson_ratio * (stress[0] + stress[1]);
  }

  SpatialMandel
  Material::whole_stress(const Mandel &stress, const double *history) const
  {
    return extended(stress,
                    dim == 2 ? stress_zz(components_of(stress), history) : 0.);
  }

  SpatialMandel
  Material::elastic_strain(const SpatialMandel &from,
                           const SpatialMandel &to,
                           const double *) const
  {
    return extended(elastic.strain(Mandel((to - from).head<n_mandel>())), 0.);
  }

  double
  Material::elastic_energy(const Mandel &stress, const double *history) const
  {
    const SpatialMandel whole = whole_stress(stress, history);
    return whole.dot(elastic_strain(SpatialMandel::Zero(), whole, history)) /
           2.;
  }

  std::optional<double>
  Material::overstress(const Mandel &stress, const double *history) const
  {
    if (const auto cone = flow_cone(history))
      return cone->yield_function(to_cone_axes(stress));
    return std::nullopt;
  }

  Mandel
  Material::nearest_admissible(const Mandel &stress,
                               const double *history) const
  {
    const auto cone = strength(history);
    return cone ? from_cone_axes(project(*cone, Mandel(to_cone_axes(stress))))
                : stress;
  }

  std::optional<FlowCone>
  Material::step_cone(const Mandel   &stress_n,
                      const double   *history_n,
                      const StepData &step) const
  {
    std::optional<FlowCone> cone = flow_cone(history_n);
    if (cone && step.friction_lag > 0.)
      cone = cone->delayed(step.friction_lag, to_cone_axes(stress_n)[0]);
    return cone;
  }

  std::optional<FlowCone>
  Material::end_cone(const Mandel   &stress_n,
                     const double   *history_n,
                     const StepData &step,
                     const double    slip) const
  {
    const auto cone = step_cone(stress_n, history_n, step);
    return cone ? cone->hardened(slip) : cone;
  }

  std::optional<FlowCone>
  Material::exact_end_cone(const double *history_n, const double slip) const
  {
    const auto cone = flow_cone(history_n);
    return cone ? cone->hardened(slip) : cone;
  }

  std::optional<FlowCheck>
  Material::check_flow(const PointStep &point, const StepData &step) const
  {
    if (!flow_cone(point.history_n))
      return std::nullopt;
    const Mandel stress_n = point.stress_n.head<n_mandel>(),
                 stress   = point.stress.head<n_mandel>();
    const Elasticity own  = elasticity_at(stress_n, point.history_n);
    const Mandel z = to_cone_axes(Mandel(own.strain(Mandel(stress - stress_n)) -
                                         point.strain.head<n_mandel>()));
    const double slip = FlowCone::tangential_norm(z);
    return FlowCheck::of_cone(*end_cone(stress_n, point.history_n, step, slip),
                              *exact_end_cone(point.history_n, slip),
                              z,
                              to_cone_axes(stress),
                              own.two_G);
  }

  void
  Material::reduce_strength(const double)
  {
    if (initial_cone())
      throw InputError(
        parameter("Type"),
        "a law that hardens",
        "Mohr-Coulomb, Tresca or linear elastic where a stage has "
        "a 'Strength factor'",
        "take the strength that counts, initial or final");
  }

  std::optional<FlowCone>
  Material::initial_cone() const
  {
    if (is_spatial()) // no hardening cone among them
      return flow_cone(nullptr);
    std::vector<double> history(n_history());
    initialise({}, 0., history.data());
    return flow_cone(history.data());
  }

  double
  Material::earth_pressure_at_rest() const
  {
    if (const std::optional<FlowCone> cone = initial_cone())
      return 1. - cone->a;
    return elastic.lambda / (elastic.lambda + elastic.two_G);
  }

  double
  Material::wave_modulus(const Stress &, const double *) const
  {
    return elastic.lambda + elastic.two_G;
  }

  void
  Material::advance(const PointBlock &block, LawCounts &counts) const
  {
    counts.updates += block.n_points;
    if (!has_history())
      if (const auto cone = flow_cone(nullptr); cone && !cone->is_cut())
        return advance_cone(*cone, elastic, block);
    constexpr unsigned int   size = PointBlock::capacity;
    std::array<Mandel, size> strain, stress_n, stress;
    std::array<Mode, size>   mode;
    const unsigned int       n = block.n_points, m = n_history();
    std::vector<double>      history_n(m * n);
    for (unsigned int p = 0; p < n; ++p)
      {
        for (unsigned int k = 0; k < m; ++k)
          history_n[m * p + k] = block.history[k][p];
        const auto l = block.gradient(p);
        auto       s = block.stress(p);
        Spin(l).turn(s);
        stress_n[p] = mandel_of_components(s);
        strain[p]   = symmetric_part(l);
      }
    std::vector<double> history = history_n;
    Response            response;
    response.stress  = dealii::ArrayView<Mandel>(stress.data(), n);
    response.mode    = dealii::ArrayView<Mode>(mode.data(), n);
    response.history = history.data();
    update({dealii::ArrayView<const Mandel>(strain.data(), n),
            dealii::ArrayView<const Mandel>(stress_n.data(), n),
            history_n.data(),
            m,
            {block.step},
            block.l_zz},
           response);
    for (unsigned int p = 0; p < n; ++p)
      {
        for (unsigned int k = 0; k < m; ++k)
          block.history[k][p] = history[m * p + k];
        const Mandel change    = stress[p] - stress_n[p];
        block.work[p]          = strain[p].dot(stress_n[p] + change / 2.);
        const double        zz = block.l_zz != nullptr ? block.l_zz[p] : 0.;
        const SpatialMandel whole_n =
          whole_stress(stress_n[p], history_n.data() + m * p);
        const double *const own   = history.data() + m * p;
        const SpatialMandel whole = whole_stress(stress[p], own);
        if (block.l_zz != nullptr)
          block.work[p] += zz * (whole_n[3] + whole[3]) / 2.;
        block.plastic_strain[p] +=
          mode[p] == Mode::elastic
            ? 0.
            : (extended(strain[p], zz) - elastic_strain(whole_n, whole, own))
                .norm();
        block.set_stress(p, components_of(stress[p]));
        block.wave_modulus[p] = wave_modulus(stress_of(whole), own);
      }
  }

  double
  Material::non_associativity() const
  {
    const std::optional<FlowCone> cone = initial_cone();
    return cone && cone->a > 0. ? (cone->a - cone->b) / cone->a : 0.;
  }

  std::vector<YieldCurve>
  Material::yield_curves(const Components &,
                         const double       *history,
                         const SectionPlane &plane) const
  {
    const auto cone = flow_cone(history);
    if (!cone)
      return {};
    const double p = plane.largest_p;
    const double tip =
      cone->a > 0. ? -cone->k / (sqrt2 * cone->a) : std::min(0., -p);
    const double q      = 2. * cone->a * p + sqrt2 * cone->k;
    const double at_tip = cone->a > 0. ? 0. : sqrt2 * cone->k;
    const double T      = cone->cut_off / sqrt2;
    if (cone->is_cut() && (cone->a == 0. || -T > tip))
      {
        const double corner = (cone->k / sqrt2 - T) / (1. - cone->a);
        const double there  = 2. * (corner + T);
        return {{{p, -q}, {corner, -there}, {-T, 0.}, {corner, there}, {p, q}}};
      }
    return {{{p, -q}, {tip, -at_tip}, {tip, at_tip}, {p, q}}};
  }
} // namespace geocone::GEOCONE_DIM
