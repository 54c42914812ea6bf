// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/files.h>
#include <geocone/base/gather.h>
#include <geocone/base/hdf5_file.h>
#include <geocone/base/log.h>
#include <geocone/base/types.h>
#include <geocone/output/field_files.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <new>

#include <zlib.h>

namespace geocone::GEOCONE_DIM
{
  std::vector<double>
  FieldTable::values(const Fill &fill, const unsigned int n_components) const
  {
    std::vector<double> all(n_nodes * n_components);
    fill(all);
    return all;
  }

  namespace
  {
    /** Performs an action unless there is a problem; catches errors as a problem. */
    void
    attempt(std::string &problem, const std::function<void()> &action)
    {
      if (problem.empty())
        try
          {
            action();
          }
        catch (const std::bad_alloc &)
          {
            problem =
              "the fields cannot be written: out of memory\n"
              "  remedy:  set 'Output/Fields format' = vtu, which needs "
              "the least";
          }
        catch (const std::exception &error)
          {
            problem = error.what();
          }
    }

    /** Escapes a name for XML attributes. */
    std::string
    escaped(const std::string &name)
    {
      std::string text;
      for (const char c : name)
        text += c == '&'   ? "&amp;"
                : c == '<' ? "&lt;"
                : c == '>' ? "&gt;"
                : c == '"' ? "&quot;"
                           : std::string(1, c);
      return text;
    }

    void
    write_base64(std::ostream &out, const std::vector<unsigned char> &bytes)
    {
      const char *digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
                           "abcdefghijklmnopqrstuvwxyz0123456789+/";
      std::string text;
      text.reserve((bytes.size() + 2) / 3 * 4);
      for (std::size_t i = 0; i < bytes.size(); i += 3)
        {
          const std::size_t  n     = std::min<std::size_t>(3, bytes.size() - i);
          const unsigned int three = bytes[i] << 16 |
                                     (n > 1 ? bytes[i + 1] << 8 : 0) |
                                     (n > 2 ? bytes[i + 2] : 0);
          text += digits[three >> 18];
          text += digits[three >> 12 & 63];
          text += n > 1 ? digits[three >> 6 & 63] : '=';
          text += n > 2 ? digits[three & 63] : '=';
        }
      out.write(text.data(), text.size());
    }

    /** Encodes numbers for VTK: zlib blocks preceded by their sizes. */
    template <typename T>
    void
    write_blocks(std::ostream &out, const std::vector<T> &values)
    {
      constexpr std::size_t block = 1 << 20;
      const auto           *bytes =
        reinterpret_cast<const unsigned char *>(values.data());
      const std::size_t          n        = values.size() * sizeof(T);
      const std::size_t          n_blocks = (n + block - 1) / block;
      std::vector<std::uint32_t> header   = {
          static_cast<std::uint32_t>(n_blocks),
          static_cast<std::uint32_t>(block),
          static_cast<std::uint32_t>(n > 0 ? n - (n_blocks - 1) * block : 0)};
      std::vector<unsigned char> packed;
      for (std::size_t first = 0; first < n; first += block)
        {
          const std::size_t size = std::min(block, n - first);
          const std::size_t end  = packed.size();
          uLongf            room = compressBound(size);
          packed.resize(end + room);
          // Better compression takes ten times as long and saves a fifth of the size.
          const int result =
            compress2(&packed[end], &room, bytes + first, size, Z_BEST_SPEED);
          if (result == Z_MEM_ERROR)
            throw std::bad_alloc();
          if (result != Z_OK)
            throw RunError("fields cannot be compressed\n"
                           "  remedy:  set 'Output/Fields format' = hdf5");
          packed.resize(end + room);
          header.push_back(room);
        }
      const auto *begin =
        reinterpret_cast<const unsigned char *>(header.data());
      write_base64(out,
                   std::vector<unsigned char>(
                     begin, begin + header.size() * sizeof(header[0])));
      write_base64(out, packed);
      out << "\n";
    }

    /** XML attributes of an array of three-dimensional vectors or scalars. */
    std::string
    components(const unsigned int n)
    {
      return n > 1 ? " NumberOfComponents=\"3\"" : "";
    }

