// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mesh_background_mesh_h
#define geocone_mesh_background_mesh_h

#include <geocone/base/choice.h>
#include <geocone/mesh/fitted_mesh.h>
#include <geocone/scene/scene.h>

#include <deal.II/base/bounding_box.h>

#include <deal.II/distributed/tria_base.h>

#include <deal.II/fe/mapping.h>

#include <deal.II/grid/filtered_iterator.h>

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Mesh distributed over the ranks, with its mapping, material ids (indices
   * into Scene::materials) and side ids.
   *
   * Quadrilaterals and hexahedra use parallel::distributed::Triangulation
   * (p4est); simplices, which p4est does not support, use
   * parallel::shared::Triangulation, where every rank stores the complete mesh
   * and owns a part of it.
   *
   * Particle bodies in contact have one layer each: a copy of the mesh at the
   * same position, so that the particles of each body move separate nodes. Such
   * meshes also use parallel::shared::Triangulation.
   */
  class BackgroundMesh : public dealii::ParameterAcceptor
  {
  public:
    BackgroundMesh(const MPI_Comm comm);

    /** Expected number and area of cells, as far as the parameters determine
     *  them. */
    struct Expected
    {
      double n_cells;
      std::array<double, dim>
                  intervals; ///< of a grid; otherwise only the product is used
      double      area;      ///< total area of the cells (m^2)
      bool        is_simplicial, is_grid;
      std::string parameter; ///< that determines the number of cells
    };

    /** Estimates the number of cells without creating the mesh: for a file,
     *  from its size or, after prepare(), from its content. @throws InputError
     *  as prepare() */
    Expected
    expect(const Scene &scene, const Method &method);

    /** Sets the function that computes the cell sizes of a mesh of type "from
     *  the bounds" by limit analysis. To be called before prepare(); this module
     *  does not include limit analysis. Collective. @throws InputError */
    using SizesOf = std::function<CellSizes(const MeshParameters &)>;
    void
    take_sizes(const SizesOf &sizes_of,
               const Scene   &scene,
               const Method  &method);

    /** Creates the mesh. @throws InputError */
    void
    prepare(const Scene &scene, const Method &method);

    /**
     * Coordinates of the grid lines of a uniform grid of rectangles, without
     * creating the mesh; empty for other meshes (m). @throws InputError as
     * prepare()
     */
    std::array<std::vector<double>, dim>
    uniform_lines(const Scene &scene, const Method &method);

    using Cell = dealii::Triangulation<dim>::active_cell_iterator;

    /** Equivalent cell size: side length of a square (in three dimensions, a
     *  cube) of the area (volume) of the cell; for simplices, of twice the area
     *  (six times the volume) (m). */
    static double
    size_of(const Cell &cell)
    {
      const bool   is_simplex = cell->n_vertices() == dim + 1;
      const double parts      = !is_simplex ? 1. : dim == 2 ? 2. : 6.;
      return length_of(cell->measure() * parts);
    }

    /** Iterates over the cells of this rank. */
    auto
    own_cells() const
    {
      return dealii::filter_iterators(
        tria->active_cell_iterators(),
        dealii::IteratorFilters::LocallyOwnedCell());
    }

    /** Rank that owns each cell of the mesh, by active cell index. */
    const std::vector<unsigned int> &
    owner_of_cell() const
    {
      return owners;
    }

    /** Redistributes the cells over the ranks, so that the sum of cell weights
     *  per rank is about equal. Collective. @param weight positive weight of a
     *  cell of this rank */
    void
    repartition(const std::function<unsigned int(const Cell &)> &weight);

    /** Marks the cells in the union over all ranks of the given lists of owned
     *  cells, by active cell index, for owned and ghost cells. Collective. */
    std::vector<bool>
    is_among(const std::vector<Cell> &cells) const;

    /** Whether the problem is axisymmetric, with x as the radius. */
    bool
    is_axisymmetric() const
    {
      return symmetry == Geometry::Symmetry::axisymmetric;
    }

    /** Factor of volume integrals in plane strain or axisymmetry, see
     *  Geometry::measure(). */
    double
    measure(const dealii::Point<dim> &x) const
    {
      return Geometry::measure(symmetry, x);
    }

    /** Tolerance of the search for points: distance from a cell, relative to
     *  the cell size, within which a point counts as inside. */
    static constexpr double tolerance = 1e-8;

    /** Unit coordinates of x in a cell; no value if x is outside of the cell by
     *  more than the tolerance. */
    std::optional<dealii::Point<dim>>
    unit_point(const Cell &cell, const dealii::Point<dim> &x) const;

    /** Coordinates of the grid lines of a tensor grid (m); empty for other
     *  meshes. */
    const std::array<std::vector<double>, dim> &
    grid() const
    {
      return lines;
    }

    /** Moves the grid lines of a tensor grid; the number of lines must not
     *  change. */
    void
    move_grid(const std::array<std::vector<double>, dim> &to);

    /** Column and row of a cell of a tensor grid. */
    std::array<unsigned int, dim>
    place_in_grid(const Cell &cell) const;

    /** Whether the mesh is split between bodies in contact; each rank then
     *  stores the complete mesh. */
    bool
    is_parted() const
    {
      return parted;
    }

    /** Number of layers: one per body for particle bodies in contact, otherwise
     *  1. */
    unsigned int
    n_layers() const
    {
      return layers;
    }

    /** Layer of a cell, counted from 0. */
    unsigned int
    layer_of(const Cell &cell) const
    {
      return cell->active_cell_index() / (tria->n_active_cells() / layers);
    }

    /** Cell at the same position in another layer, possibly owned by another
     *  rank. */
    Cell
    twin(const Cell &cell, const unsigned int layer) const
    {
      const int n = tria->n_active_cells() / layers;
      return Cell(tria.get(), 0, cell->index() % n + int(layer) * n);
    }

    /** Bounding box of all vertices, over all ranks. */
    dealii::BoundingBox<dim>
    bounding_box() const;

    /** Lowest corner of the bounding box. */
    dealii::Point<dim>
    lower_corner() const
    {
      return bounding_box().get_boundary_points().first;
    }

    /** Inverse of the Jacobian dx/dxi at a point of a cell, given in unit
     *  coordinates (1/m). */
    dealii::Tensor<2, dim>
    inverse_jacobian(const Cell &cell, const dealii::Point<dim> &unit) const;

    const dealii::parallel::TriangulationBase<dim> &
    triangulation() const
    {
      return *tria;
    }

    const dealii::Mapping<dim> &
    mapping() const
    {
      return *map;
    }

    bool
    is_simplicial() const
    {
      return simplicial;
    }

    /**
     * Ids of the sides on which a boundary condition acts.
     * @throws InputError if the mesh has no side of that name
     */
    std::set<dealii::types::boundary_id>
    side_ids(const BoundaryCondition &condition) const;

    /** Side ids by name of the side. */
    const std::map<std::string, dealii::types::boundary_id> &
    named_sides() const
    {
      return sides;
    }

    /** Vertices of each boundary face on which a condition acts, over all
     *  ranks: in the plane with the body on the left, in space counterclockwise
     *  as seen from outside. Collective. @throws InputError if the mesh has no
     *  side of a given name */
    std::vector<std::vector<dealii::Point<dim>>>
    faces_of(const BoundaryCondition &condition) const;

    /**
     * Index of the connected part of the body, counted from 0, for each vertex
     * of the mesh; parts without a common edge are not connected.
     * @param cells of the body on this rank. Collective.
     */
    std::vector<unsigned int>
    connected_parts(const std::vector<Cell> &cells) const;

  private:
    /** Determines the rank that owns each cell. Collective. */
    void
    find_owners();

    enum class Storage
    {
      automatic,
      distributed,
      shared
    };

    const MPI_Comm comm;
    MeshParameters parameters;

    Geometry::Symmetry symmetry = Geometry::Symmetry::plane_strain;

    Choice<Storage> storage = {{{"automatic", Storage::automatic},
                                {"distributed", Storage::distributed},
                                {"shared", Storage::shared}}};

    std::unique_ptr<dealii::parallel::TriangulationBase<dim>> tria;
    std::unique_ptr<dealii::Mapping<dim>>                     map;
    std::map<std::string, dealii::types::boundary_id>         sides;
    std::array<std::vector<double>, dim>                      lines;
    bool                      simplicial = false, parted = false;
    unsigned int              layers = 1;
    std::optional<CellSizes>  sizes;
    std::vector<unsigned int> owners; ///< owner_of_cell()
  };
} // namespace geocone::GEOCONE_DIM

#endif
