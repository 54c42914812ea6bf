// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_reliability_random_fields_h
#define geocone_reliability_random_fields_h

#include <geocone/base/choice.h>
#include <geocone/base/named_list.h>
#include <geocone/limit_analysis/bounded_load.h>

#include <Eigen/Dense>

#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Material property that is multiplied by a random field. */
  enum class RandomProperty
  {
    cohesion,
    tan_phi,
    unit_weight
  };

  /** Values of the triangles of a mesh by material property, e.g. the factors by which
   *  the properties are multiplied. An empty array means that a property is not
   *  random: its factors are 1. */
  struct RandomFactors
  {
    std::vector<double> cohesion, tan_phi, unit_weight;

    std::vector<double> &
    of(const RandomProperty property)
    {
      return property == RandomProperty::cohesion  ? cohesion
             : property == RandomProperty::tan_phi ? tan_phi
                                                   : unit_weight;
    }
  };

  /**
   * Random field by which a property of a material is multiplied. It is a
   * function of a standard normal field. The field is sampled at the centres of
   * the triangles of a mesh and is constant in each triangle (midpoint method,
   * Der Kiureghian and Ke 1988).
   */
  class RandomField : public dealii::ParameterAcceptor
  {
  public:
    explicit RandomField(const std::string &name);

    /** Checks the parameters of the random field. @throws InputError */
    void
    prepare(const Scene &scene);

    /** Selects the triangles of the material.
     *  @throws InputError if there are too many for a dense covariance matrix */
    void
    prepare_on(const Triangles &triangles);

    /** Factorises the covariance matrix of the field values at the centres of the
     *  material's triangles, which are those of prepare_on(). */
    void
    factorise(const Triangles &triangles);

    /** Sets the factor of each triangle of the material.
     *  @param numbers rank() independent standard normal numbers */
    void
    set_factors(const Eigen::Ref<const Eigen::VectorXd> &numbers,
                std::vector<double>                     &factors) const;

    /** Gradient of a function of the factors with respect to the standard normal
     *  numbers.
     *  @param elasticity derivative of the function with respect to the logarithm of the
     *  factor of each triangle */
    Eigen::VectorXd
    gradient(const Eigen::Ref<const Eigen::VectorXd> &numbers,
             const std::vector<double>               &elasticity) const;

    /** Covariance of the standard normal field at two points a given distance
     *  apart. */
    double
    covariance(const dealii::Tensor<1, dim> &distance) const;

    /** Factor of the material property for a value z of the standard normal
     *  field. */
    double
    factor(const double z) const;

    /** Derivative of the logarithm of factor(). */
    double
    log_slope(const double z) const;

    std::string
    parameter(const std::string &entry) const
    {
      return "Random fields/" + name + "/" + entry;
    }

    const std::string name;

    unsigned int material = 0; ///< index, after prepare()

    RandomProperty
    property() const
    {
      return chosen;
    }

    /** Number of independent standard normal numbers required for a sample. */
    unsigned int
    rank() const
    {
      return root.cols();
    }

    /** Name of the material property in the parameter file. */
    std::string
    property_word() const
    {
      return chosen.word();
    }

  private:
    enum class Distribution
    {
      lognormal,
      truncated_normal
    };
    enum class Covariance
    {
      exponential,
      gaussian,
      matern
    };

    Choice<RandomProperty> chosen = {
      {{"cohesion", RandomProperty::cohesion},
       {"tan(phi)", RandomProperty::tan_phi},
       {"unit weight", RandomProperty::unit_weight}}};
    Choice<Distribution> distribution = {
      {{"lognormal", Distribution::lognormal},
       {"truncated normal", Distribution::truncated_normal}}};
    Choice<Covariance> covariance_kind = {
      {{"exponential", Covariance::exponential},
       {"Gaussian", Covariance::gaussian},
       {"Matern 3/2", Covariance::matern}}};

    std::string material_name;
    double      variation = 0.3, length_x = 0., length_y = 0.;

    std::vector<unsigned int> cells; ///< triangles of the material
    Eigen::MatrixXd           root;  ///< covariance = root root'
  };

  /** All random fields of a reliability analysis. */
  class RandomFields : public NamedList<RandomField>
  {
  public:
    explicit RandomFields(const ParameterFile &file);

    /** Checks the parameters of all random fields. @throws InputError */
    void
    prepare(const Scene &scene);

    /** @name As those of each field */
    /** @{ */
    void
    prepare_on(const Triangles &triangles);
    void
    factorise(const Triangles &triangles);
    /** @} */

    /** Number of independent standard normal numbers of all fields. */
    unsigned int
    rank() const;

    /** Independent standard normal numbers of a sample. @param number of the sample,
     *  from 1 */
    Eigen::VectorXd
    numbers_of(const unsigned int number) const;

    /** Factors of the material properties. @param numbers rank() standard normal
     *  numbers */
    RandomFactors
    factors(const Eigen::VectorXd &numbers) const;

    /** Gradient of a function of the factors with respect to the standard normal
     *  numbers, see RandomField::gradient(). */
    Eigen::VectorXd
    gradient(const Eigen::VectorXd &numbers, RandomFactors elasticity) const;

    unsigned int seed = 1;

  private:
    unsigned int n_cells = 0;
  };
} // namespace geocone::GEOCONE_DIM

#endif