    /** Converts to single precision; vectors get a third component 0. */
    std::vector<float>
    as_vtk(const std::vector<double> &values, const unsigned int n_components)
    {
      if (n_components == 1)
        return std::vector<float>(values.begin(), values.end());
      std::vector<float> result(values.size() / dim * 3, 0.f);
      for (std::size_t i = 0; i < values.size(); ++i)
        result[i / dim * 3 + i % dim] = values[i];
      return result;
    }

    template <typename T>
    void
    write_data_array(std::ostream         &out,
                     const std::string    &attributes,
                     const std::vector<T> &values)
    {
      out << "<DataArray " << attributes << " format=\"binary\">\n";
      write_blocks(out, values);
      out << "</DataArray>\n";
    }

    void
    write_vtu(std::ostream      &out,
              const FieldTable  &table,
              const double       time,
              const unsigned int number)
    {
      const std::size_t  n_cells = table.n_cells();
      const unsigned int n       = table.nodes_per_cell();
      out << "<?xml version=\"1.0\"?>\n"
             "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
             "byte_order=\"LittleEndian\" "
             "compressor=\"vtkZLibDataCompressor\">\n"
             "<UnstructuredGrid>\n<FieldData>\n"
          << format("<DataArray type=\"Float64\" Name=\"TIME\" "
                    "NumberOfTuples=\"1\" format=\"ascii\">%.12g</DataArray>\n"
                    "<DataArray type=\"Int32\" Name=\"CYCLE\" "
                    "NumberOfTuples=\"1\" format=\"ascii\">%u</DataArray>\n"
                    "</FieldData>\n"
                    "<Piece NumberOfPoints=\"%zu\" NumberOfCells=\"%zu\">\n",
                    time,
                    number,
                    table.n_nodes,
                    n_cells);
      out << "<Points>\n";
      write_data_array(out,
                       "type=\"Float32\"" + components(dim),
                       as_vtk(table.values(table.positions, dim), dim));
      out << "</Points>\n<Cells>\n";
      {
        std::vector<std::int32_t> nodes =
          table.connectivity<std::int32_t>(table.n_nodes);
        write_data_array(out, "type=\"Int32\" Name=\"connectivity\"", nodes);
        nodes.resize(n_cells);
        for (std::size_t c = 0; c < n_cells; ++c)
          nodes[c] = (c + 1) * n;
        write_data_array(out, "type=\"Int32\" Name=\"offsets\"", nodes);
        write_data_array(
          out,
          "type=\"UInt8\" Name=\"types\"",
          std::vector<std::uint8_t>(n_cells, table.kind().vtk_type));
      }
      out << "</Cells>\n<PointData>\n";
      for (const FieldTable::Column &column : table.columns)
        write_data_array(out,
                         "type=\"Float32\" Name=\"" + escaped(column.name) +
                           "\"" + components(column.n_components),
                         as_vtk(table.values(column.fill, column.n_components),
                                column.n_components));
      out << "</PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
    }

    void
    write_pvtu(std::ostream                   &out,
               const FieldTable               &table,
               const std::vector<std::string> &pieces)
    {
      out << "<?xml version=\"1.0\"?>\n"
             "<VTKFile type=\"PUnstructuredGrid\" version=\"0.1\" "
             "byte_order=\"LittleEndian\">\n"
             "<PUnstructuredGrid GhostLevel=\"0\">\n<PPointData>\n";
      for (const FieldTable::Column &column : table.columns)
        out << "<PDataArray type=\"Float32\" Name=\"" << escaped(column.name)
            << "\"" << components(column.n_components) << "/>\n";
      out << "</PPointData>\n<PPoints>\n<PDataArray type=\"Float32\""
          << components(dim) << "/>\n</PPoints>\n";
      for (const std::string &piece : pieces)
        out << "<Piece Source=\"" << escaped(piece) << "\"/>\n";
      out << "</PUnstructuredGrid>\n</VTKFile>\n";
    }

