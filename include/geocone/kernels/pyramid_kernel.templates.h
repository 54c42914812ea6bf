// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_kernels_pyramid_kernel_templates_h
#define geocone_kernels_pyramid_kernel_templates_h

#include <geocone/kernels/pyramid_body.h>
#include <geocone/kernels/pyramid_kernel.h>
#include <geocone/kernels/simd.h>
#include <geocone/kernels/spin.h>

namespace geocone::GEOCONE_DIM
{
  /** Principal values of a symmetric tensor in decreasing order, with the
   *  principal directions n. In two dimensions the components of the dyads n n
   *  are stored, in three dimensions the components of n. */
  template <typename P>
  class PrincipalAxes
  {
  public:
    /** Computes the principal axes of a symmetric tensor from its components in
     *  the order of tensor_component. */
    explicit PrincipalAxes(const std::array<P, n_spatial> &s)
    {
      if constexpr (dim == 2)
        find_in_plane(s);
      else
        find_by_rotations(s);
      sort(0, 1);
      sort(1, 2);
      sort(0, 1);
    }

    /** Tensor with the principal values y and the stored principal
     *  directions. */
    std::array<P, n_spatial>
    tensor(const P (&y)[3]) const
    {
      std::array<P, n_spatial> s;
      if constexpr (dim == 2)
        for (int i = 0; i < n_spatial; ++i)
          s[i] = y[0] * axis[0][i] + y[1] * axis[1][i] + y[2] * axis[2][i];
      else
        for (int i = 0; i < 3; ++i)
          for (int j = i; j < 3; ++j)
            s[index_of_component[i][j]] = y[0] * axis[0][i] * axis[0][j] +
                                          y[1] * axis[1][i] * axis[1][j] +
                                          y[2] * axis[2][i] * axis[2][j];
      return s;
    }

    P value[3];

  private:
    static constexpr int n_axis = dim == 2 ? n_spatial : 3;

    P axis[3][n_axis];

    /** Computes the principal axes in plane strain, where the z axis is a
     *  principal axis. */
    void
    find_in_plane(const std::array<P, n_spatial> &s)
    {
      const P half(0.5), zero(0.), one(1.);
      const P mean = half * (s[0] + s[1]), difference = half * (s[0] - s[1]);
      const P radius = sqrt(difference * difference + s[2] * s[2]);
      // If both values are equal, any axes are principal.
      const P per_radius = one / max(radius, P(1e-300));
      const P cos2 = where_greater(radius, zero, difference * per_radius, one);
      const P sin2 = s[2] * per_radius;
      value[0]     = mean + radius;
      value[1]     = mean - radius;
      value[2]     = s[3];
      for (int i = 0; i < 2; ++i)
        {
          const P sign(i == 0 ? 0.5 : -0.5);
          axis[i][0] = half + sign * cos2;
          axis[i][1] = half - sign * cos2;
          axis[i][2] = sign * sin2;
          axis[i][3] = zero;
          axis[2][i] = zero;
        }
      axis[2][2] = zero;
      axis[2][3] = one;
    }

    /** Computes the principal axes by Jacobi rotations. Each rotation
     *  annihilates one off-diagonal component. */
    void
    find_by_rotations(const std::array<P, n_spatial> &s)
    {
      // The shear component between the two other directions.
      P off[3], size(0.);
      for (int i = 0; i < 3; ++i)
        {
          const int j = (i + 1) % 3, k = (i + 2) % 3;
          value[i] = s[index_of_normal[i]];
          off[i]   = s[index_of_component[j][k]];
          size += value[i] * value[i] + off[i] * off[i];
          for (int d = 0; d < 3; ++d)
            axis[i][d] = P(d == i ? 1. : 0.);
        }
      // Squares below rounding; four or five sweeps suffice.
      const P    negligible = P(1e-33) * size;
      const auto is_done    = [&] {
        const P left = off[0] * off[0] + off[1] * off[1] + off[2] * off[2];
        return all_between(left, P(0.), negligible);
      };
      for (int sweep = 0; sweep < 10 && !is_done(); ++sweep)
        for (int k = 0; k < 3; ++k)
          rotate((k + 1) % 3, (k + 2) % 3, k, off);
    }

