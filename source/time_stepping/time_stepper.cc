// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/time_stepping/time_stepper.h>

#include <deal.II/base/mpi.h>

namespace geocone
{
  using namespace dealii;

  double
  elastic_energy(const MaterialPoints &points,
                 const Materials      &materials,
                 const MPI_Comm        comm)
  {
    double sum = 0.;
    for (unsigned int p = 0; p < points.n_points(); ++p)
      {
        const Mandel &s = points.stress[p];
        sum += points.weight[p] / 2. *
               s.dot(materials[points.material[p]].elasticity().strain(s));
      }
    return Utilities::MPI::sum(sum, comm);
  }

  double
  largest_plastic_strain(const MaterialPoints &points, const MPI_Comm comm)
  {
    double largest = 0.;
    for (const double strain : points.cumulative_plastic_strain)
      largest = std::max(largest, strain);
    return Utilities::MPI::max(largest, comm);
  }

  double
  energy_identity_error(const IncrementalProblem &problem,
                        const MaterialPoints     &points,
                        const Materials          &materials,
                        const Vector             &velocity_L,
                        const Vector             &v,
                        const double              work)
  {
    // Kinetic: (v + vL)'M(v - vL)/2 + |v - vL|_M^2/2 = v'M(v - vL), and alike
    // for the elastic energy: no small differences of large numbers.
    double kinetic = 0., kinetic_energy = 0.;
    if (problem.has_inertia())
      {
        Vector change = v, momentum = problem.make_vector();
        change.update_ghost_values();
        problem.apply_mass(momentum, change);
        kinetic_energy = v * momentum / 2.;
        change -= velocity_L;
        change.update_ghost_values();
        problem.apply_mass(momentum, change);
        kinetic = v * momentum;
      }
    // The elastic and the plastic term, and the elastic energy.
    std::array<double, 3> sums = {};
    for (unsigned int p = 0; p < points.n_points(); ++p)
      {
        const Mandel &s = problem.trial_stress()[p];
        sums[0] += points.weight[p] *
                   s.dot(materials[points.material[p]].elasticity().strain(
                     Mandel(s - points.stress[p])));
        sums[1] +=
          points.weight[p] * s.dot(problem.plastic_strain_increment(p));
        sums[2] += points.weight[p] / 2. *
                   s.dot(materials[points.material[p]].elasticity().strain(s));
      }
    Utilities::MPI::sum(ArrayView<const double>(sums.data(), 3),
                        v.get_mpi_communicator(),
                        ArrayView<double>(sums.data(), 3));
    // Steps in which next to nothing happens are rounding of the energies.
    const double largest = std::max({1e-4 * kinetic_energy,
                                     1e-4 * sums[2],
                                     std::abs(kinetic),
                                     std::abs(sums[0]),
                                     std::abs(sums[1]),
                                     std::abs(work),
                                     std::numeric_limits<double>::min()});
    return std::abs(kinetic + sums[0] + sums[1] - work) / largest;
  }

  void
  TimeStepper::reset(Kinematics &kinematics, MaterialPoints &points) const
  {
    if (kinematics.displacement.size() > 0)
      kinematics.displacement = 0.;
    for (auto &displacement : kinematics.supports)
      displacement = 0.;
    for (auto &displacement : points.displacement)
      displacement = 0.;
    for (Mandel &strain : points.plastic_strain)
      strain.setZero();
    for (double &strain : points.cumulative_plastic_strain)
      strain = 0.;
  }
} // namespace geocone
