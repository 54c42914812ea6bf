// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/archive.h>
#include <geocone/base/gather.h>

#include <deal.II/base/mpi.h>

#include <zlib.h>

#include <sstream>

namespace geocone
{
  using dealii::Utilities::MPI::broadcast;
  using dealii::Utilities::MPI::n_mpi_processes;
  using dealii::Utilities::MPI::this_mpi_process;

  namespace
  {
    const std::string format_name = "geocone checkpoint 4";

    /** Updates the checksum with an array. */
    unsigned long
    add_to_checksum(const unsigned long        sum,
                    const std::string         &name,
                    const std::vector<double> &values)
    {
      const auto add = [](unsigned long s, const void *data, std::size_t n) {
        const auto *bytes = static_cast<const Bytef *>(data);
        for (std::size_t i = 0; i < n; i += 1UL << 30)
          s = crc32(s, bytes + i, std::min<std::size_t>(n - i, 1UL << 30));
        return s;
      };
      return add(add(sum, name.data(), name.size()),
                 values.data(),
                 values.size() * sizeof(double));
    }
  } // namespace

  Archive::Archive(const MPI_Comm comm, const std::string &file_name)
    : comm(comm)
    , file_name(file_name)
  {}

  Archive::Archive(const MPI_Comm     comm,
                   const std::string &file_name,
                   const std::string &run)
    : Archive(comm, file_name)
  {
    if (this_mpi_process(comm) == 0)
      {
        file = std::make_unique<Hdf5File>(file_name, Hdf5File::Access::create);
        file->write("format", format_name);
        file->write("belongs to", run);
      }
  }

  Archive::Archive(const MPI_Comm comm)
    : Archive(comm, "")
  {}

  void
  Archive::add(const std::string &name, const std::vector<double> &values)
  {
    if (file_name.empty())
      {
        names += name + "\n";
        arrays[name] = broadcast(comm, values);
        return;
      }
    if (!file)
      return;
    names += name + "\n";
    checksum = add_to_checksum(checksum, name, values);
    if (!values.empty())
      file->write_plain(name, values);
  }

  void
  Archive::write(const std::string         &name,
                 const std::vector<double> &of_this_rank)
  {
    const std::vector<double> size = {double(of_this_rank.size())};
    add(name + " of ranks", gather(size, comm));
    add(name, gather(of_this_rank, comm));
  }

  void
  Archive::write_row(const std::string &name, const StateRow &row)
  {
    add(name, row.values());
  }

  void
  Archive::close()
  {
    std::string problem;
    if (file)
      try
        {
          file->write("names", names);
          file->write("checksum", std::to_string(checksum));
          file->close(true);
        }
      catch (const RunError &error)
        {
          problem = error.what();
        }
    problem = broadcast(comm, problem);
    if (!problem.empty())
      throw StepFailure(problem);
  }

  std::unique_ptr<Archive>
  Archive::open(const MPI_Comm     comm,
                const std::string &file_name,
                const std::string &run,
                std::string       &why_not)
  {
    why_not.clear();
    std::unique_ptr<Archive> archive(new Archive(comm, file_name));
    try
      {
        archive->file =
          std::make_unique<Hdf5File>(file_name, Hdf5File::Access::read);
        const Hdf5File &file = *archive->file;
        if (file.read_text("format") != format_name)
          throw RunError("it is of another version of geocone");
        if (file.read_text("belongs to") != run)
          throw RunError("it belongs to a run with other parameters");
        archive->names = file.read_text("names");
        // The first rank verifies the file for all ranks.
        if (this_mpi_process(comm) == 0)
          {
            unsigned long      sum = 0;
            std::istringstream list(archive->names);
            for (std::string name; std::getline(list, name);)
              sum = add_to_checksum(sum, name, archive->read(name));
            if (file.read_text("checksum") != std::to_string(sum))
              throw RunError("it is damaged: its checksum is wrong");
          }
      }
    catch (const RunError &error)
      {
        why_not = error.what();
      }
    for (const std::string &problem :
         dealii::Utilities::MPI::all_gather(comm, why_not))
      if (why_not.empty())
        why_not = problem;
    if (!why_not.empty())
      return nullptr;
    return archive;
  }

  bool
  Archive::has(const std::string &name) const
  {
    return ("\n" + names).find("\n" + name + "\n") != std::string::npos;
  }

  std::vector<double>
  Archive::read(const std::string &name) const
  {
    if (!has(name))
      throw RunError("the checkpoint '" + file_name + "' lacks '" + name + "'");
    if (file_name.empty())
      return arrays.at(name);
    return file->has(name) ? file->read_doubles(name) : std::vector<double>();
  }

  std::vector<double>
  Archive::read_part(const std::string &name, const std::size_t size) const
  {
    const std::vector<double> all     = read(name);
    const std::vector<double> sizes   = read(name + " of ranks");
    const unsigned int        n_ranks = n_mpi_processes(comm),
                       rank           = this_mpi_process(comm);
    std::size_t begin = 0, end = 0;
    if (sizes.size() == n_ranks)
      {
        for (unsigned int r = 0; r < rank; ++r)
          begin += static_cast<std::size_t>(sizes[r]);
        end = begin + static_cast<std::size_t>(sizes[rank]);
      }
    else
      {
        const std::size_t n = all.size() / size;
        begin               = n * rank / n_ranks * size;
        end                 = n * (rank + 1) / n_ranks * size;
      }
    if (end > all.size())
      throw RunError("the checkpoint '" + file_name + "' has a wrong '" + name +
                     "'");
    return std::vector<double>(all.begin() + begin, all.begin() + end);
  }

  unsigned int
  Archive::n_ranks_of(const std::string &name) const
  {
    return read(name + " of ranks").size();
  }

  StateRow
  Archive::read_row(const std::string &name) const
  {
    return StateRow(read(name));
  }
} // namespace geocone
