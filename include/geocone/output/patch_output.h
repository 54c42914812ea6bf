// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_patch_output_h
#define geocone_output_patch_output_h

#include <geocone/base/exceptions.h>
#include <geocone/base/files.h>
#include <geocone/base/log.h>
#include <geocone/base/types.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/mpi.h>

#include <deal.II/numerics/data_component_interpretation.h>

#include <filesystem>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace geocone
{
  /** Patches with named data, which the base class writes. */
  template <int patch_dim>
  class PatchOutput : public dealii::DataOutInterface<patch_dim, dim>
  {
  public:
    using Patch = dealii::DataOutBase::Patch<patch_dim, dim>;

    std::vector<Patch>       patches;
    std::vector<std::string> names;
    std::vector<std::tuple<
      unsigned int,
      unsigned int,
      std::string,
      dealii::DataComponentInterpretation::DataComponentInterpretation>>
      vectors;

    void
    add_scalar(const std::string &name)
    {
      names.push_back(name);
    }

    void
    add_vector(const std::string &name)
    {
      vectors.emplace_back(
        names.size(),
        names.size() + dim - 1,
        name,
        dealii::DataComponentInterpretation::component_is_part_of_vector);
      for (unsigned int c = 0; c < dim; ++c)
        names.push_back(name);
    }

    /** Writes base-NNNN.vtu (or a file per rank and base-NNNN.pvtu). */
    void
    write_as_vtu(const std::string                           &folder,
                 const std::string                           &base,
                 const unsigned int                           number,
                 const double                                 time,
                 const MPI_Comm                               comm,
                 std::vector<std::pair<double, std::string>> &series)
    {
      const unsigned int n_ranks =
        dealii::Utilities::MPI::n_mpi_processes(comm);
      const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(comm);
      dealii::DataOutBase::VtkFlags flags;
      flags.time  = time;
      flags.cycle = number;
      this->set_flags(flags);

      const std::string stem  = base + format("-%04u", number);
      const auto        piece = [&](const unsigned int r) {
        return n_ranks == 1 ? stem + ".vtu" : stem + format(".%03u.vtu", r);
      };
      write_file(folder + "/" + piece(rank),
                 [&](std::ostream &out) { this->write_vtu(out); });
      if (rank != 0)
        return;
      std::string whole = piece(0);
      if (n_ranks > 1)
        {
          std::vector<std::string> pieces;
          for (unsigned int r = 0; r < n_ranks; ++r)
            pieces.push_back(piece(r));
          whole = stem + ".pvtu";
          write_file(folder + "/" + whole, [&](std::ostream &out) {
            this->write_pvtu_record(out, pieces);
          });
        }
      series.emplace_back(time, whole);
      write_file(folder + "/" + base + ".pvd", [&](std::ostream &out) {
        dealii::DataOutBase::write_pvd_record(out, series);
      });
    }

    /** Writes base-NNNN.h5, of all ranks, and lists it in base.xdmf. */
    void
    write_as_hdf5(const std::string        &folder,
                  const std::string        &base,
                  const unsigned int        number,
                  const double              time,
                  const MPI_Comm            comm,
                  std::vector<std::string> &series)
    {
      const unsigned int n_ranks =
        dealii::Utilities::MPI::n_mpi_processes(comm);
      const unsigned int rank  = dealii::Utilities::MPI::this_mpi_process(comm);
      const std::string  file  = base + format("-%04u.h5", number);
      const std::string  whole = folder + "/" + file;
      const std::string  temporary = whole + ".part";
      const auto         refuse    = [&]() {
        std::error_code error;
        std::filesystem::remove(temporary, error);
        throw RunError("the file '" + whole +
                       "' cannot be written: is the disk full?");
      };

      if (!dealii::Utilities::MPI::logical_or(!patches.empty(), comm))
        return; // nothing to write
      // The library fails on ranks without patches: only the others write.
      MPI_Comm writers;
      MPI_Comm_split(comm, patches.empty(), rank, &writers);
      std::string entry;
      if (!patches.empty())
        {
          dealii::DataOutBase::DataOutFilter filtered(
            dealii::DataOutBase::DataOutFilterFlags(false, true));
          this->write_filtered_data(filtered);
          try
            {
              this->write_hdf5_parallel(filtered, temporary, writers);
            }
          catch (const dealii::ExceptionBase &)
            {
              refuse();
            }
          entry = this->create_xdmf_entry(filtered, file, time, writers)
                    .get_xdmf_content(3, patches[0].reference_cell);
        }
      MPI_Comm_free(&writers);
      // Only the first writer has got an entry.
      entry = dealii::Utilities::MPI::broadcast(
        comm,
        entry,
        dealii::Utilities::MPI::min(patches.empty() ? n_ranks : rank, comm));
      if (rank != 0)
        return;
      std::error_code error;
      std::filesystem::rename(temporary, whole, error);
      if (error)
        refuse();
      series.push_back(entry);
      write_file(folder + "/" + base + ".xdmf", [&](std::ostream &out) {
        out << "<?xml version=\"1.0\" ?>\n"
               "<Xdmf Version=\"2.0\">\n  <Domain>\n"
               "    <Grid Name=\"CellTime\" GridType=\"Collection\" "
               "CollectionType=\"Temporal\">\n";
        for (const std::string &grid : series)
          out << grid;
        out << "    </Grid>\n  </Domain>\n</Xdmf>\n";
      });
    }

  protected:
    const std::vector<Patch> &
    get_patches() const override
    {
      return patches;
    }

    std::vector<std::string>
    get_dataset_names() const override
    {
      return names;
    }

    std::vector<std::tuple<
      unsigned int,
      unsigned int,
      std::string,
      dealii::DataComponentInterpretation::DataComponentInterpretation>>
    get_nonscalar_data_ranges() const override
    {
      return vectors;
    }
  };

  /** The files of one kind of patches at all times, in the formats wanted. */
  class FieldFiles
  {
  public:
    /** @param base e.g. "points" @param format vtu | hdf5 | both */
    FieldFiles(const std::string &base, const std::string &format)
      : base(base)
      , format(format)
    {}

    /** Writes base-NNNN and adds it to the series. Collective. */
    template <int patch_dim>
    void
    write(PatchOutput<patch_dim> &output,
          const std::string      &folder,
          const double            time,
          const MPI_Comm          comm)
    {
      if (format != "hdf5")
        output.write_as_vtu(folder, base, number, time, comm, vtu);
      if (format != "vtu")
        output.write_as_hdf5(folder, base, number, time, comm, hdf5);
      ++number;
    }

  private:
    const std::string                           base, format;
    unsigned int                                number = 0;
    std::vector<std::pair<double, std::string>> vtu;
    std::vector<std::string>                    hdf5;
  };
} // namespace geocone

#endif
