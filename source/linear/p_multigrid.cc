// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/linear/linear_solver.h>
#include <geocone/linear/preconditioner.h>

#include <deal.II/base/mpi.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace geocone
{
  namespace
  {
    using dealii::types::global_dof_index;
    namespace MPI = dealii::Utilities::MPI;

    /** Sum of a number over the ranks before this one. Collective. */
    unsigned int
    sum_of_ranks_before(const unsigned int number, const MPI_Comm comm)
    {
      unsigned int sum = 0;
      MPI_Exscan(&number, &sum, 1, MPI_UNSIGNED, MPI_SUM, comm);
      return sum;
    }

    /** Inverses of the diagonal blocks of a matrix, one block per node. */
    class NodalBlocks
    {
    public:
      void
      analyse(const SparseMatrix &matrix, const NodalRows &nodes)
      {
        const unsigned int dim = nodes.n_components;
        first_row.clear();
        for (int i = 0; i < matrix.n_rows(); ++i)
          {
            const unsigned int node =
              nodes.layout->global_to_local(nodes.dof[i]) / dim;
            if (first_row.empty() || node != last_node)
              first_row.push_back(i);
            last_node = node;
          }
        first_row.push_back(matrix.n_rows());
        last_node = -1;
      }

      /** Inverts the blocks. Without elastic stiffness the block of a node is
       *  zero if all points of its cells are at the apex.
       *  @return false if a block is singular; the same on all ranks */
      [[nodiscard]] bool
      invert(const SparseMatrix &matrix, const RowOperator &rows)
      {
        // Sums the blocks over the ranks, column by column.
        std::array<RowVector, 3> column;
        for (RowVector &c : column)
          c.reinit(rows.layout());
        for (unsigned int b = 0; b + 1 < first_row.size(); ++b)
          for (int i = first_row[b]; i < first_row[b + 1]; ++i)
            {
              const int *const columns = matrix.columns(i);
              const int        from    = matrix.row_start[i],
                        n              = matrix.row_start[i + 1] - from;
              for (int k =
                     std::lower_bound(columns, columns + n, first_row[b]) -
                     columns;
                   k < n && columns[k] < first_row[b + 1];
                   ++k)
                {
                  const double entry = matrix.value[from + k];
                  column[columns[k] - first_row[b]].local_element(
                    rows.place(i)) = entry;
                  if (matrix.symmetric)
                    column[i - first_row[b]].local_element(
                      rows.place(columns[k])) = entry;
                }
            }
        if (MPI::n_mpi_processes(matrix.comm) > 1)
          for (RowVector &c : column)
            c.compress(dealii::VectorOperation::add);
        double largest = 0.; // of the diagonal
        for (unsigned int b = 0; first_row[b] < matrix.n_owned; ++b)
          for (int i = first_row[b]; i < first_row[b + 1]; ++i)
            largest = std::max(
              largest, std::abs(column[i - first_row[b]].local_element(i)));
        largest         = MPI::max(largest, matrix.comm);
        int is_singular = 0;
        inverse.clear();
        inverse.reserve(first_row.size() - 1);
        for (unsigned int b = 0; first_row[b] < matrix.n_owned; ++b)
          {
            Eigen::Matrix3d block = Eigen::Matrix3d::Identity();
            const int       n     = first_row[b + 1] - first_row[b];
            for (int i = 0; i < n; ++i)
              for (int k = 0; k < n; ++k)
                block(i, k) = column[k].local_element(first_row[b] + i);
            const Eigen::Array3d diagonal = block.diagonal().array().abs();
            if (!(diagonal.head(n).minCoeff() > smallest * largest &&
                  std::abs(block.determinant()) > smallest * diagonal.prod()))
              is_singular = 1;
            inverse.push_back(block.inverse());
          }
        return MPI::max(is_singular, matrix.comm) == 0;
      }

      /** Multiplies the owned rows by the inverses, in place. */
      void
      apply(RowVector &x) const
      {
        for (unsigned int b = 0; b < inverse.size(); ++b)
          {
            const int    first = first_row[b], n = first_row[b + 1] - first;
            const double old[3] = {x.local_element(first),
                                   n > 1 ? x.local_element(first + 1) : 0.,
                                   n > 2 ? x.local_element(first + 2) : 0.};
            for (int i = 0; i < n; ++i)
              x.local_element(first + i) = inverse[b](i, 0) * old[0] +
                                           inverse[b](i, 1) * old[1] +
                                           inverse[b](i, 2) * old[2];
          }
      }

    private:
      /** Smallest diagonal entry relative to the largest one of the matrix, and
       *  smallest determinant of a block relative to the product of its
       *  diagonal, which are not taken for rounding. */
      static constexpr double smallest = 1e-14;

      std::vector<int>             first_row; ///< of each local node with rows
      unsigned int                 last_node = -1;
      std::vector<Eigen::Matrix3d> inverse; ///< of owned nodes
    };

    /**
     * Linear interpolation from the free dofs of the vertices (coarse rows) to
     * the rows of a matrix, and the coarse matrix P' A P.
     */
    class Interpolation
    {
    public:
      /** Finds the coarse rows and the weights. Collective. */
      void
      analyse(const SparseMatrix &fine,
              const RowOperator  &fine_rows,
              const NodalRows    &nodes)
      {
        number_coarse_rows(fine, fine_rows, nodes);
        find_weights(fine, nodes);
        coarse_rows.reinit(coarse);
      }

      /** Finds the pattern of the coarse matrix.
       *  @param one_triangle whether its lower triangle only is stored */
      void
      set_pattern(const SparseMatrix &fine, const bool one_triangle)
      {
        find_fine_rows(fine);
        const int                     n = coarse.global_index.size();
        std::vector<std::vector<int>> columns(n);
        std::vector<int>              last_row(n, -1);
        for (int I = 0; I < n; ++I)
          for (int f = first_fine[I]; f < first_fine[I + 1]; ++f)
            {
              const int        i      = fine_of[f];
              const int *const of_row = fine.columns(i);
              const int n_of_row = fine.row_start[i + 1] - fine.row_start[i];
              for (int k = 0; k < n_of_row; ++k)
                for (int c = first[of_row[k]]; c < first[of_row[k] + 1]; ++c)
                  if (const int J = weights[c].first; last_row[J] != I)
                    {
                      last_row[J] = I;
                      if (!one_triangle || J <= I)
                        columns[I].push_back(J);
                      // The transposed entry of one triangle.
                      if (fine.symmetric && (!one_triangle || J >= I))
                        columns[J].push_back(I);
                    }
            }
        coarse.symmetric = one_triangle;
        coarse.set_pattern(std::move(columns));
      }

      /** Computes the coarse matrix P' A P. */
      void
      project(const SparseMatrix &fine)
      {
        std::fill(coarse.value.begin(), coarse.value.end(), 0.);
        std::vector<int> place(coarse.n_rows(), -1);
        // Next entry of each coarse row, for columns in ascending order.
        std::vector<int> next(coarse.row_start.begin(),
                              coarse.row_start.end() - 1);
        for (int I = 0; I < coarse.n_rows(); ++I)
          {
            for (int e = coarse.row_start[I]; e < coarse.row_start[I + 1]; ++e)
              place[coarse.column[e]] = e;
            for (int f = first_fine[I]; f < first_fine[I + 1]; ++f)
              {
                const int        i      = fine_of[f];
                const double     w      = weight(i, I);
                const int *const column = fine.columns(i);
                const int        from   = fine.row_start[i];
                for (int e = from; e < fine.row_start[i + 1]; ++e)
                  {
                    const double a = w * fine.value[e];
                    const int    j = column[e - from];
                    for (int c = first[j]; c < first[j + 1]; ++c)
                      {
                        const auto [J, v] = weights[c];
                        if (!fine.symmetric)
                          {
                            if (const int at = place[J]; at >= 0)
                              coarse.value[at] += a * v;
                          }
                        else if (J <= I) // the transposed entry counts as well
                          coarse.value[place[J]] +=
                            (J == I && j != i ? 2. : 1.) * a * v;
                        else if (j != i)
                          {
                            int &at = next[J];
                            while (coarse.column[at] < I)
                              ++at;
                            coarse.value[at] += a * v;
                          }
                      }
                  }
              }
            for (int e = coarse.row_start[I]; e < coarse.row_start[I + 1]; ++e)
              place[coarse.column[e]] = -1;
          }
        if (fine.symmetric && !coarse.symmetric)
          fill_upper_triangle();
      }

      /** Adds the interpolated coarse vector to owned rows. */
      void
      add_interpolated(RowVector &fine, const RowVector &of_vertices) const
      {
        of_vertices.update_ghost_values();
        for (unsigned int i = 0; i < fine.locally_owned_size(); ++i)
          for (int c = first[i]; c < first[i + 1]; ++c)
            fine.local_element(i) +=
              weights[c].second *
              of_vertices.local_element(coarse_rows.place(weights[c].first));
        of_vertices.zero_out_ghost_values();
      }

      /** Computes the coarse vector P' b. */
      void
      restrict_to_vertices(RowVector &of_vertices, const RowVector &b) const
      {
        of_vertices = 0.;
        for (unsigned int i = 0; i < b.locally_owned_size(); ++i)
          for (int c = first[i]; c < first[i + 1]; ++c)
            of_vertices.local_element(coarse_rows.place(weights[c].first)) +=
              weights[c].second * b.local_element(i);
        of_vertices.compress(dealii::VectorOperation::add);
      }

      /** Coarse rows as nodes of algebraic multigrid. Collective. */
      NodalRows
      coarse_nodes(const SparseMatrix &fine,
                   const RowOperator  &fine_rows,
                   const NodalRows    &nodes) const
      {
        const unsigned int dim = nodes.n_components;
        NodalRows          result;
        result.n_components = dim;
        // Vertices are numbered as the first of their rows.
        std::vector<unsigned int> owned; // local numbers of owned vertices
        for (int i = 0; i < fine.n_owned; ++i)
          if (coarse_of[i] >= 0)
            if (const unsigned int node = node_of(nodes, i);
                owned.empty() || node != owned.back())
              owned.push_back(node);
        const global_dof_index n_owned = owned.size(),
                               before = sum_of_ranks_before(n_owned, fine.comm),
                               all    = MPI::sum(n_owned, fine.comm);
        RowVector number(fine_rows.layout()); // of the vertex of each row
        int       last = -1;
        for (int i = 0; i < fine.n_owned; ++i)
          if (coarse_of[i] >= 0)
            {
              last += last < 0 || owned[last] != node_of(nodes, i);
              number.local_element(i) = before + last;
            }
        number.update_ghost_values();
        result.dof.resize(coarse.n_rows());
        for (int i = 0; i < fine.n_rows(); ++i)
          if (coarse_of[i] >= 0)
            result.dof[coarse_of[i]] =
              dim * global_dof_index(number.local_element(fine_rows.place(i)) +
                                     0.5) +
              nodes.dof[i] % dim;
        dealii::IndexSet range(dim * all), used(dim * all);
        range.add_range(dim * before, dim * (before + n_owned));
        std::vector<global_dof_index> sorted(
          result.dof.begin() + coarse.n_owned, result.dof.end());
        std::sort(sorted.begin(), sorted.end());
        used.add_indices(sorted.begin(), sorted.end());
        result.layout =
          std::make_shared<MPI::Partitioner>(range, used, fine.comm);
        for (const std::vector<double> &motion : nodes.rigid_motions)
          {
            std::vector<double> values;
            for (const unsigned int node : owned)
              for (unsigned int d = 0; d < dim; ++d)
                values.push_back(motion[dim * node + d]);
            result.rigid_motions.push_back(std::move(values));
          }
        return result;
      }

      SparseMatrix coarse;
      RowOperator  coarse_rows;

    private:
      static unsigned int
      node_of(const NodalRows &nodes, const int row)
      {
        return nodes.layout->global_to_local(nodes.dof[row]) /
               nodes.n_components;
      }

      /** Numbers the rows of vertices: owned rows first. */
      void
      number_coarse_rows(const SparseMatrix &fine,
                         const RowOperator  &fine_rows,
                         const NodalRows    &nodes)
      {
        coarse      = SparseMatrix();
        coarse.comm = fine.comm;
        coarse_of.assign(fine.n_rows(), -1);
        int n = 0;
        for (int i = 0; i < fine.n_rows(); ++i)
          {
            if (nodes.vertices->is_vertex(node_of(nodes, i)))
              coarse_of[i] = n++;
            if (i < fine.n_owned)
              coarse.n_owned = n;
          }
        const int before = sum_of_ranks_before(coarse.n_owned, fine.comm);
        coarse.n_global  = MPI::sum(coarse.n_owned, fine.comm);
        RowVector number(fine_rows.layout());
        for (int i = 0; i < fine.n_owned; ++i)
          number.local_element(i) = before + std::max(coarse_of[i], 0);
        number.update_ghost_values();
        for (int i = 0; i < fine.n_rows(); ++i)
          if (coarse_of[i] >= 0)
            coarse.global_index.push_back(
              std::lround(number.local_element(fine_rows.place(i))));
      }

      /** Copies the lower triangle of the coarse matrix to the upper one. */
      void
      fill_upper_triangle()
      {
        std::vector<int> next; // after the diagonal of each row
        for (int I = 0; I < coarse.n_rows(); ++I)
          next.push_back(coarse.entry(I, I) + 1);
        for (int I = 0; I < coarse.n_rows(); ++I)
          for (int e = coarse.row_start[I]; coarse.column[e] < I; ++e)
            coarse.value[next[coarse.column[e]]++] = coarse.value[e];
      }

      /** Finds the weights of coarse rows in each fine row. Components of
       *  turned nodes are along their own axes. */
      void
      find_weights(const SparseMatrix &fine, const NodalRows &nodes)
      {
        const unsigned int dim = nodes.n_components;
        const auto         n_nodes =
          nodes.layout->locally_owned_size() + nodes.layout->n_ghost_indices();
        std::vector<int> row_of(n_nodes, -1); // fine row of each local dof
        for (int i = 0; i < fine.n_rows(); ++i)
          row_of[nodes.layout->global_to_local(nodes.dof[i])] = i;
        std::vector<const double *> axes(n_nodes / dim, nullptr);
        for (const auto &[node, unit_vectors] : nodes.turned)
          axes[node] = unit_vectors.data();
        const auto unit_vector =
          [&](const unsigned int node, const unsigned int a, const unsigned d) {
            return axes[node] != nullptr ? axes[node][dim * a + d]
                                         : double(a == d);
          };
        first.assign(1, 0);
        weights.clear();
        for (int i = 0; i < fine.n_rows(); ++i)
          {
            const unsigned int dof =
              nodes.layout->global_to_local(nodes.dof[i]);
            const unsigned int node = dof / dim, a = dof % dim;
            for (std::size_t k = nodes.vertices->first[node];
                 k < nodes.vertices->first[node + 1];
                 ++k)
              {
                const auto [vertex, weight] = nodes.vertices->weights[k];
                for (unsigned int b = 0; b < dim; ++b)
                  {
                    double cosine = 0.; // of component a and the vertex's b
                    for (unsigned int d = 0; d < dim; ++d)
                      cosine +=
                        unit_vector(node, a, d) * unit_vector(vertex, b, d);
                    const int row = row_of[dim * vertex + b];
                    if (row >= 0 && std::abs(cosine) > 1e-14)
                      weights.emplace_back(coarse_of[row], weight * cosine);
                  }
              }
            first.push_back(weights.size());
          }
      }

      /** Finds the fine rows and weights of each coarse row. */
      void
      find_fine_rows(const SparseMatrix &fine)
      {
        first_fine.assign(coarse.global_index.size() + 1, 0);
        for (const auto &[row, weight] : weights)
          ++first_fine[row + 1];
        std::partial_sum(
          first_fine.begin(), first_fine.end(), first_fine.begin());
        fine_of.resize(weights.size());
        std::vector<int> next(first_fine.begin(), first_fine.end() - 1);
        for (int i = 0; i < fine.n_rows(); ++i)
          for (int c = first[i]; c < first[i + 1]; ++c)
            fine_of[next[weights[c].first]++] = i;
      }

      /** Weight of a coarse row in a fine row, which contains it. */
      double
      weight(const int fine_row, const int coarse_row) const
      {
        int c = first[fine_row];
        while (weights[c].first != coarse_row)
          ++c;
        return weights[c].second;
      }

      std::vector<int> coarse_of; ///< coarse row of each fine row, or -1

      /** Coarse rows and weights of each fine row, and index of its first. */
      std::vector<std::pair<int, double>> weights;
      std::vector<int>                    first;

      /** Fine rows of each coarse row, and index of its first. */
      std::vector<int> fine_of, first_fine;
    };

    class PMultigrid : public Preconditioner
    {
    public:
      PMultigrid(const bool                      symmetric,
                 std::unique_ptr<LinearSolver>   direct,
                 std::unique_ptr<Preconditioner> aggregation)
        : symmetric(symmetric)
        , direct(std::move(direct))
        , aggregation(std::move(aggregation))
      {}

      void
      analyse(const SparseMatrix &matrix, NodalRows nodes) override
      {
        fine.reinit(matrix);
        blocks.analyse(matrix, nodes);
        levels.analyse(matrix, fine, nodes);
        is_large = levels.coarse.n_global > largest_direct;
        levels.set_pattern(matrix, !is_large && direct->wants_one_triangle());
        if (is_large)
          aggregation->analyse(levels.coarse,
                               levels.coarse_nodes(matrix, fine, nodes));
        else
          direct->analyse(levels.coarse);
        for (RowVector *x : {&residual, &change, &product})
          x->reinit(fine.layout());
        for (RowVector *x : {&coarse_b, &coarse_x})
          x->reinit(levels.coarse_rows.layout());
        start_eigenvector();
        largest_eigenvalue = 0.;
      }

      bool
      factorise(const SparseMatrix &matrix) override
      {
        n_mended = 0;
        if (!blocks.invert(matrix, fine) ||
            !(symmetric ? find_largest_by_lanczos() : find_largest_by_powers()))
          return false;
        levels.project(matrix);
        return is_large ? aggregation->factorise(levels.coarse)
                        : direct->factorise(levels.coarse);
      }

      void
      vmult(RowVector &x, const RowVector &b) const override
      {
        x = 0.;
        smooth(x, b, true);
        fine.vmult(residual, x);
        residual.sadd(-1., 1., b);
        levels.restrict_to_vertices(coarse_b, residual);
        if (is_large)
          aggregation->vmult(coarse_x, coarse_b);
        else
          {
            std::vector<double> values(coarse_b.begin(),
                                       coarse_b.begin() +
                                         coarse_b.locally_owned_size());
            direct->solve(values);
            std::copy(values.begin(), values.end(), coarse_x.begin());
          }
        levels.add_interpolated(x, coarse_x);
        smooth(x, b, false);
      }

      bool
      make_definite() override
      {
        // An eigenvalue beyond the interval of the polynomial.
        largest_eigenvalue *= 1.5;
        return ++n_mended <= 3;
      }

      bool
      takes_compact_matrix() const override
      {
        return true;
      }

      std::string
      name() const override
      {
        return "p-multigrid";
      }

    private:
      /** Number of coarse unknowns beyond which a V-cycle of aggregation
       *  replaces the direct solver. */
      static constexpr int largest_direct = 40000;

      /** Degree of the smoother, and ratio of the ends of its interval. */
      static constexpr int    degree = 4;
      static constexpr double range  = 15.;

      /** Largest eigenvalue of the smoother over the computed one. */
      static constexpr double margin = 1.10;

      /** Takes a vector with parts of all frequencies. */
      void
      start_eigenvector()
      {
        eigenvector.reinit(fine.layout());
        for (unsigned int i = 0; i < eigenvector.locally_owned_size(); ++i)
          eigenvector.local_element(i) =
            std::sin(1. + 7. * (fine.layout()->local_range().first + i));
      }

      /** Power iterations, a few more after the pattern has changed. The last
       *  eigenvector is the start of the next ones.
       *  @return false for a matrix without a finite eigenvalue above zero */
      bool
      find_largest_by_powers()
      {
        const int n = largest_eigenvalue == 0. ? 12 : 4;
        for (int k = 0; k < n; ++k)
          {
            eigenvector /= eigenvector.l2_norm();
            fine.vmult(product, eigenvector);
            blocks.apply(product);
            largest_eigenvalue = product.l2_norm();
            if (!std::isfinite(largest_eigenvalue) || largest_eigenvalue == 0.)
              {
                largest_eigenvalue = 0.;
                start_eigenvector();
                return false;
              }
            eigenvector.swap(product);
          }
        return true;
      }

      /**
       * Lanczos iterations, as the coefficients of conjugate gradients with the
       * nodal blocks as the preconditioner. They find eigenvalues of a few nodes,
       * which the plastic tangents add between two matrices, to some per cent;
       * powers of the last eigenvector miss them.
       * @return false for a matrix that is not positive definite at all
       */
      bool
      find_largest_by_lanczos()
      {
        constexpr int   n = 12;
        Eigen::VectorXd diagonal(n), side(n);
        RowVector      &r = residual, &p = change;
        double          r_z = 0., length = 0.;
        int             k = 0;
        for (start_eigenvector(), r = eigenvector; k < n; ++k)
          {
            product = r;
            blocks.apply(product);
            const double next_r_z = r * product;
            if (!(next_r_z > 0.))
              break;
            const double beta = k == 0 ? 0. : next_r_z / r_z;
            if (k == 0)
              p = product;
            else
              p.sadd(beta, 1., product);
            r_z = next_r_z;
            fine.vmult(product, p);
            const double curvature = p * product;
            if (!(curvature > 0.))
              break;
            diagonal(k) = curvature / r_z;
            if (k > 0)
              {
                diagonal(k) += beta / length;
                side(k - 1) = std::sqrt(beta) / length;
              }
            length = r_z / curvature;
            r.add(-length, product);
          }
        if (k == 0)
          return false;
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> tridiagonal;
        tridiagonal.computeFromTridiagonal(
          diagonal.head(k), side.head(k - 1), Eigen::EigenvaluesOnly);
        largest_eigenvalue = tridiagonal.eigenvalues()(k - 1);
        return std::isfinite(largest_eigenvalue);
      }

      /** Chebyshev smoother, x += p(D^-1 A) D^-1 (b - A x). */
      void
      smooth(RowVector &x, const RowVector &b, const bool from_zero) const
      {
        const double most = margin * largest_eigenvalue, least = most / range,
                     middle = 0.5 * (most + least), half = 0.5 * (most - least);
        double rho = half / middle;
        if (from_zero)
          residual = b;
        else
          {
            fine.vmult(residual, x);
            residual.sadd(-1., 1., b);
          }
        change = residual;
        blocks.apply(change);
        change *= 1. / middle;
        for (int k = 1;; ++k)
          {
            x += change;
            if (k == degree)
              break;
            fine.vmult(product, change);
            residual -= product;
            product = residual;
            blocks.apply(product);
            const double next = 1. / (2. * middle / half - rho);
            change.sadd(next * rho, 2. * next / half, product);
            rho = next;
          }
      }

      const bool                      symmetric;
      std::unique_ptr<LinearSolver>   direct;
      std::unique_ptr<Preconditioner> aggregation;

      RowOperator       fine;
      NodalBlocks       blocks;
      Interpolation     levels;
      bool              is_large           = false;
      double            largest_eigenvalue = 0.;
      unsigned int      n_mended           = 0; ///< of the last matrix
      RowVector         eigenvector;
      mutable RowVector residual, change, product, coarse_b, coarse_x;
    };
  } // namespace

  std::unique_ptr<Preconditioner>
  make_p_multigrid(const bool                      symmetric,
                   std::unique_ptr<LinearSolver>   direct,
                   std::unique_ptr<Preconditioner> aggregation)
  {
    return std::make_unique<PMultigrid>(
      symmetric, std::move(direct), std::move(aggregation));
  }
} // namespace geocone
