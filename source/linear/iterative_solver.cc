// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/linear/linear_solver.h>
#include <geocone/linear/preconditioner.h>

#include <deal.II/lac/solver_control.h>
#include <deal.II/lac/solver_gmres.h>

#include <algorithm>
#include <cmath>

namespace geocone
{
  namespace
  {
    /**
     * Deflation of conjugate gradients by the solutions of earlier systems. Near
     * a limit load these are the mechanism of failure for the most part, whose
     * small stiffness a preconditioner misses. The solution in their span is
     * computed at the start, and directions are conjugate to it.
     */
    class Deflation
    {
    public:
      /** Orthonormalises the solutions in the energy of a symmetric matrix, the
       *  last one first. Those without energy are left out. */
      void
      prepare(const RowOperator &matrix)
      {
        std::vector<RowVector> earlier;
        earlier.swap(basis);
        products.clear();
        for (auto v = earlier.rbegin(); v != earlier.rend(); ++v)
          {
            RowVector product(*v);
            matrix.vmult(product, *v);
            const double of_all = *v * product;
            for (unsigned int j = 0; j < basis.size(); ++j)
              {
                const double part = *v * products[j];
                v->add(-part, basis[j]);
                product.add(-part, products[j]);
              }
            const double energy = *v * product;
            if (!(of_all > 0. && energy > smallest * of_all))
              continue;
            *v /= std::sqrt(energy);
            product /= std::sqrt(energy);
            basis.push_back(std::move(*v));
            products.push_back(std::move(product));
          }
        std::reverse(basis.begin(), basis.end());
        std::reverse(products.begin(), products.end());
      }

      /** Adds the part of the solution in the span. @param[in,out] r residual */
      void
      add_start(RowVector &solution, RowVector &r) const
      {
        for (unsigned int j = 0; j < products.size(); ++j)
          {
            const double part = r * basis[j];
            solution.add(part, basis[j]);
            r.add(-part, products[j]);
          }
      }

      /** Makes a direction conjugate to the span. */
      void
      project(RowVector &direction) const
      {
        for (unsigned int j = 0; j < products.size(); ++j)
          direction.add(-(direction * products[j]), basis[j]);
      }

      /** Keeps the solution of a system for the next ones. */
      void
      keep(const RowVector &solution)
      {
        const double size = solution.l2_norm();
        if (!(size > 0. && std::isfinite(size)))
          return;
        if (basis.size() == most)
          {
            basis.erase(basis.begin());
            if (!products.empty())
              products.erase(products.begin());
          }
        basis.push_back(solution);
        basis.back() /= size;
      }

      bool
      is_empty() const
      {
        return products.empty();
      }

    private:
      /** Number of solutions that are kept. Each takes two vectors. */
      static constexpr unsigned int most = 4;

      /** Smallest part of the energy of a solution beside those of the later
       *  ones. */
      static constexpr double smallest = 1e-10;

      /** Solutions, the last one at the end, and the matrix times those that
       *  are prepared, the first ones. */
      std::vector<RowVector> basis, products;
    };

    /**
     * Conjugate gradients, or GMRES for non-symmetric matrices, with a
     * preconditioner. Systems that take too many iterations are solved
     * directly, and so are the next ones: one after the first failure, three
     * after the next, and so on, until one converges in time. Systems that are
     * too large for this have the solution of the last iteration, if its
     * residual is below the right-hand side.
     */
    class IterativeSolver : public LinearSolver
    {
    public:
      IterativeSolver(const bool                      symmetric,
                      const LinearSolverParameters   &parameters,
                      std::unique_ptr<Preconditioner> preconditioner,
                      std::unique_ptr<LinearSolver>   direct)
        : symmetric(symmetric)
        , smallest_tolerance(parameters.tolerance)
        , largest_tolerance(
            std::max(parameters.tolerance, parameters.largest_tolerance))
        , max_iterations(parameters.max_iterations)
        , largest_direct(parameters.largest_direct)
        , preconditioner(std::move(preconditioner))
        , direct(std::move(direct))
        , tolerance(parameters.tolerance)
      {}

      bool
      wants_nodal_rows() const override
      {
        return true;
      }

