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
  Elastica();

  /// Beam: bending stiffness EI.
  StripState beam(double loadFactor) const;
  /// Plate, EI / (1 - nu^2) with nu = 0.3: the same shape at loads, and with forces, larger by 1/0.91.
  StripState plate(double loadFactor) const;

  static double touch();  ///< load factor of first contact of the beam, where the curves have a kink

 private:
  struct Branch {
    std::vector<double> loadFactor, ux, uz, force;
  };
  Branch free_, touching_;
};

}  // namespace atrapos::test