    void
    write_pvd(std::ostream                                      &out,
              const std::vector<std::pair<double, std::string>> &series)
    {
      out << "<?xml version=\"1.0\"?>\n"
             "<VTKFile type=\"Collection\" version=\"0.1\" "
             "byte_order=\"LittleEndian\">\n<Collection>\n";
      for (const auto &[time, file] : series)
        out << format("<DataSet timestep=\"%.12g\" group=\"\" part=\"0\" "
                      "file=\"",
                      time)
            << escaped(file) << "\"/>\n";
      out << "</Collection>\n</VTKFile>\n";
    }

    /** Reference of an XDMF file to an array of the .h5 file. */
    std::string
    data_item(const std::string &file,
              const std::string &name,
              const std::size_t  n,
              const unsigned int n_columns)
    {
      return format("<DataItem Dimensions=\"%zu %u\" NumberType=\"%s\" "
                    "Format=\"HDF\">\n",
                    n,
                    n_columns,
                    name == "cells" ? "UInt" : "Float\" Precision=\"8") +
             escaped(file + ":/" + name) + "\n</DataItem>\n";
    }

    /** Meshes of all states in VTKHDF's terms. Cells share no nodes, so states with the
     *  same number of nodes share a mesh. */
    struct VtkhdfMeshes
    {
      using Integers = std::vector<long long>;

      /** Index of the mesh of a state, stored in its file. */
      std::size_t
      find_or_add(const FieldTable  &table,
                  const std::string &file,
                  const std::size_t  n_nodes_of_state)
      {
        const unsigned int n    = table.nodes_per_cell();
        const auto         same = std::find(n_nodes.begin(),
                                    n_nodes.end(),
                                    static_cast<long long>(n_nodes_of_state));
        const std::size_t  m    = same - n_nodes.begin();
        if (same == n_nodes.end())
          {
            const std::size_t n_new = n_nodes_of_state / n;
            first_cell.push_back(types.size());
            n_nodes.push_back(n_nodes_of_state);
            n_cells.push_back(n_new);
            for (std::size_t c = 0; c <= n_new; ++c)
              offsets.push_back(c * n);
            types.resize(types.size() + n_new, table.kind().vtk_type);
            nodes_of_cells.push_back({file, "cells", n_new});
          }
        return m;
      }

      void
      write(Hdf5File &out, const unsigned int nodes_per_cell) const
      {
        out.write("VTKHDF/NumberOfPoints", n_nodes);
        out.write("VTKHDF/NumberOfCells", n_cells);
        out.write("VTKHDF/NumberOfConnectivityIds", n_nodes);
        out.write("VTKHDF/Offsets", offsets);
        out.write("VTKHDF/Types", types);
        out.write_joined<long long>(
          "VTKHDF/Connectivity", nodes_of_cells, nodes_per_cell, 0);
      }

      Integers                    n_nodes, n_cells, first_cell, offsets;
      std::vector<unsigned char>  types;
      std::vector<Hdf5File::Part> nodes_of_cells;
    };
  } // namespace

  const FieldTable::Kind &
  FieldTable::kind() const
  {
    static const std::map<Cell, Kind> kinds = {
      {Cell::point, {1, 1, "Polyvertex", {{0}}}},
      {Cell::triangle, {3, 5, "Triangle", {{0, 1, 2}}}},
      {Cell::quadrilateral, {4, 9, "Quadrilateral", {{0, 1, 3, 2}}}},
      {Cell::tetrahedron, {4, 10, "Tetrahedron", {{0, 1, 2, 3}}}},
      {Cell::hexahedron, {8, 12, "Hexahedron", {{0, 1, 3, 2, 4, 5, 7, 6}}}}};
    return kinds.at(cell);
  }

  FieldFiles::FieldFiles(const std::string &base, const FieldsFormat format)
    : base(base)
    , format(format)
  {}

  void
  FieldFiles::write(const FieldTable  &table,
                    const std::string &folder,
                    const double       time,
                    const MPI_Comm     comm)
  {
    // A rank that fails alone would leave the others waiting for it.
    std::string problem;
    const auto  end_together = [&]() {
      problem = text_of_any_rank(comm, problem);
      if (!problem.empty())
        throw StepFailure(problem);
    };
    if (format != FieldsFormat::hdf5)
      {
        attempt(problem, [&]() { write_as_vtu(table, folder, time, comm); });
        // The index names only existing pieces.
        end_together();
        attempt(problem, [&]() { record_vtu(table, folder, time, comm); });
      }
    if (format != FieldsFormat::vtu)
      write_as_hdf5(table, folder, time, comm, problem);
    end_together();
    ++number;
  }

