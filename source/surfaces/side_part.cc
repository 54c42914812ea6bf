// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/shapes/edge_normal.h>
#include <geocone/surfaces/side_part.h>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  UnitPart
  UnitPart::whole()
  {
    UnitPart all;
    for (unsigned int k = 0; k + 1 < dim; ++k)
      all.upper[k] = 1.;
    return all;
  }

  Tensor<1, dim>
  area_of(const SidePart &part)
  {
    const auto &x = part.corners;
    if (dim == 2)
      return edge_normal(x[0], x[1]);
    Tensor<1, dim> area;
    for (std::size_t i = 2; i < x.size(); ++i)
      area += cross_product_3d(x[i - 1] - x[0], x[i] - x[0]) / 2.;
    return area;
  }

  SidePart
  spanned_by(const std::array<Point<dim>, dim> &ends)
  {
    SidePart part{{ends[0], ends[1]}};
    if (dim == 3)
      {
        part.corners.push_back(ends[1] + (ends[dim - 1] - ends[0]));
        part.corners.push_back(ends[dim - 1]);
      }
    return part;
  }

  std::array<Point<dim>, dim>
  ends_of(const SidePart &part)
  {
    std::array<Point<dim>, dim> ends;
    ends[0]       = part.corners[0];
    ends[1]       = part.corners[1];
    ends[dim - 1] = part.corners.back();
    return ends;
  }

  SidePart
  part_of(const SidePart &whole, const UnitPart &part)
  {
    SidePart       result{{whole.at(part.lower)}};
    Point<dim - 1> corner = part.lower;
    for (unsigned int k = 0; k + 1 < dim; ++k)
      {
        corner[k] = part.upper[k];
        result.corners.push_back(whole.at(corner));
      }
    if (dim == 3)
      {
        corner[0] = part.lower[0];
        result.corners.push_back(whole.at(corner));
      }
    return result;
  }

  std::vector<SidePart>
  parts_of(const SidePart &whole, const std::array<unsigned int, dim - 1> &n)
  {
    std::vector<SidePart> all = {whole};
    for (unsigned int k = 0; k + 1 < dim; ++k)
      {
        std::vector<SidePart> divided;
        for (const SidePart &part : all)
          for (unsigned int i = 0; i < n[k]; ++i)
            {
              UnitPart between = UnitPart::whole();
              between.lower[k] = double(i) / n[k];
              between.upper[k] = (i + 1.) / n[k];
              divided.push_back(part_of(part, between));
            }
        all = divided;
      }
    return all;
  }
} // namespace geocone::GEOCONE_DIM
