// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/shakedown/elastic_stresses.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace geocone::GEOCONE_DIM
{
  using Eigen::Matrix3d;
  using Eigen::Vector3d;
  using Eigen::VectorXd;

  namespace
  {
    /** Largest number of dofs of a triangle. */
    constexpr unsigned int columns_upper = 12, columns_lower = 14;

    /** Integrals of products of linear functions over a triangle, relative to a third of
     *  its area. */
    Matrix3d
    mass()
    {
      return (Matrix3d::Identity() + Matrix3d::Ones()) / 4.;
    }

    /** Coupling of the points of a triangle in its stiffness V sum_ij G_ij B_i' D B_j:
     *  the masses of strains, or their inverse for stresses that are unknowns. */
    Matrix3d
    coupling(const BoundSide side)
    {
      return side == BoundSide::upper
               ? mass()
               : Matrix3d(4. * Matrix3d::Identity() - Matrix3d::Ones());
    }

    /** The dofs of a triangle, each once, without those of zero columns; the first one
     *  fills the rest. */
    std::vector<unsigned int>
    dofs_of_cells(const BoundProblem &problem, const unsigned int n_columns)
    {
      std::vector<unsigned int> all;
      problem.B.with_n_columns([&](const auto size) {
        constexpr int n = decltype(size)::value;
        for (unsigned int c = 0; c < problem.n_triangles; ++c)
          {
            const std::size_t first = all.size();
            for (unsigned int p = 3 * c; p < 3 * c + 3; ++p)
              for (int j = 0; j < n; ++j)
                if (const unsigned int dof = problem.B.dofs_of(p)[j];
                    std::find(all.begin() + first, all.end(), dof) == all.end())
                  all.push_back(dof);
            AssertThrow(all.size() <= first + n_columns,
                        dealii::ExcInternalError());
            all.resize(first + n_columns, all[first]);
          }
      });
      return all;
    }

    /** Adds the stiffness of all triangles. */
    template <int n_columns>
    void
    add_cells(const BoundProblem              &problem,
              const std::vector<unsigned int> &dofs,
              const std::vector<Vector3d>     &stiffness,
              const Matrix3d                  &G,
              BlockMatrix                     &matrix)
    {
      using Strains = Eigen::Matrix<double, 3, n_columns>;
      problem.B.with_n_columns([&](const auto size) {
        constexpr int n = decltype(size)::value;
        for (unsigned int c = 0; c < problem.n_triangles; ++c)
          {
            const auto             own = dofs.begin() + n_columns * c;
            std::array<Strains, 3> B;
            for (unsigned int i = 0; i < 3; ++i)
              {
                const unsigned int p = 3 * c + i;
                B[i].setZero();
                for (int j = 0; j < n; ++j)
                  B[i].col(
                    std::find(own, own + n_columns, problem.B.dofs_of(p)[j]) -
                    own) += problem.B.template matrix<n>(p).col(j);
              }
            Eigen::Matrix<double, n_columns, n_columns> block;
            block.setZero();
            for (unsigned int i = 0; i < 3; ++i)
              for (unsigned int j = 0; j < 3; ++j)
                block += problem.volume[3 * c] * G(i, j) * B[i].transpose() *
                         stiffness[c].asDiagonal() * B[j];
            matrix.add<n_columns>(0, c, block);
          }
      });
    }

    /** Averages a field at the vertices over the triangles of a material, by their areas.
     *  Errors of derivatives alternate between triangles; the mean is more accurate. */
    LinearField
    averaged(const Triangles &triangles, const LinearField &field)
    {
      std::map<std::array<unsigned int, 2>, std::pair<double, Vector3d>> sums;
      const auto sum_at = [&](const unsigned int p) -> auto &
      {
        return sums
          .try_emplace(
            {{triangles.cells[p / 3][p % 3], triangles.material[p / 3]}},
            0.,
            Vector3d::Zero())
          .first->second;
      };
      for (unsigned int p = 0; p < field.size(); ++p)
        {
          const double area = triangles.area(p / 3);
          auto        &sum  = sum_at(p);
          sum.first += area;
          sum.second += area * field[p];
        }
      LinearField mean(field.size());
      for (unsigned int p = 0; p < field.size(); ++p)
        mean[p] = sum_at(p).second / sum_at(p).first;
      return mean;
    }

    /** Sums over the points of a triangle with weights. */
    LinearField
    combined(const LinearField &field, const Matrix3d &G)
    {
      LinearField sums(field.size(), Vector3d::Zero());
      for (unsigned int p = 0; p < field.size(); ++p)
        for (unsigned int j = 0; j < 3; ++j)
          sums[p] += G(p % 3, j) * field[p - p % 3 + j];
      return sums;
    }
  } // namespace

  void
  add(LinearField &to, const double factor, const LinearField &field)
  {
    for (unsigned int p = 0; p < to.size(); ++p)
      to[p] += factor * field[p];
  }

  LinearField
  difference(const LinearField &a, const LinearField &b)
  {
    LinearField all(a);
    add(all, -1., b);
    return all;
  }

  LinearField
  mean_of_both(const ElasticStresses &stresses)
  {
    LinearField s(stresses.compatible);
    for (unsigned int p = 0; p < s.size(); ++p)
      s[p] = (s[p] + stresses.equilibrated[p]) / 2.;
    return s;
  }

  ElasticSolver::ElasticSolver(const BoundScene   &bound,
                               const BoundProblem &problem,
                               const BoundSide     side)
    : problem(problem)
    , side(side)
    , n_columns(side == BoundSide::upper ? columns_upper : columns_lower)
    , dofs(dofs_of_cells(problem, n_columns))
    , matrix(problem.is_prescribed,
             {{n_columns, problem.n_triangles, dofs.data()}})
  {
    for (const unsigned int m : bound.triangles.material)
      {
        const Elasticity &elastic = bound.scene.materials[m].elasticity();
        stiffness.push_back(
          Vector3d(elastic.normal_stiffness(), elastic.two_G, elastic.two_G) /
          bound.units.stress);
      }
    matrix.clear();
    const Matrix3d G = coupling(side);
    if (side == BoundSide::upper)
      add_cells<columns_upper>(problem, dofs, stiffness, G, matrix);
    else
      add_cells<columns_lower>(problem, dofs, stiffness, G, matrix);
    if (!matrix.factorise())
      throw StepFailure("the elastic stiffness of the mesh is singular\n  "
                        "remedy:  check the supports, or take other cells");
  }

  LinearField
  ElasticSolver::conjugate_stresses(const LinearField &strains) const
  {
    return stresses_of(combined(strains, coupling(side)));
  }

  LinearField
  ElasticSolver::stresses_of(LinearField strains) const
  {
    for (unsigned int p = 0; p < strains.size(); ++p)
      strains[p].array() *= stiffness[p / 3].array();
    return strains;
  }

  VectorXd
  ElasticSolver::displacements(const VectorXd &load) const
  {
    VectorXd q = VectorXd::Zero(problem.n_dofs());
    for (unsigned int i = 0; i < 3; ++i)
      {
        VectorXd r =
          load - problem.B.forces(problem.volume,
                                  conjugate_stresses(problem.B.rates(q)),
                                  problem.n_dofs());
        for (unsigned int dof = 0; dof < problem.n_dofs(); ++dof)
          if (problem.is_prescribed[dof])
            r[dof] = 0.;
        q += matrix.solve(r);
      }
    return q;
  }

  LinearField
  ElasticSolver::stresses(const VectorXd &load) const
  {
    const VectorXd q = displacements(load);
    LinearField    s = conjugate_stresses(problem.B.rates(q));
    VectorXd r = load - problem.B.forces(problem.volume, s, problem.n_dofs());
    double   missed = 0., largest = std::numeric_limits<double>::min();
    for (unsigned int dof = 0; dof < problem.n_dofs(); ++dof)
      if (!problem.is_prescribed[dof])
        {
          missed  = std::max(missed, std::abs(r[dof]));
          largest = std::max(largest, std::abs(load[dof]));
        }
    if (!(missed < 1e-7 * largest))
      throw StepFailure(
        format("the elastic stresses miss equilibrium by %.1e of the largest "
               "force\n  remedy:  check the loads: a shear traction that does "
               "not vanish at a corner beside a free side has no stresses "
               "in equilibrium",
               missed / largest));
    return side == BoundSide::upper ? stresses_of(problem.B.rates(q)) : s;
  }

  LinearField
  ElasticSolver::compatible_part(const LinearField &strains) const
  {
    return problem.B.rates(displacements(problem.B.forces(
      problem.volume, conjugate_stresses(strains), problem.n_dofs())));
  }

  double
  ElasticSolver::work(const LinearField &stresses,
                      const LinearField &strains) const
  {
    const LinearField weighted = combined(strains, mass());
    double            sum      = 0.;
    for (unsigned int p = 0; p < stresses.size(); ++p)
      sum += problem.volume[p] * stresses[p].dot(weighted[p]);
    return sum;
  }

  double
  ElasticSolver::product_of_strains(const LinearField &a,
                                    const LinearField &b) const
  {
    return work(stresses_of(a), b);
  }

  double
  ElasticSolver::product_of_stresses(const LinearField &a,
                                     const LinearField &b) const
  {
    LinearField strains(b);
    for (unsigned int p = 0; p < b.size(); ++p)
      strains[p].array() /= stiffness[p / 3].array();
    return work(a, strains);
  }

  std::vector<double>
  ElasticSolver::energies(const LinearField &stresses) const
  {
    const LinearField   weighted = combined(stresses, mass());
    std::vector<double> energy(problem.n_triangles, 0.);
    for (unsigned int p = 0; p < stresses.size(); ++p)
      energy[p / 3] +=
        problem.volume[p] *
        stresses[p].dot(weighted[p].cwiseQuotient(stiffness[p / 3]));
    return energy;
  }

  std::vector<ElasticStresses>
  elastic_stresses(const Triangles             &triangles,
                   const ElasticSolver         &upper,
                   const ElasticSolver         &lower,
                   const std::vector<VectorXd> &upper_forces,
                   const std::vector<VectorXd> &lower_forces)
  {
    std::vector<ElasticStresses> all(upper_forces.size());
    for (unsigned int i = 0; i < all.size(); ++i)
      {
        all[i].compatible   = upper.stresses(upper_forces[i]);
        all[i].equilibrated = lower.stresses(lower_forces[i]);
        all[i].averaged     = averaged(triangles, all[i].compatible);
      }
    return all;
  }
} // namespace geocone::GEOCONE_DIM
