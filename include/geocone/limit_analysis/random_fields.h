// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_random_fields_h
#define geocone_limit_analysis_random_fields_h

#include <geocone/base/choice.h>
#include <geocone/base/named_list.h>
#include <geocone/limit_analysis/bounded_load.h>

#include <Eigen/Dense>

#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** A property of a material that a random field multiplies. */
  enum class RandomProperty
  {
    cohesion,
    tan_phi,
    unit_weight
  };

  /** Multiples of the properties of each triangle of a mesh; empty: 1. */
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
   * Random field that multiplies a property of a material: a function of a standard
   * normal field, which is sampled at the centres of the triangles of a mesh (midpoint
   * method, Der Kiureghian and Ke 1988) and constant in each.
   */
  class RandomField : public dealii::ParameterAcceptor
  {
  public:
    explicit RandomField(const std::string &name);

    /** Checks the parameters. @throws InputError */
    void
    prepare(const Scene &scene);

    /** Factorises the covariance at the centres of the triangles of its material.
     *  @throws InputError for more triangles than a dense matrix may have */
    void
    prepare_on(const Triangles &triangles);

    /** Sets the factors of the triangles of the material in a sample.
     *  @param key identifies the sample */
    void
    sample(const std::vector<std::uint32_t> &key,
           std::vector<double>              &factors) const;

    /** Covariance of the standard normal field at a distance. */
    double
    covariance(const dealii::Tensor<1, dim> &distance) const;

    /** Factor for a value of the standard normal field. */
    double
    factor(const double z) const;

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

    /** Number of independent normal numbers of a sample. */
    unsigned int
    rank() const
    {
      return root.cols();
    }

    /** Property as a word of the parameter. */
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

  /** The random fields of a reliability analysis. */
  class RandomFields : public NamedList<RandomField>
  {
  public:
    explicit RandomFields(const ParameterFile &file);

    /** Checks all parameters. @throws InputError */
    void
    prepare(const Scene &scene);

    void
    prepare_on(const Triangles &triangles);

    /** Factors of a sample. @param number of the sample, from 1 */
    RandomFactors
    sample(const unsigned int number) const;

    /** Largest number of random numbers of a field in a sample. */
    unsigned int
    most_numbers() const;

    unsigned int seed = 1;

  private:
    unsigned int n_cells = 0;
  };
} // namespace geocone::GEOCONE_DIM

#endif
