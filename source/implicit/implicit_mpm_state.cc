// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Update of the particles of the implicit material point method after a solved
// step, with energies and works.
#include <geocone/base/log.h>
#include <geocone/base/over_ranks.h>
#include <geocone/implicit/implicit_mpm.h>

#include <deal.II/base/mpi.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** Mandel vector rotated by angles about z, x, y: Q t Q'. */
    Mandel
    turn(const Mandel &t, const Tensor<1, n_rotations> &angle)
    {
      if constexpr (dim == 2)
        {
          const double c = std::cos(2. * angle[0]), s = std::sin(2. * angle[0]);
          const double mean = (t[0] + t[1]) / 2., half = (t[0] - t[1]) / 2.,
                       shear = t[2] / sqrt2;
          const double h     = c * half - s * shear;
          return in_plane(mean + h, mean - h, s * half + c * shear);
        }
      else
        {
          const double size = angle.norm();
          if (size == 0.)
            return t;
          const Eigen::Vector3d axis =
            Eigen::Vector3d(angle[1], angle[2], angle[0]) / size;
          const Eigen::Matrix3d Q =
            Eigen::AngleAxisd(size, axis).toRotationMatrix();
          return spatial_mandel(Q * spatial_tensor(extended(t, 0.)) *
                                Q.transpose());
        }
    }
  } // namespace

  Energies
  ImplicitMPM::state_energies(const Kinematics &,
                              const MaterialPoints &points,
                              const double          t) const
  {
    const Tensor<1, dim> g = scene->gravity.at(t);
    Energies             e;
    for (unsigned int p = 0; p < points.n_points(); ++p)
      {
        e.kinetic += points.mass[p] * points.velocity[p].norm_square() / 2.;
        e.potential -= points.mass[p] * (g * (points.position[p] - datum));
      }
    if (rule.is_affine())
      for_each_point(points,
                     [&](const unsigned int p,
                         const unsigned int /* cell */,
                         const PointFunctions &at) {
                       const Tensor<2, dim> &C = points.affine[p];
                       e.kinetic +=
                         points.mass[p] / 2. *
                         scalar_product(C,
                                        C * at.moment(points.position[p],
                                                      space->node_positions()));
                     });
    const MPI_Comm comm = force.get_mpi_communicator();
    e.kinetic           = Utilities::MPI::sum(e.kinetic, comm);
    e.potential         = Utilities::MPI::sum(e.potential, comm);
    e.elastic           = elastic_energy(points, scene->materials, comm);
    return e;
  }

  std::string
  ImplicitMPM::rejection_of_move(const MaterialPoints          &points,
                                 const unsigned int             p,
                                 const double                   ratio,
                                 const Tensor<1, dim>          &move,
                                 const std::array<double, dim> &extent) const
  {
    const Moved &next = trial.moved[p];
    std::string  obstacle;
    if (!std::isfinite(next.position.square()) ||
        !std::isfinite(next.velocity.norm_square()))
      obstacle =
        format("the velocity of particle %u is not a number", points.id[p]);
    else if (!(ratio > 0.05))
      obstacle = format("the volume of particle %u at (%s) would collapse "
                        "to %.2g of itself",
                        points.id[p],
                        text_of_place(points.position[p]).c_str(),
                        ratio);
    for (unsigned int d = 0; d < dim; ++d)
      if (std::abs(move[d]) > largest_move * extent[d])
        obstacle =
          format("particle %u at (%s) would cross %.1f cells, more than "
                 "'Material point method/Largest move'",
                 points.id[p],
                 text_of_place(points.position[p]).c_str(),
                 std::abs(move[d]) / extent[d]);
    return obstacle;
  }

  std::string
  ImplicitMPM::transfer(const MaterialPoints &points,
                        const Vector         &v,
                        const Vector         &v_mean,
                        const double          h)
  {
    trial.moved.resize(points.n_points());
    const double flip_part = rule.flip_part();
    Vector       change    = v;
    change -= velocity_L;
    for (const Vector *vector : {&v, &v_mean, &std::as_const(change)})
      vector->update_ghost_values();
    std::string obstacle;
    for_each_point(
      points,
      [&](
        const unsigned int p, const unsigned int c, const PointFunctions &at) {
        const auto              box = points.cells[c]->bounding_box();
        std::array<double, dim> extent;
        for (unsigned int d = 0; d < dim; ++d)
          extent[d] = box.side_length(d);
        double end[dim], gained[dim], mean[(1 + dim) * dim];
        at.gather<dim, false>(v.begin(), end);
        at.gather<dim, false>(change.begin(), gained);
        at.gather<dim, true>(v_mean.begin(), mean);
        Tensor<2, dim> gradient; // d_d v_c of the mean velocity
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int d = 0; d < dim; ++d)
            gradient[i][d] = mean[dim * (1 + d) + i];

        Moved &next = trial.moved[p];
        if (rule.is_affine())
          next.affine = at.gather_affine<dim>(
            v.begin(),
            points.position[p],
            space->node_positions(),
            *std::min_element(extent.begin(), extent.end()));
        // Individually prescribed particles move with the grid and stay in
        // their row: otherwise their rows would also prescribe a gradient.
        const BoundaryCondition *holder = condition_of_particle(points, p);
        Tensor<1, dim>           move;
        for (unsigned int d = 0; d < dim; ++d)
          {
            next.velocity[d] = flip_part * (points.velocity[p][d] + gained[d]) +
                               (1. - flip_part) * end[d];
            const bool follows_grid =
              advection != Advection::particle_velocity ||
              (holder != nullptr && holder->components[d] &&
               !holder->imposition.get()->through_flip);
            next.displacement[d] =
              h * (follows_grid ? mean[d] : next.velocity[d]);
          }
        if (advection == Advection::none ||
            scene->regions.are_fixed(points.material[p]))
          gradient = 0.;
        else
          move = next.displacement;
        next.position          = points.position[p] + move;
        Tensor<2, dim> stretch = h * gradient;
        for (unsigned int d = 0; d < dim; ++d)
          stretch[d][d] += 1.;
        const double ratio =
          determinant(stretch) * (mesh->is_axisymmetric()
                                    ? next.position[0] / points.position[p][0]
                                    : 1.);
        next.volume = ratio * points.volume[p];
        for (unsigned int k = 0; k < n_rotations; ++k)
          {
            const auto [a, b] = plane_of_rotation[k];
            next.spin[k]      = h * (gradient[b][a] - gradient[a][b]) / 2.;
          }

        if (const std::string why =
              rejection_of_move(points, p, ratio, move, extent);
            !why.empty())
          obstacle = why;
      });
    return text_of_any_rank(v.get_mpi_communicator(), obstacle);
  }

  std::string
  ImplicitMPM::rejection(const Multipliers::LowMassShare &share) const
  {
    // Sound steps have up to 0.02, spurious velocities 1.6 and more.
    if (!(share.largest > 0.3))
      return "";
    const BoundaryCondition &condition =
      *scene->dirichlet.list[share.condition];
    return format(
      "%.0f %% of the velocity that '%s' prescribes is that of "
      "functions with next to no mass, near (%g, %g): the load would "
      "rest on a jet of a few particles; set 'Material point "
      "method/Ghost stiffness' to 1e-5, or take more segments",
      100. * share.largest,
      condition.name.c_str(),
      share.place[0],
      share.place[1]);
  }

  const BoundaryCondition *
  ImplicitMPM::condition_of_particle(const MaterialPoints &points,
                                     const unsigned int    p) const
  {
    const unsigned int held = points.held_by[p];
    if (held == 0 || !moving->is_acting(held - 1))
      return nullptr;
    const BoundaryCondition &condition = *scene->dirichlet.list[held - 1];
    return condition.imposition.get()->single ? &condition : nullptr;
  }

  double
  ImplicitMPM::external_work(const WorksOnNodes   &works,
                             const TimeStep       &step,
                             const MaterialPoints &points) const
  {
    return works.of_others +
           (advection == Advection::none ? works.of_weight
                                         : work_on_fixed_points(step, points)) +
           work_of_changing_gravity(step, points);
  }

  double
  ImplicitMPM::work_of_changing_gravity(const TimeStep       &step,
                                        const MaterialPoints &points) const
  {
    const Tensor<1, dim> change =
      scene->gravity.at(step.t + step.h) - scene->gravity.at(step.t);
    double work = 0.;
    if (change.norm() > 0.)
      for (unsigned int p = 0; p < points.n_points(); ++p)
        work -= points.mass[p] * (change * (points.position[p] - datum));
    return Utilities::MPI::sum(work, force.get_mpi_communicator());
  }

  double
  ImplicitMPM::work_on_fixed_points(const TimeStep       &step,
                                    const MaterialPoints &points) const
  {
    const Tensor<1, dim> g    = scene->gravity.at(step.solved_at);
    double               work = 0.;
    for (unsigned int p = 0; p < points.n_points(); ++p)
      if (scene->regions.are_fixed(points.material[p]))
        work += points.mass[p] * (g * trial.moved[p].displacement);
    return Utilities::MPI::sum(work, force.get_mpi_communicator());
  }

  void
  ImplicitMPM::put_points_back(const MaterialPoints &points)
  {
    unsigned int n       = 0;
    double       largest = 0.;
    for (unsigned int p = 0; p < points.n_points(); ++p)
      {
        Moved &next = trial.moved[p];
        if (const auto place =
              points.held_by[p] > 0 ||
                  scene->regions.are_fixed(points.material[p])
                ? std::nullopt
                : moving->return_to_boundary(points.position[p], next.position))
          {
            const Tensor<1, dim> change = *place - next.position;
            next.position               = *place;
            next.displacement += change;
            largest = std::max(largest, change.norm());
            ++n;
          }
      }
    const MPI_Comm comm = force.get_mpi_communicator();
    trial.n_returned    = Utilities::MPI::sum(n, comm);
    trial.returned_by   = Utilities::MPI::max(largest, comm);
  }

  Point<dim>
  ImplicitMPM::largest_coordinates(const MaterialPoints &points) const
  {
    Point<dim> front;
    for (unsigned int d = 0; d < dim; ++d)
      {
        double largest = std::numeric_limits<double>::lowest();
        for (const Point<dim> &x : points.position)
          largest = std::max(largest, x[d]);
        front[d] = Utilities::MPI::max(largest, force.get_mpi_communicator());
      }
    return front;
  }

  double
  ImplicitMPM::update_points(const TimeStep &step, MaterialPoints &points)
  {
    const std::vector<Moved>    &moved = trial.moved;
    const std::vector<EndOfStep> ends =
      end_step(step, problem->internal_forces(), scene->materials, points);
    double dissipation = 0.;
    for (unsigned int p = 0; p < points.n_points(); ++p)
      {
        const auto &[stress, plastic, slip, dissipated] = ends[p];
        dissipation += points.weight[p] * dissipated;
        points.stress[p] = turn(stress, moved[p].spin);
        points.plastic_strain[p] =
          turn(points.plastic_strain[p] + plastic, moved[p].spin);
        points.cumulative_plastic_strain[p] += slip;
        points.plastic_strain_rate[p] = slip / step.h;
        points.volume[p]              = moved[p].volume;
        points.displacement[p] += moved[p].displacement;
        points.position[p] = moved[p].position;
        points.velocity[p] = moved[p].velocity;
        points.affine[p]   = moved[p].affine;
        if (const BoundaryCondition *holder = condition_of_particle(points, p))
          for (unsigned int d = 0; d < dim; ++d)
            if (holder->components[d])
              points.velocity[p][d] = holder->components[d]->value(
                points.position[p], step.t + step.h);
      }
    return Utilities::MPI::sum(dissipation, force.get_mpi_communicator());
  }
} // namespace geocone::GEOCONE_DIM
