// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/space/space.h>

#include <deal.II/base/config.h>

#include <deal.II/fe/fe_simplex_p.h>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    using Polynomial = BarycentricPolynomial<2>;

    /**
     * Cubic Lagrange functions of the triangle in barycentric coordinates l_i,
     * in the order vertices, edges (0,1), (1,2), (2,0) with the node nearer to
     * the edge's first vertex first, centre:
     *   l_i (3 l_i - 1)(3 l_i - 2)/2,  9/2 l_i l_j (3 l_i - 1),  27 l_0 l_1 l_2.
     */
    BarycentricPolynomials<2>
    cubic_polynomials()
    {
      const Polynomial        l[3] = {Polynomial::monomial(0),
                                      Polynomial::monomial(1),
                                      Polynomial::monomial(2)};
      std::vector<Polynomial> polynomials;
      for (const Polynomial &li : l)
        polynomials.push_back(0.5 * li * (3. * li - 1.) * (3. * li - 2.));
      for (unsigned int edge = 0; edge < 3; ++edge)
        {
          const Polynomial &a = l[edge], &b = l[(edge + 1) % 3];
          polynomials.push_back(4.5 * a * b * (3. * a - 1.));
          polynomials.push_back(4.5 * a * b * (3. * b - 1.));
        }
      polynomials.push_back(27. * l[0] * l[1] * l[2]);
      return BarycentricPolynomials<2>(polynomials);
    }

    std::vector<Point<2>>
    cubic_support_points()
    {
      const Point<2>        v[3] = {{0., 0.}, {1., 0.}, {0., 1.}};
      std::vector<Point<2>> points(v, v + 3);
      for (unsigned int edge = 0; edge < 3; ++edge)
        {
          const Point<2> &a = v[edge], &b = v[(edge + 1) % 3];
          points.push_back(a + (b - a) / 3.);
          points.push_back(a + 2. * (b - a) / 3.);
        }
      points.emplace_back(1. / 3., 1. / 3.);
      return points;
    }

    /**
     * Only its dof layout and its functions on the reference cell are used;
     * Space::cell_nodes() orders the edge nodes.
     */
    class CubicSimplex : public FE_SimplexPoly<2>
    {
    public:
      CubicSimplex()
        : FE_SimplexPoly<2>(cubic_polynomials(),
                            FiniteElementData<2>({1, 2, 1},
                                                 ReferenceCells::Triangle,
                                                 1,
                                                 3,
                                                 FiniteElementData<2>::H1),
#if DEAL_II_VERSION_GTE(9, 6, 0)
                            false, // prolongation is not additive
#endif
                            cubic_support_points(),
                            {{{Point<1>(0.),
                               Point<1>(1.),
                               Point<1>(1. / 3.),
                               Point<1>(2. / 3.)},
                              {Point<1>(0.),
                               Point<1>(1.),
                               Point<1>(1. / 3.),
                               Point<1>(2. / 3.)},
                              {Point<1>(0.),
                               Point<1>(1.),
                               Point<1>(1. / 3.),
                               Point<1>(2. / 3.)}}},
                            FullMatrix<double>())
      {}

      std::unique_ptr<FiniteElement<2>>
      clone() const override
      {
        return std::make_unique<CubicSimplex>(*this);
      }

      std::string
      get_name() const override
      {
        return "CubicSimplex";
      }
    };
  } // namespace

  std::unique_ptr<FiniteElement<dim>>
  make_cubic_simplex()
  {
    return std::make_unique<CubicSimplex>();
  }
} // namespace geocone::GEOCONE_DIM
