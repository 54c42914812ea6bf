// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_conic_point_group_h
#define geocone_conic_point_group_h

#include <geocone/conic/block_matrix.h>
#include <geocone/conic/strength_law.h>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <utility>
#include <vector>

namespace geocone
{
  /**
   * Group of points of the same type in a conic problem, with stresses s_p, strain rates
   * B_p q and weights V_p. The strength is described by a symmetric cone
   * (strength_law.h). Virtual functions are called for a group, never for a point.
   */
  class PointGroup
  {
  public:
    virtual ~PointGroup() = default;

    std::vector<double>       volume; ///< weight V of each point
    std::vector<unsigned int> dofs;   ///< order: points, columns

    unsigned int
    n_points() const
    {
      return volume.size();
    }

    virtual BlockMatrix::Set
    set() const = 0;

    /** Returns the total number of eigenvalues of the cone variables at all
     *  points (degree of the barrier function). */
    virtual double
    degree() const = 0;

    /** Returns true if the flow rule constrains any strain rate component to
     *  zero, because the conjugate stress is unbounded. An example is the
     *  volumetric strain rate for phi = 0. */
    virtual bool
    has_free_direction() const = 0;

    /** Returns the largest strength k of the points. */
    virtual double
    largest_strength() const = 0;

    /** Sets the weight of each point in the barrier function: the volume V
     *  divided by the mean volume. @param margin reduction of the strength k */
    virtual void
    begin(const double mean_volume, const double margin) = 0;

    /** Adds the elastic stiffness matrix of each point to the global matrix. It
     *  is V B'(1 + stiffness E) B, where E is the projection onto the
     *  constrained rates. */
    virtual void
    add_elastic_blocks(BlockMatrix       &matrix,
                       const unsigned int set,
                       const double       stiffness) const = 0;
    virtual void
    add_elastic_forces(const Eigen::VectorXd &q,
                       const double           stiffness,
                       Eigen::VectorXd       &F) const = 0;

    /** Updates the Lagrange multipliers of the strain rates that the flow rule
     *  constrains to zero. The function add_constraint_forces() adds the forces
     *  of the multipliers and of the stiffness. */
    virtual void
    add_multipliers(const Eigen::VectorXd &q, const double stiffness) = 0;
    virtual void
    add_constraint_forces(const Eigen::VectorXd &q,
                          const double           stiffness,
                          Eigen::VectorXd       &F) const = 0;

    /** Sets the dual variables Z to those of the strain rates B q.
     *  @return two sums over the points: of V |Z|^2 and of the weights V */
    virtual std::array<double, 2>
    start_rates(const Eigen::VectorXd &q) = 0;

    /** Raises the eigenvalues of Z to the mean rate, and sets the initial stress
     *  variables. */
    virtual void
    start(const double mean_rate, const double least_strength) = 0;

    /** Sums of complementarity products and residuals over the points of the
     *  group, for the current iterate. */
    struct Sums
    {
      double product        = 0.; ///< X.Z
      double gap            = 0.; ///< V/w X.Z
      double flow_residual  = 0.; ///< V |flow residual/w|^2
      double size           = 0.; ///< V |B q|^2
      double largest_stress = 0.; ///< mean eigenvalue of X, or unbounded stress
    };

    /** Computes the residuals of the conic problem, and their sums over the
     *  points, for the velocities q. @param margin of the rates in their
     *  cone */
    virtual Sums
    evaluate(const Eigen::VectorXd &q, const double margin) = 0;

    /** Adds the internal forces sum V B's of all points (volume V, strain
     *  matrix B, stress s). */
    virtual void
    add_forces(Eigen::VectorXd &F) const = 0;

    /** Computes the Nesterov-Todd scaling of each point and factorises its compliance. */
    virtual void
    scale() = 0;
    virtual void
    add_blocks(BlockMatrix &matrix, const unsigned int set) const = 0;

