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
   * The triangulation, distributed over the ranks, with its mapping, material
   * ids (indices into Scene::materials) and side ids.
   *
   * Quadrilaterals and hexahedra live on parallel::distributed::Triangulation (p4est);
   * simplices, which p4est does not know, on parallel::shared::Triangulation,
   * where every rank stores the whole mesh and owns a part of it.
   *
   * Bodies of particles that touch each other have a layer each: the same mesh once
   * more, in the same place, so that the particles of each body move nodes of their
   * own. This is stored on parallel::shared::Triangulation, too.
   */
  class BackgroundMesh : public dealii::ParameterAcceptor
  {
  public:
    BackgroundMesh(const MPI_Comm comm);

    /** What a mesh will be, as far as parameters tell. */
    struct Expected
    {
      double n_cells;
      std::array<double, dim>
                  intervals; ///< of a grid; else their product counts
      double      area;      ///< that the cells cover (m^2)
      bool        is_simplicial, is_grid;
      std::string parameter; ///< that the number comes from
    };

    /** Without creating the mesh; of a file, from its size, or after prepare() from
     *  what it held. @throws InputError as prepare() */
    Expected
    expect(const Scene &scene, const Method &method);

    /** Of a mesh "from the bounds": who finds its sizes, which this room does not
     *  know. To be called before prepare(). Collective. @throws InputError */
    using SizesOf = std::function<CellSizes(const MeshParameters &)>;
    void
    take_sizes(const SizesOf &sizes_of,
               const Scene   &scene,
               const Method  &method);

    /** Creates the mesh. @throws InputError */
    void
    prepare(const Scene &scene, const Method &method);

    /**
     * The lines of a uniform grid of rectangles, without creating the mesh;
     * nothing if the mesh is another one. @throws InputError as prepare()
     */
    std::array<std::vector<double>, dim>
    uniform_lines(const Scene &scene, const Method &method);

    using Cell = dealii::Triangulation<dim>::active_cell_iterator;

    /** The side of a square, or of the half of one, with a cell's area, or of a cube or
     *  a sixth of one with its volume (m). */
    static double
    size_of(const Cell &cell)
    {
      const bool   is_simplex = cell->n_vertices() == dim + 1;
      const double parts      = !is_simplex ? 1. : dim == 2 ? 2. : 6.;
      return length_of(cell->measure() * parts);
    }

    /** The cells of this rank, one after another. */
    auto
    own_cells() const
    {
      return dealii::filter_iterators(
        tria->active_cell_iterators(),
        dealii::IteratorFilters::LocallyOwnedCell());
    }

    /** The rank that has each cell, also of those of other ranks, by the active
     *  cell index. */
    const std::vector<unsigned int> &
    owner_of_cell() const
    {
      return owners;
    }

    /** Parts the cells anew between the ranks, so that the sums of their weights are
     *  about equal. @param weight > 0 of a cell that this rank has. Collective. */
    void
    repartition(const std::function<unsigned int(const Cell &)> &weight);

    /** Whether a cell, of this rank or beside it, is one of those that the ranks give,
     *  each of its own; by the active cell index. Collective. */
    std::vector<bool>
    is_among(const std::vector<Cell> &cells) const;

    /** Whether x is the radius of a round body. */
    bool
    is_axisymmetric() const
    {
      return symmetry == Geometry::Symmetry::axisymmetric;
    }

    /** Geometry::measure() */
    double
    measure(const dealii::Point<dim> &x) const
    {
      return Geometry::measure(symmetry, x);
    }

    /** Part of a cell's size by which a point may lie outside of it. */
    static constexpr double tolerance = 1e-8;

    /** Unit coordinates of x in a cell, or nothing if it is neither there nor on
     *  the border, but for the tolerance. */
    std::optional<dealii::Point<dim>>
    unit_point(const Cell &cell, const dealii::Point<dim> &x) const;

    /** Coordinates of the lines of a tensor grid; empty for other meshes. */
    const std::array<std::vector<double>, dim> &
    grid() const
    {
      return lines;
    }

    /** Moves the lines of a tensor grid, of which there are as many as before. */
    void
    move_grid(const std::array<std::vector<double>, dim> &to);

    /** The column and the row of a cell of a tensor grid. */
    std::array<unsigned int, dim>
    place_in_grid(const Cell &cell) const;

    /** Whether it is parted between bodies that touch: each rank knows all of it. */
    bool
    is_parted() const
    {
      return parted;
    }

    /** How many layers there are, one after another: of particles one for each body,
     *  otherwise 1. */
    unsigned int
    n_layers() const
    {
      return layers;
    }

    /** The layer of a cell, counted from 0. */
    unsigned int
    layer_of(const Cell &cell) const
    {
      return cell->active_cell_index() / (tria->n_active_cells() / layers);
    }

    /** The cell in the same place of another layer; also of another rank. */
    Cell
    twin(const Cell &cell, const unsigned int layer) const
    {
      const int n = tria->n_active_cells() / layers;
      return Cell(tria.get(), 0, cell->index() % n + int(layer) * n);
    }

    /** The box of all vertices, of all ranks. */
    dealii::BoundingBox<dim>
    bounding_box() const;

    /** Its lowest coordinates. */
    dealii::Point<dim>
    lower_corner() const
    {
      return bounding_box().get_boundary_points().first;
    }

    /** Inverse of the Jacobian dx/dxi at a unit point of a cell. */
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
     * The side ids of a condition.
     * @throws InputError for a name that no side has
     */
    std::set<dealii::types::boundary_id>
    side_ids(const BoundaryCondition &condition) const;

    /** The vertices of each face on the sides of a condition, of all ranks: in the plane
     *  the body is on the left, in space they are counterclockwise as seen from outside.
     *  Collective. @throws InputError for a name that no side has */
    std::vector<std::vector<dealii::Point<dim>>>
    faces_of(const BoundaryCondition &condition) const;

    /**
     * The connected part of the body (counted from 0) to which each vertex of
     * the triangulation belongs; parts that share no edge are not connected.
     * @param cells that there are of the body on this rank. Collective.
     */
    std::vector<unsigned int>
    connected_parts(const std::vector<Cell> &cells) const;

  private:
    /** Finds out which rank has which cell. Collective. */
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
