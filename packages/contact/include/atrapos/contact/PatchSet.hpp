#pragma once

#include <array>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "atrapos/contact/BezierPatch.hpp"
#include "atrapos/contact/PatchTool.hpp"

namespace atrapos::contact {

/// Which patch a point is over and where. patch = -1: over none.
struct Foot {
  int patch = -1;
  double t[2] = {0, 0};
  double distance = 0;  ///< to the nearest point of the set, also where the point is over no patch; >= 0
  double beyond = 0;    ///< how far the point lies outside the patch's border that the foot is on
};

/// The patches of one tool on the host: makes the law, finds where points are over it, says what is wrong.
class PatchSet {
 public:
  /// The free side is that of S_1 x S_2, of all patches, or the other one with `reversed`. `thickness`: how
  /// deep the tool is behind its surface, a length; a point deeper than that is behind the tool and free.
  /// Throws std::invalid_argument, one line, for patches that are none or have a normal that vanishes.
  explicit PatchSet(std::vector<BezierPatch> patches, bool reversed = false,
                    double thickness = std::numeric_limits<double>::infinity());

  const PatchTool& tool() const { return tool_; }
  int numPatches() const { return static_cast<int>(patches_.size()); }

  /// Global search: the nearest point of all patches. The point is over a patch unless that point is on an
  /// edge which no other patch continues and x is beyond it.
  Foot nearest(const double* x) const;

  /// The law's data of a point that is now at x: patch, t1, t2; patch = -1 also where it is deeper than the
  /// thickness. A function of the place alone, unless it lies on the border of patches, or on an edge: then
  /// it is over `preferred` where that is one of them (-1 on an edge: over none).
  std::array<double, 3> locate(const double* x) const;
  std::array<double, 3> locate(const double* x, int preferred) const;

  enum class Event {
    Stays,    ///< on its patch, or over none
    Crosses,  ///< to another patch
    Leaves,   ///< over an edge of the set: from now on over none
    Reaches   ///< from none, onto the free side of a patch
  };
  struct Following {
    Event event = Event::Stays;
    double mismatch = 0;  ///< |change of the gap| by crossing: how far the old patch is off the new one there
  };

  /// Brings the data of a point that is now at x up to date, staying on its sheet however near another one
  /// is: from the foot on its own patch over borders to the patches that continue it. For callers that keep
  /// the data from state to state; `locate` needs no memory.
  Following follow(const double* x, double* data) const;

  /// Why the point at x has no unique projection; empty where it has one.
  std::string ambiguity(const double* x) const;

 private:
  struct Patch {
    std::vector<double> coefficients;
    std::vector<std::array<double, 3>> samples;  ///< [a][b] at numSamples_ places each way
    double reach = 0;                            ///< no point of the patch is farther from the nearest sample
    double low[3], high[3];                      ///< box of the control points, which holds the patch
    bool shared[4] = {false, false, false, false};  ///< t1 = -1, t1 = 1, t2 = -1, t2 = 1
  };

  PatchPoint point(int patch, const double* t) const;
  Foot nearestOn(int patch, const double* x, double limit = std::numeric_limits<double>::infinity()) const;
  Foot descend(int patch, double t1, double t2, const double* x) const;
  double boxDistance(const Patch& patch, const double* x) const;
  Foot nearestPoint(const double* x, const Foot* known = nullptr) const;
  std::pair<int, double> nextByBox(const double* x, std::pair<int, double> last) const;
  bool onEdge(const Foot& foot) const;
  bool beyondEdge(const Foot& foot, const double* x) const;
  double gapAt(const Foot& foot, const double* x) const;
  std::array<double, 3> dataOf(const Foot& foot, const double* x) const;
  void sample();
  void requireNormal(int patch, const std::vector<PatchPoint>& samples) const;
  void findSharedEdges();
  void makeTool(bool reversed);

  std::array<int, 2> degree_{1, 1};
  int numSamples_ = 0;
  double size_ = 0;  ///< of the whole set
  double thickness_;
  std::vector<Patch> patches_;
  bool rational_ = false;
  PatchTool tool_;
};

}  // namespace atrapos::contact
