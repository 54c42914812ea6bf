// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/over_ranks.h>
#include <geocone/newton/contact_direction.h>

#include <geocone/contact/condensed_contact.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace geocone::GEOCONE_DIM
{
  using dealii::Tensor;
  using Eigen::MatrixXd;
  using Eigen::VectorXd;

  ContactDirection::ContactDirection(const StepWorkspace &work)
    : work(work)
    , contact(work.problem.contact())
    , is_chosen(contact.nodes().size(), false)
  {
    const std::vector<unsigned int> chosen =
      contact.choose(work.v.get_mpi_communicator());
    add(chosen, true);
    if (n_components > most_components)
      n_components = 0;
    if (is_used())
      work.problem.contact().relax(chosen);
  }

  void
  ContactDirection::add(const std::vector<unsigned int> &chosen,
                        const bool                       relaxed)
  {
    const std::size_t before = own.size();
    for (const unsigned int i : chosen)
      {
        const ContactNode &node = contact.nodes()[i];
        is_chosen[i]            = true;
        own.push_back({i, node.normal, true, 0, relaxed});
        for (unsigned int t = 0; t < node.n_tangents; ++t)
          own.push_back({i, node.tangents[t], false, 0, relaxed});
      }
    const MPI_Comm comm  = work.v.get_mpi_communicator();
    const auto     sizes = dealii::Utilities::MPI::all_gather(
      comm, static_cast<unsigned int>(own.size() - before));
    const unsigned int rank  = dealii::Utilities::MPI::this_mpi_process(comm);
    unsigned int       first = n_components;
    for (unsigned int r = 0; r < sizes.size(); ++r)
      {
        if (r < rank)
          first += sizes[r];
        n_components += sizes[r];
      }
    for (std::size_t k = before; k < own.size(); ++k)
      own[k].number = first + k - before;
  }

  Tensor<1, dim>
  ContactDirection::relative_change(const ContactNode &node,
                                    const Vector      &direction) const
  {
    Tensor<1, dim> change;
    for (unsigned int d = 0; d < dim; ++d)
      {
        change[d] = direction.local_element(dim * node.node + d);
        for (const ContactNode::Partner &other : node.partners)
          change[d] -=
            other.part * direction.local_element(dim * other.node + d);
      }
    return change;
  }

  VectorXd
  ContactDirection::relative_change(Vector &direction) const
  {
    VectorXd du = VectorXd::Zero(n_components);
    direction.update_ghost_values();
    for (const Component &at : own)
      du[at.number] =
        relative_change(contact.nodes()[at.node], direction) * at.axis;
    direction.zero_out_ghost_values();
    return du;
  }

  std::vector<unsigned int>
  ContactDirection::penetrating_nodes(Vector &direction) const
  {
    std::vector<unsigned int> found;
    direction.update_ghost_values();
    for (unsigned int i = 0; i < contact.nodes().size(); ++i)
      if (const ContactNode &node = contact.nodes()[i];
          contact.is_owned(node) && !is_chosen[i] && !node.is_corner)
        {
          const double w = (contact.nodal_contacts()[i].relative +
                            relative_change(node, direction)) *
                             node.normal -
                           node.least;
          if (w < 0.)
            found.push_back(i);
        }
    direction.zero_out_ghost_values();
    return found;
  }

  MatrixXd
  ContactDirection::compliance() const
  {
    dealii::TimerOutput::Scope scope(work.timer, "solve");
    constexpr unsigned int     batch    = 32;
    const Unknowns            &unknowns = work.problem.free_dofs();
    const std::size_t          n        = work.system.n_owned_rows();
    MatrixXd                   S = MatrixXd::Zero(n_components, n_components);
    Vector                     direction = work.problem.make_vector();
    for (unsigned int begin = 0; begin < n_components; begin += batch)
      {
        const unsigned int  m = std::min(batch, n_components - begin);
        std::vector<double> columns(n * m, 0.);
        for (const Component &at : own)
          if (at.number >= begin && at.number < begin + m)
            for (unsigned int d = 0; d < dim; ++d)
              if (const int row =
                    unknowns.free_row[dim * contact.nodes()[at.node].node + d];
                  row >= 0)
                columns[n * (at.number - begin) + row] = at.axis[d];
        work.system.solve_columns(columns, m);
        for (unsigned int j = 0; j < m; ++j)
          {
            for (unsigned int i = 0; i < direction.locally_owned_size(); ++i)
              direction.local_element(i) =
                unknowns.is_free(i) ? columns[n * j + unknowns.free_row[i]]
                                    : 0.;
            S.col(begin + j) = relative_change(direction);
          }
      }
    sum_over_ranks(S, work.v.get_mpi_communicator());
    return S;
  }

  void
  ContactDirection::solve_with(const VectorXd        &force,
                               const Vector          *prescribed,
                               const Eigen::VectorXd &defect,
                               Vector                &direction) const
  {
    const Vector kept = work.residual;
    for (const Component &at : own)
      for (unsigned int d = 0; d < dim; ++d)
        work.residual.local_element(dim * contact.nodes()[at.node].node + d) =
          0.;
    for (const Component &at : own)
      {
        const double r =
          contact.nodal_contacts()[at.node].force * at.axis - force[at.number];
        for (unsigned int d = 0; d < dim; ++d)
          work.residual.local_element(dim * contact.nodes()[at.node].node +
                                      d) += r * at.axis[d];
      }
    work.solve(prescribed, defect, direction);
    --work.report.iterations; // all with the same factors
    work.residual = kept;
  }

  ContactDirection::End
  ContactDirection::end(const VectorXd &without) const
  {
    // Data of all ranks by component: position, stiffness in the Jacobian,
    // laws, and motion by free obstacles.
    constexpr unsigned int n_data = 7;
    const unsigned int     n_free = contact.motions().n_free();
    MatrixXd               data = MatrixXd::Zero(n_components, n_data + n_free);
    for (const Component &component : own)
      {
        const ContactNode           &node = contact.nodes()[component.node];
        const Contact::NodalContact &at =
          contact.nodal_contacts()[component.node];
        auto row = data.row(component.number);
        row[0]   = at.relative * component.axis;
        row[1]   = component.is_relaxed ? at.rho : 0.;
        row[2]   = component.is_normal ? 1. : 0.;
        row[3]   = node.least;
        row[4]   = node.friction;
        row[5]   = node.adhesion;
        row[6]   = node.tension;
        contact.for_motions_of(
          node, [&](const unsigned int number, const Tensor<1, dim> &G) {
            row[n_data + number] = G * component.axis;
          });
      }
    sum_over_ranks(data, work.v.get_mpi_communicator());

    CondensedContact problem;
    for (unsigned int k = 0; k < n_components; ++k)
      if (data(k, 2) > 0.)
        {
          unsigned int n_tangents = 0;
          while (k + n_tangents + 1 < n_components &&
                 data(k + n_tangents + 1, 2) == 0.)
            ++n_tangents;
          problem.nodes.push_back(
            {k, n_tangents, data(k, 3), data(k, 4), data(k, 5), data(k, 6)});
        }
    // r = K dv + c, with dv of the body; then the motions dy of obstacles are
    // eliminated, du = dv - G dy.
    const MatrixXd stiffness = compliance().inverse();
    MatrixXd       K         = stiffness;
    K.diagonal() -= data.col(1);
    const VectorXd c = -stiffness * without, u0 = data.col(0);
    const MatrixXd G = data.rightCols(n_free), KG = K * G;
    VectorXd       inertia, lack;
    contact.motions().balance(inertia, lack);
    MatrixXd Z = G.transpose() * KG;
    Z.diagonal() += inertia;
    const Eigen::PartialPivLU<MatrixXd> factors(
      n_free > 0 ? Z : MatrixXd::Identity(1, 1));
    const auto motion_for = [&](const VectorXd &du) -> VectorXd {
      return -factors.solve(VectorXd(lack + G.transpose() * (K * du + c)));
    };
    problem.K = K;
    problem.c = c - K * u0;
    if (n_free > 0)
      {
        problem.K -= KG * factors.solve(MatrixXd(G.transpose() * K));
        problem.c =
          c + KG * motion_for(VectorXd::Zero(n_components)) - problem.K * u0;
      }
    VectorXd u = u0;
    problem.solve(u);
    VectorXd dv = u - u0, motion;
    if (n_free > 0)
      {
        motion = motion_for(dv);
        dv += G * motion;
      }
    return {stiffness * (dv - without), motion};
  }

  void
  ContactDirection::solve(const Vector          *prescribed,
                          const Eigen::VectorXd &defect,
                          Vector                &direction)
  {
    const MPI_Comm comm = work.v.get_mpi_communicator();
    // Nodes that are added later are free here.
    solve_with(VectorXd::Zero(n_components), prescribed, defect, direction);
    Vector unforced = direction;
    for (unsigned int round = 0; round < 10; ++round)
      {
        VectorXd without = relative_change(unforced);
        sum_over_ranks(without, comm);
        const auto [force, motion] = end(without);
        solve_with(force, prescribed, defect, direction);
        // The Jacobian contains sigma du at these nodes, so the force is less
        // by this.
        const VectorXd du = relative_change(direction);
        end_force.assign(contact.nodes().size(), Tensor<1, dim>());
        for (const Component &at : own)
          end_force[at.node] +=
            (force[at.number] -
             (at.is_relaxed ? contact.nodal_contacts()[at.node].rho : 0.) *
               du[at.number]) *
            at.axis;
        const std::vector<unsigned int> more = penetrating_nodes(direction);
        if (dealii::Utilities::MPI::sum(dim * more.size(), comm) == 0 ||
            dealii::Utilities::MPI::sum(dim * more.size(), comm) +
                n_components >
              most_components)
          {
            if (motion.size() > 0)
              work.problem.contact().change_motions(motion);
            break;
          }
        add(more, false);
      }
    ++work.report.iterations;
  }

  double
  ContactDirection::slope(const Vector &direction) const
  {
    direction.update_ghost_values();
    double sum = 0.;
    for (unsigned int i = 0; i < contact.nodes().size(); ++i)
      if (const ContactNode &node = contact.nodes()[i]; contact.is_owned(node))
        {
          // In a corner the laws are linear in the direction, without its
          // forces.
          if (!node.is_corner)
            sum += (contact.nodal_contacts()[i].force - end_force[i]) *
                   relative_change(node, direction);
          else if (node.is_second)
            continue;
          for (unsigned int d = 0; d < dim; ++d)
            if (const unsigned int dof = dim * node.node + d;
                work.problem.free_dofs().is_free(dof))
              sum -=
                work.residual.local_element(dof) * direction.local_element(dof);
        }
    direction.zero_out_ghost_values();
    return work.problem.free_dot(work.residual, direction) +
           dealii::Utilities::MPI::sum(sum, work.v.get_mpi_communicator());
  }
} // namespace geocone::GEOCONE_DIM
