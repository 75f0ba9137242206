#include "StagedMaterial.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace atrapos::solid::detail {

std::vector<int> range(int first, int count) {
  std::vector<int> numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), first);
  return numbers;
}

std::vector<int> joined(std::vector<int> a, const std::vector<int>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::vector<std::string> stressNames() {
  return {"stress_xx", "stress_yy", "stress_zz", "stress_xy", "stress_yz", "stress_zx"};
}

void pushForward(const double* S, const double* F, double volume, double* sigma) {
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      double sum = 0;
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l) sum += F[3 * i + k] * S[taylor::symmetricIndex(k, l)] * F[3 * j + l];
      sigma[taylor::symmetricIndex(i, j)] = sum / volume;
    }
}

double determinant(const double* F) {
  return F[0] * (F[4] * F[8] - F[5] * F[7]) - F[1] * (F[3] * F[8] - F[5] * F[6]) +
         F[2] * (F[3] * F[7] - F[4] * F[6]);
}

std::unique_ptr<fem::PointLaw> metalLaw(StagedParts parts, MetalStage metal) {
  const fem::LawShape shape = metal.law->shape();
  const int n = parts.inputs, V = shape.variables, strain = n, stress = strain + 6, event = stress + 6;
  const std::vector<int> x = range(0, n), data = range(1, parts.data);
  fem::StagedPlan plan;
  plan.inputs = n;
  plan.data = 1 + parts.data + V;
  plan.symmetric = true;
  plan.stages.push_back({std::move(parts.strain), x, data});
  plan.stages.push_back({std::move(metal.law), range(strain, 6), joined({0}, range(1 + parts.data, V))});
  plan.stages.push_back({std::move(parts.forces), joined(x, range(stress, 6)), data});
  plan.outputs = joined(range(stress + shape.outputs, n), range(event, 1 + V));
  plan.names = Metal::observedNames();
  plan.show = [=, gradient = parts.gradient, volume = std::move(metal.volume)](
                  const double* wires, const double* at, double* shown) {
    double F[9], S[6];
    gradient(wires, at + 1, F);
    std::copy_n(wires + stress, 6, S);
    S[2] = 0;
    pushForward(S, F, volume(wires + strain, wires + event + 1) * determinant(F), shown);
    shown[6] = wires[event + 1];
  };
  return fem::stagedLaw(std::move(plan));
}

MetalStage planeStressMetal(const Metal& metal) {
  return {metal.kinematicModulus > 0 ? fem::pointLaw(ShellMetalStage<true>{metal})
                                     : fem::pointLaw(ShellMetalStage<false>{metal}),
          [metal](const double* E, const double* variables) {
            const double across = FlowRule<false, true>{metal}.across(E, variables);
            return std::sqrt((1 + 2 * across) / (1 + 2 * E[2]));
          }};
}

}  // namespace atrapos::solid::detail
