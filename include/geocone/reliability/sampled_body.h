// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_reliability_sampled_body_h
#define geocone_reliability_sampled_body_h

#include <geocone/base/state_row.h>
#include <geocone/limit_analysis/certified_bounds.h>
#include <geocone/reliability/random_fields.h>

#include <limits>
#include <optional>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Power of a failure mechanism in each triangle of the first mesh, for unit
   *  factors (RandomFactors). If the friction angle is not random, the
   *  mechanism is admissible in all samples and gives an upper bound without
   *  solving another problem. */
  struct Mechanism
  {
    std::vector<double> dissipation, weight;
    double              other_dissipation = 0., other_loads = 0.;

    /** Upper bound on the load factor of a sample from this mechanism; infinite
     *  if the loads do no positive work. */
    double
    bound(const RandomFactors &factors) const;

    void
    state(StateRow &row)
    {
      row(dissipation, weight, other_dissipation, other_loads);
    }
  };

  /** Stresses in equilibrium with the loads, as the cohesion that they require. If
   *  nothing else is random, they give a lower bound for all samples without solving
   *  another problem. */
  struct StressField
  {
    /** Factor of the cohesion that each triangle of the first mesh requires for the load
     *  factor 1. */
    std::vector<double> required;
    double of_others = 0.; ///< the same of strengths that are not random

    /** Lower bound on the load factor of a sample from these stresses, multiplied by a
     *  common factor. */
    double
    bound(const RandomFactors &factors) const;

    void
    state(StateRow &row)
    {
      row(required, of_others);
    }
  };

  /** Certified result of a bound for a sample of a body: it fails under its loads, is
   *  stable, or is undecided. */
  struct SampleVerdict
  {
    enum class Kind
    {
      fails     = -1, ///< its upper bound on the load factor is below 1
      undecided = 0,
      stands    = 1 ///< its lower bound on the load factor is at least 1
    };
    Kind kind = Kind::undecided;

    /** Certified bounds on the load factor; NaN if a bound is not certified or
     *  was not needed. */
    double lower = std::numeric_limits<double>::quiet_NaN(), upper = lower;

    unsigned int factorisations = 0;

    /** Failure mechanism of a certified upper bound; empty if the friction angle is
     *  random. */
    std::optional<Mechanism> mechanism;

    /** Stresses of a sample that stands; empty if other properties than the cohesion are
     *  random, or if the stresses cannot be multiplied by a factor. */
    std::optional<StressField> stresses;

    /** Refinement indicator of an undecided sample: the dissipation in each triangle times
     *  the root of its area. */
    std::vector<double> refinement_indicator;
  };

  /** Load factor of a sample, between its bounds, and how it depends on the factors. */
  struct LoadResponse
  {
    double        load = 0.;  ///< geometric mean of both bounds
    double        gap  = 0.;  ///< upper/lower - 1
    RandomFactors elasticity; ///< d ln(load)/d ln(factor), of the upper bound
    unsigned int  factorisations = 0;
    std::optional<Mechanism>   mechanism; ///< as in SampleVerdict
    std::optional<StressField> stresses;
  };

  /**
   * Body whose strength and unit weight are multiplied by a constant factor in
   * each triangle. The upper-bound and lower-bound problems differ from those
   * of the mean body only in the cones and the weight.
   */
  class SampledBody
  {
  public:
    /** Creates a body from its mean strengths.
     *  @param mean body with mean strengths; its mesh must outlive this object
     *  @param parent triangle of the first mesh that contains each triangle
     *  @param n_first number of triangles of the first mesh */
    SampledBody(BoundScene                mean,
                std::vector<unsigned int> parent,
                const unsigned int        n_first);

    /** Compares a bound on the load factor with 1.
     *  @param factors of the triangles of the first mesh
     *  @param tolerance of the interior-point method */
    SampleVerdict
    judge(const RandomFactors &factors,
          const double         tolerance,
          const BoundSide      side) const;

    /** Computes both bounds on the load factor, and the gradient of the upper one with
     *  respect to the factors of each triangle, from its fields alone (gradients.h). The
     *  bounds need not be certified. */
    LoadResponse
    respond(const RandomFactors &factors, const double tolerance) const;

    /** Velocities of the upper-bound solution of a sample, at all dofs. */
    Eigen::VectorXd
    velocities(const RandomFactors &factors, const double tolerance) const;

  private:
    Mechanism
    mechanism_of(const Eigen::VectorXd &q) const;

    /** Work of the unit weights of each triangle of the first mesh. */
    std::vector<double>
    work_of_weight(const Eigen::VectorXd &q) const;

    /** Fields that decide other samples, if they are certified. */
    std::optional<Mechanism>
    mechanism_of(const RandomFactors &factors, const Bound &upper) const;
    std::optional<StressField>
    stresses_of(const RandomFactors &factors, const Bound &lower) const;

    /** Dissipation of the velocities of an upper bound in each triangle. */
    std::vector<double>
    power_of_cells(const BoundProblem &problem, const Bound &upper) const;

    RandomFactors
    elasticity(const BoundProblem  &problem,
               const RandomFactors &factors,
               const CertifiedSide &upper) const;

    /** Upper-bound or lower-bound problem of the mean body, with its loads
     *  other than weight. */
    struct Side
    {
      BoundProblem    problem;
      Eigen::VectorXd other_loads;
    };

    /** Upper-bound or lower-bound problem of a sample. */
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
