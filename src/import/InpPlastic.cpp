#include "import/InpPlastic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "deck/Characters.hpp"

namespace atrapos::importer {
namespace {

/// Stress over plastic strain in tension.
struct Row {
  double strain, stress;
};

/// Of the first temperature.
std::vector<Row> rowsOf(InpModel& model, const InpCard& card) {
  std::vector<Row> rows;
  double temperature = 0;
  InpLines lines(card);
  for (InpLine line; lines.next(line);) {
    const Row row{inpNumber(line.at(1), line.place, "plastic strain"),
                  inpNumber(line.at(0), line.place, "yield stress")};
    const double here = inpNumber(line.at(2), line.place, "temperature");
    if (rows.empty()) temperature = here;
    if (here != temperature) {
      model.remark(line.place, "*PLASTIC: rows of other temperatures are left out");
      break;
    }
    if (!(row.stress > 0)) line.place.fail("*PLASTIC: the yield stress is not positive");
    if (rows.empty() ? row.strain != 0 : !(row.strain > rows.back().strain))
      line.place.fail("*PLASTIC: plastic strains must begin with 0 and grow from row to row");
    rows.push_back(row);
  }
  if (rows.empty()) card.place.fail("*PLASTIC: has no row of yield stress and plastic strain");
  return rows;
}

/// R0 + H g + Q (1 - exp(-beta g)).
struct Hardening {
  double yield = 0, modulus = 0, saturation = 0, exponent = 0;

  double at(double g) const { return yield + modulus * g - saturation * std::expm1(-exponent * g); }
  /// The largest error, in units of the stress.
  double offOf(const std::vector<Row>& rows) const {
    double off = 0;
    for (const Row& row : rows) off = std::max(off, std::abs(at(row.strain) / row.stress - 1));
    return off;
  }
};

/// The best by least squares with this exponent through the first row; H = 0 where it is not `linear`.
Hardening fitted(const std::vector<Row>& rows, double exponent, bool linear) {
  Hardening h{rows.front().stress, 0, 0, exponent};
  double aa = 0, ab = 0, bb = 0, ay = 0, by = 0;
  for (const Row& row : rows) {
    const double a = row.strain, b = -std::expm1(-exponent * row.strain), y = row.stress - h.yield;
    aa += a * a;
    ab += a * b;
    bb += b * b;
    ay += a * y;
    by += b * y;
  }
  const double det = aa * bb - ab * ab;
  if (linear && det > 1e-12 * aa * bb) {  // else the exponent is so small that both are the same line
    h.modulus = (ay * bb - by * ab) / det;
    h.saturation = (by * aa - ay * ab) / det;
    if (h.modulus >= 0) return h;  // decks have no other
    h.modulus = 0;
  }
  h.saturation = by / bb;
  return h;
}

Hardening nearest(const std::vector<Row>& rows, bool linear) {
  if (rows.size() == 1) return {rows.front().stress};
  // A line where the rows are on one.
  const double last = rows.back().strain;
  Hardening line{rows.front().stress, (rows.back().stress - rows.front().stress) / last};
  if (line.modulus >= 0 && line.offOf(rows) < 1e-6) return line;
  Hardening best = line.modulus >= 0 && linear ? line : fitted(rows, 1 / last, false);
  double least = best.offOf(rows);
  // Exponents from such that the table ends where hardening begins to fall, to such that it has in a
  // hundredth.
  const double first = 0.1 / last, ratio = std::pow(1e4, 1.0 / 2000);
  for (int i = 0; i <= 2000; ++i) {
    const Hardening h = fitted(rows, first * std::pow(ratio, i), linear);
    if (const double off = h.offOf(rows); off < least) {
      least = off;
      best = h;
    }
  }
  return best;
}

}  // namespace

std::string inpPlastic(InpModel& model, const InpCard& card, bool finite) {
  const std::string kind = card.word("HARDENING", "ISOTROPIC");
  if (kind != "ISOTROPIC" && kind != "KINEMATIC")
    card.place.fail(
        fmt::format("*PLASTIC, HARDENING={}: no law here is equal; expected ISOTROPIC or KINEMATIC",
                    deck::shortened(kind)));
  const bool kinematic = kind == "KINEMATIC";
  if (kinematic && finite)
    card.place.fail("*PLASTIC, HARDENING=KINEMATIC: no law here is equal at large strains (NLGEOM)");
  const std::vector<Row> rows = rowsOf(model, card);
  Hardening h = nearest(rows, !kinematic);
  std::string keys = fmt::format("yield_stress: {}", h.yield);
  if (kinematic) {
    if (h.saturation < 0 || h.modulus < 0)
      card.place.fail("*PLASTIC, HARDENING=KINEMATIC: the yield stress falls, which no law here has");
    // C (1 - exp(-b g))/b is the backstress in tension.
    if (h.saturation != 0)
      keys +=
          fmt::format(", kinematic_modulus: {:.6g}, recall: {:.6g}", h.saturation * h.exponent, h.exponent);
    else if (h.modulus > 0)
      keys += fmt::format(", kinematic_modulus: {:.6g}", h.modulus);
  } else {
    if (h.modulus > 0) keys += fmt::format(", hardening_modulus: {:.6g}", h.modulus);
    if (h.saturation != 0)
      keys += fmt::format(", saturation: {:.6g}, exponent: {:.6g}", h.saturation, h.exponent);
  }
  if (rows.size() > 2 && h.offOf(rows) > 1e-6)
    model.remark(card.place, fmt::format("*PLASTIC: a curve through its {} rows, off by {:.2g} % at most",
                                         rows.size(), 100 * h.offOf(rows)));
  if (rows.size() > 1)
    model.remark(card.place,
                 fmt::format("*PLASTIC: behind the last row, a plastic strain of {:g}, hardening goes "
                             "on as before it",
                             rows.back().strain));
  if (finite) {
    keys += ", strains: finite";
    model.remark(
        card.place,
        "*PLASTIC: yields by the Kirchhoff stress, which differs from Cauchy's by the change of volume");
  }
  return keys;
}

}  // namespace atrapos::importer
