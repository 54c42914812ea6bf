// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/newton/line_search.h>
#include <geocone/reduced/gauss_seidel.h>
#include <geocone/reduced/reduced_newton.h>

#include <Eigen/SparseLU>

#include <ctime>

namespace geocone::GEOCONE_DIM
{
  using Eigen::MatrixXd;
  using Eigen::VectorXd;

  namespace
  {
    /** Maximum of a restart: further sweeps rarely help. */
    constexpr unsigned int most_sweeps = 3200;

    /** Map F_p and, with dz = W ds, its differential dF_p = A ds_p + B dz_p. */
    struct PointMap
    {
      Mandel       F;
      MandelMatrix A, B;
    };

    /** Map with D = diag(K, 2G, 2G) for the return map, rho I for the natural map. */
    PointMap
    point_map(const ReducedNewton::Map map,
              const FlowCone          &cone,
              const Mandel            &D,
              const Mandel            &s,
              const Mandel            &z)
    {
      PointMap     result;
      MandelMatrix slope; // derivative of P_C or R
      if (map == ReducedNewton::Map::natural_map)
        {
          const double rho = D[0];
          result.F =
            s - project(cone.a, cone.k, Mandel(s - rho * cone.psi(z)), &slope);
          result.B = rho * slope * cone.psi_slope(z);
        }
      else
        {
          Mandel returned;
          return_map(cone,
                     D[0],
                     D[1],
                     Mandel(s - D.cwiseProduct(z)),
                     returned,
                     &result.B);
          result.F = s - returned;
          slope    = result.B * D.cwiseInverse().asDiagonal();
        }
      result.A = MandelMatrix::Identity() - slope;
      return result;
    }

    /** System of the unknowns s, followed by lambda. */
    class System
    {
    public:
      System(const ReducedProblem &problem, const ReducedNewton &newton)
        : problem(problem)
        , map(newton.map)
        , elastic(newton.rho == 0. && map == ReducedNewton::Map::return_map &&
                  problem.S.size() > 0)
        , D(problem.n_cones(), Mandel::Constant(newton.rho))
        , points(problem.n_cones())
        , n_stresses(problem.q.size())
        , dense(!problem.has_factors() &&
                problem.W.nonZeros() > 0.05 * n_stresses * n_stresses)
      {
        if (newton.rho != 0.)
          return;
        for (unsigned int p = 0; p < D.size(); ++p)
          if (elastic)
            D[p] = problem.S.segment<n_mandel>(n_mandel * p).cwiseInverse();
          else
            D[p].setConstant(10. * natural_scale(problem.diagonal_block(p)));
      }

      /** Whether D is that of the elasticity. */
      bool
      is_elastic() const
      {
        return elastic;
      }

      /** Strain dz - S ds of a step: h V B times the change of the velocity. */
      VectorXd
      strain(const VectorXd &step) const
      {
        const VectorXd ds = step.head(n_stresses);
        VectorXd       dz = problem.multiply(ds) - problem.S.cwiseProduct(ds);
        if (problem.n_multipliers() > 0)
          dz -= problem.C * step.tail(problem.n_multipliers());
        return dz;
      }

      /** Product F.x at the last evaluate(). */
      double
      dot(const VectorXd &x) const
      {
        double sum = 0.;
        for (unsigned int p = 0; p < points.size(); ++p)
          sum += points[p].F.dot(x.segment<n_mandel>(n_mandel * p));
        return sum;
      }

      /** Returns |F|^2 and stores the data of the Jacobian. */
      double
      evaluate(const VectorXd &s, const VectorXd &lambda)
      {
        const VectorXd z   = problem.z(s, lambda);
        double         sum = 0.;
        for (unsigned int p = 0; p < points.size(); ++p)
          {
            points[p] = point_map(map,
                                  problem.cones[p],
                                  D[p],
                                  s.segment<n_mandel>(n_mandel * p),
                                  z.segment<n_mandel>(n_mandel * p));
            sum += points[p].F.squaredNorm();
          }
        return sum;
      }

