// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/points/point_elasticity.h>
#include <geocone/reduced/reduction.h>

#include <deal.II/base/mpi.h>

namespace geocone::GEOCONE_DIM
{
  using Eigen::MatrixXd;
  using Eigen::VectorXd;

  void
  Reduction::check(const IncrementalProblem &problem,
                   const std::string        &parameter,
                   const std::string        &value,
                   const bool                projected)
  {
    const MaterialPoints &points    = problem.points;
    const Materials      &materials = problem.materials;
    const MPI_Comm        comm      = problem.layout->get_mpi_communicator();
    const auto            refuse    = [&](const std::string &allowed,
                            const std::string &remedy) {
      throw InputError(parameter, value, allowed, remedy);
    };
    if (dim == 3)
      refuse("another one where Geometry/Dimension = 3",
             "it solves for the stresses of plane cones: take automatic");
    if (dealii::Utilities::MPI::n_mpi_processes(comm) > 1)
      refuse("another one on several ranks",
             "run it on one rank, or take automatic");
    if (problem.has_contact())
      refuse("another one with obstacles",
             "hold the body by 'Boundary conditions', or take automatic");
    if (problem.has_bars())
      refuse("another one with structures",
             "leave out 'Structures/Names', or take automatic");
    if (!problem.inertia)
      refuse("another one without inertia",
             "the stresses alone determine the velocities by the mass: set "
             "Time stepping/Inertia = true, or take automatic");
    if (materials.traits().undrained)
      refuse("another one with undrained soil",
             "it solves for effective stresses alone: take automatic");
    if (problem.inertia->consistent_part() > 0.)
      refuse("another one with a consistent mass",
             "set Material point method/Consistent mass part = 0, or take "
             "automatic");
    if (!problem.ghost.stencils().empty())
      refuse(
        "another one with ghost stiffness",
        "set Material point method/Ghost stiffness = 0, or take automatic");
    if (projected && problem.unknowns.multipliers.n_rows() > 0 &&
        points.n_points() > most_projected)
      refuse(format("another one for more than %u points with constraints on "
                    "particles, and there are %u",
                    most_projected,
                    points.n_points()),
             "take 'reduced with multipliers', whose iterates are the same");
    for (const unsigned int material : points.material)
      if (materials[material].has_history())
        refuse("another one with the material '" + materials.name(material) +
                 "', whose strength has a history",
               "take a perfectly plastic law, or automatic");
      else if (const auto cone = materials[material].flow_cone(nullptr);
               !cone || cone->is_cut())
        refuse("another one with the material '" + materials.name(material) +
                 (cone ? "', whose cone is cut off by its tensile strength"
                       : "', which has no yield surface"),
               "take Mohr-Coulomb or Tresca, or automatic");
  }

  Reduction::Reduction(const IncrementalProblem &problem)
    : incremental(problem)
  {
    // At the start, when check() is called, there may be none.
    if (!problem.ghost.stencils().empty())
      throw StepFailure(
        "the formulation has no ghost stiffness, which functions "
        "with hardly any material have now\n  remedy:  set "
        "Material point method/Ghost stiffness = 0, or "
        "Newton/Formulation = automatic");
    const MaterialPoints &points    = problem.points;
    const Materials      &materials = problem.materials;
    const Unknowns       &unknowns  = problem.unknowns;
    const double          h         = problem.h;
    const unsigned int    n         = points.n_points();
    for (unsigned int p = 0; p < n; ++p)
      reduced.cones.push_back(
        *materials[points.material[p]].flow_cone(nullptr));

    velocity = problem.velocity_L;
    problem.set_prescribed(velocity);
    reduced.m.resize(unknowns.n_rows);
    for (unsigned int i = 0; i < velocity.locally_owned_size(); ++i)
      if (unknowns.is_free(i))
        {
          const double inverse =
            h / problem.inertia->lumped_mass().local_element(i);
          reduced.m[unknowns.free_row[i]] = h * inverse;
          if (const Vector *force = problem.external.vector())
            velocity.local_element(i) += inverse * force->local_element(i);
        }

    // G = V B in cone axes, S the diagonal V S, and V B v*.
    std::vector<Eigen::Triplet<double>> entries;
    VectorXd strain_rate = VectorXd::Zero(n_mandel * n);
    problem.internal.for_each_strain_column([&](const unsigned int p,
                                                const unsigned int dof,
                                                const Mandel      &column) {
      const Mandel x = points.weight[p] * to_cone_axes(column);
      strain_rate.segment<n_mandel>(n_mandel * p) +=
        velocity.local_element(dof) * x;
      if (unknowns.is_free(dof))
        for (int i = 0; i < n_mandel; ++i)
          entries.emplace_back(n_mandel * p + i, unknowns.free_row[dof], x[i]);
    });
    reduced.G.resize(n_mandel * n, unknowns.n_rows);
    reduced.G.setFromTriplets(entries.begin(), entries.end());
    reduced.S.resize(n_mandel * n);
    for (unsigned int p = 0; p < n; ++p)
      {
        const Elasticity e = elasticity_at_start(materials, points, p);
        reduced.S.segment<n_mandel>(n_mandel * p) =
          Mandel::Constant(points.weight[p] / e.two_G);
        reduced.S[n_mandel * p] = points.weight[p] / e.normal_stiffness();
      }
    reduced.q = -reduced.S.cwiseProduct(stress_at_start()) - h * strain_rate;

    const Multipliers &rows = unknowns.multipliers;
    MatrixXd           H    = MatrixXd::Zero(rows.n_rows(), unknowns.n_rows);
    for (unsigned int j = 0; j < rows.dofs().size(); ++j)
      H.col(unknowns.free_row[rows.dofs()[j]]) = rows.coefficients().col(j);
    const MatrixXd weighted = reduced.m.asDiagonal() * H.transpose();
    reduced.C               = reduced.G * weighted;
    reduced.L               = H * weighted;
    reduced.H               = H.sparseView();
    reduced.d               = -h * rows.defect(velocity);
  }

  VectorXd
  Reduction::stress_at_start() const
  {
    const std::vector<Mandel> &stress = incremental.points.stress;
    VectorXd                   s(n_mandel * stress.size());
    for (unsigned int p = 0; p < stress.size(); ++p)
      s.segment<n_mandel>(n_mandel * p) = to_cone_axes(stress[p]);
    return s;
  }

  void
  Reduction::recover_velocity(const VectorXd &s, Vector &v) const
  {
    VectorXd change = -reduced.nodal(s) / incremental.h;
    if (reduced.n_multipliers() > 0)
      change +=
        reduced.m.cwiseProduct(reduced.H.transpose() * reduced.multipliers(s)) /
        incremental.h;
    const Unknowns &unknowns = incremental.unknowns;
    for (unsigned int i = 0; i < v.locally_owned_size(); ++i)
      v.local_element(i) =
        velocity.local_element(i) +
        (unknowns.is_free(i) ? change[unknowns.free_row[i]] : 0.);
  }
} // namespace geocone::GEOCONE_DIM
