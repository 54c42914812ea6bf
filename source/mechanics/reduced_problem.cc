// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/mechanics/reduced_problem.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
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
    return MatrixXd(W.block(3 * p, 3 * p, 3, 3));
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
        const Mandel sp = s.segment<3>(3 * p);
        error           = std::max(error,
                         natural_map_norm(cones[p],
                                          sp,
                                          zs.segment<3>(3 * p),
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
    /** The numbers of a text file one after the other. */
    class Numbers
    {
    public:
      explicit Numbers(const std::string &file_name)
        : file_name(file_name)
      {
        std::ifstream in(file_name);
        if (!in)
          fail("cannot be opened");
        text.assign(std::istreambuf_iterator<char>(in), {});
        place = text.c_str();
        skip_space();
      }

      [[noreturn]] void
      fail(const std::string &what) const
      {
        throw InputError("file '" + file_name + "' " + what);
      }

      bool
      at_end() const
      {
        return place == text.c_str() + text.size();
      }

      double
      next(const std::string &what)
      {
        if (at_end())
          fail("ends within " + what);
        char        *end;
        const double x = std::strtod(place, &end);
        if (end == place || !std::isfinite(x))
          fail("has '" + std::string(place, std::strcspn(place, " \t\r\n")) +
               "' within " + what + ", where a number must be");
        place = end;
        skip_space();
        return x;
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

      VectorXd
      vector(const unsigned int size, const std::string &what)
      {
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

      std::string file_name;
      std::string text;
      const char *place = nullptr;
    };
  } // namespace

  ReducedProblem
  read_siconos(const std::string &file_name)
  {
    Numbers in(file_name);
    in.expect(3, "the dimension");
    const double n = in.next("the number of cones");
    // Beyond a million cones a dense matrix has no meaning.
    if (!(n >= 1. && n <= 1e6 && n == std::floor(n)))
      in.fail("has " + Numbers::shown(n) + " cones");

    // Old files start with the storage, new ones with the model.
    const double kind = in.next("the type of the model");
    if (kind != 0.)
      {
        if (kind != 1.)
          in.fail("has the type of the model " + Numbers::shown(kind) +
                  ", which must be 1 (a cone)");
        in.expect(0, "the storage of the matrix (0: dense)");
      }
    const unsigned int size = 3 * static_cast<unsigned int>(n);
    for (const char *what : {"rows", "columns", "rows", "columns"})
      in.expect(size, std::string("the number of ") + what);

    ReducedProblem                      problem;
    std::vector<Eigen::Triplet<double>> entries;
    for (unsigned int i = 0; i < size; ++i)
      for (unsigned int j = 0; j < size; ++j)
        if (const double w = in.next("the matrix"); w != 0.)
          entries.emplace_back(i, j, w);
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
