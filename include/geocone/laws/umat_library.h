// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_laws_umat_library_h
#define geocone_laws_umat_library_h

#include <cstddef>
#include <string>

namespace geocone
{
  /** Signature of the Abaqus/Standard subroutine UMAT as compiled by gfortran.
   *  All arguments are passed by reference; the length of CMNAME is the last
   *  argument. */
  using UmatFunction = void (*)(double       *stress,
                                double       *statev,
                                double       *ddsdde,
                                double       *sse,
                                double       *spd,
                                double       *scd,
                                double       *rpl,
                                double       *ddsddt,
                                double       *drplde,
                                double       *drpldt,
                                const double *stran,
                                const double *dstran,
                                const double *time,
                                const double *dtime,
                                const double *temp,
                                const double *dtemp,
                                const double *predef,
                                const double *dpred,
                                const char   *cmname,
                                const int    *ndi,
                                const int    *nshr,
                                const int    *ntens,
                                const int    *nstatv,
                                const double *props,
                                const int    *nprops,
                                const double *coords,
                                const double *drot,
                                double       *pnewdt,
                                const double *celent,
                                const double *dfgrd0,
                                const double *dfgrd1,
                                const int    *noel,
                                const int    *npt,
                                const int    *layer,
                                const int    *kspt,
                                const int    *jstep,
                                const int    *kinc,
                                std::size_t   length_of_cmname);

  /** Command-line option that allows shared libraries to be loaded. */
  constexpr const char *option_for_libraries = "--load-library";

  /** True if the command line allows shared libraries to be loaded; false by
   *  default. A shared library can execute any code. */
  bool &
  may_load_libraries();

  /**
   * Loads a shared library and returns one of its functions. The library
   * remains loaded until the process ends.
   * @param path of the shared library
   * @param function name of the function; in Fortran without the underscore
   * @param parameters section of the parameters, for messages
   * @throws InputError if the library cannot be loaded or lacks the function
   */
  UmatFunction
  load_umat(const std::string &path,
            const std::string &function,
            const std::string &parameters);
} // namespace geocone

#endif
