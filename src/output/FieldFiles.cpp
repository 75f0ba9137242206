#include "output/FieldFiles.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <unordered_map>

#include "atrapos/exodus/Decomposition.hpp"
#include "atrapos/exodus/JoinedResults.hpp"
#include "atrapos/exodus/ResultReader.hpp"
#include "atrapos/exodus/ResultWriter.hpp"
#include "machine/OutputFile.hpp"
#include "machine/Ranks.hpp"
#include "output/Files.hpp"
#include "scene/ResultFields.hpp"

namespace atrapos {
namespace {

const std::vector<std::string> kGlobals = {"load_factor",   "path_parameter",  "series_radius",
                                           "series_order",  "negative_pivots", "active_contacts",
                                           "residual_norm", "branch"};

using Fields = std::vector<std::vector<double>>;

std::vector<double> flat(const Fields& variables) {
  std::vector<double> all;
  for (const auto& v : variables) all.insert(all.end(), v.begin(), v.end());
  return all;
}

std::vector<double> flat(const Fields& variables, const std::vector<int>& places) {
  std::vector<double> all;
  for (const auto& v : variables)
    for (const int i : places) all.push_back(v[i]);
  return all;
}

/// [wanted] position of its id; ids that are left out are 1, 2, ...
std::vector<int> placesOf(const std::vector<long long>& wanted, const std::vector<long long>& had,
                          std::size_t count, const std::string& file) {
  std::unordered_map<long long, int> place;
  const auto id = [](const std::vector<long long>& ids, std::size_t i) {
    return ids.empty() ? static_cast<long long>(i) + 1 : ids[i];
  };
  const std::size_t own = had.empty() ? count : had.size();
  for (std::size_t i = 0; i < own; ++i) place[id(had, i)] = static_cast<int>(i);
  std::vector<int> places;
  for (std::size_t i = 0; i < count; ++i) {
    const auto found = place.find(id(wanted, i));
    if (found == place.end() || own != count)
      throw std::invalid_argument(fmt::format("{}: holds results on another mesh", file));
    places.push_back(found->second);
  }
  return places;
}

std::vector<double> reordered(const std::vector<double>& values, const std::vector<int>& places) {
  std::vector<double> result;
  for (const int i : places) result.push_back(values[i]);
  return result;
}

class SceneFields final : public FieldFile {
 public:
  SceneFields(const Scene& scene, const std::string& file)
      : scene_(scene), file_(file), names_(names(scene)) {
    if (writesParts(scene.deck())) {
      const exodus::Decomposition cut(scene.resultMesh(), scene.elementRanks(), ranks::count());
      nodes_ = cut.nodes(ranks::own());
      elements_ = cut.elements(ranks::own());
      writer_.emplace(file, cut.part(ranks::own()), names_);
    } else if (ranks::isFirst()) {
      writer_.emplace(file, scene.resultMesh(), names_);
    }
  }

  void write(const CaseState& state, const StateNumbers& n) override {
    const SceneState& of = dynamic_cast<const SceneCaseState&>(state).state();
    const ResultFields fields(scene_);
    const auto nodal = fields.nodalValues(of), element = fields.elementValues(of);
    const double active = state.activeContacts();
    writeStep(n.pathLength, nodal, element,
              {n.lambda, n.pathLength, n.radius, double(n.order), double(n.negative), active, n.residual,
               double(n.branch)});
    if (writesParts(scene_.deck())) ranks::wait();  // a step is on disk when all parts are
  }

  Mark mark() const override { return mark_; }

  void sync() const override {
    if (writer_) syncFile(ownName(file_));
  }

  void copyFrom(const std::string& file, int count, double pathLength, const Mark& mark) override {
    copyStates(file, count, pathLength);
    if (writer_ && !(mark_ == mark))
      throw std::invalid_argument(
          fmt::format("{}: its states were changed; expected the file as the run left it", file));
  }

  void rename(const std::string& file) override {
    if (writer_) {
      renameFile(ownName(file_), ownName(file));
      writer_->moved(ownName(file));
    }
    file_ = file;
  }

 private:
  void copyStates(const std::string& file, int count, double pathLength) {
    if (std::filesystem::exists(file)) {
      const exodus::ResultReader reader(file);
      copy(file, reader, reader.nodalNames(), reader.elementNames(), reader.globalNames(),
           {count, pathLength}, {}, {});
      return;
    }
    const std::vector<int> parts = exodus::findParts(file);
    if (parts.size() != 1)
      throw std::invalid_argument(fmt::format(
          "{}: {}", file,
          parts.empty() ? "does not exist, nor are there parts of it" : "there are parts of several runs"));
    const exodus::JoinedResults reader(file, parts.front());
    const fem::Mesh &own = scene_.resultMesh(), &theirs = reader.joined().mesh;
    const exodus::ResultNames names = reader.names();
    copy(file, reader, names.nodal, names.element, names.global, {count, pathLength},
         placesOf(own.nodeIds, theirs.nodeIds, own.numNodes(), file),
         placesOf(own.elementIds, theirs.elementIds, own.numElements(), file));
  }

