#include "atrapos/contact/ContactStages.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include "CompiledStages.hpp"
#include "atrapos/fem/StagedLaw.hpp"

namespace atrapos::contact {
namespace {

using fem::StagedPlan;

/// Stages one behind the other.
class Chain {
 public:
  Chain(int inputs, int data, bool symmetric) : wires_(inputs) {
    plan_.inputs = inputs;
    plan_.data = data;
    plan_.symmetric = symmetric;
  }

  /// The wires of its outputs.
  std::vector<int> add(std::unique_ptr<fem::PointLaw> law, std::vector<int> inputs,
                       std::vector<int> data = {}) {
    std::vector<int> outputs(law->shape().outputs);
    for (int& wire : outputs) wire = wires_++;
    plan_.stages.push_back({std::move(law), std::move(inputs), std::move(data)});
    return outputs;
  }

  /// h, n (and t1, t2 of patches) of the point whose place is on the wires x; lambda: the wire that the
  /// motion follows. Delta: its datum, -1: 0. firstPatch: the first of the patches' data.
  std::vector<int> project(const ToolStages& tool, std::vector<int> x, int lambda,
                           const std::optional<Motion>& motion, int Delta, int firstPatch) {
    if (motion) {
      x.push_back(lambda);
      x = add(fem::pointLaw(PullStage{*motion}), x);
    }
    std::vector<int> data;
    if (tool.patches) {
      data = {Delta, firstPatch, firstPatch + 1, firstPatch + 2};
      plan_.existence = firstPatch;
    }
    std::vector<int> hn = add(tool.projection(), x, data);
    if (motion && motion->turns()) {
      const auto n = add(fem::pointLaw(TurnStage{*motion}), {hn[1], hn[2], hn[3], lambda});
      std::copy(n.begin(), n.end(), hn.begin() + 1);
    }
    return hn;
  }

  /// -R n, R by h, n.
  std::vector<int> press(const AnyPressure& pressure, std::vector<int> hn, int Delta) {
    std::vector<int> f;
    hn.resize(4);
    pressure.with([&](const auto& one) {
      f = add(fem::pointLaw(PressureStage<std::decay_t<decltype(one)>>{one}), hn, {Delta});
    });
    return f;
  }

  void show(int gap, int pressure) {
    plan_.observed = {{"contact_gap", gap, std::numeric_limits<double>::infinity()},
                      {"contact_pressure", pressure, 0.0}};
  }

  std::unique_ptr<fem::PointLaw> law(std::vector<int> outputs) {
    plan_.outputs = std::move(outputs);
    return fem::stagedLaw(std::move(plan_));
  }

