// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_scene_water_h
#define geocone_scene_water_h

#include <geocone/base/parameter_file.h>
#include <geocone/boundary/loading.h>
#include <geocone/functions/pressure_grid.h>
#include <geocone/functions/simplex_field.h>
#include <geocone/geometry/soil_columns.h>
#include <geocone/scene/seepage.h>

#include <deal.II/base/parameter_acceptor.h>

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace geocone
{
  class Retention;
}

namespace geocone::GEOCONE_DIM
{
  /**
   * Pore water pressure: hydrostatic, from a seepage analysis (Seepage), from a
   * file (PressureGrid) or by the pore pressure ratio r_u of Bishop and
   * Morgenstern (1960), u = r_u sigma_v, where sigma_v is the total vertical
   * stress of the soil column above (SoilColumns). Water at rest below a piezometric line y = Y(x),
   * uniform along z in three dimensions, has the pressure
   *   u = gamma_w max(0, Y(x) - y).
   * Effective stresses s' = s + u 1 (tension positive) satisfy
   *   div s' + rho g - grad u = 0,
   * where rho is the density of the soil including its water. Where the line
   * lies above the ground, free water loads the surface with u: there, as on
   * the complete free surface, the effective traction is zero, so that no
   * further load is needed. Above the free surface of a flow with suction, u < 0
   * and Bishop's effective stress is s' = s + chi u 1: the load is the power
   *   integral of chi u div v,
   * whose boundary part compresses the surface of the soil by -chi u.
   */
  class Water : public dealii::ParameterAcceptor
  {
  public:
    explicit Water(const ParameterFile &file);

    /** Checks the parameters. @param geometry,regions,materials of the body,
     *  already prepared @throws InputError */
    void
    prepare(const Gravity   &gravity,
            const Geometry  &geometry,
            const Regions   &regions,
            const Materials &materials);

    /** Checks the parameters of pore water that do not depend on gravity.
     *  @throws InputError */
    void
    prepare_pressures(const Geometry &geometry);

    bool
    acts() const
    {
      return !table.empty() || grid.has_value() || seepage.acts() ||
             scales_with_weight();
    }

    /** Returns true if the pore pressures are proportional to the weight of the
     *  soil, by the pore pressure ratio. */
    bool
    scales_with_weight() const
    {
      return pressure_ratio > 0.;
    }

    /** Returns true if the water table is horizontal, or the pore pressures of
     *  soil columns depend on y alone. */
    bool
    is_level() const;

    /** Returns true if the seepage force varies within the cells of a mesh, as
     *  for pore pressures from a file or a seepage analysis. */
    bool
    varies_in_cells() const
    {
      return grid.has_value() || seepage.acts();
    }

    /** Boundary conditions of the seepage problem. */
    Seepage seepage;

    /** Returns true if any flow problem is transient. */
    bool
    flows_in_time() const;

    /** Returns all flow problems in order: the initial flow problem, then the
     *  flow problems of the stages. */
    std::vector<Seepage::Step>
    flow_steps() const;

    /** Solution of a flow problem: pore pressures and position of the free
     *  surface. */
    struct Flow
    {
      SimplexField pressure; ///< (Pa)

      /** Free surface: line segments, or triangles in three dimensions. */
      std::vector<std::array<dealii::Point<dim>, dim>> surface;

      bool has_suction = false; ///< pressure < 0 above the free surface
    };

    /** Stores the solutions of the flow problems listed by flow_steps().
     *  @param time at which the pressures are the initial pore pressures (s) */
    void
    set_flows(std::vector<Flow> of_steps, const double time = 0.)
    {
      all_flows       = std::move(of_steps);
      initial_weights = interpolation_weights(time);
    }

    const std::vector<Flow> &
    flows() const
    {
      return all_flows;
    }

    /** Returns the unit weight of water (N/m^3). */
    double
    weight() const
    {
      return unit_weight;
    }

    /** Reads the piezometric lines and water levels of all stages.
     *  @throws InputError if initial lines or levels are missing, or for
     *  invalid values */
    void
    prepare_stages(const LoadingProgramme &loading);

    /** Returns the initial pore pressure u (Pa) at the point x. */
    double
    pressure(const dealii::Point<dim> &x) const;

