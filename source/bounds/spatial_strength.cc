// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/bounds/spatial_strength.h>
#include <geocone/laws/drucker_prager.h>
#include <geocone/laws/spatial_mohr_coulomb.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    /** Error of computed eigenvalues of symmetric 3 x 3 matrices, relative to their norm:
     *  some ten units of the last place, by Weyl's theorem. */
    constexpr double of_eigenvalues = 1e-14;

    /** Eigenvalues in increasing order. */
    Eigen::Vector3d
    eigenvalues_of(const Eigen::Matrix3d &m)
    {
      return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(
               m, Eigen::EigenvaluesOnly)
        .eigenvalues();
    }

    std::string
    section_of(const Scene &scene, const unsigned int material)
    {
      return "Materials/" + scene.materials.name(material);
    }

    const std::string bounded_laws =
      (dim == 3 ? "Mohr-Coulomb | Tresca"
                : "spatial Mohr-Coulomb | spatial Tresca") +
      std::string(" | Drucker-Prager | von Mises where loads are bounded");
  } // namespace

  double
  SpatialStrength::face_friction() const
  {
    return is_circular ? std::sqrt(3. * a * a / (2. - 4. * a * a))
                       : a / std::sqrt(1. - a * a);
  }

  double
  SpatialStrength::face_cohesion_per_k() const
  {
    if (!is_circular)
      return 1. / (2. * std::sqrt(1. - a * a));
    return a > 0. ? face_friction() / (a * std::sqrt(3.)) : 1. / std::sqrt(2.);
  }

  void
  SpatialStrength::reduce(const double F)
  {
    const double cut = tension / F;
    double       by  = F; // of k = 2 c cos(phi)
    if (!is_circular)
      {
        const double cosine = std::sqrt(1. - a * a), sine = a;
        a = sine / std::hypot(F * cosine, sine);
        by *= cosine / std::sqrt(1. - a * a);
      }
    scale(by);
    tension = cut;
  }

  double
  SpatialStrength::utilisation(const double           k_here,
                               const Eigen::Matrix3d &s) const
  {
    const double guard = of_eigenvalues * s.norm();
    // The excess of a stress over no strength is relative to its norm.
    const auto over_strength = [&](const double demand) {
      return k_here > 0.   ? demand / k_here
             : demand > 0. ? 1. + demand / s.norm()
                           : 0.;
    };
    if (is_circular)
      {
        const double mean = s.trace() / 3.;
        return over_strength((s - mean * Eigen::Matrix3d::Identity()).norm() +
                             a * std::sqrt(3.) * mean + guard);
      }
    const Eigen::Vector3d l = eigenvalues_of(s);
    const double          of_pyramid =
      over_strength((1. + a) * l[2] - (1. - a) * l[0] + 4. * guard);
    return is_cut() ? std::max(of_pyramid, (l[2] + guard) / tension)
                    : of_pyramid;
  }

  SpatialStrength::Flow
  SpatialStrength::flow(const double k_here, const Eigen::Matrix3d &e) const
  {
    Flow         flow;
    const double trace = e.trace(), guard = of_eigenvalues * e.norm();
    if (is_circular)
      {
        const double shear =
          (e - trace / 3. * Eigen::Matrix3d::Identity()).norm();
        const double expansion = trace / std::sqrt(3.);
        if (a > 0.)
          {
            flow.miss        = a * shear - expansion + guard;
            flow.dissipation = k_here / a * expansion;
          }
        else
          {
            flow.constrained = std::abs(trace);
            flow.dissipation = k_here * shear;
          }
        return flow;
      }
    const double sum = eigenvalues_of(e).cwiseAbs().sum();
    if (is_cut())
      {
        // s_1 = T and s_3 = ((1 + a) T - k)/(1 - a), by the signs of the rates.
        const double shortening = (sum - trace) / 2. / (1. - a);
        flow.miss               = a * sum - trace + 4. * guard;
        flow.dissipation =
          tension * ((sum + trace) / 2. - (1. + a) * shortening) +
          k_here * shortening + (tension + k_here) * 4. * guard;
      }
    else if (a > 0.)
      {
        flow.miss        = a * sum - trace + 4. * guard;
        flow.dissipation = k_here / (2. * a) * trace;
      }
    else
      {
        flow.constrained = std::abs(trace);
        flow.dissipation = k_here / 2. * sum;
      }
    return flow;
  }

  SpatialStrength::Flow
  SpatialStrength::flow_of_jump(const double c,
                                const double u_n,
                                const double u_t) const
  {
    if (is_cut())
      {
        // Strain of a thin layer, sym(u x n).
        Eigen::Matrix3d e = Eigen::Matrix3d::Zero();
        e(0, 0)           = u_n;
        e(0, 1) = e(1, 0) = u_t / 2.;
        return flow(c / face_cohesion_per_k(), e);
      }
    Flow         flow;
    const double mu = face_friction();
    if (mu > 0.)
      {
        flow.miss = mu * u_t - u_n + of_eigenvalues * std::hypot(u_n, u_t);
        flow.dissipation = c / mu * u_n;
      }
    else
      {
        flow.constrained = std::abs(u_n);
        flow.dissipation = c * u_t;
      }
    return flow;
  }

  namespace
  {
    /** Takes the tensile strength of a material. */
    void
    take_tension(SpatialStrength          &one,
                 const FrictionalStrength &given,
                 const std::string        &section)
    {
      if (!std::isfinite(given.tension))
        return;
      const std::string parameter = section + "/Tensile strength";
      if (given.tension == 0.)
        throw InputError(parameter,
                         0,
                         "none, or > 0 Pa where loads are bounded",
                         "free surfaces would be at their strength whatever "
                         "the load: give a small one, e.g. a hundredth of the "
                         "cohesion");
      if (given.gradient != 0.)
        throw InputError(parameter,
                         given.tension,
                         "none beside a 'Cohesion gradient' where loads are "
                         "bounded in three dimensions",
                         "take layers instead of the gradient");
      one.tension = given.tension;
    }
  } // namespace

  std::vector<SpatialStrength>
  spatial_strengths(const Scene &scene)
  {
    scene.materials.refuse_strength_formulas(
      "in bounds around an axis and in three dimensions");
    std::vector<SpatialStrength> strengths;
    scene.materials.check_closed_form("limit load");
    for (unsigned int m = 0; m < scene.materials.size(); ++m)
      {
        const Material   &law     = scene.materials[m];
        const std::string section = section_of(scene, m);
        SpatialStrength   one;
        if (const auto *pyramid =
              dynamic_cast<const SpatialMohrCoulomb *>(&law))
          {
            const FrictionalStrength given = *pyramid->plane_strain_strength();
            const double             phi   = radians(given.phi);
            one.a                          = std::sin(phi);
            one.k                          = 2. * given.c * std::cos(phi);
            one.growth = {2. * given.gradient * std::cos(phi), given.level};
            one.is_associated = given.theta >= given.phi;
            take_tension(one, given, section);
          }
        else if (const auto *circular =
                   dynamic_cast<const DruckerPrager *>(&law))
          {
            const FlowCone cone = circular->spatial_cone();
            one.is_circular     = true;
            one.a               = cone.a;
            one.k               = cone.k;
            one.is_associated   = cone.b >= cone.a * (1. - 1e-12);
            if (!circular->has_constant_cohesion())
              throw InputError(section + "/Cohesion gradient",
                               "a cohesion that varies",
                               "a constant one with Drucker-Prager or von "
                               "Mises where loads are bounded",
                               "take Mohr-Coulomb or Tresca, or layers");
            if (!(cone.a < 0.7))
              throw InputError(section + "/Friction angle",
                               "a cone as wide as this",
                               "a < 0.7 of the cone |s_t| <= a s_n + k where "
                               "loads are bounded",
                               "jumps of velocities are then not admissible; "
                               "take Mohr-Coulomb, or another 'Match'");
          }
        else
          throw InputError(section + "/Type",
                           ParameterFile::value(section + "/Type"),
                           bounded_laws,
                           "bounds are those of these laws; what cannot yield "
                           "carries any load: leave it out of the domain");
        if (law.hardens())
          throw InputError(section + "/Type",
                           "a law that hardens",
                           bounded_laws,
                           "take the strength that counts, initial or final");
        strengths.push_back(one);
      }
    return strengths;
  }

  void
  check_reducible(const Scene                        &scene,
                  const std::vector<SpatialStrength> &strengths)
  {
    for (unsigned int m = 0; m < strengths.size(); ++m)
      if (strengths[m].is_circular && strengths[m].a > 0.)
        {
          const std::string type = section_of(scene, m) + "/Type";
          throw InputError(type,
                           ParameterFile::value(type),
                           "Mohr-Coulomb | Tresca | von Mises where the "
                           "strength is reduced",
                           "c and tan(phi) are those of Mohr-Coulomb");
        }
  }

  double
  positive_strength(const Scene                        &scene,
                    const std::vector<SpatialStrength> &strengths,
                    const unsigned int                  material,
                    const dealii::Point<dim>           &x)
  {
    const double k = strengths[material].k_at(x);
    if (!(k > 0.))
      throw InputError(
        section_of(scene, material) + "/Cohesion",
        0,
        "> 0 Pa everywhere where loads are bounded around an axis",
        "give a small cohesion, e.g. a hundredth of weight times height: it "
        "raises the bounds a little");
    return k;
  }
} // namespace geocone::GEOCONE_DIM
