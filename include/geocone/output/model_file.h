// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_model_file_h
#define geocone_output_model_file_h

#include <geocone/folder/json.h>
#include <geocone/mesh/background_mesh.h>
#include <geocone/scene/scene.h>
#include <geocone/surfaces/sides_of_body.h>

#include <array>
#include <functional>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Name of the file that describes the scene for plots of the model. */
  constexpr const char *model_file = "model.json";

  /** Mesh of a scene for plots of the model. */
  struct ModelMesh
  {
    /** Polygon in two dimensions or flat face in three dimensions, given by its
     *  vertices. */
    using Face = std::vector<dealii::Point<dim>>;

    /** Mesh cells in two dimensions, boundary faces of the mesh in three
     *  dimensions. */
    std::vector<Face> cells;

    /** Material index of each cell. Empty for particles, whose body is described by
     *  Scene::geometry. */
    std::vector<unsigned int> materials;

    /** Lower and upper corner of the bounding box of the mesh. */
    std::array<dealii::Point<dim>, 2> box;

    /** Returns the boundary faces on which a boundary condition acts. */
    std::function<std::vector<SidePart>(const BoundaryCondition &)> faces_of;
  };

  /**
   * Returns the mesh of a run for plots of the model. Collective.
   * @param of_particles whether conditions may act on the sides of the body instead
   * of the sides of the mesh
   */
  ModelMesh
  model_mesh_of(const BackgroundMesh &mesh,
                const Scene          &scene,
                const bool            of_particles);

  /** Returns a Cartesian grid with the given grid lines, for plots of the model.
   *  Boundary conditions act on its nodes. */
  ModelMesh
  model_mesh_of(const std::array<std::vector<double>, dim> &lines,
                const Scene                                &scene);

  /**
   * Returns a description of the scene before the first step as a JSON object
   * (m, m/s, Pa). The description contains the body and its materials, the
   * mesh, supports, tractions, obstacles, observed points and the changes in
   * each stage. A prescribed value is the largest at a few sampled times of the
   * loading programme.
   */
  Json
  model_of(const Scene &scene, const ModelMesh &mesh);
} // namespace geocone::GEOCONE_DIM

#endif