  std::string
  FieldFiles::piece(const unsigned int rank, const unsigned int n_ranks) const
  {
    return base + geocone::format("-%04u", number) +
           (n_ranks == 1 ? ".vtu" : geocone::format(".%03u.vtu", rank));
  }

  void
  FieldFiles::write_as_vtu(const FieldTable  &table,
                           const std::string &folder,
                           const double       time,
                           const MPI_Comm     comm) const
  {
    write_file(folder + "/" +
                 piece(dealii::Utilities::MPI::this_mpi_process(comm),
                       dealii::Utilities::MPI::n_mpi_processes(comm)),
               [&](std::ostream &out) { write_vtu(out, table, time, number); });
  }

  void
  FieldFiles::record_vtu(const FieldTable  &table,
                         const std::string &folder,
                         const double       time,
                         const MPI_Comm     comm)
  {
    if (dealii::Utilities::MPI::this_mpi_process(comm) != 0)
      return;
    const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(comm);
    std::string        whole   = piece(0, n_ranks);
    if (n_ranks > 1)
      {
        std::vector<std::string> pieces;
        for (unsigned int r = 0; r < n_ranks; ++r)
          pieces.push_back(piece(r, n_ranks));
        whole = base + geocone::format("-%04u.pvtu", number);
        write_file(folder + "/" + whole,
                   [&](std::ostream &out) { write_pvtu(out, table, pieces); });
      }
    vtu.emplace_back(time, whole);
    write_file(folder + "/" + base + ".pvd",
               [&](std::ostream &out) { write_pvd(out, vtu); });
  }

  void
  FieldFiles::write_as_hdf5(const FieldTable  &table,
                            const std::string &folder,
                            const double       time,
                            const MPI_Comm     comm,
                            std::string       &problem)
  {
    const std::size_t n_nodes =
      dealii::Utilities::MPI::sum(table.n_nodes, comm);
    if (n_nodes == 0)
      return; // nothing to write
    const bool writes = dealii::Utilities::MPI::this_mpi_process(comm) == 0;
    const unsigned int        n    = table.nodes_per_cell();
    const std::string         file = base + geocone::format("-%04u.h5", number);
    std::unique_ptr<Hdf5File> out;
    // Between the attempts only the arrays of all ranks are collected.
    if (writes)
      attempt(problem, [&]() {
        out = std::make_unique<Hdf5File>(folder + "/" + file,
                                         Hdf5File::Access::create);
        out->write_table("cells", table.connectivity<unsigned int>(n_nodes), n);
      });
    const auto write_array = [&](const std::string      &name,
                                 const FieldTable::Fill &fill,
                                 const unsigned int      n_components,
                                 const unsigned int      n_columns) {
      const std::vector<double> all =
        gather(table.values(fill, n_components), comm);
      if (writes)
        attempt(problem, [&]() {
          if (n_columns == n_components)
            {
              out->write_table(name, all, n_columns);
              return;
            }
          std::vector<double> wide(n_nodes * n_columns, 0.);
          for (std::size_t i = 0; i < all.size(); ++i)
            wide[i / n_components * n_columns + i % n_components] = all[i];
          out->write_table(name, wide, n_columns);
        });
    };
    write_array("nodes", table.positions, dim, dim);
    for (const FieldTable::Column &column : table.columns)
      write_array(column.name,
                  column.fill,
                  column.n_components,
                  column.n_components > 1 ? 3 : 1);
    if (writes)
      attempt(problem, [&]() {
        out->close();
        hdf5.push_back({time, file, n_nodes});
        write_xdmf(table, folder);
        write_vtkhdf(table, folder);
      });
  }

