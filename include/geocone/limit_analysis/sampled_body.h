// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_sampled_body_h
#define geocone_limit_analysis_sampled_body_h

#include <geocone/limit_analysis/certified_bounds.h>
#include <geocone/limit_analysis/random_fields.h>

#include <limits>
#include <optional>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Power of a mechanism for unit factors, by triangle of the first mesh. Unless friction
   *  varies, it is admissible in all samples, and its bound needs no solution. */
  struct Mechanism
  {
    std::vector<double> dissipation, weight;
    double              other_dissipation = 0., other_loads = 0.;

    /** Upper bound of a sample's load factor; infinite if its loads do no work. */
    double
    bound(const RandomFactors &factors) const;
  };

  /** Certified answer to whether a sample of a body carries its loads. */
  struct SampleVerdict
  {
    enum class Kind
    {
      fails     = -1, ///< its upper bound of the load factor is below 1
      undecided = 0,
      stands    = 1 ///< its lower bound of the load factor is at least 1
    };
    Kind kind = Kind::undecided;

    /** Certified bounds of the load factor as far as they were needed, or NaN. */
    double lower = std::numeric_limits<double>::quiet_NaN(), upper = lower;

    unsigned int factorisations = 0;

    /** Mechanism of the upper bound, if it is certified. */
    std::optional<Mechanism> mechanism;

    /** Refinement indicator of an undecided sample (CertifiedBounds::uneven). */
    std::vector<double> uneven;
  };

  /**
   * A body with constant multiples of the strengths and unit weights in each triangle.
   * The problems are those of the mean but for cones and weights.
   */
  class SampledBody
  {
  public:
    /** @param mean the body with its mean strengths; its mesh must outlive this
     *  @param parent triangle of the first mesh that contains each triangle
     *  @param n_first number of triangles of the first mesh */
    SampledBody(BoundScene                mean,
                std::vector<unsigned int> parent,
                const unsigned int        n_first);

    /** Compares both bounds of the load factor with 1.
     *  @param factors of the triangles of the first mesh
     *  @param tolerance of the interior-point method */
    SampleVerdict
    judge(const RandomFactors &factors, const double tolerance) const;

    /** Velocities of the best upper bound of a sample, in all dofs. */
    Eigen::VectorXd
    velocities(const RandomFactors &factors, const double tolerance) const;

  private:
    Mechanism
    mechanism_of(const Eigen::VectorXd &q) const;

    /** A problem of the mean, and its loads other than weight. */
    struct Side
    {
      BoundProblem    problem;
      Eigen::VectorXd other_loads;
    };

    /** Problem of a sample. */
    BoundProblem
    of_sample(const Side          &side,
              const BoundSide      kind,
              const RandomFactors &factors) const;

    BoundScene                mean;
    std::vector<unsigned int> parent;
    const unsigned int        n_first;
    Side                      above, below;
  };
} // namespace geocone::GEOCONE_DIM

#endif