    /** @name Newton's direction for lambda-scaled right-hand sides d */
    /** @{ */
    /** Sets the right-hand side of the predictor step to -lambda, with the
     *  scaled iterate lambda. */
    virtual void
    predict() = 0;
    /** Sets the right-hand side d of the interior-point corrector step:
     *  d = -lambda + lambda \ (target e - x_hat o z_hat). */
    virtual void
    correct(const double target) = 0;
    /** Adds Gondzio's correction to the right-hand side: after the steps t_x and t_z,
     *  the eigenvalues of x o z would be in the neighbourhood of the target. The
     *  direction is kept for take_back(). */
    virtual void
    correct_further(const double target,
                    const double t_x,
                    const double t_z) = 0;
    /** Restores the direction before correct_further(). */
    virtual void
    take_back() = 0;
    /** Adds the internal forces due to the part of the search direction that is
     *  independent of the velocity increments dq. */
    virtual void
    add_given_forces(Eigen::VectorXd &F) = 0;
    /** Completes the search direction for given velocity increments dq.
     *  @return the largest steps of X and Z */
    virtual std::array<double, 2>
    complete(const Eigen::VectorXd &dq) = 0;
    /** Returns the complementarity product after a step of lengths a_x and a_z,
     *  i.e. the sum of (X + a_x dX).(Z + a_z dZ) over the points. */
    virtual double
    product_after(const double a_x, const double a_z) const = 0;
    virtual void
    advance(const double b_x, const double b_z) = 0;
    /** @} */

    /** Adds to the stresses the increments that are due to the velocities x,
     *  with the last Nesterov-Todd scaling. */
    virtual void
    polish(const Eigen::VectorXd &x) = 0;

    /** Returns the largest part of the stresses that is in the cones, at most 1; zero if
     *  there is none. */
    virtual double
    admissible_part() const = 0;

    /** Stores a copy of the current iterate. The function restore() returns to this
     *  copy. */
    virtual void
    keep() = 0;
    virtual void
    restore() = 0;

    /** Stores a copy of the stresses of the current iterate. The function
     *  restore_stresses() returns to this copy. */
    virtual void
    keep_stresses() = 0;
    virtual void
    restore_stresses() = 0;

    /** Returns the stress of a point as a vector of Law::rows components. */
    virtual Eigen::VectorXd
    stress(const unsigned int point) const = 0;
  };

  /** Group of points with a given strength law and number of dofs per point.
   *  @tparam Law strength law (StrengthLaw, or a law with the same members)
   *  @tparam n_columns number of dofs per point */
  template <typename Law, int n_columns>
  class PointGroupOf : public PointGroup
  {
  public:
    static constexpr int columns = n_columns, rows = Law::rows;
    using Cone = typename Law::Cone;
    using Y    = typename Law::Y;
    using S    = typename Law::S;
    using X    = typename Law::X;

    /** True for points whose matrices are multiplied with sizes known at compile time. */
    static constexpr bool is_small = rows <= 3;
    using Strains                  = Eigen::Matrix<double,
                                  rows,
                                  columns,
                                  is_small ? Eigen::RowMajor : Eigen::ColMajor>;

    /** Creates a group without points. @param laws strength laws of the points */
    explicit PointGroupOf(const std::vector<Law> &laws)
      : laws(laws)
    {}

    template <typename Matrix, typename Dofs>
    void
    add(const Matrix      &B_p,
        const Dofs        &dofs_p,
        const double       V,
        const unsigned int law_p,
        const double       k_p)
    {
      B.push_back(B_p);
      dofs.insert(dofs.end(), &dofs_p[0], &dofs_p[0] + columns);
      volume.push_back(V);
      law.push_back(law_p);
      k.push_back(k_p);
    }

    BlockMatrix::Set
    set() const override
    {
      return {columns, n_points(), dofs.data()};
    }
    double
    degree() const override
    {
      return double(Cone::degree) * n_points();
    }
    bool
    has_free_direction() const override
    {
      return std::any_of(law.begin(), law.end(), [&](const unsigned int l) {
        return laws[l].constrained_rate().squaredNorm() > 0.;
      });
    }
    double
    largest_strength() const override
    {
      return k.empty() ? 0. : *std::max_element(k.begin(), k.end());
    }

