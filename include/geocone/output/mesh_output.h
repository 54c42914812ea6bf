// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_mesh_output_h
#define geocone_output_mesh_output_h

#include <geocone/output/field_files.h>
#include <geocone/output/table_output.h>

#include <memory>
#include <string>

namespace geocone::GEOCONE_DIM
{
  /** Output of an analysis on a sequence of meshes: a table with one record per mesh (or
   *  sample), and field files. */
  template <typename Record>
  class MeshOutput : public TableOutput<Record>
  {
  public:
    using TableOutput<Record>::TableOutput;

    /** Writes the fields of a mesh, if field output is enabled. Collective. */
    void
    write_fields(const double number, const FieldTable &fields)
    {
      if (this->with_fields)
        files->write(fields, this->path, number, this->comm);
    }

    void
    state_of_run(StateRow &row) override
    {
      TableOutput<Record>::state_of_run(row);
      row(*files);
    }

  protected:
    using TableOutput<Record>::table;
    using TableOutput<Record>::records;

    /** Creates the output folder, or reopens the folder of a resumed run.
     *  @param name base name of the field files @throws InputError */
    void
    begin(const RunOptions &options, const std::string &name)
    {
      this->make_folder(options);
      files =
        std::make_unique<FieldFiles>(name, FieldsFormat(this->fields_format));
    }

  private:
    std::unique_ptr<FieldFiles> files;
  };
} // namespace geocone::GEOCONE_DIM

#endif
