// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_surfaces_panel_h
#define geocone_surfaces_panel_h

#include <geocone/scene/scene.h>
#include <geocone/surfaces/facet.h>

#include <array>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** A flat part of a side of the body, as it is: in the plane a line, in space a
   *  parallelogram. */
  struct Panel
  {
    dealii::Point<dim> corner;

    /** From the corner: in the plane the body is on the left, in space the edges and the
     *  outward normal are right-handed. */
    std::array<dealii::Tensor<1, dim>, dim - 1> edges;

    dealii::Point<dim>
    at(const dealii::Point<dim - 1> &s) const;

    /** The outward normal times the length (m), or the area (m^2). */
    dealii::Tensor<1, dim>
    area() const;

    /** All of them, in the order of deal.II. */
    std::vector<dealii::Point<dim>>
    corners() const;

    /** The corner and the ends of the edges. */
    std::array<dealii::Point<dim>, dim>
    ends() const;

    /** Takes them. */
    void
    span(const std::array<dealii::Point<dim>, dim> &ends);

    /** It, or the two triangles that make it. */
    std::vector<Facet>
    facets() const;

    /** So many equal parts along each edge. */
    std::vector<Panel>
    parts(const std::array<unsigned int, dim - 1> &n) const;
  };

  /**
   * The parts of the condition's sides of the body inside its box.
   * @throws InputError if the body has no such side or it misses the box
   */
  std::vector<Panel>
  panels_of_body(const BoundaryCondition &condition, const Geometry &geometry);

  /** Points on a panel, see for_each_point(); their weights are parts of the panel. */
  std::vector<BoundaryPoint>
  points_on_panel(const BackgroundMesh &mesh,
                  const Space          &space,
                  const Panel          &panel);

  /** The longest part of the middle line along an edge in one cell (m). Collective. */
  double
  cell_size_along(const BackgroundMesh &mesh,
                  const Panel          &panel,
                  const unsigned int    edge);
} // namespace geocone::GEOCONE_DIM

#endif
