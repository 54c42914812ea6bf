// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_element_element_test_h
#define geocone_element_element_test_h

#include <geocone/base/choice.h>
#include <geocone/base/parameter_file.h>
#include <geocone/element/element_output.h>
#include <geocone/element/element_path.h>
#include <geocone/element/mixed_control.h>
#include <geocone/materials/material_library.h>
#include <geocone/run/simulation.h>

#include <deal.II/base/parameter_acceptor.h>

#include <memory>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * A material point driven along a path in stages; one increment is one step.
   * The material is the first of "Materials/Names".
   */
  class ElementTest : public Simulation, public dealii::ParameterAcceptor
  {
  public:
    ElementTest(const MPI_Comm comm, const ParameterFile &file, Log &log);

    OutputBase &
    output() override
    {
      return element_output;
    }

  private:
    std::vector<std::string>
    prepare(const RunOptions &options) override;
    std::vector<unsigned int>
    programme() const override;
    void
    prepare_output(const RunOptions &options) override;
    std::string
    headline(const std::string &name) const override;
    void
    record_start() override;
    void
    begin(const Place &place) override;
    Ended
    advance(Place &place) override;
    void
    record(const Place &place) override;
    std::string
    progress(const Place &place) const override;
    void
    end(const Place &place) override;
    Json
    topics() override;
    void
    finish(const double t) override;
    void
    state(StateRow &row) override;

    /** Advances to the end of an increment, subdivided if necessary.
     *  @throws StepFailure */
    void
    follow(const ElementStage &stage, const double to);

    const char *
    components_of_point() const;

    /** Appends the present state to the table. */
    void
    add_line(const unsigned int stage);

    /** Whether a stop condition ends the stage early. */
    bool
    stops(const ElementStage &stage) const;

    void
    write_surfaces();

    /** The component with the largest range of strain. */
    unsigned int
    main_component() const;

    Materials     materials;
    ElementPath   path;
    MixedControl  mixed_control;
    ElementOutput element_output;

    Choice<StressComponents> components = {
      {{"automatic", StressComponents::automatic},
       {"plane strain", StressComponents::plane_strain},
       {"axisymmetric", StressComponents::axisymmetric},
       {"3D", StressComponents::all}}};

    std::vector<double> initial_stress = {-100e3, -100e3, -100e3, 0., 0., 0.};
    double              initial_volume = 2.;

    std::unique_ptr<ElementPoint> point;
    std::string                   changed; ///< by initialisation
    Tensor6                       strain{}, least_strain{}, most_strain{};
    ElementControl                control;        ///< of the stage
    Tensor6                       start_stress{}; ///< of the stage (Pa)
    double                        at = 0.;        ///< f in the stage
    Tensor6                       guess{};        ///< increment per unit of f
    std::vector<double>           positions; ///< f of the stage's increments
    double                        strain_path = 0., largest_p = 0.;
    unsigned int n_increments = 0, n_iterations = 0, n_cuts = 0;
    double       worst_residual = 0.;
    LawCounts    before; ///< counts before the increment
  };
} // namespace geocone::GEOCONE_DIM

#endif
