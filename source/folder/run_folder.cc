// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/files.h>
#include <geocone/base/parameter_file.h>
#include <geocone/folder/run_folder.h>
#include <geocone/folder/run_status.h>

#include <deal.II/base/mpi.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

namespace geocone
{
  namespace
  {
    namespace fs = std::filesystem;

    /** Whether the folder has files other than a lock. */
    bool
    is_used(const fs::path &folder)
    {
      std::error_code error;
      if (!fs::exists(folder, error))
        return false;
      for (const auto &entry : fs::directory_iterator(folder, error))
        if (entry.path().filename().string().find(lock_file) != 0)
          return true;
      return static_cast<bool>(error);
    }

    /** Reason why a folder must not be overwritten, or nothing. */
    std::string
    why_no_old_run(const fs::path &folder)
    {
      std::error_code ignored;
      if (!fs::is_directory(folder, ignored))
        return "it is no folder";
      if (!fs::is_regular_file(
            fs::symlink_status(folder / list_of_files, ignored)))
        return std::string("it has no ") + list_of_files +
               " of a run before, which would say what may be deleted: empty "
               "it yourself";
      return "";
    }

    /** Whether runs write files of such a name. */
    bool
    is_name_of_runs(const std::string &name)
    {
      static const std::regex names(
        "(parameters\\.prm|summary\\.json|model\\.json|log\\.txt|report\\.html|"
        "paraview_state\\.py|(statistics|newton|plates|path|surfaces|bounds|"
        "structures)\\."
        "csv|"
        "(cells|points|obstacles|bounds)(-[0-9]{4,}.*)?\\."
        "(vtu|pvtu|pvd|h5|vtkhdf|xdmf)|checkpoint-[0-9]{6,}\\.h5)(\\.part)?");
      return std::regex_match(name, names);
    }

    /** Deletes the files listed by the earlier run, and the list.
     *  @return reason for refusal, or nothing; if refused, no file is deleted */
    std::string
    remove_old_run(const fs::path &folder)
    {
      std::ifstream         list(folder / list_of_files);
      std::error_code       ignored;
      std::set<std::string> names;
      for (std::string name; std::getline(list, name);)
        // The list may be forged: only plain names in this folder are accepted.
        if (!name.empty() && fs::path(name).filename() == name &&
            name != list_of_files &&
            !fs::is_directory(fs::symlink_status(folder / name, ignored)))
          {
            names.insert(name);
            names.insert(name + ".part");
          }
      for (const auto &entry : fs::directory_iterator(folder, ignored))
        {
          const std::string name     = entry.path().filename().string();
          const bool        is_known = names.count(name) > 0;
          if (is_known ? fs::is_directory(entry.symlink_status(ignored))
                       : is_name_of_runs(name))
            return (is_known ? "its folder '" : "its file '") +
                   printable(name) + "' is not in the " + list_of_files +
                   " of the run before: move it away yourself";
        }
      for (const std::string &name : names)
        fs::remove(folder / name, ignored);
      fs::remove(folder / list_of_files, ignored);
      return "";
    }

    /** Begins the list of files. @return errno, or 0 */
    int
    begin_list(const fs::path &folder)
    {
      const int list = ::open((folder / list_of_files).c_str(),
                              O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW,
                              0666);
      return list < 0 || ::close(list) != 0 ? errno : 0;
    }

    /** Locks a folder and empties it if allowed. @param exists is set if the folder
     *  exists and must not. @return reason for refusal, or nothing */
    std::string
    take_for_new_run(const std::string &path,
                     const IfExists     if_exists,
                     bool              &exists)
    {
      const auto why_not_used = [&]() -> std::string {
        exists = is_used(path) && if_exists != IfExists::overwrite;
        if (exists)
          return "it exists and is not empty: set 'Output/If folder "
                 "exists' to overwrite or number";
        return is_used(path) ? why_no_old_run(path) : "";
      };
      std::error_code error;
      std::string     why_not = why_not_used();
      if (!why_not.empty())
        return why_not;
      fs::create_directories(path, error);
      if (std::error_code ignored; !fs::is_directory(path, ignored))
        return "it cannot be made" +
               (error ? " (" + error.message() + ")" : "");
      why_not = take_folder(path);
      if (!why_not.empty())
        {
          std::error_code ignored;
          exists =
            fs::exists(fs::symlink_status(fs::path(path) / lock_file, ignored));
          return why_not;
        }
      why_not = why_not_used(); // may have changed before locking
      if (why_not.empty() && is_used(path))
        why_not = remove_old_run(path);
      if (why_not.empty())
        if (const int cause = begin_list(path))
          why_not =
            std::string("it cannot be written (") + std::strerror(cause) + ")";
      if (!why_not.empty())
        release_folder();
      return why_not;
    }

    /** Makes the folder. @return reason for refusal, or empty */
    std::string
    make_folder(std::string &path, const IfExists if_exists)
    {
      const std::string wanted = path;
      for (unsigned int i = 2;; ++i)
        {
          bool              exists  = false;
          const std::string why_not = take_for_new_run(path, if_exists, exists);
          if (why_not.empty())
            break;
          if (if_exists != IfExists::number || !exists)
            return why_not;
          path = wanted + "-" + std::to_string(i);
        }
      keep_list_of_files(path);
      try
        {
          write_file(path + "/parameters.prm", [](std::ostream &out) {
            ParameterFile::print(out);
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
    // Rank 0 makes the folder; all ranks receive its name or the reason for refusal.
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
    /** Reason why this process may not resume the run in a folder, or nothing. */
    std::string
    why_not_enter(const std::string &path)
    {
      std::error_code error;
      for (const char *name : {list_of_files, "summary.json"})
        if (!fs::is_regular_file(fs::path(path) / name, error))
          return std::string("it has no ") + name;
      std::vector<std::string> names = {list_of_files};
      std::ifstream            file(fs::path(path) / list_of_files);
      for (std::string name; std::getline(file, name);)
        names.push_back(name);
      for (const std::string &name : names)
        {
          const auto is = [&](const std::string  &file,
                              const fs::file_type type) {
            std::error_code ignored;
            return fs::symlink_status(fs::path(path) / file, ignored).type() ==
                   type;
          };
          if (is(name, fs::file_type::symlink))
            return "'" + printable(name) +
                   "' is a symbolic link, through which nothing is written: "
                   "take it away";
          for (const std::string &file : {name, name + ".part"})
            if (is(file, fs::file_type::directory))
              return "'" + printable(file) +
                     "' is a folder where a file is written: take it away";
        }
      return take_folder(path);
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
