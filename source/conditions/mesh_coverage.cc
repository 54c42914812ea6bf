// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/log.h>
#include <geocone/base/over_ranks.h>
#include <geocone/conditions/mesh_coverage.h>
#include <geocone/shapes/part_in_box.h>
#include <geocone/surfaces/face_points.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** Whether all that a condition prescribes is zero. */
    bool
    is_support(const BoundaryCondition &condition)
    {
      const auto is_zero = [](const std::optional<Expression> &value) {
        return !value || value->is_zero();
      };
      return is_zero(condition.normal) &&
             std::all_of(condition.components.begin(),
                         condition.components.end(),
                         is_zero);
    }

    /** Bounding box of a part of the boundary: minima of the coordinates and of
     *  their negatives. */
    struct Extent
    {
      std::array<double, 2 * dim> ends;

      Extent()
      {
        ends.fill(std::numeric_limits<double>::max());
      }

      void
      add(const Point<dim> &x)
      {
        for (unsigned int d = 0; d < dim; ++d)
          {
            ends[d]       = std::min(ends[d], x[d]);
            ends[dim + d] = std::min(ends[dim + d], -x[d]);
          }
      }

      void
      unite(const MPI_Comm comm)
      {
        Utilities::MPI::min(ArrayView<const double>(ends.data(), ends.size()),
                            comm,
                            ArrayView<double>(ends.data(), ends.size()));
      }

      double
      width(const unsigned int d) const
      {
        return -ends[dim + d] - ends[d];
      }
    };

    /** Calls a function for each face at the boundary with given ids. */
    template <typename Function>
    void
    for_each_face(const BackgroundMesh               &mesh,
                  const std::set<types::boundary_id> &ids,
                  const Function                     &function)
    {
      for (const auto &cell : mesh.own_cells())
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary() &&
              ids.count(cell->face(f)->boundary_id()) > 0)
            function(cell, f);
    }

    /** Part of the boundary in the box of a condition or, by samples on the
     *  edges, where its formula holds. */
    Extent
    asked_part(const BoundaryCondition            &condition,
               const BackgroundMesh               &mesh,
               const std::set<types::boundary_id> &ids,
               double                             &spacing)
    {
      constexpr unsigned int n_samples = 64; // intervals per edge
      Extent                 asked;
      const auto add_edge = [&](const Point<dim> &a, const Point<dim> &b) {
        if (!condition.has_formula())
          {
            if (const auto part = part_in_box(*condition.wide_box(), a, b))
              for (const Point<dim> &end : *part)
                asked.add(end);
            return;
          }
        for (unsigned int i = 0; i <= n_samples; ++i)
          if (const Point<dim> x = a + double(i) / n_samples * (b - a);
              condition.holds_at(x))
            {
              asked.add(x);
              spacing = std::max(spacing, a.distance(b) / n_samples);
            }
      };
      for_each_face(mesh, ids, [&](const auto &cell, const unsigned int f) {
        const auto face = cell->face(f);
        if constexpr (dim == 2)
          add_edge(face->vertex(0), face->vertex(1));
        else
          for (const unsigned int l : face->line_indices())
            add_edge(face->line(l)->vertex(0), face->line(l)->vertex(1));
      });
      return asked;
    }
  } // namespace

  std::vector<std::string>
  warn_of_partial_coverage(const Scene          &scene,
                           const BackgroundMesh &mesh,
                           const Space          &space)
  {
    constexpr double         noticed = 1e-3; ///< part of the width
    std::vector<std::string> warnings;
    const MPI_Comm           comm = mesh.triangulation().get_communicator();
    // Tractions act on the parts of faces in their box exactly.
    const auto check = [&](const BoundaryCondition &condition,
                           const bool               is_velocity) {
      if (condition.has_formula() ? is_velocity && is_support(condition)
                                  : !is_velocity || !condition.box_corners())
        return;
      const auto ids     = mesh.side_ids(condition);
      double     spacing = 0.;
      Extent     asked   = asked_part(condition, mesh, ids, spacing), held;
      if (is_velocity)
        {
          for (const unsigned int node : space.nodes_on_sides(ids))
            if (condition.holds_at(space.node_positions()[node]))
              held.add(space.node_positions()[node]);
        }
      else
        for_each_face(mesh, ids, [&](const auto &cell, const unsigned int f) {
          if (part_of_face(condition, mesh, cell, f))
            for (const unsigned int v : cell->face(f)->vertex_indices())
              held.add(cell->face(f)->vertex(v));
        });
      asked.unite(comm);
      held.unite(comm);
      spacing       = Utilities::MPI::max(spacing, comm);
      double widest = 0.;
      for (unsigned int d = 0; d < dim; ++d)
        widest = std::max(widest, held.width(d));
      if (widest == 0. && is_support(condition))
        return; // a point that is held has no width
      for (unsigned int d = 0; d < dim; ++d)
        if (std::abs(held.width(d) - asked.width(d)) >
            noticed * asked.width(d) + 2. * spacing + 1e-8)
          warnings.push_back(
            format("'%s' %s from %c = %g to %g m, a width of %g m, where "
                   "%g m are in its %s, from %g to %g m: loads, and errors "
                   "beside a reference, are those of the %s; put nodes at the "
                   "ends of the %s (cell size, grading), or take smaller cells",
                   condition.name.c_str(),
                   is_velocity ? "holds nodes" : "acts on whole faces",
                   coordinate[d],
                   held.ends[d],
                   -held.ends[dim + d],
                   held.width(d),
                   asked.width(d),
                   condition.has_formula() ? "formula" : "box",
                   asked.ends[d],
                   -asked.ends[dim + d],
                   is_velocity ? "nodes" : "faces",
                   condition.has_formula() ? "region" : "box"));
    };
    for (const auto &condition : scene.dirichlet.list)
      if (!condition->moves_with_body())
        check(*condition, true);
    for (const auto &condition : scene.tractions.list)
      check(*condition, false);
    return warnings;
  }

  std::string
  warn_of_steep_water(const Scene &scene, const BackgroundMesh &mesh)
  {
    const Water &water = scene.water;
    if (!water.acts() || water.scales_with_weight() || water.has_suction())
      return "";
    const MPI_Comm comm  = mesh.triangulation().get_communicator();
    double         worst = 0.;
    Point<dim>     place;
    for (const auto &cell : mesh.own_cells())
      if (const Point<dim> c = cell->center(); scene.geometry.contains(c))
        for (const unsigned int v : cell->vertex_indices())
          {
            // A jump that the gradient between does not see, of more than half
            // of a cell of water: kinks of its line have less.
            const Tensor<1, dim> r = cell->vertex(v) - c;
            double jump            = water.pressure(c + r) - water.pressure(c);
            for (const double at : {0.25, 0.75})
              jump += 0.5 * water.force(c + at * r) * r;
            const double of_cells =
              0.5 * water.weight() * BackgroundMesh::size_of(cell);
            if (std::abs(jump) > std::max(worst, of_cells))
              {
                worst = std::abs(jump);
                place = c;
              }
          }
    const double largest = Utilities::MPI::max(worst, comm);
    if (!(largest > 0.))
      return "";
    return format("the pore pressure changes by %.4g Pa within the cell at (",
                  largest) +
           text_of_place(place_of_largest(worst, largest, place, comm)) +
           "), more than its points see: a part of its thrust is missing; let "
           "the line of water rise over two cells, or put edges on it "
           "(Mesh/Type = unstructured)";
  }

  namespace
  {
    /** Forces of a traction, summed over the ends of stages. */
    struct HeldForce
    {
      double whole = 0.; ///< (N/m)
      double free  = 0.; ///< along velocities that are not prescribed (N/m)
      std::set<std::string> holders; ///< conditions that prescribe the others

      /** Adds a force at a point where conditions may hold. */
      void
      add(Tensor<1, dim>                                force,
          const FacePoint                              &point,
          const std::vector<const BoundaryCondition *> &held)
      {
        whole += force.norm();
        for (const BoundaryCondition *condition : held)
          {
            if (!condition->holds_at(point.position))
              continue;
            const double before = force.norm();
            for (unsigned int d = 0; d < dim; ++d)
              if (condition->components[d])
                force[d] = 0.;
            if (condition->normal)
              force -= (force * point.normal) * point.normal;
            if (force.norm() < 0.5 * before)
              holders.insert(condition->name);
          }
        free += force.norm();
      }

      void
      unite(const MPI_Comm comm)
      {
        whole = Utilities::MPI::sum(whole, comm);
        free  = Utilities::MPI::sum(free, comm);
        const std::vector<std::string> own(holders.begin(), holders.end());
        for (const auto &of_rank : Utilities::MPI::all_gather(comm, own))
          holders.insert(of_rank.begin(), of_rank.end());
      }

      /** Names of the conditions, in quotes. */
      std::string
      names() const
      {
        std::string text;
        for (const std::string &name : holders)
          text += (text.empty() ? "'" : ", '") + name + "'";
        return text;
      }
    };

    HeldForce
    held_force(const BoundaryCondition &traction,
               const Scene             &scene,
               const BackgroundMesh    &mesh,
               const Space             &space)
    {
      HeldForce sum;
      for_each_face(
        mesh, mesh.side_ids(traction), [&](const auto &cell, const unsigned f) {
          const auto part = part_of_face(traction, mesh, cell, f);
          if (!part)
            return;
          std::vector<const BoundaryCondition *> held;
          for (const auto &condition : scene.dirichlet.list)
            if (condition->stages.are_all() && !condition->moves_with_body() &&
                mesh.side_ids(*condition).count(cell->face(f)->boundary_id()) >
                  0)
              held.push_back(condition.get());
          for (const FacePoint &point :
               points_on_face(mesh, space, cell, f, *part))
            {
              double t = 0.;
              for (const auto &stage : scene.loading.list)
                {
                  t += stage->duration;
                  sum.add(point.weight *
                            traction.vector_at(point.position, point.normal, t),
                          point,
                          held);
                }
            }
        });
      sum.unite(mesh.triangulation().get_communicator());
      return sum;
    }
  } // namespace

  std::vector<std::string>
  warn_of_held_tractions(const Scene          &scene,
                         const BackgroundMesh &mesh,
                         const Space          &space)
  {
    constexpr double         noticed = 0.5; ///< part that is held
    std::vector<std::string> warnings;
    for (const auto &traction : scene.tractions.list)
      if (const HeldForce force = held_force(*traction, scene, mesh, space);
          force.whole - force.free > noticed * force.whole)
        warnings.push_back(
          format("the traction '%s' acts for %.3g %% along velocities that %s "
                 "prescribes: that part only changes the reaction there; give "
                 "the traction other sides, or leave that velocity free",
                 traction->name.c_str(),
                 100. * (1. - force.free / force.whole),
                 force.names().c_str()));
    return warnings;
  }

  std::vector<std::string>
  warn_of_cut_cells(const Scene &scene, const BackgroundMesh &mesh)
  {
    constexpr double noticed = 0.02; ///< part of the volume
    // Volumes of a region: of its cells, and by samples within all cells.
    struct Volumes
    {
      double of_cells = 0., sampled = 0.;
    };
    const unsigned int n_materials = scene.materials.size();
    const bool has_regions = n_materials > 1 && !scene.regions.have_groups();
    if (!has_regions && !scene.loading.changes_body())
      return {};
    std::vector<Volumes> volumes(n_materials + scene.loading.list.size());
    const auto add = [&](const Point<dim> &x, const double V, auto member) {
      volumes[scene.regions.material_at(x)].*member += V;
      for (unsigned int s = 0; s < scene.loading.list.size(); ++s)
        if (scene.loading.list[s]->removes(x))
          volumes[n_materials + s].*member += V;
    };
    for (const auto &cell : mesh.own_cells())
      {
        const double       V = cell->measure();
        const unsigned int n = cell->n_vertices();
        add(cell->center(), V, &Volumes::of_cells);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            add(cell->center() +
                  0.999 * (2. / 3. * (cell->vertex(i) - cell->center()) +
                           1. / 3. * (cell->vertex(j) - cell->center())),
                V / (n * n),
                &Volumes::sampled);
      }
    std::vector<std::string> warnings;
    // The first material fills what the others leave.
    for (unsigned int r = has_regions ? 1 : n_materials; r < volumes.size();
         ++r)
      {
        const MPI_Comm comm   = mesh.triangulation().get_communicator();
        const double of_cells = Utilities::MPI::sum(volumes[r].of_cells, comm),
                     sampled  = Utilities::MPI::sum(volumes[r].sampled, comm);
        if (std::abs(of_cells - sampled) >
            noticed * std::max(of_cells, sampled))
          warnings.push_back(format(
            "%s '%s' takes cells by their centres, of %.3g %s in all, where "
            "about %.3g are in its region: put cell edges on the boundary of "
            "the region (Mesh/Type = unstructured), or take smaller cells",
            r < n_materials ? "the material" : "the excavation of the stage",
            r < n_materials ? scene.materials.name(r).c_str()
                            : scene.loading.list[r - n_materials]->name.c_str(),
            of_cells,
            dim == 2 ? "m^2" : "m^3",
            sampled));
      }
    return warnings;
  }
} // namespace geocone::GEOCONE_DIM
