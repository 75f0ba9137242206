#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "atrapos/fem/PointLaw.hpp"
#include "atrapos/fem/StagedLaw.hpp"
#include "atrapos/solid/Metal.hpp"
#include "atrapos/solid/ShellStages.hpp"

/// Laws of thin bodies in stages: strain, material, forces.
namespace atrapos::solid::detail {

/// What a Kinematics (ShellKinematics.hpp, ThinKinematics.hpp) gives to a law in stages.
struct StagedParts {
  std::unique_ptr<fem::PointLaw> strain, forces;
  int inputs = 0, data = 0;
  void (*gradient)(const double* x, const double* data, double* F) = nullptr;
  /// Of shells: the unit tensor as the element's strains have it, 6; assumed strains of a body that grows
  /// alike are (e + e^2/2) times that.
  void (*unit)(const double* data, double* tensor) = nullptr;
};

template <class Kinematics>
StagedParts partsOf() {
  return {fem::pointLaw(ShellStrainStage<Kinematics>{}), fem::pointLaw(ShellForceStage<Kinematics>{}),
          Kinematics::numInputs, Kinematics::numData, &Kinematics::gradient};
}

template <class Kinematics>
StagedParts shellPartsOf() {
  StagedParts parts = partsOf<Kinematics>();
  parts.unit = [](const double* data, double* tensor) {
    double x[Kinematics::numInputs];
    Kinematics::doubled(data, x);
    Kinematics::strain(x, data).store(tensor);
    for (int m = 0; m < 6; ++m) tensor[m] /= 1.5;  // e + e^2/2 of e = 1
  };
  return parts;
}

/// first, first + 1, ...
std::vector<int> range(int first, int count);
std::vector<int> joined(std::vector<int> a, const std::vector<int>& b);

/// Of Cauchy stress.
std::vector<std::string> stressNames();

/// F S F^T / volume, S and what it becomes in the order xx yy zz xy yz zx.
void pushForward(const double* S, const double* F, double volume, double* sigma);
double determinant(const double* F);

/// A metal as a stage between strain and forces.
struct MetalStage {
  std::unique_ptr<fem::PointLaw> law;  ///< in: strain, 6; out: stress, 6, event function, variables
  /// What the volume is of that of F, whose stretches across the body are not those of the metal.
  std::function<double(const double* strain, const double* variables)> volume;
};

/// Inputs x; data: whether the point yields, the Kinematics', variables. Cauchy stress is shown without that
/// along the third axis.
std::unique_ptr<fem::PointLaw> metalLaw(StagedParts parts, MetalStage metal);

/// In shells and membranes.
MetalStage planeStressMetal(const Metal& metal);

}  // namespace atrapos::solid::detail
