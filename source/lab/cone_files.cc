// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/hdf5_file.h>
#include <geocone/base/largest_quantity.h>
#include <geocone/lab/cone_files.h>

#include <Eigen/SparseLU>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  using Eigen::VectorXd;

  namespace
  {
    /** Limits beyond which a text file is certainly invalid. */
    constexpr double         most_cones           = 1e6;
    constexpr std::uintmax_t largest_problem_file = 1ULL << 32;

    /** Numbers of a text file, one after the other. */
    class Numbers
    {
    public:
      explicit Numbers(const std::string &file_name)
        : file_name(file_name)
      {
        std::error_code error;
        if (std::filesystem::exists(file_name, error) &&
            !std::filesystem::is_regular_file(file_name, error))
          fail("is no regular file");
        std::ifstream in(file_name);
        if (!in)
          fail("cannot be opened");
        if (std::filesystem::file_size(file_name, error) > largest_problem_file)
          fail("is larger than 4 GB");
        text.assign(std::istreambuf_iterator<char>(in), {});
        place = text.c_str();
        skip_space();
      }

      [[noreturn]] void
      fail(const std::string &what) const
      {
        throw InputError("file '" + file_name + "' " + what +
                         "\n  allowed: an argument file of Siconos' tests of "
                         "plasticity or of contact\n  remedy:  copy or write "
                         "it again");
      }

      bool
      at_end() const
      {
        return place == text.c_str() + text.size();
      }

      /** @throws InputError if fewer than n numbers can follow */
      void
      check_room(const std::size_t n, const std::string &what) const
      {
        // Each has at least one character and a separator.
        const std::size_t left = text.c_str() + text.size() - place;
        if (n > (left + 1) / 2)
          fail("ends within " + what);
      }

      double
      next(const std::string &what)
      {
        if (at_end())
          fail("ends within " + what);
        char        *end;
        const double x = std::strtod(place, &end);
        if (end == place || !(std::abs(x) <= largest_quantity))
          fail("has '" + word() + "' within " + what +
               ", where a number of at most 1e30 must be");
        place = end;
        skip_space();
        return x;
      }

      /** Reads a number that counts something: 0, 1, ..., @p most. */
      std::size_t
      count(const double most, const std::string &what)
      {
        const double x = next(what);
        if (!(x >= 0. && x <= most && x == std::floor(x)))
          fail("has " + shown(x) + " as " + what + ", which must be 0 to " +
               shown(most));
        return static_cast<std::size_t>(x);
      }

      /** Reads a number that must have the given value. */
      void
      expect(const double value, const std::string &what)
      {
        const double x = next(what);
        if (x != value)
          fail("has " + what + " = " + shown(x) + ", which must be " +
               shown(value));
      }

      /** Number of remaining words. @param[out] last the last one */
      std::size_t
      left(std::string &last) const
      {
        std::size_t n = 0;
        for (const char *at = place; *at != 0; ++n)
          {
            last.assign(at, std::strcspn(at, " \t\r\n"));
            at += std::strcspn(at, " \t\r\n");
            at += std::strspn(at, " \t\r\n");
          }
        return n;
      }

      /** Whether a given text follows; if so, skips it. */
      bool
      follows(const std::string &wanted)
      {
        if (std::strncmp(place, wanted.c_str(), wanted.size()) != 0)
          return false;
        place += wanted.size();
        skip_space();
        return true;
      }

      void
      expect(const std::string &wanted)
      {
        if (!follows(wanted))
          fail("has '" + word() + "' where '" + wanted + "' must be");
      }

      void
      skip_line()
      {
        place += std::strcspn(place, "\n");
        skip_space();
      }

      VectorXd
      vector(const unsigned int size, const std::string &what)
      {
        check_room(size, what);
        VectorXd x(size);
        for (double &value : x)
          value = next(what);
        return x;
      }

      static std::string
      shown(const double x)
      {
        std::ostringstream out;
        out << x;
        return out.str();
      }

    private:
      void
      skip_space()
      {
        place += std::strspn(place, " \t\r\n");
      }

      /** Present word, for messages. */
      std::string
      word() const
      {
        return std::string(
          place, std::min<std::size_t>(40, std::strcspn(place, " \t\r\n")));
      }

      std::string file_name;
      std::string text;
      const char *place = nullptr;
    };

    using Triplets = std::vector<Eigen::Triplet<double>>;

    Triplets
    read_dense(Numbers &in, const unsigned int size)
    {
      for (const char *what : {"rows", "columns"})
        in.expect(size, std::string("the number of ") + what);
      in.check_room(std::size_t(size) * size, "the matrix");
      Triplets entries;
      for (unsigned int i = 0; i < size; ++i)
        for (unsigned int j = 0; j < size; ++j)
          if (const double w = in.next("the matrix"); w != 0.)
            entries.emplace_back(i, j, w);
      return entries;
    }

    /** Reads a matrix as printed by the library CSparse: triplets, columns or rows. */
    Triplets
    read_sparse(Numbers &in, const unsigned int size)
    {
      enum Origin
      {
        triplets = 1,
        columns,
        rows
      };
      const auto origin = in.count(4, "the origin of the sparse matrix");
      if (origin < triplets || origin > rows)
        in.fail("has the origin of the sparse matrix " +
                std::to_string(origin) +
                ", which must be 1 (triplets), 2 (columns) or 3 (rows)\n"
                "  remedy:  convert it in Siconos, e.g. by NM_triplet()");
      in.expect("CSparse");
      in.skip_line();
      if (origin != columns)
        in.expect(origin == triplets ? "triplet:" : "csr:");
      in.expect(size, "the number of rows");
      in.expect("-by-");
      in.expect(size, "the number of columns");
      in.expect(", nzmax:");
      in.next("the room for entries");
      in.expect("nnz:");
      const std::size_t n =
        in.count(double(size) * size, "the number of entries");
      in.check_room((origin == triplets ? 3 : 2) * n, "the matrix");

      Triplets entries;
      if (origin == triplets)
        {
          for (std::size_t k = 0; k < n; ++k)
            {
              const auto i = in.count(size - 1., "a row of the matrix");
              const auto j = in.count(size - 1., "a column of the matrix");
              in.expect(":");
              entries.emplace_back(i, j, in.next("the matrix"));
            }
          return entries;
        }
      in.expect(", 1-norm:");
      in.next("the norm of the matrix");
      const std::string line = origin == columns ? "col" : "row";
      for (unsigned int major = 0; major < size; ++major)
        {
          in.expect(line);
          in.expect(major, "the number of the " + line);
          in.expect(": locations");
          in.expect(entries.size(), "the first entry of the " + line);
          in.expect("to");
          // The last index, or the one before the first if the line is empty.
          const double last = in.next("the last entry of the " + line);
          if (!(last >= entries.size() - 1. && last < double(n)))
            in.fail("has more entries in a " + line + " than there are");
          while (double(entries.size()) <= last)
            {
              const auto minor = in.count(size - 1., "a place in the matrix");
              in.expect(":");
              const double w = in.next("the matrix");
              if (origin == columns)
                entries.emplace_back(minor, major, w);
              else
                entries.emplace_back(major, minor, w);
            }
        }
      return entries;
    }
    /** Reads a matrix of blocks, each stored by columns. */
    Triplets
    read_blocks(Numbers &in, const unsigned int size, const unsigned int n)
    {
      const std::size_t n_blocks =
        in.count(double(n) * n, "the number of blocks");
      for (const char *what : {"rows of blocks", "columns of blocks"})
        in.expect(n, std::string("the number of ") + what);
      const unsigned int d = size / n;
      for (const char *what : {"rows", "columns"})
        for (unsigned int i = 1; i <= n; ++i)
          in.expect(d * i, std::string("the end of ") + what + " of a block");
      const std::size_t n_starts = in.count(n + 1., "the number of block rows");
      const std::size_t n_places =
        in.count(double(n_blocks), "the number of places of blocks");
      if (n_places != n_blocks || n_starts < 1)
        in.fail("has other numbers of blocks and of their places");
      in.check_room(n_starts + n_places, "the places of the blocks");
      std::vector<std::size_t> start, column;
      for (std::size_t i = 0; i < n_starts; ++i)
        {
          start.push_back(
            in.count(double(n_blocks), "the first block of a row"));
          if (i > 0 && start[i] < start[i - 1])
            in.fail("has block rows that are not in order");
        }
      for (std::size_t k = 0; k < n_blocks; ++k)
        column.push_back(in.count(n - 1., "the column of a block"));
      in.check_room(n_blocks * (d * d + 1), "the blocks");
      Triplets entries;
      for (std::size_t row = 0; row + 1 < n_starts; ++row)
        for (std::size_t k = start[row]; k < start[row + 1]; ++k)
          {
            in.expect(double(k), "the number of a block");
            for (unsigned int j = 0; j < d; ++j)
              for (unsigned int i = 0; i < d; ++i)
                if (const double w = in.next("a block"); w != 0.)
                  entries.emplace_back(d * row + i, d * column[k] + j, w);
          }
      if (start.back() != n_blocks)
        in.fail("has blocks that are in no row");
      return entries;
    }

    /** Contact problem from W and q of n cones with d components. */
    ReducedProblem
    contact_problem(const Triplets                                 &entries,
                    const VectorXd                                 &q,
                    const std::vector<double>                      &friction,
                    const unsigned int                              d,
                    const std::function<void(const std::string &)> &fail)
    {
      const unsigned int n = friction.size();
      ReducedProblem     problem;
      Triplets           all;
      problem.q      = VectorXd::Zero(3 * n);
      VectorXd trace = VectorXd::Zero(n);
      for (const auto &entry : entries)
        {
          all.emplace_back(3 * (entry.row() / d) + entry.row() % d,
                           3 * (entry.col() / d) + entry.col() % d,
                           entry.value());
          if (entry.row() == entry.col())
            trace[entry.row() / d] += entry.value();
        }
      for (unsigned int p = 0; p < n; ++p)
        {
          for (unsigned int i = 0; i < d; ++i)
            problem.q[3 * p + i] = q[d * p + i];
          if (d == 2)
            all.emplace_back(3 * p + 2, 3 * p + 2, trace[p] / 2.);
          if (!(friction[p] >= 0.))
            fail("has a coefficient of friction that is not >= 0");
          if (!(trace[p] > 0.))
            fail("has a matrix that is not positive definite");
          problem.cones.push_back({friction[p], 0., 0.});
        }
      problem.W.resize(3 * n, 3 * n);
      problem.W.setFromTriplets(all.begin(), all.end());
      return problem;
    }

    /** Header of a problem file of Siconos. */
    struct SiconosHead
    {
      unsigned int d, n_cones;
      bool         has_model; ///< in newer files
      double       storage;   ///< of the matrix: dense, blocks or sparse
    };

    SiconosHead
    read_siconos_head(Numbers &in)
    {
      const double d_read = in.next("the dimension");
      if (d_read != 2. && d_read != 3.)
        in.fail("has the dimension " + Numbers::shown(d_read) +
                ", which must be 2 or 3");
      const unsigned int d = d_read;
      const double       n = in.next("the number of cones");
      if (!(n >= 1. && n <= most_cones && n == std::floor(n)))
        in.fail("has " + Numbers::shown(n) + " cones");
      const unsigned int size = d * static_cast<unsigned int>(n);

      // Older files, and those of contact, start with the storage, newer ones with the
      // model. The number of rows follows the storage and is larger than any storage
      // type, or is 2 and repeated.
      bool   has_model = false;
      double model = 1., storage = in.next("the type of the model");
      double n_rows = in.next("the storage of the matrix");
      if (n_rows < 3. && size > 2)
        {
          has_model = true;
          model     = storage;
          storage   = n_rows;
          n_rows    = in.next("the number of rows");
        }
      if (model == 2.)
        in.fail(
          "has the type of the model 2 (von Mises), which must be 1 (a "
          "cone)\n  remedy:  none: the yield surface of Siconos' type 2, "
          "sqrt(sx^2 + sy^2 - sx sy + 3 txy^2) = sigma_y, that of plane "
          "stress, is no cone, and stresses return to it by a factor; take "
          "type 1, or a step of geocone with the material Tresca");
      if (model != 1.)
        in.fail("has the type of the model " + Numbers::shown(model) +
                ", which must be 1 (a cone)");
      if (storage != 0. && storage != 1. && storage != 2.)
        in.fail("has the storage of the matrix " + Numbers::shown(storage) +
                ", which must be 0 (dense), 1 (blocks) or 2 (sparse)\n"
                "  remedy:  convert it in Siconos, e.g. by NM_triplet()");
      if (n_rows != size)
        in.fail("has the number of rows = " + Numbers::shown(n_rows) +
                ", which must be " + Numbers::shown(size));
      in.expect(size, "the number of columns");
      return {d, size / d, has_model, storage};
    }
  } // namespace

  ReducedProblem
  read_siconos(const std::string &file_name)
  {
    Numbers            in(file_name);
    const SiconosHead  head = read_siconos_head(in);
    const unsigned int d = head.d, n_cones = head.n_cones;
    const unsigned int size    = d * n_cones;
    const Triplets     entries = head.storage == 0. ? read_dense(in, size)
                                 : head.storage == 1.
                                   ? read_blocks(in, size, n_cones)
                                   : read_sparse(in, size);
    const VectorXd     q       = in.vector(size, "the vector q");
    // One number per cone apart from a flag, and no model: contact.
    std::string        last;
    const std::size_t  left = in.left(last);
    const unsigned int flag = last == "0" || last == "1";
    if (!head.has_model &&
        (left == n_cones || (left == n_cones + 1 && (n_cones > 1 || flag)) ||
         d == 2))
      {
        const VectorXd mu = in.vector(n_cones, "the coefficients of friction");
        if (!in.at_end())
          in.count(1., "the flag at the end");
        if (!in.at_end())
          in.fail("goes on after the coefficients of friction");
        return contact_problem(entries,
                               q,
                               {mu.data(), mu.data() + mu.size()},
                               d,
                               [&](const std::string &what) { in.fail(what); });
      }
    const VectorXd eta   = in.vector(n_cones, "the apertures eta");
    const VectorXd theta = in.vector(n_cones, "the coefficients theta");
    if (!in.at_end())
      in.fail("goes on after the coefficients theta");
    ReducedProblem problem;
    problem.W.resize(size, size);
    problem.W.setFromTriplets(entries.begin(), entries.end());
    problem.q = q;

    for (unsigned int p = 0; p < size / 3; ++p)
      {
        if (!(eta[p] >= 0. && theta[p] >= 0. && theta[p] <= eta[p]))
          in.fail("has a cone with eta = " + Numbers::shown(eta[p]) +
                  " and theta = " + Numbers::shown(theta[p]) +
                  ", which must be 0 <= theta <= eta");
        if (!(problem.diagonal_block(p).trace() > 0.))
          in.fail("has a matrix that is not positive definite");
        problem.cones.push_back({eta[p], eta[p] - theta[p], 0.});
      }
    return problem;
  }

  bool
  is_fclib(const std::string &file_name)
  {
    try
      {
        const Hdf5File file(file_name, Hdf5File::Access::read);
        for (const char *group :
             {"fclib_local", "fclib_global", "fclib_global_rolling"})
          if (file.has(group))
            return true;
      }
    catch (const RunError &)
      {
        // The reader of another format reports the error.
      }
    return false;
  }

  namespace
  {
    /** Element of an array of length one. */
    int
    one_integer(const Hdf5File &file, const std::string &name)
    {
      const std::vector<int> values = file.read_integers(name);
      return values.size() == 1 ? values[0] : -3;
    }

    /**
     * Reads a sparse matrix of FCLib: triplets, columns (nz = -1) or rows (nz = -2).
     */
    Eigen::SparseMatrix<double>
    read_fclib_matrix(const Hdf5File                                 &file,
                      const std::string                              &name,
                      const std::function<void(const std::string &)> &fail)
    {
      const int n_rows                  = one_integer(file, name + "/m"),
                n_cols                  = one_integer(file, name + "/n"),
                nz                      = one_integer(file, name + "/nz");
      const std::vector<int> p          = file.read_integers(name + "/p"),
                             i          = file.read_integers(name + "/i");
      const std::vector<double> x       = file.read_doubles(name + "/x");
      const std::size_t         n_major = nz == -1 ? n_cols : n_rows;
      if (n_rows < 1 || n_cols < 1 || nz < -2 || i.size() != x.size() ||
          (nz >= 0 ? p.size() != x.size() || std::size_t(nz) > x.size()
                   : p.size() != n_major + 1))
        fail("has a matrix '" + name + "' with sizes that do not fit");
      Triplets   entries;
      const auto add = [&](const int row, const int column, const double w) {
        if (row < 0 || column < 0 || row >= n_rows || column >= n_cols ||
            !(std::abs(w) <= largest_quantity))
          fail("has an entry of '" + name +
               "' that is outside of it, or no "
               "number");
        entries.emplace_back(row, column, w);
      };
      if (nz >= 0)
        for (int k = 0; k < nz; ++k)
          add(i[k], p[k], x[k]);
      else
        for (std::size_t major = 0; major < n_major; ++major)
          for (int k = p[major]; k < p[major + 1]; ++k)
            {
              if (k < 0 || std::size_t(k) >= x.size())
                fail("has rows of '" + name + "' that end beyond its entries");
              add(nz == -1 ? i[k] : major, nz == -1 ? major : i[k], x[k]);
            }
      Eigen::SparseMatrix<double> matrix(n_rows, n_cols);
      matrix.setFromTriplets(entries.begin(), entries.end());
      return matrix;
    }
  } // namespace

  ReducedProblem
  read_fclib(const std::string &file_name)
  {
    const auto fail = [&](const std::string &what) {
      throw InputError("file '" + file_name + "' " + what +
                       "\n  allowed: a local or global problem of FCLib, of "
                       "contact with friction alone\n  remedy:  copy or write "
                       "it again, without rolling and without bilateral "
                       "constraints");
    };
    const Hdf5File    file(file_name, Hdf5File::Access::read);
    const bool        is_local = file.has("fclib_local");
    const std::string group    = is_local ? "fclib_local/" : "fclib_global/";
    if (!is_local && !file.has("fclib_global"))
      fail("has rolling friction, or no problem at all");
    for (const char *constraint : {"V", "G"})
      if (file.has(group + constraint))
        fail("has bilateral constraints");
    const int d = one_integer(file, group + "spacedim");
    if (d != 2 && d != 3)
      fail("has 'spacedim' = " + std::to_string(d) + ", which must be 2 or 3");
    const std::vector<double> mu = file.read_doubles(group + "vectors/mu");
    const auto vector_of = [&](const std::string &name, const std::size_t n) {
      const std::vector<double> values =
        file.read_doubles(group + "vectors/" + name);
      if (values.size() != n)
        fail("has '" + name + "' with " + std::to_string(values.size()) +
             " entries, which must be " + std::to_string(n));
      for (const double x : values)
        if (!(std::abs(x) <= largest_quantity))
          fail("has entries of '" + name + "' that are no numbers");
      return VectorXd(Eigen::Map<const VectorXd>(values.data(), n));
    };
    const std::size_t           size = d * mu.size();
    Eigen::SparseMatrix<double> W;
    VectorXd                    q;
    if (is_local)
      {
        W = read_fclib_matrix(file, group + "W", fail);
        q = vector_of("q", size);
      }
    else
      {
        const auto M = read_fclib_matrix(file, group + "M", fail),
                   H = read_fclib_matrix(file, group + "H", fail);
        if (M.rows() != M.cols() || H.rows() != M.rows())
          fail("has matrices M and H with sizes that do not fit");
        const Eigen::SparseLU<Eigen::SparseMatrix<double>> factors(M);
        if (factors.info() != Eigen::Success)
          fail("has a matrix M that is singular");
        const Eigen::SparseMatrix<double> solved = factors.solve(H);
        W                                        = H.transpose() * solved;
        q = H.transpose() * VectorXd(factors.solve(vector_of("f", M.rows()))) +
            vector_of("w", size);
      }
    if (mu.empty() || std::size_t(W.rows()) != size ||
        std::size_t(W.cols()) != size)
      fail("has a matrix that does not fit the number of its cones");
    Triplets entries;
    for (int k = 0; k < W.outerSize(); ++k)
      for (Eigen::SparseMatrix<double>::InnerIterator it(W, k); it; ++it)
        entries.emplace_back(it.row(), it.col(), it.value());
    return contact_problem(entries, q, mu, d, fail);
  }
} // namespace geocone::GEOCONE_DIM
