// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/over_ranks.h>
#include <geocone/mesh/cell_record.h>
#include <geocone/points/history_start.h>
#include <geocone/points/point_elasticity.h>
#include <geocone/points/point_record.h>
#include <geocone/time_stepping/time_stepper.h>

#include <deal.II/base/mpi.h>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  void
  check_axisymmetric_body(const Scene &scene)
  {
    if (!scene.geometry.is_axisymmetric())
      return;
    for (const auto &obstacle : scene.obstacles.list)
      obstacle->check_round();
  }

  std::vector<unsigned int>
  materials_after(const Stage &stage, const Materials &materials)
  {
    const unsigned int        n = materials.size();
    std::vector<unsigned int> becomes(n);
    for (unsigned int i = 0; i < n; ++i)
      {
        becomes[i]       = i;
        const auto found = stage.changed_materials.find(materials.name(i));
        for (unsigned int j = 0; j < n; ++j)
          if (found != stage.changed_materials.end() &&
              materials.name(j) == found->second)
            becomes[i] = j;
      }
    return becomes;
  }

  std::vector<std::string>
  change_materials(const Stage    &stage,
                   const Scene    &scene,
                   const Space    &space,
                   const MPI_Comm  comm,
                   MaterialPoints &points)
  {
    const Materials                &materials = scene.materials;
    const unsigned int              n         = materials.size();
    const std::vector<unsigned int> becomes = materials_after(stage, materials);
    std::vector<unsigned int>       number(n, 0);
    HistoryStart                    start;
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      for (unsigned int p = points.first_point[c];
           p < points.first_point[c + 1];
           ++p)
        {
          const unsigned int from = points.material[p], to = becomes[from];
          if (from == to)
            continue;
          ++number[from];
          const SpatialMandel stress = materials[from].whole_stress(
            points.stress[p], points.history_of(p));
          points.material[p] = to;
          start.set(materials.law(to),
                    stress_of(stress),
                    space.band_width(BackgroundMesh::size_of(points.cells[c])),
                    p < points.displacement.size()
                      ? points.position[p] - points.displacement[p]
                      : points.position[p],
                    points.history_of(p));
          if (!points.mass.empty())
            {
              const double before = scene.density(from, points.position[p]),
                           after  = scene.density(to, points.position[p]);
              points.mass[p] = before > 0. ? points.mass[p] * (after / before)
                                           : points.volume[p] * after;
            }
        }
    start.check<StepFailure>(comm);
    Utilities::MPI::sum(number, comm, number);
    std::vector<std::string> remarks;
    for (unsigned int i = 0; i < n; ++i)
      if (becomes[i] != i)
        {
          if (number[i] == 0)
            throw StepFailure("'Loading/" + stage.name +
                              "/Changed materials': there is no '" +
                              materials.name(i) +
                              "' in the body\n  remedy:  leave it out, or "
                              "change it in an earlier stage");
          remarks.push_back(format("%u points of '", number[i]) +
                            materials.name(i) + "' become '" +
                            materials.name(becomes[i]) + "'");
        }
    start.remark(comm, remarks);
    return remarks;
  }

  double
  elastic_energy(const MaterialPoints &points,
                 const Materials      &materials,
                 const MPI_Comm        comm)
  {
    double sum = 0.;
    for (unsigned int p = 0; p < points.n_points(); ++p)
      sum += points.volume[p] * materials[points.material[p]].elastic_energy(
                                  points.stress[p], points.history_of(p));
    if (materials.traits().undrained)
      for (unsigned int p = 0; p < points.n_points(); ++p)
        sum += points.volume[p] * materials[points.material[p]].fluid_energy(
                                    points.excess_pressure(p));
    return Utilities::MPI::sum(sum, comm);
  }

  void
  save_nodes(Archive              &archive,
             const std::string    &name,
             const BackgroundMesh &mesh,
             const Space          &space,
             const Vector         &values)
  {
    // Written by cell, where the order of nodes does not depend on the ranks.
    Vector all = values;
    all.update_ghost_values();
    CellRecord                                   cells;
    std::vector<double>                          numbers;
    std::vector<dealii::types::global_dof_index> nodes;
    for (const auto &cell : mesh.own_cells())
      {
        space.cell_nodes(cell, nodes);
        cells.add(cell, nodes.size());
        for (const auto node : nodes)
          for (unsigned int d = 0; d < dim; ++d)
            numbers.push_back(
              all.local_element(dim * space.local_node(node) + d));
      }
    archive.write(name + "/cells", cells.numbers);
    archive.write(name + "/values", numbers);
  }

  void
  load_nodes(const Archive        &archive,
             const std::string    &name,
             const BackgroundMesh &mesh,
             const Space          &space,
             Vector               &values)
  {
    const std::vector<double> numbers = archive.read(name + "/values");
    const CellRecord cells(archive.read(name + "/cells"), numbers.size() / dim);
    std::vector<dealii::types::global_dof_index> nodes;
    values = 0.;
    for (const auto &cell : mesh.own_cells())
      {
        space.cell_nodes(cell, nodes);
        const auto [begin, end] = cells.range(cell);
        if (end - begin != nodes.size())
          throw RunError("the checkpoint is of another element");
        for (std::size_t i = 0; i < nodes.size(); ++i)
          for (unsigned int d = 0; d < dim; ++d)
            if (const unsigned int dof = dim * space.local_node(nodes[i]) + d;
                dof < values.locally_owned_size())
              values.local_element(dof) = numbers[dim * (begin + i) + d];
      }
  }

  double
  largest_plastic_strain(const MaterialPoints &points, const MPI_Comm comm)
  {
    double largest = 0.;
    for (const double strain : points.cumulative_plastic_strain)
      largest = std::max(largest, strain);
    return Utilities::MPI::max(largest, comm);
  }

  namespace
  {
    /** Parts of the work of a step (J/m). */
    struct PartsOfWork
    {
      double kinetic = 0., elastic = 0., plastic = 0.;

      double kinetic_energy = 0.; ///< at its end
      double elastic_energy = 0.; ///< maximum of beginning and end
    };

    /** Parts of the work in the last step that a problem solved. Collective. */
    PartsOfWork
    parts_of_work(const IncrementalProblem &problem,
                  const MaterialPoints     &points,
                  const Materials          &materials,
                  const Vector             &velocity_L,
                  const Vector             &v)
    {
      // Kinetic: (v + vL)'M(v - vL)/2 + |v - vL|_M^2/2 = v'M(v - vL), and
      // likewise the elastic energy, which avoids small differences of large
      // numbers.
      PartsOfWork parts;
      if (problem.has_inertia())
        {
          Vector change = v, momentum = problem.make_vector();
          change.update_ghost_values();
          problem.inertia_term().apply_mass(momentum, change);
          parts.kinetic_energy = v * momentum / 2.;
          change -= velocity_L;
          change.update_ghost_values();
          problem.inertia_term().apply_mass(momentum, change);
          parts.kinetic = v * momentum;
        }
      const InternalForces &internal = problem.internal_forces();
      std::array<double, 4> sums     = {};
      for (unsigned int p = 0; p < points.n_points(); ++p)
        {
          const Mandel              &s    = internal.trial_stress()[p];
          const InternalForces::Work work = internal.work(p);
          sums[0] += points.weight[p] * work.elastic;
          sums[1] += points.weight[p] * work.plastic;
          const auto  elasticity = elasticity_at_start(materials, points, p);
          const auto &s_n        = points.stress[p];
          sums[2] += points.weight[p] / 2. * s.dot(elasticity.strain(s));
          sums[3] += points.weight[p] / 2. * s_n.dot(elasticity.strain(s_n));
        }
      sum_over_ranks(sums, v.get_mpi_communicator());
      parts.elastic        = sums[0];
      parts.plastic        = sums[1];
      parts.elastic_energy = std::max(sums[2], sums[3]);
      return parts;
    }
  } // namespace

  double
  energy_identity_error(const IncrementalProblem &problem,
                        const MaterialPoints     &points,
                        const Materials          &materials,
                        const Vector             &velocity_L,
                        const Vector             &v,
                        const double              work)
  {
    const PartsOfWork parts =
      parts_of_work(problem, points, materials, velocity_L, v);
    // In nearly static steps the works are rounding of the energies.
    const double largest = std::max({1e-4 * parts.kinetic_energy,
                                     1e-4 * parts.elastic_energy,
                                     std::abs(parts.kinetic),
                                     std::abs(parts.elastic),
                                     std::abs(parts.plastic),
                                     std::abs(work),
                                     std::numeric_limits<double>::min()});
    return std::abs(parts.kinetic + parts.elastic + parts.plastic - work) /
           largest;
  }

  double
  accelerating_share(const IncrementalProblem &problem,
                     const MaterialPoints     &points,
                     const Materials          &materials,
                     const Vector             &velocity_L,
                     const Vector             &v)
  {
    PartsOfWork parts =
      parts_of_work(problem, points, materials, velocity_L, v);
    if (problem.has_contact())
      {
        const double                   h = problem.time_step();
        const ObstacleMotions::Kinetic of_obstacles =
          problem.contact().motions().kinetic();
        parts.kinetic += h * of_obstacles.work;
        parts.kinetic_energy += h * of_obstacles.energy;
      }
    return share_of_plastic_work(
      parts.kinetic, parts.plastic, parts.kinetic_energy, parts.elastic_energy);
  }

  void
  TimeStepper::begin_from(const Archive  &archive,
                          Kinematics     &kinematics,
                          MaterialPoints &points)
  {
    take_points(archive, points);
    check_places(points, kinematics.velocity.get_mpi_communicator());
    for (auto &velocity : points.velocity)
      velocity = 0.;
    for (auto &affine : points.affine)
      affine = 0.;
    reset(kinematics, points);
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
} // namespace geocone::GEOCONE_DIM
