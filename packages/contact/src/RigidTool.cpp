#include "atrapos/contact/RigidTool.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "CompiledStages.hpp"
#include "atrapos/contact/ContactStages.hpp"
#include "atrapos/contact/CurveContact.hpp"
#include "atrapos/contact/PatchSearch.hpp"
#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/fem/ReducedLaw.hpp"
#include "atrapos/fem/UnilateralTerm.hpp"

namespace atrapos::contact {
namespace {

/// x (3) for somebody who moves with the tool; place: (x, load factor).
void toToolFrame(const std::optional<Motion>& motion, const double* place, double* X) {
  if (motion)
    MovingTool<Plane>{{}, *motion}.toToolFrame(place, X);
  else
    std::copy_n(place, 3, X);
}

/// y = (h, n, ...) with the normal of the tool where it stands.
ToolProjection projection(const std::optional<Motion>& motion, const double* place, const double* y,
                          double distance) {
  ToolProjection result{y[0], {y[1], y[2], y[3]}, distance};
  if (!motion || !motion->turns()) return result;
  double c[3], sine, cosine;
  motion->at(place[3], c, sine, cosine);
  motion->turn(y + 1, sine, cosine, result.normal.data());
  return result;
}

/// The law at these points: of (x, y, z, ...) with outputs (f_x, f_y, f_z, ...), for points of a plane body
/// without z.
std::unique_ptr<fem::PointLaw> forPoints(std::unique_ptr<fem::PointLaw> law, const fem::PointSet& points) {
  if (points.components == 3) return law;
  const fem::LawShape shape = law->shape();
  fem::Reduction plane;
  for (int i = 0; i < shape.inputs; ++i) plane.inputs.push_back(i < 2 ? i : i == 2 ? -1 : i - 1);
  for (int o = 0; o < shape.outputs; ++o)
    if (o != 2) plane.outputs.push_back(o);
  plane.numInputs = shape.inputs - 1;
  return fem::reducedLaw(std::move(law), plane);
}

/// What does not depend on the kind of the tool: laws of its stages, at points whose data a search keeps up
/// to date where the tool has pieces.
class StagedTool : public RigidTool {
 public:
  StagedTool(ToolStages stages, std::optional<Motion> motion)
      : stages_(std::move(stages)), motion_(std::move(motion)) {
    if (motion_) motion_->validate();
  }

  bool moves() const override { return motion_.has_value(); }

  std::unique_ptr<fem::Term> term(const AnyPressure& pressure, const fem::PointSet& points,
                                  const std::vector<double>& referenceGaps) const override {
    return onPieces(forPoints(stagedContact(stages_, pressure), points), points, withTool(referenceGaps, 1),
                    pieces(points, 1, points.components));
  }

  std::unique_ptr<fem::Term> passage(const AnyPressure& pressure, const fem::PointSet& points,
                                     const std::vector<double>& referenceGaps,
                                     Passage passage) const override {
    const int fields = static_cast<int>(points.more.size());
    const int D = points.components, lambda = D + fields;
    std::vector<double> data;
    for (std::size_t p = 0; p < referenceGaps.size(); ++p) {
      data.insert(data.end(), &points.positions[3 * p], &points.positions[3 * p] + 3);
      data.push_back(referenceGaps[p]);
    }
    const auto search = pieces(lambda + 1, 4, placeAmong(D, lambda));
    return onPieces(forPoints(stagedPassage(stages_, pressure, std::move(passage), fields), points), points,
                    withTool(data, 4), search);
  }

  void addHard(fem::FeModel& model, const fem::PointSet& points) const override {
    const fem::UnilateralPoints own = fem::withMultipliers(model, points);
    addUnilateral(model, own);
  }

  void addHardFaces(fem::FeModel& model, const fem::PointSet& faces) const override {
    const fem::UnilateralPoints own = fem::withCornerMultipliers(model, faces);
    addUnilateral(model, own);
  }

  void addCurve(fem::FeModel& model, const RegularisedPressure& pressure, const fem::PointSet& points,
                const std::vector<double>& referenceGaps) const override {
    const fem::PointSet curves = withCurves(model, points, pressure, referenceGaps);
    // The load factor stands behind the place on the curve.
    model.terms.push_back(onPieces(forPoints(stagedCurveContact(stages_, pressure), points), curves,
                                   withTool(referenceGaps, 1), pieces(points, 1, points.components + 1)));
  }

  std::unique_ptr<fem::Term> zones(const Overclosure& pressure, const fem::LineSet& lines,
                                   fem::ZoneOptions options) const override {
    if (!stages_.symmetric)
      throw std::invalid_argument("zones of contact need a tool whose normal is the gradient of its gap");
    pressure.validate();
    return fem::zoneTerm({stagedProjection(stages_), fem::pointLaw(OverclosureStage{pressure}),
                          pieces(moves() ? 4 : 3, 0, placeAmong(3, 3))},
                         lines, options);
  }

  std::unique_ptr<fem::Term> sharpened(const RegularisedPressure& pressure, const fem::PointSet& points,
                                       const std::vector<double>& referenceGaps,
                                       double loadFactor) const override {
    auto law = forPoints(stagedSharpenedContact(stages_, pressure, loadFactor), points);
    const auto data = withTool(referenceGaps, 1);
    const int D = points.components;
    const fem::PieceSearch search = pieces(points, 1, D);
    if (!search.update) return fem::lawTerm(std::move(law), points, data);
    // Places have the load factor where the tool moves; the law's last input is how sharp it is.
    const auto update = [search, loadFactor, D, moving = moves()](int numPoints, const double* in,
                                                                  double* own) {
      std::vector<double> places;
      for (int p = 0; p < numPoints; ++p) {
        places.insert(places.end(), in + (D + 1) * p, in + (D + 1) * p + D);
        if (moving) places.push_back(loadFactor);
      }
      const std::vector<int> none(numPoints, fem::PointPieces::any);
      search.update(numPoints, places.data(), none.data(), own);
    };
    return fem::lawTerm(std::move(law), points, data, update);
  }

