#include "atrapos/exodus/ResultWriter.hpp"

#include <cmath>
#include <optional>
#include <set>

#include "File.hpp"
#include "FileCheck.hpp"
#include "MeshWriter.hpp"

namespace atrapos::exodus {

namespace {

constexpr std::size_t maxName = 255;  // NetCDF: NC_MAX_NAME less the final zero

void checkNames(const std::vector<std::string>& names, const std::string& kind, const std::string& file) {
  std::set<std::string> seen;
  for (const std::string& name : names) {
    if (name.empty()) throw Error(file + ": a " + kind + " variable has an empty name");
    if (name.size() > maxName)
      throw Error(file + ": " + kind + " variable '" + name + "' has more than 255 characters");
    if (!seen.insert(name).second)
      throw Error(file + ": two " + kind + " variables are named '" + name + "'");
  }
}

void defineVariables(const File& file, ex_entity_type type, const std::vector<std::string>& names) {
  if (names.empty()) return;
  const int count = static_cast<int>(names.size());
  file.check(ex_put_variable_param(file.id(), type, count), "defining variables");
  Strings rows(names);
  file.check(ex_put_variable_names(file.id(), type, count, rows.data()), "writing the names of variables");
}

}  // namespace

struct ResultWriter::Impl {
  struct BlockSize {
    long long id;
    std::size_t count;
  };

  Impl(const std::string& name, const fem::Mesh& mesh, const ResultNames& names, const MeshPart* part)
      : numNodal(names.nodal.size()),
        numElement(names.element.size()),
        numGlobal(names.global.size()),
        numNodes(static_cast<std::size_t>(mesh.numNodes())),
        numElements(static_cast<std::size_t>(mesh.numElements())) {
    FileContents contents{mesh, names.qa, names.info, 0, {}, part};
    for (const auto& [list, kind] :
         {std::make_pair(&names.nodal, "nodal"), std::make_pair(&names.element, "element"),
          std::make_pair(&names.global, "global")}) {
      checkNames(*list, kind, name);
      for (const std::string& variable : *list)
        contents.longestName = std::max(contents.longestName, variable.size());
    }
    for (const fem::Block& block : mesh.blocks)
      blocks.push_back({block.id, block.nodes.size() / fem::nodesPerElement(block.topology)});
    contents.more = [&](const File& created) {
      defineVariables(created, EX_GLOBAL, names.global);
      // The library has no variables on nothing.
      if (numNodes > 0) defineVariables(created, EX_NODAL, names.nodal);
      if (numElements == 0 || numElement == 0) return;
      defineVariables(created, EX_ELEM_BLOCK, names.element);
      writeTruthTable(created);
    };
    file.emplace(createFile(name, contents));
  }

  /// All element variables on all blocks that have elements.
  void writeTruthTable(const File& created) const {
    std::vector<int> table;
    for (const BlockSize& block : blocks) table.insert(table.end(), numElement, block.count > 0 ? 1 : 0);
    created.check(ex_put_truth_table(created.id(), EX_ELEM_BLOCK, static_cast<int>(blocks.size()),
                                     static_cast<int>(numElement), table.data()),
                  "writing the truth table");
  }

  void checkStep(double newTime, ConstSpan nodal, ConstSpan element, ConstSpan global) const {
    const std::string at = file->name() + ": step " + std::to_string(step + 1) + ": ";
    if (!std::isfinite(newTime)) throw Error(at + "the time is not a finite number");
    if (step > 0 && !(newTime > time))
      throw Error(at + "time must ascend, but " + std::to_string(newTime) + " follows " +
                  std::to_string(time));
    const auto checkSize = [&](ConstSpan values, std::size_t expected, const char* kind) {
      if (values.size != expected)
        throw Error(at + std::to_string(expected) + " " + kind + " values are needed, got " +
                    std::to_string(values.size));
    };
    checkSize(nodal, numNodal * numNodes, "nodal");
    checkSize(element, numElement * numElements, "element");
    checkSize(global, numGlobal, "global");
  }

  void write(double newTime, ConstSpan nodal, ConstSpan element, ConstSpan global) {
    checkStep(newTime, nodal, element, global);
    try {
      put(newTime, nodal, element, global);
    } catch (const Error&) {
      const std::string name = file->name();
      file.reset();  // nothing more can be written
      cutRecords(name, static_cast<std::uint32_t>(step));
      throw;
    }
    ++step;
    time = newTime;
  }

  void put(double newTime, ConstSpan nodal, ConstSpan element, ConstSpan global) const {
    const int number = step + 1;
    const std::string doing = "writing step " + std::to_string(number);
    file->check(ex_put_time(file->id(), number, &newTime), doing);
    if (numGlobal > 0)
      file->check(
          ex_put_var(file->id(), number, EX_GLOBAL, 1, 0, static_cast<int64_t>(numGlobal), global.data),
          doing);
    for (std::size_t v = 0; v < numNodal && numNodes > 0; ++v)
      file->check(ex_put_var(file->id(), number, EX_NODAL, static_cast<int>(v) + 1, 1,
                             static_cast<int64_t>(numNodes), nodal.data + v * numNodes),
                  doing);
    for (std::size_t v = 0; v < numElement; ++v) {
      const double* values = element.data + v * numElements;
      for (const BlockSize& block : blocks) {
        if (block.count == 0) continue;
        file->check(ex_put_var(file->id(), number, EX_ELEM_BLOCK, static_cast<int>(v) + 1, block.id,
                               static_cast<int64_t>(block.count), values),
                    doing);
        values += block.count;
      }
    }
    file->check(ex_update(file->id()), doing);
  }

  std::size_t numNodal, numElement, numGlobal, numNodes, numElements;
  std::vector<BlockSize> blocks;
  std::optional<File> file;
  int step = 0;
  double time = 0.0;
};

ResultWriter::ResultWriter(const std::string& file, const fem::Mesh& mesh, const ResultNames& names)
    : impl_(std::make_unique<Impl>(file, mesh, names, nullptr)) {}
ResultWriter::ResultWriter(const std::string& file, const MeshPart& part, const ResultNames& names)
    : impl_(std::make_unique<Impl>(partName(file, part.parts, part.part), part.mesh, names, &part)) {}
ResultWriter::~ResultWriter() = default;
ResultWriter::ResultWriter(ResultWriter&&) noexcept = default;
ResultWriter& ResultWriter::operator=(ResultWriter&&) noexcept = default;

void ResultWriter::writeStep(double time, ConstSpan nodal, ConstSpan element, ConstSpan global) {
  if (!impl_->file) throw Error("a result file is written to again after it could not be");
  impl_->write(time, nodal, element, global);
}

void ResultWriter::moved(const std::string& file) { impl_->file->rename(file); }

int ResultWriter::numSteps() const { return impl_->step; }

}  // namespace atrapos::exodus
