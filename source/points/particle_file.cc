// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/csv_reader.h>
#include <geocone/base/exceptions.h>
#include <geocone/base/hdf5_file.h>
#include <geocone/base/largest_quantity.h>
#include <geocone/base/log.h>
#include <geocone/points/particle_file.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    using Column = ParticleFile::Column;
    using Row    = std::array<double, Column::n_columns>;

    const std::vector<std::string> names = [] {
      std::vector<std::string> list;
      for (unsigned int d = 0; d < dim; ++d)
        list.emplace_back(1, coordinate[d]);
      list.insert(list.end(), {"volume", "material"});
      for (unsigned int d = 0; d < dim; ++d)
        list.push_back(std::string("v") + coordinate[d]);
      for (int i = 0; i < n_mandel; ++i)
        list.push_back(std::string("s") + tensor_component[i]);
      return list;
    }();

    /** Columns of a group, from the first one on. */
    std::vector<Column>
    group_of(const Column first, const unsigned int n)
    {
      std::vector<Column> group;
      for (unsigned int i = 0; i < n; ++i)
        group.push_back(static_cast<Column>(first + i));
      return group;
    }

    /** About 10^9 rows, more than the largest number of points. */
    constexpr std::uintmax_t largest_particle_file = 1ULL << 37;

    constexpr const char *unit = dim == 2 ? "m^2" : "m^3"; ///< of volumes

    InputError
    refused(const std::string &file, const std::string &what)
    {
      return InputError("Particles/File",
                        file,
                        std::string("a .csv or .h5 file of ") + coordinates +
                          ", volume > 0 and, if given, material, " +
                          (dim == 2 ? "vx and vy, sxx and syy and sxy"
                                    : "vx, vy and vz, and the six stresses sxx "
                                      "to szx"),
                        what);
    }
  } // namespace

  class ParticleFile::Reader
  {
  public:
    Reader(const std::string &file, const Materials &materials)
      : file(file)
      , materials(materials)
    {
      given.fill(false);
    }
    virtual ~Reader() = default;

    /** Appends up to @p n rows. */
    virtual void
    read(const std::size_t n, std::vector<Row> &rows) = 0;

    /** Whether each column is in the file. */
    std::array<bool, Column::n_columns> given;

  protected:
    /** Columns of a group are given together; the first group is required. */
    void
    check_columns() const
    {
      const std::vector<std::vector<Column>> groups = {
        group_of(x, dim + 1), group_of(vx, dim), group_of(sxx, n_mandel)};
      for (const auto &group : groups)
        if (group == groups[0] ||
            std::any_of(group.begin(), group.end(), [&](const Column column) {
              return given[column];
            }))
          for (const Column column : group)
            if (!given[column])
              throw refused(file,
                            "the column '" + names[column] + "' is missing");
    }

    /** @throws InputError for an inadmissible value @param place e.g. the
     *  line */
    template <typename Place>
    void
    check(const Column column, const double value, const Place &place) const
    {
      std::string what;
      if (!std::isfinite(value))
        what = "is not a finite number";
      else if (column == volume && value <= 0.)
        what = "is not > 0";
      else if (column == material && (value < 0. || value >= materials.size() ||
                                      value != std::floor(value)))
        what = "is no material: they are counted from 0 to " +
               std::to_string(materials.size() - 1);
      else if (std::abs(value) > largest_quantity)
        what = std::string("is larger than 1e30; give it in m, ") + unit +
               ", m/s or Pa";
      else if (column == volume && value < 1. / largest_quantity)
        what =
          std::string("is smaller than 1e-30 ") + unit + "; give it in " + unit;
      if (!what.empty())
        throw refused(file, place() + format("%g ", value) + what);
    }

    const std::string file;
    const Materials  &materials;
  };

  namespace
  {
    class CsvParticles : public ParticleFile::Reader
    {
    public:
      CsvParticles(const std::string &file, const Materials &materials)
        : Reader(file, materials)
        , in(file)
      {
        for (unsigned int i = 0; i < materials.size(); ++i)
          number_of_material[materials.name(i)] = i;
        for (const std::string &name : in.names())
          {
            const std::size_t column =
              std::find(names.begin(), names.end(), name) - names.begin();
            if (column == Column::n_columns || given[column])
              throw refused(file,
                            in.place(columns.size()) +
                              ": not one of these names, or there twice");
            given[column] = true;
            columns.push_back(static_cast<Column>(column));
          }
        check_columns();
      }

      void
      read(const std::size_t n, std::vector<Row> &rows) override
      {
        std::vector<std::string> texts;
        for (std::size_t i = 0; i < n && in.next_row(texts); ++i)
          rows.push_back(row(texts));
      }

    private:
      Row
      row(const std::vector<std::string> &texts) const
      {
        Row values = {};
        for (std::size_t c = 0; c < columns.size(); ++c)
          {
            const Column column      = columns[c];
            const bool   is_material = column == ParticleFile::material;
            if (const auto named = number_of_material.find(texts[c]);
                is_material && named != number_of_material.end())
              {
                values[column] = named->second;
                continue;
              }
            values[column] = is_material ? in.number(texts, c, "is no material")
                                         : in.number(texts, c);
            check(column, values[column], [&]() { return in.place(c) + ": "; });
          }
        return values;
      }

      CsvReader                     in;
      std::map<std::string, double> number_of_material;
      std::vector<Column>           columns;
    };

    class Hdf5Particles : public ParticleFile::Reader
    {
    public:
      Hdf5Particles(const std::string &file_name, const Materials &materials)
        : Reader(file_name, materials)
        , in(file_name, Hdf5File::Access::read)
      {
        for (unsigned int c = 0; c < Column::n_columns; ++c)
          given[c] = in.has(names[c]);
        check_columns();
        length = in.length("x");
        for (unsigned int c = 0; c < Column::n_columns; ++c)
          if (given[c] && in.length(names[c]) != length)
            throw refused(file,
                          "the columns 'x' and '" + names[c] +
                            "' have different lengths");
      }

      void
      read(const std::size_t n, std::vector<Row> &rows) override
      {
        const std::size_t first  = rows.size(),
                          n_here = std::min(n, length - at);
        rows.resize(first + n_here, Row());
        for (unsigned int c = 0; c < Column::n_columns && n_here > 0; ++c)
          if (given[c])
            {
              const std::vector<double> values =
                in.read_doubles(names[c], at, n_here);
              for (std::size_t i = 0; i < n_here; ++i)
                {
                  check(static_cast<Column>(c), values[i], [&]() {
                    return format("entry %zu (from 0) of '", at + i) +
                           names[c] + "': ";
                  });
                  rows[first + i][c] = values[i];
                }
            }
        at += n_here;
      }

    private:
      const Hdf5File in;
      std::size_t    length = 0, at = 0;
    };

    bool
    is_hdf5(const std::string &file_name)
    {
      return std::filesystem::path(file_name).extension() == ".h5";
    }
  } // namespace

  ParticleFile::ParticleFile(const std::string &file_name,
                             const Materials   &materials)
    : file_name(file_name)
  {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file_name, error))
      throw refused(file_name, "it is no regular file");
    if (std::filesystem::file_size(file_name, error) > largest_particle_file)
      throw refused(file_name, "it is larger than 128 GB: is it a table?");
    try
      {
        if (is_hdf5(file_name))
          reader = std::make_unique<Hdf5Particles>(file_name, materials);
        else
          reader = std::make_unique<CsvParticles>(file_name, materials);
      }
    catch (const RunError &error)
      {
        throw refused(file_name, error.what());
      }
  }

  ParticleFile::~ParticleFile() = default;

  bool
  ParticleFile::has(const Column column) const
  {
    return reader->given[column];
  }

  std::vector<Seed>
  ParticleFile::read(const std::size_t n)
  {
    std::vector<Row> rows;
    rows.reserve(std::min<std::size_t>(n, 1 << 16));
    try
      {
        reader->read(n, rows);
      }
    catch (const RunError &error)
      {
        throw refused(file_name, error.what());
      }
    std::vector<Seed> seeds(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      {
        const Row &row    = rows[i];
        seeds[i].volume   = row[volume];
        seeds[i].material = static_cast<unsigned int>(row[material]);
        for (unsigned int d = 0; d < dim; ++d)
          {
            seeds[i].position[d] = row[x + d];
            seeds[i].velocity[d] = row[vx + d];
          }
        std::array<double, n_mandel> stress;
        std::copy_n(&row[sxx], n_mandel, stress.begin());
        seeds[i].stress = mandel_of_components(stress);
      }
    return seeds;
  }

  double
  ParticleFile::expected_number(const std::string &file_name)
  {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file_name, error))
      return 0.;
    if (is_hdf5(file_name))
      try
        {
          return Hdf5File(file_name, Hdf5File::Access::read).length("x");
        }
      catch (const RunError &)
        {
          return 0.; // reported when the file is read
        }
    std::vector<char> start(1 << 16);
    std::ifstream     in(file_name, std::ios::binary);
    in.read(start.data(), start.size());
    // The first line holds the column names.
    const double n_lines = std::max(
      0., std::count(start.begin(), start.begin() + in.gcount(), '\n') - 1.);
    return in.gcount() > 0
             ? n_lines * std::filesystem::file_size(file_name, error) /
                 in.gcount()
             : 0.;
  }
} // namespace geocone::GEOCONE_DIM