    /** Rotates axes i and j about axis k so that the off-diagonal component
     *  off[k] vanishes. */
    void
    rotate(const int i, const int j, const int k, P (&off)[3])
    {
      const P zero(0.), one(1.);
      const P apart = value[j] - value[i], twice = off[k] + off[k];
      // Tangent of the smaller of the two angles.
      const P t =
        where_greater(zero, apart, zero - twice, twice) /
        max(abs(apart) + sqrt(apart * apart + twice * twice), P(1e-300));
      const P c = one / sqrt(one + t * t), sine = t * c;
      value[i] = value[i] - t * off[k];
      value[j] = value[j] + t * off[k];
      off[k]   = zero;
      // The component of i and k is stored at j, that of j and k at i.
      turn(c, sine, off[j], off[i]);
      for (int d = 0; d < 3; ++d)
        turn(c, sine, axis[i][d], axis[j][d]);
    }

    static void
    turn(const P &c, const P &sine, P &a, P &b)
    {
      const P turned = c * a - sine * b;
      b              = sine * a + c * b;
      a              = turned;
    }

    void
    sort(const int i, const int j)
    {
      const P a = value[i], b = value[j];
      value[i] = max(a, b);
      value[j] = min(a, b);
      for (int d = 0; d < n_axis; ++d)
        {
          const P p = axis[i][d], q = axis[j][d];
          axis[i][d] = where_greater(b, a, q, p);
          axis[j][d] = where_greater(b, a, p, q);
        }
    }
  };

  /** Rotated stresses and strain increments of a group of points (SIMD lanes).
   *  The stresses are rotated by the spin increment; the shear strains are
   *  engineering strains, gamma_ij = 2 e_ij. */
  template <typename P>
  struct TurnedTensors
  {
    std::array<P, n_spatial> s, strain;

    /** Reads the stresses and strain increments of consecutive points from a
     *  block, starting at point p. @param nu Poisson ratio, for s_zz in plane
     *  strain (see Material) */
    TurnedTensors(const PointBlock &block, const unsigned int p, const P &nu)
    {
      std::array<P, dim * dim> l;
      for (unsigned int i = 0; i < dim * dim; ++i)
        l[i] = P::load(block.l[i] + p);
      std::array<P, n_mandel> moved;
      for (int i = 0; i < n_mandel; ++i)
        moved[i] = P::load(block.s[i] + p);
      if constexpr (dim == 2)
        {
          s[3] = nu * (moved[0] + moved[1]) + P::load(block.history[0] + p);
          strain[3] = block.l_zz != nullptr ? P::load(block.l_zz + p) : P(0.);
          PlaneSpin<P>(l).turn(moved);
        }
      else
        SpatialSpin<P>(l).turn(moved);
      for (int i = 0; i < n_mandel; ++i)
        s[i] = moved[i];
      for (unsigned int d = 0; d < dim; ++d)
        strain[index_of_normal[d]] = l[(dim + 1) * d];
      for (int i = 0; i < n_shears; ++i)
        {
          const auto [place, a, b] = shears[i];
          strain[place]            = l[dim * a + b] + l[dim * b + a];
        }
    }
  };

  /** Stress update of a group of points (SIMD lanes) by the pyramid. */
  template <typename P>
  class PyramidUpdate
  {
  public:
    using T = std::array<P, n_spatial>;

    PyramidUpdate(const PyramidConstants &pyramid, const PointBlock &block)
      : pyramid(pyramid)
      , block(block)
      , memory(history(pyramid.memory))
      , growth(history(pyramid.growth))
      , lambda(pyramid.lambda)
      , two_G(pyramid.two_G)
      , nu(pyramid.lambda / (2. * pyramid.lambda + pyramid.two_G))
      , wave_modulus(pyramid.lambda + pyramid.two_G)
      , apex(apex_of_size(pyramid.sine))
      , exact_apex(apex_of_size(pyramid.sine + pyramid.delayed_sine))
      , returns(pyramid.sine, pyramid.flow, pyramid.lambda, pyramid.two_G)
    {}

