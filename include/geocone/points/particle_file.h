// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_points_particle_file_h
#define geocone_points_particle_file_h

#include <geocone/base/types.h>
#include <geocone/laws/material_library.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <memory>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Initial data of a particle, from the scene or a file. */
  struct Seed
  {
    dealii::Point<dim>     position;
    double                 volume = 0.; ///< per unit thickness (m^2); or m^3
    double                 cell = 0.; ///< BackgroundMesh::size_of its cell (m)
    unsigned int           material = 0;
    dealii::Tensor<1, dim> velocity;
    Mandel                 stress    = Mandel::Zero();
    double                 stress_zz = 0.;
  };

  /**
   * Reader of particle files. A file is read in blocks and is either a .csv file
   * whose first line contains the column names, or an .h5 file with one array per
   * column. Columns are x, y (m), volume (m^2), and, if given, material (name in
   * .csv, or number from 0), vx and vy (m/s), sxx and syy and sxy (Pa); in three
   * dimensions also z, vz, szz, syz, szx, with volumes in m^3. A .csv file can
   * have a byte-order mark, any line ends, names in double quotes, and blank lines
   * at its end.
   * @throws InputError naming the parameter, the file, the position and the
   * fault; the same on all ranks that read the file
   */
  class ParticleFile
  {
  public:
    /** Columns of a particle file. */
    enum Column : unsigned int
    {
      x, ///< followed by the other coordinates
      volume = x + dim,
      material,
      vx, ///< followed by the other components
      sxx       = vx + dim,
      n_columns = sxx + n_mandel
    };

    ParticleFile(const std::string &file_name, const Materials &materials);
    ~ParticleFile();

    bool
    has(const Column column) const;

    /** Reads the next @p n particles, or fewer at the end of the file. */
    std::vector<Seed>
    read(const std::size_t n);

    /** Number of particles in a file; zero if the file does not exist. For .csv it
     *  is estimated from the first lines. */
    static double
    expected_number(const std::string &file_name);

    /** Reader of particle files in one format (.csv or .h5). */
    class Reader;

  private:
    const std::string       file_name;
    std::unique_ptr<Reader> reader;
  };
} // namespace geocone::GEOCONE_DIM

#endif
