// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/files.h>
#include <geocone/kernels/spin.h>
#include <geocone/laws/umat.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    /** Places in a Mandel vector of the components of a UMAT: 11, 22, 33, 12,
     *  and in three dimensions 13, 23. */
    constexpr int place_in_mandel[6] = {0, 1, 3, 2, 5, 4};

    /** Number of values behind those of a law, which show that it uses more. */
    constexpr unsigned int n_guards = 64;

    /** Factor of a Mandel component over that of a UMAT's stress, or of a
     *  UMAT's strain over the Mandel component. */
    double
    umat_factor(const int umat_component)
    {
      return umat_component < 3 ? 1. : sqrt2;
    }

    UmatComponents
    umat_stress(const SpatialMandel &t)
    {
      UmatComponents s;
      for (int i = 0; i < n_spatial; ++i)
        s[i] = t[place_in_mandel[i]] / umat_factor(i);
      return s;
    }

    UmatComponents
    umat_strain(const SpatialMandel &t)
    {
      UmatComponents e;
      for (int i = 0; i < n_spatial; ++i)
        e[i] = t[place_in_mandel[i]] * umat_factor(i);
      return e;
    }

    /** Rotation of a spin increment, column by column, from half of its axial
     *  vector: about z and, in three dimensions, x and y. */
    std::array<double, 9>
    rotation_of_spin(const double *spin)
    {
      std::array<double, 3> g = {{0., 0., spin[0]}};
      for (unsigned int r = 1; r < n_rotations; ++r)
        g[r - 1] = spin[r];
      const double          g2 = g[0] * g[0] + g[1] * g[1] + g[2] * g[2];
      const double          s = 2. / (1. + g2), c = 1. - s * g2;
      std::array<double, 9> Q; // i, j at i + 3 j
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          Q[i + 3 * j] = s * g[i] * g[j] + (i == j ? c : 0.);
      for (int i = 0; i < 3; ++i)
        {
          const int j = (i + 1) % 3, k = (i + 2) % 3;
          Q[k + 3 * j] += s * g[i];
          Q[j + 3 * k] -= s * g[i];
        }
      return Q;
    }
  } // namespace

  Umat::Umat(const std::string &section)
    : SpatialLaw(section)
  {
    add_parameter(
      "Library",
      library,
      "Shared object with the law, relative to the folder of the parameter "
      "file, or else to the working folder. It is executed with your rights, "
      "and is loaded only with the option --load-library.");
    add_parameter("Function",
                  function,
                  "Name of the function in the library; an underscore at its "
                  "end, as compilers of Fortran add it, can be omitted.");
    add_parameter(
      "Constants",
      constants,
      "Constants of the law, its PROPS, in the units of the file if "
      "the law does not say otherwise, comma-separated.");
    add_parameter("Number of state variables",
                  n_state,
                  "Number of state variables of the law, NSTATV [-].");
    add_parameter("State variables",
                  state,
                  "Initial values of the state variables, STATEV, "
                  "comma-separated. Empty: zeros.");
  }

  void
  Umat::prepare()
  {
    SpatialLaw::prepare();
    if (!may_load_libraries())
      throw InputError(parameter("Library"),
                       library,
                       std::string("a shared object, which is a program and "
                                   "runs with your rights; only with the "
                                   "option ") +
                         option_for_libraries,
                       std::string("if you trust it, give the option ") +
                         option_for_libraries);
    require(n_state <= 1000,
            "Number of state variables",
            n_state,
            "0 to 1000",
            "take the number that the law needs, its NSTATV");
    if (!state.empty() && state.size() != n_state)
      throw InputError(parameter("State variables"),
                       std::to_string(state.size()) + " values",
                       "none, or 'Number of state variables' = " +
                         std::to_string(n_state),
                       "give an initial value for each, or none");
    const std::string file = existing_file(library,
                                           folder_of_parameters,
                                           parameter("Library"),
                                           "the file of a shared object (.so)");
    umat                   = load_umat(file, function, parameter());
    props                  = constants;
    props.resize(constants.size() + n_guards,
                 std::numeric_limits<double>::quiet_NaN());
    name = parameter().substr(parameter().rfind('/') + 1);
    std::transform(name.begin(), name.end(), name.begin(), [](const char c) {
      return std::toupper(static_cast<unsigned char>(c));
    });
    name.resize(80, ' ');
  }

  std::string
  Umat::initialise(const Stress &stress,
                   const double  size,
                   double       *history) const
  {
    SpatialLaw::initialise(stress, size, history);
    std::fill(history + index_of_state(), history + n_history(), 0.);
    std::copy(state.begin(), state.end(), history + index_of_state());
    history[index_of_size()] = size;
    return "";
  }

  std::vector<ConstitutiveLaw::OutputQuantity>
  Umat::output_quantities() const
  {
    std::vector<OutputQuantity> all = SpatialLaw::output_quantities();
    for (unsigned int i = 1; i <= n_state; ++i)
      all.push_back({"state_variable_" + std::to_string(i),
                     "state variable " + std::to_string(i)});
    return all;
  }

  void
  Umat::output(const Components &stress,
               const double     *history,
               double           *values) const
  {
    SpatialLaw::output(stress, history, values);
    std::copy_n(history + index_of_state(),
                n_state,
                values + SpatialLaw::output_quantities().size());
  }

  void
  Umat::reduce_strength(const double)
  {
    throw InputError(parameter("Type"),
                     "umat",
                     "a law with cohesion and friction, whose strength can be "
                     "divided by a factor",
                     "set 'Reduce strength = false' for this material");
  }

  void
  Umat::advance(const PointBlock &block, LawCounts &counts) const
  {
    for (unsigned int p = 0; p < block.n_points; ++p)
      {
        const auto                   l = block.gradient(p);
        std::array<double, n_mandel> e;
        for (int i = 0; i < n_mandel; ++i)
          e[i] = block.history[index_of_strain() + i][p];
        Spin(l).turn(e);
        for (int i = 0; i < n_mandel; ++i)
          block.history[index_of_strain() + i][p] = e[i];
        for (unsigned int r = 0; r < n_rotations; ++r)
          {
            const auto [a, b] = plane_of_rotation[r];
            block.history[index_of_spin() + r][p] =
              0.25 * (l[dim * b + a] - l[dim * a + b]);
          }
      }
    SpatialLaw::advance(block, counts);
  }

  double
  Umat::call(const UmatComponents &strain_n,
             const UmatComponents &strain,
             const double         *history_n,
             const StepData       &step,
             UmatComponents       &stress,
             std::vector<double>  &variables,
             UmatTangent          &tangent) const
  {
    constexpr int n_normal = 3, n_shear = n_spatial - 3, n = n_spatial, one = 1,
                  layer                  = 1;
    constexpr int    step_of_analysis[4] = {1, 1, 0, 0};
    constexpr double none[3]             = {0., 0., 0.},
                     unit[9]             = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    // Laws that depend on the position are not supported, and shall show it.
    constexpr double nan         = std::numeric_limits<double>::quiet_NaN();
    constexpr double position[3] = {nan, nan, nan};
    const double                times[2]    = {history_n[index_of_time()],
                                               history_n[index_of_time()]};
    UmatComponents              ddsddt = {}, drplde = {};
    const std::array<double, 9> rotation =
      rotation_of_spin(history_n + index_of_spin());

    // Guards behind the values show a law that writes more of them.
    constexpr double guard = -7.2e302;
    variables.assign(history_n + index_of_state(),
                     history_n + index_of_state() + n_state);
    variables.resize(n_state + n_guards, guard);
    const int n_variables = n_state, n_constants = constants.size();
    double    sse = 0., spd = 0., scd = 0., rpl = 0., drpldt = 0., pnewdt = 1.;
    umat(stress.data(),
         variables.data(),
         tangent.data(),
         &sse,
         &spd,
         &scd,
         &rpl,
         ddsddt.data(),
         drplde.data(),
         &drpldt,
         strain_n.data(),
         strain.data(),
         times,
         &step.size,
         none,
         none,
         none,
         none,
         name.data(),
         &n_normal,
         &n_shear,
         &n,
         &n_variables,
         props.data(),
         &n_constants,
         position,
         rotation.data(),
         &pnewdt,
         history_n + index_of_size(),
         unit,
         unit,
         &one,
         &one,
         &layer,
         &one,
         step_of_analysis,
         &one,
         name.size());
    if (std::any_of(variables.begin() + n_state,
                    variables.end(),
                    [](const double value) { return value != guard; }))
      throw RunError("the law of '" + parameter() +
                     "' writes more state variables than " +
                     std::to_string(n_state) + "\n  remedy:  raise '" +
                     parameter("Number of state variables") + "'");
    return pnewdt;
  }

  Mode
  Umat::respond(const SpatialMandel &strain,
                const SpatialMandel &stress_n,
                const double        *history_n,
                const StepData      &step,
                SpatialMandel       &stress,
                double              *history,
                SpatialMandelMatrix *tangent) const
  {
    constexpr int n = n_spatial;
    SpatialMandel total;
    for (int i = 0; i < n; ++i)
      total[i] = history_n[index_of_strain() + i] * (is_shear(i) ? sqrt2 : 1.);
    UmatComponents                   s = umat_stress(stress_n);
    UmatTangent                      D = {};
    thread_local std::vector<double> variables;
    const double                     pnewdt = call(umat_strain(total),
                               umat_strain(strain),
                               history_n,
                               step,
                               s,
                               variables,
                               D);

    for (int i = 0; i < n; ++i)
      stress[place_in_mandel[i]] = pnewdt < 1.
                                     ? std::numeric_limits<double>::quiet_NaN()
                                     : umat_factor(i) * s[i];
    if (tangent != nullptr)
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
          (*tangent)(place_in_mandel[i], place_in_mandel[j]) =
            umat_factor(i) * D[i + n * j] * umat_factor(j);
    if (history != nullptr)
      {
        std::copy_n(variables.begin(), n_state, history + index_of_state());
        for (int i = 0; i < n; ++i)
          history[index_of_strain() + i] =
            history_n[index_of_strain() + i] +
            strain[i] / (is_shear(i) ? sqrt2 : 1.);
        std::fill_n(history + index_of_spin(), n_rotations, 0.);
        history[index_of_time()] = history_n[index_of_time()] + step.size;
      }
    const SpatialMandel change = elasticity().stress(strain);
    return (stress - stress_n - change).norm() <=
               1e-10 * (stress_n.norm() + change.norm())
             ? Mode::elastic
             : Mode::cone;
  }
} // namespace geocone::GEOCONE_DIM
