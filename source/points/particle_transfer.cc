// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/unused_parameters.h>
#include <geocone/points/particle_transfer.h>

#include <deal.II/base/patterns.h>
#include <deal.II/base/symmetric_tensor.h>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    const UsedWhere used_particle_transfer[] = {
      {"Material point method/Transfer",
       "Discretisation/Method",
       {"MPM", "explicit MPM"}},
      {"Material point method/FLIP part",
       "Discretisation/Method",
       {"MPM", "explicit MPM"}},
      {"Material point method/FLIP part",
       "Material point method/Transfer",
       {"FLIP", "AFLIP"}}};
  } // namespace

  const char *const ParticleTransfer::parameter =
    "Material point method/Transfer";

  ParticleTransfer::ParticleTransfer()
    : ParameterAcceptor("/Material point method")
  {
    rule.declare(
      *this,
      "Transfer",
      ". Transfer of velocities from the grid to the particles. FLIP: adds the "
      "increment of nodal velocities. APIC: interpolates the velocity and its "
      "affine part; conserves angular momentum and damps vibrations. AFLIP: "
      "FLIP with the affine part; damps less. PIC: interpolates the velocity; "
      "damps most.");
    add_parameter("FLIP part",
                  part,
                  "FLIP part of the new velocity for FLIP and AFLIP [-], 0 to "
                  "1; the remainder is interpolated, which damps.",
                  prm,
                  Patterns::Double(0., 1.));
  }

  Tensor<2, dim>
  affine_velocity(const Tensor<2, dim> &B,
                  const Tensor<2, dim> &D,
                  const Tensor<2, dim> &gradient,
                  const double          size)
  {
    Tensor<2, dim> C;
    for (const auto &[moment, e] :
         eigenvectors(SymmetricTensor<2, dim>(symmetrize(D))))
      C += outer_product(moment > vanishing_moment * size * size
                           ? Tensor<1, dim>(B * e / moment)
                           : Tensor<1, dim>(gradient * e),
                         e);
    return C;
  }
} // namespace geocone::GEOCONE_DIM
