#include "report/ReportShape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "atrapos/exodus/JoinedResults.hpp"
#include "atrapos/exodus/MeshFile.hpp"
#include "atrapos/exodus/MeshPart.hpp"
#include "atrapos/exodus/ResultReader.hpp"
#include "report/ReportTools.hpp"
#include "report/Surface.hpp"

namespace atrapos {
namespace {

constexpr std::array<const char*, 3> kDisplacements{"displ_x", "displ_y", "displ_z"};

std::string base64(const void* data, std::size_t size) {
  static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto* const bytes = static_cast<const unsigned char*>(data);
  std::string text;
  text.reserve(4 * ((size + 2) / 3));
  for (std::size_t i = 0; i < size; i += 3) {
    const std::size_t left = size - i;
    const std::uint32_t three =
        bytes[i] << 16 | (left > 1 ? bytes[i + 1] << 8 : 0) | (left > 2 ? bytes[i + 2] : 0);
    text += letters[three >> 18];
    text += letters[three >> 12 & 63];
    text += left > 1 ? letters[three >> 6 & 63] : '=';
    text += left > 2 ? letters[three & 63] : '=';
  }
  return text;
}

/// Results in one file or in parts.
class Results {
 public:
  explicit Results(const std::string& file) {
    if (std::filesystem::exists(file)) {
      whole_.emplace(file);
      mesh_ = exodus::readMesh(file);
    } else {
      parts_ = std::make_unique<exodus::JoinedResults>(file, exodus::findParts(file).at(0));
      mesh_ = parts_->joined().mesh;
    }
  }
  static bool isThere(const std::string& file) {
    return std::filesystem::exists(file) || exodus::findParts(file).size() == 1;
  }

  const fem::Mesh& mesh() const { return mesh_; }
  int numSteps() const { return whole_ ? whole_->numSteps() : parts_->numSteps(); }
  std::vector<double> times() const { return whole_ ? whole_->times() : parts_->times(); }
  std::vector<std::string> nodalNames() const {
    return whole_ ? whole_->nodalNames() : parts_->names().nodal;
  }
  std::vector<std::string> elementNames() const {
    return whole_ ? whole_->elementNames() : parts_->names().element;
  }
  double loadFactor(int step) const {
    const auto names = whole_ ? whole_->globalNames() : parts_->names().global;
    const auto at = std::find(names.begin(), names.end(), "load_factor") - names.begin();
    const auto values = whole_ ? whole_->globals(step) : parts_->globals(step);
    return at < static_cast<std::ptrdiff_t>(values.size()) ? values[at] : 0;
  }
  std::vector<double> nodal(int step, const std::string& name) const {
    return whole_ ? whole_->nodal(step, name) : parts_->nodal(step, name);
  }
  std::vector<double> element(int step, const std::string& name) const {
    return whole_ ? whole_->element(step, name) : parts_->element(step, name);
  }

