// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/points/point_elasticity.h>
#include <geocone/terms/natural_map.h>

#include <Eigen/LU>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    /** Ratio of rho for laws with edges to that of cones, whose optimum is
     *  smaller. For laws with edges, projections alternate between planes and
     *  edges if rho is small, and beyond the edges if it is large (of 2G, 0.1
     *  to 0.25 work in one layer of cells; 0.03 and 0.4 cycle). */
    constexpr double rho_with_edges = 5.;

    /** Number of updates without a halved residual after which a point is
     *  solved by the return map, and the residual over the stress below which
     *  it counts as solved. */
    constexpr unsigned int patience = 5;
    constexpr double       solved   = 1e-9;

    /** Derivative of the projection with respect to |z_t| through the cone, by
     *  a difference quotient. @param strain the size of elastic strains */
    template <typename ConeOf, typename Project>
    Mandel
    slope_by_slip(const ConeOf  &cone_of,
                  const Project &project_on,
                  const double   slip,
                  const double   strain)
    {
      const double step  = 1e-6 * std::max(slip, strain),
                   below = std::min(step, slip);
      Mandel above, under;
      project_on(cone_of(slip + step), above, nullptr);
      project_on(cone_of(slip - below), under, nullptr);
      return (above - under) / (step + below);
    }
  } // namespace

  NaturalMap::NaturalMap(const MaterialPoints      &points,
                         const Materials           &materials,
                         const StepData            &step,
                         const double               rho,
                         const std::vector<Mandel> &start)
    : points(points)
    , materials(materials)
    , step(step)
    , rho(rho)
    , iterate(start)
    , slopes((start.size() + block_size - 1) / block_size)
  {
    for (unsigned int i = 0; i < materials.size(); ++i)
      {
        cones.push_back(materials[i].initial_cone());
        if (!cones.back())
          progress.resize(start.size());
        // A law may have a history without a cone.
        varies.push_back(materials[i].has_history() && cones.back());
        compliance.push_back(materials[i].elasticity().stiffness().inverse());
      }
  }

  NaturalMap::Error
  NaturalMap::update(const std::vector<Mandel> &strain, std::vector<Mode> &mode)
  {
    const bool moves = !last_strain.empty();
    Error      error;
    double     largest_k = 0.;
    Slopes     next; // of a block
    for (unsigned int p = 0, of_last = 0; p < strain.size(); ++p)
      {
        Slopes          &last       = slopes[p / block_size];
        const Elasticity elasticity = elasticity_at_start(materials, points, p);
        MandelMatrix     slope;
        Mandel           s = iterate[p];
        if (moves)
          {
            const bool flowed =
              of_last < last.point.size() && last.point[of_last] == p;
            slope = flowed ? last.slope[of_last] : elasticity.stiffness();
            s += slope * (strain[p] - last_strain[p]);
            of_last += flowed;
          }
        const Mandel z =
          elasticity.strain(Mandel(s - points.stress[p])) - strain[p];
        mode[p] =
          cones[points.material[p]]
            ? update_on_cone(p, elasticity, s, z, slope, error, largest_k)
            : update_with_edges(p, elasticity, s, z, strain[p], slope, error);
        if (mode[p] == Mode::elastic)
          // J = I, for which the linear law is solved at once.
          iterate[p] = points.stress[p] + elasticity.stress(strain[p]);
        else
          {
            next.point.push_back(p);
            next.slope.push_back(slope);
          }
        if ((p + 1) % block_size == 0 || p + 1 == strain.size())
          {
            last.point.assign(next.point.begin(), next.point.end());
            last.slope.assign(next.slope.begin(), next.slope.end());
            next.point.clear();
            next.slope.clear();
            of_last = 0;
          }
      }
    error.stress_scale += largest_k;
    last_strain = strain;
    return error;
  }

  void
  NaturalMap::copy_tangents(const unsigned int begin,
                            const unsigned int end,
                            MandelMatrix      *tangent) const
  {
    for (unsigned int p = begin; p < end; ++p)
      {
        const Slopes &block = slopes[p / block_size];
        const auto    found =
          std::lower_bound(block.point.begin(), block.point.end(), p);
        tangent[p - begin] =
          found != block.point.end() && *found == p
            ? block.slope[found - block.point.begin()]
            : elasticity_at_start(materials, points, p).stiffness();
      }
  }

  Mode
  NaturalMap::update_on_cone(const unsigned int p,
                             const Elasticity  &elasticity,
                             const Mandel      &s,
                             const Mandel      &z,
                             MandelMatrix      &slope,
                             Error             &error,
                             double            &largest_k)
  {
    const unsigned int material = points.material[p];
    const double       rho_p    = rho * elasticity.two_G;
    const Mandel       z_axes   = to_cone_axes(z);
    const Mandel       x        = to_cone_axes(s);
    const auto         cone_of  = [&](const double slip) {
      return varies[material]
                        ? *materials[material].end_cone(
                   points.stress[p], points.history_of(p), step, slip)
                        : *cones[material];
    };
    const auto project_on =
      [&](const FlowCone &cone, Mandel &projected, MandelMatrix *J) {
        const FlowCone convex{cone.a, cone.a, cone.k, cone.tension};
        return return_map(
          convex, 1., 1., Mandel(x - rho_p * cone.psi(z_axes)), projected, J);
      };
    const double   slip = FlowCone::tangential_norm(z_axes);
    const FlowCone cone = cone_of(slip);
    Mandel         projected;
    MandelMatrix   J;
    const Mode     mode    = project_on(cone, projected, &J);
    const Mandel   R       = x - projected;
    error.add(R, x);
    largest_k              = std::max(largest_k, cone.k);
    if (mode == Mode::elastic)
      return mode;

    const double compliance_of_shear = 1. / elasticity.two_G;
    Mandel       S                   = Mandel::Constant(compliance_of_shear);
    S[0]                             = 1. / elasticity.normal_stiffness();
    MandelMatrix B                   = rho_p * J * cone.psi_slope(z_axes);
    if (materials[material].hardens())
      B -= slope_by_slip(
             cone_of, project_on, slip, compliance_of_shear * x.norm()) *
           tangential_direction(z_axes).transpose();
    const MandelMatrix A = MandelMatrix::Identity() - J + B * S.asDiagonal();
    const auto         factors = A.partialPivLu();
    iterate[p]                 = from_cone_axes(Mandel(x - factors.solve(R)));
    slope                      = from_cone_axes(MandelMatrix(factors.solve(B)));
    return mode;
  }

  Mode
  NaturalMap::update_with_edges(const unsigned int p,
                                const Elasticity  &elasticity,
                                const Mandel      &s,
                                const Mandel      &z,
                                const Mandel      &strain,
                                MandelMatrix      &slope,
                                Error             &error)
  {
    Progress &own = progress[p];
    if (own.since == patience)
      return map_back(p, strain, slope);
    const unsigned int material = points.material[p];
    const double       rho_p    = rho_with_edges * (rho * elasticity.two_G);
    const auto         at       = materials[material].project_natural_map(
      s, z, rho_p, points.stress[p], points.history_of(p), step);
    if (!at)
      return Mode::elastic;
    const Mandel R         = s - at->stress;
    error.add(R, s);
    if (at->mode == Mode::elastic)
      return at->mode;

    const double size = R.norm();
    own.since =
      size < own.least / 2. || size < solved * s.norm() ? 0 : own.since + 1;
    if (own.since == 0)
      own.least = size;
    if (own.since == patience)
      return map_back(p, strain, slope);

    const MandelMatrix B = rho_p * at->slope * at->psi_slope,
                       A = MandelMatrix::Identity() - at->slope +
                           B * compliance[material];
    const auto factors = A.partialPivLu();
    iterate[p]         = s - factors.solve(R);
    slope              = factors.solve(B);
    return at->mode;
  }

  Mode
  NaturalMap::map_back(const unsigned int p,
                       const Mandel      &strain,
                       MandelMatrix      &slope)
  {
    Mode      mode = Mode::elastic;
    Increment increment;
    increment.strain    = dealii::ArrayView<const Mandel>(&strain, 1);
    increment.stress_n  = dealii::ArrayView<const Mandel>(&points.stress[p], 1);
    increment.history_n = points.history_of(p);
    increment.n_history = points.n_history();
    increment.step      = step;
    Response response;
    response.stress  = dealii::ArrayView<Mandel>(&iterate[p], 1);
    response.mode    = dealii::ArrayView<Mode>(&mode, 1);
    response.tangent = dealii::ArrayView<MandelMatrix>(&slope, 1);
    materials[points.material[p]].update(increment, response);
    return mode;
  }
} // namespace geocone::GEOCONE_DIM
