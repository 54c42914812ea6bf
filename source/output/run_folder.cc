// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/parameter_file.h>
#include <geocone/output/run_folder.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

namespace geocone
{
  namespace
  {
    namespace fs = std::filesystem;

    bool
    is_used(const std::string &folder)
    {
      std::error_code error;
      return fs::exists(folder) &&
             (!fs::is_directory(folder) || !fs::is_empty(folder, error));
    }

    /** Removes what a run writes, and never anything else. */
    void
    remove_old_run(const std::string &folder)
    {
      static const std::array<const char *, 7> names   = {{"parameters.prm",
                                                           "statistics.csv",
                                                           "newton.csv",
                                                           "path.csv",
                                                           "surfaces.csv",
                                                           "summary.json",
                                                           "log.txt"}};
      static const std::array<const char *, 6> endings = {
        {".vtu", ".pvtu", ".pvd", ".part", ".png", ".svg"}};
      std::error_code error;
      for (const auto &entry : fs::directory_iterator(folder, error))
        {
          const fs::path   &file = entry.path();
          const std::string stem = file.stem();
          const auto        is   = [&](const char *base) {
            return stem.rfind(base, 0) == 0;
          };
          const bool is_field =
            (file.extension() == ".h5" || file.extension() == ".xdmf") &&
            (is("cells") || is("points") || is("frozen"));
          if (is_field ||
              std::count(names.begin(), names.end(), file.filename()) > 0 ||
              std::count(endings.begin(), endings.end(), file.extension()) > 0)
            fs::remove(file, error);
        }
    }

    /** Why the folder cannot be used; empty if it has been made. */
    std::string
    make_folder(std::string &path, const std::string &if_exists)
    {
      const std::string wanted = path;
      if (if_exists == "number")
        for (unsigned int i = 2; is_used(path); ++i)
          path = wanted + "-" + std::to_string(i);
      if (is_used(path))
        {
          if (if_exists == "refuse")
            return "it exists and is not empty";
          if (fs::is_directory(path))
            remove_old_run(path);
        }
      std::error_code error;
      fs::create_directories(path, error);
      if (!fs::is_directory(path))
        return "it cannot be made";
      std::ofstream parameters(path + "/parameters.prm");
      if (parameters)
        ParameterFile::print(parameters, false);
      parameters.close();
      return parameters ? "" : "it cannot be written";
    }
  } // namespace

  std::string
  make_run_folder(const MPI_Comm     comm,
                  const std::string &wanted,
                  const std::string &if_exists)
  {
    // Rank 0 makes the folder; all learn its name, or why there is none.
    std::string path = wanted, refusal;
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      refusal = make_folder(path, if_exists);
    path    = dealii::Utilities::MPI::broadcast(comm, path);
    refusal = dealii::Utilities::MPI::broadcast(comm, refusal);
    if (!refusal.empty())
      throw InputError("Output/Folder",
                       path,
                       "a folder that can be written",
                       refusal + "; name another one with --output");
    return path;
  }
} // namespace geocone