      void
      set_nodal_rows(NodalRows new_nodes) override
      {
        nodes = std::move(new_nodes);
      }

      void
      set_tolerance(const double wanted) override
      {
        tolerance =
          std::min(std::max(wanted, smallest_tolerance), largest_tolerance);
      }

      const LinearIterations *
      iterations() const override
      {
        return &counts;
      }

      void
      analyse(const SparseMatrix &matrix) override
      {
        direct_is_ready = false;
        deflation       = Deflation();
        is_large        = nodes.n_components == 3 &&
                   std::size_t(matrix.n_global) > largest_direct;
        if (is_large)
          n_to_skip = 0;
        rows.reinit(matrix);
        preconditioner->analyse(matrix, std::move(nodes));
        solution.reinit(rows.layout());
        right_side.reinit(rows.layout());
      }

      bool
      factorise(const SparseMatrix &matrix) override
      {
        last      = &matrix;
        is_direct = n_to_skip > 0;
        if (is_direct)
          --n_to_skip;
        else
          is_direct = !preconditioner->factorise(matrix);
        if (symmetric && !is_direct)
          deflation.prepare(rows);
        return !is_direct || (!is_large && factorise_directly());
      }

      void
      solve(std::vector<double> &x, const unsigned int n_columns) override
      {
        const std::size_t n = last->n_owned;
        for (unsigned int c = 0; c < n_columns && !is_direct; ++c)
          if (!iterate(&x[n * c]))
            {
              // Columns already solved are kept.
              std::vector<double> rest(x.begin() + n * c, x.end());
              n_in_a_row = std::min(2 * n_in_a_row + 1, 15U);
              n_to_skip  = n_in_a_row;
              is_direct  = true;
              if (factorise_directly())
                direct->solve(rest, n_columns - c);
              else
                // Singular: too late to report, so the direction is zero.
                std::fill(rest.begin(), rest.end(), 0.);
              std::copy(rest.begin(), rest.end(), x.begin() + n * c);
              return;
            }
        if (is_direct)
          direct->solve(x, n_columns);
        else
          n_in_a_row = 0;
      }

      bool
      wants_one_triangle() const override
      {
        return symmetric && takes_shared_columns();
      }

      bool
      takes_shared_columns() const override
      {
        return preconditioner->takes_compact_matrix();
      }

      std::string
      name() const override
      {
        return preconditioner->name();
      }

    private:
      /** @return whether the solution is within the tolerance after the allowed
       *  iterations, or is to be used without */
      bool
      iterate(double *x)
      {
        std::copy_n(x, last->n_owned, right_side.begin());
        solution          = 0.;
        const double norm = right_side.l2_norm();
        if (norm == 0.)
          return true;
        dealii::SolverControl control(
          max_iterations, tolerance * norm, false, false);
        const bool converged =
          symmetric ? conjugate_gradients(control) : gmres(control, norm);
        ++counts.systems;
        counts.total += control.last_step();
        counts.most = std::max(counts.most, control.last_step());
        if (!converged && is_large)
          ++counts.stopped;
        if (is_large &&
            (!converged || 2 * control.last_step() > max_iterations))
          ++counts.hard;
        if (symmetric)
          deflation.keep(solution);
        if (converged || is_large)
          std::copy_n(solution.begin(), last->n_owned, x);
        return converged || is_large;
      }

      /**
       * Performs preconditioned conjugate gradients. Their iterates are descent
       * directions of the energy as long as the matrix and the preconditioner
       * are positive definite, also if the residual is large. A preconditioner
       * that turns out to be indefinite is made definite, and the iterations
       * restart. They end at a direction of negative curvature.
       * @return whether the solution is within the tolerance
       */
      bool
      conjugate_gradients(dealii::SolverControl &control)
      {
        using State    = dealii::SolverControl::State;
        RowVector &r   = right_side, z(r), p(r), product(r);
        double     r_z = 0.;
        deflation.add_start(solution, r);
        if (control.check(0, r.l2_norm()) == State::success)
          return true;
        for (unsigned int step = 0;;)
          {
            preconditioner->vmult(z, r);
            const double next_r_z = r * z;
            if (!(next_r_z > 0.))
              {
                if (!std::isfinite(next_r_z) ||
                    !preconditioner->make_definite())
                  return false;
                r_z = 0.;
                continue;
              }
            deflation.project(z);
            if (r_z == 0.)
              p = z;
            else
              p.sadd(next_r_z / r_z, 1., z);
            r_z = next_r_z;
            rows.vmult(product, p);
            const double curvature = p * product;
            if (!(curvature > 0.))
              {
                if (step == 0 && deflation.is_empty() &&
                    std::isfinite(curvature))
                  solution = p;
                return false;
              }
            solution.add(r_z / curvature, p);
            r.add(-r_z / curvature, product);
            const State state = control.check(++step, r.l2_norm());
            if (state != State::iterate)
              return state == State::success;
          }
      }

