// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_implicit_implicit_fem_h
#define geocone_implicit_implicit_fem_h

#include <geocone/conditions/loads.h>
#include <geocone/implicit/implicit_stepper.h>

#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Implicit time stepping by the finite element method at small strains, with
   * fixed quadrature points.
   */
  class ImplicitFEM : public ImplicitStepper, public dealii::ParameterAcceptor
  {
  public:
    ImplicitFEM();

    bool
    has_inertia() const override
    {
      return inertia;
    }

    std::string
    prepare(const Scene           &scene,
            BackgroundMesh        &mesh,
            Space                 &space,
            const NonsmoothNewton &newton,
            dealii::TimerOutput   &timer,
            Kinematics            &kinematics,
            MaterialPoints        &points) override;

    Energies
    state_energies(const Kinematics     &kinematics,
                   const MaterialPoints &points,
                   const double          t) const override;

    void
    save(Archive &archive, const MaterialPoints &points) override;
    void
    load(const Archive &archive, MaterialPoints &points) override;

  private:
    void
    take_points(const Archive &archive, MaterialPoints &points) override;

    /** Rejects a scene in which no stress can develop, e.g. weightless
     *  cohesionless soil without loads or inertia. Collective. */
    void
    check_resistance(const MaterialPoints &points, const MPI_Comm comm) const;

    void
    begin(MaterialPoints &points, dealii::TimerOutput &timer) override;

    bool
    has_force() const override
    {
      return loads->exist() || scene->loading.changes_body();
    }

    void
    evaluate_force(Vector               &dst,
                   const MaterialPoints &points,
                   const double          t,
                   const Stage          *stage,
                   const bool            scaled) override;

    void
    begin_motion(const TimeStep       &step,
                 const Kinematics     &kinematics,
                 const MaterialPoints &points,
                 const Vector         &prescribed) override;

    ContactStep
    find_contact(const TimeStep       &step,
                 const Kinematics     &kinematics,
                 const MaterialPoints &points) override;

    SolverReport
    solve(const TimeStep   &step,
          const Kinematics &kinematics,
          const Solving    &with,
          Vector           &v,
          Vector           &residual) override;

    double
    update_points(const TimeStep &step, MaterialPoints &points) override;

    double
    update_nodes(const TimeStep &step,
                 const Vector   &v_end,
                 const Vector   &v,
                 Kinematics     &kinematics) override;

    void
    remove(const Stage              &stage,
           MaterialPoints           &points,
           std::vector<std::string> &remarks) override;
    void
    add(const Stage    &stage,
        MaterialPoints &points,
        BodyChange     &change) override;

    void
    change_nodes(const std::vector<bool> &had_mass,
                 Kinematics              &kinematics,
                 Vector                  &difference) const override;

    /** Creates and removes quadrature points so that exactly the given cells
     *  contain points. */
    void
    take_cells(const std::vector<bool> &is_there, MaterialPoints &points) const;

    /** Rejects scenes that finite elements do not support. @throws InputError */
    void
    check_scene(const LinearSolverParameters &linear_solver) const;

    /** Evaluates formulas just after the beginning of each stage, to reject those
     *  without a value, and checks the supports of the stage. Collective.
     *  @throws InputError */
    void
    check_stages(const MaterialPoints &points);

    void
    check_consolidation(
      const LinearSolverParameters &linear_solver) const override;

    /** Nodes with zero excess pore pressure, by local node. Collective.
     *  @throws InputError for unknown sides */
    std::vector<bool>
    drained_nodes() const;

    bool                   inertia = false;
    std::unique_ptr<Loads> loads;
    Vector                 weight_per_g;
  };
} // namespace geocone::GEOCONE_DIM

#endif