    /** Updates the points from p on. */
    void
    operator()(const unsigned int p) const
    {
      const P half(0.5);
      const auto [s, strain] = TurnedTensors<P>(block, p, nu);
      const P pressed        = lambda * (strain[0] + strain[1] + strain[3]);
      T       trial;
      for (int i = 0; i < n_spatial; ++i)
        trial[i] = s[i] + (is_shear(i) ? half * (two_G * strain[i])
                                       : pressed + two_G * strain[i]);
      const P size = strength(p);
      T       end  = trial;
      if (memory != nullptr || !inside_inscribed_cone(trial, size))
        return_to_pyramid(p, size, trial, end);

      P work(0.);
      for (int i = 0; i < n_spatial; ++i)
        work += (s[i] + end[i]) * strain[i];
      for (int i = 0; i < n_mandel; ++i)
        end[i].store(block.s[i] + p);
      if constexpr (dim == 2)
        (end[3] - nu * (end[0] + end[1])).store(block.history[0] + p);
      (half * work).store(block.work + p);
      wave_modulus.store(block.wave_modulus + p);
    }

  private:
    double *
    history(const unsigned int place) const
    {
      return place == PyramidConstants::no_place ? nullptr
                                                 : block.history[place];
    }

    /** Apex stress of a pyramid, per size. */
    static P
    apex_of_size(const double sine)
    {
      return sine > 0. ? P(0.5 / sine) : P(1e100);
    }

    /** Size of the pyramid of each point. */
    P
    strength(const unsigned int p) const
    {
      P size(pyramid.size);
      if (growth != nullptr)
        size += P(pyramid.size_per_cohesion) * P::load(growth + p);
      if (memory != nullptr)
        size = size - P(2. * pyramid.delayed_sine) *
                        min(P(0.) - P::load(memory + p), exact_apex * size);
      return size;
    }

    /** Whether all points are in the cone inscribed in the pyramid, and so elastic. */
    bool
    inside_inscribed_cone(const T &trial, const P &size) const
    {
      const P mean = P(1. / 3.) * (trial[0] + trial[1] + trial[3]);
      P       squares(0.);
      for (int i = 0; i < n_spatial; ++i)
        {
          const P d = is_shear(i) ? trial[i] : trial[i] - mean;
          squares += is_shear(i) ? P(2.) * d * d : d * d;
        }
      const P room = size - P(2. * pyramid.sine) * mean;
      const P round(2. * (1. + pyramid.sine * pyramid.sine / 3.));
      return room.least() > 0. && (room * room - round * squares).least() >= 0.;
    }

    /** Maps trial stresses back to the pyramid, with plastic strain and memory. */
    void
    return_to_pyramid(const unsigned int p,
                      const P           &size,
                      const T           &trial,
                      T                 &end) const
    {
      const P                zero(0.);
      const PrincipalAxes<P> axes(trial);
      const P                f = returns.yield_function(axes.value, 0, 2, size);
      P                      values[3];
      returns(axes.value, f, size, apex * size, values);
      const T back = axes.tensor(values);
      for (int i = 0; i < n_spatial; ++i)
        end[i] = where_greater(f, zero, back[i], trial[i]);
      P change[3], sum(0.);
      for (int i = 0; i < 3; ++i)
        {
          values[i] = where_greater(f, zero, values[i], axes.value[i]);
          change[i] = axes.value[i] - values[i];
          sum += change[i];
        }
      const P per_G2(1. / pyramid.two_G);
      const P bulk(pyramid.lambda /
                   (pyramid.two_G * (3. * pyramid.lambda + pyramid.two_G)));
      P       plastic(0.);
      for (int i = 0; i < 3; ++i)
        {
          const P e = per_G2 * change[i] - bulk * sum;
          plastic += e * e;
        }
      (P::load(block.plastic_strain + p) + sqrt(plastic))
        .store(block.plastic_strain + p);
      if (memory != nullptr)
        (P(pyramid.memory_factor) * P::load(memory + p) -
         P(0.5 * (1. - pyramid.memory_factor)) * (values[0] + values[2]))
          .store(memory + p);
    }

    const PyramidConstants &pyramid;
    const PointBlock       &block;
    double *const memory, *const growth;
    const P                lambda, two_G, nu, wave_modulus, apex, exact_apex;
    const PyramidReturn<P> returns;
  };

  /** Implements advance_pyramid() for one SIMD instruction set. */
  template <typename Arch>
  void
  advance_pyramid_block(const PyramidConstants &pyramid,
                        const PointBlock       &block)
  {
    const PyramidUpdate<Pack<Arch>> update(pyramid, block);
    for (unsigned int p = 0; p < block.n_points; p += PointBlock::lanes)
      update(p);
  }
} // namespace geocone::GEOCONE_DIM

#endif
