#include "deck/Stages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <regex>

#include "atrapos/physics/Formulas.hpp"
#include "deck/DeckTables.hpp"

namespace atrapos::deck {
namespace {

bool isZero(const Vector3& v) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

// ------------------------------------------------------- of a load: whether it is zero, and a part of it, by
// type

bool isZero(const NodalLoad& load) { return isZero(load.force); }
bool isZero(const SurfaceLoad& load) {
  return load.kind == SurfaceLoad::Kind::Pressure ? load.pressure == 0 : isZero(load.vector);
}
bool isZero(const EdgeLoad& load) {
  return load.kind == EdgeLoad::Kind::FollowerMoment ? load.moment == 0 : isZero(load.vector);
}
bool isZero(const VolumeLoad& load) { return isZero(load.force); }
bool isZero(const MomentLoad& load) { return load.moment == 0; }

void scale(Vector3& v, double factor) {
  for (double& x : v) {
    x *= factor;
  }
}

void scale(NodalLoad& load, double factor) { scale(load.force, factor); }
void scale(SurfaceLoad& load, double factor) {
  scale(load.vector, factor);
  load.pressure *= factor;
}
void scale(EdgeLoad& load, double factor) {
  scale(load.vector, factor);
  load.moment *= factor;
}
void scale(VolumeLoad& load, double factor) { scale(load.force, factor); }
void scale(MomentLoad& load, double factor) { load.moment *= factor; }

/// A formula with a number in place of the load factor.
std::string atLoadFactor(const std::string& formula, double loadFactor) {
  static const std::regex lambda("\\blambda\\b");
  return std::regex_replace(formula, lambda, fmt::format("({:.17g})", loadFactor));
}

class Formulas {
 public:
  explicit Formulas(const Deck& deck) : deck_(deck), fields_(scalarFields(deck)) {}
  bool haveLambda(const std::string& text, physics::Place place) const {
    return !text.empty() && physics::dependsOnLoadFactor(text, fields_, deck_.constants, place);
  }

