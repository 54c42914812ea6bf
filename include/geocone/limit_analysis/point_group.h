// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_point_group_h
#define geocone_limit_analysis_point_group_h

#include <geocone/limit_analysis/block_matrix.h>
#include <geocone/limit_analysis/strength_law.h>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
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

    /** Sets the weight of each point in the barrier function: the volume V
     *  divided by the mean volume. */
    virtual void
    begin(const double mean_volume) = 0;

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

    /** Returns two sums over the points: of V |B q|^2 (weight V, strain rate B
     *  q) and of the weights V. */
    virtual std::array<double, 2>
    rate_square(const Eigen::VectorXd &q) const = 0;

    /** Sets the initial stress variables y and dual variables Z. The eigenvalues of Z are
     *  at least the mean rate. */
    virtual void
    start(const Eigen::VectorXd &q, const double mean_rate) = 0;

    /** Sums of complementarity products and residuals over the points of the
     *  group, for the current iterate. */
    struct Sums
    {
      double product              = 0.; ///< X.Z
      double gap                  = 0.; ///< V/w X.Z
      double flow_residual        = 0.; ///< V |flow residual/w|^2
      double size                 = 0.; ///< V |B q|^2
      double largest_stress_ratio = 0.; ///< largest X over k
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
    /** Adds the internal forces due to the part of the search direction that is
     *  independent of the velocity increments dq. */
    virtual void
    add_given_forces(Eigen::VectorXd &F) const = 0;
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

    /** Stores a copy of the current iterate. The function restore() returns to this
     *  copy. */
    virtual void
    keep() = 0;
    virtual void
    restore() = 0;

    /** Returns the stress of a point as a vector of Law::rows components. */
    virtual Eigen::VectorXd
    stress(const unsigned int point) const = 0;
  };

  /** Group of points with a given strength law and number of dofs per point.
   *  @tparam Law strength law @tparam n_columns number of dofs per point */
  template <typename Law, int n_columns>
  class PointGroupOf : public PointGroup
  {
  public:
    static constexpr int columns = n_columns, rows = Law::rows,
                         n_y = Law::columns, size = Law::size;
    using Cone    = typename Law::Cone;
    using Y       = typename Law::Y;
    using S       = typename Law::S;
    using X       = typename Law::X;
    using Strains = Eigen::Matrix<double, rows, columns>;

    /** Creates a group without points. @param laws strength laws of the points */
    explicit PointGroupOf(const std::vector<Law> &laws)
      : laws(laws)
    {}

    void
    add(const Strains                           &B_p,
        const std::array<unsigned int, columns> &dofs_p,
        const double                             V,
        const unsigned int                       law_p,
        const double                             k_p)
    {
      B.push_back(B_p);
      dofs.insert(dofs.end(), dofs_p.begin(), dofs_p.end());
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
        return laws[l].null_vector.squaredNorm() > 0.;
      });
    }

    void
    begin(const double mean_volume) override
    {
      const unsigned int n = n_points();
      w.resize(n);
      for (unsigned int p = 0; p < n; ++p)
        w[p] = volume[p] / mean_volume;
      y.resize(n);
      z.resize(n);
      x.resize(n);
      residual.resize(n);
      rate.resize(n);
      local.resize(n);
      d.resize(n);
      g.resize(n);
      dy.resize(n);
      dx.resize(n);
      dz.resize(n);
      x_hat.resize(n);
      z_hat.resize(n);
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
    rate_square(const Eigen::VectorXd &q) const override
    {
      std::array<double, 2> sums = {{0., 0.}};
      for (unsigned int p = 0; p < n_points(); ++p)
        {
          sums[0] += volume[p] * rate_of(p, q).squaredNorm();
          sums[1] += volume[p];
        }
      return sums;
    }

    void
    start(const Eigen::VectorXd &q, const double mean_rate) override
    {
      scale_of_rate = mean_rate;
      for (unsigned int p = 0; p < n_points(); ++p)
        {
          const Law &own = laws[law[p]];
          y[p]           = k[p] * own.start;
          z[p]           = Cone::raised(
            own.pseudo_inverse * extended(w[p] * rate_of(p, q)), mean_rate);
        }
    }

    Sums
    evaluate(const Eigen::VectorXd &q, const double margin) override
    {
      Sums sums;
      for (unsigned int p = 0; p < n_points(); ++p)
        {
          const Law &own = laws[law[p]];
          x[p]           = k[p] * own.o - own.A * y[p];
          rate[p]        = rate_of(p, q);
          residual[p] =
            extended(w[p] * (rate[p] - margin * scale_of_rate * own.inside)) -
            own.A.transpose() * z[p];
          const double xz = x[p].dot(z[p]);
          sums.product += xz;
          sums.gap += volume[p] / w[p] * xz;
          sums.flow_residual += volume[p] * (residual[p] / w[p]).squaredNorm();
          sums.size += volume[p] * rate[p].squaredNorm();
          sums.largest_stress_ratio =
            std::max(sums.largest_stress_ratio, x[p].norm() / k[p]);
        }
      return sums;
    }

    void
    add_forces(Eigen::VectorXd &F) const override
    {
      for (unsigned int p = 0; p < n_points(); ++p)
        add_force(p, y[p].template head<rows>(), F);
    }

    void
    scale() override
    {
      for (unsigned int p = 0; p < n_points(); ++p)
        {
          const Law                           &own = laws[law[p]];
          const typename Cone::Scaling         W(x[p], z[p]);
          Local                               &here = local[p];
          Eigen::Matrix<double, size + 1, n_y> scaled;
          for (int j = 0; j < n_y; ++j)
            scaled.col(j).template head<size>() = W.x_hat(own.A.col(j));
          scaled.template bottomRows<1>() =
            std::sqrt(w[p] / bulk) * own.null_vector.transpose();
          small_matrices::factorise(
            size + 1, n_y, scaled.data(), here.Q.data(), here.T_inverse.data());
          const Eigen::Matrix<double, rows, n_y> upper =
            here.T_inverse.template topRows<rows>();
          small_matrices::multiply_transpose(
            rows, rows, n_y, upper.data(), upper.data(), w[p], here.C.data());
          here.from_null.setZero();
          if (const int m = own.n_null; m > 0)
            {
              Eigen::Matrix<double, size, size> WN, Q_2, T_2, T_turned, N_T;
              for (int j = 0; j < m; ++j)
                WN.col(j) = W.z_hat(own.null.col(j));
              small_matrices::factorise(
                size, m, WN.data(), Q_2.data(), T_2.data());
              for (int i = 0; i < m; ++i)
                for (int j = 0; j < m; ++j)
                  T_turned.data()[j + m * i] = T_2.data()[i + m * j];
              small_matrices::multiply_transpose(
                size, m, m, own.null.data(), T_turned.data(), 1., N_T.data());
              small_matrices::multiply_transpose(size,
                                                 size,
                                                 m,
                                                 N_T.data(),
                                                 Q_2.data(),
                                                 1.,
                                                 here.from_null.data());
            }
          here.scaling = W;
        }
    }

    void
    add_blocks(BlockMatrix &matrix, const unsigned int set) const override
    {
      for (unsigned int p = 0; p < n_points(); ++p)
        add_block(matrix, set, p, local[p].C);
    }

    void
    predict() override
    {
      for (unsigned int p = 0; p < n_points(); ++p)
        {
          d[p] = -local[p].scaling->lambda;
          set_given(p);
        }
    }

    void
    correct(const double target) override
    {
      for (unsigned int p = 0; p < n_points(); ++p)
        {
          const auto &W = *local[p].scaling;
          d[p]          = -W.lambda + W.divide(target * Cone::unit() -
                                      Cone::product(x_hat[p], z_hat[p]));
          set_given(p);
        }
    }

    void
    add_given_forces(Eigen::VectorXd &F) const override
    {
      for (unsigned int p = 0; p < n_points(); ++p)
        add_force(p, g[p].template head<rows>(), F);
    }

    std::array<double, 2>
    complete(const Eigen::VectorXd &dq) override
    {
      std::array<double, 2> steps = {{1. / 0.99, 1. / 0.99}};
      for (unsigned int p = 0; p < n_points(); ++p)
        {
          const Law   &own  = laws[law[p]];
          const Local &here = local[p];
          const auto  &W    = *here.scaling;
          const Y      de   = extended(w[p] * rate_of(p, dq));
          dy[p] = g[p] + here.T_inverse * (here.T_inverse.transpose() * de);
          dx[p] = -(own.A * dy[p]);
          const Y goal =
            residual[p] + de -
            w[p] / bulk * own.null_vector * own.null_vector.dot(dy[p]);
          // Flow exactly, whatever the accuracy of C; the rest from complementarity.
          const X least = own.pseudo_inverse * goal;
          dz[p]         = least + here.from_null * (d[p] - W.z_hat(least));
          x_hat[p]      = W.x_hat(dx[p]);
          z_hat[p]      = W.z_hat(dz[p]);
          steps[0]      = std::min(steps[0], W.step(x_hat[p]));
          steps[1]      = std::min(steps[1], W.step(z_hat[p]));
        }
      return steps;
    }

    double
    product_after(const double a_x, const double a_z) const override
    {
      double sum = 0.;
      for (unsigned int p = 0; p < n_points(); ++p)
        sum += (x[p] + a_x * dx[p]).dot(z[p] + a_z * dz[p]);
      return sum;
    }

    void
    advance(const double b_x, const double b_z) override
    {
      for (unsigned int p = 0; p < n_points(); ++p)
        {
          y[p] += b_x * dy[p];
          z[p] += b_z * dz[p];
        }
    }

    void
    polish(const Eigen::VectorXd &q) override
    {
      for (unsigned int p = 0; p < n_points(); ++p)
        y[p] += local[p].T_inverse * (local[p].T_inverse.transpose() *
                                      extended(w[p] * rate_of(p, q)));
    }

    void
    keep() override
    {
      kept_y = y;
      kept_z = z;
    }
    void
    restore() override
    {
      y = kept_y;
      z = kept_z;
    }

    Eigen::VectorXd
    stress(const unsigned int point) const override
    {
      return y[point].template head<rows>();
    }

  private:
    /** Penalty stiffness, in the method of multipliers, of the strain rates
     *  that the flow rule constrains to zero. Strength, lengths and velocities
     *  are of order one. */
    static constexpr double bulk = 1e6;

    /** QR factors of the matrix A of a point's strength law, scaled by the
     *  Nesterov-Todd scaling W. Products of the factors are far more accurate
     *  than the inverse of A'W^-1W^-T A. */
    struct Local
    {
      Eigen::Matrix<double, size + 1, n_y>  Q;
      Eigen::Matrix<double, n_y, n_y>       T_inverse;
      Eigen::Matrix<double, rows, rows>     C;
      Eigen::Matrix<double, size, size>     from_null; ///< N T_2^-1 Q_2'
      std::optional<typename Cone::Scaling> scaling;
    };

    void
    add_block(BlockMatrix                             &matrix,
              const unsigned int                       set,
              const unsigned int                       p,
              const Eigen::Matrix<double, rows, rows> &C) const
    {
      Eigen::Matrix<double, columns, columns> block;
      small_matrices::congruence(
        rows, columns, B[p].data(), C.data(), volume[p], block.data());
      matrix.add<columns>(set, p, block);
    }

    S
    rate_of(const unsigned int p, const Eigen::VectorXd &q) const
    {
      const unsigned int *const own = &dofs[columns * p];
      S                         e   = S::Zero();
      for (int j = 0; j < columns; ++j)
        e += q[own[j]] * B[p].col(j);
      return e;
    }

    void
    add_force(const unsigned int p, const S &s, Eigen::VectorXd &F) const
    {
      const unsigned int *const own = &dofs[columns * p];
      for (int j = 0; j < columns; ++j)
        F[own[j]] += volume[p] * B[p].col(j).dot(s);
    }

    /** Returns the strain rate e, extended by zeros for the internal variables of the
     *  strength law. */
    static Y
    extended(const S &e)
    {
      Y all                     = Y::Zero();
      all.template head<rows>() = e;
      return all;
    }

    Eigen::Matrix<double, rows, rows>
    elastic(const unsigned int p, const double stiffness) const
    {
      const S free = laws[law[p]].null_vector.template head<rows>();
      Eigen::Matrix<double, rows, rows> C =
        Eigen::Matrix<double, rows, rows>::Identity();
      if (free.squaredNorm() > 0.)
        C += stiffness / free.squaredNorm() * free * free.transpose();
      return C;
    }

    void
    set_given(const unsigned int p)
    {
      const Local &here = local[p];
      g[p] =
        here.T_inverse * (here.T_inverse.transpose() * residual[p] -
                          here.Q.template topRows<size>().transpose() * d[p]);
    }

    std::vector<Law>          laws;
    std::vector<Strains>      B;
    std::vector<unsigned int> law;
    std::vector<double>       k, w;
    double                    scale_of_rate = 1.;

    std::vector<Y>     y, residual, g, dy, kept_y;
    std::vector<X>     x, z, d, dx, dz, x_hat, z_hat, kept_z;
    std::vector<S>     rate, multipliers;
    std::vector<Local> local;
  };
} // namespace geocone

#endif
