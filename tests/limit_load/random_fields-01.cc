// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// If this failed, random fields would not have their mean, variance and correlation, or the
// binomial limits would not be Clopper and Pearson's: 0 of 10 events have the upper limit
// 1 - 0.025^(1/10). Then the probability of failure of a block with one random strength,
// which is exact, is within limits of confidence 0.999 for 20 of 20 seeds.

#include <geocone/base/version.h>
#include <geocone/limit_analysis/reliability.h>
#include <geocone/limit_analysis/statistics.h>

#include <fstream>
#include <iostream>

#include "../test.h"

namespace limit_load_random_fields_01
{
  using namespace geocone;

  void
  check_limits()
  {
    const auto none = clopper_pearson(0, 10, 0.95),
               all  = clopper_pearson(10, 10, 0.95),
               some = clopper_pearson(300, 1000, 0.95);
    std::cout << "limits "
              << (std::abs(none[1] - (1. - std::pow(0.025, 0.1))) < 1e-12 &&
                  none[0] == 0. && all[1] == 1. &&
                  std::abs(all[0] - std::pow(0.025, 0.1)) < 1e-12)
              << " symmetric "
              << (std::abs(some[0] + clopper_pearson(700, 1000, 0.95)[1] - 1.) <
                  1e-10)
              << " quantile "
              << (std::abs(normal_quantile(0.975) - 1.9599639845400545) < 1e-12)
              << std::endl;
  }

  /** Triangles of a strip of 8 squares of size 1 along x. */
  Triangles
  strip()
  {
    CoarseMesh mesh;
    for (unsigned int i = 0; i <= 8; ++i)
      for (unsigned int j = 0; j < 2; ++j)
        mesh.points.emplace_back(i, j);
    for (unsigned int i = 0; i < 8; ++i)
      for (unsigned int j = 0; j < 2; ++j)
        {
          dealii::CellData<2> cell(3);
          cell.vertices =
            j == 0 ? std::vector<unsigned int>{2 * i, 2 * i + 2, 2 * i + 1}
                   : std::vector<unsigned int>{2 * i + 2, 2 * i + 3, 2 * i + 1};
          cell.material_id = 0;
          mesh.cells.push_back(cell);
        }
    return Triangles(mesh);
  }

  /** Largest errors of mean, deviation and correlation over their own deviation, about
   *  1/sqrt(number of samples), of the logarithm of the factors. */
  void
  check_field(const std::string &distribution, const std::string &covariance)
  {
    dealii::ParameterAcceptor::clear();
    const ParameterFile file = ParameterFile::from_text("", "field", {});
    RandomField         field("strength");
    file.parse();
    auto &prm = dealii::ParameterAcceptor::prm;
    prm.enter_subsection("Random fields");
    prm.enter_subsection("strength");
    prm.set("Distribution", distribution);
    prm.set("Covariance", covariance);
    prm.set("Correlation length x", 3.);
    prm.set("Correlation length y", 2.);
    prm.leave_subsection();
    prm.leave_subsection();
    dealii::ParameterAcceptor::parse_all_parameters();
    const Triangles triangles = strip();
    field.prepare_on(triangles);
    constexpr unsigned int n = 4000;
    const unsigned int     m = triangles.cells.size();
    std::vector<double>    factors(m), mean(m, 0.), square(m, 0.);
    std::vector<double>    product(m, 0.);
    const double           s2    = std::log1p(0.09);
    const bool             is_ln = distribution == "lognormal";
    for (std::uint32_t i = 0; i < n; ++i)
      {
        field.sample({7, i}, factors);
        const auto normal = [&](const unsigned int c) {
          return is_ln ? (std::log(factors[c]) + s2 / 2.) / std::sqrt(s2)
                       : (factors[c] - 1.) / 0.3;
        };
        for (unsigned int c = 0; c < m; ++c)
          {
            mean[c] += factors[c] / n;
            square[c] += std::pow(factors[c] - 1., 2) / n;
            product[c] += normal(0) * normal(c) / n;
          }
      }
    double error = 0.;
    for (unsigned int c = 0; c < m; ++c)
      {
        const double rho =
          field.covariance(triangles.centre(0) - triangles.centre(c));
        error = std::max({error,
                          std::abs(mean[c] - 1.) / 0.3,
                          std::abs(std::sqrt(square[c]) / 0.3 - 1.),
                          std::abs(product[c] - rho)});
      }
    // Five deviations of a mean of 4000 numbers.
    std::cout << distribution << ", " << covariance << ": "
              << (error < 5. / std::sqrt(double(n))) << std::endl;
  }

  /** Whether the limits of a seed include the exact probability of failure. */
  bool
  includes_exact(const unsigned int seed)
  {
    dealii::ParameterAcceptor::clear();
    const ParameterFile file(GEOCONE_SOURCE_DIR
                             "/tests/limit_load/reliability_block.prm",
                             {"Output/Folder = results",
                              "Output/Report for tests = none",
                              "Analysis/Samples = 48",
                              "Analysis/Confidence = 0.999",
                              "Random fields/Seed = " + std::to_string(seed)});
    Log                 log(MPI_COMM_WORLD, true);
    Reliability         run(MPI_COMM_WORLD, file, log);
    file.parse();
    RunOptions options;
    options.name               = "test";
    std::streambuf *const cerr = std::cerr.rdbuf(nullptr); // warnings
    static_cast<Simulation &>(run).run(options);
    std::cerr.rdbuf(cerr);
    Json summary;
    std::ifstream("results/summary.json") >> summary;
    const Json      &found = summary["reliability"];
    constexpr double exact = 0.269823094957572;
    return found["limit_lower"] <= exact && found["limit_upper"] >= exact &&
           found["undecided"] == 0;
  }

  void
  test()
  {
    check_limits();
    check_field("lognormal", "exponential");
    check_field("lognormal", "Gaussian");
    check_field("truncated normal", "Matern 3/2");
    unsigned int n_inside = 0;
    for (unsigned int seed = 1; seed <= 20; ++seed)
      n_inside += includes_exact(seed);
    std::cout << n_inside << " of 20 seeds include the exact probability"
              << std::endl;
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace limit_load_random_fields_01
