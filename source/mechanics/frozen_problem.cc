// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/hdf5_file.h>
#include <geocone/mechanics/frozen_problem.h>

#include <deal.II/base/mpi.h>

namespace geocone
{
  using namespace dealii;

  namespace
  {
    /** The arrays of all ranks one after another, on the first one. */
    template <typename T>
    std::vector<T>
    join(const std::vector<T> &part, const MPI_Comm comm)
    {
      std::vector<T> all;
      for (const std::vector<T> &of_rank : Utilities::MPI::gather(comm, part))
        all.insert(all.end(), of_rank.begin(), of_rank.end());
      return all;
    }

    std::vector<double>
    owned(const Vector &v)
    {
      return std::vector<double>(v.begin(), v.begin() + v.locally_owned_size());
    }

    std::vector<int>
    integers(const std::vector<unsigned int> &values)
    {
      return std::vector<int>(values.begin(), values.end());
    }

    /** Mandel vectors as three numbers each. */
    std::vector<double>
    flat(const std::vector<Mandel> &values)
    {
      std::vector<double> result;
      for (const Mandel &value : values)
        result.insert(result.end(), value.data(), value.data() + n_mandel);
      return result;
    }
  } // namespace

  FrozenProblem
  IncrementalProblem::freeze(const Vector &start) const
  {
    const MPI_Comm comm = layout->get_mpi_communicator();
    FrozenProblem  frozen;
    frozen.h               = h;
    frozen.consistent_part = consistent_part;

    MaterialPoints &p = frozen.points;
    p.n_nodes         = points.n_nodes;
    std::vector<unsigned int> counts;
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      counts.push_back(points.first_point[c + 1] - points.first_point[c]);
    for (const unsigned int count : join(counts, comm))
      p.first_point.push_back(p.first_point.back() + count);
    for (const unsigned int node : points.nodes)
      p.nodes.push_back(layout->local_to_global(dim * node) / dim);
    p.nodes                            = join(p.nodes, comm);
    p.gradients                        = join(points.gradients, comm);
    p.values                           = join(points.values, comm);
    p.mean_gradients                   = join(points.mean_gradients, comm);
    p.material                         = join(points.material, comm);
    p.weight                           = join(points.weight, comm);
    p.position                         = join(points.position, comm);
    p.mass                             = join(points.mass, comm);
    const std::vector<double> stresses = join(flat(points.stress), comm);
    for (std::size_t i = 0; i < stresses.size(); i += n_mandel)
      p.stress.emplace_back(&stresses[i]);

    for (unsigned int dof = 0; dof < layout->locally_owned_size(); ++dof)
      frozen.kind.push_back(std::min(0, unknowns.free_row[dof]));
    frozen.kind = join(frozen.kind, comm);
    if (mass != nullptr)
      frozen.mass = join(owned(*mass), comm);
    if (force != nullptr)
      frozen.force = join(owned(*force), comm);
    frozen.velocity_L = join(owned(velocity_L), comm);
    frozen.prescribed = join(owned(prescribed), comm);
    frozen.start      = join(owned(start), comm);

    const Multipliers &rows = unknowns.multipliers;
    for (const unsigned int dof : rows.dofs())
      frozen.constrained_dofs.push_back(layout->local_to_global(dof));
    frozen.constrained_dofs = join(frozen.constrained_dofs, comm);
    const std::vector<double> coefficients =
      join(std::vector<double>(rows.coefficients().data(),
                               rows.coefficients().data() +
                                 rows.coefficients().size()),
           comm);
    frozen.H = Eigen::Map<const Eigen::MatrixXd>(
      coefficients.data(),
      rows.n_rows(),
      rows.n_rows() > 0 ? coefficients.size() / rows.n_rows() : 0);
    frozen.q = rows.targets();
    return frozen;
  }

  void
  FrozenProblem::write(const std::string &file_name) const
  {
    Hdf5File file(file_name, Hdf5File::Access::create);
    file.write("materials", materials);
    file.write("step", std::vector<double>{h, consistent_part});
    file.write("particles", std::vector<int>{particles});
    file.write("points/n_nodes", std::vector<int>{int(points.n_nodes)});
    file.write("points/first_point", integers(points.first_point));
    file.write("points/nodes", integers(points.nodes));
    file.write("points/gradients", points.gradients);
    file.write("points/values", points.values);
    file.write("points/mean_gradients", points.mean_gradients);
    file.write("points/material", integers(points.material));
    file.write("points/weight", points.weight);
    file.write("points/mass", points.mass);
    file.write("points/stress", flat(points.stress));
    std::vector<double> positions;
    for (const Point<dim> &x : points.position)
      positions.insert(positions.end(), {x[0], x[1]});
    file.write("points/position", positions);
    file.write("dofs/kind", kind);
    file.write("dofs/mass", mass);
    file.write("dofs/force", force);
    file.write("dofs/velocity_L", velocity_L);
    file.write("dofs/prescribed", prescribed);
    file.write("dofs/start", start);
    file.write("constraints/dofs", constrained_dofs);
    file.write("constraints/coefficients",
               std::vector<double>(H.data(), H.data() + H.size()));
    file.write("constraints/targets",
               std::vector<double>(q.data(), q.data() + q.size()));
    file.close();
  }

