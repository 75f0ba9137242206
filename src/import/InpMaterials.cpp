#include "import/InpMaterials.hpp"

#include <fmt/format.h>

#include <vector>

#include "deck/Characters.hpp"
#include "import/Import.hpp"
#include "import/InpPlastic.hpp"

namespace atrapos::importer {
namespace {

/// Numbers of the card's first line of data; more of them, for other temperatures, are remarked. They may go
/// on in the next line where `count` are not there yet.
std::vector<double> constants(InpModel& model, const InpCard& card, std::size_t count) {
  std::vector<double> numbers;
  InpLines lines(card);
  InpLine line;
  while (numbers.size() < count && lines.next(line))
    for (const auto field : line.fields)
      if (numbers.size() < count) numbers.push_back(inpNumber(field, line.place, "constant of the material"));
  numbers.resize(count);
  if (lines.next(line))
    model.remark(line.place, fmt::format("*{}: constants of other temperatures are left out", card.keyword));
  return numbers;
}

/// With *PLASTIC, null: none.
std::string elastic(InpModel& model, const InpCard& card, const InpCard* plastic, bool finite) {
  const std::string type = card.word("TYPE", "ISO");
  if (type != "ISO" && type != "ISOTROPIC")
    card.place.fail(
        fmt::format("*ELASTIC, TYPE={}: no law here is equal; expected ISO", deck::shortened(type)));
  const auto c = constants(model, card, 2);
  const std::string constants = fmt::format("youngs_modulus: {}, poissons_ratio: {}", c[0], c[1]);
  if (plastic == nullptr) return "law: saint_venant_kirchhoff, " + constants;
  return "law: von_mises, " + constants + ", " + inpPlastic(model, *plastic, finite);
}

double bulkModulus(double d, const InpPlace& place) {
  if (!(d > 0))
    place.fail(
        "*HYPERELASTIC: D1 is not positive; expected D1 = 2 / bulk modulus, no law here is incompressible");
  return 2 / d;
}

/// U = sum of 2 mu_i/alpha_i^2 (...) there, mu_i/alpha_i here; constants mu_1, alpha_1, ..., D_1, ...
std::string ogden(InpModel& model, const InpCard& card, std::size_t n) {
  const auto c = constants(model, card, 3 * n);
  std::vector<double> mu, alpha;
  for (std::size_t i = 0; i < n; ++i) {
    if (c[2 * i] == 0 || c[2 * i + 1] == 0)
      card.place.fail(fmt::format("*HYPERELASTIC, OGDEN: term {} has a constant that is 0", i + 1));
    mu.push_back(2 * c[2 * i] / c[2 * i + 1]);
    alpha.push_back(c[2 * i + 1]);
  }
  for (std::size_t i = 2 * n + 1; i < 3 * n; ++i)
    if (c[i] != 0) model.remark(card.place, fmt::format("*HYPERELASTIC: D{} is left out", i - 2 * n + 1));
  return fmt::format("law: ogden, mu: [{}], alpha: [{}], bulk_modulus: {}", fmt::join(mu, ", "),
                     fmt::join(alpha, ", "), bulkModulus(c[2 * n], card.place));
}

std::string hyperelastic(InpModel& model, const InpCard& card) {
  const long long n = card.has("N") ? inpInteger(*card.find("N"), card.place, "N", 1, 6) : 1;
  const bool neo = card.has("NEOHOOKE") || (card.has("REDUCEDPOLYNOMIAL") && n == 1),
             mooney = card.has("MOONEY-RIVLIN") || (card.has("POLYNOMIAL") && n == 1),
             yeoh = card.has("YEOH") || (card.has("REDUCEDPOLYNOMIAL") && n == 3);
  if (card.has("TESTDATAINPUT")) card.place.fail("*HYPERELASTIC, TEST DATA INPUT: expected constants");
  if (neo) {
    const auto c = constants(model, card, 2);
    return fmt::format("law: mooney_rivlin, c1: {}, c2: 0, bulk_modulus: {}", c[0],
                       bulkModulus(c[1], card.place));
  }
  if (mooney) {
    const auto c = constants(model, card, 3);
    return fmt::format("law: mooney_rivlin, c1: {}, c2: {}, bulk_modulus: {}", c[0], c[1],
                       bulkModulus(c[2], card.place));
  }
  if (card.has("OGDEN")) return ogden(model, card, static_cast<std::size_t>(n));
  if (!yeoh)
    card.place.fail(
        "*HYPERELASTIC: no law here is equal; expected NEO HOOKE, MOONEY-RIVLIN, OGDEN, YEOH, POLYNOMIAL of "
        "N=1 or REDUCED POLYNOMIAL of N=1 or 3");
  const auto c = constants(model, card, 6);
  if (c[4] != 0 || c[5] != 0) model.remark(card.place, "*HYPERELASTIC: D2 and D3 are left out");
  return fmt::format("law: yeoh, c1: {}, c2: {}, c3: {}, bulk_modulus: {}", c[0], c[1], c[2],
                     bulkModulus(c[3], card.place));
}

}  // namespace

std::string inpLaw(InpModel& model, const std::string& name, bool finite) {
  const InpMaterial* const material = model.materials.find(name);
  const InpCard *law = nullptr, *linear = nullptr, *plastic = nullptr;
  for (const InpCard* card : material->cards) {
    if (card->keyword == "HYPERELASTIC") law = card;
    if (card->keyword == "ELASTIC") linear = card;
    if (card->keyword == "PLASTIC") plastic = card;
  }
  if (law != nullptr) {
    if (plastic != nullptr)
      plastic->place.fail("*PLASTIC beside *HYPERELASTIC: no law here is equal; expected it beside *ELASTIC");
    const std::string text = hyperelastic(model, *law);
    model.remark(law->place,
                 "*HYPERELASTIC: the energy of the volume is kappa/4 (J^2 - 1 - 2 ln J), near J = 1 the same "
                 "as (J - 1)^2/D1");
    return text;
  }
  if (linear == nullptr)
    material->place.fail(
        fmt::format("material '{}' has neither *ELASTIC nor *HYPERELASTIC", deck::shortened(name)));
  return elastic(model, *linear, plastic, finite);
}

double inpDensity(const InpModel& model, const std::string& name, const InpPlace& place) {
  const InpMaterial* const material = model.materials.find(name);
  if (material != nullptr)
    for (const InpCard* card : material->cards) {
      InpLine line;
      if (card->keyword == "DENSITY" && InpLines(*card).next(line))
        return inpNumber(line.at(0), line.place, "density");
    }
  place.fail(fmt::format("gravity acts on material '{}', which has no *DENSITY", deck::shortened(name)));
}

}  // namespace atrapos::importer
