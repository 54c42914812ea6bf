// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mesh_divided_mesh_h
#define geocone_mesh_divided_mesh_h

#include <geocone/mesh/coarse_mesh.h>

#include <deal.II/base/mpi.h>

#include <deal.II/distributed/fully_distributed_tria.h>

#include <memory>

namespace geocone::GEOCONE_DIM
{
  /** Boundary id of the faces of ghost cells behind which this rank stores no
   *  cell. No side has it. */
  constexpr dealii::types::boundary_id end_of_ghost_cells =
    dealii::numbers::invalid_boundary_id - 1;

  /**
   * Creates the triangulation of which each rank stores its own cells and
   * their vertex neighbours only. The rank of each cell is determined by METIS.
   * The numbers of the coarse cells, and thus all CellId, are those of the
   * whole mesh. Collective.
   * @param mesh whole mesh on the first rank; not used on the others
   */
  std::unique_ptr<dealii::parallel::fullydistributed::Triangulation<dim>>
  divided_mesh(const CoarseMesh &mesh, const MPI_Comm comm);
} // namespace geocone::GEOCONE_DIM

#endif