  FrozenProblem
  FrozenProblem::read(const std::string &file_name)
  {
    const Hdf5File file(file_name, Hdf5File::Access::read);
    const auto     check = [&](const bool holds, const std::string &what) {
      if (!holds)
        throw RunError("the file '" + file_name + "' is inconsistent: " + what);
    };
    const auto unsigned_array = [&](const std::string &name) {
      const std::vector<int> values = file.read_integers(name);
      for (const int value : values)
        check(value >= 0, "negative numbers in '" + name + "'");
      return std::vector<unsigned int>(values.begin(), values.end());
    };

    FrozenProblem frozen;
    frozen.materials = file.read_text("materials");
    const auto step  = file.read_doubles("step");
    check(step.size() == 2 && step[0] > 0., "the step must be > 0 s");
    frozen.h               = step[0];
    frozen.consistent_part = step[1];
    const auto particles   = unsigned_array("particles");
    const auto n_nodes     = unsigned_array("points/n_nodes");
    check(particles.size() == 1 && n_nodes.size() == 1, "it lacks numbers");
    frozen.particles = particles[0] != 0;

    MaterialPoints &p       = frozen.points;
    p.n_nodes               = n_nodes[0];
    p.first_point           = unsigned_array("points/first_point");
    p.nodes                 = unsigned_array("points/nodes");
    p.gradients             = file.read_doubles("points/gradients");
    p.values                = file.read_doubles("points/values");
    p.mean_gradients        = file.read_doubles("points/mean_gradients");
    p.material              = unsigned_array("points/material");
    p.weight                = file.read_doubles("points/weight");
    p.mass                  = file.read_doubles("points/mass");
    const auto stress       = file.read_doubles("points/stress");
    const auto x            = file.read_doubles("points/position");
    frozen.kind             = file.read_integers("dofs/kind");
    frozen.mass             = file.read_doubles("dofs/mass");
    frozen.force            = file.read_doubles("dofs/force");
    frozen.velocity_L       = file.read_doubles("dofs/velocity_L");
    frozen.prescribed       = file.read_doubles("dofs/prescribed");
    frozen.start            = file.read_doubles("dofs/start");
    frozen.constrained_dofs = file.read_integers("constraints/dofs");
    const auto H            = file.read_doubles("constraints/coefficients");
    const auto q            = file.read_doubles("constraints/targets");

    const std::size_t n = p.n_points(), n_dofs = frozen.kind.size();
    check(!p.first_point.empty() && p.first_point[0] == 0 &&
            p.first_point.back() == n &&
            std::is_sorted(p.first_point.begin(), p.first_point.end()),
          "the cells do not hold its points");
    check(p.nodes.size() == p.n_cells() * p.n_nodes &&
            p.gradients.size() == 2 * n * p.n_nodes && p.material.size() == n &&
            stress.size() == n_mandel * n && x.size() == dim * n,
          "the arrays of its points differ in length");
    check((p.values.empty() || p.values.size() == n * p.n_nodes) &&
            (p.mean_gradients.empty() ||
             p.mean_gradients.size() == 2 * p.n_cells() * p.n_nodes),
          "the functions of its points differ in number");
    for (const unsigned int node : p.nodes)
      check(dim * node + dim <= n_dofs, "it has cells without nodes");
    for (const auto *array :
         {&frozen.velocity_L, &frozen.prescribed, &frozen.start})
      check(array->size() == n_dofs, "the arrays of its dofs differ in length");
    for (const auto *array : {&frozen.mass, &frozen.force})
      check(array->empty() || array->size() == n_dofs,
            "the arrays of its dofs differ in length");
    check(H.size() == q.size() * frozen.constrained_dofs.size(),
          "its constraints differ in length");
    for (const int dof : frozen.constrained_dofs)
      check(dof >= 0 && std::size_t(dof) < n_dofs,
            "it has constraints without dofs");

    for (std::size_t i = 0; i < n; ++i)
      {
        p.stress.emplace_back(&stress[n_mandel * i]);
        p.position.emplace_back(x[dim * i], x[dim * i + 1]);
      }
    frozen.q = Eigen::Map<const Eigen::VectorXd>(q.data(), q.size());
    frozen.H = Eigen::Map<const Eigen::MatrixXd>(
      H.data(), q.size(), frozen.constrained_dofs.size());
    return frozen;
  }

  ThawedProblem::ThawedProblem(const FrozenProblem &frozen,
                               const Materials     &materials)
    : points(frozen.points)
  {
    const unsigned int n = frozen.kind.size();
    unknowns.free_row    = frozen.kind;
    for (int &row : unknowns.free_row)
      {
        unknowns.with_mass.push_back(row != Unknowns::massless_row);
        if (row == 0)
          {
            row = unknowns.n_rows++;
            unknowns.global_row.push_back(row);
          }
      }
    unknowns.n_owned_rows = unknowns.n_rows;
    if (unknowns.n_rows == 0)
      throw RunError("the frozen problem has no unknown");
    unknowns.multipliers =
      Multipliers(std::vector<unsigned int>(frozen.constrained_dofs.begin(),
                                            frozen.constrained_dofs.end()),
                  frozen.H,
                  frozen.q);

    IndexSet all(n);
    all.add_range(0, n);
    const auto layout =
      std::make_shared<const Utilities::MPI::Partitioner>(all, MPI_COMM_SELF);
    const auto vector = [&](const std::vector<double> &values) {
      Vector v(layout);
      std::copy(values.begin(), values.end(), v.begin());
      return v;
    };
    mass    = vector(frozen.mass);
    force   = vector(frozen.force);
    v_start = vector(frozen.start);
    for (const unsigned int m : points.material)
      if (m >= materials.size())
        throw RunError("the frozen problem has points of a material that its "
                       "materials lack");
    incremental_problem = std::make_unique<IncrementalProblem>(
      points,
      materials,
      unknowns,
      layout,
      frozen.mass.empty() ? nullptr : &mass,
      frozen.consistent_part);
    incremental_problem->begin_step(frozen.h,
                                    frozen.force.empty() ? nullptr : &force,
                                    vector(frozen.velocity_L),
                                    vector(frozen.prescribed));
  }
} // namespace geocone
