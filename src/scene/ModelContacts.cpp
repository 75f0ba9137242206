// The contacts of a deck made into terms: where points are over tools, and their reference gaps.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "atrapos/fem/Loads.hpp"
#include "atrapos/fem/ReferenceCell.hpp"
#include "atrapos/fem/ShellFaces.hpp"
#include "scene/ChosenContact.hpp"
#include "scene/ModelMaker.hpp"
#include "scene/Sets.hpp"

namespace atrapos {

std::vector<fem::PointSet> ModelMaker::pointsOf(const deck::Contact& contact) const {
  const double zeta = zetaOf(contact.at);
  try {
    if (contact.points == deck::Contact::Points::Nodes) {
      fem::PointSet points =
          zeta == 0 ? fem::nodePoints(mesh_, nodesOf(mesh_, contact.set))
                    : fem::shellNodePoints(mesh_, shells_.geometry, nodesOf(mesh_, contact.set), zeta);
      if (contact.shares == deck::Contact::Shares::DistributionFactors)
        points.weights = mesh_.nodeSets[fem::findNodeSet(mesh_, contact.set)].factors;
      return {std::move(points)};
    }
    const auto& set = sidesOf(mesh_, contact.set);
    if (plane_) return solid::planeEdgePoints(mesh_, set, *plane_, contact.quadratureDegree);
    return zeta == 0 ? fem::facePoints(mesh_, set, contact.quadratureDegree)
                     : fem::shellFacePoints(mesh_, shells_.geometry, set, zeta, contact.quadratureDegree);
  } catch (const std::runtime_error& e) {
    fail("contact/" + contact.name + "/set", e.what());
  }
}

void ModelMaker::addContacts() {
  const BodySize body = bodySize();
  // A body that only its contacts hold needs the law of far points too.
  const bool heldByContacts =
      !fem::freeBodies(mesh_, made_.model.dofs, made_.model.supports, held_, &shells_.geometry, joinedNodes())
           .empty();
  const auto toolOf = [this](const deck::Contact& contact) {
    return std::find_if(deck_.tools.begin(), deck_.tools.end(),
                        [&](const deck::Tool& tool) { return tool.name == contact.tool; }) -
           deck_.tools.begin();
  };
  const auto atStart = [&](const deck::Contact& contact) -> const contact::RigidTool& {
    const auto number = toolOf(contact);
    return *(tools_.atStart[number] ? tools_.atStart[number] : tools_.tools[number]);
  };
  const bool holds =
      heldByContacts && std::none_of(deck_.contacts.begin(), deck_.contacts.end(), [&](const auto& contact) {
        return liesOnTool(contact, mesh_, atStart(contact), body.thickness);
      });
  for (const deck::Contact& asked : deck_.contacts) {
    ContactPoints entry;
    entry.name = asked.name;
    entry.tool = tools_.tools[toolOf(asked)].get();
    entry.atStart = &atStart(asked);
    const deck::Contact& contact = made_.chosenContacts.emplace_back(
        chosenContact(asked, {deck_, mesh_, deck_.tools[toolOf(asked)], *entry.atStart, body, holds}));
    const bool zones = contact.points == deck::Contact::Points::Zones;
    if (zones)
      makeLines(contact, entry);
    else
      entry.points = pointsOf(contact);
    // A tool that moves may be all that drives the body; the steps of branches and imperfect paths are not
    // made again.
    const bool all = contact.carried == deck::Contact::Carried::All || heldByContacts ||
                     entry.tool->moves() || deck_.path.branches != path::Follow::none ||
                     !deck_.path.imperfections.empty();
    measureGaps(contact, entry);
    choosePressure(contact, body, entry);
    entry.pressure.text = choiceMade(asked, contact) + entry.pressure.text;
    entry.hardFaces = entry.pressure.hard && contact.points == deck::Contact::Points::Quadrature;
    if (zones) {
      addZones(contact, entry);
      made_.contacts.push_back(std::move(entry));
      continue;
    }
    for (std::size_t t = 0; t < entry.points.size(); ++t) {
      entry.terms.push_back(static_cast<int>(made_.model.terms.size()));
      const auto& references = entry.references[t];
      if (entry.hardFaces) {
        entry.tool->addHardFaces(made_.model, entry.points[t]);
      } else if (entry.pressure.hard) {
        entry.tool->addHard(made_.model, entry.points[t]);
      } else if (contact.unknown == deck::Contact::Unknown::Curve) {
        try {
          entry.tool->addCurve(made_.model, *entry.pressure.regularised, entry.points[t], references);
        } catch (const std::invalid_argument& e) {
          fail("contact/" + contact.name + "/reference_gap", e.what());
        }
      } else if (all) {
        made_.model.terms.push_back(entry.tool->term(entry.pressure.law, entry.points[t], references));
      } else {
        auto term = std::make_unique<contact::NearContact>(*entry.tool, entry.pressure.law, entry.points[t],
                                                           references);
        entry.near.push_back(term.get());
        made_.model.terms.push_back(std::move(term));
      }
    }
    made_.contacts.push_back(std::move(entry));
  }
}

/// Edges or lines across faces, and the points that show them.
void ModelMaker::makeLines(const deck::Contact& contact, ContactPoints& entry) const {
  const auto& set = sidesOf(mesh_, contact.set);
  if (plane_) {
    entry.points = pointsOf(contact);
    entry.lines = solid::planeEdgeLines(mesh_, set, *plane_, contact.quadratureDegree);
    return;
  }
  const auto gap = [&](const double* x) {
    const double place[4] = {x[0], x[1], x[2], 0};
    return entry.atStart->project(place).gap;
  };
  try {
    for (auto& faces :
         fem::faceLines(mesh_, shells_.geometry, set, zetaOf(contact.at), contact.quadratureDegree, gap)) {
      entry.points.push_back(std::move(faces.points));
      entry.lines.push_back(std::move(faces.lines));
    }
  } catch (const std::runtime_error& e) {
    fail("contact/" + contact.name + "/set", e.what());
  }
}

void ModelMaker::addZones(const deck::Contact& contact, ContactPoints& entry) {
  const std::string key = "contact/" + contact.name + "/points";
  fem::ZoneOptions options;
  options.events = deck_.path.series();
  // Thin bodies press on a tool with next to nothing of E.
  options.mostDepth = entry.pressure.overclosure->depthOf(1e-8 * deck::largestYoungsModulus(deck_));
  for (const fem::LineSet& lines : entry.lines) try {
      entry.terms.push_back(static_cast<int>(made_.model.terms.size()));
      made_.model.terms.push_back(entry.tool->zones(*entry.pressure.overclosure, lines, options));
    } catch (const std::invalid_argument& e) {
      fail(key, e.what());
    }
  // A whole line in the tool's surface has no limits that a series could start from, unless it closes as one.
  const double touching = 1e-9 * bodySize().thickness;
  for (std::size_t t = 0; t < entry.lines.size(); ++t) {
    const std::size_t onLine = entry.lines[t].shown.size();
    const auto& gaps = entry.gaps[t];
    for (std::size_t p = 0; p < gaps.size(); p += onLine)
      if (std::all_of(&gaps[p], &gaps[p] + onLine, [&](double gap) { return gap < touching; })) {
        entry.pressure.text +=
            "; the body lies on the tool at the start: where zones find no way to begin, leave a gap "
            "(1e-6 of the thickness does)";
        return;
      }
  }
}

/// Where the points are over the tool at the start, refusing places that cannot be.
void ModelMaker::measureGaps(const deck::Contact& contact, ContactPoints& entry) const {
  entry.smallestGap = std::numeric_limits<double>::infinity();
  for (const fem::PointSet& points : entry.points) {
    std::vector<double> gaps, distances;
    for (int p = 0; p < points.numPoints(); ++p) {
      const double* x = &points.positions[3 * static_cast<std::size_t>(p)];
      const double place[4] = {x[0], x[1], x[2], 0};
      const std::string ambiguity = entry.atStart->ambiguity(place);
      const contact::ToolProjection over = entry.atStart->project(place);
      if (!ambiguity.empty() || std::isnan(over.gap))
        fail("contact/" + contact.name,
             fmt::format("the point ({:.6g}, {:.6g}, {:.6g}) has no unique projection on tool '{}'{}{}", x[0],
                         x[1], x[2], contact.tool, ambiguity.empty() ? "" : ": it ", ambiguity));
      if (plane_ && std::abs(over.normal[2]) > 1e-9)  // far above the rounding of unit vectors
        fail("contact/" + contact.name,
             fmt::format("the normal of tool '{}' leaves the plane z = 0 at ({:.6g}, {:.6g}): a plane body "
                         "needs tools that go on along z",
                         contact.tool, x[0], x[1]));
      // Rounding of coordinates as large as the scene; anything deeper is meant.
      const double rounding = 1e-12 * (1 + std::abs(x[0]) + std::abs(x[1]) + std::abs(x[2]));
      if (over.gap < -rounding)
        fail(
            "contact/" + contact.name,
            fmt::format("tool '{}' penetrates the body at the start: gap {:.6g} at ({:.6g}, {:.6g}, {:.6g}); "
                        "move the tool or the mesh apart",
                        contact.tool, over.gap, x[0], x[1], x[2]));
      gaps.push_back(over.gap);
      distances.push_back(over.distance);
      entry.smallestGap = std::min(entry.smallestGap, over.gap);
    }
    entry.count += points.numPoints();
    entry.gaps.push_back(std::move(gaps));
    entry.references.push_back(std::move(distances));
  }
}

/// The law and each point's reference gap; `references` holds distances on entry.
void ModelMaker::choosePressure(const deck::Contact& contact, BodySize body, ContactPoints& entry) const {
  // Of the points that neither touch nor are beyond the tool; a thousandth of the thickness counts as a gap.
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& distances : entry.references)
    for (const double d : distances)
      if (d > 1e-3 * body.thickness) smallest = std::min(smallest, d);
  body.smallestGap = std::isfinite(smallest) ? smallest : 1e-3 * body.thickness;
  if (contact.points == deck::Contact::Points::Nodes)
    body.areaPerPoint /= std::accumulate(entry.points[0].weights.begin(), entry.points[0].weights.end(), 0.0);
  else
    body.areaPerPoint = 1;
  for (const fem::LineSet& lines : entry.lines) {
    const std::size_t each = 3 * (lines.degree + 1);
    for (std::size_t c = 0; c < lines.coefficients.size(); c += each) {
      const double length =
          2 * std::hypot(lines.coefficients[c + 3], lines.coefficients[c + 4], lines.coefficients[c + 5]);
      body.shortestLine = body.shortestLine > 0 ? std::min(body.shortestLine, length) : length;
    }
  }
  const std::string key = "contact/" + contact.name;
  try {
    entry.pressure = contactPressure(contact, body);
  } catch (const std::invalid_argument& e) {
    fail(key, e.what());
  }
  for (std::size_t t = 0; t < entry.points.size(); ++t) {
    std::vector<double> closed;
    for (int p = 0; p < entry.points[t].numPoints(); ++p) {
      double& reference = entry.references[t][p];
      const double least = entry.pressure.leastReference;
      const bool touches = reference < 1e-9 * body.smallestGap;
      if (contact.referenceGap) {
        reference = *contact.referenceGap;
        if (reference <= least / 2)
          fail(key + "/reference_gap",
               fmt::format(
                   "must be above {:.6g}, regularisation/stiffness as the body suggests them, got {:.6g}",
                   least / 2, reference));
      } else if (!contact.isRigid()) {
        // A law as hard as that of a point that touches, whose force falls over nothing, has no start in
        // floating-point numbers: it gets a thousandth of the scene's gap, and lifts the body by less.
        reference = std::max({reference, least, 1e-3 * body.smallestGap});
      }
      const bool curve = contact.unknown == deck::Contact::Unknown::Curve;
      if (!contact.referenceGap && (curve ? touches : !(reference > 0) && contact.isRigid())) {
        const double* x = &entry.points[t].positions[3 * static_cast<std::size_t>(p)];
        fail(key + "/reference_gap",
             fmt::format("the body touches tool '{}' at ({:.6g}, {:.6g}, {:.6g}): {} needs a "
                         "positive reference_gap there, give a number",
                         contact.tool, x[0], x[1], x[2], curve ? "unknown: curve" : "a rigid contact"));
      }
      entry.attracted += contact.referenceGap && entry.gaps[t][p] > reference;
      closed.push_back(entry.pressure.closedGap < 0 ? 1e-3 * reference : entry.pressure.closedGap);
    }
    entry.closedGaps.push_back(std::move(closed));
  }
}

