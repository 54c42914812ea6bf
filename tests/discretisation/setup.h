// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef tests_discretisation_setup_h
#define tests_discretisation_setup_h

#include <geocone/base/version.h>
#include <geocone/points/particles.h>

#include <deal.II/base/mpi.h>

#include <cstdio>

namespace discretisation_tests
{
  namespace mpi = dealii::Utilities::MPI;

  const MPI_Comm comm = MPI_COMM_WORLD;

  /** Scene, mesh, space and seeding of a parameter file with overrides. */
  struct Setup
  {
    Setup(const std::string              &file_name,
          const std::vector<std::string> &overrides)
      : file((dealii::ParameterAcceptor::clear(),
              GEOCONE_SOURCE_DIR "/tests/" + file_name),
             overrides)
      , scene(file)
      , mesh(comm)
      , particles(file)
    {}

    /** @param may_divide false: each rank stores the whole mesh */
    void
    prepare(const bool may_divide = false)
    {
      file.parse();
      scene.prepare();
      mesh.prepare(scene, method, may_divide);
      space.prepare(mesh, method);
    }

    geocone::ParameterFile  file;
    geocone::Method         method;
    geocone::Scene          scene;
    geocone::BackgroundMesh mesh;
    geocone::Space          space;
    geocone::Particles      particles;
  };

  inline bool
  speaks()
  {
    return mpi::this_mpi_process(comm) == 0;
  }

  /** Prints a verdict on what must hold on all ranks. Collective. */
  inline void
  print(const std::string &what, const bool holds)
  {
    const bool all = mpi::min(holds ? 1 : 0, comm) == 1;
    if (speaks())
      std::printf("  %s: %s\n", what.c_str(), all ? "yes" : "NO");
  }
} // namespace discretisation_tests

#endif
