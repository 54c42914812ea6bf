// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/clipped.h>
#include <geocone/surfaces/face_plane.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    using Flat = Point<dim - 1>;

    /** Twice the area of a triangle, positive if it is counterclockwise. */
    double
    turn(const Flat &a, const Flat &b, const Flat &c)
    {
      const auto u = b - a, v = c - a;
      return u[0] * v[dim - 2] - u[dim - 2] * v[0];
    }

    /** Calls f(a, b, sign) for the edges of an outline; inside, sign * turn(a,
     *  b, x) >= 0. */
    template <typename Function>
    void
    for_edges(const FlatPart &outline, const Function &f)
    {
      const auto  &corners = outline.corners;
      const double sign =
        turn(corners[0], corners[1], corners[corners.size() - 1]) < 0. ? -1.
                                                                       : 1.;
      for (std::size_t i = 0; i < corners.size(); ++i)
        f(corners[i], corners[(i + 1) % corners.size()], sign);
    }

    // Templates, so that only the branch of the dimension is compiled.

    template <int m>
    Point<m>
    unbounded_unit_place(const Outline<m> &outline, const Point<m> &x)
    {
      const auto &corners = outline.corners;
      Point<m>    s;
      if constexpr (m == 1)
        s[0] = (x - corners[0]) * (corners[1] - corners[0]) /
               (corners[1] - corners[0]).norm_square();
      else
        // Linear in triangles and parallelograms, where the first step is
        // exact.
        for (unsigned int step = 0; step < 20; ++step)
          {
            const auto lack = x - outline.at(s);
            if (lack.norm() <= 1e-14 * corners[0].distance(corners[2]))
              break;
            Tensor<1, m> along[m] = {outline.edge(0), outline.edge(1)};
            if (corners.size() == 4)
              {
                const auto twist = (corners[2] - corners[1]) - along[1];
                along[0] += s[1] * twist;
                along[1] += s[0] * twist;
              }
            const double det =
              along[0][0] * along[1][1] - along[0][1] * along[1][0];
            s[0] += (lack[0] * along[1][1] - lack[1] * along[1][0]) / det;
            s[1] += (along[0][0] * lack[1] - along[0][1] * lack[0]) / det;
          }
      return s;
    }

    template <int m>
    std::vector<Outline<m>>
    pieces_of_both(const Outline<m> &a, const Outline<m> &b)
    {
      if constexpr (m == 1)
        {
          const auto ends = [](const Outline<m> &outline) {
            return std::minmax(outline.corners[0][0], outline.corners[1][0]);
          };
          const double begin = std::max(ends(a).first, ends(b).first),
                       end   = std::min(ends(a).second, ends(b).second);
          if (end > begin)
            return {{{Point<m>(begin), Point<m>(end)}}};
          return {};
        }
      else
        {
          Outline<m> rest = a;
          for_edges(
            b,
            [&](const Point<m> &from, const Point<m> &to, const double sign) {
              Tensor<1, m> into;
              into[0]      = sign * (from[1] - to[1]);
              into[1]      = sign * (to[0] - from[0]);
              rest.corners = clipped(rest.corners, from, into);
            });
          return rest.simplices();
        }
    }
  } // namespace

  Flat
  unit_place(const FlatPart &outline, const Flat &x)
  {
    Flat s = unbounded_unit_place(outline, x);
    for (unsigned int k = 0; k + 1 < dim; ++k)
      s[k] = std::clamp(s[k], 0., 1.);
    return s;
  }

  bool
  is_in(const FlatPart &outline, const Flat &x)
  {
    if (dim == 2)
      return (x[0] - outline.corners[0][0]) * (x[0] - outline.corners[1][0]) <=
             0.;
    bool is_inside = true;
    for_edges(outline, [&](const Flat &a, const Flat &b, const double sign) {
      is_inside = is_inside && sign * turn(a, b, x) >= 0.;
    });
    return is_inside;
  }

  double
  size_of(const FlatPart &simplex)
  {
    const auto &x = simplex.corners;
    if constexpr (dim == 2)
      return std::abs(x[1][0] - x[0][0]);
    else
      return std::abs(turn(x[0], x[1], x[2])) / 2.;
  }

  std::vector<FlatPart>
  shared_part(const FlatPart &a, const FlatPart &b)
  {
    return pieces_of_both(a, b);
  }

  FacePlane::FacePlane(const SidePart &face)
    : diameter(0.)
    , origin(face.corners[0])
  {
    const auto &corners = face.corners;
    for (const Point<dim> &a : corners)
      for (const Point<dim> &b : corners)
        diameter = std::max(diameter, a.distance(b));
    normal = area_of(face);
    size   = normal.norm();
    normal /= size;
    axes[0] = (corners[1] - corners[0]) / corners[0].distance(corners[1]);
    if constexpr (dim == 3)
      {
        axes[0] -= (axes[0] * normal) * normal;
        axes[0] /= axes[0].norm();
        axes[1] = cross_product_3d(normal, axes[0]);
      }
  }

  FlatPart
  FacePlane::project(const SidePart &face) const
  {
    FlatPart flat;
    for (const Point<dim> &x : face.corners)
      {
        Flat &corner = flat.corners.emplace_back();
        for (unsigned int k = 0; k + 1 < dim; ++k)
          corner[k] = (x - origin) * axes[k];
      }
    return flat;
  }
} // namespace geocone::GEOCONE_DIM
