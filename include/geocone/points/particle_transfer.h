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
   * Transfer rule for velocities from the nodes to the particles, such as FLIP
   * or APIC. With the FLIP weight alpha, the velocity v_p of a particle becomes
   *   v_p := alpha (v_p + sum_i N_i (v_i - vL_i)) + (1 - alpha) sum_i N_i v_i.
   * Affine rules also update the gradient C of the velocity field v_p + C (x -
   * x_p), by which the particles transfer momentum to the nodes
   * (affine_velocity()).
   */
  struct TransferRule
  {
    bool is_affine;
    bool flips; ///< alpha is 'FLIP part'; otherwise 0
  };

  /**
   * Parameters of the velocity transfer from the nodes to the particles
   * (section "Material point method"), for implicit and explicit steps. A new
   * rule is an entry in the list of rules.
   */
  class ParticleTransfer : public dealii::ParameterAcceptor
  {
  public:
    ParticleTransfer();

    /** Returns true if particles have an affine velocity field v + C (x -
     *  x_p). */
    bool
    is_affine() const
    {
      return present().is_affine;
    }

    /** Weight alpha of the FLIP velocity v_p + dv of a particle. The
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

    /** Name of the parameter "Material point method/Transfer", for error
     *  messages. */
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
   * Velocity gradient C of a particle in affine transfer schemes (APIC). With
   * the moments of the nodes
   *   B = sum_i N_i v_i r_i',  D = sum_i N_i r_i r_i',  r_i = x_i - x_p,
   * C e = B e/d for each eigenvector e of D with the eigenvalue d. On a side of
   * the mesh only the shape functions of the side are nonzero, and d vanishes
   * in the normal direction. The limit of C e is then the gradient of the
   * interpolated velocity.
   * @param B first moment of the nodal velocities
   * @param D second moment of the nodes
   * @param gradient sum_i v_i (grad N_i)'
   * @param size of the cell (m), for comparison with sqrt(d)
   */
  dealii::Tensor<2, dim>
  affine_velocity(const dealii::Tensor<2, dim> &B,
                  const dealii::Tensor<2, dim> &D,
                  const dealii::Tensor<2, dim> &gradient,
                  const double                  size);

  /** Threshold of the ratio d/size^2 below which affine_velocity() treats an
   *  eigenvalue d of the second moment as zero. */
  constexpr double vanishing_moment = 1e-10;
} // namespace geocone::GEOCONE_DIM

#endif