  void
  FieldFiles::write_xdmf(const FieldTable  &table,
                         const std::string &folder) const
  {
    const unsigned int n = table.nodes_per_cell();
    write_file(folder + "/" + base + ".xdmf", [&](std::ostream &out) {
      out << "<?xml version=\"1.0\" ?>\n<Xdmf Version=\"2.0\">\n<Domain>\n"
             "<Grid Name=\"CellTime\" GridType=\"Collection\" "
             "CollectionType=\"Temporal\">\n";
      for (const auto &[time, file, n_nodes] : hdf5)
        {
          out << geocone::format("<Grid Name=\"mesh\" GridType=\"Uniform\">\n"
                                 "<Time Value=\"%.12g\"/>\n"
                                 "<Geometry GeometryType=\"%s\">\n",
                                 time,
                                 dim == 2 ? "XY" : "XYZ")
              << data_item(file, "nodes", n_nodes, dim)
              << geocone::format("</Geometry>\n<Topology TopologyType=\"%s\" "
                                 "NumberOfElements=\"%zu\"%s>\n",
                                 table.kind().xdmf_type,
                                 n_nodes / n,
                                 n == 1 ? " NodesPerElement=\"1\"" : "")
              << data_item(file, "cells", n_nodes / n, n) << "</Topology>\n";
          for (const FieldTable::Column &column : table.columns)
            out << "<Attribute Name=\"" << escaped(column.name)
                << "\" AttributeType=\""
                << (column.n_components > 1 ? "Vector" : "Scalar")
                << "\" Center=\"Node\">\n"
                << data_item(file,
                             column.name,
                             n_nodes,
                             column.n_components > 1 ? 3 : 1)
                << "</Attribute>\n";
          out << "</Grid>\n";
        }
      out << "</Grid>\n</Domain>\n</Xdmf>\n";
    });
  }

  void
  FieldFiles::write_vtkhdf(const FieldTable  &table,
                           const std::string &folder) const
  {
    using Integers = VtkhdfMeshes::Integers;
    VtkhdfMeshes meshes;
    struct
    {
      std::vector<double> times;
      Integers            mesh, first_node, first_cell, first_node_of_cell;
    } states;
    std::size_t n_nodes = 0;
    for (const Hdf5State &state : hdf5)
      {
        const unsigned int m =
          meshes.find_or_add(table, state.file, state.n_nodes);
        states.times.push_back(state.time);
        states.mesh.push_back(m);
        states.first_node.push_back(n_nodes);
        states.first_cell.push_back(meshes.first_cell[m]);
        states.first_node_of_cell.push_back(meshes.first_cell[m] *
                                            table.nodes_per_cell());
        n_nodes += state.n_nodes;
      }
    const auto parts = [&](const std::string &name) {
      std::vector<Hdf5File::Part> all;
      for (const Hdf5State &state : hdf5)
        all.push_back({state.file, name, state.n_nodes});
      return all;
    };

    // Names defined by VTKHDF.
    Hdf5File out(folder + "/" + base + ".vtkhdf", Hdf5File::Access::create);
    out.write_attribute("VTKHDF", "Version", Integers{2, 0});
    out.write_attribute("VTKHDF", "Type", std::string("UnstructuredGrid"));
    meshes.write(out, table.nodes_per_cell());
    out.write_joined<double>("VTKHDF/Points", parts("nodes"), dim, 3);

    out.write_attribute(
      "VTKHDF/Steps", "NSteps", Integers{static_cast<long long>(hdf5.size())});
    out.write("VTKHDF/Steps/Values", states.times);
    out.write("VTKHDF/Steps/PartOffsets", states.mesh);
    out.write("VTKHDF/Steps/NumberOfParts", Integers(hdf5.size(), 1));
    out.write("VTKHDF/Steps/PointOffsets", states.first_node);
    out.write("VTKHDF/Steps/CellOffsets", states.first_cell);
    out.write("VTKHDF/Steps/ConnectivityIdOffsets", states.first_node_of_cell);
    for (const auto &[name, n_components, fill] : table.columns)
      {
        const unsigned int n_columns = n_components > 1 ? 3 : 1;
        out.write_joined<double>("VTKHDF/PointData/" + name,
                                 parts(name),
                                 n_columns,
                                 n_components > 1 ? 3 : 0);
        out.write("VTKHDF/Steps/PointDataOffsets/" + name, states.first_node);
      }
    out.close();
  }
} // namespace geocone::GEOCONE_DIM