    void
    begin(const double mean_volume, const double margin) override
    {
      const unsigned int n = n_points();
      strength_margin      = margin;
      w.resize(n);
      for (unsigned int p = 0; p < n; ++p)
        w[p] = volume[p] / mean_volume;
      if constexpr (!Law::x_is_variable)
        y.resize(n);
      z.resize(n);
      x.resize(n);
      residual.resize(n);
      elimination.resize(n);
      d.resize(n);
      along.resize(n);
    }

    void
    add_elastic_blocks(BlockMatrix       &matrix,
                       const unsigned int set,
                       const double       stiffness) const override
    {
      for (unsigned int p = 0; p < n_points(); ++p)
        add_block(matrix, set, p, elastic(p, stiffness));
    }

    void
    add_elastic_forces(const Eigen::VectorXd &q,
                       const double           stiffness,
                       Eigen::VectorXd       &F) const override
    {
      for (unsigned int p = 0; p < n_points(); ++p)
        add_force(p, elastic(p, stiffness) * rate_of(p, q), F);
    }

    void
    add_multipliers(const Eigen::VectorXd &q, const double stiffness) override
    {
      multipliers.resize(n_points(), S::Zero());
      for (unsigned int p = 0; p < n_points(); ++p)
        {
          const S e = rate_of(p, q);
          multipliers[p] += elastic(p, stiffness) * e - e;
        }
    }

    void
    add_constraint_forces(const Eigen::VectorXd &q,
                          const double           stiffness,
                          Eigen::VectorXd       &F) const override
    {
      for (unsigned int p = 0; p < n_points(); ++p)
        {
          const S e = rate_of(p, q);
          S       s = elastic(p, stiffness) * e - e;
          if (!multipliers.empty())
            s += multipliers[p];
          add_force(p, s, F);
        }
    }

    std::array<double, 2>
    start_rates(const Eigen::VectorXd &q) override
    {
      std::array<double, 2> sums = {{0., 0.}};
      for (unsigned int p = 0; p < n_points(); ++p)
        {
          z[p] = law_of(p).rates_of_cone(w[p] * rate_of(p, q));
          sums[0] += volume[p] * z[p].squaredNorm();
          sums[1] += volume[p];
        }
      return sums;
    }

    void
    start(const double mean_rate, const double least_strength) override
    {
      scale_of_rate = mean_rate;
      for (unsigned int p = 0; p < n_points(); ++p)
        {
          const Law &own = law_of(p);
          z[p]           = Cone::raised(z[p], mean_rate);
          variables()[p] =
            own.start_variable(own.constrained_rate().squaredNorm() > 0.
                                 ? k[p]
                                 : std::max(k[p], least_strength));
        }
    }

    Sums
    evaluate(const Eigen::VectorXd &q, const double margin) override
    {
      Sums sums;
      for (unsigned int p = 0; p < n_points(); ++p)
        {
          const Law &own = law_of(p);
          if constexpr (!Law::x_is_variable)
            {
              x[p]                = own.cone_variable(y[p], strength(p));
              sums.largest_stress = std::max(
                sums.largest_stress, std::abs(own.unbounded_stress(y[p])));
            }
          const S rate = rate_of(p, q);
          residual[p]  = Law::extended(w[p] * (rate - margin * scale_of_rate *
                                                       own.rate_inside())) -
                        own.flow(z[p]);
          const double xz = x[p].dot(z[p]);
          sums.product += xz;
          sums.gap += volume[p] / w[p] * xz;
          sums.flow_residual += volume[p] * (residual[p] / w[p]).squaredNorm();
          sums.size += volume[p] * rate.squaredNorm();
          sums.largest_stress = std::max(sums.largest_stress,
                                         x[p].dot(Cone::unit()) / Cone::degree);
        }
      return sums;
    }

    void
    add_forces(Eigen::VectorXd &F) const override
    {
      for (unsigned int p = 0; p < n_points(); ++p)
        add_force(p, stress_of(p), F);
    }

