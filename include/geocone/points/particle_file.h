// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_points_particle_file_h
#define geocone_points_particle_file_h

#include <geocone/base/types.h>
#include <geocone/materials/material_library.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <memory>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** A particle before its life: what the scene says of it. */
  struct Seed
  {
    dealii::Point<dim>     position;
    double                 volume = 0.; ///< per unit thickness (m^2), or (m^3)
    double                 cell = 0.; ///< BackgroundMesh::size_of its cell (m)
    unsigned int           material = 0;
    dealii::Tensor<1, dim> velocity;
    Mandel                 stress    = Mandel::Zero();
    double                 stress_zz = 0.;
  };

  /**
   * A table of particles, read in parts: a .csv file whose first line names its
   * columns, or an .h5 file with an array for each: x, y (m), volume (m^2), and,
   * if given, material (name in .csv, or number from 0), vx and vy (m/s), sxx and
   * syy and sxy (Pa). In three dimensions z, vz, szz, syz, szx, too, and m^3.
   * A .csv file may begin with a byte-order mark, have lines that
   * end in any way, names in double quotes, and blank lines at its end.
   * @throws InputError naming the parameter, the file, the place, and what is wrong
   * there; the same on all ranks that read the file
   */
  class ParticleFile
  {
  public:
    /** The columns, in the order of the class's text. */
    enum Column : unsigned int
    {
      x, ///< and the other coordinates
      volume = x + dim,
      material,
      vx, ///< and its other components
      sxx       = vx + dim,
      n_columns = sxx + n_mandel
    };

    ParticleFile(const std::string &file_name, const Materials &materials);
    ~ParticleFile();

    bool
    has(const Column column) const;

    /** Up to @p n more seeds; none: the end of the file. */
    std::vector<Seed>
    read(const std::size_t n);

    /** Rows of a file, if it is one: of .csv by the length of its first lines. */
    static double
    expected_number(const std::string &file_name);

    /** How the rows of a file are read. */
    class Reader;

  private:
    const std::string       file_name;
    std::unique_ptr<Reader> reader;
  };
} // namespace geocone::GEOCONE_DIM

#endif
