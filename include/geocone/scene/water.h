// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_scene_water_h
#define geocone_scene_water_h

#include <geocone/base/parameter_file.h>
#include <geocone/functions/pressure_grid.h>
#include <geocone/scene/geometry.h>
#include <geocone/functions/triangle_field.h>
#include <geocone/scene/loading.h>
#include <geocone/scene/seepage.h>

#include <deal.II/base/parameter_acceptor.h>

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Pore water at rest below a piezometric line y = Y(x), uniform along z in
   * three dimensions, with the pressure
   *   u = gamma_w max(0, Y(x) - y),
   * or with pressures of a flow (Seepage), or given by a file
   * (PressureGrid). Stresses are effective, s' = s + u 1 (tension positive), so that
   *   div s' + rho g - grad u = 0,
   * where rho is the density of the soil including its water. Where the line
   * lies above the ground, free water loads the surface with u: there, as on
   * the complete free surface, the effective traction is zero, so that no
   * further load is needed.
   */
  class Water : public dealii::ParameterAcceptor
  {
  public:
    explicit Water(const ParameterFile &file);

    /** Checks the parameters. @param geometry of the body, already prepared
     *  @throws InputError */
    void
    prepare(const Gravity &gravity, const Geometry &geometry);

    /** Checks the parameters except gravity. @throws InputError */
    void
    prepare_pressures(const Geometry &geometry);

    bool
    acts() const
    {
      return !table.empty() || grid.has_value() || seepage.acts();
    }

    /** Whether the water table is level. */
    bool
    is_level() const;

    /** Whether the seepage force varies within cells of any mesh, as is the
     *  case for pressures from a file or a flow. */
    bool
    varies_in_cells() const
    {
      return grid.has_value() || seepage.acts();
    }

    /** Boundaries of the body between which water flows. */
    Seepage seepage;

    /** Whether some of the flows are transient. */
    bool
    flows_in_time() const;

    /** Flows to be solved, in order: the initial one, then those of stages. */
    std::vector<Seepage::Step>
    flow_steps() const;

    /** Pore pressures of a flow, and its free surface. */
    struct Flow
    {
      TriangleField                                  pressure; ///< (Pa)
      std::vector<std::array<dealii::Point<dim>, 2>> surface;  ///< segments
    };

    /** Sets the results of flow_steps(), whose pressures at a time are the initial
     *  ones. */
    void
    set_flows(std::vector<Flow> of_steps, const double time = 0.)
    {
      all_flows     = std::move(of_steps);
      initial_parts = parts(time);
    }

    const std::vector<Flow> &
    flows() const
    {
      return all_flows;
    }

    /** Unit weight of water (N/m^3). */
    double
    weight() const
    {
      return unit_weight;
    }

    /** Reads the lines and levels of stages. @throws InputError if there are no
     *  initial ones, or some are invalid */
    void
    prepare_stages(const LoadingProgramme &loading);

    /** Initial pore pressure u (Pa). */
    double
    pressure(const dealii::Point<dim> &x) const;

    /** Seepage force -grad u (N/m^3) of one of the lines or flows: the initial
     *  one, then those of stages. */
    dealii::Tensor<1, dim>
    force(const dealii::Point<dim> &x, const std::size_t line = 0) const;

    /** Weight of each line or flow in the pressures at time t; they sum up to 1. */
    std::vector<double>
    parts(const double t) const;

    /**
     * Lines of the plane across which the force jumps, where u has a kink: the
     * water table, and vertical lines below its corners; none for pressures
     * that vary in cells.
     * @param lower,upper corners of a box around the body
     */
    std::vector<std::array<dealii::Point<dim>, 2>>
    lines(const dealii::Point<dim> &lower,
          const dealii::Point<dim> &upper) const;

    /** @throws InputError if there is water. @param what does not support it */
    void
    refuse(const std::string &what, const std::string &remedy) const;

  private:
    using Table = std::vector<dealii::Point<2>>; ///< x, y

    /** @throws InputError unless x increases */
    static void
    check(const Table &table, const std::string &parameter);

    /** Y and its slope. */
    static std::array<double, 2>
    level(const Table &table, const double x);

    void
    add_lines(const Table                                    &table,
              const dealii::Point<dim>                       &lower,
              const dealii::Point<dim>                       &upper,
              std::vector<std::array<dealii::Point<dim>, 2>> &all) const;

    const std::string           folder; ///< to which the file is relative
    std::string                 file;
    std::optional<PressureGrid> grid;
    Table                       table;
    std::vector<Flow>           all_flows;
    std::vector<double>         initial_parts; ///< weights of flows

    /** Piezometric line at the end of a stage, or a flow during it. */
    struct Later
    {
      double        begin, end; ///< (s)
      Table         table;
      Seepage::Step flow;
    };
    std::vector<Later> later;

    double unit_weight = 9810.;
  };
} // namespace geocone::GEOCONE_DIM

#endif
