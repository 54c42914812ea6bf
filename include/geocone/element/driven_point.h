// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_element_driven_point_h
#define geocone_element_driven_point_h

#include <geocone/base/choice.h>
#include <geocone/base/parameter_file.h>
#include <geocone/element/element_path.h>
#include <geocone/element/element_record.h>
#include <geocone/element/mixed_control.h>
#include <geocone/materials/material_library.h>

#include <deal.II/base/parameter_acceptor.h>

#include <memory>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * A material point that follows prescribed strains and stresses, with its
   * strains and the counts of its increments. The material is the first of
   * "Materials/Names".
   */
  class DrivenPoint : public dealii::ParameterAcceptor
  {
  public:
    explicit DrivenPoint(const ParameterFile &file);

    /** Checks the parameters and creates the point.
     *  @return a note on values changed by the initialisation, or empty */
    std::string
    prepare();

    /** A point in the initial state. @param[out] changed as of prepare() */
    std::unique_ptr<ElementPoint>
    initial_point(std::string &changed) const;

    /** Returns to the initial state and resets the counts. */
    void
    restart();

    /** Begins a control at f = 0.
     *  @param goes_on whether the strains of the last control are the initial
     *  guess of this one */
    void
    begin(const ElementControl &control, const bool goes_on = false);

    /** Advances to a value of f, in subincrements if necessary.
     *  @param stage for messages. @throws StepFailure */
    void
    follow(const double to, const std::string &stage);

    /** The present state. @param stage from 1; 0: the start */
    ElementRecord
    record(const unsigned int stage) const;

    /** The component with the largest range of strain. */
    unsigned int
    main_component() const;

    void
    state(StateRow &row);

    Materials                     materials;
    MixedControl                  mixed_control;
    double                        initial_volume = 2.; ///< 1 + e (-)
    std::unique_ptr<ElementPoint> point;

    /** State and counts since the initial state. */
    struct Path
    {
      Tensor6        strain{}, least_strain{}, most_strain{};
      ElementControl control;
      Tensor6        start_stress{}; ///< of the control (Pa)
      double         at = 0.;        ///< f in the control
      Tensor6        guess{};        ///< increment per unit of f
      double         strain_path  = 0.;
      unsigned int   n_increments = 0, n_iterations = 0, n_cuts = 0;
      double         worst_residual = 0.;
      LawCounts      before; ///< counts before the increment
    };
    Path path;

  private:
    Choice<StressComponents> components = {
      {{"automatic", StressComponents::automatic},
       {"plane strain", StressComponents::plane_strain},
       {"axisymmetric", StressComponents::axisymmetric},
       {"3D", StressComponents::all}}};

    std::vector<double> initial_stress = {-100e3, -100e3, -100e3, 0., 0., 0.};
  };
} // namespace geocone::GEOCONE_DIM

#endif
