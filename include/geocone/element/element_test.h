// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_element_element_test_h
#define geocone_element_element_test_h

#include <geocone/base/log.h>
#include <geocone/base/parameter_file.h>
#include <geocone/element/element_output.h>
#include <geocone/element/element_path.h>
#include <geocone/element/mixed_control.h>
#include <geocone/materials/material_library.h>
#include <geocone/run_options.h>

#include <deal.II/base/parameter_acceptor.h>

#include <mpi.h>

#include <memory>
#include <string>
#include <vector>

namespace geocone
{
  /**
   * One material point that is driven along a path in stages. The material is
   * the first of "Materials/Names".
   */
  class ElementTest : public dealii::ParameterAcceptor
  {
  public:
    ElementTest(const MPI_Comm comm, const ParameterFile &file, Log &log);

    /**
     * Runs the path.
     * @return whether all expectations hold
     * @throws InputError before anything is written, StepFailure if the path
     * cannot be followed to its end
     */
    bool
    run(const RunOptions &options);

    const ElementOutput &
    output() const
    {
      return element_output;
    }

  private:
    /** Checks everything. @throws InputError */
    void
    prepare();

    /** All stages. @throws RunError */
    void
    follow_path();

    /** From the present f of the stage to the end of the increment.
     *  @throws StepFailure */
    void
    advance(const ElementStage   &stage,
            const ElementControl &control,
            const Tensor6        &start_stress,
            const double          from,
            const double          to);

    std::vector<std::string>
    columns() const;
    std::vector<double>
    line(const unsigned int stage) const;
    bool
    stops(const ElementStage &stage, const std::vector<double> &values) const;

    void
    write_surfaces();
    Json
    topics() const;

    /** The component with the largest range of strain. */
    unsigned int
    main_component() const;

    Log          &log;
    Materials     materials;
    ElementPath   path;
    MixedControl  mixed_control;
    ElementOutput element_output;

    std::string         components     = "automatic";
    std::vector<double> initial_stress = {-100e3, -100e3, -100e3, 0., 0., 0.};
    double              initial_volume = 2.;

    std::unique_ptr<ElementPoint> point;
    std::string                   changed; ///< by initialisation
    Tensor6                       strain{}, least_strain{}, most_strain{};
    Tensor6                       guess{}; ///< increment per unit of f
    double                        strain_path = 0., largest_p = 0.;
    unsigned int n_increments = 0, n_iterations = 0, n_cuts = 0;
    double       worst_residual = 0.;
    LawCounts    before; ///< counts before the increment
  };
} // namespace geocone

#endif
