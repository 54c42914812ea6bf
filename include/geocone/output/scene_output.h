// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_scene_output_h
#define geocone_output_scene_output_h

#include <geocone/output/energy_balance.h>
#include <geocone/output/table_output.h>
#include <geocone/scene/scene.h>

#include <algorithm>
#include <string>

namespace geocone::GEOCONE_DIM
{
  /**
   * Output common to all methods that simulate a scene: columns of
   * statistics.csv and sections of summary.json.
   * @tparam Record a StepRecord
   */
  template <typename Record>
  class SceneOutput : public TableOutput<Record>
  {
  public:
    using TableOutput<Record>::TableOutput;

    void
    state_of_run(StateRow &row) override
    {
      TableOutput<Record>::state_of_run(row);
      row(balance);
    }

    /**
     * Kinetic energy and largest plastic strain as text for the progress line.
     */
    std::string
    text_of_motion(const StepEnd &end) const
    {
      return format("kinetic energy = %.3g %s  plastic strain <= %.3g",
                    end.energies.kinetic,
                    unit("J/m").c_str(),
                    end.largest_plastic_strain);
    }

  protected:
    using TableOutput<Record>::table;
    using TableOutput<Record>::records;

    /** Creates the output folder, or reopens the folder of a resumed run.
     *  @throws InputError */
    void
    begin(const RunOptions &options, const Scene &of_run)
    {
      scene = &of_run;
      this->make_folder(options);
    }

    /** Converts a unit for plane strain to the unit for the current problem,
     *  i.e. without "per metre of thickness" in axisymmetric and
     *  three-dimensional problems. See Geometry::unit(). */
    std::string
    unit(const std::string &in_plane_strain) const
    {
      return scene->geometry.unit(in_plane_strain);
    }

    /** Appends a column to statistics.csv. Its name contains the unit in plane
     *  strain. */
    void
    add(const std::string                             &column,
        const typename StatisticsTable<Record>::Value &value,
        const Finite                                   finite = Finite::must_be)
    {
      table.add(unit(column), value, finite);
    }

    /** @name Columns of all methods, grouped so that methods can insert their own */
    /** @{ */
    void
    add_time_columns()
    {
      add("step", [](const Record &r) { return r.step; });
      add("time (s)", [](const Record &r) { return r.time; });
    }

    void
    add_strain_columns()
    {
      add("largest plastic strain (-)",
          [](const Record &r) { return r.last.largest_plastic_strain; });
    }

    /** Adds the energy columns to statistics.csv. @param knows_elastic whether
     *  the method computes Energies::elastic */
    void
    add_energy_columns(const bool knows_elastic)
    {
      add("kinetic energy (J/m)",
          [](const Record &r) { return r.last.energies.kinetic; });
      if (knows_elastic)
        add("elastic energy (J/m)",
            [](const Record &r) { return r.last.energies.elastic; });
      add("potential energy (J/m)",
          [](const Record &r) { return r.last.energies.potential; });
    }

    void
    add_loss_columns()
    {
      add("numerical loss (J/m)",
          [this](const Record &) { return balance.loss(); });
    }

    /** Appends the columns of observed quantities to statistics.csv. They are the
     *  moments at observed boundary conditions (not in axisymmetry) and the
     *  displacements of observed points. */
    void
    add_observed_columns()
    {
      const Observation &observation = scene->observation;
      const auto         supports    = scene->supports();
      if (!scene->geometry.is_axisymmetric())
        for (const unsigned int c : observation.conditions)
          for (unsigned int axis = 0; axis < n_rotations; ++axis)
            table.add(
              "moment " + supports[c] +
                (dim == 2 ? "" : " " + axis_of_rotation(axis)) +
                unit(" (N m/m)"),
              [c, axis](const Record &r) {
                return r.last.reactions[c].moment[axis];
              },
              Finite::may_be);
      for (unsigned int i = 0; i < observation.points.size(); ++i)
        for (unsigned int d = 0; d < dim; ++d)
          add(
            format("displacement of point %u %c (m)", i + 1, coordinate[d]),
            [i, d](const Record &r) { return r.displacements[i][d]; },
            Finite::may_be);
    }

    /** Appends the columns of the excess pore pressures at the observed points,
     *  for records with the member `pressures`. */
    void
    add_observed_pressures()
    {
      for (unsigned int i = 0; i < scene->observation.points.size(); ++i)
        add(
          format("excess pore pressure of point %u (Pa)", i + 1),
          [i](const Record &r) { return r.pressures[i]; },
          Finite::may_be);
    }
    /** @} */

    /** @name Topics of all summaries */
    /** @{ */
    /** Adds the section "points" to summary.json: final displacements of the
     *  observed points. */
    void
    add_points(Json &summary) const
    {
      const auto &displacements = records.back().displacements;
      for (unsigned int i = 0; i < displacements.size(); ++i)
        for (unsigned int d = 0; d < dim; ++d)
          summary["points"]
                 [format("displacement_%u_%c_m", i + 1, coordinate[d])] =
                   finite_or_null(displacements[i][d]);
    }

    /** Adds the excess pore pressures at the observed points to the section
     *  "points" of summary.json. */
    void
    add_pressures(Json &summary) const
    {
      const std::vector<double> &pressures = records.back().pressures;
      for (unsigned int i = 0; i < pressures.size(); ++i)
        summary["points"][format("excess_pore_pressure_%u_Pa", i + 1)] =
          finite_or_null(pressures[i]);
    }

    /** Returns the section "energy" of summary.json. @param weight_changes see
     *  EnergyBalance::json() */
    Json
    energy(const bool weight_changes) const
    {
      return balance.json(
        [this](const std::string &name) { return unit(name); }, weight_changes);
    }
    /** @} */

    /** Warns of conditions on sides of the mesh that are observed or move,
     *  and on which no force acts in any step: the particles do not reach
     *  them. */
    void
    warn_of_untouched() const
    {
      const auto &observed = scene->observation.conditions;
      const auto  is_given = [](const std::optional<Expression> &value) {
        return value && !value->is_zero();
      };
      for (unsigned int c = 0; c < scene->dirichlet.list.size(); ++c)
        {
          const BoundaryCondition &condition = *scene->dirichlet.list[c];
          const bool               matters =
            is_given(condition.normal) ||
            std::any_of(condition.components.begin(),
                        condition.components.end(),
                        is_given) ||
            std::count(observed.begin(), observed.end(), c) > 0;
          if (matters &&
              std::all_of(
                records.begin(), records.end(), [c](const Record &record) {
                  return record.last.reactions[c].force.norm() == 0.;
                }))
            this->log.warn(
              "no force acts on '" + condition.name +
              "' in any step: its sides are those of the mesh, and no particle "
              "reaches them; end the mesh at the body, or push the body by an "
              "obstacle or with 'Imposed on' = segments");
        }
    }

    const Scene  *scene = nullptr;
    EnergyBalance balance;
  };
} // namespace geocone::GEOCONE_DIM

#endif
