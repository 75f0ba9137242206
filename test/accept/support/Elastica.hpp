#pragma once

#include <vector>

namespace atrapos::test {

/// Tip of the strip and force on the roll at a load factor.
struct StripState {
  double ux = 0, uz = 0;  ///< mm
  double force = 0;       ///< N, total contact force
};

/// The strip as an inextensible elastica on a rigid roll, hard contact, a solution by other means than ours
/// (data/README.md). Interpolated: with every second point left out the cubic is wrong by 0.0071 mm and
/// 0.0002 N at worst, so with all points by about a sixteenth of that.
class Elastica {
 public:
  /// The lower surface touches, mid-line radius 50.4 (B), or the mid-line bends to a radius of 50 (A).
  enum class Case { A, B };
  explicit Elastica(Case which = Case::B);

  /// Beam: bending stiffness EI.
  StripState beam(double loadFactor) const;
  /// Plate, EI / (1 - nu^2) with nu = 0.3: the same shape at loads, and with forces, larger by 1/0.91.
  StripState plate(double loadFactor) const;

  double touch() const {
    return touch_;
  }  ///< load factor of first contact of the beam, where the curves have a kink

 private:
  struct Branch {
    std::vector<double> loadFactor, ux, uz, force;
  };
  double touch_;
  Branch free_, touching_;
};

}  // namespace atrapos::test