 private:
  const Deck& deck_;
  std::vector<std::string> fields_;
};

bool isDriven(const Load& load, const Formulas& formulas) {
  return std::visit(
      [&](const auto& of) {
        if constexpr (std::is_same_v<decltype(of), const InflowLoad&>) {
          return formulas.haveLambda(of.amount, placeOf(of));
        } else if constexpr (std::is_same_v<decltype(of), const PluginLoad&>) {
          return true;  // its law may read the load factor
        } else {
          return !load.constant && !isZero(of);
        }
      },
      load.load);
}

/// Calls f(prescribed) for all that a support prescribes.
template <class Support, class F>
void forEachPrescribed(Support& support, const F& f) {
  if (support.value) {
    f(*support.value);
  }
  for (auto* const components : {&support.components, &support.director}) {
    for (auto& component : *components) {
      if (component) {
        f(*component);
      }
    }
  }
}

bool isDriven(const Support& support) {
  bool driven = false;
  forEachPrescribed(support, [&](const Prescribed& p) { driven = driven || p.driven(); });
  return driven;
}

bool isDriven(const Tool& tool, const Deck& deck) {
  return tool.motion.moves() && std::any_of(deck.contacts.begin(), deck.contacts.end(),
                                            [&](const Contact& c) { return c.tool == tool.name; });
}

bool isDriven(const Physics& physics, const Formulas& formulas) {
  if (std::holds_alternative<PluginLaw>(physics.law)) {
    return true;  // its law may read the load factor
  }
  const auto* balance = std::get_if<ScalarBalance>(&physics.law);
  return balance != nullptr && (formulas.haveLambda(balance->conductivity, physics::Place::body) ||
                                formulas.haveLambda(balance->source, physics::Place::body));
}

/// What is prescribed stays as it is at this load factor.
void hold(Prescribed& p, double loadFactor) {
  if (p.valueFormula.empty() && p.perLoadFactorFormula.empty()) {
    p.value += loadFactor * p.perLoadFactor;
  } else {
    const auto text = [](double number, const std::string& formula) {
      return formula.empty() ? fmt::format("({:.17g})", number) : "(" + formula + ")";
    };
    p.valueFormula = text(p.value, p.valueFormula) + fmt::format(" + ({:.17g})*", loadFactor) +
                     text(p.perLoadFactor, p.perLoadFactorFormula);
  }
  p.perLoadFactor = 0;
  p.perLoadFactorFormula.clear();
}

/// The entry stays as it is at this load factor.
void hold(Deck& deck, const Driven& entry, double loadFactor) {
  switch (entry.kind) {
    case Driven::Kind::Load: {
      Load& load = deck.loads[entry.index];
      std::visit(
          [&](auto& of) {
            if constexpr (std::is_same_v<decltype(of), InflowLoad&>) {
              of.amount = atLoadFactor(of.amount, loadFactor);
            } else if constexpr (std::is_same_v<decltype(of), PluginLoad&>) {
              throw std::logic_error("stages: of a plug-in's load");  // refused with the deck
            } else {
              scale(of, loadFactor);
              load.constant = true;
            }
          },
          load.load);
      return;
    }
    case Driven::Kind::Support:
      return forEachPrescribed(deck.supports[entry.index], [&](Prescribed& p) { hold(p, loadFactor); });
    case Driven::Kind::Coupling:
      return hold(*deck.couplings[entry.index].angle, loadFactor);
    case Driven::Kind::Tool:
      deck.tools[entry.index].motion.heldAt = loadFactor;
      return;
    case Driven::Kind::Material: {
      std::string& expansion = deck.materials[entry.index].expansion;
      expansion = atLoadFactor(expansion, loadFactor);
      return;
    }
    case Driven::Kind::Physics: {
      auto& balance = std::get<ScalarBalance>(deck.physics[entry.index].law);
      balance.conductivity = atLoadFactor(balance.conductivity, loadFactor);
      balance.source = atLoadFactor(balance.source, loadFactor);
      if (!balance.capacity.empty()) {
        balance.capacity = atLoadFactor(balance.capacity, loadFactor);
      }
      return;
    }
  }
}

bool isOf(const std::vector<Driven>& entries, const Driven& entry) {
  return std::any_of(entries.begin(), entries.end(),
                     [&](const Driven& e) { return e.kind == entry.kind && e.index == entry.index; });
}

/// Where the stages before have left an entry.
double leftAt(const Deck& deck, const Driven& entry, std::size_t stage, const std::vector<double>& ends) {
  for (std::size_t s = stage; s-- > 0;) {
    if (isOf(drivenBy(deck, deck.path.stages[s]), entry)) {
      return ends.at(s);
    }
  }
  return 0;
}

}  // namespace

std::vector<Driven> drivenOf(const Deck& deck) {
  const Formulas formulas(deck);
  std::vector<Driven> all;
  const auto look = [&](const auto& entries, Driven::Kind kind, const auto& driven) {
    for (std::size_t i = 0; i < entries.size(); ++i) {
      if (driven(entries[i])) {
        all.push_back({kind, i, entries[i].name});
      }
    }
  };
  look(deck.loads, Driven::Kind::Load, [&](const Load& l) { return isDriven(l, formulas); });
  look(deck.supports, Driven::Kind::Support, [](const Support& s) { return isDriven(s); });
  look(deck.couplings, Driven::Kind::Coupling,
       [](const Coupling& c) { return c.angle && c.angle->driven(); });
  look(deck.tools, Driven::Kind::Tool, [&](const Tool& t) { return isDriven(t, deck); });
  look(deck.materials, Driven::Kind::Material,
       [&](const Material& m) { return formulas.haveLambda(m.expansion, physics::Place::shell); });
  look(deck.physics, Driven::Kind::Physics, [&](const Physics& p) { return isDriven(p, formulas); });
  return all;
}

std::vector<Driven> drivenBy(const Deck& deck, const Stage& stage) {
  if (!stage.release.empty()) {
    return {};
  }
  std::vector<Driven> all = drivenOf(deck);
  if (stage.drives.empty()) {
    return all;
  }
  const auto isNamed = [&](const Driven& entry) {
    return std::find(stage.drives.begin(), stage.drives.end(), entry.name) != stage.drives.end();
  };
  all.erase(std::remove_if(all.begin(), all.end(), [&](const Driven& entry) { return !isNamed(entry); }),
            all.end());
  return all;
}

double beginOf(const Deck& deck, std::size_t stage, const std::vector<double>& ends) {
  const std::vector<Driven> driven = drivenBy(deck, deck.path.stages.at(stage));
  return driven.empty() ? 0 : leftAt(deck, driven.front(), stage, ends);
}

Deck stageDeck(const Deck& deck, std::size_t stage, const std::vector<double>& ends) {
  Deck result = deck;
  const Stage& here = deck.path.stages.at(stage);
  const std::vector<Driven> driven = drivenBy(deck, here);
  for (const Driven& entry : drivenOf(deck)) {
    if (!isOf(driven, entry)) {
      hold(result, entry, leftAt(deck, entry, stage, ends));
    }
  }
  for (std::size_t s = 0; s <= stage; ++s) {
    for (const std::string& name : deck.path.stages[s].release) {
      for (Support& support : result.supports) {
        support.released = support.released || support.name == name;
      }
    }
  }
  result.path.stages.clear();
  result.path.stop = here.stop;
  const auto& stops = here.stop.loadFactors;
  const double begin = beginOf(deck, stage, ends);
  const bool allBelow =
      !stops.empty() && std::all_of(stops.begin(), stops.end(), [&](double stop) { return stop < begin; });
  result.path.direction = here.direction.value_or(allBelow ? -1 : 1);
  return result;
}

}  // namespace atrapos::deck
