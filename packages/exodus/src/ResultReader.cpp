#include "atrapos/exodus/ResultReader.hpp"

#include <algorithm>
#include <limits>

#include "File.hpp"
#include "atrapos/exodus/InfoRecords.hpp"

namespace atrapos::exodus {

struct ResultReader::Impl {
  explicit Impl(const std::string& name) : file(File::open(name)) {
    ex_init_params init{};
    file.check(ex_get_init_ext(file.id(), &init), "reading the sizes");
    numNodes = static_cast<std::size_t>(init.num_nodes);
    numSteps = countSteps();
    nodal = names(EX_NODAL);
    element = names(EX_ELEM_BLOCK);
    global = names(EX_GLOBAL);
    blockIds.resize(static_cast<std::size_t>(init.num_elem_blk));
    if (!blockIds.empty())
      file.check(ex_get_ids(file.id(), EX_ELEM_BLOCK, blockIds.data()), "reading the ids of the blocks");
  }

  /// The library has a negative number where the file has no dimension of times, as meshes of other programs
  /// have none.
  int countSteps() const {
    const int64_t count = ex_inquire_int(file.id(), EX_INQ_TIME);
    if (count > std::numeric_limits<int>::max())
      throw Error(file.name() + ": has " + std::to_string(count) + " states, too many to be counted");
    return count < 0 ? 0 : static_cast<int>(count);
  }

  std::vector<std::string> names(ex_entity_type type) const {
    int count = 0;
    file.check(ex_get_variable_param(file.id(), type, &count), "reading the number of variables");
    if (count <= 0) return {};
    Strings rows(static_cast<std::size_t>(count),
                 static_cast<std::size_t>(ex_inquire_int(file.id(), EX_INQ_MAX_READ_NAME_LENGTH)));
    file.check(ex_get_variable_names(file.id(), type, count, rows.data()), "reading the names of variables");
    return rows.get();
  }

  /// The library's number, from 1, of a step.
  int number(int step) const {
    if (step < 0 || step >= numSteps)
      throw Error(file.name() + ": there is no step " + std::to_string(step) + "; the file has " +
                  std::to_string(numSteps) + " counted from 0");
    return step + 1;
  }

  /// Position of a variable.
  std::size_t find(const std::vector<std::string>& list, const std::string& name, const char* kind) const {
    const auto it = std::find(list.begin(), list.end(), name);
    if (it == list.end()) throw Error(file.name() + ": there is no " + kind + " variable '" + name + "'");
    return static_cast<std::size_t>(it - list.begin());
  }

  File file;
  std::size_t numNodes = 0;
  int numSteps = 0;
  std::vector<std::string> nodal, element, global;
  std::vector<int64_t> blockIds;
};

ResultReader::ResultReader(const std::string& file) : impl_(std::make_unique<Impl>(file)) {}
ResultReader::~ResultReader() = default;
ResultReader::ResultReader(ResultReader&&) noexcept = default;
ResultReader& ResultReader::operator=(ResultReader&&) noexcept = default;

int ResultReader::numSteps() const { return impl_->numSteps; }

std::vector<double> ResultReader::times() const {
  std::vector<double> values(static_cast<std::size_t>(impl_->numSteps));
  if (!values.empty())
    impl_->file.check(ex_get_all_times(impl_->file.id(), values.data()), "reading the times");
  return values;
}

const std::vector<std::string>& ResultReader::nodalNames() const { return impl_->nodal; }
const std::vector<std::string>& ResultReader::elementNames() const { return impl_->element; }
const std::vector<std::string>& ResultReader::globalNames() const { return impl_->global; }

std::vector<double> ResultReader::nodal(int step, const std::string& name) const {
  const File& file = impl_->file;
  const int number = impl_->number(step);
  const auto variable = impl_->find(impl_->nodal, name, "nodal");
  std::vector<double> values(impl_->numNodes);
  if (values.empty()) return values;  // a part without nodes
  file.check(ex_get_var(file.id(), number, EX_NODAL, static_cast<int>(variable) + 1, 1,
                        static_cast<int64_t>(values.size()), values.data()),
             "reading nodal variable '" + name + "'");
  return values;
}

std::vector<double> ResultReader::element(int step, const std::string& name) const {
  const File& file = impl_->file;
  const int number = impl_->number(step);
  const auto variable = impl_->find(impl_->element, name, "element");
  std::vector<double> values;
  for (int64_t id : impl_->blockIds) {
    ex_block param{};
    param.id = id;
    param.type = EX_ELEM_BLOCK;
    file.check(ex_get_block_param(file.id(), &param), "reading block " + std::to_string(id));
    if (param.num_entry <= 0) continue;
    std::vector<int> defined(impl_->element.size());
    file.check(ex_get_object_truth_vector(file.id(), EX_ELEM_BLOCK, id, static_cast<int>(defined.size()),
                                          defined.data()),
               "reading the truth table");
    if (defined[variable] == 0)
      throw Error(file.name() + ": block " + std::to_string(id) + " has no element variable '" + name + "'");
    const std::size_t first = values.size();
    values.resize(first + static_cast<std::size_t>(param.num_entry));
    file.check(ex_get_var(file.id(), number, EX_ELEM_BLOCK, static_cast<int>(variable) + 1, id,
                          param.num_entry, values.data() + first),
               "reading element variable '" + name + "'");
  }
  return values;
}

std::vector<double> ResultReader::globals(int step) const {
  const int number = impl_->number(step);
  std::vector<double> values(impl_->global.size());
  if (!values.empty())
    impl_->file.check(ex_get_var(impl_->file.id(), number, EX_GLOBAL, 1, 0,
                                 static_cast<int64_t>(values.size()), values.data()),
                      "reading the global variables");
  return values;
}

double ResultReader::global(int step, const std::string& name) const {
  const auto variable = impl_->find(impl_->global, name, "global");
  return globals(step)[variable];
}

std::vector<std::string> ResultReader::info() const {
  const File& file = impl_->file;
  const auto count = ex_inquire_int(file.id(), EX_INQ_INFO);
  if (count <= 0) return {};
  Strings rows(static_cast<std::size_t>(count), MAX_LINE_LENGTH);
  file.check(ex_get_info(file.id(), rows.data()), "reading the info records");
  return fromInfoRecords(rows.get());
}

std::vector<QaRecord> ResultReader::qa() const {
  const File& file = impl_->file;
  const auto count = ex_inquire_int(file.id(), EX_INQ_QA);
  if (count <= 0) return {};
  Strings rows(4 * static_cast<std::size_t>(count), MAX_STR_LENGTH);
  file.check(ex_get_qa(file.id(), reinterpret_cast<char*(*)[4]>(rows.data())), "reading the QA records");
  const auto texts = rows.get();
  std::vector<QaRecord> records;
  for (std::size_t i = 0; i < texts.size(); i += 4)
    records.push_back({texts[i], texts[i + 1], texts[i + 2], texts[i + 3]});
  return records;
}

}  // namespace atrapos::exodus
