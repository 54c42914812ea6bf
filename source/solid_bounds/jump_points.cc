// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/solid_bounds/jump_points.h>

#include <algorithm>

namespace geocone::GEOCONE_DIM
{
  using dealii::Tensor;

  namespace
  {
    /** Unbounded normal stress of a plane that soil cannot leave: the jump vanishes. */
    OpeningCone
    closed_cone()
    {
      OpeningCone law;
      law.A(0, 0)        = 0.;
      law.o[0]           = 1.;
      law.null_vector[0] = 1.;
      law.finish();
      return law;
    }

    using PlaneStrains = PointGroupOf<OpeningCone, 6>::Strains;

    PlaneStrains
    normal_jump(const Tensor<1, dim>   &normal,
                const JumpPoints::Axes &axes_of_first)
    {
      PlaneStrains B;
      for (unsigned int d = 0; d < dim; ++d)
        {
          B(0, d)       = -(normal * axes_of_first[d]);
          B(0, dim + d) = normal[d];
        }
      return B;
    }

    using FaceStrains = PointGroupOf<FaceCone, 6>::Strains;

    FaceStrains
    jump(const JumpPoints::Axes &axes, const JumpPoints::Axes &axes_of_first)
    {
      FaceStrains B;
      for (unsigned int row = 0; row < dim; ++row)
        B.row(row) = normal_jump(axes[row], axes_of_first);
      return B;
    }
  } // namespace

  CutFaceCone
  cut_face_cone(const double mu, const double tension)
  {
    const FaceCone cone = face_cone(mu);
    CutFaceCone    law;
    law.A << cone.A, 1., 0., 0.;
    law.o << cone.o, tension;
    law.start     = cone.start;
    law.start[0]  = std::min(law.start[0], -1.);
    law.inside[0] = 1.;
    law.finish();
    return law;
  }

  JumpPoints::Axes
  global_axes()
  {
    JumpPoints::Axes axes;
    for (unsigned int d = 0; d < dim; ++d)
      axes[d][d] = 1.;
    return axes;
  }

  JumpPoints::Dofs
  dofs_of_both(const unsigned int first, const unsigned int second)
  {
    JumpPoints::Dofs dofs;
    for (unsigned int d = 0; d < dim; ++d)
      {
        dofs[d]       = first + d;
        dofs[dim + d] = second + d;
      }
    return dofs;
  }

  JumpPoints::JumpPoints(const SolidScene &bound, const double margin)
    : strengths(bound.strengths)
    , interfaces(bound.interfaces)
  {
    std::vector<FaceCone>            of_faces;
    std::vector<CutMohrCoulombCones> of_cut_layers;
    std::vector<CutFaceCone>         of_cut_faces;
    for (const SpatialStrength &one : strengths)
      if (one.is_cut())
        {
          number.push_back(of_cut_layers.size());
          of_cut_layers.push_back(cut_law(one));
        }
      else
        {
          number.push_back(of_faces.size());
          of_faces.push_back(face_cone(one.face_friction()));
        }
    for (const InterfaceStrength &one : interfaces)
      if (one.is_cut())
        {
          number_at.push_back(of_cut_faces.size());
          of_cut_faces.push_back(
            cut_face_cone(one.friction, (one.tension - margin) / one.adhesion));
        }
      else
        {
          number_at.push_back(of_faces.size());
          of_faces.push_back(face_cone(one.friction));
        }
    faces      = std::make_unique<Faces>(of_faces);
    cut_layers = std::make_unique<CutLayers>(of_cut_layers);
    cut_faces  = std::make_unique<CutFaces>(of_cut_faces);
    planes     = std::make_unique<Planes>(
      std::vector<OpeningCone>{opening_cone(), closed_cone()});
  }

  void
  JumpPoints::add_in_soil(const unsigned int material,
                          const Axes        &axes,
                          const Dofs        &dofs,
                          const double       weight,
                          const double       k)
  {
    const SpatialStrength &one = strengths[material];
    if (one.is_cut())
      {
        CutLayers::Strains B; // of a thin layer
        for (unsigned int d = 0; d < dim; ++d)
          {
            B.col(dim + d) = symmetric_product(d, axes[0]);
            B.col(d)       = -B.col(dim + d);
          }
        cut_layers->add(B, dofs, weight, number[material], one.k);
        return;
      }
    faces->add(jump(axes, global_axes()), dofs, weight, number[material], k);
  }

  void
  JumpPoints::add_opening(const Tensor<1, dim> &normal,
                          const Dofs           &dofs,
                          const double          weight,
                          const double          tension)
  {
    planes->add(normal_jump(normal, global_axes()), dofs, weight, 0, tension);
  }

  void
  JumpPoints::add_closed(const Tensor<1, dim> &normal,
                         const Dofs           &dofs,
                         const double          weight)
  {
    planes->add(normal_jump(normal, global_axes()), dofs, weight, 1, 1.);
  }

  void
  JumpPoints::add_at_obstacle(const unsigned int obstacle,
                              const Axes        &axes,
                              const Dofs        &dofs,
                              const double       weight,
                              const Axes        &axes_of_first)
  {
    const InterfaceStrength &one = interfaces[obstacle];
    if (one.is_smooth())
      planes->add(normal_jump(axes[0], axes_of_first),
                  dofs,
                  weight,
                  one.is_closed() ? 1 : 0,
                  one.is_closed() ? 1. : one.tension);
    else if (one.is_cut())
      cut_faces->add(jump(axes, axes_of_first),
                     dofs,
                     weight,
                     number_at[obstacle],
                     one.adhesion);
    else
      faces->add(jump(axes, axes_of_first),
                 dofs,
                 weight,
                 number_at[obstacle],
                 one.adhesion);
  }

  void
  JumpPoints::move_to(ConicProblem &problem)
  {
    if (faces->n_points() > 0)
      problem.groups.push_back(std::move(faces));
    if (cut_layers->n_points() > 0)
      problem.groups.push_back(std::move(cut_layers));
    if (cut_faces->n_points() > 0)
      problem.groups.push_back(std::move(cut_faces));
    if (planes->n_points() > 0)
      problem.groups.push_back(std::move(planes));
  }
} // namespace geocone::GEOCONE_DIM
