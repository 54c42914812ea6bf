// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/files.h>
#include <geocone/base/parameter_file.h>
#include <geocone/output/run_folder.h>
#include <geocone/output/run_status.h>

#include <deal.II/base/mpi.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace geocone
{
  namespace
  {
    namespace fs = std::filesystem;

    bool
    is_used(const fs::path &folder)
    {
      std::error_code error;
      return fs::exists(folder, error) &&
             (!fs::is_directory(folder, error) || !fs::is_empty(folder, error));
    }

    /** Deletes the files that the list of the run before names, and the list.
     *  @return why not, or nothing */
    std::string
    remove_old_run(const fs::path &folder)
    {
      std::error_code ignored;
      if (!fs::is_directory(folder, ignored))
        return "it is no folder";
      if (const std::string why = running_in(folder.string()); !why.empty())
        return why;
      std::ifstream list(folder / list_of_files);
      if (!list)
        return std::string("it has no ") + list_of_files +
               " of a run before, which would say what may be deleted: empty "
               "it yourself";
      for (std::string name; std::getline(list, name);)
        {
          // The list is a file like others: only plain names in this folder.
          const fs::path file = folder / name;
          if (name.empty() || fs::path(name).filename() != name ||
              name == list_of_files ||
              fs::is_directory(fs::symlink_status(file, ignored)))
            continue;
          fs::remove(file, ignored);
          fs::remove(file.string() + ".part", ignored);
        }
      for (const char *name : {"parameters.prm",
                               "summary.json",
                               "statistics.csv",
                               "newton.csv",
                               "path.csv",
                               "log.txt"})
        if (fs::exists(fs::symlink_status(folder / name, ignored)))
          return std::string("its file '") + name + "' is not in the " +
                 list_of_files + " of the run before: empty it yourself";
      fs::remove(folder / list_of_files, ignored);
      return "";
    }

    /** Whether this run, and no other one, has got the folder. */
    bool
    claim(const fs::path &folder)
    {
      const int list = ::open((folder / list_of_files).c_str(),
                              O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW,
                              0666);
      if (list < 0)
        return false;
      ::close(list);
      return true;
    }

    /** Why the folder cannot be used; empty if it has been made. */
    std::string
    make_folder(std::string &path, const IfExists if_exists)
    {
      const std::string wanted = path;
      for (unsigned int i = 2;; ++i)
        {
          std::error_code error;
          if (is_used(path))
            {
              if (if_exists == IfExists::refuse)
                return "it exists and is not empty: set 'Output/If folder "
                       "exists' to overwrite or number";
              if (if_exists == IfExists::overwrite)
                {
                  const std::string why = remove_old_run(path);
                  if (!why.empty())
                    return why;
                }
            }
          if (!is_used(path) || if_exists == IfExists::overwrite)
            {
              fs::create_directories(path, error);
              if (std::error_code ignored; !fs::is_directory(path, ignored))
                return "it cannot be made" +
                       (error ? " (" + error.message() + ")" : "");
              if (claim(path))
                break;
              const int cause = errno;
              if (cause != EEXIST)
                return std::string("it cannot be written (") +
                       std::strerror(cause) + ")";
              if (if_exists != IfExists::number)
                return "another run has just taken it";
            }
          path = wanted + "-" + std::to_string(i);
        }
      keep_list_of_files(path);
      try
        {
          write_file(path + "/parameters.prm", [](std::ostream &out) {
            ParameterFile::print(out, false);
          });
        }
      catch (const RunError &error)
        {
          return error.what();
        }
      return "";
    }
  } // namespace

  Choice<IfExists>
  if_exists_choice()
  {
    return {{{"automatic", IfExists::automatic},
             {"number", IfExists::number},
             {"refuse", IfExists::refuse},
             {"overwrite", IfExists::overwrite}}};
  }

  std::string
  make_run_folder(const MPI_Comm     comm,
                  const std::string &wanted,
                  const bool         was_named,
                  const IfExists     if_exists)
  {
    for (const char c : wanted)
      if (static_cast<unsigned char>(c) < 32 || c == 127)
        throw InputError("Output/Folder",
                         printable(wanted),
                         "a name without control characters",
                         "name another one with --output");
    IfExists chosen = if_exists;
    if (chosen == IfExists::automatic)
      chosen = was_named ? IfExists::refuse : IfExists::number;
    // Rank 0 makes the folder; all learn its name, or why there is none.
    std::string path = wanted, refusal;
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      refusal = make_folder(path, chosen);
    path    = dealii::Utilities::MPI::broadcast(comm, path);
    refusal = dealii::Utilities::MPI::broadcast(comm, refusal);
    if (!refusal.empty())
      throw InputError("Output/Folder",
                       path,
                       "a folder that can be written, empty or not there yet",
                       refusal + "; or name another one with --output");
    keep_list_of_files(path);
    return path;
  }

  ParameterFile
  parameters_of_run(const std::string &folder)
  {
    const std::string file_name = folder + "/parameters.prm";
    std::error_code   error;
    if (!fs::is_regular_file(file_name, error))
      throw InputError("--resume",
                       printable(folder),
                       "the folder of a run by geocone",
                       "it has no parameters.prm");
    const Json  summary = read_summary(folder + "/summary.json");
    std::string original;
    if (summary.contains("run") && summary["run"].is_object())
      if (const auto path = summary["run"].find("parameter_file");
          path != summary["run"].end() && path->is_string())
        original = path->get<std::string>();
    return ParameterFile(file_name, {}, original);
  }

  namespace
  {
    /** Why this process may not go on with the run in a folder; or nothing. */
    std::string
    why_not_enter(const std::string &path)
    {
      std::error_code error;
      for (const char *name : {list_of_files, "summary.json"})
        if (!fs::is_regular_file(fs::path(path) / name, error))
          return std::string("it has no ") + name;
      if (const std::string why = running_in(path); !why.empty())
        return why;
      // Held until the process ends, however it does.
      const int list =
        ::open((fs::path(path) / list_of_files).c_str(), O_RDWR | O_CLOEXEC);
      if (list < 0 || ::flock(list, LOCK_EX | LOCK_NB) != 0)
        return std::string("it cannot be locked (") + std::strerror(errno) +
               "): another process may be going on with it";
      return "";
    }
  } // namespace

  void
  enter_run_folder(const MPI_Comm comm, const std::string &path)
  {
    std::string why_not;
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      why_not = why_not_enter(path);
    why_not = dealii::Utilities::MPI::broadcast(comm, why_not);
    if (!why_not.empty())
      throw InputError("--resume",
                       path,
                       "the folder of a run that has ended, by geocone",
                       why_not);
    keep_list_of_files(path);
  }
} // namespace geocone
