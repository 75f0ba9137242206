#include "scene/ContactPressure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace atrapos {
namespace {

/// Collects the numbers of a law.
class Numbers {
 public:
  explicit Numbers(ContactPressure& result) : result_(result) {}

  double operator()(const char* name, const std::optional<double>& given, double chosen) {
    const double value = given.value_or(chosen);
    result_.numbers.emplace_back(name, value);
    result_.text += fmt::format(", {} {:.6g}{}", name, value, given ? "" : " (chosen)");
    return value;
  }

 private:
  ContactPressure& result_;
};

/// alpha of zones, hard enough for the body and no harder: a zone begins as a line, and the stiffer it is,
/// the shorter the piece of the path on which its force becomes the body's (docs/theory/contact.md,
/// Defaults).
double zoneStiffness(const BodySize& body, int exponent) {
  const double t = body.thickness, L = body.length, E = body.youngsModulus, depth = 1e-3 * t;
  // Of a thick body it is the contact that yields: its compliance is to be small against that of a cell.
  const double ofCell = body.shortestLine > 0 ? 20 * E / body.shortestLine : 0;
  double alpha = std::max(10 * E / t, ofCell);
  // A slender one bends: with the force per width E t^3/L^2 a tool of the radius L comes so deep.
  if (body.isSlender())
    alpha = std::min(alpha, E * t * t * t / (L * L) * 3 / (4 * std::sqrt(2 * L * depth * depth * depth)));
  // Other powers have the same pressure there.
  return alpha * std::pow(depth, 1 - exponent);
}

}  // namespace

ContactPressure contactPressure(const deck::Contact& contact, const BodySize& body) {
  using Law = deck::Contact::Law;
  const double slender = body.thickness / body.length;
  // The pressure that bends a plate of this length and thickness by the gap, without its factor of about 1.
  const double bending = body.youngsModulus * slender * slender * slender * body.smallestGap / body.length;
  const double alpha0 = 10 * body.youngsModulus / body.thickness * body.areaPerPoint;
  const double eta0 = 0.01 * bending * body.areaPerPoint;
  const double gap = contact.referenceGap.value_or(body.smallestGap);

  ContactPressure result;
  Numbers number(result);
  const auto compliance = [&] {
    if (!contact.isRigid()) return 1 / number("stiffness", contact.stiffness, alpha0);
    result.text += ", rigid";
    return 0.0;
  };
  switch (contact.law) {
    case Law::Auto:
      throw std::logic_error("contactPressure: a law that is not chosen yet");
    case Law::Hard:
      result.hard = true;
      result.text = "hard";
      // Far above the rounding of gaps that are constraints, far below what a contact's state can mean.
      result.closedGap = 1e-10 * body.length;
      return result;
    case Law::Hyperbola:
    case Law::Barrier: {
      result.text = contact.law == Law::Barrier ? "barrier" : "hyperbola";
      const double c = contact.law == Law::Barrier ? 0 : compliance();
      const double eta = number("regularisation", contact.regularisation, eta0);
      result.regularised = contact::RegularisedPressure{c, eta};
      result.law = *result.regularised;
      result.leastReference = result.closedGap = 2 * eta * c;
      break;
    }
    case Law::Power: {
      result.text = "power";
      const double c = compliance();
      const double eta = number("regularisation", contact.regularisation, eta0);
      const double m = number("exponent", contact.exponent, contact.exponent);
      result.law = contact::PowerBarrier{c, eta, m};
      result.leastReference = result.closedGap = 2 * eta * c;
      break;
    }
    case Law::Exponential: {
      result.text = "exponential";
      const double touching = number("touching", contact.touching, bending * body.areaPerPoint);
      const double length = number("length", contact.length, 0.01 * gap);
      result.law = contact::ExponentialPressure{touching, length};
      break;
    }
    case Law::Penalty: {
      result.text = "penalty";
      const double alpha = number("stiffness", contact.stiffness, alpha0);
      // The force at zero gap that the hyperbola would have.
      const double length =
          number("length", contact.length, std::sqrt(alpha * eta0 * gap) / (alpha * std::log(2.0)));
      result.law = contact::SmoothedPenalty{alpha, length};
      break;
    }
    case Law::Linear:
    case Law::Overclosure: {
      result.text = contact.law == Law::Linear ? "linear" : "power_overclosure";
      const int m = contact.law == Law::Linear ? 1 : static_cast<int>(contact.exponent);
      const double alpha = number("stiffness", contact.stiffness, zoneStiffness(body, m));
      if (m > 1) number("exponent", contact.exponent, m);
      result.overclosure = contact::Overclosure{alpha, m};
      result.overclosure->validate();
      return result;
    }
  }
  if (contact.isRigid()) result.closedGap = -1;
  result.law.validate();
  return result;
}

}  // namespace atrapos
