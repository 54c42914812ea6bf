// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/gather.h>
#include <geocone/base/hdf5_file.h>
#include <geocone/base/largest_quantity.h>
#include <geocone/base/log.h>
#include <geocone/problem/frozen_problem.h>
#include <geocone/space/spline_basis.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
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

    /** Flattens Mandel vectors. */
    std::vector<double>
    flat(const std::vector<Mandel> &values)
    {
      std::vector<double> result;
      for (const Mandel &value : values)
        result.insert(result.end(), value.data(), value.data() + n_mandel);
      return result;
    }

    /** Flattens points. */
    std::vector<double>
    flat(const std::vector<Point<dim>> &values)
    {
      std::vector<double> result;
      for (const Point<dim> &value : values)
        for (unsigned int d = 0; d < dim; ++d)
          result.push_back(value[d]);
      return result;
    }

    std::vector<Mandel>
    mandel_vectors(const std::vector<double> &numbers)
    {
      std::vector<Mandel> result;
      for (std::size_t i = 0; i < numbers.size(); i += n_mandel)
        result.emplace_back(&numbers[i]);
      return result;
    }

    std::vector<Point<dim>>
    points_from(const std::vector<double> &numbers)
    {
      std::vector<Point<dim>> result(numbers.size() / dim);
      for (std::size_t i = 0; i < numbers.size(); ++i)
        result[i / dim][i % dim] = numbers[i];
      return result;
    }

    /** Format identifier of frozen files. */
    const std::string frozen_format = "geocone-1";

    /** Error in the text of a section Materials; empty if there is none. */
    std::string
    rejection_of_materials(const std::string &text)
    {
      std::istringstream       in(text);
      std::vector<std::string> sections;
      bool                     any = false;
      for (std::string line; std::getline(in, line);)
        {
          const std::size_t first = line.find_first_not_of(" \t\r");
          if (first == std::string::npos)
            continue;
          line = line.substr(first, line.find_last_not_of(" \t\r") - first + 1);
          const std::string shown = "'" + line.substr(0, 80) + "'";
          if (std::any_of(line.begin(), line.end(), [](const unsigned char c) {
                return c < ' ';
              }))
            return "its materials are no text";
          if (line.compare(0, 11, "subsection ") == 0)
            {
              const std::string name = line.substr(11);
              if (name.find('/') != std::string::npos)
                return "it has the material '" + name.substr(0, 80) +
                       "', whose name must have no '/'";
              if (sections.empty() && (name != "Materials" || any))
                return "its materials have the section " + shown +
                       ", where only one, Materials, may be";
              any = true;
              sections.push_back(name);
            }
          else if (line == "end")
            {
              if (sections.empty())
                return "its materials have an 'end' without a subsection";
              sections.pop_back();
            }
          else if (line.compare(0, 4, "set ") != 0 || sections.empty())
            return "its materials have the line " + shown +
                   ", which is no parameter of a material";
          else if (sections.size() == 1 && line.find('/') != std::string::npos)
            return "its materials have the line " + shown +
                   ", but names must have no '/'";
        }
      return sections.empty() ? ""
                              : "its materials have a subsection without 'end'";
    }
  } // namespace

  FrozenProblem
  IncrementalProblem::freeze(const Vector &start) const
  {
    const MPI_Comm comm = layout->get_mpi_communicator();
    FrozenProblem  frozen;
    frozen.materials       = materials.as_parameters();
    frozen.h               = h;
    frozen.consistent_part = inertia ? inertia->consistent_part() : 0.;

    MaterialPoints &p = frozen.points;
    p.n_nodes         = points.n_nodes;
    std::vector<unsigned int> counts;
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      counts.push_back(points.first_point[c + 1] - points.first_point[c]);
    for (const unsigned int count : gather(counts, comm))
      p.first_point.push_back(p.first_point.back() + count);
    for (const unsigned int node : points.nodes)
      p.nodes.push_back(layout->local_to_global(dim * node) / dim);
    p.nodes                = gather(p.nodes, comm);
    p.gradients            = gather(points.gradients, comm);
    p.values               = gather(points.values, comm);
    p.hoop                 = gather(points.hoop, comm);
    p.volumetric_gradients = gather(points.volumetric_gradients, comm);
    p.n_volumetric_modes   = points.n_volumetric_modes;
    p.volumetric_modes     = gather(points.volumetric_modes, comm);
    p.material             = gather(points.material, comm);
    p.weight               = gather(points.weight, comm);
    p.volume               = p.weight;
    p.mass                 = gather(points.mass, comm);
    p.history.width        = points.n_history();
    p.history              = gather(points.history, comm);
    p.stress               = mandel_vectors(gather(flat(points.stress), comm));
    p.position             = points_from(gather(flat(points.position), comm));

    for (unsigned int dof = 0; dof < layout->locally_owned_size(); ++dof)
      frozen.kind.push_back(std::min(0, unknowns.free_row[dof]));
    frozen.kind = gather(frozen.kind, comm);
    if (inertia)
      frozen.mass = gather(owned(inertia->lumped_mass()), comm);
    if (const Vector *force = external.vector())
      frozen.force = gather(owned(*force), comm);
    frozen.velocity_L = gather(owned(velocity_L), comm);
    frozen.prescribed = gather(owned(prescribed), comm);
    frozen.start      = gather(owned(start), comm);

    for (const GhostStencil &stencil : ghost.stencils())
      {
        for (const unsigned int node : stencil.node)
          frozen.ghost_nodes.push_back(layout->local_to_global(dim * node) /
                                       dim);
        for (const double c : stencil.coefficient)
          frozen.ghost_values.push_back(c);
        frozen.ghost_values.push_back(stencil.stiffness);
      }
    frozen.ghost_nodes  = gather(frozen.ghost_nodes, comm);
    frozen.ghost_values = gather(frozen.ghost_values, comm);

    const Multipliers &rows = unknowns.multipliers;
    for (const unsigned int dof : rows.dofs())
      frozen.constrained_dofs.push_back(layout->local_to_global(dof));
    frozen.constrained_dofs = gather(frozen.constrained_dofs, comm);
    const std::vector<double> coefficients =
      gather(std::vector<double>(rows.coefficients().data(),
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
    file.write("format", frozen_format);
    file.write("dimension", std::vector<int>{dim});
    file.write("materials", materials);
    file.write("step", std::vector<double>{h, consistent_part});
    file.write("particles", std::vector<int>{particles});
    file.write("points/n_nodes", std::vector<int>{int(points.n_nodes)});
    file.write("points/first_point", integers(points.first_point));
    file.write("points/nodes", integers(points.nodes));
    file.write("points/gradients", points.gradients);
    file.write("points/values", points.values);
    file.write("points/hoop", points.hoop);
    file.write("points/mean_gradients", points.volumetric_gradients);
    file.write("points/volumetric_modes", points.volumetric_modes);
    file.write("points/material", integers(points.material));
    file.write("points/weight", points.weight);
    file.write("points/mass", points.mass);
    file.write("points/stress", flat(points.stress));
    file.write("points/history", points.history);
    file.write("points/position", flat(points.position));
    file.write("dofs/kind", kind);
    file.write("dofs/mass", mass);
    file.write("dofs/force", force);
    file.write("dofs/velocity_L", velocity_L);
    file.write("dofs/prescribed", prescribed);
    file.write("dofs/start", start);
    file.write("ghosts/nodes", ghost_nodes);
    file.write("ghosts/values", ghost_values);
    file.write("constraints/dofs", constrained_dofs);
    file.write("constraints/coefficients",
               std::vector<double>(H.data(), H.data() + H.size()));
    file.write("constraints/targets",
               std::vector<double>(q.data(), q.data() + q.size()));
    file.close();
  }

  namespace
  {
    /** A frozen file from any source. */
    struct FrozenFile
    {
      explicit FrozenFile(const std::string &name)
        : name(name)
        , file(name, Hdf5File::Access::read)
      {}

      /** Checks a condition. @throws RunError with @p what is wrong unless it
       *  @p holds */
      void
      check(const bool holds, const std::string &what) const
      {
        if (!holds)
          throw RunError("the file '" + name + "' is inconsistent: " + what +
                         "\n  remedy:  freeze the step again ('Output/Freeze "
                         "steps')");
      }

      std::vector<unsigned int>
      unsigned_array(const std::string &array) const
      {
        const std::vector<int> values = file.read_integers(array);
        for (const int value : values)
          check(value >= 0, "negative numbers in '" + array + "'");
        return std::vector<unsigned int>(values.begin(), values.end());
      }

      std::vector<double>
      doubles(const std::string &array) const
      {
        const std::vector<double> values = file.read_doubles(array);
        for (const double value : values)
          check(std::abs(value) <= largest_quantity,
                "numbers in '" + array +
                  "' that are not finite, or beyond 1e30");
        return values;
      }

      const std::string name;
      const Hdf5File    file;
    };

    /** Arrays of numbers, converted to vectors and a matrix after their lengths
     *  are checked. */
    struct FlatArrays
    {
      std::vector<double> stress, position, H, q;
    };

    /** Reads all except the arrays. */
    void
    read_step(const FrozenFile &in, FrozenProblem &frozen)
    {
      in.check(in.file.read_text("format") == frozen_format,
               "its format is another one than '" + frozen_format + "'");
      if (in.file.has("dimension")) // older files lack it
        in.check(in.unsigned_array("dimension") ==
                   std::vector<unsigned int>{dim},
                 format("its dimension is not %u", dim));
      frozen.materials            = in.file.read_text("materials");
      const std::string rejection = rejection_of_materials(frozen.materials);
      in.check(rejection.empty(), rejection);
      const auto step = in.doubles("step");
      in.check(step.size() == 2 && step[0] > 0., "the step must be > 0 s");
      in.check(step[1] >= 0. && step[1] <= 1.,
               "the consistent part of the mass must be 0 to 1");
      frozen.h               = step[0];
      frozen.consistent_part = step[1];
      const auto particles   = in.unsigned_array("particles");
      const auto n_nodes     = in.unsigned_array("points/n_nodes");
      in.check(particles.size() == 1 && n_nodes.size() == 1,
               "it lacks numbers");
      constexpr unsigned int most_nodes = Utilities::pow(max_degree + 1, dim);
      in.check(n_nodes[0] >= 1 && n_nodes[0] <= most_nodes,
               format("cells have 1 to %u nodes", most_nodes));
      frozen.particles      = particles[0] != 0;
      frozen.points.n_nodes = n_nodes[0];
    }

    /** Reads all arrays, whose lengths remain to be checked. */
    FlatArrays
    read_arrays(const FrozenFile &in, FrozenProblem &frozen)
    {
      FlatArrays      flat;
      MaterialPoints &p      = frozen.points;
      p.first_point          = in.unsigned_array("points/first_point");
      p.nodes                = in.unsigned_array("points/nodes");
      p.gradients            = in.doubles("points/gradients");
      p.values               = in.doubles("points/values");
      p.volumetric_gradients = in.doubles("points/mean_gradients");
      if (in.file.has("points/hoop"))
        p.hoop = in.doubles("points/hoop");
      if (in.file.has("points/volumetric_modes"))
        p.volumetric_modes = in.doubles("points/volumetric_modes");
      p.material    = in.unsigned_array("points/material");
      p.weight      = in.doubles("points/weight");
      p.volume      = p.weight;
      p.mass        = in.doubles("points/mass");
      flat.stress   = in.doubles("points/stress");
      flat.position = in.doubles("points/position");
      if (in.file.has("points/history")) // older files lack it
        p.history = in.doubles("points/history");
      if (in.file.has("ghosts/nodes"))
        {
          frozen.ghost_nodes  = in.file.read_integers("ghosts/nodes");
          frozen.ghost_values = in.doubles("ghosts/values");
        }
      frozen.kind             = in.file.read_integers("dofs/kind");
      frozen.mass             = in.doubles("dofs/mass");
      frozen.force            = in.doubles("dofs/force");
      frozen.velocity_L       = in.doubles("dofs/velocity_L");
      frozen.prescribed       = in.doubles("dofs/prescribed");
      frozen.start            = in.doubles("dofs/start");
      frozen.constrained_dofs = in.file.read_integers("constraints/dofs");
      flat.H                  = in.doubles("constraints/coefficients");
      flat.q                  = in.doubles("constraints/targets");
      return flat;
    }

    void
    check_lengths(const FrozenFile     &in,
                  const MaterialPoints &p,
                  const FlatArrays     &flat)
    {
      const std::size_t n = p.n_points(), functions = p.n_nodes;
      in.check(p.first_point.size() >= 2 && p.first_point[0] == 0 &&
                 p.first_point.back() == n &&
                 std::is_sorted(p.first_point.begin(), p.first_point.end()) &&
                 std::adjacent_find(p.first_point.begin(),
                                    p.first_point.end()) == p.first_point.end(),
               "the cells do not hold its points");
      in.check(p.nodes.size() == p.n_cells() * functions &&
                 p.gradients.size() == dim * n * functions &&
                 p.material.size() == n && flat.stress.size() == n_mandel * n &&
                 flat.position.size() == dim * n &&
                 (p.mass.empty() || p.mass.size() == n),
               "the arrays of its points differ in length");
      in.check(p.history.size() % n == 0,
               "the histories of its points differ in length");
    }

    /** Copies volumetric gradients to points: older files have one set per
     *  cell. */
    void
    give_points_gradients_of_cells(MaterialPoints &p)
    {
      const std::size_t n = dim * p.n_nodes;
      if (p.volumetric_gradients.size() != n * p.n_cells())
        return;
      const std::vector<double> of_cells = std::move(p.volumetric_gradients);
      p.volumetric_gradients.clear();
      for (unsigned int c = 0; c < p.n_cells(); ++c)
        for (unsigned int q = p.first_point[c]; q < p.first_point[c + 1]; ++q)
          p.volumetric_gradients.insert(p.volumetric_gradients.end(),
                                        of_cells.begin() + n * c,
                                        of_cells.begin() + n * (c + 1));
    }

    void
    check_points(const FrozenFile &in, const FrozenProblem &frozen)
    {
      const MaterialPoints &p = frozen.points;
      in.check((p.values.empty() ||
                p.values.size() == std::size_t(p.n_points()) * p.n_nodes) &&
                 (p.volumetric_gradients.empty() ||
                  p.volumetric_gradients.size() == p.gradients.size()) &&
                 (p.hoop.empty() ||
                  (dim == 2 &&
                   p.hoop.size() == std::size_t(p.n_points()) * p.n_nodes)),
               "the functions of its points differ in number");
      in.check(
        p.volumetric_modes.size() % p.n_points() == 0 &&
          p.volumetric_modes.size() / p.n_points() <=
            CellPressures::most_modes &&
          (p.volumetric_modes.empty() || !p.volumetric_gradients.empty()),
        "the polynomials of its cells differ in number");
      for (const double weight : p.weight)
        in.check(weight > 0., "it has points without a volume");
      for (const std::vector<double> *masses :
           {static_cast<const std::vector<double> *>(&p.mass), &frozen.mass})
        for (const double mass : *masses)
          in.check(mass >= 0., "it has negative masses");
      in.check(frozen.kind.size() % dim == 0, "it has half a node");
      for (const std::size_t node : p.nodes)
        in.check(dim * node + dim <= frozen.kind.size(),
                 "it has cells without nodes");
    }

    void
    check_ghosts(const FrozenFile &in, const FrozenProblem &frozen)
    {
      in.check(frozen.ghost_nodes.size() % 3 == 0 &&
                 frozen.ghost_values.size() ==
                   frozen.ghost_nodes.size() / 3 * 4,
               "its ghost stiffness differs in length");
      for (const int node : frozen.ghost_nodes)
        in.check(node >= 0 &&
                   dim * std::size_t(node) + dim <= frozen.kind.size(),
                 "its ghost stiffness is of nodes that it lacks");
      for (std::size_t i = 3; i < frozen.ghost_values.size(); i += 4)
        in.check(frozen.ghost_values[i] >= 0.,
                 "its ghost stiffness is negative");
    }

    void
    check_dofs(const FrozenFile &in, const FrozenProblem &frozen)
    {
      const std::size_t n_dofs = frozen.kind.size();
      for (const int kind : frozen.kind)
        in.check(
          kind == 0 || kind == Unknowns::prescribed_row ||
            kind == Unknowns::massless_row,
          "it has dofs that are neither free nor prescribed nor without mass");
      for (const auto *array :
           {&frozen.velocity_L, &frozen.prescribed, &frozen.start})
        in.check(array->size() == n_dofs,
                 "the arrays of its dofs differ in length");
      for (const auto *array : {&frozen.mass, &frozen.force})
        in.check(array->empty() || array->size() == n_dofs,
                 "the arrays of its dofs differ in length");
      const MaterialPoints &p = frozen.points;
      const std::size_t     n = p.n_points();
      in.check(frozen.consistent_part == 0. ||
                 (p.values.size() == n * p.n_nodes && p.mass.size() == n),
               "it lacks the functions or masses of a consistent mass");
    }

    void
    check_constraints(const FrozenFile    &in,
                      const FrozenProblem &frozen,
                      const FlatArrays    &flat)
    {
      std::vector<int> dofs = frozen.constrained_dofs;
      in.check(flat.H.size() == flat.q.size() * dofs.size(),
               "its constraints differ in length");
      for (const int dof : dofs)
        in.check(dof >= 0 && std::size_t(dof) < frozen.kind.size() &&
                   frozen.kind[dof] == 0,
                 "it has constraints on dofs that are not free");
      std::sort(dofs.begin(), dofs.end());
      in.check(std::adjacent_find(dofs.begin(), dofs.end()) == dofs.end() &&
                 flat.q.size() <= dofs.size(),
               "it has more constraints than dofs in them, or dofs twice");
    }
  } // namespace

  FrozenProblem
  FrozenProblem::read(const std::string &file_name)
  {
    const FrozenFile in(file_name);
    FrozenProblem    frozen;
    read_step(in, frozen);
    const FlatArrays flat = read_arrays(in, frozen);
    MaterialPoints  &p    = frozen.points;
    check_lengths(in, p, flat);
    p.history.width      = p.history.size() / p.n_points();
    p.n_volumetric_modes = p.volumetric_modes.size() / p.n_points();
    give_points_gradients_of_cells(p);
    check_points(in, frozen);
    check_ghosts(in, frozen);
    check_dofs(in, frozen);
    check_constraints(in, frozen, flat);

    p.stress   = mandel_vectors(flat.stress);
    p.position = points_from(flat.position);
    frozen.q = Eigen::Map<const Eigen::VectorXd>(flat.q.data(), flat.q.size());
    frozen.H = Eigen::Map<const Eigen::MatrixXd>(
      flat.H.data(), flat.q.size(), frozen.constrained_dofs.size());
    return frozen;
  }
} // namespace geocone::GEOCONE_DIM