      /** Newton step at the last evaluate(); not finite if J is singular. */
      VectorXd
      step() const
      {
        const unsigned int size = n_stresses + problem.n_multipliers();
        VectorXd           rhs  = VectorXd::Zero(size);
        for (unsigned int p = 0; p < points.size(); ++p)
          rhs.segment<n_mandel>(n_mandel * p) = -points[p].F;
        if (problem.has_factors())
          return step_by_factors(rhs.head(n_stresses));
        if (dense)
          {
            MatrixXd J = MatrixXd::Zero(size, size);
            assemble(
              [&J](const int i, const int j, const double x) { J(i, j) += x; });
            return J.partialPivLu().solve(rhs);
          }
        Entries entries;
        assemble([&entries](const int i, const int j, const double x) {
          entries.emplace_back(i, j, x);
        });
        return solved(entries, rhs);
      }

    private:
      using Entries = std::vector<Eigen::Triplet<double>>;

      /** Solution; not finite if the matrix is singular. */
      static VectorXd
      solved(const Entries &entries, const VectorXd &rhs)
      {
        Eigen::SparseMatrix<double> matrix(rhs.size(), rhs.size());
        matrix.setFromTriplets(entries.begin(), entries.end());
        const Eigen::SparseLU<Eigen::SparseMatrix<double>> factors(matrix);
        if (factors.info() != Eigen::Success)
          return VectorXd::Constant(rhs.size(), std::nan(""));
        return factors.solve(rhs);
      }

      /**
       * The same step with fewer unknowns: with E = A + B S and u = diag(m) (G'ds -
       * H'dlambda),
       *   E ds + B G u = -F,   (diag(1/m) + G'E^-1 B G) u + H'dlambda = -G'E^-1 F,
       *   H u = 0.
       */
      VectorXd
      step_by_factors(const VectorXd &rhs) const
      {
        using Matrix                   = ReducedProblem::Matrix;
        const Matrix      &G           = problem.G;
        const unsigned int n_nodal     = problem.m.size(),
                           multipliers = problem.n_multipliers();
        VectorXd scaled(n_stresses); // E^-1 rhs
        Entries  entries;            // E^-1 B
        for (unsigned int p = 0; p < points.size(); ++p)
          {
            const MandelMatrix inverse =
              (points[p].A +
               points[p].B *
                 problem.S.segment<n_mandel>(n_mandel * p).asDiagonal())
                .inverse();
            scaled.segment<n_mandel>(n_mandel * p) =
              inverse * rhs.segment<n_mandel>(n_mandel * p);
            const MandelMatrix slope = inverse * points[p].B;
            for (int i = 0; i < n_mandel; ++i)
              for (int k = 0; k < n_mandel; ++k)
                entries.emplace_back(
                  n_mandel * p + i, n_mandel * p + k, slope(i, k));
          }
        Matrix slopes(n_stresses, n_stresses);
        slopes.setFromTriplets(entries.begin(), entries.end());
        const Matrix slopes_G = slopes * G;
        const Matrix tangent  = G.transpose() * slopes_G;

        entries.clear();
        for (unsigned int i = 0; i < n_nodal; ++i)
          entries.emplace_back(i, i, 1. / problem.m[i]);
        for (unsigned int i = 0; i < n_nodal; ++i)
          for (Matrix::InnerIterator x(tangent, i); x; ++x)
            entries.emplace_back(i, x.col(), x.value());
        for (unsigned int r = 0; r < multipliers; ++r)
          for (Matrix::InnerIterator x(problem.H, r); x; ++x)
            {
              entries.emplace_back(n_nodal + r, x.col(), x.value());
              entries.emplace_back(x.col(), n_nodal + r, x.value());
            }
        VectorXd nodal_rhs      = VectorXd::Zero(n_nodal + multipliers);
        nodal_rhs.head(n_nodal) = G.transpose() * scaled;
        const VectorXd found    = solved(entries, nodal_rhs);
        VectorXd       step(n_stresses + multipliers);
        step.head(n_stresses)  = scaled - slopes_G * found.head(n_nodal);
        step.tail(multipliers) = found.tail(multipliers);
        return step;
      }

