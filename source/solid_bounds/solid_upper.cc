// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/bounds/held_bodies.h>
#include <geocone/solid_bounds/solid_points.h>

#include <memory>

namespace geocone::GEOCONE_DIM
{
  using dealii::Tensor;

  namespace
  {
    using Faces    = PointGroupOf<FaceCone, 6>;
    using CutFaces = PointGroupOf<CutMohrCoulombCones, 6>;
    using Planes   = PointGroupOf<OpeningCone, 6>;

    /** Unbounded normal stress of a plane that soil cannot leave: the jump vanishes. */
    OpeningCone
    closed_cone()
    {
      OpeningCone law;
      law.A(0, 0)        = 0.;
      law.o[0]           = 1.;
      law.null_vector[0] = 1.;
      law.finish();
      return law;
    }

    /** Dofs of the velocities of cells and of the bodies that hold facets. */
    class VelocityDofs
    {
    public:
      VelocityDofs(const SolidScene &bound, const unsigned int order)
        : n_nodes(simplex_nodes::n_in_cell(order))
        , bodies(dim * n_nodes * bound.tetrahedra->cells.size())
      {
        for (const FacetCondition &held : bound.facet_conditions)
          bodies.add(held);
      }

      unsigned int
      of_node(const unsigned int cell, const unsigned int node) const
      {
        return dim * (n_nodes * cell + node);
      }

      const unsigned int n_nodes;
      HeldBodies         bodies;
    };

    /** Points of the jumps of velocity at facets. Each has six dofs, those of both
     *  sides. */
    class JumpPoints
    {
    public:
      using Dofs = std::array<unsigned int, 6>;
      using Axes = std::array<Tensor<1, dim>, dim>;

      explicit JumpPoints(const std::vector<SpatialStrength> &strengths)
        : strengths(strengths)
      {
        std::vector<FaceCone>            of_faces;
        std::vector<CutMohrCoulombCones> of_cut_faces;
        for (const SpatialStrength &one : strengths)
          if (one.is_cut())
            {
              number.push_back(of_cut_faces.size());
              of_cut_faces.push_back(cut_law(one));
            }
          else
            {
              number.push_back(of_faces.size());
              of_faces.push_back(face_cone(one.face_friction()));
            }
        faces     = std::make_unique<Faces>(of_faces);
        cut_faces = std::make_unique<CutFaces>(of_cut_faces);
        planes    = std::make_unique<Planes>(
          std::vector<OpeningCone>{opening_cone(), closed_cone()});
      }

      /** Adds a jump within soil. @param k cohesion of the facet */
      void
      add_in_soil(const unsigned int material,
                  const Axes        &axes,
                  const Dofs        &dofs,
                  const double       weight,
                  const double       k)
      {
        const SpatialStrength &one = strengths[material];
        if (one.is_cut())
          {
            CutFaces::Strains B; // of a thin layer
            for (unsigned int d = 0; d < dim; ++d)
              {
                B.col(dim + d) = symmetric_product(d, axes[0]);
                B.col(d)       = -B.col(dim + d);
              }
            cut_faces->add(B, dofs, weight, number[material], one.k);
            return;
          }
        Faces::Strains B;
        for (unsigned int row = 0; row < dim; ++row)
          for (unsigned int d = 0; d < dim; ++d)
            {
              B(row, d)       = -axes[row][d];
              B(row, dim + d) = axes[row][d];
            }
        faces->add(B, dofs, weight, number[material], k);
      }

      /** Adds an opening at a smooth plane. @param tension tensile strength */
      void
      add_opening(const Tensor<1, dim> &normal,
                  const Dofs           &dofs,
                  const double          weight,
                  const double          tension)
      {
        planes->add(normal_jump(normal), dofs, weight, 0, tension);
      }

      /** Adds a smooth plane that soil cannot leave. */
      void
      add_closed(const Tensor<1, dim> &normal,
                 const Dofs           &dofs,
                 const double          weight)
      {
        planes->add(normal_jump(normal), dofs, weight, 1, 1.);
      }

      void
      move_to(ConicProblem &problem)
      {
        if (faces->n_points() > 0)
          problem.groups.push_back(std::move(faces));
        if (cut_faces->n_points() > 0)
          problem.groups.push_back(std::move(cut_faces));
        if (planes->n_points() > 0)
          problem.groups.push_back(std::move(planes));
      }

    private:
      static Planes::Strains
      normal_jump(const Tensor<1, dim> &normal)
      {
        Planes::Strains B;
        for (unsigned int d = 0; d < dim; ++d)
          {
            B(0, d)       = -normal[d];
            B(0, dim + d) = normal[d];
          }
        return B;
      }

      const std::vector<SpatialStrength> &strengths;
      std::vector<unsigned int>           number; ///< of the law of a material
      std::unique_ptr<Faces>              faces;
      std::unique_ptr<CutFaces>           cut_faces;
      std::unique_ptr<Planes>             planes;
    };

    /** Tractions of a facet of the dead or the live load. */
    std::array<Tensor<1, dim>, 3>
    part_of(const std::array<SolidScene::Load, 3> &tractions, const bool live)
    {
      std::array<Tensor<1, dim>, 3> part;
      for (unsigned int i = 0; i < 3; ++i)
        part[i] = live ? tractions[i].live : tractions[i].dead;
      return part;
    }

