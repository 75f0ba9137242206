#include "MeshWriter.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <filesystem>

#include "CheckMesh.hpp"
#include "ElementTypes.hpp"
#include "FileCheck.hpp"
#include "PartRecords.hpp"
#include "atrapos/exodus/InfoRecords.hpp"
#include "atrapos/exodus/MeshFile.hpp"

namespace atrapos::exodus {

namespace {

QaRecord ownRecord() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  std::array<char, 16> date{}, time{};
  std::strftime(date.data(), date.size(), "%Y/%m/%d", &local);
  std::strftime(time.data(), time.size(), "%H:%M:%S", &local);
  return {"Atrapos", ATRAPOS_VERSION, date.data(), time.data()};
}

class MeshWriter {
 public:
  MeshWriter(const File& file, const FileContents& contents)
      : file_(file), mesh_(contents.mesh), contents_(contents) {}

  void operator()() const {
    setNameLength();
    ex_init_params init{};
    std::copy(mesh_.title.begin(), mesh_.title.end(), init.title);
    init.num_dim = mesh_.dimension;
    init.num_nodes = mesh_.numNodes();
    init.num_elem = mesh_.numElements();
    init.num_elem_blk = static_cast<int64_t>(mesh_.blocks.size());
    init.num_node_sets = static_cast<int64_t>(mesh_.nodeSets.size());
    init.num_side_sets = static_cast<int64_t>(mesh_.sideSets.size());
    file_.check(ex_put_init_ext(file_.id(), &init), "writing the sizes");
    writeRecords();
    writeIds(EX_NODE_MAP, mesh_.nodeIds);
    writeIds(EX_ELEM_MAP, mesh_.elementIds);
    if (contents_.part) definePart(file_, *contents_.part);
    // Definitions first: each one that comes after data makes NetCDF move all of them.
    for (const fem::Block& block : mesh_.blocks) defineBlock(block);
    writeSets();
    if (contents_.more) contents_.more(file_);
    writeNames(EX_ELEM_BLOCK, mesh_.blocks);
    writeNames(EX_NODE_SET, mesh_.nodeSets);
    writeNames(EX_SIDE_SET, mesh_.sideSets);
    writeCoordinates();
    for (const fem::Block& block : mesh_.blocks) writeBlock(block);
    if (contents_.part) writePartMaps(file_, *contents_.part);
  }

 private:
  void setNameLength() const {
    std::size_t longest = std::max<std::size_t>(MAX_NAME_LENGTH, contents_.longestName);
    for (const fem::Block& block : mesh_.blocks) {
      longest = std::max(longest, block.name.size());
      for (const std::string& name : block.attributeNames) longest = std::max(longest, name.size());
    }
    for (const fem::NodeSet& set : mesh_.nodeSets) longest = std::max(longest, set.name.size());
    for (const fem::SideSet& set : mesh_.sideSets) longest = std::max(longest, set.name.size());
    file_.check(ex_set_max_name_length(file_.id(), static_cast<int>(longest)), "setting the length of names");
  }

  void writeRecords() const {
    std::vector<QaRecord> records = contents_.qa;
    records.push_back(ownRecord());
    std::vector<std::string> texts;
    for (const QaRecord& r : records)
      for (const std::string* text : {&r.code, &r.version, &r.date, &r.time}) {
        if (text->size() > MAX_STR_LENGTH)
          throw Error(file_.name() + ": QA entry '" + *text + "' has more than 32 characters");
        texts.push_back(*text);
      }
    Strings rows(texts);
    file_.check(
        ex_put_qa(file_.id(), static_cast<int>(records.size()), reinterpret_cast<char*(*)[4]>(rows.data())),
        "writing the QA records");
    const auto info = toInfoRecords(contents_.info);
    if (info.empty()) return;
    Strings lines(info);
    file_.check(ex_put_info(file_.id(), static_cast<int>(info.size()), lines.data()),
                "writing the info records");
  }

  void writeCoordinates() const {
    const auto n = static_cast<std::size_t>(mesh_.numNodes());
    if (n == 0) return;
    std::array<std::vector<double>, 3> x;
    for (std::size_t d = 0; d < 3; ++d) {
      x[d].resize(n);
      for (std::size_t i = 0; i < n; ++i) x[d][i] = mesh_.coordinates[3 * i + d];
    }
    const bool plane = mesh_.dimension == 2;
    file_.check(ex_put_coord(file_.id(), x[0].data(), x[1].data(), plane ? nullptr : x[2].data()),
                "writing the coordinates");
    Strings names(plane ? std::vector<std::string>{"x", "y"} : std::vector<std::string>{"x", "y", "z"});
    file_.check(ex_put_coord_names(file_.id(), names.data()), "writing the names of the coordinates");
  }

  void defineBlock(const fem::Block& block) const {
    const int perElement = fem::nodesPerElement(block.topology);
    const auto count = static_cast<int64_t>(block.nodes.size()) / perElement;
    file_.check(ex_put_block(file_.id(), EX_ELEM_BLOCK, block.id, elementType(block.topology), count,
                             perElement, 0, 0, static_cast<int64_t>(block.attributeNames.size())),
                "defining block '" + block.name + "'");
  }

  void writeBlock(const fem::Block& block) const {
    if (block.nodes.empty()) return;
    const std::string owner = "writing block '" + block.name + "'";
    const auto nodes = oneBased(block.nodes);
    file_.check(ex_put_conn(file_.id(), EX_ELEM_BLOCK, block.id, nodes.data(), nullptr, nullptr), owner);
    if (block.attributeNames.empty()) return;
    file_.check(ex_put_attr(file_.id(), EX_ELEM_BLOCK, block.id, block.attributes.data()), owner);
    Strings names(block.attributeNames);
    file_.check(ex_put_attr_names(file_.id(), EX_ELEM_BLOCK, block.id, names.data()), owner);
  }