    void
    scale() override
    {
      for (unsigned int p = 0; p < n_points(); ++p)
        elimination[p].scale(law_of(p), x[p], z[p], w[p]);
    }

    void
    add_blocks(BlockMatrix &matrix, const unsigned int set) const override
    {
      for (unsigned int p = 0; p < n_points(); ++p)
        add_block(matrix, set, p, elimination[p].stiffness(w[p]));
    }

    void
    predict() override
    {
      for (unsigned int p = 0; p < n_points(); ++p)
        d[p] = -elimination[p].scaling.lambda;
    }

    void
    correct(const double target) override
    {
      for (unsigned int p = 0; p < n_points(); ++p)
        {
          const auto &W = elimination[p].scaling;
          d[p] =
            -W.lambda + W.divide(target * Cone::unit() -
                                 Cone::product(along.x_hat[p], along.z_hat[p]));
        }
    }

    void
    correct_further(const double target,
                    const double t_x,
                    const double t_z) override
    {
      for (unsigned int p = 0; p < n_points(); ++p)
        {
          const auto &W = elimination[p].scaling;
          const X     c =
            Cone::correction(Cone::product(X(W.lambda + t_x * along.x_hat[p]),
                                           X(W.lambda + t_z * along.z_hat[p])),
                             target);
          if (!c.isZero(0.))
            d[p] += W.divide(c);
        }
      std::swap(along, before);
      along.resize(n_points());
    }

    void
    take_back() override
    {
      std::swap(along, before);
    }

    void
    add_given_forces(Eigen::VectorXd &F) override
    {
      for (unsigned int p = 0; p < n_points(); ++p)
        add_force(p, elimination[p].given(d[p], residual[p], w[p]), F);
    }

    std::array<double, 2>
    complete(const Eigen::VectorXd &dq) override
    {
      std::array<double, 2> steps = {{1. / 0.99, 1. / 0.99}};
      for (unsigned int p = 0; p < n_points(); ++p)
        {
          const auto &here = elimination[p];
          const auto &W    = here.scaling;
          const S     de   = rate_of(p, dq);
          if constexpr (Law::x_is_variable)
            here.complete(
              law_of(p), d[p], residual[p], de, w[p], along.x[p], along.z[p]);
          else
            here.complete(law_of(p),
                          d[p],
                          residual[p],
                          de,
                          w[p],
                          along.y[p],
                          along.x[p],
                          along.z[p]);
          along.x_hat[p] = W.x_hat(along.x[p]);
          along.z_hat[p] = W.z_hat(along.z[p]);
          steps[0]       = std::min(steps[0], W.step(along.x_hat[p]));
          steps[1]       = std::min(steps[1], W.step(along.z_hat[p]));
        }
      return steps;
    }

    double
    product_after(const double a_x, const double a_z) const override
    {
      double sum = 0.;
      for (unsigned int p = 0; p < n_points(); ++p)
        sum += (x[p] + a_x * along.x[p]).dot(z[p] + a_z * along.z[p]);
      return sum;
    }

    void
    advance(const double b_x, const double b_z) override
    {
      for (unsigned int p = 0; p < n_points(); ++p)
        {
          if constexpr (Law::x_is_variable)
            x[p] += b_x * along.x[p];
          else
            y[p] += b_x * along.y[p];
          z[p] += b_z * along.z[p];
        }
    }

    void
    polish(const Eigen::VectorXd &q) override
    {
      for (unsigned int p = 0; p < n_points(); ++p)
        variables()[p] += elimination[p].response(rate_of(p, q), w[p]);
    }

    double
    admissible_part() const override
    {
      double part = 1.;
      for (unsigned int p = 0; p < n_points(); ++p)
        if (const double f = Cone::excess(x[p]) - strength_margin; f > 0.)
          part = std::min(part, k[p] / (k[p] + f));
      return part;
    }

