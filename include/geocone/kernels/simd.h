// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_kernels_simd_h
#define geocone_kernels_simd_h

#include <xsimd/xsimd.hpp>

namespace geocone
{
  /** Baseline SIMD instruction set, available on all supported processors. */
#if XSIMD_WITH_SSE2
  using BaselineArch = xsimd::sse2;
#else
  using BaselineArch = xsimd::default_arch;
#endif

  /**
   * SIMD vector of four doubles: one register of four or two registers of two,
   * depending on the instruction set @p Arch. Kernels that use it are templates
   * over @p Arch, compiled once for each instruction set, so that the linker
   * cannot mix functions of different instruction sets.
   */
  template <typename Arch>
  class Pack
  {
  public:
    using Batch                   = xsimd::batch<double, Arch>;
    static constexpr int n_parts  = 4 / static_cast<int>(Batch::size);
    static constexpr int per_part = static_cast<int>(Batch::size);
    static_assert(n_parts * per_part == 4, "registers of 2 or 4 doubles");

    Batch part[n_parts];

    Pack() = default;

    Pack(const double value)
    {
      for (int k = 0; k < n_parts; ++k)
        part[k] = Batch(value);
    }

    static Pack
    load(const double *values)
    {
      Pack p;
      for (int k = 0; k < n_parts; ++k)
        p.part[k] = Batch::load_unaligned(values + k * per_part);
      return p;
    }

    void
    store(double *values) const
    {
      for (int k = 0; k < n_parts; ++k)
        part[k].store_unaligned(values + k * per_part);
    }

#define GEOCONE_PACK_OPERATOR(op)                       \
  friend Pack operator op(const Pack &a, const Pack &b) \
  {                                                     \
    Pack p;                                             \
    for (int k = 0; k < n_parts; ++k)                   \
      p.part[k] = a.part[k] op b.part[k];               \
    return p;                                           \
  }
    GEOCONE_PACK_OPERATOR(+)
    GEOCONE_PACK_OPERATOR(-)
    GEOCONE_PACK_OPERATOR(*)
    GEOCONE_PACK_OPERATOR(/)
#undef GEOCONE_PACK_OPERATOR

    Pack &
    operator+=(const Pack &b)
    {
      return *this = *this + b;
    }
    Pack &
    operator*=(const Pack &b)
    {
      return *this = *this * b;
    }

    friend Pack
    max(const Pack &a, const Pack &b)
    {
      Pack p;
      for (int k = 0; k < n_parts; ++k)
        p.part[k] = xsimd::max(a.part[k], b.part[k]);
      return p;
    }
    friend Pack
    min(const Pack &a, const Pack &b)
    {
      Pack p;
      for (int k = 0; k < n_parts; ++k)
        p.part[k] = xsimd::min(a.part[k], b.part[k]);
      return p;
    }
    friend Pack
    abs(const Pack &a)
    {
      return max(a, Pack(0.) - a);
    }
#define GEOCONE_PACK_FUNCTION(name)       \
  friend Pack name(const Pack &a)         \
  {                                       \
    Pack p;                               \
    for (int k = 0; k < n_parts; ++k)     \
      p.part[k] = xsimd::name(a.part[k]); \
    return p;                             \
  }
    GEOCONE_PACK_FUNCTION(sqrt)
    GEOCONE_PACK_FUNCTION(log)
    GEOCONE_PACK_FUNCTION(expm1)
    GEOCONE_PACK_FUNCTION(cos)
    GEOCONE_PACK_FUNCTION(acos)
#undef GEOCONE_PACK_FUNCTION

    /** Component-wise selection: a > b ? yes : no. */
    friend Pack
    where_greater(const Pack &a, const Pack &b, const Pack &yes, const Pack &no)
    {
      Pack p;
      for (int k = 0; k < n_parts; ++k)
        p.part[k] =
          xsimd::select(a.part[k] > b.part[k], yes.part[k], no.part[k]);
      return p;
    }

    /** Returns true if a > b in at least one component. */
    friend bool
    any_greater(const Pack &a, const Pack &b)
    {
      bool any = false;
      for (int k = 0; k < n_parts; ++k)
        any = any || xsimd::any(a.part[k] > b.part[k]);
      return any;
    }