  // All in one call, which defines all sets before it writes them.
  void writeSets() const {
    std::vector<std::vector<int64_t>> lists;
    std::vector<ex_set> sets;
    lists.reserve(mesh_.nodeSets.size() + 2 * mesh_.sideSets.size());  // the sets point into it
    for (const fem::NodeSet& set : mesh_.nodeSets) {
      lists.push_back(oneBased(set.nodes));
      // The library writes factors where there is a pointer to some; it does not change them.
      void* factors = set.factors.empty() ? nullptr : const_cast<double*>(set.factors.data());
      sets.push_back({set.id, EX_NODE_SET, static_cast<int64_t>(set.nodes.size()),
                      static_cast<int64_t>(set.factors.size()), lists.back().data(), nullptr, factors});
    }
    for (const fem::SideSet& set : mesh_.sideSets) {
      std::vector<int64_t> elements, sides;
      for (const fem::Side& side : set.sides) {
        elements.push_back(side.element + int64_t{1});
        sides.push_back(side.side + int64_t{1});
      }
      lists.push_back(std::move(elements));
      lists.push_back(std::move(sides));
      sets.push_back({set.id, EX_SIDE_SET, static_cast<int64_t>(set.sides.size()), 0,
                      lists[lists.size() - 2].data(), lists.back().data(), nullptr});
    }
    if (!sets.empty()) file_.check(ex_put_sets(file_.id(), sets.size(), sets.data()), "writing the sets");
  }

  template <class Items>
  void writeNames(ex_entity_type type, const Items& items) const {
    if (items.empty()) return;
    std::vector<std::string> names;
    for (const auto& item : items) names.push_back(item.name);
    Strings rows(names);
    file_.check(ex_put_names(file_.id(), type, rows.data()), "writing the names of blocks and sets");
  }

  void writeIds(ex_entity_type type, const std::vector<long long>& ids) const {
    if (ids.empty()) return;
    const std::vector<int64_t> map(ids.begin(), ids.end());
    file_.check(ex_put_id_map(file_.id(), type, map.data()), "writing the node and element ids");
  }

  static std::vector<int64_t> oneBased(const std::vector<int>& numbers) {
    std::vector<int64_t> result(numbers.begin(), numbers.end());
    for (int64_t& n : result) ++n;
    return result;
  }

  const File& file_;
  const fem::Mesh& mesh_;
  const FileContents& contents_;
};

/// Tells whether what the library wrote into a file reached the disk. A descriptor of its own, opened while
/// NetCDF has the file: the system tells each descriptor of an error once, and NetCDF keeps to itself what it
/// hears when it closes its own.
class DiskCheck {
 public:
  /// Messages speak of the file as `shown`.
  DiskCheck(const std::string& path, std::string shown)
      : shown_(std::move(shown)), descriptor_(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (descriptor_ < 0) fail();
  }
  DiskCheck(const DiskCheck&) = delete;
  DiskCheck& operator=(const DiskCheck&) = delete;
  ~DiskCheck() { close(descriptor_); }

  /// Throws Error.
  void operator()() const {
    // File systems without fsync have nothing that outlasts anything.
    if (fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) fail();
  }

 private:
  [[noreturn]] void fail() const {
    throw Error(shown_ + ": the file cannot be written (" + std::strerror(errno) + ")");
  }

  std::string shown_;
  int descriptor_;
};

/// A file that disappears unless it is moved to its place.
class Draft {
 public:
  explicit Draft(const std::string& target)
      : target_(target), path_(target + ".part" + std::to_string(getpid())) {
    std::error_code notThere;
    const auto status = std::filesystem::status(target, notThere);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
      throw Error(target + ": is no regular file, and is not replaced");
  }
  Draft(const Draft&) = delete;
  Draft& operator=(const Draft&) = delete;
  ~Draft() {
    std::error_code ignored;  // nothing more can be done about it here
    if (!path_.empty()) std::filesystem::remove(path_, ignored);
  }

  const std::string& path() const { return path_; }

  void moveToTarget() {
    std::error_code error;
    std::filesystem::rename(path_, target_, error);
    if (error) throw Error(target_ + ": the file cannot be put in its place (" + error.message() + ")");
    path_.clear();
  }

 private:
  std::string target_, path_;
};

/// Makes the file under a name of its own; `last(path, file)` is the last that happens to it before it gets
/// `name`.
template <class Last>
File makeFile(const std::string& name, const FileContents& contents, const Last& last) {
  checkMesh(contents.mesh, name, contents.part ? Extent::part : Extent::whole);
  Draft draft(name);
  File file = File::create(draft.path(), name);
  MeshWriter(file, contents)();
  file.check(ex_update(file.id()), "writing the mesh");
  padFile(draft.path());
  last(draft.path(), file);
  draft.moveToTarget();
  return file;
}

/// A file without results, closed and on the disk before it has its name.
void makeClosed(const std::string& name, const FileContents& contents) {
  makeFile(name, contents, [&](const std::string& path, File& file) {
    const DiskCheck checkDisk(path, name);
    file.close();
    checkDisk();
  });
}

}  // namespace

File createFile(const std::string& name, const FileContents& contents) {
  return makeFile(name, contents, [](const std::string&, File&) {});
}

void writeMesh(const fem::Mesh& mesh, const std::string& file) { makeClosed(file, {mesh, {}, {}, 0, {}}); }

void writePart(const MeshPart& part, const std::string& file) {
  makeClosed(partName(file, part.parts, part.part), {part.mesh, {}, {}, 0, {}, &part});
}

}  // namespace atrapos::exodus