 private:
  StagedPlan plan_;
  int wires_;
};

constexpr int patchData = PatchTool::numToolData;

/// The motion that stands still where this one is at `loadFactor`.
Motion heldAt(const Motion& motion, double loadFactor) {
  Motion held = motion;
  for (int k = Motion::maxDegree; k > 0; --k) {
    held.angle[k - 1] += loadFactor * held.angle[k];
    held.angle[k] = 0;
    for (int i = 0; i < 3; ++i) {
      held.shift[k - 1][i] += loadFactor * held.shift[k][i];
      held.shift[k][i] = 0;
    }
  }
  return held;
}

}  // namespace

ToolStages stagesOf(const AnyTool& tool, const std::optional<Motion>& motion) {
  ToolStages stages;
  stages.motion = motion;
  tool.with([&](const auto& one) {
    using Tool = std::decay_t<decltype(one)>;
    stages.symmetric = Tool::symmetric;
    stages.projection = [one] { return fem::pointLaw(ProjectionStage<Tool>{one}); };
  });
  return stages;
}

ToolStages stagesOf(const PatchTool& tool, const std::optional<Motion>& motion) {
  return {[tool] { return fem::pointLaw(ProjectionStage<PatchTool>{tool}); }, true, PatchTool::symmetric,
          motion};
}

std::unique_ptr<fem::PointLaw> stagedContact(const ToolStages& tool, const AnyPressure& pressure) {
  Chain chain(tool.motion ? 4 : 3, 1 + (tool.patches ? patchData : 0), tool.symmetric);
  const auto hn = chain.project(tool, {0, 1, 2}, 3, tool.motion, 0, 1);
  const auto f = chain.press(pressure, hn, 0);
  chain.show(hn[0], f[3]);
  return chain.law({f[0], f[1], f[2]});
}

std::unique_ptr<fem::PointLaw> stagedPassage(const ToolStages& tool, const AnyPressure& pressure,
                                             Passage passage, int fields) {
  constexpr int firstField = 3, Delta = 3, firstPatch = 4;
  const int lambda = firstField + fields;
  Chain chain(lambda + 1, firstPatch + (tool.patches ? patchData : 0), false);
  const auto hn = chain.project(tool, {0, 1, 2}, lambda, tool.motion, Delta, firstPatch);
  const int R = chain.press(pressure, hn, Delta)[3];
  // Of fields that there are none of a formula reads nothing: any wire stands for them.
  std::vector<int> inputs(passage.amount->shape().inputs, firstField);
  for (int f = 0; f < fields; ++f) inputs[f] = firstField + f;
  const int atContact[] = {lambda, R, hn[0]};
  std::copy_n(atContact, 3, inputs.end() - 3);
  const auto q = chain.add(std::move(passage.amount), inputs, {0, 1, 2});
  const auto out = chain.add(fem::pointLaw(PassageStage{}), q, {tool.patches ? firstPatch : -1});
  std::vector<int> outputs(firstField + fields, out[0]);
  outputs[firstField + passage.into] = out[1];
  return chain.law(outputs);
}

std::unique_ptr<fem::PointLaw> stagedSharpenedContact(const ToolStages& tool,
                                                      const RegularisedPressure& pressure,
                                                      double loadFactor) {
  Chain chain(4, 1 + (tool.patches ? patchData : 0), tool.symmetric);
  std::optional<Motion> held;
  if (tool.motion) held = heldAt(*tool.motion, loadFactor);
  const auto hn = chain.project(tool, {0, 1, 2}, 3, held, 0, 1);
  const SharpenedStage stage{{pressure.compliance, pressure.eta}};
  const auto f = chain.add(fem::pointLaw(stage), {hn[0], hn[1], hn[2], hn[3], 3}, {0});
  chain.show(hn[0], f[3]);
  return chain.law({f[0], f[1], f[2]});
}

std::unique_ptr<fem::PointLaw> stagedProjection(const ToolStages& tool) {
  Chain chain(tool.motion ? 4 : 3, tool.patches ? patchData : 0, tool.symmetric);
  return chain.law(chain.project(tool, {0, 1, 2}, 3, tool.motion, -1, 0));
}

std::unique_ptr<fem::PointLaw> stagedHardContact(const ToolStages& tool) {
  constexpr int r = 3;
  Chain chain(tool.motion ? 5 : 4, tool.patches ? patchData : 0, tool.symmetric);
  const auto hn = chain.project(tool, {0, 1, 2}, 4, tool.motion, -1, 0);
  const auto f = chain.add(fem::pointLaw(HardStage{}), {hn[1], hn[2], hn[3], r});
  chain.show(hn[0], r);
  return chain.law({f[0], f[1], f[2], hn[0]});
}

std::unique_ptr<fem::PointLaw> stagedCurveContact(const ToolStages& tool,
                                                  const RegularisedPressure& pressure) {
  constexpr int t = 3, firstPatch = 1;
  Chain chain(tool.motion ? 5 : 4, firstPatch + (tool.patches ? patchData : 0), tool.symmetric);
  const auto hn = chain.project(tool, {0, 1, 2}, 4, tool.motion, 0, firstPatch);
  const auto f = chain.add(fem::pointLaw(CurveStage{pressure}), {hn[0], hn[1], hn[2], hn[3], t}, {0});
  chain.show(hn[0], f[4]);
  return chain.law({f.begin(), f.begin() + 4});
}

}  // namespace atrapos::contact