    /** Returns true if lower <= a <= upper in all components. */
    friend bool
    all_between(const Pack &a, const Pack &lower, const Pack &upper)
    {
      bool all = true;
      for (int k = 0; k < n_parts; ++k)
        all = all && xsimd::all((lower.part[k] <= a.part[k]) &
                                (a.part[k] <= upper.part[k]));
      return all;
    }

    /** Integer parts of vector components between 0 and 2^31 - 1. They are
     *  returned as doubles and stored as integers in @p integers. */
    friend Pack
    whole_part(const Pack &a, int *integers)
    {
      Pack p;
#ifdef __AVX2__
      if constexpr (n_parts == 1)
        {
          const __m128i whole = _mm256_cvttpd_epi32(a.part[0]);
          _mm_storeu_si128(reinterpret_cast<__m128i *>(integers), whole);
          p.part[0] = _mm256_cvtepi32_pd(whole);
          return p;
        }
#endif
      double v[4];
      a.store(v);
      for (int k = 0; k < 4; ++k)
        {
          integers[k] = static_cast<int>(v[k]);
          v[k]        = integers[k];
        }
      p = load(v);
      return p;
    }

    double
    sum() const
    {
      double v[4];
      store(v);
      return (v[0] + v[1]) + (v[2] + v[3]);
    }
    double
    largest() const
    {
      double v[4];
      store(v);
      const double a = v[0] > v[1] ? v[0] : v[1];
      const double b = v[2] > v[3] ? v[2] : v[3];
      return a > b ? a : b;
    }
    double
    least() const
    {
      return -(Pack(0.) - *this).largest();
    }
  };

  /** Transposes the 4 x 4 matrix with rows a, b, c, d in place. */
  template <typename Arch>
  inline void
  transpose(Pack<Arch> &a, Pack<Arch> &b, Pack<Arch> &c, Pack<Arch> &d)
  {
#ifdef __AVX2__
    if constexpr (Pack<Arch>::n_parts == 1)
      {
        const __m256d ab_02 = _mm256_unpacklo_pd(a.part[0], b.part[0]);
        const __m256d ab_13 = _mm256_unpackhi_pd(a.part[0], b.part[0]);
        const __m256d cd_02 = _mm256_unpacklo_pd(c.part[0], d.part[0]);
        const __m256d cd_13 = _mm256_unpackhi_pd(c.part[0], d.part[0]);
        a.part[0]           = _mm256_permute2f128_pd(ab_02, cd_02, 0x20);
        b.part[0]           = _mm256_permute2f128_pd(ab_13, cd_13, 0x20);
        c.part[0]           = _mm256_permute2f128_pd(ab_02, cd_02, 0x31);
        d.part[0]           = _mm256_permute2f128_pd(ab_13, cd_13, 0x31);
        return;
      }
#endif
    if constexpr (Pack<Arch>::n_parts == 2)
      {
        using Batch      = typename Pack<Arch>::Batch;
        const Batch ab_0 = xsimd::zip_lo(a.part[0], b.part[0]);
        const Batch ab_1 = xsimd::zip_hi(a.part[0], b.part[0]);
        const Batch ab_2 = xsimd::zip_lo(a.part[1], b.part[1]);
        const Batch ab_3 = xsimd::zip_hi(a.part[1], b.part[1]);
        const Batch cd_0 = xsimd::zip_lo(c.part[0], d.part[0]);
        const Batch cd_1 = xsimd::zip_hi(c.part[0], d.part[0]);
        const Batch cd_2 = xsimd::zip_lo(c.part[1], d.part[1]);
        const Batch cd_3 = xsimd::zip_hi(c.part[1], d.part[1]);
        a.part[0] = ab_0, a.part[1] = cd_0;
        b.part[0] = ab_1, b.part[1] = cd_1;
        c.part[0] = ab_2, c.part[1] = cd_2;
        d.part[0] = ab_3, d.part[1] = cd_3;
      }
    else
      {
        double m[4][4];
        a.store(m[0]), b.store(m[1]), c.store(m[2]), d.store(m[3]);
        for (int i = 0; i < 4; ++i)
          for (int j = i + 1; j < 4; ++j)
            {
              const double carried = m[i][j];
              m[i][j]              = m[j][i];
              m[j][i]              = carried;
            }
        a = Pack<Arch>::load(m[0]), b = Pack<Arch>::load(m[1]);
        c = Pack<Arch>::load(m[2]), d = Pack<Arch>::load(m[3]);
      }
  }
} // namespace geocone

#endif
