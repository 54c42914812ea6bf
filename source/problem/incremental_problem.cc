// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/over_ranks.h>
#include <geocone/conditions/vector_at.h>
#include <geocone/problem/incremental_problem.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  IncrementalProblem::IncrementalProblem(
    const MaterialPoints                                     &points,
    const Materials                                          &materials,
    const Unknowns                                           &unknowns,
    const std::shared_ptr<const Utilities::MPI::Partitioner> &layout,
    const Vector                                             *lumped_mass,
    const double                                              consistent_part,
    std::vector<GhostStencil>                                 ghosts,
    const bool                                                has_contact)
    : points(points)
    , materials(materials)
    , unknowns(unknowns)
    , layout(layout)
    , internal(points, materials, unknowns, layout->get_mpi_communicator())
    , ghost(std::move(ghosts), unknowns)
    , terms{&internal, &external}
    , part(layout)
  {
    if (lumped_mass != nullptr)
      terms.push_back(
        &inertia.emplace(points, unknowns, *lumped_mass, consistent_part));
    if (has_contact)
      contact_term.emplace(unknowns);
    // A property of any rank counts for all, since collective calls depend on
    // it.
    std::vector<unsigned int> any = {!points.values.empty(),
                                     !ghost.stencils().empty()};
    Utilities::MPI::max(any, layout->get_mpi_communicator(), any);
    of_particles = any[0] > 0;
    if (any[1] > 0)
      terms.push_back(&ghost);
  }

  void
  IncrementalProblem::begin_step(const double  step,
                                 const Vector *external_force,
                                 const Vector &v,
                                 const Vector &prescribed_velocity,
                                 ContactStep   touching)
  {
    if (contact_term)
      contact_term->begin_step(std::move(touching), prescribed_velocity);
    links_now  = contact_term ? contact_term->links() : Links();
    h          = step;
    velocity_L = v;
    prescribed = prescribed_velocity;
    internal.begin_step(h);
    external.begin_step(external_force);
    if (inertia)
      inertia->begin_step(h, velocity_L);
    ghost.begin_step(h);
    if (pore_pressures != nullptr)
      pore_pressures->begin_step(h);
    elastic_diagonal.reinit(0);
    row_factors = Multipliers::Factors();
  }

  void
  IncrementalProblem::set_prescribed(Vector &v) const
  {
    for (unsigned int i = 0; i < v.locally_owned_size(); ++i)
      if (unknowns.is_prescribed(i))
        v.local_element(i) = prescribed.local_element(i);
  }

  ResidualReport
  IncrementalProblem::residual(Vector         &dst,
                               const Vector   &v,
                               const LocalLaw &law)
  {
    // One reduction for all sums: modes, |R|^2, and the sizes of its parts.
    std::vector<double>    sums(6, 0.);
    constexpr unsigned int square = 3, of_contact = 4, first_size = 6;
    dst = 0.;
    for (Term *term : terms)
      {
        term->residual(part, v, law);
        term->add_sizes(part, sums);
        dst += part;
      }
    if (contact_term)
      {
        contact_term->replace(
          dst, v, scale(), law.contact_friction, law.contact_is_bilateral);
        // Forces required by obstacles on a body at rest are part of the
        // reference.
        const Contact::Sums sums_of_contact = contact_term->sums();
        sums.push_back(sums_of_contact.of_errors + sums_of_contact.of_bodies);
        sums[of_contact]     = sums_of_contact.of_errors;
        sums[of_contact + 1] = sums_of_contact.of_sizes;
      }
    internal.count_modes(sums.data());
    for (unsigned int i = 0; i < dst.locally_owned_size(); ++i)
      if (unknowns.is_free(i))
        sums[square] += dst.local_element(i) * dst.local_element(i);
    sum_over_ranks(sums, layout->get_mpi_communicator());
    if (unknowns.multipliers.n_rows() > 0)
      {
        if (row_factors.U.size() == 0)
          row_factors = unknowns.multipliers.factorise(&scale());
        lambda       = unknowns.multipliers.remove(dst, row_factors);
        sums[square] = free_dot(dst, dst);
      }
    ResidualReport report;
    report.force_norm =
      std::sqrt(*std::max_element(sums.begin() + first_size, sums.end()));
    report.norm         = std::sqrt(sums[square]);
    report.contact_norm = std::sqrt(sums[of_contact]);
    report.contact_size = sums[of_contact + 1];
    report.n_cone       = sums[0];
    report.n_apex       = sums[1];
    report.n_switched   = sums[2];
    report.local_error  = internal.local_error();
    return report;
  }

  const Vector &
  IncrementalProblem::scale()
  {
    if (elastic_diagonal.size() > 0)
      return elastic_diagonal;
    elastic_diagonal.reinit(layout);
    for (const Term *term : terms)
      term->add_elastic_diagonal(elastic_diagonal);
    if (contact_term) // which needs nodes of other ranks
      elastic_diagonal.update_ghost_values();
    return elastic_diagonal;
  }

  double
  IncrementalProblem::merit(const Vector &residual)
  {
    const Vector &D   = scale();
    double        sum = 0.;
    for (unsigned int i = 0; i < residual.locally_owned_size(); ++i)
      if (unknowns.is_free(i))
        sum += residual.local_element(i) * residual.local_element(i) /
               D.local_element(i);
    return Utilities::MPI::sum(sum, layout->get_mpi_communicator());
  }

  StepTraits
  IncrementalProblem::traits() const
  {
    StepTraits step;
    step.law = materials.traits();
    if (contact_term)
      step.contact = contact_term->traits(layout->get_mpi_communicator());
    step.has_inertia        = has_inertia();
    step.has_constraints    = unknowns.multipliers.n_rows() > 0;
    step.has_cell_pressures = internal.has_cell_pressures();
    step.points_move        = of_particles;
    step.scales_loads       = unknowns.multipliers.has_loads();
    return step;
  }

  SparseMatrix
  IncrementalProblem::make_pattern(const bool one_triangle,
                                   const bool shares_columns)
  {
    Assert(!one_triangle || is_symmetric(), ExcInternalError());
    SparseMatrix matrix;
    links = links_now;
    std::vector<std::vector<unsigned int>> groups;
    for (const Term *term : terms)
      for (std::vector<unsigned int> &group : term->node_groups())
        groups.push_back(std::move(group));
    pattern = JacobianPattern(points,
                              unknowns,
                              layout->get_mpi_communicator(),
                              groups,
                              links,
                              one_triangle,
                              shares_columns,
                              matrix);
    return matrix;
  }

  NodalRows
  IncrementalProblem::nodal_rows() const
  {
    NodalRows rows;
    rows.n_components         = dim;
    rows.layout               = layout;
    const unsigned int n_dofs = layout->locally_owned_size();
    for (unsigned int i = 0; i < unknowns.free_row.size(); ++i)
      if (unknowns.is_free(i))
        rows.dof.push_back(layout->local_to_global(i));

    for (const Unknowns::TurnedNode &turned : unknowns.turned_nodes)
      {
        std::array<double, 9> axes{};
        for (unsigned int a = 0; a < dim; ++a)
          for (unsigned int b = 0; b < dim; ++b)
            axes[dim * a + b] = turned.axes[a][b];
        rows.turned.emplace_back(turned.node, axes);
      }
    const auto add = [&](const auto &velocity) {
      std::vector<double> values(n_dofs);
      for (unsigned int i = 0; i < n_dofs; ++i)
        values[i] = velocity(i / dim, i % dim);
      for (const Unknowns::TurnedNode &turned : unknowns.turned_nodes)
        if (dim * turned.node < n_dofs)
          {
            double *at = &values[dim * turned.node];
            put(turned.axes * taken(at), at);
          }
      for (unsigned int i = 0; i < n_dofs; ++i)
        if (!unknowns.is_free(i))
          values[i] = 0.;
      rows.rigid_motions.push_back(std::move(values));
    };
    for (unsigned int d = 0; d < dim; ++d)
      add([&](const unsigned int, const unsigned int component) {
        return component == d ? 1. : 0.;
      });
    if (unknowns.node_positions == nullptr)
      return rows;
    const std::vector<Point<dim>> &places = *unknowns.node_positions;
    Tensor<1, dim>                 sum;
    for (unsigned int node = 0; node < n_dofs / dim; ++node)
      sum += places[node];
    const Point<dim> centre(
      Utilities::MPI::sum(sum, layout->get_mpi_communicator()) /
      (layout->size() / double(dim)));
    for (unsigned int r = 0; r < n_rotations; ++r)
      {
        const auto [a, b] = plane_of_rotation[r];
        add([&, a = a, b = b](const unsigned int node,
                              const unsigned int component) {
          return component == a   ? centre[b] - places[node][b]
                 : component == b ? places[node][a] - centre[a]
                                  : 0.;
        });
      }
    return rows;
  }

  bool
  IncrementalProblem::needs_pattern() const
  {
    return contact_term &&
           Utilities::MPI::max(int(links_now != links),
                               layout->get_mpi_communicator()) > 0;
  }

  LowRank
  IncrementalProblem::linearise(SparseMatrix &matrix, const double blend) const
  {
    std::fill(matrix.value.begin(), matrix.value.end(), 0.);
    for (const Term *term : terms)
      term->linearise(pattern, blend, matrix);
    // Structures do not go with contact, ImplicitFEM::prepare().
    return contact_term      ? contact_term->linearise(pattern, matrix)
           : bars != nullptr ? bars->low_rank(blend)
                             : LowRank();
  }

  void
  IncrementalProblem::apply_tangent(Vector &dst, const Vector &dv) const
  {
    dst = 0.;
    for (const Term *term : terms)
      term->apply_tangent(dst, dv);
    if (contact_term)
      contact_term->apply_tangent(dst, dv);
  }

  double
  IncrementalProblem::free_dot(const Vector &a, const Vector &b) const
  {
    double sum = 0.;
    for (unsigned int i = 0; i < a.locally_owned_size(); ++i)
      if (unknowns.is_free(i))
        sum += a.local_element(i) * b.local_element(i);
    return Utilities::MPI::sum(sum, layout->get_mpi_communicator());
  }
} // namespace geocone::GEOCONE_DIM
