// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_model_of_tetrahedra_h
#define geocone_output_model_of_tetrahedra_h

#include <geocone/mesh/tetrahedra.h>
#include <geocone/output/model_file.h>

namespace geocone::GEOCONE_DIM
{
  /** Returns the boundary facets of a tetrahedral mesh for plots of the model.
   *  @param tetrahedra must outlive the mesh */
  ModelMesh
  model_mesh_of(const Tetrahedra &tetrahedra);
} // namespace geocone::GEOCONE_DIM

#endif
