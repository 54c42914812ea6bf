// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// A law of all principal stresses by itself, and what update() says of one point.

#ifndef geocone_tests_spatial_point_h
#define geocone_tests_spatial_point_h

#include <geocone/laws/material_library.h>

#include <memory>
#include <string>
#include <vector>

namespace cone_tests
{
  class SpatialPoint
  {
  public:
    /** @param parameters as in a section Materials/NAME */
    SpatialPoint(const std::string &type, const std::string &parameters)
    {
      using dealii::ParameterAcceptor;
      ParameterAcceptor::clear();
      owner = geocone::make_material(type, "Materials/soil");
      ParameterAcceptor::declare_all_parameters();
      ParameterAcceptor::prm.parse_input_from_string(
        "subsection Materials\nsubsection soil\n" + parameters + "end\nend\n");
      ParameterAcceptor::parse_all_parameters();
      owner->prepare();
      law = dynamic_cast<const geocone::Material *>(owner.get());
    }

    struct Answer
    {
      geocone::SpatialMandel       stress;
      geocone::SpatialMandelMatrix tangent;
      std::vector<double>          history;
      geocone::Mode                mode;
    };

    Answer
    step(const geocone::SpatialMandel &strain,
         const geocone::SpatialMandel &stress_n,
         const std::vector<double>    &history_n) const
    {
      using namespace geocone;
      using dealii::ArrayView;
      const Mandel e = strain.head<3>(), s_n = stress_n.head<3>();
      const double zz = strain[3];
      Increment    increment;
      increment.strain    = ArrayView<const Mandel>(&e, 1);
      increment.stress_n  = ArrayView<const Mandel>(&s_n, 1);
      increment.history_n = history_n.data();
      increment.n_history = history_n.size();
      increment.strain_zz = &zz;
      Mandel            stress;
      MandelMatrix      tangent;
      OutOfPlaneTangent out;
      double            stress_zz;
      Answer            answer;
      answer.history = history_n;
      Response response;
      response.stress     = ArrayView<Mandel>(&stress, 1);
      response.mode       = ArrayView<Mode>(&answer.mode, 1);
      response.tangent    = ArrayView<MandelMatrix>(&tangent, 1);
      response.history    = answer.history.data();
      response.stress_zz  = &stress_zz;
      response.tangent_zz = &out;
      law->update(increment, response);
      answer.stress << stress, stress_zz;
      answer.tangent.topLeftCorner<3, 3>()    = tangent;
      answer.tangent.topRightCorner<3, 1>()   = out.by_zz;
      answer.tangent.bottomLeftCorner<1, 3>() = out.of_zz.transpose();
      answer.tangent(3, 3)                    = out.zz;
      return answer;
    }

    const geocone::Material *law;

  private:
    std::unique_ptr<geocone::ConstitutiveLaw> owner;
  };
} // namespace cone_tests

#endif
