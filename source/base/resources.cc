// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/resources.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <limits>
#include <string>

#include <dlfcn.h>
#include <sched.h>
#include <sys/resource.h>

namespace geocone
{
  double
  cpu_time_of_rank()
  {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  }

  double
  peak_memory_of_rank()
  {
    dealii::Utilities::System::MemoryStats memory;
    dealii::Utilities::System::get_memory_stats(memory);
    return memory.VmHWM / 1024.; // from kB
  }

  double
  available_memory()
  {
    double        available = std::numeric_limits<double>::max();
    std::ifstream in("/proc/meminfo");
    for (std::string line; std::getline(in, line);)
      if (line.compare(0, 13, "MemAvailable:") == 0)
        available = std::strtod(line.c_str() + 13, nullptr) / 1024.; // from kB
    // Of the container, which hides files of others but not the machine's memory.
    double allowed = 0., used = 0.;
    if (std::ifstream("/sys/fs/cgroup/memory.max") >> allowed &&
        std::ifstream("/sys/fs/cgroup/memory.current") >> used)
      available = std::min(available, (allowed - used) / 1048576.);
    rlimit limit;
    if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
      available = std::min(available, limit.rlim_cur / 1048576.);
    return available;
  }

  namespace
  {
    /** Whether two threads may call BLAS at the same time. OpenBLAS locks its buffers
     *  only where it is built with threads of its own. */
    bool
    has_locking_blas()
    {
      const auto kind = reinterpret_cast<int (*)()>(
        dlsym(RTLD_DEFAULT, "openblas_get_parallel"));
      return kind != nullptr && kind() == 1;
    }
  } // namespace

  bool
  has_room_for_two()
  {
    cpu_set_t    allowed;
    unsigned int processors = 1;
    if (sched_getaffinity(0, sizeof(allowed), &allowed) == 0)
      processors = CPU_COUNT(&allowed);
    return has_locking_blas() &&
           processors >=
             2 * dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) &&
           available_memory() > 8. * peak_memory_of_rank();
  }
} // namespace geocone