    /** Adds the strain rates of a cell, and its weight. */
    void
    add_rates(const SolidScene   &bound,
              const unsigned int  order,
              const unsigned int  cell,
              const VelocityDofs &velocities,
              SolidPoints        &points,
              ConicProblem       &problem)
    {
      const Tetrahedra  &tetrahedra = *bound.tetrahedra;
      const double       L          = bound.units.length;
      const unsigned int n_nodes    = simplex_nodes::n_in_cell(order);
      const auto         g          = tetrahedra.gradients(cell);
      const double       V          = tetrahedra.volume(cell) / (L * L * L);
      const auto         k          = strength_of_rates(bound, order, cell);
      for (unsigned int i = 0; i < k.size(); ++i)
        {
          // The gradient at vertex i is 2 sum_j v_ij x g_j.
          SolidPoints::Strains         B;
          std::array<unsigned int, 12> dofs;
          for (unsigned int j = 0; j < 4; ++j)
            for (unsigned int d = 0; d < dim; ++d)
              {
                B.col(dim * j + d) = order * L * symmetric_product(d, g[j]);
                dofs[dim * j + d] =
                  velocities.of_node(
                    cell, order == 1 ? j : simplex_nodes::node(i, j)) +
                  d;
              }
          points.add(tetrahedra.material[cell], B, dofs, V / k.size(), k[i]);
        }
      for (unsigned int i = 0; i < n_nodes; ++i)
        add_load(problem,
                 velocities.of_node(cell, i),
                 V / n_nodes * bound.body_force(cell));
    }

    /** Adds the jumps at an inner or a held facet; prescribes velocities at a plane
     *  that soil without tensile strength cannot leave. */
    void
    add_jumps(const SolidScene   &bound,
              const unsigned int  order,
              const unsigned int  f,
              const VelocityDofs &velocities,
              JumpPoints         &jumps,
              ConicProblem       &problem)
    {
      const Tetrahedra     &tetrahedra = *bound.tetrahedra;
      const auto           &facet      = tetrahedra.facets[f];
      const FacetCondition &held       = bound.facet_conditions[f];
      const bool            is_inner   = facet.cells[1] != Tetrahedra::none,
                 is_plane = held.kind == FacetCondition::Kind::plane;
      if (!is_inner && held.kind == FacetCondition::Kind::free)
        return;
      const double L      = bound.units.length;
      const auto   axes   = axes_of_facet(tetrahedra, f);
      const auto   first  = nodes_in_cell(tetrahedra, order, f, 0);
      const auto   second = is_inner ? nodes_in_cell(tetrahedra, order, f, 1)
                                     : std::vector<unsigned int>();
      const unsigned int material = tetrahedra.material[cell_of_jump(bound, f)];
      const SpatialStrength &one  = bound.strengths[material];
      const auto             k    = strength_of_jumps(bound, order, f);
      const double           mu   = one.face_friction(),
                   weight         = tetrahedra.area(f) / (L * L) / first.size();
      for (unsigned int i = 0; i < first.size(); ++i)
        {
          const unsigned int a = velocities.of_node(facet.cells[0], first[i]),
                             b = is_inner ? velocities.of_node(facet.cells[1],
                                                               second[i])
                                          : velocities.bodies.dof_of(held);
          const bool is_closed = is_plane && mu == 0. && !one.is_cut();
          if (is_closed && !held.is_oblique())
            {
              problem.is_prescribed[a + held.axis] = true;
              problem.prescribed[a + held.axis]    = held.velocity[held.axis];
              continue;
            }
          JumpPoints::Dofs dofs;
          for (unsigned int d = 0; d < dim; ++d)
            {
              dofs[d]       = a + d;
              dofs[dim + d] = b + d;
            }
          if (is_closed)
            jumps.add_closed(axes[0], dofs, weight);
          else if (is_plane)
            jumps.add_opening(
              axes[0], dofs, weight, one.is_cut() ? one.tension : k[i] / mu);
          else
            jumps.add_in_soil(material, axes, dofs, weight, k[i]);
        }
    }

    /** Adds the tractions of a boundary facet to the forces of the velocities. */
    void
    add_tractions(const SolidScene   &bound,
                  const unsigned int  order,
                  const unsigned int  f,
                  const VelocityDofs &velocities,
                  ConicProblem       &problem)
    {
      const Tetrahedra &tetrahedra = *bound.tetrahedra;
      const double L = bound.units.length, A = tetrahedra.area(f) / (L * L);
      const auto   nodes      = nodes_in_cell(tetrahedra, order, f, 0);
      const unsigned int cell = tetrahedra.facets[f].cells[0];
      for (const bool is_live : {false, true})
        {
          auto      &load = is_live ? problem.live : problem.dead;
          const auto forces =
            forces_of_traction(order, part_of(bound.tractions(f), is_live));
          for (unsigned int i = 0; i < nodes.size(); ++i)
            for (unsigned int d = 0; d < dim; ++d)
              load[velocities.of_node(cell, nodes[i]) + d] += A * forces[i][d];
        }
    }
  } // namespace

  ConicProblem
  upper_problem(const SolidScene &bound, const unsigned int order)
  {
    const Tetrahedra  &tetrahedra = *bound.tetrahedra;
    const VelocityDofs velocities(bound, order);
    ConicProblem problem = ConicProblem::of_dofs(velocities.bodies.n_dofs());
    problem.least_start        = bound.units.is_of_loads ? 0.1 : 0.;
    velocities.bodies.prescribe(problem);
    SolidPoints points = empty_points(bound);
    for (unsigned int c = 0; c < tetrahedra.cells.size(); ++c)
      add_rates(bound, order, c, velocities, points, problem);
    JumpPoints jumps(bound.strengths);
    for (unsigned int f = 0; f < tetrahedra.facets.size(); ++f)
      {
        add_jumps(bound, order, f, velocities, jumps, problem);
        if (tetrahedra.facets[f].cells[1] == Tetrahedra::none)
          add_tractions(bound, order, f, velocities, problem);
      }
    points.move_to(problem);
    jumps.move_to(problem);
    return problem;
  }
} // namespace geocone::GEOCONE_DIM
