// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/terms/plate_strength.h>

#include <algorithm>
#include <cmath>

namespace geocone
{
  namespace
  {
    using Pairs = std::vector<std::array<unsigned int, 2>>;

    /**
     * Projection of the forces of connected pairs, by its dual problem: with the
     * multipliers lambda >= 0 of the strengths and S the sum of those of a force
     * of compliance w,
     *   m = max(0, m^e - S/w),  n = n^e w/(w + 2 S),
     * for absolute values of the elastic forces m^e and n^e. The multipliers
     * maximise a concave function whose gradient is m + n^2 - 1.
     */
    class Projection
    {
    public:
      /** @param elastic absolute values */
      Projection(std::vector<PlateForce> elastic, Pairs pairs)
        : elastic(std::move(elastic))
        , pairs(std::move(pairs))
        , is_moment(this->elastic.size(), false)
        , lambda(Eigen::VectorXd::Zero(this->pairs.size()))
      {
        for (const auto &[m, n] : this->pairs)
          is_moment[m] = true;
        update();
      }

      /** Newton's method on the multipliers that are positive or grow, with a
       *  line search. */
      void
      solve()
      {
        double largest = 1.;
        for (const PlateForce &force : elastic)
          largest = std::max(largest, force.value);
        const double tolerance = 1e-14 * largest; // rounding
        double       least     = 2. * error();
        for (unsigned int i = 0; i < 200 && error() > tolerance; ++i)
          {
            if (error() < 1e-10 && error() > least / 2.) // no progress
              return;
            least                       = error();
            std::vector<int>      those = active();
            const Eigen::VectorXd step = ascent(those), old = lambda;
            const double          value = dual(), first = error();
            const Eigen::VectorXd slope   = gradient();
            bool                  is_done = false;
            for (double size = 1.; size > 1e-4 && !is_done; size /= 2.)
              {
                for (unsigned int k = 0; k < those.size(); ++k)
                  lambda[those[k]] =
                    std::max(0., old[those[k]] + size * step[k]);
                update();
                const double growth = dual() - value;
                is_done             = growth > 1e-4 * slope.dot(lambda - old) ||
                          (error() < first / 2. &&
                           growth > -1e-13 * std::abs(value)); // rounding
              }
            if (is_done)
              continue;
            lambda = old; // one at a time
            update();
            for (const int p : active())
              {
                lambda[p] =
                  std::max(0., lambda[p] + gradient()[p] / hessian({p})(0, 0));
                update();
              }
          }
      }

      double
      value(const unsigned int i) const
      {
        return x[i];
      }

      /** Derivative of the absolute values by those of the elastic forces. */
      Eigen::MatrixXd
      derivative() const
      {
        std::vector<int> those;
        for (unsigned int p = 0; p < pairs.size(); ++p)
          if (lambda[p] > 0.)
            those.push_back(p);
        const unsigned int n         = x.size();
        Eigen::MatrixXd    by_lambda = Eigen::MatrixXd::Zero(n, those.size());
        Eigen::MatrixXd    result    = Eigen::MatrixXd::Zero(n, n);
        for (unsigned int i = 0; i < n; ++i)
          result(i, i) = is_moment[i] ? double(x[i] > 0.)
                                      : elastic[i].compliance /
                                          (elastic[i].compliance + 2. * sum[i]);
        for (unsigned int k = 0; k < those.size(); ++k)
          for (const unsigned int i : pairs[those[k]])
            by_lambda(i, k) = -rate(i);
        if (!those.empty())
          {
            Eigen::MatrixXd of_elastic = -by_lambda.transpose();
            for (unsigned int i = 0; i < n; ++i)
              of_elastic.col(i) *= elastic[i].compliance;
            result += by_lambda *
                      hessian(those).completeOrthogonalDecomposition().solve(
                        of_elastic);
          }
        return result;
      }

    private:
      /** Decrease of a force by the sum of its multipliers. */
      double
      rate(const unsigned int i) const
      {
        return is_moment[i] ? (x[i] > 0. ? 1. / elastic[i].compliance : 0.)
                            : 2. * x[i] / (elastic[i].compliance + 2. * sum[i]);
      }

      void
      update()
      {
        sum.assign(elastic.size(), 0.);
        for (unsigned int p = 0; p < pairs.size(); ++p)
          for (const unsigned int i : pairs[p])
            sum[i] += lambda[p];
        x.resize(elastic.size());
        for (unsigned int i = 0; i < x.size(); ++i)
          {
            const auto &[force, w] = elastic[i];
            x[i] = is_moment[i] ? std::max(0., force - sum[i] / w)
                                : force * w / (w + 2. * sum[i]);
          }
      }

      double
      gradient(const unsigned int p) const
      {
        const auto [m, n] = pairs[p];
        return x[m] + x[n] * x[n] - 1.;
      }

      Eigen::VectorXd
      gradient() const
      {
        Eigen::VectorXd g(pairs.size());
        for (unsigned int p = 0; p < pairs.size(); ++p)
          g[p] = gradient(p);
        return g;
      }

      Eigen::VectorXd
      gradient(const std::vector<int> &those) const
      {
        Eigen::VectorXd g(those.size());
        for (unsigned int k = 0; k < those.size(); ++k)
          g[k] = gradient(those[k]);
        return g;
      }

