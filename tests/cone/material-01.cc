// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// If this failed, a material would not have the strength that its parameters
// say, or its stresses would depend on how points are batched. Strengths and
// stress paths are compared with formulas by hand, in units of the cohesion.

#include <geocone/base/exceptions.h>
#include <geocone/laws/material_library.h>

#include "../test.h"
#include "cone_tests.h"
#include <memory>
#include <vector>

namespace cone_material_01
{
  using namespace cone_tests;
  using namespace geocone;

  /** One point, without and with the tangent. */
  Mode
  update(const Material &material,
         const Mandel   &stress_n,
         const Mandel   &strain,
         Mandel         &stress,
         MandelMatrix   *tangent = nullptr)
  {
    Mode mode;
    material.update(
      {dealii::ArrayView<const Mandel>(&strain, 1),
       dealii::ArrayView<const Mandel>(&stress_n, 1)},
      {dealii::ArrayView<Mandel>(&stress, 1),
       dealii::ArrayView<Mode>(&mode, 1),
       dealii::ArrayView<MandelMatrix>(tangent, tangent != nullptr)});
    return mode;
  }

  const char *
  name(const Mode mode)
  {
    return mode == Mode::elastic ? "elastic"
           : mode == Mode::cone  ? "cone"
                                 : "apex";
  }

  constexpr double c = 2000., E = 1e8, nu = 0.3;

  /** |sigma - by hand|/c. */
  void
  compare(const std::string &what,
          const Mode         mode,
          const Mandel      &stress,
          const Mandel      &by_hand)
  {
    std::cout << "  " << what << ": " << name(mode) << ", stress/c "
              << stress[0] / c << " " << stress[1] / c << " " << stress[2] / c;
    print(", as by hand", (stress - by_hand).norm() < 1e-9 * c);
  }

  /**
   * The strength in uniaxial compression, s_yy = -2 c cos(phi)/(1 - sin(phi)),
   * and in simple shear at the pressure p, |s_xy| = p sin(phi) + c cos(phi).
   */
  void
  check_strength(const Material &material, const double phi)
  {
    const double uniaxial = 2. * c * std::cos(phi) / (1. - std::sin(phi));
    const double p = 3. * c, shear = p * std::sin(phi) + c * std::cos(phi);
    std::cout << "  strength/c: uniaxial " << uniaxial / c << ", shear "
              << shear / c << "; just below and above:";
    for (const double factor : {1. - 1e-9, 1. + 1e-9})
      {
        Mandel s;
        std::cout << " "
                  << name(update(material,
                                 Mandel(0., -factor * uniaxial, 0.),
                                 Mandel::Zero(),
                                 s));
        std::cout << " "
                  << name(update(material,
                                 Mandel(-p, -p, -factor * sqrt2 * shear),
                                 Mandel::Zero(),
                                 s));
      }
    std::cout << std::endl;
  }

  /** Compression e_yy = -e of a confined column, from zero stress, in one step.
   */
  void
  check_oedometer(const Material &material,
                  const double    phi,
                  const double    theta)
  {
    const double G = E / 2. / (1. + nu), lambda = 2. * G * nu / (1. - 2. * nu);
    const double a = std::sin(phi), b = std::sin(theta);

    // Elastic: s_xx = -lambda e, s_yy = -(lambda + 2G) e.
    Mandel s, s_back;
    double e    = 1e-6;
    Mode   mode = update(material, Mandel::Zero(), Mandel(0., -e, 0.), s);
    compare("small", mode, s, Mandel(-lambda * e, -(lambda + 2. * G) * e, 0.));

    // Plastic: Mohr's circle with pressure p and radius r = p sin(phi) + c
    // cos(phi). The flow g adds 2(lambda + G) b g to p and takes 2G g from r:
    //   p = (lambda + G) e + 2 (lambda + G) b g,  r = G e - 2 G g.
    e              = 1e-3;
    const double g = (G * e - a * (lambda + G) * e - c * std::cos(phi)) /
                     (2. * G + 2. * a * b * (lambda + G));
    const double p = (lambda + G) * (e + 2. * b * g);
    const double r = p * a + c * std::cos(phi);
    mode           = update(material, Mandel::Zero(), Mandel(0., -e, 0.), s);
    compare("large", mode, s, Mandel(-p + r, -p - r, 0.));

    // Back by less than the way to the other side: elastic.
    mode = update(material, s, Mandel(0., 2e-5, 0.), s_back);
    compare(
      "back", mode, s_back, s + 2e-5 * Mandel(lambda, lambda + 2. * G, 0.));
    mode = update(material, s, Mandel::Zero(), s_back);
    print("  no change without strain", (s_back - s).norm() < 1e-12 * s.norm());
  }

  /** Isotropic extension with some shear. */
  void
  check_tension(const Material &material, const double phi)
  {
    Mandel       s;
    MandelMatrix C;
    const Mode   mode =
      update(material, Mandel::Zero(), Mandel(1e-2, 1e-2, 1e-5), s, &C);
    if (phi > 0.)
      {
        const double tip = c / std::tan(phi);
        compare("tension", mode, s, Mandel(tip, tip, 0.));
        print("  without any digit of shear, and without stiffness",
              s[0] == s[1] && s[2] == 0. && C.isZero(0.));
      }
    else
      {
        compare("tension",
                mode,
                s,
                material.elasticity().stress(Mandel(1e-2, 1e-2, 1e-5)));
      }
  }

