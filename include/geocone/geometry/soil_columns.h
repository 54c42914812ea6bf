// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_geometry_soil_columns_h
#define geocone_geometry_soil_columns_h

#include <geocone/geometry/regions.h>

#include <array>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Total vertical stress of the soil columns of a body,
   *   sigma_v(x) = integral of the unit weight from x up to the ground surface,
   * as compression. The body is divided into upright strips between the vertices
   * and crossings of its sides and of the regions of its materials. In each
   * layer of a strip the stress is linear in x and y. In three dimensions the
   * body is a box with layers as wide as the box: one strip, uniform along x
   * and z.
   */
  class SoilColumns
  {
  public:
    /** @param unit_weights of the materials (N/m^3), with @p regions
     *  @param parameter,value,remedy of the messages
     *  @throws InputError unless the vertical stress is continuous in the body:
     *  for overhangs, holes, steps of the ground, and upright interfaces of
     *  materials of different weight; also for bodies from files, discs and
     *  bodies restricted by a formula, whose surface is not a polygon */
    SoilColumns(const Geometry            &geometry,
                const Regions             &regions,
                const std::vector<double> &unit_weights,
                const std::string         &parameter,
                const double               value,
                const std::string         &remedy);

    /** Returns the total vertical stress (Pa); 0 above the ground. */
    double
    stress(const dealii::Point<dim> &x) const;

    /** Returns the gradient of stress() (N/m^3); 0 above the ground. */
    dealii::Tensor<1, dim>
    gradient(const dealii::Point<dim> &x) const;

    /** Returns true if the stress is a function of y. */
    bool
    are_level() const;

    /** Returns the lines across which the gradient jumps, apart from the sides
     *  of regions: upright lines below vertices of the ground surface and of the
     *  layers. In three dimensions: the traces of the interfaces of layers. */
    std::vector<std::array<dealii::Point<dim>, 2>>
    lines() const;

  private:
    /** Value at a coordinate x in a strip, linear between both sides. */
    struct Linear
    {
      double left, right;
    };

    /** Layer of a strip, from its top down to the top of the next one. */
    struct Layer
    {
      Linear top;    ///< y (m)
      Linear stress; ///< at the top (Pa)
      double weight; ///< N/m^3
    };

    struct Strip
    {
      double             left, right; ///< x (m)
      std::vector<Layer> layers;      ///< from the top
      Linear             bottom;      ///< y (m)

      double
      at(const Linear &value, const double x) const
      {
        return value.left +
               (x - left) / (right - left) * (value.right - value.left);
      }
      double
      slope(const Linear &value) const
      {
        return (value.right - value.left) / (right - left);
      }

      /** Returns the layer at a place; null above the ground. */
      const Layer *
      layer(const double x, const double y) const;

      double
      stress(const double x, const double y) const;

      /** Returns d sigma_v/dx in a layer. */
      double
      slope_of_stress(const Layer &layer) const
      {
        return slope(layer.stress) + layer.weight * slope(layer.top);
      }
    };

    /** Side of the body or of a region, from left to right. */
    struct Segment
    {
      dealii::Point<dim> left, right;
      bool               is_of_body;
    };

    void
    add_strip(const double                left,
              const double                right,
              const std::vector<Segment> &segments,
              const Regions              &regions);

    void
    add_layers_of_box(const Geometry &geometry, const Regions &regions);

    void
    check_continuity() const;

    void
    add_lines_between(
      const Strip                                    &left,
      const Strip                                    &right,
      std::vector<std::array<dealii::Point<dim>, 2>> &all) const;

    const Strip &
    strip(const double x) const;

    [[noreturn]] void
    refuse(const std::string &allowed) const;

    std::vector<double> unit_weights;
    std::string         parameter, remedy;
    double              value, rounding = 0.;
    std::vector<Strip>  strips; ///< from left to right
  };
} // namespace geocone::GEOCONE_DIM

#endif
