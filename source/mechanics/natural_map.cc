// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/mechanics/natural_map.h>

#include <Eigen/LU>

namespace geocone
{
  NaturalMap::NaturalMap(const MaterialPoints      &points,
                         const Materials           &materials,
                         const double               rho,
                         const std::vector<Mandel> &start)
    : points(points)
    , materials(materials)
    , rho(rho)
    , iterate(start)
    , slope(start.size())
  {
    for (unsigned int i = 0; i < materials.size(); ++i)
      {
        cones.push_back(materials[i].initial_cone());
        // A law may harden without a cone.
        hardens.push_back(materials[i].hardens() && cones.back());
      }
  }

  NaturalMap::Error
  NaturalMap::update(const std::vector<Mandel> &strain, std::vector<Mode> &mode)
  {
    const bool moves = !last_strain.empty();
    Error      error;
    double     largest_k = 0.;
    for (unsigned int p = 0; p < strain.size(); ++p)
      {
        const unsigned int material = points.material[p];
        FlowCone           at_point;
        const FlowCone    *cone = cones[material] ? &*cones[material] : nullptr;
        if (hardens[material])
          {
            at_point = *materials[material].flow_cone(points.history_of(p));
            cone     = &at_point;
          }
        const Elasticity &elasticity = materials[material].elasticity();
        Mandel            s          = iterate[p];
        if (moves)
          s += slope[p] * (strain[p] - last_strain[p]);

        mode[p] = Mode::elastic;
        if (cone != nullptr)
          {
            const double rho_p = rho * elasticity.two_G;
            const Mandel z     = to_cone_axes(
              elasticity.strain(Mandel(s - points.stress[p])) - strain[p]);
            const Mandel x = to_cone_axes(s);
            Mandel       projected;
            MandelMatrix J;
            const double k         = cone->hardened(z).k;
            mode[p]                = return_map(FlowCone{cone->a, cone->a, k},
                                 1.,
                                 1.,
                                 Mandel(x - rho_p * cone->psi(z)),
                                 projected,
                                 &J);
            const Mandel R         = x - projected;
            error.largest_residual = std::max(error.largest_residual, R.norm());
            error.stress_scale     = std::max(error.stress_scale, x.norm());
            largest_k              = std::max(largest_k, k);
            if (mode[p] != Mode::elastic)
              {
                const double compliance = 1. / elasticity.two_G;
                const Mandel S(
                  1. / elasticity.normal_stiffness(), compliance, compliance);
                MandelMatrix B = rho_p * J * cone->psi_slope(z);
                if (cone->hardening > 0.)
                  B -= cone->hardening *
                       project_slope(cone->a, projected, mode[p]) *
                       tangential_direction(z).transpose();
                const MandelMatrix A =
                  MandelMatrix::Identity() - J + B * S.asDiagonal();
                const auto factors = A.partialPivLu();
                iterate[p] = from_cone_axes(Mandel(x - factors.solve(R)));
                slope[p]   = from_cone_axes(MandelMatrix(factors.solve(B)));
              }
          }
        if (mode[p] == Mode::elastic)
          {
            // J = I, where the linear law is solved at once.
            iterate[p] = points.stress[p] + elasticity.stress(strain[p]);
            slope[p]   = elasticity.stiffness();
          }
      }
    error.stress_scale += largest_k;
    last_strain = strain;
    return error;
  }
} // namespace geocone
