// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Files of particles that are damaged: each must be read or refused.

#include <geocone/base/hdf5_file.h>
#include <geocone/points/particle_file.h>

#include "../damage.h"
#include "../test.h"

#include <deal.II/base/mpi.h>

namespace particles_damaged_files_01
{
  using namespace geocone;

  void
  test(int argc, char **argv)
  {
    dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
    const ParameterFile                      file = ParameterFile::from_text(
      "subsection Materials\nset Names = clay, sand\nend", "test", {});
    const Materials materials(file);

    std::ofstream csv("whole.csv");
    csv << "x,y,volume,material,vx,vy,sxx,syy,sxy\n";
    const std::vector<std::string> names = {
      "x", "y", "volume", "vx", "vy", "sxx", "syy", "sxy"};
    for (unsigned int i = 0; i < 40; ++i)
      csv << i << ",0.5,1e-3," << (i % 2 == 0 ? "sand" : "0")
          << ",1,-2.5,-1e5,-2e5," << 10. * i << "\n";
    csv.close();
    {
      Hdf5File h5("whole.h5", Hdf5File::Access::create);
      for (const std::string &name : names)
        h5.write(name, std::vector<double>(40, 0.25));
      h5.close();
    }
    for (const std::string ending : {"csv", "h5"})
      damage::check(ending, "whole." + ending, "damaged." + ending, 500, [&]() {
        ParticleFile in("damaged." + ending, materials);
        while (!in.read(7).empty())
          ;
      });
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace particles_damaged_files_01
