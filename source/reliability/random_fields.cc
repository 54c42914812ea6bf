// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/parameter_file.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/reliability/random_fields.h>
#include <geocone/reliability/statistics.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    const UsedWhere used_random_fields[] = {
      {"Random fields/*", "Analysis/Kind", {"reliability"}}};

    /**
     * Root R of a covariance matrix, C = R R', by Cholesky's factorisation with pivots.
     * It ends when the variance that is left is below 1e-10 of each, so a smooth field or
     * a long correlation length needs few columns; rows are scaled to the exact variance.
     * @param covariance of two indices
     */
    template <typename Function>
    Eigen::MatrixXd
    pivoted_root(const unsigned int n, const Function &covariance)
    {
      constexpr double negligible = 1e-10;
      // Columns of R', which are contiguous.
      Eigen::MatrixXd           rows(n, n);
      Eigen::VectorXd           left(n);
      std::vector<unsigned int> order(n);
      for (unsigned int i = 0; i < n; ++i)
        {
          order[i] = i;
          left[i]  = covariance(i, i);
        }
      unsigned int rank = 0;
      for (; rank < n; ++rank)
        {
          unsigned int at = rank;
          for (unsigned int i = rank + 1; i < n; ++i)
            if (left[order[i]] > left[order[at]])
              at = i;
          std::swap(order[rank], order[at]);
          const unsigned int pivot = order[rank];
          if (!(left[pivot] > negligible))
            break;
          const double root = std::sqrt(left[pivot]);
          for (unsigned int i = rank; i < n; ++i)
            {
              const unsigned int row = order[i];
              const double       value =
                i == rank
                        ? root
                        : (covariance(row, pivot) -
                     rows.col(row).head(rank).dot(rows.col(pivot).head(rank))) /
                      root;
              rows(rank, row) = value;
              left[row] -= value * value;
            }
          for (unsigned int i = 0; i < rank; ++i)
            rows(rank, order[i]) = 0.;
        }
      Eigen::MatrixXd root = rows.topRows(rank).transpose();
      for (unsigned int i = 0; i < n; ++i)
        root.row(i) *= std::sqrt(covariance(i, i)) / root.row(i).norm();
      return root;
    }
  } // namespace

  RandomField::RandomField(const std::string &name)
    : dealii::ParameterAcceptor("/Random fields/" + name)
    , name(name)
  {
    add_parameter(
      "Material", material_name, "Name of the material whose property varies.");
    chosen.declare(*this,
                   "Property",
                   ". Property that the field multiplies; its mean is that of "
                   "the material, so a 'Cohesion gradient' is its trend.");
    add_parameter("Coefficient of variation",
                  variation,
                  "Standard deviation of the property over its mean [-].");
    distribution.declare(*this,
                         "Distribution",
                         ". Of the property at a point. Truncated normal: "
                         "mean and standard deviation are those before "
                         "negative values are cut off.");
    covariance_kind.declare(
      *this,
      "Covariance",
      ". Correlation of the underlying normal field at the distance r = "
      "sqrt((x/l_x)^2 + (y/l_y)^2): exp(-2 r), exp(-pi r^2) or "
      "(1 + 4 r) exp(-4 r).");
    for (auto &[entry, length] :
         {std::pair<const char *, double &>("Correlation length x", length_x),
          {"Correlation length y", length_y}})
      add_parameter(entry,
                    length,
                    "Correlation length l of the underlying normal field along "
                    "this axis [m]: scale of fluctuation, the integral of the "
                    "correlation over the axis. 1e30: no variation along it.");
  }

  void
  RandomField::prepare(const Scene &scene)
  {
    const auto &names = scene.materials.names();
    const auto  found = std::find(names.begin(), names.end(), material_name);
    if (found == names.end())
      throw InputError(parameter("Material"),
                       material_name,
                       "a name of 'Materials/Names'",
                       "e.g. " + names.front());
    material = found - names.begin();
    if (!(variation > 0. && variation <= 3.))
      throw InputError(parameter("Coefficient of variation"),
                       variation,
                       "> 0, at most 3",
                       "0.3 is usual for undrained strength");
    if (distribution == Distribution::truncated_normal && variation > 0.5)
      throw InputError(parameter("Coefficient of variation"),
                       variation,
                       "at most 0.5 with Distribution = truncated normal",
                       "more would move the mean: take lognormal");
    for (const auto &[entry, length] :
         {std::pair<const char *, double>("Correlation length x", length_x),
          {"Correlation length y", length_y}})
      if (!(length > 0. && std::isfinite(length)))
        throw InputError(parameter(entry),
                         length,
                         "> 0 m",
                         "1e30 if the field does not vary along this axis");
    const std::string of_material = "Materials/" + material_name + "/";
    const FlowCone    cone        = *scene.materials[material].initial_cone();
    if (chosen == RandomProperty::tan_phi && cone.a == 0.)
      throw InputError(parameter("Property"),
                       "tan(phi)",
                       "cohesion | unit weight of a material without friction",
                       "give " + of_material + "'Friction angle'");
    if (chosen == RandomProperty::cohesion && cone.k == 0. &&
        scene.materials[material].growth().slope == 0.)
      throw InputError(parameter("Property"),
                       "cohesion",
                       "tan(phi) | unit weight of a material without cohesion",
                       "give " + of_material + "Cohesion");
    if (chosen == RandomProperty::unit_weight && !scene.gravity.acts())
      throw InputError(parameter("Property"),
                       "unit weight",
                       "cohesion | tan(phi) without gravity",
                       "give Gravity/Acceleration and " + of_material +
                         "Density");
    if (chosen != RandomProperty::unit_weight && std::isfinite(cone.cut_off))
      throw InputError(of_material + "Tensile strength",
                       ParameterFile::value(of_material + "Tensile strength"),
                       "none where the strength is random",
                       "leave it out");
  }

  double
  RandomField::covariance(const dealii::Tensor<1, dim> &distance) const
  {
    const double r = std::hypot(distance[0] / length_x, distance[1] / length_y);
    switch (covariance_kind.get())
      {
        case Covariance::exponential:
          return std::exp(-2. * r);
        case Covariance::gaussian:
          return std::exp(-M_PI * r * r);
        default:
          return (1. + 4. * r) * std::exp(-4. * r);
      }
  }

  double
  RandomField::factor(const double z) const
  {
    if (distribution == Distribution::lognormal)
      {
        const double variance = std::log1p(variation * variation);
        return std::exp(std::sqrt(variance) * z - variance / 2.);
      }
    // By the upper tail, without cancellation near 1. The least factor avoids a
    // strength of zero by rounding.
    const double kept = normal_distribution(1. / variation),
                 tail = kept * normal_distribution(-z);
    return std::max(1. - variation * normal_quantile(tail), 1e-6);
  }

  double
  RandomField::log_slope(const double z) const
  {
    if (distribution == Distribution::lognormal)
      return std::sqrt(std::log1p(variation * variation));
    const double kept = normal_distribution(1. / variation),
                 x    = normal_quantile(kept * normal_distribution(-z));
    return variation * kept * std::exp((x * x - z * z) / 2.) / factor(z);
  }

  void
  RandomField::prepare_on(const Triangles &triangles)
  {
    constexpr unsigned int most = 6000;
    cells.clear();
    for (unsigned int c = 0; c < triangles.cells.size(); ++c)
      if (triangles.material[c] == material)
        cells.push_back(c);
    if (cells.size() > most)
      throw InputError(
        "Mesh/Cell size",
        format("a mesh of %zu triangles", cells.size()),
        format("at most %u in a material with a random field", most),
        "take larger cells: undecided samples are refined");
  }

  void
  RandomField::factorise(const Triangles &triangles)
  {
    root = pivoted_root(cells.size(),
                        [&](const unsigned int i, const unsigned int j) {
                          return covariance(triangles.centre(cells[i]) -
                                            triangles.centre(cells[j]));
                        });
  }

  void
  RandomField::set_factors(const Eigen::Ref<const Eigen::VectorXd> &numbers,
                           std::vector<double> &factors) const
  {
    const Eigen::VectorXd z = root * numbers;
    for (unsigned int i = 0; i < cells.size(); ++i)
      factors[cells[i]] = factor(z[i]);
  }

  Eigen::VectorXd
  RandomField::gradient(const Eigen::Ref<const Eigen::VectorXd> &numbers,
                        const std::vector<double> &elasticity) const
  {
    Eigen::VectorXd by_z = root * numbers;
    for (unsigned int i = 0; i < cells.size(); ++i)
      by_z[i] = elasticity[cells[i]] * log_slope(by_z[i]);
    return root.transpose() * by_z;
  }

  RandomFields::RandomFields(const ParameterFile &file)
    : NamedList(file,
                "Random fields",
                "Names of the random fields; each has a subsection of its "
                "name. Fields are independent of each other.")
  {
    add_parameter("Seed",
                  seed,
                  "Seed of the random numbers: the same samples for the same "
                  "seed and mesh, on any number of ranks.");
    make();
  }

  void
  RandomFields::prepare(const Scene &scene)
  {
    require_one("strength");
    for (unsigned int i = 0; i < list.size(); ++i)
      {
        list[i]->prepare(scene);
        for (unsigned int j = 0; j < i; ++j)
          if (list[i]->material == list[j]->material &&
              list[i]->property() == list[j]->property())
            throw InputError(list[i]->parameter("Property"),
                             list[i]->property_word(),
                             "one field for each property of a material",
                             "leave out '" + list[i]->name + "' or '" +
                               list[j]->name + "'");
      }
  }

  void
  RandomFields::prepare_on(const Triangles &triangles)
  {
    n_cells = triangles.cells.size();
    for (const auto &field : list)
      field->prepare_on(triangles);
  }

  void
  RandomFields::factorise(const Triangles &triangles)
  {
    for (const auto &field : list)
      field->factorise(triangles);
  }

  unsigned int
  RandomFields::rank() const
  {
    unsigned int sum = 0;
    for (const auto &field : list)
      sum += field->rank();
    return sum;
  }

  Eigen::VectorXd
  RandomFields::numbers_of(const unsigned int number) const
  {
    Eigen::VectorXd numbers(rank());
    unsigned int    first = 0;
    for (unsigned int i = 0; i < list.size(); ++i)
      for (const double one :
           normal_numbers({seed, number, i}, list[i]->rank()))
        numbers[first++] = one;
    return numbers;
  }

  RandomFactors
  RandomFields::factors(const Eigen::VectorXd &numbers) const
  {
    RandomFactors factors;
    unsigned int  first = 0;
    for (const auto &field : list)
      {
        auto &of = factors.of(field->property());
        of.resize(n_cells, 1.);
        field->set_factors(numbers.segment(first, field->rank()), of);
        first += field->rank();
      }
    return factors;
  }

  Eigen::VectorXd
  RandomFields::gradient(const Eigen::VectorXd &numbers,
                         RandomFactors          elasticity) const
  {
    Eigen::VectorXd gradient(rank());
    unsigned int    first = 0;
    for (const auto &field : list)
      {
        const unsigned int n       = field->rank();
        gradient.segment(first, n) = field->gradient(
          numbers.segment(first, n), elasticity.of(field->property()));
        first += n;
      }
    return gradient;
  }
} // namespace geocone::GEOCONE_DIM