 private:
  std::optional<exodus::ResultReader> whole_;
  std::unique_ptr<exodus::JoinedResults> parts_;
  fem::Mesh mesh_;
};

struct Field {
  std::string name;
  bool ofNodes;
};

/// What colours can show; displacements and directors are seen in the shape.
std::vector<Field> fieldsOf(const Results& results) {
  std::vector<Field> fields;
  for (const std::string& name : results.nodalNames())
    if (name.rfind("displ_", 0) != 0 && name.rfind("director_", 0) != 0) fields.push_back({name, true});
  for (const std::string& name : results.elementNames()) fields.push_back({name, false});
  return fields;
}

bool hasDisplacements(const Results& results) {
  const auto names = results.nodalNames();
  return std::all_of(
      kDisplacements.begin(), kDisplacements.end() - (results.mesh().dimension == 2 ? 1 : 0),
      [&](const char* name) { return std::find(names.begin(), names.end(), name) != names.end(); });
}

/// The states and fields that `bytes` have room for.
struct Room {
  std::size_t states = 0, fields = 0;
};

Room roomFor(std::size_t states, std::size_t fields, std::size_t displacementBytes, std::size_t fieldBytes,
             std::size_t bytes) {
  constexpr std::size_t most = 150, few = 30;  // states of a slider; so many rather than a field more
  const auto fits = [&](std::size_t s, std::size_t f) {
    return s * (displacementBytes + f * fieldBytes) <= bytes;
  };
  Room room{std::min(states, most), fields};
  while (room.states > few && !fits(room.states, room.fields)) --room.states;
  while (room.fields > 0 && !fits(room.states, room.fields)) --room.fields;
  while (room.states > 0 && !fits(room.states, room.fields)) --room.states;
  return room;
}

class Shape {
 public:
  Shape(const Results& first, std::size_t bytes, std::size_t allStates)
      : mesh_(first.mesh()),
        surface_(surfaceOf(mesh_)),
        fields_(fieldsOf(first)),
        moves_(hasDisplacements(first)) {
    const std::size_t largest = 4 * std::max<std::size_t>(surface_.nodes.size(), mesh_.numElements());
    room_ = roomFor(allStates, fields_.size(), 12 * surface_.nodes.size(), largest, bytes);
  }

  const Room& room() const { return room_; }
  std::size_t numFields() const { return fields_.size(); }

  nlohmann::json body() const {
    std::vector<float> rest;
    for (const int node : surface_.nodes)
      for (int c = 0; c < 3; ++c) rest.push_back(static_cast<float>(mesh_.coordinates[3 * node + c]));
    nlohmann::json json{{"dimension", mesh_.dimension},
                        {"moves", moves_},
                        {"positions", atrapos::base64(rest)},
                        {"triangles", atrapos::base64(surface_.triangles)},
                        {"triangle_elements", atrapos::base64(surface_.triangleElements)},
                        {"edges", atrapos::base64(surface_.edges)},
                        {"fields", nlohmann::json::array()},
                        {"branches", nlohmann::json::array()}};
    for (std::size_t f = 0; f < room_.fields; ++f)
      json["fields"].push_back({{"name", fields_[f].name}, {"of", fields_[f].ofNodes ? "node" : "element"}});
    return json;
  }

  nlohmann::json state(const Results& results, int step, double pathLength) const {
    nlohmann::json json{{"path_length", pathLength},
                        {"load_factor", results.loadFactor(step)},
                        {"displacement", atrapos::base64(displacement(results, step))},
                        {"fields", nlohmann::json::array()}};
    for (std::size_t f = 0; f < room_.fields; ++f) {
      const auto all =
          fields_[f].ofNodes ? results.nodal(step, fields_[f].name) : results.element(step, fields_[f].name);
      std::vector<float> values;
      if (fields_[f].ofNodes)
        for (const int node : surface_.nodes) values.push_back(static_cast<float>(all[node]));
      else
        values.assign(all.begin(), all.end());
      json["fields"].push_back(atrapos::base64(values));
    }
    return json;
  }

 private:
  /// From the first file's mesh: that of an imperfect body lies beside it.
  std::vector<float> displacement(const Results& results, int step) const {
    std::vector<float> u(3 * surface_.nodes.size());
    const auto& theirs = results.mesh().coordinates;
    for (int c = 0; c < 3; ++c) {
      const bool flat = !moves_ || (c == 2 && mesh_.dimension == 2);
      const auto all =
          flat ? std::vector<double>(mesh_.numNodes(), 0.0) : results.nodal(step, kDisplacements[c]);
      for (std::size_t n = 0; n < surface_.nodes.size(); ++n) {
        const std::size_t at = 3 * static_cast<std::size_t>(surface_.nodes[n]) + c;
        u[3 * n + c] = static_cast<float>(all[surface_.nodes[n]] + theirs[at] - mesh_.coordinates[at]);
      }
    }
    return u;
  }