BodySize ModelMaker::bodySize() const {
  BodySize body;
  body.youngsModulus = deck::largestYoungsModulus(deck_);
  const auto depthAt = [this](double x) {
    const bool ring = plane_->kind == solid::PlaneSection::Kind::axisymmetric;
    return ring ? 2 * std::acos(-1.0) * x : plane_->thickness;
  };
  double low[3], high[3], volume = 0, area = 0;  // area: of plane cells
  for (int i = 0; i < 3; ++i) low[i] = high[i] = mesh_.coordinates[i];
  for (std::size_t d = 0; d < mesh_.coordinates.size(); ++d) {
    low[d % 3] = std::min(low[d % 3], mesh_.coordinates[d]);
    high[d % 3] = std::max(high[d % 3], mesh_.coordinates[d]);
  }
  int element = 0;  // counted over all blocks
  for (const fem::Block& block : mesh_.blocks) {
    const int count = static_cast<int>(block.nodes.size()) / fem::nodesPerElement(block.topology);
    if (fem::isShell(block)) {
      const int b = static_cast<int>(&block - mesh_.blocks.data());
      const auto& directors = shells_.geometry.find(b)->directors;
      double halves = 0;
      for (std::size_t d = 0; d < directors.size(); d += 3)
        halves += std::hypot(directors[d], directors[d + 1], directors[d + 2]);
      fem::SideSet faces;
      for (int e = 0; e < count; ++e) faces.sides.push_back({element + e, 0});
      volume += fem::areaOf(mesh_, faces) * 2 * halves / (directors.size() / 3.0);
      element += count;
      continue;
    }
    element += count;
    const auto section = thin_.find(static_cast<int>(&block - mesh_.blocks.data()));
    const auto points =
        section != thin_.end()
            ? solid::thinValuePoints(mesh_, block, solid::thinTabulation(block.topology), section->second)
            : materialPoints(block, fem::tabulate(block.topology));
    volume += std::accumulate(points.weights.begin(), points.weights.end(), 0.0);
    for (int p = 0; plane_ && p < points.numPoints(); ++p)
      area += points.weights[p] / depthAt(points.positions[3 * static_cast<std::size_t>(p)]);
  }
  double extent[3] = {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
  if (plane_) {
    body.length = std::max(extent[0], extent[1]);
    body.areaPerPoint = body.length * depthAt(high[0]);
    body.thickness = area / body.length;
    return body;
  }
  std::sort(extent, extent + 3);
  body.length = extent[2];
  body.areaPerPoint = extent[1] * extent[2];  // of all points together so far
  body.thickness = volume / body.areaPerPoint;
  return body;
}

}  // namespace atrapos
