// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/files.h>
#include <geocone/folder/run_status.h>
#include <geocone/run/checkpoint.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include <zlib.h>

namespace geocone
{
  namespace
  {
    namespace fs = std::filesystem;

    const std::string prefix = "checkpoint-", ending = ".h5";

    /** Checkpoints in a folder, latest first. */
    std::vector<std::string>
    checkpoints_in(const std::string &folder)
    {
      std::vector<std::string> names;
      std::error_code          error;
      for (const auto &entry : fs::directory_iterator(folder, error))
        {
          const std::string name = entry.path().filename().string();
          if (name.size() > prefix.size() + ending.size() &&
              name.compare(0, prefix.size(), prefix) == 0 &&
              name.compare(
                name.size() - ending.size(), ending.size(), ending) == 0 &&
              name.find_first_not_of("0123456789", prefix.size()) ==
                name.size() - ending.size())
            names.push_back(name);
        }
      // Numbers have the same number of digits, or more.
      std::sort(names.begin(),
                names.end(),
                [](const std::string &a, const std::string &b) {
                  return a.size() != b.size() ? a.size() > b.size() : a > b;
                });
      return names;
    }

    /** Parameters that a checkpoint must match: all but those of the output that may
     *  change. */
    std::string
    digest(const std::string &folder)
    {
      std::ifstream     in(folder + "/parameters.prm");
      const std::string text((std::istreambuf_iterator<char>(in)), {});
      return std::to_string(text.size()) + "-" +
             std::to_string(crc32(
               0, reinterpret_cast<const Bytef *>(text.data()), text.size()));
    }
  } // namespace

  Checkpoint::Checkpoint()
    : ParameterAcceptor("/Checkpoint")
  {
    add_parameter("Every steps",
                  every_steps,
                  "Number of steps between checkpoints, from which 'geocone "
                  "--resume FOLDER' continues; 0: none. A run stopped by "
                  "Ctrl-C or SIGTERM also writes one.");
    add_parameter("Every minutes",
                  every_minutes,
                  "Time between checkpoints [min]; 0: none.",
                  prm,
                  dealii::Patterns::Double(0.));
    add_parameter("Keep",
                  keep,
                  "Number of checkpoints kept; older ones are deleted.",
                  prm,
                  dealii::Patterns::Integer(1));
  }

  void
  Checkpoint::prepare(const MPI_Comm comm_)
  {
    comm = comm_;
    last = std::chrono::steady_clock::now();
  }

  bool
  Checkpoint::is_due(const unsigned int step)
  {
    if (every_steps > 0 && step % every_steps == 0)
      return true;
    if (every_minutes == 0.)
      return false;
    const std::chrono::duration<double> since =
      std::chrono::steady_clock::now() - last;
    return dealii::Utilities::MPI::broadcast(
      comm, since.count() > 60. * every_minutes);
  }

  void
  Checkpoint::write(const std::string                    &folder,
                    const unsigned int                    step,
                    const std::function<void(Archive &)> &save)
  {
    const std::string name =
      folder + "/" + prefix + format("%06u", step) + ending;
    Archive archive(comm, name, digest(folder));
    save(archive);
    const bool first = dealii::Utilities::MPI::this_mpi_process(comm) == 0;
    if (first)
      for (const char *of_the_run : {"parameters.prm", list_of_files})
        sync_to_disk(folder + "/" + of_the_run);
    archive.close();
    last = std::chrono::steady_clock::now();
    if (first)
      {
        const std::string this_one = fs::path(name).filename().string();
        unsigned int      n_kept   = 0;
        bool              is_later = true; // steps to be repeated
        for (const std::string &present : checkpoints_in(folder))
          {
            is_later = is_later && present != this_one;
            if (std::error_code ignored;
                is_in_list(present) && (is_later || ++n_kept > keep))
              fs::remove(folder + "/" + present, ignored);
          }
      }
  }

  void
  Checkpoint::read(const std::string                                 &folder,
                   Log                                               &log,
                   const std::function<std::string(const Archive &)> &load,
                   const std::string                                 &parameter)
  {
    const std::vector<std::string> names =
      dealii::Utilities::MPI::broadcast(comm, checkpoints_in(folder));
    std::string why_not;
    for (const std::string &name : names)
      {
        const auto archive =
          Archive::open(comm, folder + "/" + name, digest(folder), why_not);
        if (archive)
          why_not = load(*archive);
        if (why_not.empty())
          return;
        log.warn("the checkpoint '" + name +
                 "' is left out: " + why_not.substr(0, why_not.find('\n')));
      }
    const Json summary = read_summary(folder + "/summary.json");
    if (names.empty() && parameter == "--resume" &&
        summary.contains("status") && summary["status"] == "finished")
      throw InputError(parameter,
                       folder,
                       "the folder of a run that has not finished",
                       "nothing is left to do: its results are complete");
    throw InputError(
      parameter,
      folder,
      "the folder of a run with a checkpoint-NNNNNN.h5",
      names.empty() ? "there is none: set 'Checkpoint/Every steps' or 'Every "
                      "minutes' in the parameter file, and run it anew"
                    : "none of those that are there can be used: bring back a "
                      "copy of the folder, or run it anew");
  }
} // namespace geocone