    void
    keep() override
    {
      kept_variables = variables();
      kept_z         = z;
    }
    void
    restore() override
    {
      variables() = kept_variables;
      z           = kept_z;
    }
    void
    keep_stresses() override
    {
      best_variables = variables();
    }
    void
    restore_stresses() override
    {
      variables() = best_variables;
    }

    Eigen::VectorXd
    stress(const unsigned int point) const override
    {
      return stress_of(point);
    }

  private:
    using Variables = std::vector<
      std::conditional_t<Law::x_is_variable, typename Law::X, typename Law::Y>>;

    /** Direction of the iterate; y is empty if X is the variable. */
    struct Direction
    {
      std::vector<Y> y;
      std::vector<X> x, z, x_hat, z_hat; ///< x_hat = W^-T dX, z_hat = W dZ

      void
      resize(const unsigned int n)
      {
        if constexpr (!Law::x_is_variable)
          y.resize(n);
        x.resize(n);
        z.resize(n);
        x_hat.resize(n);
        z_hat.resize(n);
      }
    };

    const Law &
    law_of(const unsigned int p) const
    {
      return std::is_empty_v<Law> ? laws.front() : laws[law[p]];
    }

    /** Strength k of a point less the margin. */
    double
    strength(const unsigned int p) const
    {
      return k[p] - strength_margin;
    }

    Variables &
    variables()
    {
      if constexpr (Law::x_is_variable)
        return x;
      else
        return y;
    }

    S
    stress_of(const unsigned int p) const
    {
      if constexpr (Law::x_is_variable)
        return Law::stress(x[p], strength(p));
      else
        return y[p].template head<rows>();
    }

    void
    add_block(BlockMatrix                             &matrix,
              const unsigned int                       set,
              const unsigned int                       p,
              const Eigen::Matrix<double, rows, rows> &C) const
    {
      Eigen::Matrix<double, columns, columns> block;
      if constexpr (is_small)
        {
          Strains CB;
          CB.noalias()    = (volume[p] * C).eval().lazyProduct(B[p]);
          block.noalias() = B[p].transpose().lazyProduct(CB);
        }
      else
        small_matrices::congruence(
          rows, columns, B[p].data(), C.data(), volume[p], block.data());
      matrix.add<columns>(set, p, block);
    }

    S
    rate_of(const unsigned int p, const Eigen::VectorXd &q) const
    {
      const unsigned int *const own = &dofs[columns * p];
      S                         e;
      if constexpr (is_small)
        {
          Eigen::Matrix<double, 1, columns> q_p;
          for (int j = 0; j < columns; ++j)
            q_p[j] = q[own[j]];
          for (int i = 0; i < rows; ++i)
            e[i] = B[p].row(i).dot(q_p);
        }
      else
        {
          e.setZero();
          for (int j = 0; j < columns; ++j)
            e += q[own[j]] * B[p].col(j);
        }
      return e;
    }

    void
    add_force(const unsigned int p, const S &s, Eigen::VectorXd &F) const
    {
      const unsigned int *const         own      = &dofs[columns * p];
      const S                           weighted = volume[p] * s;
      Eigen::Matrix<double, 1, columns> f        = weighted[0] * B[p].row(0);
      for (int i = 1; i < rows; ++i)
        f += weighted[i] * B[p].row(i);
      for (int j = 0; j < columns; ++j)
        F[own[j]] += f[j];
    }

    Eigen::Matrix<double, rows, rows>
    elastic(const unsigned int p, const double stiffness) const
    {
      const S constrained = law_of(p).constrained_rate();
      return Eigen::Matrix<double, rows, rows>::Identity() +
             stiffness * constrained * constrained.transpose();
    }

    std::vector<Law>          laws;
    std::vector<Strains>      B;
    std::vector<unsigned int> law;
    std::vector<double>       k, w;
    double                    scale_of_rate = 1., strength_margin = 0.;

    std::vector<Y>                         y, residual;
    std::vector<X>                         x, z, d, kept_z;
    Variables                              kept_variables, best_variables;
    std::vector<S>                         multipliers;
    Direction                              along, before;
    std::vector<typename Law::Elimination> elimination;
  };
} // namespace geocone

#endif
