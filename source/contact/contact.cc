// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/over_ranks.h>
#include <geocone/contact/contact.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  using dealii::Tensor;

  unsigned int
  Contact::n_free(const unsigned int node) const
  {
    unsigned int n = 0;
    for (unsigned int d = 0; d < dim; ++d)
      n += unknowns.is_free(dim * node + d);
    return n;
  }

  Tensor<1, dim>
  Contact::free_part(const Tensor<1, dim> &x, const unsigned int node) const
  {
    Tensor<1, dim> part;
    for (unsigned int d = 0; d < dim; ++d)
      if (unknowns.is_free(dim * node + d))
        part[d] = x[d];
    return part;
  }

  Contact::Force
  Contact::free_part(const Vector &v, const unsigned int node) const
  {
    Force value;
    for (unsigned int d = 0; d < dim; ++d)
      if (unknowns.is_free(dim * node + d))
        value[d] = v.local_element(dim * node + d);
    return value;
  }

  Contact::Force
  Contact::velocity_of_partners(const ContactNode &node, const Vector &v) const
  {
    Force velocity;
    for (const ContactNode::Partner &other : node.partners)
      for (unsigned int d = 0; d < dim; ++d)
        velocity[d] += other.part * v.local_element(dim * other.node + d);
    return velocity;
  }

  void
  Contact::load_partners(Vector &residual) const
  {
    if (!has_pairs)
      return;
    residual.zero_out_ghost_values();
    for (const ContactNode &node : list)
      if (is_owned(node) && node.touches_body())
        {
          const Force r = node.share * free_part(residual, node.node);
          for (const ContactNode::Partner &other : node.partners)
            for (unsigned int d = 0; d < dim; ++d)
              residual.local_element(dim * other.node + d) += other.part * r[d];
        }
    residual.compress(dealii::VectorOperation::add);
  }

  void
  Contact::add_rows_to_partners(SparseMatrix &matrix) const
  {
    for (const ContactNode &node : list)
      for (const ContactNode::Partner &other : node.partners)
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int e = 0; e < dim; ++e)
            {
              const int from    = unknowns.free_row[dim * node.node + e],
                        to      = unknowns.free_row[dim * other.node + d];
              const double part = other.part * node.share[d][e];
              if (from < 0 || to < 0 || part == 0.)
                continue;
              // Both rows have sorted columns, and those of the first are a
              // subset.
              const int *column = matrix.columns(to);
              double    *sum    = &matrix.value[matrix.row_start[to]];
              const int  start  = matrix.row_start[from],
                        n       = matrix.row_start[from + 1] - start;
              for (int j = 0; j < n; ++j)
                {
                  for (; *column < matrix.columns(from)[j]; ++column)
                    ++sum;
                  *sum += part * matrix.value[start + j];
                }
            }
  }

  std::vector<std::vector<unsigned int>>
  Contact::links() const
  {
    std::vector<std::vector<unsigned int>> all;
    for (const ContactNode &node : list)
      if (node.touches_body())
        {
          all.push_back({node.node});
          for (const ContactNode::Partner &other : node.partners)
            all.back().push_back(other.node);
        }
    return all;
  }

  double
  Contact::rho_of(const ContactNode &node, const Vector &scale) const
  {
    const auto mean = [&](const unsigned int of) {
      double sum = 0.;
      for (unsigned int d = 0; d < dim; ++d)
        if (unknowns.is_free(dim * of + d))
          sum += scale.local_element(dim * of + d) / n_free(of);
      return sum;
    };
    double compliance = 1. / mean(node.node);
    for (const ContactNode::Partner &other : node.partners)
      if (const double stiffness = mean(other.node); stiffness > 0.)
        compliance += other.part * other.part / stiffness;
    return 1. / compliance;
  }

  Contact::Projection
  Contact::project(const ContactNode &node,
                   const Local       &at,
                   const Force       &velocity,
                   const Law         &law)
  {
    Projection   result;
    const Force &n   = node.normal;
    const Force  u   = at.v - velocity;
    const double rho = at.rho, w = u * n - node.least, p = at.r * n - rho * w;
    result.q = -node.tension * n;
    result.F = at.r - result.q;
    // A node at rest without force counts as supported: it may have no other
    // support.
    if (!(p >= -node.tension) && !(law.holds && node.is_closed))
      return result;
    const double mu = law.with_friction ? node.friction : 0.;
    const double bound =
      law.with_friction ? mu * std::max(p, -node.tension) + node.adhesion : 0.;
    const Force u_T = u - (u * n) * n, r_T = at.r - (at.r * n) * n,
                pull  = r_T - rho * u_T;
    const double size = pull.norm();
    const Matrix I    = dealii::unit_symmetric_tensor<dim>();
    Force        F_T, q_T;
    result.Q = outer_product(n, n);
    if (bound > 0. && size <= bound)
      {
        result.state = State::stick;
        F_T          = rho * u_T;
        q_T          = pull;
        result.Q     = I;
      }
    else
      {
        result.state = State::slip;
        if (bound > 0.)
          {
            const Force along = pull / size;
            q_T               = bound * along;
            result.Q += mu * outer_product(along, n);
            if (dim == 3) // sliding direction may rotate
              result.Q +=
                bound / size *
                (I - outer_product(n, n) - outer_product(along, along));
          }
        F_T = r_T - q_T;
      }
    result.F = rho * w * n + F_T;
    result.q = p * n + q_T;
    return result;
  }

  void
  Contact::add_to_obstacle(const ContactNode &node,
                           const double       rho,
                           const Projection  &at,
                           double            *sums)
  {
    for (unsigned int k = 0; k < n_motions; ++k)
      {
        const Force G = node.of_obstacle * RigidMotion::of_point(k, node.arm);
        sums[k] += G * at.q;
        for (unsigned int l = 0; l < n_motions; ++l)
          sums[n_motions + n_motions * k + l] +=
            rho * (G * (at.Q * (node.of_obstacle *
                                RigidMotion::of_point(l, node.arm))));
      }
    sums[ObstacleMotions::n_sums - 1] += at.q.norm() * (1. + node.arm.norm());
  }

  std::vector<double>
  Contact::sums_of_nodes(const std::vector<Local> &locals,
                         const MPI_Comm            comm) const
  {
    std::vector<double> sums(ObstacleMotions::n_sums * obstacles.n_obstacles(),
                             0.);
    for (unsigned int i = 0; i < list.size(); ++i)
      if (const ContactNode &node = list[i]; is_owned(node) &&
                                             !node.touches_body() &&
                                             obstacles.is_free(node.obstacle))
        {
          const Projection at =
            project(node,
                    locals[i],
                    node.of_obstacle *
                      obstacles.velocities()[node.obstacle].at(node.arm),
                    law);
          add_to_obstacle(node,
                          locals[i].rho,
                          at,
                          &sums[ObstacleMotions::n_sums * node.obstacle]);
        }
    sum_over_ranks(sums, comm);
    return sums;
  }

  std::vector<unsigned int>
  Contact::choose(const MPI_Comm comm) const
  {
    double largest = 0.;
    for (unsigned int i = 0; i < list.size(); ++i)
      if (nodal_contact[i].state != State::open)
        largest = std::max(largest, nodal_contact[i].size);
    largest = dealii::Utilities::MPI::max(largest, comm);
    std::vector<unsigned int> chosen;
    for (unsigned int i = 0; i < list.size(); ++i)
      if (is_owned(list[i]) && !list[i].is_corner &&
          (nodal_contact[i].state != State::open ||
           nodal_contact[i].rho *
               (nodal_contact[i].relative * list[i].normal - list[i].least) <=
             largest))
        chosen.push_back(i);
    return chosen;
  }

  void
  Contact::relax(const std::vector<unsigned int> &chosen)
  {
    relaxed = true;
    for (Vector &row : row_A)
      row.zero_out_ghost_values();
    for (const unsigned int i : chosen)
      {
        rho_Q[i] = Matrix();
        for (unsigned int a = 0; a < dim; ++a)
          {
            rho_Q[i][a][a] = nodal_contact[i].rho;
            for (unsigned int b = 0; b < dim; ++b)
              row_A[a].local_element(dim * list[i].node + b) = a == b ? 1. : 0.;
          }
      }
    for (Vector &row : row_A)
      row.update_ghost_values();
  }

  ContactTraits
  Contact::traits(const MPI_Comm comm) const
  {
    const bool frictional =
      std::any_of(list.begin(), list.end(), [](const ContactNode &node) {
        return node.friction > 0. || node.adhesion > 0.;
      });
    ContactTraits result;
    result.exists    = true;
    result.of_bodies = has_pairs;
    result.has_friction =
      dealii::Utilities::MPI::max(int(frictional), comm) > 0;
    result.has_free_obstacles = obstacles.n_free() > 0;
    result.obstacles_loaded =
      result.has_free_obstacles && obstacles.are_loaded();
    return result;
  }

  void
  Contact::replace(Vector       &residual,
                   const Vector &v,
                   const Vector &scale,
                   const bool    has_friction,
                   const bool    holds_now)
  {
    law     = {has_friction, holds_now};
    relaxed = false;
    nodal_contact.assign(list.size(), NodalContact());
    rho_Q.assign(list.size(), Matrix());
    for (Vector &row : row_A)
      if (row.size() == 0)
        row.reinit(residual);
      else
        row.zero_out_ghost_values();
    load_partners(residual);
    std::vector<Local> locals(list.size());
    for (unsigned int i = 0; i < list.size(); ++i)
      if (const unsigned int node = list[i].node; is_owned(list[i]))
        {
          locals[i].r   = list[i].share * free_part(residual, node);
          locals[i].v   = free_part(v, node);
          locals[i].rho = rho_of(list[i], scale);
        }
    const MPI_Comm comm = residual.get_mpi_communicator();
    obstacles.find([&]() { return sums_of_nodes(locals, comm); });
    body_error =
      obstacles.error() / dealii::Utilities::MPI::n_mpi_processes(comm);
    for (unsigned int i = 0; i < list.size(); ++i)
      {
        ContactNode &node = list[i];
        node.velocity     = node.touches_body()
                              ? velocity_of_partners(node, v)
                              : obstacles.velocities()[node.obstacle].at(node.arm);
        if (!is_owned(node))
          continue;
        const Force      velocity = node.touches_body()
                                      ? free_part(node.velocity, node.node)
                                      : node.of_obstacle * node.velocity;
        const Projection at       = project(node, locals[i], velocity, law);
        nodal_contact[i].force    = locals[i].r;
        nodal_contact[i].state    = at.state;
        nodal_contact[i].size =
          locals[i].r.norm() + locals[i].rho * (locals[i].v - velocity).norm();
        nodal_contact[i].relative = locals[i].v - velocity;
        nodal_contact[i].rho      = locals[i].rho;
        rho_Q[i]                  = locals[i].rho * at.Q;
        Matrix A                  = node.share - at.Q * node.share;
        for (unsigned int a = 0; a < dim; ++a)
          for (unsigned int b = 0; b < dim; ++b)
            if (node.is_second)
              row_A[a].local_element(dim * node.node + b) += A[a][b];
            else
              row_A[a].local_element(dim * node.node + b) = A[a][b];
        for (unsigned int d = 0; d < dim; ++d)
          if (unknowns.is_free(dim * node.node + d))
            {
              double &row = residual.local_element(dim * node.node + d);
              row         = (node.is_second ? row : 0.) + at.F[d];
              nodal_contact[i].error =
                std::hypot(nodal_contact[i].error, at.F[d]);
            }
      }
    for (Vector &row : row_A)
      row.update_ghost_values();
  }

  void
  Contact::combine_rows(const unsigned int node, SparseMatrix &matrix) const
  {
    // All of its rows have the same columns.
    std::array<unsigned int, dim> free;
    std::array<double *, dim>     row;
    unsigned int                  n_rows = 0;
    int                           n      = 0;
    for (unsigned int d = 0; d < dim; ++d)
      if (const int r = unknowns.free_row[dim * node + d]; r >= 0)
        {
          free[n_rows]  = d;
          row[n_rows++] = &matrix.value[matrix.row_start[r]];
          n             = matrix.row_start[r + 1] - matrix.row_start[r];
        }
    for (int k = 0; k < n; ++k)
      {
        std::array<double, dim> sum = {};
        for (unsigned int a = 0; a < n_rows; ++a)
          for (unsigned int b = 0; b < n_rows; ++b)
            sum[a] +=
              row_A[free[a]].local_element(dim * node + free[b]) * row[b][k];
        for (unsigned int a = 0; a < n_rows; ++a)
          row[a][k] = sum[a];
      }
  }

  LowRank
  Contact::linearise(const JacobianPattern &pattern, SparseMatrix &matrix) const
  {
    add_rows_to_partners(matrix);
    const LowRank of_obstacles = low_rank(matrix);
    for (unsigned int i = 0; i < list.size(); ++i)
      {
        const int *row = &unknowns.free_row[dim * list[i].node];
        if (!list[i].is_second)
          combine_rows(list[i].node, matrix);
        if (is_owned(list[i]))
          for (unsigned int a = 0; a < dim; ++a)
            for (unsigned int b = 0; b < dim; ++b)
              {
                if (row[a] < 0)
                  continue;
                if (row[b] >= 0)
                  pattern.add_entry(row[a], row[b], rho_Q[i][a][b], matrix);
                for (const ContactNode::Partner &other : list[i].partners)
                  if (const int column =
                        unknowns.free_row[dim * other.node + b];
                      column >= 0)
                    pattern.add_entry(
                      row[a], column, -other.part * rho_Q[i][a][b], matrix);
              }
      }
    return of_obstacles;
  }

  LowRank
  Contact::low_rank(const SparseMatrix &matrix) const
  {
    LowRank update;
    update.U = update.W =
      Eigen::MatrixXd::Zero(matrix.n_owned, relaxed ? 0 : obstacles.n_free());
    if (update.rank() == 0)
      return update;
    // Rows of the matrix are sums over ranks, each with the contributions of
    // its cells.
    std::vector<unsigned int> dof_of(matrix.global_index.size());
    for (unsigned int dof = 0; dof < unknowns.free_row.size(); ++dof)
      if (unknowns.free_row[dof] >= 0)
        dof_of[unknowns.free_row[dof]] = dof;
    std::vector<Vector> sums(obstacles.n_free()); // of G' Q (K - rho)
    for (Vector &sum : sums)
      sum.reinit(row_A[0]);
    for (unsigned int i = 0; i < list.size(); ++i)
      if (!list[i].touches_body())
        obstacles.for_free(
          list[i].obstacle,
          [&](const unsigned int k, const unsigned int number) {
            const unsigned int node = list[i].node;
            const Force        G =
              list[i].of_obstacle * RigidMotion::of_point(k, list[i].arm);
            Force GQ = G; // G' Q, Q = 1 - A
            for (unsigned int a = 0; a < dim; ++a)
              for (unsigned int b = 0; b < dim; ++b)
                GQ[b] -= G[a] * row_A[a].local_element(dim * node + b);
            for (unsigned int d = 0; d < dim; ++d)
              if (const int row = unknowns.free_row[dim * node + d]; row >= 0)
                {
                  const int *column = matrix.columns(row);
                  for (int j = matrix.row_start[row];
                       j < matrix.row_start[row + 1];
                       ++j, ++column)
                    sums[number].local_element(dof_of[*column]) +=
                      GQ[d] * matrix.value[j];
                  if (!is_owned(list[i]))
                    continue;
                  sums[number].local_element(dim * node + d) -=
                    nodal_contact[i].rho * GQ[d];
                  update.U(row, number) += rho_Q[i][d] * G;
                }
          });
    for (Vector &sum : sums)
      sum.compress(dealii::VectorOperation::add);
    for (unsigned int o = 0; o < obstacles.n_obstacles(); ++o)
      obstacles.for_free(
        o, [&](const unsigned int k, const unsigned int number) {
          obstacles.for_free(
            o, [&](const unsigned int l, const unsigned int other) {
              for (unsigned int i = 0; i < sums[other].locally_owned_size();
                   ++i)
                if (const int row = unknowns.free_row[i]; row >= 0)
                  update.W(row, number) +=
                    obstacles.mobility(o)(k, l) * sums[other].local_element(i);
            });
        });
    return update;
  }

  void
  Contact::apply_tangent(Vector &dst, const Vector &dv) const
  {
    load_partners(dst);
    // Response of free obstacles.
    std::vector<RigidMotion> change(obstacles.n_obstacles());
    if (obstacles.n_free() > 0 && !relaxed)
      {
        std::vector<double> sums(n_motions * obstacles.n_obstacles(), 0.);
        for (unsigned int i = 0; i < list.size(); ++i)
          if (const ContactNode &node = list[i];
              is_owned(node) && !node.touches_body())
            {
              const Force p =
                rho_Q[i] * (free_part(dst, node.node) / nodal_contact[i].rho -
                            free_part(dv, node.node));
              for (unsigned int k = 0; k < n_motions; ++k)
                sums[n_motions * node.obstacle + k] +=
                  (node.of_obstacle * RigidMotion::of_point(k, node.arm)) * p;
            }
        sum_over_ranks(sums, dst.get_mpi_communicator());
        for (unsigned int o = 0; o < obstacles.n_obstacles(); ++o)
          for (unsigned int k = 0; k < n_motions; ++k)
            for (unsigned int l = 0; l < n_motions; ++l)
              change[o][k] -=
                obstacles.mobility(o)(k, l) * sums[n_motions * o + l];
      }
    for (unsigned int i = 0; i < list.size(); ++i)
      {
        const ContactNode &node = list[i];
        if (!is_owned(node))
          continue;
        const Force dr = free_part(dst, node.node),
                    du = free_part(dv, node.node) -
                         (node.touches_body()
                            ? velocity_of_partners(node, dv)
                            : node.of_obstacle *
                                change[node.obstacle].at(node.arm));
        for (unsigned int a = 0; a < dim; ++a)
          if (unknowns.is_free(dim * node.node + a))
            {
              double sum = rho_Q[i][a] * du;
              if (node.is_second) // A of both is applied
                sum += dr[a];
              else
                for (unsigned int b = 0; b < dim; ++b)
                  if (unknowns.is_free(dim * node.node + b))
                    sum += row_A[a].local_element(dim * node.node + b) * dr[b];
              dst.local_element(dim * node.node + a) = sum;
            }
      }
  }
} // namespace geocone::GEOCONE_DIM
