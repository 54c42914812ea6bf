// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_model_file_h
#define geocone_output_model_file_h

#include <geocone/mesh/background_mesh.h>
#include <geocone/output/json.h>
#include <geocone/scene/scene.h>
#include <geocone/surfaces/sides_of_body.h>

#include <array>
#include <functional>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Name of the file that describes the scene, for plots. */
  constexpr const char *model_file = "model.json";

  /** Mesh of a scene, for drawings. */
  struct ModelMesh
  {
    /** A polygon in the plane, or a flat face in space. */
    using Face = std::vector<dealii::Point<dim>>;

    /** Cells (two dimensions) or boundary faces of the mesh (three dimensions). */
    std::vector<Face> cells;

    /** Index of the material of each cell; empty for particles, whose body is
     *  described by Scene::geometry. */
    std::vector<unsigned int> materials;

    /** Corners of the bounding box. */
    std::array<dealii::Point<dim>, 2> box;

    /** Returns the boundary faces on which a condition acts. */
    std::function<std::vector<SidePart>(const BoundaryCondition &)> faces_of;
  };

  /**
   * Mesh of a run, for drawings. Collective.
   * @param of_particles whether conditions may act on the sides of the body instead
   * of the sides of the mesh
   */
  ModelMesh
  model_mesh_of(const BackgroundMesh &mesh,
                const Scene          &scene,
                const bool            of_particles);

  /** Uniform grid with the given grid lines, and boundary conditions on its nodes. */
  ModelMesh
  model_mesh_of(const std::array<std::vector<double>, dim> &lines,
                const Scene                                &scene);

  /**
   * Describes a scene before its first step (m, m/s, Pa): the body and its
   * materials, the mesh, supports, tractions, obstacles, observed points and the
   * changes in each stage. A prescribed value is the largest at a few sampled times
   * of the loading programme.
   */
  Json
  model_of(const Scene &scene, const ModelMesh &mesh);
} // namespace geocone::GEOCONE_DIM

#endif
