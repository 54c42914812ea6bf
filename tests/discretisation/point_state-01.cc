// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// The state of points is one list of variables in two layouts. If it were not carried
// whole, by sorting, by sending to other ranks, and by filling up vectors, a point would
// get numbers of another one, or lose some.

#include <geocone/points/material_points.h>
#include <geocone/points/point_arrays.h>

#include "../test.h"
#include "setup.h"

#include <numeric>

namespace discretisation_point_state_01
{
  using namespace discretisation_tests;
  using namespace geocone;

  unsigned int
  rank()
  {
    return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  }

  /** A number for each place of the row of a point. */
  std::vector<double>
  row_of(const unsigned int id, const unsigned int n)
  {
    std::vector<double> row(n);
    for (unsigned int i = 0; i < n; ++i)
      row[i] = 1000. * id + i;
    return row;
  }

  /** Whether each point has all numbers of the one that it was. */
  template <typename Points>
  bool
  are_whole(const Points &points, const std::vector<unsigned int> &wanted)
  {
    bool                whole = points.n_points() == wanted.size();
    std::vector<double> row(points.n_numbers());
    for (unsigned int p = 0; p < points.n_points() && whole; ++p)
      {
        points.get(p, row.data());
        whole = row == row_of(wanted[p], row.size());
      }
    return whole;
  }

  template <typename Points>
  void
  test(const char *name, Points points)
  {
    if (speaks())
      std::printf("%s: %s\n", name, points.variables().c_str());
    // Five on each rank, counted through.
    std::vector<unsigned int> ids(5);
    std::iota(ids.begin(), ids.end(), 5 * rank());
    for (const unsigned int id : ids)
      points.append(row_of(id, points.n_numbers()).data());
    print("filled", are_whole(points, ids));

    points.reorder({4, 2, 0});
    ids = {ids[4], ids[2], ids[0]};
    print("sorted, some removed", are_whole(points, ids));

    // The first goes to the other rank, the second is nobody's.
    const unsigned int n_ranks =
      dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    const unsigned int other = (rank() + 1) % n_ranks;
    migrate(points, {other, nobody, rank()}, MPI_COMM_WORLD);
    ids = n_ranks == 1 ? std::vector<unsigned int>{ids[0], ids[2]}
                       : std::vector<unsigned int>{ids[2], 5 * other + 4};
    print("sent to other ranks", are_whole(points, ids));
  }

  void
  test(int argc, char **argv)
  {
    dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

    MaterialPoints particles, fixed;
    particles.use(true, 2);
    test("particles", particles);
    fixed.use(false, 1);
    test("points that stay", fixed);
    test("explicit, affine, in cells", PointArrays(0, 2, true, true));
    test("explicit", PointArrays(0, 0, false, false));

    // What fills up the vectors is a copy without mass and volume.
    PointArrays arrays(0, 1, false, false);
    for (unsigned int id = 1; id < 7; ++id)
      arrays.append(row_of(id, arrays.n_numbers()).data());
    arrays.pad();
    print("six points take eight places",
          arrays.n_points() == 6 && arrays.n_padded() == 8);
    print("copies have no mass and no volume",
          arrays.mass[6] == 0. && arrays.volume[7] == 0.);
    print("but the last one's place",
          arrays.position.of(7) == arrays.position.of(5));
    arrays.append(row_of(7, arrays.n_numbers()).data());
    arrays.pad();
    print("one more takes a place of a copy",
          arrays.n_padded() == 8 && are_whole(arrays, {1, 2, 3, 4, 5, 6, 7}));
    PointArrays grown(0, 1, false, false);
    grown.append(row_of(1, grown.n_numbers()).data());
    grown.pad();
    print("a new point begins with zeros",
          grown.mass[grown.append()] == 0. && grown.position[0][1] == 0.);
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace discretisation_point_state_01
