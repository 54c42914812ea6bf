// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_run_run_estimate_h
#define geocone_run_run_estimate_h

#include <geocone/linear/linear_solver.h>
#include <geocone/mesh/background_mesh.h>
#include <geocone/output/output_base.h>
#include <geocone/points/seeding.h>
#include <geocone/scene/scene.h>

#include <string>

namespace geocone::GEOCONE_DIM
{
  /**
   * Estimated size of a run (numbers of cells, unknowns and points; memory;
   * files), computed from the parameters before any data are allocated. The
   * estimate is printed; runs that would exceed the memory are rejected.
   *
   * Nodes per cell: 1/2, 2, 9/2 for P1, P2, P3 (each vertex has six triangles), p^2 for
   * Q1 to Q3, 1 for splines. Memory, as measured (doc/performance.md): implicit runs 160
   * MB, 1.5 kB per unknown, 0.06 kB per entry of the matrix with its factors, and 1 kB
   * per point plus 0.1 kB per node of the cell of the point; explicit runs 80 MB, 280
   * bytes per point and 200 bytes per node.
   */
  struct RunEstimate
  {
    double      cells = 0., unknowns = 0., points = 0., steps = 0., files = 0.;
    double      memory     = 0.; ///< memory of all ranks (bytes)
    double      file_bytes = 0.;
    std::string driver; ///< parameter that determines most of the memory

    /** One-line summary of the estimate. */
    std::string
    text() const;

    /**
     * Rejects runs that exceed the available memory or the range of integers.
     * @param force allows runs that need more than the available memory
     * @throws InputError, with the driver, if a count exceeds the range of its integer
     * type, or the memory exceeds the available memory
     */
    void
    check(const bool force) const;
  };

  /**
   * Estimates the numbers of cells, unknowns and points of a run, its memory
   * consumption and the size of its files. The scene and the method must be
   * prepared; this function prepares the seeding.
   * @param seeding of the particles, or nullptr for FEM
   * @param linear_solver of implicit steps, or nullptr for explicit ones
   */
  RunEstimate
  estimate_run(const Scene                  &scene,
               const Method                 &method,
               BackgroundMesh               &mesh,
               Seeding                      *seeding,
               const FieldsAsked            &fields,
               const LinearSolverParameters *linear_solver = nullptr);
} // namespace geocone::GEOCONE_DIM

#endif
