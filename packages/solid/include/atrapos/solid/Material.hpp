#pragma once

#include "atrapos/fem/PointLaw.hpp"
#include "atrapos/solid/AssumedShearLaw.hpp"
#include "atrapos/solid/ShellLaw.hpp"
#include "atrapos/solid/ShellStages.hpp"
#include "atrapos/solid/TiedShellLaw.hpp"

/// A material of solids is a law of the displacement gradient (taylor/Law.hpp: H to the first Piola-Kirchhoff
/// stress, 9 each by rows) with `template <class T> taylor::Symmetric3<T> secondPiola(const
/// taylor::Symmetric3<T>& E) const`, from which shells are made. Its header ends with
/// ATRAPOS_DECLARE_MATERIAL(Material), its source is ATRAPOS_MATERIAL(Material) behind fem/PointLawOf.hpp;
/// both outside of namespaces.
#define ATRAPOS_DECLARE_MATERIAL(M)                             \
  ATRAPOS_DECLARE_POINT_LAW(M)                                  \
  ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::ShellLaw<M>)        \
  ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::AssumedShearLaw<M>) \
  ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::Mitc4Law<M>)        \
  ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::Mitc3Law<M>)        \
  ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::ShellMaterialStage<M>)

#define ATRAPOS_MATERIAL(M)                             \
  ATRAPOS_POINT_LAW(M)                                  \
  ATRAPOS_POINT_LAW(atrapos::solid::ShellLaw<M>)        \
  ATRAPOS_POINT_LAW(atrapos::solid::AssumedShearLaw<M>) \
  ATRAPOS_POINT_LAW(atrapos::solid::Mitc4Law<M>)        \
  ATRAPOS_POINT_LAW(atrapos::solid::Mitc3Law<M>)        \
  ATRAPOS_POINT_LAW(atrapos::solid::ShellMaterialStage<M>)
