#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "atrapos/fem/Rows.hpp"
#include "atrapos/formula/Builder.hpp"
#include "atrapos/physics/Balance.hpp"
#include "atrapos/physics/BalanceLaw.hpp"
#include "atrapos/physics/FieldTerm.hpp"
#include "atrapos/physics/Flow.hpp"
#include "atrapos/solid/MixedBody.hpp"
#include "plugin/Plugins.hpp"
#include "scene/ModelMaker.hpp"
#include "scene/Sets.hpp"

// Scalar fields of a scene: their balances, flows, what flows in, where they begin.
namespace atrapos {
namespace {

/// Values of a field at the points of a contact. A shell's surface has directors, where no field is, behind
/// its nodes.
fem::Interpolation valuesAt(const fem::PointSet& points, const std::string& field, bool directors) {
  fem::Interpolation values = physics::mapsOf(field, points);
  if (!directors) return values;
  const int half = values.nodesPerEntity /= 2;
  const auto firstHalves = [half](const auto& all) {
    std::vector<int> even;
    for (std::size_t row = 0; row * half < all.size(); row += 2) even.push_back(static_cast<int>(row));
    return fem::rowsOf(all, even, half);
  };
  values.nodes = firstHalves(values.nodes);
  values.shape = firstHalves(values.shape);
  return values;
}

}  // namespace

std::vector<std::string> ModelMaker::scalarFieldsOf(int block) const {
  const auto isIn = [&](const std::vector<std::string>& blocks) {
    return std::any_of(blocks.begin(), blocks.end(),
                       [&](const std::string& name) { return fem::findBlock(mesh_, name) == block; });
  };
  std::set<std::string> here;
  for (const deck::Physics& entry : deck_.physics) {
    if (!isIn(entry.blocks)) continue;
    if (const auto* balance = std::get_if<deck::ScalarBalance>(&entry.law))
      here.insert(balance->field);
    else if (const auto* own = std::get_if<deck::PluginLaw>(&entry.law))
      here.insert(own->fields.begin(), own->fields.end());
    else  // without the pressure, which is not at all nodes
      here.insert(std::get<deck::FluidFlow>(entry.law).velocity.begin(),
                  std::get<deck::FluidFlow>(entry.law).velocity.end());
  }
  for (const deck::Material& material : deck_.materials)
    if (material.dielectric && isIn(material.blocks)) here.insert(material.dielectric->field);
  std::vector<std::string> fields;
  for (const std::string& name : deck::scalarFields(deck_))
    if (here.count(name) > 0) fields.push_back(name);
  return fields;
}

std::vector<std::string> ModelMaker::scalarFieldsOf(const fem::SideSet& set) const {
  std::set<int> blocks;
  for (const fem::Side& side : set.sides) blocks.insert(fem::addressOf(mesh_, side.element).block);
  std::vector<std::string> fields = deck::scalarFields(deck_);
  for (const int block : blocks) {
    const std::vector<std::string> here = scalarFieldsOf(block);
    fields.erase(std::remove_if(fields.begin(), fields.end(),
                                [&](const std::string& name) {
                                  return std::find(here.begin(), here.end(), name) == here.end();
                                }),
                 fields.end());
  }
  return fields;
}

physics::Expansion ModelMaker::expansionOf(const deck::Material& material, int block) const {
  try {
    return physics::expansionOf(material.expansion, scalarFieldsOf(block), deck_.constants);
  } catch (const formula::FormulaError& e) {
    fail("materials/" + material.name + "/expansion",
         fmt::format("in block '{}' {}", mesh_.blocks[block].name, e.what()));
  }
}

bool ModelMaker::isVelocity(const std::string& field) const {
  return std::any_of(deck_.physics.begin(), deck_.physics.end(), [&](const deck::Physics& entry) {
    const auto* flow = std::get_if<deck::FluidFlow>(&entry.law);
    return flow != nullptr &&
           std::find(flow->velocity.begin(), flow->velocity.end(), field) != flow->velocity.end();
  });
}

const solid::ShellElements* ModelMaker::shellsOf(int block) const {
  const int shells = shells_.find(block);
  return shells < 0 ? nullptr : &shells_.elements[shells];
}

void ModelMaker::addBalances() {
  for (std::size_t b = 0; b < mesh_.blocks.size(); ++b) {
    const fem::Block& block = mesh_.blocks[b];
    const std::vector<std::string> fields = scalarFieldsOf(static_cast<int>(b));
    if (fields.empty()) continue;
    std::vector<physics::Balance> balances;
    const deck::Physics* last = nullptr;
    for (const deck::Physics& entry : deck_.physics) {
      const bool here = std::any_of(entry.blocks.begin(), entry.blocks.end(), [&](const std::string& name) {
        return fem::findBlock(mesh_, name) == static_cast<int>(b);
      });
      if (!here) continue;
      const auto* law = std::get_if<deck::ScalarBalance>(&entry.law);
      if (law == nullptr) continue;
      for (const auto& text : {law->conductivity, law->source, law->capacity.empty() ? "1" : law->capacity})
        try {
          physics::checkFormula(text, fields, deck_.constants, physics::Place::body);
        } catch (const formula::FormulaError& e) {
          fail("physics/" + entry.name, fmt::format("in block '{}' a formula {}", block.name, e.what()));
        }
      balances.push_back({law->field, law->conductivity, law->source, law->capacity});
      last = &entry;
      if (shells_.find(static_cast<int>(b)) >= 0 && !shells_.geometry.followers.empty())
        fail("physics/" + entry.name + "/blocks",
             fmt::format("block '{}' has shells, some with middle nodes on edges that others have without; "
                         "fields do not cross such edges",
                         block.name));
      if (!isVelocity(law->field)) continue;
      if (made_.bodies[b].flow < 0)
        fail("physics/" + entry.name + "/blocks",
             fmt::format("block '{}' has no flow, whose velocity '{}' is; a force acts on a fluid",
                         block.name, law->field));
      balances.back().capacity = "0";  // the flow has its density
    }
    if (balances.empty()) continue;
    if (fields.size() > physics::mostFields)
      fail("physics/" + last->name + "/blocks",
           fmt::format("block '{}' has {} scalar fields; expected at most {}", block.name, fields.size(),
                       physics::mostFields));
    try {
      made_.bodies[b].balances = static_cast<int>(made_.model.terms.size());
      made_.model.terms.push_back(physics::balanceTerm(mesh_, block, fields, balances, deck_.constants,
                                                       plane_, shellsOf(static_cast<int>(b))));
    } catch (const formula::FormulaError& e) {
      fail("physics/" + last->name, fmt::format("with all that acts in block '{}' {}", block.name, e.what()));
    } catch (const std::runtime_error& e) {
      fail("mesh/file", e.what());
    }
  }
}

void ModelMaker::addFlows() {
  for (const deck::Physics& entry : deck_.physics) {
    const auto* flow = std::get_if<deck::FluidFlow>(&entry.law);
    if (flow == nullptr) continue;
    for (const std::string& name : entry.blocks) {
      const int b = fem::findBlock(mesh_, name);
      made_.bodies[b].flow = static_cast<int>(made_.model.terms.size());
      try {
        made_.model.terms.push_back(
            physics::flowTerm(mesh_, mesh_.blocks[b],
                              {flow->velocity, flow->pressure, flow->viscosity, flow->density}, plane_));
      } catch (const std::runtime_error& e) {
        fail("mesh/file", e.what());
      }
    }
  }
}

void ModelMaker::addPluginLaws() {
  for (const deck::Physics& entry : deck_.physics) {
    const auto* own = std::get_if<deck::PluginLaw>(&entry.law);
    if (own == nullptr) continue;
    const std::string path = "physics/" + entry.name;
    const auto chosen = plugins::physicsOf(deck_, path, *own);
    physics::FieldCapacity capacity;
    if (chosen.law->capacity)
      capacity = [stored = chosen.law->capacity, parameters = chosen.parameters](
                     const double* in, const double* data, double* c) { stored(parameters, in, data, c); };
    for (const std::string& name : entry.blocks) {
      const int b = fem::findBlock(mesh_, name);
      made_.bodies[b].own.push_back(static_cast<int>(made_.model.terms.size()));
      made_.model.terms.push_back(made(path, [&] {
        return physics::fieldTerm(mesh_, mesh_.blocks[b], own->fields, plugins::lawOf(chosen), capacity,
                                  plane_, shellsOf(b));
      }));
    }
  }
}

void ModelMaker::addPluginLoads() {
  for (const deck::Load& load : deck_.loads) {
    const auto* own = std::get_if<deck::PluginLoad>(&load.load);
    if (own == nullptr) continue;
    const std::string path = "loads/" + load.name;
    const auto chosen = plugins::loadOf(deck_, path, own->law);
    const fem::SideSet& set = sidesOf(mesh_, own->set);
    for (const std::string& field : own->law.fields) fieldsAt(path + "/fields", own->set, field);
    auto terms = made(path, [&] {
      return physics::sideTerms(
          mesh_, set, own->law.fields, [&] { return plugins::lawOf(chosen); }, plane_);
    });
    for (auto& term : terms) made_.model.terms.push_back(std::move(term));
  }
}

std::vector<fem::DofMap::Located> ModelMaker::flowFields() const {
  std::vector<fem::DofMap::Located> fields;
  for (const deck::Physics& entry : deck_.physics) {
    const auto* flow = std::get_if<deck::FluidFlow>(&entry.law);
    if (flow == nullptr) continue;
    std::vector<int> blocks;
    std::set<int> corners;
    for (const std::string& name : entry.blocks) {
      blocks.push_back(fem::findBlock(mesh_, name));
      const auto nodes = solid::pressureNodes(mesh_.blocks[blocks.back()]);
      corners.insert(nodes.begin(), nodes.end());
    }
    for (const std::string& name : flow->velocity) {
      fem::Field field = physics::scalarField(name);
      field.balance = flow->velocity[0];  // forces along all axes are one balance
      fields.push_back({field, nodesOfBlocks(blocks)});
    }
    fields.push_back({physics::scalarField(flow->pressure), {corners.begin(), corners.end()}});
  }
  return fields;
}

std::vector<std::string> ModelMaker::fieldsAt(const std::string& key, const std::string& sides,
                                              const std::string& field) const {
  std::vector<std::string> fields = scalarFieldsOf(sidesOf(mesh_, sides));
  if (std::find(fields.begin(), fields.end(), field) == fields.end())
    fail(key, fmt::format("a side of '{}' belongs to a block without the field '{}'", sides, field));
  return fields;
}

void ModelMaker::addInflows() {
  for (const deck::Load& load : deck_.loads) {
    const auto* inflow = std::get_if<deck::InflowLoad>(&load.load);
    if (inflow == nullptr || !inflow->contact.empty()) continue;
    const std::vector<std::string> fields =
        fieldsAt("loads/" + load.name + "/field", inflow->set, inflow->field);
    const fem::SideSet& set = sidesOf(mesh_, inflow->set);
    try {
      for (auto& term : physics::inflowTerms(mesh_, set, fields, {{inflow->field, inflow->amount}},
                                             deck_.constants, plane_))
        made_.model.terms.push_back(std::move(term));
    } catch (const formula::FormulaError& e) {
      fail("loads/" + load.name + "/amount", e.what());
    } catch (const std::runtime_error& e) {
      fail("loads/" + load.name, e.what());
    }
  }
}

void ModelMaker::addContactInflows() {
  for (const deck::Load& load : deck_.loads) {
    const auto* inflow = std::get_if<deck::InflowLoad>(&load.load);
    if (inflow == nullptr || inflow->contact.empty()) continue;
    const auto made = std::find_if(made_.contacts.begin(), made_.contacts.end(),
                                   [&](const ContactPoints& c) { return c.name == inflow->contact; });
    const deck::Contact& contact = deck_.contacts[made - made_.contacts.begin()];  // made in their order
    const std::vector<std::string> fields =
        fieldsAt("loads/" + load.name + "/field", contact.set, inflow->field);
    const auto into = std::find(fields.begin(), fields.end(), inflow->field) - fields.begin();
    for (std::size_t t = 0; t < made->points.size(); ++t) try {
        fem::PointSet points = made->points[t];
        for (const std::string& field : fields)
          points.more.push_back(valuesAt(made->points[t], field, zetaOf(contact.at) != 0));
        contact::Passage passage{physics::contactInflow(inflow->amount, fields, deck_.constants),
                                 static_cast<int>(into)};
        made_.model.terms.push_back(
            made->tool->passage(made->pressure.law, points, made->references[t], std::move(passage)));
      } catch (const formula::FormulaError& e) {
        fail("loads/" + load.name + "/amount", e.what());
      } catch (const std::invalid_argument& e) {
        fail("loads/" + load.name, e.what());
      }
  }
}

void ModelMaker::setInitialValues() {
  for (const deck::ScalarField& field : deck_.fields) {
    const int number = made_.model.dofs.find(field.name);
    made_.model.initial.resize(made_.model.dofs.numDofs(), 0.0);
    const auto value = physics::ofPlace(field.initial, deck_.constants);
    for (int n = 0; n < mesh_.numNodes(); ++n)
      if (const int dof = made_.model.dofs.dof(number, n, 0); dof >= 0)
        made_.model.initial[dof] = value(&mesh_.coordinates[3 * static_cast<std::size_t>(n)]);
  }
}

}  // namespace atrapos
