// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_points_particle_transfer_h
#define geocone_points_particle_transfer_h

#include <geocone/base/choice.h>
#include <geocone/base/types.h>

#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/base/tensor.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * Rule for the transfer of velocities from the nodes to the particles:
   *   v_p := alpha (v_p + sum_i N_i (v_i - vL_i)) + (1 - alpha) sum_i N_i v_i,
   * and, for affine rules, C of the velocity field v_p + C (x - x_p) by which
   * the particles transfer momentum to the nodes (affine_velocity()).
   */
  struct TransferRule
  {
    bool is_affine;
    bool flips; ///< alpha is 'FLIP part'; otherwise 0
  };

  /**
   * Transfer of velocities from the nodes to the particles, in implicit and
   * explicit steps: parameters of "Material point method". A new rule is an
   * entry in the list of rules.
   */
  class ParticleTransfer : public dealii::ParameterAcceptor
  {
  public:
    ParticleTransfer();

    /** Whether particles have an affine velocity field, v + C (x - x_p). */
    bool
    is_affine() const
    {
      return present().is_affine;
    }

    /** Weight alpha of the FLIP velocity v_p + dv of a particle; the
     *  interpolated (PIC) velocity has the weight 1 - alpha. */
    double
    flip_part() const
    {
      return present().flips ? part : 0.;
    }

    /** Name of the transfer rule in the parameter file. */
    std::string
    name() const
    {
      return rule.word();
    }

    /** Name of the parameter "Material point method/Transfer", for messages. */
    static const char *const parameter;

  private:
    const TransferRule &
    present() const
    {
      return *static_cast<const TransferRule *>(rule);
    }

    static constexpr TransferRule flip  = {false, true};
    static constexpr TransferRule apic  = {true, false};
    static constexpr TransferRule aflip = {true, true};
    static constexpr TransferRule pic   = {false, false};

    Choice<const TransferRule *> rule = {
      {{"FLIP", &flip}, {"APIC", &apic}, {"AFLIP", &aflip}, {"PIC", &pic}}};

    double part = 1.;
  };

  /**
   * Velocity gradient C of a particle in affine rules (APIC), from the moments
   * of its nodes,
   *   B = sum_i N_i v_i r_i',  D = sum_i N_i r_i r_i',  r_i = x_i - x_p:
   * C e = B e/d for the eigenvectors e of D with the eigenvalues d. On a side
   * of the mesh only the functions of the side are non-zero: in its normal
   * direction, where d vanishes, the limit is the gradient.
   * @param gradient sum_i v_i (grad N_i)'
   * @param size of the cell (m), for comparison with sqrt(d)
   */
  dealii::Tensor<2, dim>
  affine_velocity(const dealii::Tensor<2, dim> &B,
                  const dealii::Tensor<2, dim> &D,
                  const dealii::Tensor<2, dim> &gradient,
                  const double                  size);

  /** Tolerance of d/size^2 below which an eigenvalue d is treated as zero in
   *  affine_velocity(). */
  constexpr double vanishing_moment = 1e-10;
} // namespace geocone::GEOCONE_DIM

#endif
