// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/hdf5_file.h>
#include <geocone/command_line.h>
#include <geocone/output/run_folder.h>
#include <geocone/program.h>

#include <omp.h>

#include <cstdlib>

#include <dlfcn.h>

// The program for scenes in three dimensions, beside that of the plane (program.h).
namespace geocone::dim3
{
  int
  run_geocone(int argc, char **argv);
}

namespace
{
  using namespace geocone;

  /** That of the parameters that the program is called with. What is wrong with them
   *  is said by the program of plane scenes. */
  std::string
  dimension_of(const int argc, char **argv)
  {
    const std::string parameter = "Geometry/Dimension", plane = "2";
    try
      {
        const CommandLine call =
          parse_command_line(argc, argv, "geocone", {"--replay", "--resume"});
        if (const auto resumed = call.own.find("--resume");
            resumed != call.own.end())
          return parameters_of_run(resumed->second).peek(parameter, plane);
        if (const auto frozen = call.own.find("--replay");
            frozen != call.own.end())
          {
            const Hdf5File file(frozen->second, Hdf5File::Access::read);
            return file.has("dimension")
                     ? std::to_string(file.read_integers("dimension").at(0))
                     : plane;
          }
        if (call.file.empty())
          return ParameterFile::from_text("", "call", call.overrides)
            .peek(parameter, plane);
        return ParameterFile(call.file, call.overrides).peek(parameter, plane);
      }
    catch (const std::exception &)
      {
        return plane;
      }
  }
} // namespace

/**
 * In place of that of the OpenMP runtime. CHOLMOD opens a parallel region in each of its
 * inner loops, most of them of one thread; the runtime makes a system call at the end of
 * each, a million times in a minute. Here all regions are of one thread, so a region
 * is a call.
 */
extern "C" void
GOMP_parallel(void (*function)(void *), void *data, unsigned int, unsigned int)
{
  function(data);
}

int
main(int argc, char **argv)
{
  // One thread per rank: the parallelism is MPI's. Cholmod asks for a fixed
  // number of threads in blocks that are far too small for them, which was
  // measured to triple the time of a factorisation; this alone stops it.
  omp_set_max_active_levels(0);
  if (const auto set_blas_threads = reinterpret_cast<void (*)(int)>(
        dlsym(RTLD_DEFAULT, "openblas_set_num_threads")))
    set_blas_threads(1);
  return dimension_of(argc, argv) == "3"
           ? geocone::dim3::run_geocone(argc, argv)
           : geocone::dim2::run_geocone(argc, argv);
}
