// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_scene_water_h
#define geocone_scene_water_h

#include <geocone/base/parameter_file.h>
#include <geocone/functions/pressure_grid.h>
#include <geocone/scene/geometry.h>
#include <geocone/scene/loading.h>

#include <deal.II/base/parameter_acceptor.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Water at rest below a piezometric line y = Y(x), alike along z in three dimensions,
   * with the pressure
   *   u = gamma_w max(0, Y(x) - y),
   * or with pressures that a file gives (PressureGrid), as of water that seeps.
   * Stresses are effective ones, s' = s + u 1 (tension positive), and so
   *   div s' + rho g - grad u = 0,
   * rho the density of the soil with its water. Where the line runs above the
   * ground the water outside presses with u on it: there, as on all of the free
   * surface, the effective traction is zero, so that nothing else is to be added.
   */
  class Water : public dealii::ParameterAcceptor
  {
  public:
    explicit Water(const ParameterFile &file);

    /** Checks the parameters. @param geometry of the body, which is prepared
     *  @throws InputError */
    void
    prepare(const Gravity &gravity, const Geometry &geometry);

    bool
    acts() const
    {
      return !table.empty() || grid.has_value();
    }

    /** Whether its table is level. */
    bool
    is_level() const;

    /** Whether a file gives the pressures, whose gradient is not constant anywhere. */
    bool
    is_of_grid() const
    {
      return grid.has_value();
    }

    /** Takes the lines of stages. @throws InputError where there is no line before them,
     *  or for one that is none */
    void
    prepare_stages(const LoadingProgramme &loading);

    /** u (Pa) at the start. */
    double
    pressure(const dealii::Point<dim> &x) const;

    /** -grad u (N/m^3) of one of the lines: the first is the start's, then those of
     *  stages. */
    dealii::Tensor<1, dim>
    force(const dealii::Point<dim> &x, const std::size_t line = 0) const;

    /** The part of each line in the pressures at time t, whose sum is 1. */
    std::vector<double>
    parts(const double t) const;

    /**
     * The lines of the plane across which the force jumps, and at which u has a kink: that of the
     * table, and upright ones below its corners; none of pressures from a file.
     * @param lower,upper corners of a box around the body
     */
    std::vector<std::array<dealii::Point<dim>, 2>>
    lines(const dealii::Point<dim> &lower,
          const dealii::Point<dim> &upper) const;

    /** @throws InputError if there is water, with what knows none */
    void
    refuse(const std::string &what, const std::string &remedy) const;

  private:
    using Table = std::vector<dealii::Point<2>>; ///< x, y

    /** @throws InputError if x does not grow */
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

    const std::string           folder; ///< what the file is relative to
    std::string                 file;
    std::optional<PressureGrid> grid;
    Table                       table;

    /** A line that a stage leads to. */
    struct Later
    {
      double begin, end; ///< of the stage (s)
      Table  table;
    };
    std::vector<Later> later;

    double unit_weight = 9810.;
  };
} // namespace geocone::GEOCONE_DIM

#endif