  const fem::Mesh& mesh_;
  Surface surface_;
  std::vector<Field> fields_;
  bool moves_;  ///< whether there are displacements
  Room room_;
};

/// A file of the same body and fields.
bool isLike(const Results& a, const Results& b) {
  return a.mesh().coordinates.size() == b.mesh().coordinates.size() &&
         a.mesh().numElements() == b.mesh().numElements() && a.nodalNames() == b.nodalNames() &&
         a.elementNames() == b.elementNames();
}

/// Bytes of the tools' surfaces.
std::size_t bytesOf(const nlohmann::json& surfaces) {
  std::size_t bytes = 0;
  for (const auto& surface : surfaces)
    bytes += surface.at("positions").get_ref<const std::string&>().size() +
             surface.at("triangles").get_ref<const std::string&>().size();
  return bytes;
}

}  // namespace

std::string base64(const std::vector<float>& values) {
  return base64(values.data(), values.size() * sizeof values[0]);
}

std::string base64(const std::vector<std::uint32_t>& values) {
  return base64(values.data(), values.size() * sizeof values[0]);
}

std::vector<std::size_t> evenly(std::size_t count, std::size_t most) {
  std::vector<std::size_t> places;
  const std::size_t taken = std::min(count, most);
  for (std::size_t i = 0; i < taken; ++i)
    places.push_back(taken == 1 ? count - 1 : (i * (count - 1) + (taken - 1) / 2) / (taken - 1));
  return places;
}

nlohmann::json shapeOf(const std::vector<ShapeFile>& files, std::size_t bytes,
                       std::vector<std::string>& notes) {
  std::vector<std::pair<const ShapeFile*, Results>> all;
  std::size_t states = 0;
  for (const ShapeFile& file : files) {
    if (!Results::isThere(file.file)) continue;
    Results results(file.file);
    if (results.numSteps() == 0 || (!hasDisplacements(results) && fieldsOf(results).empty())) continue;
    if (!all.empty() && !isLike(all.front().second, results)) {
      notes.push_back(fmt::format("{} is not shown in space: its results are on another mesh", file.name));
      continue;
    }
    states += results.numSteps();
    all.emplace_back(&file, std::move(results));
  }
  if (all.empty()) return nullptr;
  const Shape shape(all.front().second, bytes, states);
  const Room& room = shape.room();
  if (room.states < all.size()) {
    notes.push_back(
        "the deformed shape is left out: its surface is too large for a page (see it in ParaView)");
    return nullptr;
  }
  if (room.fields < shape.numFields())
    notes.push_back(
        fmt::format("the deformed shape shows the first {} of {} fields", room.fields, shape.numFields()));
  if (room.states < states)
    notes.push_back(fmt::format("the deformed shape shows {} of {} states", room.states, states));
  nlohmann::json json = shape.body();
  for (const auto& [file, results] : all) {
    nlohmann::json branch{
        {"number", file->branch}, {"name", file->name}, {"states", nlohmann::json::array()}};
    const auto times = results.times();
    auto tools = ReportTools::of(file->tools, results.numSteps());
    // The same tools on every branch: what differs is where they are.
    if (tools && !json.contains("tools")) {
      auto surfaces = tools->surfaces();
      if (bytesOf(surfaces) > bytes / 3) {
        surfaces = nullptr;
        notes.push_back("tools are not shown: their surfaces are too large for a page");
      }
      json["tools"] = std::move(surfaces);
    }
    if (tools && json.at("tools").is_null()) tools = nullptr;
    const std::size_t own = std::max<std::size_t>(1, room.states * times.size() / states);
    for (const std::size_t step : evenly(times.size(), own)) {
      branch["states"].push_back(shape.state(results, static_cast<int>(step), times[step]));
      if (tools) branch["states"].back()["tools"] = tools->motions(static_cast<int>(step));
    }
    json["branches"].push_back(std::move(branch));
  }
  return json;
}

}  // namespace atrapos