    /** Returns the pore pressure u (Pa) at the point x and the time t (s); at
     *  t = 0 the initial one. */
    double
    pressure(const dealii::Point<dim> &x, const double t) const;

    /** Returns true if the soil at x has its saturated density: below the water
     *  table, where the initial pore pressure is positive. With the pore
     *  pressure ratio no soil has: unit weights are total ones. */
    bool
    saturates(const dealii::Point<dim> &x) const
    {
      return !scales_with_weight() && pressure(x) > 0.;
    }

    /** Returns the seepage force -grad u (N/m^3) at the point x for one
     *  piezometric line or flow problem.
     *  @param line index: 0 initially, then in the order of stages */
    dealii::Tensor<1, dim>
    force(const dealii::Point<dim> &x, const std::size_t line = 0) const;

    /** Returns true if the computed pore pressures are negative (suction) above
     *  the free surface. */
    bool
    has_suction() const
    {
      return !all_flows.empty() && all_flows.front().has_suction;
    }

    /** Suction stress chi u <= 0 (Pa) in Bishop's effective stress, of one flow
     *  problem. It is zero below the free surface and without suction. */
    double
    suction_stress(const dealii::Point<dim> &x,
                   const Retention          &soil,
                   const std::size_t         line) const;

    /** Initial suction stress chi u (Pa), see suction_stress(). */
    double
    initial_suction_stress(const dealii::Point<dim> &x,
                           const Retention          &soil) const;

    /** Returns the interpolation weights at time t for the pore pressures of
     *  all piezometric lines and flow problems. The weights sum to 1. */
    std::vector<double>
    interpolation_weights(const double t) const;

    /**
     * Returns the line segments across which the seepage force is
     * discontinuous. These are the water table, and vertical lines below its
     * vertices, or those of the soil columns. The list is empty for pressures
     * from a file or from seepage.
     * @param lower,upper corners of a box around the body
     */
    std::vector<std::array<dealii::Point<dim>, 2>>
    lines(const dealii::Point<dim> &lower,
          const dealii::Point<dim> &upper) const;

    /** Rejects pore water. @throws InputError @param what feature that does not
     *  support it */
    void
    refuse(const std::string &what, const std::string &remedy) const;

  private:
    using Table = std::vector<dealii::Point<2>>; ///< vertices (x, y)

    /** Returns the pore pressure (Pa) of one piezometric line or flow problem.
     *  @param line see force() */
    double
    pressure_of(const dealii::Point<dim> &x, const std::size_t line) const;

    /** Returns the mean of these pressures (Pa). @param weights of all lines or
     *  flow problems, see interpolation_weights() */
    double
    mean_pressure(const dealii::Point<dim>  &x,
                  const std::vector<double> &weights) const;

    /** Rejects a pore pressure ratio out of its limits or beside other pore
     *  pressures. @throws InputError */
    void
    check_ratio() const;

    /** Checks that the x coordinates of a piezometric line increase. @throws
     *  InputError */
    static void
    check(const Table &table, const std::string &parameter);

    /** Returns the level Y (m) and the slope dY/dx of a piezometric line at the
     *  coordinate x. */
    static std::array<double, 2>
    level(const Table &table, const double x);

    void
    add_lines(const Table                                    &table,
              const dealii::Point<dim>                       &lower,
              const dealii::Point<dim>                       &upper,
              std::vector<std::array<dealii::Point<dim>, 2>> &all) const;

    const std::string           folder; ///< to which file names are relative
    std::string                 file;
    std::optional<PressureGrid> grid;
    Table                       table;
    double                      pressure_ratio = 0.; ///< r_u
    std::optional<SoilColumns>  columns;
    std::vector<Flow>           all_flows;

    /** interpolation_weights() at the initial time. */
    std::vector<double> initial_weights = {1.};

    /** Piezometric line at the end of a stage, or flow problem during the
     *  stage. */
    struct Later
    {
      double        begin, end; ///< begin and end of the stage (s)
      Table         table;
      Seepage::Step flow;
    };
    std::vector<Later> later;

    double unit_weight = 9810.;
  };
} // namespace geocone::GEOCONE_DIM

#endif
