// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_laws_umat_h
#define geocone_laws_umat_h

#include <geocone/laws/spatial_law.h>
#include <geocone/laws/umat_library.h>

#include <array>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Components of a tensor in the order of a UMAT: xx, yy, zz, xy, xz, yz. */
  using UmatComponents = std::array<double, n_spatial>;
  /** Derivatives of these components, column by column. */
  using UmatTangent = std::array<double, n_spatial * n_spatial>;

  /**
   * User-defined constitutive law for small strains, from a shared library with
   * the UMAT interface of Abaqus/Standard. Stress has four components xx, yy,
   * zz, xy in plane strain and axisymmetry, and six, xx, yy, zz, xy, xz, yz, in
   * three dimensions; tension is positive, and shear strains are engineering
   * strains.
   *
   * Young's modulus and Poisson's ratio are used for the initial guess of a
   * step, wave speeds, energies and the output of plastic strain, not for the
   * stress.
   *
   * The history variables are those of Material, the state variables, the total
   * strain (components in the order of Mandel vectors), half of the axial
   * vector of the spin increment (explicit steps only), the time (s) and the
   * size of the cell (m). If the function requests a smaller step (PNEWDT < 1),
   * the stress is set to NaN, and the step fails.
   */
  class Umat : public SpatialLaw
  {
  public:
    explicit Umat(const std::string &section);

    /** Sets the base folder for a relative path of the shared library. */
    void
    set_folder(const std::string &folder)
    {
      folder_of_parameters = folder;
    }

    /** Loads the shared library of the user-defined law. @throws InputError if
     *  the command line does not allow it */
    void
    prepare() override;

    /** Explicit stress update; the total strain is rotated together with the
     *  stress. */
    void
    advance(const PointBlock &block, LawCounts &counts) const override;

    unsigned int
    n_history() const override
    {
      return index_of_size() + 1;
    }

    std::string
    initialise(const Stress &stress,
               const double  size,
               double       *history) const override;

    double
    size(const double *history) const override
    {
      return history[index_of_size()];
    }

    std::vector<OutputQuantity>
    output_quantities() const override;

    void
    output(const Components &stress,
           const double     *history,
           double           *values) const override;

    SpatialMandel
    elastic_strain(const SpatialMandel &from,
                   const SpatialMandel &to,
                   const double * /*history*/) const override
    {
      return elasticity().strain(SpatialMandel(to - from));
    }

    bool
    has_symmetric_tangent() const override
    {
      return false;
    }

    /** Rejects strength reduction. @throws InputError always: only the function
     *  interprets the constants */
    void
    reduce_strength(const double F) override;

  protected:
    Mode
    respond(const SpatialMandel &strain,
            const SpatialMandel &stress_n,
            const double        *history_n,
            const StepData      &step,
            SpatialMandel       &stress,
            double              *history,
            SpatialMandelMatrix *tangent) const override;

  private:
    /** Calls the function of the library.
     *  @param strain_n, strain total strain at the start of the step, and its
     *  increment
     *  @param[in,out] stress at the start and at the end (Pa)
     *  @param[out] variables state variables at the end
     *  @param[out] tangent derivatives of the stress (Pa)
     *  @return PNEWDT
     *  @throws RunError if more state variables are written than there are */
    double
    call(const UmatComponents &strain_n,
         const UmatComponents &strain,
         const double         *history_n,
         const StepData       &step,
         UmatComponents       &stress,
         std::vector<double>  &variables,
         UmatTangent          &tangent) const;

    static unsigned int
    index_of_state()
    {
      return dim == 2 ? 1 : 0;
    }
    unsigned int
    index_of_strain() const
    {
      return index_of_state() + n_state;
    }
    unsigned int
    index_of_spin() const
    {
      return index_of_strain() + n_spatial;
    }
    unsigned int
    index_of_time() const
    {
      return index_of_spin() + n_rotations;
    }
    unsigned int
    index_of_size() const
    {
      return index_of_time() + 1;
    }

    std::string         folder_of_parameters;
    std::string         library;
    std::string         function = "umat";
    std::vector<double> constants;
    std::vector<double> props; ///< the constants, followed by NaN
    unsigned int        n_state = 0;
    std::vector<double> state; ///< initial values, or empty
    std::string         name;  ///< CMNAME, 80 characters
    UmatFunction        umat = nullptr;
  };
} // namespace geocone::GEOCONE_DIM

#endif
