// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_reliability_importance_sampling_h
#define geocone_reliability_importance_sampling_h

#include <geocone/base/state_row.h>

#include <Eigen/Dense>

#include <functional>
#include <utility>
#include <vector>

namespace geocone
{
  /** Logarithm of the load factor for given standard normal numbers, with its
   *  gradient. */
  struct LimitState
  {
    double          log_load = 0.;
    Eigen::VectorXd gradient;
  };

  /** Design point: the standard normal numbers of largest density for which the load
   *  factor is one. */
  struct DesignPoint
  {
    Eigen::VectorXd numbers;         ///< zero if the mean body fails
    double          load_factor = 0; ///< at these numbers
    unsigned int    iterations  = 0;
    bool            converged   = false;
    double          distance = 0.; ///< of the centre of samples from the origin

    /** Reliability index of Hasofer and Lind (1974): distance from the origin. */
    double
    index() const
    {
      return numbers.norm();
    }

    bool
    mean_fails() const
    {
      return converged && numbers.squaredNorm() == 0.;
    }

    /** Centre of samples, towards the design point. */
    Eigen::VectorXd
    centre() const
    {
      return numbers.squaredNorm() > 0. ? distance / index() * numbers
                                        : numbers;
    }

    void
    state(StateRow &row);
  };

  /**
   * Finds the design point by the iteration of Hasofer, Lind, Rackwitz and Fiessler
   * (1978): u <- ((g.u - ln lambda)/|g|^2) g with the gradient g of ln lambda, by steps of
   * a limited length.
   * @param n number of standard normal numbers
   * @param limit_state function of these numbers
   * @param start of the iteration; empty for the mean
   */
  DesignPoint
  design_point(
    const unsigned int                                        n,
    const std::function<LimitState(const Eigen::VectorXd &)> &limit_state,
    const Eigen::VectorXd                                    &start = {});

  /**
   * Finds design points of different mechanisms, the nearest first: from the mean, and
   * then from the point opposite to each that was found, where its mechanism is strong.
   * Others are left out if they are in nearly the same direction as a nearer one, or so
   * much farther that failures there are rare. There may be more that are not found.
   * @return at least one, which may not have converged
   */
  std::vector<DesignPoint>
  design_points(
    const unsigned int                                        n,
    const std::function<LimitState(const Eigen::VectorXd &)> &limit_state);

  /**
   * Distance of the centre of samples from the origin, along a design point: the mean of
   * failed samples there, if ln lambda is linear along it, and normal across it. This
   * mean makes the variance of weights small (cross-entropy method). With many random
   * numbers it is less than the reliability index, since other soil than that of the
   * design point fails as well. With the distance t_0 at which the mean of ln lambda
   * vanishes, its slope g along the design point and its deviation s across it, it is
   * t_0 g^2/(g^2 + s^2).
   * @param pilots standard normal numbers of trial samples; their component along the
   * design point is left out
   */
  double
  distance_of_centre(
    const DesignPoint                                        &point,
    const std::vector<Eigen::VectorXd>                       &pilots,
    const std::function<LimitState(const Eigen::VectorXd &)> &limit_state);

  /**
   * Density from which samples are drawn: nine samples of ten are normally distributed
   * around centres, in turn, every tenth around the origin. Weights of samples, phi(u)
   * over the density, are therefore about 10 at most, and sums of weights have a finite
   * variance wherever samples fail (defensive mixture, Hesterberg 1995). The density has
   * the shares of the samples that are drawn (fixed shares, Owen and Zhou 2000). A centre
   * at the origin gives the weight 1 to all samples.
   */
  class SamplingDensity
  {
  public:
    SamplingDensity() = default;

    /** @param n_samples number of all samples, ten at least */
    SamplingDensity(std::vector<Eigen::VectorXd> centres,
                    const unsigned int           n_samples)
      : centres(std::move(centres))
      , n_samples(n_samples)
    {}

    /** Returns true if all weights are 1. */
    bool
    is_normal() const
    {
      return centres.empty() || centres[0].squaredNorm() == 0.;
    }

    /** Moves independent standard normal numbers of a sample to the density.
     *  @param number of the sample, from 1 */
    Eigen::VectorXd
    moved(const unsigned int number, Eigen::VectorXd numbers) const;

    /** Ratio of the standard normal density to this one. */
    double
    weight(const Eigen::VectorXd &numbers) const;

    /** Weight that no sample exceeds. */
    double
    largest_weight() const
    {
      return is_normal() ? 1. : double(n_samples) / (n_samples / period);
    }

  private:
    static constexpr unsigned int period = 10;

    std::vector<Eigen::VectorXd> centres;
    unsigned int                 n_samples = 0;
  };
} // namespace geocone

#endif
