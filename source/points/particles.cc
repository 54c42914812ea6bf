// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/points/history_start.h>
#include <geocone/points/particles.h>
#include <geocone/points/point_record.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <numeric>
#include <tuple>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** Nearest point on a side of the body: in the plane on a line, in space on
     *  a rectangle of a box. */
    Point<dim>
    nearest_on_side(const Geometry    &geometry,
                    const std::string &name,
                    const Point<dim>  &x)
    {
      if (dim == 2)
        {
          const auto ends = geometry.side_ends(geometry.sides.at(name));
          return nearest_on_segment(x, ends[0], ends[1]);
        }
      const auto [lower, upper] = geometry.bounding_box();
      Point<dim> foot;
      for (unsigned int d = 0; d < dim; ++d)
        foot[d] = name == side_of_box[d][0] ? lower[d]
                  : name == side_of_box[d][1]
                    ? upper[d]
                    : std::clamp(x[d], lower[d], upper[d]);
      return foot;
    }

    /**
     * Whether a particle lies in the first row under the controlled part of the
     * body's sides: nearer than the side length of its own square or cube.
     */
    bool
    in_first_row(const BoundaryCondition &condition,
                 const Geometry          &geometry,
                 const Point<dim>        &x,
                 const double             volume)
    {
      for (const auto &side : geometry.sides)
        if (condition.is_on_side(side.first))
          {
            const Point<dim> foot = nearest_on_side(geometry, side.first, x);
            if (foot.distance(x) < geometry.size_of_point(x, volume) &&
                condition.holds_at(foot))
              return true;
          }
      return false;
    }
  } // namespace

  Point<dim>
  Particles::inside(const Point<dim> &unit) const
  {
    if (margin == 0.)
      return unit;
    Point<dim> moved;
    for (unsigned int d = 0; d < dim; ++d)
      moved[d] = std::clamp(unit[d], margin, 1. - margin);
    double sum = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      sum += moved[d];
    if (search->mesh_is_simplicial() && sum > 1. - margin)
      moved *= (1. - margin) / sum;
    return moved;
  }

  Particles::Particles(const ParameterFile &file)
    : seeding(file)
  {}

  std::string
  Particles::prepare(const Scene          &scene,
                     const BackgroundMesh &mesh_,
                     const Space          &space_,
                     MaterialPoints       &points)
  {
    contacts = &scene.contacts;
    mesh     = &mesh_;
    space    = &space_;
    comm     = mesh->triangulation().get_communicator();
    seeding.prepare(scene);
    const std::vector<Seed> seeds = seeding.make(scene, *mesh);
    search                        = std::make_unique<CellSearch>(*mesh);
    margin                        = space->is_spline() ? 0. : 1e-6;

    points = MaterialPoints();
    points.use(true, scene.materials.n_history());
    unsigned int       first = 0;
    const unsigned int n     = seeds.size();
    MPI_Exscan(&n, &first, 1, MPI_UNSIGNED, MPI_SUM, comm);
    const auto  &conditions = scene.dirichlet.list;
    HistoryStart start;
    std::string  held_twice; // a condition
    for (unsigned int i = 0; i < n; ++i)
      {
        const Seed            &seed = seeds[i];
        const ConstitutiveLaw &law  = scene.materials.law(seed.material);
        const bool             later =
          scene.loading.adds(scene.materials.name(seed.material));
        MaterialPoints    &set = later ? waiting[seed.material] : points;
        const unsigned int p   = set.n_points();
        if (p == 0)
          set.use_as(points);
        set.set_size(p + 1);
        set.id[p]       = first + i;
        set.cell[p]     = numbers::invalid_unsigned_int;
        set.position[p] = seed.position;
        set.volume[p]   = seed.volume;
        set.material[p] = seed.material;
        set.mass[p] = seed.volume * scene.density(seed.material, seed.position);
        set.stress[p] = seed.stress;
        if (!later)
          set.velocity[p] = seed.velocity;
        start.set(law,
                  stress_of(extended(seed.stress, seed.stress_zz)),
                  space->band_width(seed.cell),
                  seed.position,
                  set.history_of(p));
        for (unsigned int c = 0; c < conditions.size(); ++c)
          if (conditions[c]->imposed_on() == Imposition::On::particles &&
              in_first_row(
                *conditions[c], scene.geometry, seed.position, seed.volume))
            {
              if (const unsigned int other = set.held_by[p];
                  other > 0 && !(conditions[c]->stages.are_all() &&
                                 conditions[other - 1]->stages.are_all()))
                held_twice = conditions[c]->name;
              set.held_by[p] = c + 1;
            }
      }
    start.check<InputError>(comm);
    held_twice = text_of_any_rank(comm, held_twice);
    if (!held_twice.empty())
      throw InputError("Boundary conditions/" + held_twice + "/" +
                         ActingStages::entry,
                       held_twice,
                       "one condition per particle, where it does not act in "
                       "all stages",
                       "make it one condition with formulas in t, or impose it "
                       "on nodes or segments");
    find_cells(points);

    return warning_of_few_particles();
  }

  std::string
  Particles::warning_of_few_particles() const
  {
    const unsigned int k    = seeding.points_per_direction();
    const unsigned int want = mesh->is_simplicial() ? 4 : 3;
    if (space->degree() == 3 && !space->is_spline() && k > 0 && k < want)
      return format("%s with fewer than %u x %u particles per cell: functions "
                    "that no particle sees move freely, loads come out far too "
                    "low; take 'Particles/Points per direction' = %u%s",
                    space->element().c_str(),
                    want,
                    want,
                    want,
                    mesh->is_simplicial() ? " and 'Layout' = sub-cells"
                                          : ", or B-splines");
    return "";
  }

  void
  Particles::evaluate(MaterialPoints &points) const
  {
    const unsigned int n_points = points.n_points();
    const unsigned int n        = space->nodes_per_cell();
    points.n_nodes              = n;
    points.values.resize(n_points * n);
    points.gradients.resize(n_points * dim * n);
    points.cells.clear();
    points.first_point = {0};
    points.nodes.clear();
    points.hoop.clear();

    std::vector<types::global_dof_index> nodes;
    std::vector<Tensor<1, dim>>          unit_gradient(n);
    for (unsigned int p = 0; p < n_points; ++p)
      {
        const auto cell = search->cell(points.cell[p]);
        if (p == 0 || points.cell[p] != points.cell[p - 1])
          {
            if (p > 0)
              points.first_point.push_back(p);
            points.cells.push_back(cell);
            space->cell_nodes(cell, nodes);
            for (const types::global_dof_index node : nodes)
              points.nodes.push_back(space->local_node(node));
          }
        const Tensor<2, dim> inverse =
          mesh->inverse_jacobian(cell, points.unit[p]);
        space->evaluate(
          cell, points.unit[p], &points.values[p * n], unit_gradient.data());
        for (unsigned int i = 0; i < n; ++i)
          {
            const Tensor<1, dim> gradient = unit_gradient[i] * inverse;
            for (unsigned int c = 0; c < dim; ++c)
              points.gradients[(p * dim + c) * n + i] = gradient[c];
          }
        if (mesh->is_axisymmetric())
          for (unsigned int i = 0; i < n; ++i)
            points.hoop.push_back(points.values[p * n + i] /
                                  points.position[p][0]);
      }
    if (n_points > 0)
      points.first_point.push_back(n_points);
    points.weight.assign(points.volume.begin(), points.volume.end());
  }

  void
  Particles::prepare_integration(const bool          consistent,
                                 const SoilBoundary &boundary,
                                 MaterialPoints     &points) const
  {
    if (consistent && space->is_spline() && contacts->list.empty() &&
        (space->has_b_bar() || !boundary.loaded.empty()))
      make_consistent(*mesh, *space, boundary, points);
    if (space->has_b_bar())
      project_gradients(space->volumetric_degree(), points);
  }

  void
  Particles::save(Archive &archive, const MaterialPoints &points)
  {
    save_points(archive, points);
    StateRow row;
    row(n_lost_all);
    archive.write_row("particles/lost", row);
  }

  void
  Particles::load(const Archive &archive, MaterialPoints &points)
  {
    const PointRecord record(archive, points);
    points.set_size(0);
    for (const auto &cell : mesh->own_cells())
      if (record.has(cell))
        for (const double *row : record.of(cell))
          {
            points.append(row);
            points.cell.back() = cell->active_cell_index();
          }
    archive.read_row("particles/lost")(n_lost_all);
    evaluate(points);
    // On shared meshes the order of points depends on the number of ranks.
    if (archive.n_ranks_of("points/state") !=
          Utilities::MPI::n_mpi_processes(comm) &&
        dynamic_cast<const parallel::distributed::Triangulation<dim> *>(
          &mesh->triangulation()) == nullptr)
      for (auto &[material, later] : waiting)
        for (unsigned int p = 0; p < later.n_points(); ++p)
          later.id[p] |= 1U << 31;
  }

  void
  Particles::keep(const std::vector<bool> &stays, MaterialPoints &points) const
  {
    std::vector<unsigned int> staying;
    for (unsigned int p = 0; p < stays.size(); ++p)
      if (stays[p])
        staying.push_back(p);
    points.reorder(staying);
    evaluate(points);
  }

  unsigned long
  Particles::add(const unsigned int material, MaterialPoints &points)
  {
    const MaterialPoints &now = waiting[material];
    std::vector<double>   row(points.n_numbers());
    for (unsigned int p = 0; p < now.n_points(); ++p)
      {
        now.get(p, row.data());
        points.append(row.data());
      }
    const unsigned long n = Utilities::MPI::sum(now.n_points(), comm);
    waiting.erase(material);
    find_cells(points);
    return n;
  }

  std::pair<std::string, unsigned int>
  Particles::find_cells(MaterialPoints &points) const
  {
    std::pair<std::string, unsigned int> lost;
    std::vector<unsigned int>            owner(points.n_points(), nobody);
    for (unsigned int p = 0; p < points.n_points(); ++p)
      {
        unsigned int &cell  = points.cell[p];
        const auto    place = search->find(points.position[p],
                                        cell == numbers::invalid_unsigned_int
                                             ? BackgroundMesh::Cell()
                                             : search->cell(cell),
                                        contacts->body_of(points.material[p]));
        if (place)
          {
            cell           = place->cell->active_cell_index();
            points.unit[p] = inside(place->unit);
            owner[p]       = search->owner(place->cell);
          }
        else if (lost.second++ == 0)
          lost.first = format("particle %u at (%s)",
                              points.id[p],
                              text_of_place(points.position[p]).c_str());
      }
    migrate(points, owner, comm);

    // By cell and number: an order independent of the history and the number of
    // ranks.
    std::vector<unsigned int> order(points.n_points());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](const auto a, const auto b) {
      return std::tie(points.cell[a], points.id[a]) <
             std::tie(points.cell[b], points.id[b]);
    });
    if (!std::is_sorted(order.begin(), order.end()))
      points.reorder(order);
    evaluate(points);
    return lost;
  }

  void
  Particles::sort(MaterialPoints &points)
  {
    const auto [which, n_here] = find_cells(points);
    const unsigned int n_now   = Utilities::MPI::sum(n_here, comm);
    n_lost_all += n_now;
    if (n_now > 0 && outflow.is_error())
      throw StepFailure(
        format("%u particles left the background mesh, e.g. ", n_now) +
        text_of_any_rank(comm, which) +
        "\n  remedy:  enlarge 'Mesh/Box', or let them go with "
        "'Particles/Outflow = count'");
  }
} // namespace geocone::GEOCONE_DIM