      double
      error() const
      {
        double most = 0.;
        for (unsigned int p = 0; p < pairs.size(); ++p)
          most = std::max(most,
                          lambda[p] > 0. ? std::abs(gradient(p)) : gradient(p));
        return most;
      }

      std::vector<int>
      active() const
      {
        std::vector<int> those;
        for (unsigned int p = 0; p < pairs.size(); ++p)
          if (lambda[p] > 0. || gradient(p) > 0.)
            those.push_back(p);
        return those;
      }

      double
      dual() const
      {
        double sum = 0.;
        for (unsigned int i = 0; i < x.size(); ++i)
          sum +=
            elastic[i].compliance / 2. * std::pow(x[i] - elastic[i].value, 2);
        for (unsigned int p = 0; p < pairs.size(); ++p)
          sum += lambda[p] * gradient(p);
        return sum;
      }

      /** Negative second derivative of the dual function. */
      Eigen::MatrixXd
      hessian(const std::vector<int> &those) const
      {
        const unsigned int n = those.size();
        Eigen::MatrixXd    H = Eigen::MatrixXd::Zero(n, n);
        for (unsigned int k = 0; k < n; ++k)
          for (unsigned int l = 0; l < n; ++l)
            for (const unsigned int end : {0u, 1u})
              if (const unsigned int i = pairs[those[k]][end];
                  i == pairs[those[l]][end])
                H(k, l) += (end == 0 ? 1. : 2. * x[i]) * rate(i);
        return H;
      }

      /** Newton step of some multipliers, without those that are zero and would
       *  become negative, which are removed. The Hessian is singular where
       *  multipliers are not unique. */
      Eigen::VectorXd
      ascent(std::vector<int> &those) const
      {
        while (true)
          {
            Eigen::MatrixXd H = hessian(those);
            H.diagonal().array() += 1e-13 * H.diagonal().maxCoeff();
            const Eigen::VectorXd step = H.ldlt().solve(gradient(those));
            std::vector<int>      rest;
            for (unsigned int k = 0; k < those.size(); ++k)
              if (lambda[those[k]] > 0. || step[k] > 0.)
                rest.push_back(those[k]);
            if (rest.size() == those.size() || rest.empty())
              return step;
            those = std::move(rest);
          }
      }

      const std::vector<PlateForce> elastic;
      const Pairs                   pairs;
      std::vector<bool>             is_moment;
      Eigen::VectorXd               lambda;
      std::vector<double>           sum, x;
    };

    /** Numbers of the groups of connected pairs whose elastic forces exceed the
     *  strength, by force; -1 for the forces of no such pair. */
    std::vector<int>
    groups_of(const std::vector<PlateForce> &forces,
              const Pairs                   &exceeded,
              int                           &n_groups)
    {
      std::vector<int> group(forces.size(), -1);
      n_groups = 0;
      for (bool is_first = true, has_changed = true; has_changed;
           is_first = false)
        {
          has_changed = is_first;
          for (const auto &[m, n] : exceeded)
            {
              if (is_first && group[m] < 0 && group[n] < 0)
                group[m] = n_groups++;
              const int low = group[m] < 0   ? group[n]
                              : group[n] < 0 ? group[m]
                                             : std::min(group[m], group[n]);
              has_changed   = has_changed || group[m] != low || group[n] != low;
              group[m] = group[n] = low;
            }
        }
      return group;
    }
  } // namespace

  std::vector<YieldingForces>
  return_to_interaction(std::vector<PlateForce> &forces, const Pairs &pairs)
  {
    // Forces decrease, so that pairs within the strength stay there.
    Pairs exceeded;
    for (const auto &[m, n] : pairs)
      if (std::abs(forces[m].value) + forces[n].value * forces[n].value > 1.)
        exceeded.push_back({{m, n}});
    int                         n_groups;
    const std::vector<int>      group = groups_of(forces, exceeded, n_groups);
    std::vector<YieldingForces> all;
    for (int g = 0; g < n_groups; ++g)
      {
        YieldingForces            yielding;
        std::vector<PlateForce>   elastic;
        std::vector<unsigned int> position(forces.size());
        for (unsigned int i = 0; i < forces.size(); ++i)
          if (group[i] == g)
            {
              position[i] = elastic.size();
              yielding.forces.push_back(i);
              elastic.push_back(
                {std::abs(forces[i].value), forces[i].compliance});
            }
        Pairs of_group;
        for (const auto &[m, n] : exceeded)
          if (group[m] == g)
            of_group.push_back({{position[m], position[n]}});
        if (of_group.empty()) // joined to another one
          continue;
        Projection projection(std::move(elastic), std::move(of_group));
        projection.solve();
        yielding.derivative   = projection.derivative();
        const unsigned int  n = yielding.forces.size();
        std::vector<double> sign(n);
        for (unsigned int k = 0; k < n; ++k)
          {
            double &value = forces[yielding.forces[k]].value;
            sign[k]       = value < 0. ? -1. : 1.;
            value         = sign[k] * projection.value(k);
          }
        for (unsigned int k = 0; k < n; ++k)
          for (unsigned int l = 0; l < n; ++l)
            yielding.derivative(k, l) *= sign[k] * sign[l];
        all.push_back(std::move(yielding));
      }
    return all;
  }
} // namespace geocone