  static exodus::ResultNames names(const Scene& scene) {
    const ResultFields fields(scene);
    exodus::ResultNames names;
    names.nodal = fields.nodalNames();
    names.element = fields.elementNames();
    names.global = kGlobals;
    std::istringstream deck(scene.deck().text);
    for (std::string line; std::getline(deck, line);) names.info.push_back(line);
    return names;
  }

  /// The file that this rank writes.
  std::string ownName(const std::string& file) const {
    return writesParts(scene_.deck()) ? exodus::partName(file, ranks::count(), ranks::own()) : file;
  }

  void writeStep(double time, const Fields& nodal, const Fields& element, const std::vector<double>& global) {
    if (!writer_) return;
    // Exodus wants times that ascend: a step may be shorter than the rounding of the path's length.
    if (!(time > lastTime_)) time = std::nextafter(lastTime_, std::numeric_limits<double>::infinity());
    lastTime_ = time;
    digest_.add(&time, 1);
    for (const Fields* const fields : {&nodal, &element})
      for (const auto& values : *fields) digest_.add(values);
    digest_.add(global);
    mark_ = {mark_.count + 1, digest_.value()};
    if (writesParts(scene_.deck()))
      writer_->writeStep(time, flat(nodal, nodes_), flat(element, elements_), global);
    else
      writer_->writeStep(time, flat(nodal), flat(element), global);
  }

  /// States up to a length of the path.
  struct Wanted {
    int count;
    double pathLength;
  };

  template <class Reader>
  void copy(const std::string& file, const Reader& reader, const std::vector<std::string>& nodalNames,
            const std::vector<std::string>& elementNames, const std::vector<std::string>& globalNames,
            Wanted wanted, const std::vector<int>& nodes, const std::vector<int>& elements) {
    if (nodalNames != names_.nodal || elementNames != names_.element || globalNames != names_.global)
      throw std::invalid_argument(fmt::format("{}: holds other fields than output/fields asks for", file));
    const int count = wanted.count;
    if (reader.numSteps() < count)
      throw std::invalid_argument(
          fmt::format("{}: holds {} states, {} are needed", file, reader.numSteps(), count));
    const auto times = reader.times();
    constexpr double rounding = 1e-12;  // far below a step
    if (times[count - 1] > wanted.pathLength * (1 + rounding) ||
        (reader.numSteps() > count && times[count] < wanted.pathLength * (1 - rounding)))
      throw std::invalid_argument(
          fmt::format("{}: holds states of other steps than output/fields_every asks for", file));
    if (!writer_) return;
    const auto inOrder = [](const std::vector<double>& values, const std::vector<int>& places) {
      return places.empty() ? values : reordered(values, places);
    };
    for (int step = 0; step < count; ++step) {
      Fields nodal, element;
      for (const auto& name : names_.nodal) nodal.push_back(inOrder(reader.nodal(step, name), nodes));
      for (const auto& name : names_.element)
        element.push_back(inOrder(reader.element(step, name), elements));
      writeStep(times[step], nodal, element, reader.globals(step));
    }
  }

  const Scene& scene_;
  std::string file_;  ///< without a part's numbers
  exodus::ResultNames names_;
  std::vector<int> nodes_, elements_;                           ///< of this rank's part in the result mesh
  std::optional<exodus::ResultWriter> writer_;                  ///< of the first rank, or of each
  double lastTime_ = -std::numeric_limits<double>::infinity();  ///< written last
  Digest digest_;
  Mark mark_;
};

struct ResultFile {
  std::filesystem::path path;
  int branch = 0;
  int parts = 0;  ///< that it is one of; 0: the whole
};

std::vector<ResultFile> resultFiles(const std::string& folder) {
  std::vector<ResultFile> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::string whole = entry.path().filename().string();
    int parts = 0;
    try {
      const exodus::PartName name = exodus::parsePartName(whole);
      whole = name.file;
      parts = name.parts;
    } catch (const exodus::Error&) {  // no part
    }
    if (const auto branch = branchOfFields(whole)) files.push_back({entry.path(), *branch, parts});
  }
  return files;
}

}  // namespace

std::string fieldsName(int branch) {
  return branch == 0 ? "results.exo" : fmt::format("results_branch{}.exo", branch);
}

bool writesParts(const deck::Deck& deck) { return deck.output.parts && ranks::count() > 1; }

std::unique_ptr<FieldFile> makeSceneFields(const Scene& scene, const std::string& file) {
  return std::make_unique<SceneFields>(scene, file);
}

void removeOtherFields(const std::string& folder, int last, const deck::Deck& deck) {
  const int own = writesParts(deck) ? ranks::count() : 0;
  for (const ResultFile& file : resultFiles(folder))
    if (file.branch > last || (file.branch == last && file.parts != own)) removeFile(file.path);
}

void copyFields(const std::string& from, const std::string& to, int last) {
  for (const ResultFile& file : resultFiles(from))
    if (file.branch <= last)
      std::filesystem::copy_file(file.path, std::filesystem::path(to) / file.path.filename(),
                                 std::filesystem::copy_options::overwrite_existing);
}

}  // namespace atrapos
