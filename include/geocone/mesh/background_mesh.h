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
   * Mesh distributed over the MPI ranks, with mapping, material ids and
   * boundary ids of the sides. Material ids are indices into Scene::materials.
   *
   * Finite elements use parallel::fullydistributed::Triangulation: each rank
   * stores its own cells and their vertex neighbours only. Where the whole mesh
   * is needed (particles, contact, structures, B-splines), quadrilaterals and
   * hexahedra use parallel::distributed::Triangulation (p4est), and simplices,
   * which p4est does not support, parallel::shared::Triangulation. Both store
   * all cells on every rank, since none is refined.
   *
   * Particle bodies in contact have one layer each: a copy of the mesh at the
   * same position, so that the particles of each body move separate nodes. Such
   * meshes also use parallel::shared::Triangulation.
   */
  class BackgroundMesh : public dealii::ParameterAcceptor
  {
  public:
    BackgroundMesh(const MPI_Comm comm);

    /** Estimated number and total area of the cells before the mesh is
     *  created. */
    struct Expected
    {
      double n_cells;
      std::array<double, dim>
                  intervals; ///< of a grid; otherwise only the product is used
      double      area;      ///< total area of the cells (m^2)
      bool        is_simplicial, is_grid;
      std::string parameter; ///< that determines the number of cells
    };

    /** Estimates the number of cells without creating the mesh. For a mesh
     *  file, the estimate follows from the file size or, after prepare(), from
     *  the content. @throws InputError as prepare() */
    Expected
    expect(const Scene &scene, const Method &method);

    /** Sets the function that computes cell sizes by limit analysis for the
     *  mesh type "from the bounds". To be called before prepare(); the mesh
     *  module does not include limit analysis. Collective.
     *  @throws InputError */
    using SizesOf = std::function<CellSizes(const MeshParameters &)>;
    void
    take_sizes(const SizesOf &sizes_of,
               const Scene   &scene,
               const Method  &method);

    /** Creates the mesh. @param may_divide true if the method needs own and
     *  ghost cells only, e.g. finite elements other than B-splines
     *  @throws InputError */
    void
    prepare(const Scene  &scene,
            const Method &method,
            const bool    may_divide = false);

    /** @pre prepare() */
    const MeshParameters &
    mesh_parameters() const
    {
      return parameters;
    }

    /**
     * Computes the grid line coordinates (m) of a uniform grid of rectangles
     * without creating the mesh. Empty for other meshes. @throws InputError as
     * prepare()
     */
    std::array<std::vector<double>, dim>
    uniform_lines(const Scene &scene, const Method &method);

    using Cell = dealii::Triangulation<dim>::active_cell_iterator;

    /** Equivalent cell size (m): side length of a square (or cube) with the
     *  area (or volume) of the cell. For simplices, twice the area or six times
     *  the volume is used. */
    static double
    size_of(const Cell &cell)
    {
      const bool   is_simplex = cell->n_vertices() == dim + 1;
      const double parts      = !is_simplex ? 1. : dim == 2 ? 2. : 6.;
      return side_length(cell->measure() * parts);
    }

    /** Range of the cells owned by this MPI rank, for iteration. */
    auto
    own_cells() const
    {
      return dealii::filter_iterators(
        tria->active_cell_iterators(),
        dealii::IteratorFilters::LocallyOwnedCell());
    }

    /** Owner rank of each cell that this rank stores, by active cell index. */
    const std::vector<unsigned int> &
    owner_of_cell() const
    {
      return owners;
    }

    /** Redistributes the cells over the MPI ranks such that all ranks have
     *  about the same sum of cell weights. Collective. @param weight positive
     *  weight of a cell of this rank */
    void
    repartition(const std::function<unsigned int(const Cell &)> &weight);

    /** Returns, for each active cell, whether it is in the list @p cells of at
     *  least one rank. The result includes owned and ghost cells.
     *  Collective. */
    std::vector<bool>
    marked_cells(const std::vector<Cell> &cells) const;

    /** Returns true if the problem is axisymmetric, with x as the radius. */
    bool
    is_axisymmetric() const
    {
      return symmetry == Geometry::Symmetry::axisymmetric;
    }

    /** Integration factor at a point for plane strain or axisymmetry, see
     *  Geometry::measure(). */
    double
    measure(const dealii::Point<dim> &x) const
    {
      return Geometry::measure(symmetry, x);
    }

    /** Tolerance of the point search, relative to the cell size. Points within
     *  this distance from a cell are inside the cell. */
    static constexpr double tolerance = 1e-8;

    /** Unit cell coordinates of the point x in a given cell. No value if x is
     *  outside the cell by more than the tolerance. */
    std::optional<dealii::Point<dim>>
    unit_point(const Cell &cell, const dealii::Point<dim> &x) const;

    /** Grid line coordinates of a tensor-product grid (m); empty for other
     *  meshes. */
    const std::array<std::vector<double>, dim> &
    grid() const
    {
      return lines;
    }

    /** Moves the grid lines of a tensor-product grid. The number of lines must
     *  not change. */
    void
    move_grid(const std::array<std::vector<double>, dim> &to);

    /** Column and row indices of a cell in a tensor-product grid. */
    std::array<unsigned int, dim>
    place_in_grid(const Cell &cell) const;

    /** Returns true if the mesh is split between bodies in contact. Each rank
     *  then stores the complete mesh. */
    bool
    is_split() const
    {
      return split_at_contacts;
    }

    /** Number of mesh layers (copies of the mesh): one per body for bodies of
     *  particles in contact, otherwise 1. */
    unsigned int
    n_layers() const
    {
      return layers;
    }

    /** Index of the mesh layer (copy of the mesh for one body) that contains a
     *  cell, counted from 0. */
    unsigned int
    layer_of(const Cell &cell) const
    {
      return cell->active_cell_index() / (tria->n_active_cells() / layers);
    }

    /** The coincident cell in another mesh layer (copy of the mesh for another
     *  body). The cell may be owned by another rank. */
    Cell
    cell_in_layer(const Cell &cell, const unsigned int layer) const
    {
      const int n = tria->n_active_cells() / layers;
      return Cell(tria.get(), 0, cell->index() % n + int(layer) * n);
    }

    /** Bounding box of the complete mesh, over all ranks. */
    const dealii::BoundingBox<dim> &
    bounding_box() const
    {
      return box;
    }

    /** Corner of the bounding box with the smallest coordinates. */
    dealii::Point<dim>
    lower_corner() const
    {
      return bounding_box().get_boundary_points().first;
    }

    /** Inverse Jacobian dxi/dx of the cell mapping (1/m) at a point given in
     *  unit cell coordinates. */
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
     * Boundary ids of the sides on which a boundary condition acts.
     * @throws InputError if the mesh has no side of that name
     */
    std::set<dealii::types::boundary_id>
    side_ids(const BoundaryCondition &condition) const;

    /** Boundary id of the side of a given name.
     *  @param parameter,remedy for the message
     *  @throws InputError if the mesh has no such side */
    dealii::types::boundary_id
    side_id(const std::string &name,
            const std::string &parameter,
            const std::string &remedy) const;

    /** Boundary ids of the sides, by name of the side. */
    const std::map<std::string, dealii::types::boundary_id> &
    named_sides() const
    {
      return sides;
    }

    /** Vertices of all boundary faces on which a condition acts, over all
     *  ranks. In two dimensions the body is on the left; in three dimensions
     *  the vertices are counterclockwise as seen from outside. Collective.
     *  @throws InputError if the mesh has no side of a given name */
    std::vector<std::vector<dealii::Point<dim>>>
    faces_of(const BoundaryCondition &condition) const;

    /**
     * Index of the connected component of the body that contains each cell,
     * counted from 0 over all ranks. Parts without a common edge are not
     * connected.
     * @param cells cells of the body on this rank. Collective.
     */
    std::vector<unsigned int>
    connected_parts(const std::vector<Cell> &cells) const;

  private:
    /** Creates the whole mesh. @throws InputError */
    CoarseMesh
    whole_mesh(const Scene   &scene,
               const Method  &method,
               const MPI_Comm communicator);

    /** Takes what is known of the whole mesh from the first rank. Collective.
     *  @param[in,out] n_cells of the whole mesh */
    void
    share_description(std::size_t &n_cells);

    /** @param divides whether the scene needs own and ghost cells only
     *  @throws InputError if the cells cannot be stored as they are asked to */
    void
    check_storage(const bool has_contacts, const bool divides) const;

    /** Determines the boundary ids of all sides, over all ranks. Collective. */
    void
    find_boundary_ids();

    /** Determines the rank that owns each cell. Collective. */
    void
    find_owners();

    enum class Storage
    {
      automatic,
      distributed,
      shared,
      fully_distributed
    };

    const MPI_Comm comm;
    MeshParameters parameters;

    Geometry::Symmetry symmetry = Geometry::Symmetry::plane_strain;

    Choice<Storage> storage = {
      {{"automatic", Storage::automatic},
       {"distributed", Storage::distributed},
       {"shared", Storage::shared},
       {"fully distributed", Storage::fully_distributed}}};

    std::unique_ptr<dealii::parallel::TriangulationBase<dim>> tria;
    std::unique_ptr<dealii::Mapping<dim>>                     map;
    std::map<std::string, dealii::types::boundary_id>         sides;
    std::array<std::vector<double>, dim>                      lines;
    dealii::BoundingBox<dim>                                  box;
    bool                      simplicial = false, split_at_contacts = false;
    unsigned int              layers = 1;
    std::optional<CellSizes>  sizes;
    std::vector<unsigned int> owners; ///< owner_of_cell()
    std::vector<dealii::types::boundary_id> boundary_ids; ///< of all sides
  };
} // namespace geocone::GEOCONE_DIM

#endif