  void
  check_batches(const Material &material)
  {
    Random                    random;
    const unsigned int        n = 300;
    std::vector<Mandel>       strain(n), stress_n(n), stress(n), stress_only(n);
    std::vector<MandelMatrix> tangent(n);
    std::vector<Mode>         mode(n), mode_only(n);
    for (unsigned int i = 0; i < n; ++i)
      {
        stress_n[i] = c * random.vector<Mandel>(1.);
        strain[i]   = random.vector<Mandel>(i % 2 == 0 ? 1e-5 : 1e-4);
        // Some points under pressure, where they stay elastic.
        if (i % 3 == 0)
          stress_n[i] -= 5. * c * Mandel(1., 1., 0.);
      }
    const Increment increment = {
      dealii::ArrayView<const Mandel>(strain.data(), n),
      dealii::ArrayView<const Mandel>(stress_n.data(), n)};
    material.update(increment,
                    {dealii::ArrayView<Mandel>(stress.data(), n),
                     dealii::ArrayView<Mode>(mode.data(), n),
                     dealii::ArrayView<MandelMatrix>(tangent.data(), n)});
    material.update(increment,
                    {dealii::ArrayView<Mandel>(stress_only.data(), n),
                     dealii::ArrayView<Mode>(mode_only.data(), n),
                     dealii::ArrayView<MandelMatrix>()});

    unsigned int counts[3] = {};
    bool    same = true, without = true, exact = true, elastic_tangent = true;
    Largest violation;
    for (unsigned int i = 0; i < n; ++i)
      {
        Mandel       s;
        MandelMatrix C;
        const Mode   one = update(material, stress_n[i], strain[i], s, &C);
        same = same && one == mode[i] && s == stress[i] && C == tangent[i];
        without =
          without && mode_only[i] == mode[i] && stress_only[i] == stress[i];
        ++counts[static_cast<int>(mode[i])];
        if (mode[i] == Mode::elastic)
          {
            const Mandel trial =
              stress_n[i] + material.elasticity().stress(strain[i]);
            exact           = exact && stress[i] == trial;
            elastic_tangent = elastic_tangent &&
                              tangent[i] == material.elasticity().stiffness();
          }
        if (const auto cone = material.initial_cone())
          violation.add(cone->yield_function(to_cone_axes(stress[i])) / c);
      }
    std::cout << "  batch: " << counts[0] << " elastic, " << counts[1]
              << " cone, " << counts[2] << " apex" << std::endl;
    print("  as point by point, to the last digit", same);
    print("  the same stresses without the tangents", without);
    print("  elastic points keep their trial stress to the last digit", exact);
    print("  and have the elastic tangent", elastic_tangent);
    print_below("  yield function/c", violation, "1e-12");
  }

  /** A law in closed form. */
  std::unique_ptr<Material>
  make(const std::string &type, const std::string &section)
  {
    std::unique_ptr<ConstitutiveLaw> law = make_material(type, section);
    auto *const material                 = dynamic_cast<Material *>(law.get());
    if (material == nullptr)
      throw InputError("'" + type + "' is not in closed form");
    law.release();
    return std::unique_ptr<Material>(material);
  }

  void
  test()
  {
    std::cout.precision(10);
    const auto friction   = make("Mohr-Coulomb", "Materials/friction");
    const auto associated = make("Mohr-Coulomb", "Materials/associated");
    const auto cohesive   = make("Mohr-Coulomb", "Materials/cohesive");
    const auto tresca     = make("Tresca", "Materials/tresca");
    const auto elastic    = make("linear elastic", "Materials/elastic");
    const auto wrong      = make("Mohr-Coulomb", "Materials/wrong");
    dealii::ParameterAcceptor::prm.parse_input_from_string(R"(
    subsection Materials
      subsection friction
        set Young modulus   = 1e8
        set Poisson ratio   = 0.3
        set Cohesion        = 2000
        set Friction angle  = 20
        set Dilatancy angle = 5
      end
      subsection associated
        set Young modulus   = 1e8
        set Poisson ratio   = 0.3
        set Cohesion        = 2000
        set Friction angle  = 10
        set Dilatancy angle = 10
      end
      subsection cohesive
        set Young modulus   = 1e8
        set Poisson ratio   = 0.3
        set Cohesion        = 2000
        set Friction angle  = 0
        set Dilatancy angle = 0
      end
      subsection tresca
        set Young modulus   = 1e8
        set Poisson ratio   = 0.3
        set Cohesion        = 2000
      end
      subsection elastic
        set Density         = 1500
        set Young modulus   = 1e8
        set Poisson ratio   = 0.3
      end
      subsection wrong
        set Friction angle  = 20
        set Dilatancy angle = 21
      end
    end)");
    dealii::ParameterAcceptor::parse_all_parameters();

    struct Case
    {
      std::string name;
      Material   &material;
      double      phi, theta;
    };
    for (const Case &test : {Case{"friction", *friction, 20., 5.},
                             Case{"associated", *associated, 10., 10.},
                             Case{"cohesive", *cohesive, 0., 0.},
                             Case{"tresca", *tresca, 0., 0.}})
      {
        test.material.prepare();
        const double phi = radians(test.phi), theta = radians(test.theta);
        std::cout << test.name << ": non-associativity "
                  << test.material.non_associativity() << std::endl;
        check_strength(test.material, phi);
        check_oedometer(test.material, phi, theta);
        check_tension(test.material, phi);
        check_batches(test.material);
      }

    elastic->prepare();
    std::cout << "elastic: density " << elastic->density() << ", cone "
              << (elastic->initial_cone() ? "yes" : "no")
              << ", non-associativity " << elastic->non_associativity()
              << std::endl;
    check_batches(*elastic);

    try
      {
        wrong->prepare();
        std::cout << "more dilatancy than friction was accepted" << std::endl;
      }
    catch (const InputError &error)
      {
        std::cout << "refused: " << error.what() << std::endl;
      }
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace cone_material_01
