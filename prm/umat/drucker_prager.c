/* Copyright (C) 2026 by the geocone authors
 * SPDX-License-Identifier: LGPL-2.1-or-later
 *
 * A UMAT in C: the cone of Drucker and Prager that has the strength of Mohr-Coulomb's
 * pyramid in triaxial compression, without hardening.
 *
 *   PROPS  = E (Pa), nu, c (Pa), phi (degrees), theta (degrees, dilatancy)
 *   STATEV = the integral of the norm of the plastic strain
 *
 *   cc -O2 -shared -fPIC -o drucker_prager.so drucker_prager.c -lm
 */
#include <math.h>

void
umat_(double *stress, double *statev, double *ddsdde, double *sse, double *spd,
      double *scd, double *rpl, double *ddsddt, double *drplde, double *drpldt,
      const double *stran, const double *dstran, const double *time,
      const double *dtime, const double *temp, const double *dtemp,
      const double *predef, const double *dpred, const char *cmname,
      const int *ndi, const int *nshr, const int *ntens, const int *nstatv,
      const double *props, const int *nprops)
{
  const int    n       = *ntens;
  const double degree  = acos(-1.) / 180.;
  const double lambda  = props[0] * props[1] / ((1. + props[1]) * (1. - 2. * props[1]));
  const double two_G   = props[0] / (1. + props[1]);
  const double three_K = 3. * lambda + two_G;
  const double phi = props[3] * degree, theta = props[4] * degree;
  /* |dev s| <= k - a tr(s)/sqrt(3); b has the dilatancy. */
  const double a = 2. * sqrt(2.) * sin(phi) / (3. - sin(phi));
  const double b = 2. * sqrt(2.) * sin(theta) / (3. - sin(theta));
  const double k = sqrt(2.) * 6. / (sqrt(3.) * (3. - sin(phi))) * props[2] * cos(phi);
  int          i, j;

  const double volume = dstran[0] + dstran[1] + dstran[2];
  for (i = 0; i < n; ++i)
    stress[i] += i < 3 ? lambda * volume + two_G * dstran[i] : two_G / 2. * dstran[i];

  const double mean = (stress[0] + stress[1] + stress[2]) / 3.;
  double       t[6], square = 0.;
  for (i = 0; i < n; ++i)
    {
      t[i] = stress[i] - (i < 3 ? mean : 0.);
      square += (i < 3 ? 1. : 2.) * t[i] * t[i];
    }
  const double length = sqrt(square);
  const double f      = length + a * sqrt(3.) * mean - k;

  for (i = 0; i < n; ++i)
    for (j = 0; j < n; ++j)
      ddsdde[i + n * j] = (i < 3 && j < 3 ? lambda : 0.) +
                          (i == j ? (i < 3 ? two_G : two_G / 2.) : 0.);
  if (f <= 0.)
    return;

  const double hard  = two_G + three_K * a * b;
  const double gamma = f / hard;
  if (length < two_G * gamma) /* the apex */
    {
      const double apex = k / (a * sqrt(3.));
      const double opening = sqrt(3.) * (mean - apex) / three_K;
      for (i = 0; i < n; ++i)
        stress[i] = i < 3 ? apex : 0.;
      for (i = 0; i < n * n; ++i)
        ddsdde[i] = 0.;
      statev[0] += sqrt(opening * opening + square / (two_G * two_G));
      return;
    }

  /* The tangent of the return map, D - D m (D n)'/hard less the turn of the direction. */
  const double turn = two_G * gamma / length;
  for (i = 0; i < n; ++i)
    for (j = 0; j < n; ++j)
      {
        const double Dm = two_G * t[i] / length + (i < 3 ? three_K * b / sqrt(3.) : 0.);
        const double Dn = two_G * t[j] / length + (j < 3 ? three_K * a / sqrt(3.) : 0.);
        const double dev = (i == j ? (i < 3 ? 1. : 0.5) : 0.) - (i < 3 && j < 3 ? 1. / 3. : 0.);
        ddsdde[i + n * j] -= Dm * Dn / hard +
                             turn * two_G * (dev - t[i] * t[j] / square);
      }
  for (i = 0; i < n; ++i)
    stress[i] -= gamma * (two_G * t[i] / length + (i < 3 ? three_K * b / sqrt(3.) : 0.));
  statev[0] += gamma * sqrt(1. + b * b);
}