      /**
       * Jacobian J = [A + B W, -B C; -C', L], with the lower rows scaled to order one.
       */
      template <typename Add>
      void
      assemble(const Add &add) const
      {
        for (unsigned int p = 0; p < points.size(); ++p)
          for (int i = 0; i < n_mandel; ++i)
            for (int k = 0; k < 3; ++k)
              {
                add(n_mandel * p + i, n_mandel * p + k, points[p].A(i, k));
                const double b   = points[p].B(i, k);
                const int    row = n_mandel * p + k;
                if (b == 0.)
                  continue;
                for (ReducedProblem::Matrix::InnerIterator w(problem.W, row); w;
                     ++w)
                  add(n_mandel * p + i, w.col(), b * w.value());
                for (unsigned int c = 0; c < problem.n_multipliers(); ++c)
                  add(n_mandel * p + i, n_stresses + c, -b * problem.C(row, c));
              }
        for (unsigned int r = 0; r < problem.n_multipliers(); ++r)
          {
            const double size =
              std::max(problem.C.col(r).lpNorm<Eigen::Infinity>(),
                       problem.L.row(r).lpNorm<Eigen::Infinity>());
            for (unsigned int j = 0; j < n_stresses; ++j)
              if (const double x = problem.C(j, r); x != 0.)
                add(n_stresses + r, j, -x / size);
            for (unsigned int c = 0; c < problem.n_multipliers(); ++c)
              add(n_stresses + r, n_stresses + c, problem.L(r, c) / size);
          }
      }

      const ReducedProblem    &problem;
      const ReducedNewton::Map map;
      const bool               elastic;
      std::vector<Mandel>      D;
      std::vector<PointMap>    points;
      const unsigned int       n_stresses;
      const bool               dense;
    };
  } // namespace

  ReducedReport
  ReducedNewton::solve(const ReducedProblem &problem, VectorXd &s) const
  {
    const std::clock_t start = std::clock();
    System             system(problem, *this);
    VectorXd           lambda = problem.multipliers(s);
    double             before = system.evaluate(s, lambda);
    GaussSeidel        sweeper;
    sweeper.tolerance  = tolerance;
    sweeper.max_sweeps = restart_sweeps;
    ReducedReport report;
    for (;;)
      {
        report.error = problem.natural_map_error(s);
        report.errors.push_back(report.error);
        report.converged = report.error <= tolerance;
        if (report.converged || report.iterations == max_iterations ||
            !s.allFinite())
          break;

        ++report.iterations;
        const VectorXd step = system.step();
        const VectorXd s0 = s, lambda0 = lambda;
        // lambda fulfils the linear constraints, which remain fulfilled along the step.
        const auto move = [&](const double length) {
          s      = s0 + length * step.head(s.size());
          lambda = lambda0 + length * step.tail(lambda.size());
          return system.evaluate(s, lambda);
        };
        if (system.is_elastic())
          {
            const VectorXd strain = system.strain(step);
            line_search(system.dot(strain), [&](const double length) {
              move(length);
              return system.dot(strain);
            });
            continue;
          }
        const auto falls = [&](const double length) {
          const double after = move(length);
          if (!(after <= (1. - 1e-4 * length) * before))
            return false;
          before = after;
          return true;
        };
        double length = 1.;
        while (!falls(length) && length > 1e-3)
          length /= 2.;
        if (length > 1e-3)
          continue;

        s = s0;
        sweeper.solve(problem, s);
        sweeper.max_sweeps = std::min(2 * sweeper.max_sweeps, most_sweeps);
        lambda             = problem.multipliers(s);
        before             = system.evaluate(s, lambda);
        ++report.restarts;
      }
    report.cpu_seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
    return report;
  }
} // namespace geocone::GEOCONE_DIM
