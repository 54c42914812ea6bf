// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Fields of which one rank cannot write its piece: all ranks end together, and
// the record names only files that are there.

#include <geocone/base/exceptions.h>
#include <geocone/base/files.h>
#include <geocone/output/field_files.h>

#include <deal.II/base/mpi.h>

#include "../test.h"

#include <cstdio>
#include <filesystem>
#include <regex>
#include <sstream>

namespace output_pieces_01
{
  using namespace geocone;

  namespace fs = std::filesystem;

  /** Whether all files that a record names are there. */
  bool
  is_complete(const fs::path &record)
  {
    std::ifstream      in(record);
    std::ostringstream text;
    text << in.rdbuf();
    const std::string all = text.str();
    const std::regex  name("(file|Source)=\"([^\"]*)\"");
    bool              complete = !all.empty();
    for (std::sregex_iterator it(all.begin(), all.end(), name), end; it != end;
         ++it)
      {
        const fs::path file = record.parent_path() / (*it)[2].str();
        complete            = complete && fs::exists(file) &&
                   (file.extension() != ".pvtu" || is_complete(file));
      }
    return complete;
  }

  void
  test(int argc, char **argv)
  {
    const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
    const MPI_Comm                                 comm = MPI_COMM_WORLD;
    const bool last = dealii::Utilities::MPI::this_mpi_process(comm) + 1 ==
                      dealii::Utilities::MPI::n_mpi_processes(comm);
    const std::string folder = "pieces-01";
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      {
        fs::remove_all(folder);
        fs::create_directory(folder);
      }
    MPI_Barrier(comm);

    FieldTable table;
    table.n_nodes   = 3;
    table.positions = [](std::vector<double> &x) {
      x = {0., 0., 1., 0., 0., 1.};
    };
    FieldFiles files("points", FieldsFormat::vtu);
    files.write(table, folder, 0., comm);
    bool thrown = false;
    try
      {
        files.write(table, last ? folder + "/none" : folder, 1., comm);
      }
    catch (const StepFailure &)
      {
        thrown = true;
      }
    const bool all_thrown = !dealii::Utilities::MPI::logical_or(!thrown, comm);
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      {
        std::printf("the error is that of all ranks: %s\n",
                    all_thrown ? "yes" : "NO");
        std::printf("the record names what is there: %s\n",
                    is_complete(folder + "/points.pvd") ? "yes" : "NO");
        fs::remove_all(folder);
      }
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace output_pieces_01
