// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/largest_quantity.h>
#include <geocone/mechanics/reduced_problem.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>

namespace geocone
{
  using Eigen::MatrixXd;
  using Eigen::VectorXd;

  namespace
  {
    Eigen::LLT<MatrixXd>
    factorised(const MatrixXd &L)
    {
      Eigen::LLT<MatrixXd> factors(L);
      if (factors.info() != Eigen::Success)
        throw RunError("The matrix of the constraints, H M^-1 H', is not "
                       "positive definite: constraints are redundant");
      return factors;
    }
  } // namespace

  MandelMatrix
  ReducedProblem::diagonal_block(const unsigned int p) const
  {
    return MatrixXd(W.block(n_mandel * p, n_mandel * p, n_mandel, n_mandel));
  }

  VectorXd
  ReducedProblem::z(const VectorXd &s, const VectorXd &lambda) const
  {
    VectorXd result = W * s + q;
    if (n_multipliers() > 0)
      result -= C * lambda;
    return result;
  }

  VectorXd
  ReducedProblem::multipliers(const VectorXd &s) const
  {
    if (n_multipliers() == 0)
      return {};
    return factorised(L).solve(C.transpose() * s - d);
  }

  ReducedProblem
  ReducedProblem::projected() const
  {
    if (n_multipliers() == 0)
      return *this;
    const auto     factors = factorised(L);
    ReducedProblem result;
    result.cones = cones;
    result.S     = S;
    result.W = (MatrixXd(W) - C * factors.solve(C.transpose())).sparseView();
    result.q = q + C * factors.solve(d);
    return result;
  }

  double
  ReducedProblem::natural_map_error(const VectorXd &s) const
  {
    const VectorXd zs    = z(s, multipliers(s));
    double         error = 0., size = 0., cohesion = 0.;
    for (unsigned int p = 0; p < n_cones(); ++p)
      {
        const Mandel sp = s.segment<n_mandel>(n_mandel * p);
        error           = std::max(error,
                         natural_map_norm(cones[p],
                                          sp,
                                          zs.segment<n_mandel>(n_mandel * p),
                                          natural_scale(diagonal_block(p))));
        size            = std::max(size, sp.norm());
        cohesion        = std::max(cohesion, cones[p].k);
      }
    if (!s.allFinite())
      return std::numeric_limits<double>::infinity();
    return error > 0. ? error / (size + cohesion) : 0.;
  }

  namespace
  {
    /** Beyond a million cones, or some gigabytes, a text has no meaning. */
    constexpr double         most_cones           = 1e6;
    constexpr std::uintmax_t largest_problem_file = 1ULL << 32;

    /** The numbers of a text file one after the other. */
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
                         "\n  allowed: an argument file of Siconos' plasticity "
                         "tests\n  remedy:  copy or write it again");
      }

      bool
      at_end() const
      {
        return place == text.c_str() + text.size();
      }

      /** @throws InputError unless there may be so many numbers more */
      void
      check_room(const std::size_t n, const std::string &what) const
      {
        // Each has a character, and one that ends it.
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

      /** A number that counts something: 0, 1, ..., @p most. */
      std::size_t
      count(const double most, const std::string &what)
      {
        const double x = next(what);
        if (!(x >= 0. && x <= most && x == std::floor(x)))
          fail("has " + shown(x) + " as " + what + ", which must be 0 to " +
               shown(most));
        return static_cast<std::size_t>(x);
      }

      /** A number that may only have the value given. */
      void
      expect(const double value, const std::string &what)
      {
        const double x = next(what);
        if (x != value)
          fail("has " + what + " = " + shown(x) + ", which must be " +
               shown(value));
      }

      /** Whether the text goes on so; if it does, goes behind it. */
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

      /** What stands here, for messages. */
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

    /** A matrix as the library CSparse prints it: triplets, columns or rows. */
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
          // The last one, which is before the first one where there is none.
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
  } // namespace

  ReducedProblem
  read_siconos(const std::string &file_name)
  {
    Numbers in(file_name);
    in.expect(3, "the dimension");
    const double n = in.next("the number of cones");
    if (!(n >= 1. && n <= most_cones && n == std::floor(n)))
      in.fail("has " + Numbers::shown(n) + " cones");
    const unsigned int size = n_mandel * static_cast<unsigned int>(n);

    // Old files begin with the storage, new ones with the model; the number of
    // rows, which comes next in the former, is more than any storage.
    double model = 1., storage = in.next("the type of the model");
    double n_rows = in.next("the storage of the matrix");
    if (n_rows < 3.)
      {
        model   = storage;
        storage = n_rows;
        n_rows  = in.next("the number of rows");
      }
    if (model == 2.)
      in.fail("has the type of the model 2 (von Mises), which must be 1 (a "
              "cone)\n  remedy:  none: the yield surface of Siconos' type 2, "
              "sqrt(sx^2 + sy^2 - sx sy + 3 txy^2) = sigma_y, that of plane "
              "stress, is no cone, and stresses return to it by a factor; take "
              "type 1, or a step of geocone with the material Tresca");
    if (model != 1.)
      in.fail("has the type of the model " + Numbers::shown(model) +
              ", which must be 1 (a cone)");
    if (storage != 0. && storage != 2.)
      in.fail("has the storage of the matrix " + Numbers::shown(storage) +
              ", which must be 0 (dense) or 2 (sparse)\n"
              "  remedy:  convert it in Siconos, e.g. by NM_triplet()");
    if (n_rows != size)
      in.fail("has the number of rows = " + Numbers::shown(n_rows) +
              ", which must be " + Numbers::shown(size));
    in.expect(size, "the number of columns");

    const Triplets entries =
      storage == 0. ? read_dense(in, size) : read_sparse(in, size);
    ReducedProblem problem;
    problem.W.resize(size, size);
    problem.W.setFromTriplets(entries.begin(), entries.end());
    problem.q            = in.vector(size, "the vector q");
    const VectorXd eta   = in.vector(size / 3, "the apertures eta");
    const VectorXd theta = in.vector(size / 3, "the coefficients theta");
    if (!in.at_end())
      in.fail("goes on after the coefficients theta");

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
} // namespace geocone
