// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_element_driven_point_h
#define geocone_element_driven_point_h

#include <geocone/base/choice.h>
#include <geocone/base/parameter_file.h>
#include <geocone/element/element_path.h>
#include <geocone/element/element_record.h>
#include <geocone/element/mixed_control.h>
#include <geocone/laws/material_library.h>

#include <deal.II/base/parameter_acceptor.h>

#include <memory>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Material point driven by prescribed strains and stresses. Stores
   * accumulated strains and statistics of the increments. The material is the
   * first of "Materials/Names".
   */
  class DrivenPoint : public dealii::ParameterAcceptor
  {
  public:
    explicit DrivenPoint(const ParameterFile &file);

    /** Checks the parameters and creates the material point.
     *  @return remark on values changed by the initialisation, or empty */
    std::string
    prepare();

    /** Creates a material point in the initial state. @param[out] changed
     *  remark as returned by prepare() */
    std::unique_ptr<ElementPoint>
    initial_point(std::string &changed) const;

    /** Resets the material point to the initial state and the statistics to
     *  zero. */
    void
    restart();

    /** Begins a loading stage in which each component is either strain- or
     *  stress-controlled, as specified by @p control. The fraction f of the
     *  stage is 0.
     *  @param goes_on whether strains of the previous control are the initial
     *  guess */
    void
    begin(const ElementControl &control, const bool goes_on = false);

    /** Advances the loading until the fraction @p to of the stage is reached,
     *  in subincrements if necessary.
     *  @param stage name for error messages. @throws StepFailure */
    void
    follow(const double to, const std::string &stage);

    /** Returns the record of the current state for path.csv. @param stage
     *  number from 1; 0: initial state */
    ElementRecord
    record(const unsigned int stage) const;

    /** Index of the strain component with the largest range (maximum minus
     *  minimum). */
    unsigned int
    main_component() const;

    void
    state(StateRow &row);

    Materials                     materials;
    MixedControl                  mixed_control;
    double                        initial_volume = 2.; ///< 1 + e (-)
    std::unique_ptr<ElementPoint> point;

    /** Accumulated strains, current strain or stress control of the loading,
     *  and statistics since the initial state. */
    struct Path
    {
      Tensor6        strain{}, least_strain{}, most_strain{};
      ElementControl control;
      Tensor6        start_stress{}; ///< stress at f = 0 (Pa)
      double         at = 0.;        ///< current f of the control
      Tensor6        guess{};        ///< strain increment per unit of f
      double         strain_path  = 0.;
      unsigned int   n_increments = 0, n_iterations = 0, n_cuts = 0;
      double         worst_residual = 0.;
      LawCounts      before; ///< statistics before the increment
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
