// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_materials_umat_library_h
#define geocone_materials_umat_library_h

#include <cstddef>
#include <string>

namespace geocone
{
  /** The subroutine UMAT of Abaqus/Standard as gfortran calls it: all arguments
   *  by reference, and the length of CMNAME at the end. */
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

  /** Option of the command line without which no library is loaded. */
  constexpr const char *option_for_libraries = "--load-library";

  /** Whether the command line of this process allows libraries, which can
   *  execute any code, to be loaded. */
  bool &
  may_load_libraries();

  /**
   * Loads a shared object, which remains loaded until the process ends, and
   * finds a function in it.
   * @param path of the file
   * @param function its name, or in Fortran the name without the underscore
   * @param parameters section of the parameters, for messages
   * @throws InputError if it cannot be loaded or has no such function
   */
  UmatFunction
  load_umat(const std::string &path,
            const std::string &function,
            const std::string &parameters);
} // namespace geocone

#endif
