// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/parameter_file.h>
#include <geocone/surfaces/face_points.h>
#include <geocone/terms/absorbing_boundary.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** @throws InputError for a law without constant wave speeds */
    void
    check_constant_stiffness(const Materials &materials)
    {
      for (unsigned int m = 0; m < materials.size(); ++m)
        if (const auto *law = dynamic_cast<const Material *>(&materials.law(m));
            law == nullptr || !law->has_constant_stiffness())
          throw InputError(
            "Materials/" + materials.name(m) + "/Type",
            ParameterFile::value("Materials/" + materials.name(m) + "/Type"),
            "a law of constant stiffness where a side absorbs "
            "waves",
            "take linear elastic without a formula, or leave out 'Absorbing "
            "boundaries/Names'");
    }

    /** Dashpots of nodes, summed over faces and ranks. */
    class DashpotSums
    {
    public:
      explicit DashpotSums(const Space &space)
        : diagonal(space.partitioner())
        , beside(space.partitioner())
      {}

      /** Adds the dashpots of a law at a point of a face. */
      void
      add(const Material &law, const double rho, const FacePoint &point)
      {
        const Elasticity &e = law.elasticity();
        const double      of_p =
          std::sqrt(rho * (e.lambda + e.two_G + law.fluid_modulus()));
        const double of_s = std::sqrt(rho * e.two_G / 2.);
        for (unsigned int i = 0; i < point.nodes.size(); ++i)
          {
            const double       w   = point.weight * point.values[i];
            const auto        &n   = point.normal;
            const unsigned int dof = dim * point.nodes[i];
            for (unsigned int d = 0; d < dim; ++d)
              diagonal.local_element(dof + d) +=
                w * (of_s + (of_p - of_s) * n[d] * n[d]);
            for (unsigned int r = 0; r < n_rotations; ++r)
              {
                const auto [a, b] = plane_of_rotation[r];
                beside.local_element(dof + r) +=
                  w * (of_p - of_s) * n[a] * n[b];
              }
          }
      }

      void
      compress()
      {
        diagonal.compress(VectorOperation::add);
        beside.compress(VectorOperation::add);
      }

      bool
      has(const unsigned int node) const
      {
        return diagonal.local_element(dim * node) > 0.;
      }

      Tensor<2, dim>
      of_node(const unsigned int node) const
      {
        Tensor<2, dim> C;
        for (unsigned int d = 0; d < dim; ++d)
          C[d][d] = diagonal.local_element(dim * node + d);
        for (unsigned int r = 0; r < n_rotations; ++r)
          {
            const auto [a, b] = plane_of_rotation[r];
            C[a][b] = C[b][a] = beside.local_element(dim * node + r);
          }
        return C;
      }

    private:
      Vector diagonal, beside; ///< off-diagonals in the order of rotations
    };
  } // namespace

  AbsorbingBoundary::AbsorbingBoundary(const Scene          &scene,
                                       const BackgroundMesh &mesh,
                                       const Space          &space,
                                       const MaterialPoints *body)
    : conditions(scene.absorbing)
    , space(space)
  {
    if (!exists())
      return;
    check_constant_stiffness(scene.materials);
    // From the points in the cells, since stages may have changed the soil.
    constexpr unsigned int    none = numbers::invalid_unsigned_int;
    std::vector<unsigned int> of_cell;
    if (body != nullptr)
      {
        of_cell.assign(mesh.triangulation().n_active_cells(), none);
        for (unsigned int c = 0; c < body->n_cells(); ++c)
          of_cell[body->cells[c]->active_cell_index()] =
            body->material[body->first_point[c]];
      }
    const auto material_at = [&](const BackgroundMesh::Cell &cell,
                                 const FacePoint            &point) {
      if (body != nullptr)
        return of_cell[cell->active_cell_index()];
      // Evaluated inside the body, not on its boundary. Other bodies do not
      // matter here.
      const unsigned int material = scene.regions.material_at(
        point.position - 1e-6 * cell->diameter() * point.normal);
      return scene.contacts.body_of(material) == mesh.layer_of(cell) ? material
                                                                     : none;
    };
    incoming.reinit(space.partitioner());
    for (unsigned int c = 0; c < conditions.list.size(); ++c)
      {
        DashpotSums        sums(space);
        const unsigned int n_faces = for_each_face_point(
          mesh,
          space,
          *conditions.list[c],
          [&](const BackgroundMesh::Cell &cell, const FacePoint &point) {
            const unsigned int material = material_at(cell, point);
            if (material == none)
              return;
            sums.add(scene.materials[material],
                     scene.density(material, point.position),
                     point);
          });
        refuse_no_face(*conditions.list[c],
                       n_faces,
                       mesh.triangulation().get_communicator(),
                       "this side absorbs nothing");
        sums.compress();
        for (unsigned int node = 0; node < space.n_owned_nodes(); ++node)
          if (sums.has(node))
            dashpots.push_back({node, c, sums.of_node(node)});
      }
  }

  void
  AbsorbingBoundary::check(const Unknowns &unknowns) const
  {
    if (!exists())
      return;
    bool turned = false;
    for (const Unknowns::TurnedNode &node : unknowns.turned_nodes)
      for (const Dashpot &dashpot : dashpots)
        turned = turned || dashpot.node == node.node;
    if (Utilities::MPI::max(int(turned),
                            space.partitioner()->get_mpi_communicator()) > 0)
      throw InputError(conditions.list[0]->parameter("Sides"),
                       conditions.list[0]->part(),
                       "sides that do not touch one that is held obliquely",
                       "leave out the last node by a Box, or hold that side by "
                       "Velocity x and y");
  }

  void
  AbsorbingBoundary::begin_step(const double t, const Unknowns &of_problem)
  {
    unknowns = &of_problem;
    incoming_force(t, incoming);
  }

  void
  AbsorbingBoundary::incoming_force(const double t, Vector &force) const
  {
    force = 0.;
    for (const Dashpot &dashpot : dashpots)
      {
        Tensor<1, dim> v_in;
        for (unsigned int d = 0; d < dim; ++d)
          if (const auto &component =
                conditions.list[dashpot.condition]->components[d])
            v_in[d] = component->value(space.node_positions()[dashpot.node], t);
        const Tensor<1, dim> of_node = 2. * (dashpot.C * v_in);
        for (unsigned int d = 0; d < dim; ++d)
          force.local_element(dim * dashpot.node + d) += of_node[d];
      }
  }

  void
  AbsorbingBoundary::add_product(Vector &dst, const Vector &x) const
  {
    for (const Dashpot &dashpot : dashpots)
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int b = 0; b < dim; ++b)
          dst.local_element(dim * dashpot.node + a) +=
            dashpot.C[a][b] * x.local_element(dim * dashpot.node + b);
  }

  void
  AbsorbingBoundary::residual(Vector &part, const Vector &v, const LocalLaw &)
  {
    part = 0.;
    part.add(-1., incoming);
    add_product(part, v);
  }

  void
  AbsorbingBoundary::linearise(const JacobianPattern &pattern,
                               const double,
                               SparseMatrix &matrix) const
  {
    for (const Dashpot &dashpot : dashpots)
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int b = 0; b < dim; ++b)
          {
            const int row    = unknowns->free_row[dim * dashpot.node + a],
                      column = unknowns->free_row[dim * dashpot.node + b];
            if (row >= 0 && column >= 0 && dashpot.C[a][b] != 0.)
              pattern.add_entry(row, column, dashpot.C[a][b], matrix);
          }
  }

  void
  AbsorbingBoundary::apply_tangent(Vector &dst, const Vector &dv) const
  {
    add_product(dst, dv);
  }

  void
  AbsorbingBoundary::add_elastic_diagonal(Vector &dst) const
  {
    for (const Dashpot &dashpot : dashpots)
      for (unsigned int d = 0; d < dim; ++d)
        dst.local_element(dim * dashpot.node + d) += dashpot.C[d][d];
  }

  double
  AbsorbingBoundary::power(const Vector &v) const
  {
    Vector force = incoming;
    force *= -1.;
    add_product(force, v);
    return -(force * v);
  }
} // namespace geocone::GEOCONE_DIM
