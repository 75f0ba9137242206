// A file restart.bin of a problem with five unknowns: a run that may go on, or one line. Mutants keep the
// records' check sums right, as one who forges them would.
#include <Kokkos_Core.hpp>
#include <Teuchos_DefaultSerialComm.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cstring>
#include <random>
#include <vector>

#include "Target.hpp"
#include "machine/Digest.hpp"
#include "restart/RestartFile.hpp"

using namespace atrapos;

namespace {

path::RCP<const path::Map> map() {
  static const path::RCP<const path::Map> five =
      Teuchos::rcp(new path::Map(5, 0, Teuchos::rcp(new Teuchos::SerialComm<int>())));
  return five;
}

RunProblem problem() {
  return {{"materials/steel/youngs_modulus: 1000", "loads/tip/total: [0, 0, -1]"}, {8, 1, 2, 3, 4}};
}

path::RCP<path::Vector> vector(double value) {
  auto v = Teuchos::rcp(new path::Vector(map()));
  v->putScalar(value);
  return v;
}

path::State state(double value) {
  auto memory = std::make_shared<path::Memory>();
  memory->conditions = {1, 0, 2};
  memory->variables = {0.5, 1.5};
  memory->u = vector(value);
  return {vector(value), value, memory};
}

path::PathTangent tangent(double value) { return {{vector(value), {value}}, 1}; }

/// What two steps, a bifurcation point and the first step of a branch leave behind.
std::string sample() {
  const std::string file = fuzz::folder() / "sample.bin";
  path::BranchProgress progress(state(0));
  progress.path.emplace();
  progress.path->state = state(1);
  progress.path->tangent = tangent(2);
  progress.path->steps = 1;
  progress.path->weight = 3;
  progress.path->events = {1, 2};
  progress.path->eigenvalues = {{vector(4), 0.5, 0.1}, {vector(5), 0.7, 0.2}};
  progress.path->stop = "load_factor";
  progress.path->landmarks.add({1, {0.1, 0.2, 0.3}, {1, 0, 0}, {1, 1, 1}});
  RestartFile out(file, problem(), true);
  out.append(progress, {{3, 1}, {1, 2}, {1, 3}, {0, 4}, {1, 5}});
  path::BranchPoint& point = progress.diagram.points.emplace_back();
  point.point.state = state(1.5);
  point.point.tangents = {tangent(1), tangent(-1)};
  point.point.nullVectors = {vector(1)};
  point.step = 2;
  progress.addHalves(0);
  progress.path->steps = 2;
  out.append(progress, {{5, 1}, {2, 2}, {2, 3}, {0, 4}, {2, 5}});
  progress.diagram.branches.front().outcome.final = state(2);
  progress.path.reset();
  out.append(progress, {{5, 1}, {2, 2}, {2, 3}, {0, 4}, {2, 5}});
  path::Branch& branch = progress.diagram.branches.emplace_back();
  branch.parent = branch.point = 0;
  branch.depth = 1;
  branch.direction = tangent(1);
  branch.start = state(1.6);
  progress.current = 1;
  progress.path.emplace().state = state(1.7);
  progress.path->steps = 1;
  out.append(progress, {{7, 1}, {2, 2}, {3, 3}, {0, 4}, {1, 5}});
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

constexpr std::size_t headSize = 24;

std::vector<std::string> recordsOf(const std::string& file) {
  std::vector<std::string> records;
  for (std::size_t at = headSize; at + 16 <= file.size();) {
    std::uint64_t length = 0;
    std::memcpy(&length, &file[at], sizeof length);
    if (length > file.size() - at - 16) break;
    records.push_back(file.substr(at + 16, length));
    at += 16 + length;
  }
  return records;
}

std::string bytesOf(std::uint64_t number) { return {reinterpret_cast<const char*>(&number), sizeof number}; }

std::string fileOf(const std::string& head, const std::vector<std::string>& records) {
  std::string file = head;
  for (const std::string& record : records) {
    Digest sum;
    sum.add(record);
    file += bytesOf(record.size()) + bytesOf(sum.value()) + record;
  }
  return file;
}

void changeBytes(std::string& record) {
  std::vector<std::uint8_t> bytes(record.begin(), record.end());
  bytes.resize(record.size() + 64);
  bytes.resize(LLVMFuzzerMutate(bytes.data(), record.size(), bytes.size()));
  record.assign(bytes.begin(), bytes.end());
}

void changeNumber(std::string& record, std::mt19937& random) {
  if (record.size() < 8) return;
  const std::uint64_t numbers[] = {0,
                                   1,
                                   2,
                                   ~std::uint64_t{0},
                                   std::uint64_t{1} << 40,
                                   0x7fffffff,
                                   0x80000000u,
                                   record.size(),
                                   0x7ff0000000000000u};
  std::memcpy(&record[random() % (record.size() - 7)], &numbers[random() % std::size(numbers)],
              random() % 2 == 0 ? 8 : 4);
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  Kokkos::initialize();
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
  static const std::string first = sample();
  std::mt19937 random(seed);
  if (size > 0 && random() % 10 == 0) return LLVMFuzzerMutate(data, size, most);
  std::string file = fuzz::textOf(data, size);
  if (file.size() < headSize || recordsOf(file).empty()) file = first;
  std::vector<std::string> records = recordsOf(file);
  std::string& record = records[random() % records.size()];
  switch (random() % 8) {
    case 0:
      records.erase(records.begin() + (&record - records.data()));
      break;
    case 1: {
      const std::string again = record;
      records.push_back(again);
      break;
    }
    case 2:
      std::swap(record, records.back());
      break;
    case 3:
    case 4:
      changeNumber(record, random);
      break;
    default:
      changeBytes(record);
  }
  file = fileOf(file.substr(0, headSize), records);
  if (file.size() > most) return LLVMFuzzerMutate(data, size, most);
  std::copy(file.begin(), file.end(), data);
  return file.size();
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string file = fuzz::folder().write("restart.bin", fuzz::textOf(data, size));
  for (const std::optional<RestartPlace>& place :
       {std::optional<RestartPlace>(), std::optional<RestartPlace>({0, 1}),
        std::optional<RestartPlace>({1, 1})}) {
    try {
      readRestart(fuzz::folder().path(), place, problem(), map());
    } catch (const std::invalid_argument& error) {
      fuzz::requireOneLine(error.what(), file);
    }
  }
  return 0;
}