      /** Performs GMRES. The solution of systems too large for a direct solver
       *  is zero unless its residual is below the right-hand side.
       *  @return whether the solution is within the tolerance */
      bool
      gmres(dealii::SolverControl &control, const double norm)
      {
        try
          {
            dealii::SolverGMRES<RowVector>(
              control,
              dealii::SolverGMRES<RowVector>::AdditionalData(100, true))
              .solve(rows, solution, right_side, *preconditioner);
          }
        catch (const dealii::SolverControl::NoConvergence &)
          {
            // Neither NaN nor a larger residual than that of zero.
            if (!(control.last_value() < norm))
              solution = 0.;
            return false;
          }
        return true;
      }

      /** Factorises the last matrix by the direct solver. */
      bool
      factorise_directly()
      {
        ++counts.directly;
        const bool lower = direct->wants_one_triangle();
        const bool is_as_wanted =
          lower == last->symmetric && last->column_start.empty();
        if (!direct_is_ready)
          {
            for_direct =
              is_as_wanted ? SparseMatrix() : with_own_columns(lower);
            direct->analyse(is_as_wanted ? *last : for_direct);
            direct_is_ready = true;
          }
        if (is_as_wanted)
          return direct->factorise(*last);
        for (int i = 0; i < last->n_rows(); ++i)
          std::copy_n(&last->value[last->row_start[i]],
                      for_direct.row_start[i + 1] - for_direct.row_start[i],
                      &for_direct.value[for_direct.row_start[i]]);
        return direct->factorise(for_direct);
      }

      /** Creates the pattern of the last matrix, or of its lower triangle, where
       *  each row has its own columns. */
      SparseMatrix
      with_own_columns(const bool lower) const
      {
        SparseMatrix result;
        result.comm         = last->comm;
        result.symmetric    = lower;
        result.n_global     = last->n_global;
        result.n_owned      = last->n_owned;
        result.global_index = last->global_index;
        for (int i = 0; i < last->n_rows(); ++i)
          {
            const int *const begin = last->columns(i);
            const int *const end =
              begin + (last->row_start[i + 1] - last->row_start[i]);
            result.column.insert(result.column.end(),
                                 begin,
                                 lower ? std::upper_bound(begin, end, i) : end);
            result.row_start.push_back(result.column.size());
          }
        result.value.resize(result.column.size());
        return result;
      }

      const bool                      symmetric;
      const double                    smallest_tolerance, largest_tolerance;
      const unsigned int              max_iterations, largest_direct;
      std::unique_ptr<Preconditioner> preconditioner;
      std::unique_ptr<LinearSolver>   direct;

      double           tolerance;
      NodalRows        nodes;
      RowOperator      rows;
      RowVector        solution, right_side;
      Deflation        deflation;
      LinearIterations counts;

      const SparseMatrix *last = nullptr; ///< last factorised
      SparseMatrix        for_direct;
      bool                is_large        = false; ///< for direct solvers
      bool                direct_is_ready = false;
      bool                is_direct       = false;
      unsigned int        n_in_a_row = 0, n_to_skip = 0; ///< failures
    };
  } // namespace

  std::unique_ptr<LinearSolver>
  make_iterative(const bool                      symmetric,
                 const LinearSolverParameters   &parameters,
                 std::unique_ptr<Preconditioner> preconditioner,
                 std::unique_ptr<LinearSolver>   direct)
  {
    return std::make_unique<IterativeSolver>(
      symmetric, parameters, std::move(preconditioner), std::move(direct));
  }
} // namespace geocone
