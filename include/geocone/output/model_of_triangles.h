// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_model_of_triangles_h
#define geocone_output_model_of_triangles_h

#include <geocone/mesh/triangles.h>
#include <geocone/output/model_file.h>

namespace geocone::GEOCONE_DIM
{
  /** Returns a triangle mesh for plots of the model. @param triangles must
   *  outlive the mesh */
  ModelMesh
  model_mesh_of(const Triangles &triangles);
} // namespace geocone::GEOCONE_DIM

#endif