 protected:
  using PlaceOf = std::function<void(const double* in, const double* data, double* x)>;

  /// How the points' data follow their places, `before` others ahead of the tool's; without an update where
  /// the tool has no pieces.
  virtual fem::PieceSearch pieces(int numInputs, int before, const PlaceOf& placeOf) const = 0;

  /// The same for inputs that begin with the place of these points and have the load factor, where the tool
  /// moves, at `loadFactor`.
  fem::PieceSearch pieces(const fem::PointSet& points, int before, int loadFactor) const {
    return pieces(loadFactor + (moves() ? 1 : 0), before, placeAmong(points.components, loadFactor));
  }

  /// The place in D dimensions at the head of inputs, and the load factor where the tool moves.
  PlaceOf placeAmong(int D, int loadFactor) const {
    return [D, loadFactor, moving = moves()](const double* in, const double*, double* x) {
      for (int i = 0; i < 3; ++i) x[i] = i < D ? in[i] : 0;
      if (moving) x[3] = in[loadFactor];
    };
  }

  const std::optional<Motion>& motion() const { return motion_; }

 private:
  void addUnilateral(fem::FeModel& model, const fem::UnilateralPoints& own) const {
    model.terms.push_back(fem::unilateralTerm(forPoints(stagedHardContact(stages_), own.points), own,
                                              withTool(std::vector<double>(), own.points.numPoints(), 0),
                                              pieces(own.points, 0, own.points.components)));
  }

  static std::unique_ptr<fem::Term> onPieces(std::unique_ptr<fem::PointLaw> law, const fem::PointSet& points,
                                             const std::vector<double>& data, fem::PieceSearch search) {
    if (!search.update) return fem::lawTerm(std::move(law), points, data);
    return fem::lawTerm(std::move(law), points, data, std::move(search));
  }

  /// [point] `each` of these data, and the tool's of points that are over nothing.
  std::vector<double> withTool(const std::vector<double>& data, int each) const {
    return withTool(data, static_cast<int>(data.size()) / each, each);
  }
  std::vector<double> withTool(const std::vector<double>& data, int numPoints, int each) const {
    if (!stages_.patches) return data;
    std::vector<double> all;
    for (int p = 0; p < numPoints; ++p) {
      all.insert(all.end(), data.begin() + each * p, data.begin() + each * (p + 1));
      all.insert(all.end(), {-1, 0, 0});
    }
    return all;
  }

  ToolStages stages_;
  std::optional<Motion> motion_;
};

class SmoothTool final : public StagedTool {
 public:
  SmoothTool(const AnyTool& tool, const std::optional<Motion>& motion)
      : StagedTool(stagesOf(tool, motion), motion), tool_(tool) {
    tool_.validate();
  }

  std::string ambiguity(const double* place) const override {
    double X[3];
    toToolFrame(motion(), place, X);
    return tool_.ambiguity(X);
  }

  ToolProjection project(const double* place) const override {
    double X[3], y[AnyTool::numUnknowns];
    toToolFrame(motion(), place, X);
    taylor::solveImplicit<3, AnyTool::numUnknowns>(tool_, X, y);
    return projection(motion(), place, y, std::abs(y[0]));
  }

 private:
  fem::PieceSearch pieces(int, int, const PlaceOf&) const override { return {}; }

  AnyTool tool_;
};

class PatchedTool final : public StagedTool {
 public:
  PatchedTool(std::shared_ptr<const PatchSet> set, const std::optional<Motion>& motion)
      : StagedTool(stagesOf(set->tool(), motion), motion), tool_(set->tool()), set_(std::move(set)) {
    tool_.validate();
  }

  std::string ambiguity(const double* place) const override {
    double X[3];
    toToolFrame(motion(), place, X);
    return set_->ambiguity(X);
  }

  ToolProjection project(const double* place) const override {
    double X[3], y[PatchTool::numUnknowns];
    toToolFrame(motion(), place, X);
    const double distance = set_->nearest(X).distance;
    const auto data = set_->locate(X);
    if (data[0] < 0) {
      ToolProjection none;
      none.distance = distance;
      return none;
    }
    taylor::solveImplicit<3, PatchTool::numUnknowns, PatchTool::numToolData>(tool_, X, data.data(), y);
    return projection(motion(), place, y, distance);
  }

 private:
  fem::PieceSearch pieces(int numInputs, int before, const PlaceOf& placeOf) const override {
    if (motion())
      return PatchSearch<MovingTool<PatchTool>>{set_, {tool_, *motion()}}.pieces(numInputs, before, placeOf);
    return PatchSearch<PatchTool>{set_, tool_}.pieces(numInputs, before, placeOf);
  }

  PatchTool tool_;
  std::shared_ptr<const PatchSet> set_;
};

}  // namespace

std::unique_ptr<RigidTool> rigidTool(const AnyTool& tool, const std::optional<Motion>& motion) {
  return std::make_unique<SmoothTool>(tool, motion);
}

std::unique_ptr<RigidTool> rigidTool(std::shared_ptr<const PatchSet> set,
                                     const std::optional<Motion>& motion) {
  return std::make_unique<PatchedTool>(std::move(set), motion);
}

}  // namespace atrapos::contact
