#include "restart/RestartFile.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <utility>

#include "machine/Ranks.hpp"
#include "restart/RunProblem.hpp"

namespace atrapos {
namespace {

/// At the head of the file: the format's name and version, and a number that tells another byte order.
struct Head {
  char name[16] = "atrapos restart";
  std::uint32_t version = 11, byteOrder = 0x01020304;
};

std::uint64_t checkSum(const std::string& bytes) {
  Digest digest;
  digest.add(bytes);
  return digest.value();
}

std::string bytesOf(std::uint64_t number) { return {reinterpret_cast<const char*>(&number), sizeof number}; }

/// Calls f(record) for every whole record until it returns false.
void forEachRecord(const std::string& file, const std::function<bool(const std::string&)>& f) {
  std::ifstream in(file, std::ios::binary);
  Head head;
  const Head expected;
  if (!in) throw std::invalid_argument(fmt::format("{}: cannot be read", file));
  if (!in.read(reinterpret_cast<char*>(&head), sizeof head) ||
      std::memcmp(head.name, expected.name, sizeof head.name) != 0)
    throw std::invalid_argument(fmt::format("{}: not a restart file", file));
  if (head.version != expected.version || head.byteOrder != expected.byteOrder)
    throw std::invalid_argument(
        fmt::format("{}: written by another version or on another kind of machine", file));
  in.seekg(0, std::ios::end);
  const auto size = static_cast<std::uint64_t>(in.tellg());
  in.seekg(sizeof head);
  std::uint64_t length = 0, sum = 0;
  while (in.read(reinterpret_cast<char*>(&length), sizeof length) &&
         in.read(reinterpret_cast<char*>(&sum), sizeof sum)) {
    if (length > size - static_cast<std::uint64_t>(in.tellg())) return;
    std::string record(length, '\0');
    if (!in.read(record.data(), static_cast<std::streamsize>(length)) || checkSum(record) != sum) return;
    if (!f(record)) return;
  }
}

}  // namespace

RestartFile::RestartFile(const std::string& file, const RunProblem& problem, bool tree)
    : tree_(tree), writes_(ranks::isFirst()) {
  if (!writes_) return;
  out_ = OutputFile(file, false);
  const Head head;
  out_.write({reinterpret_cast<const char*>(&head), sizeof head});
  put(packed(problem));
}

void RestartFile::goOn(const std::string& file, const Continued& run) {
  branches_ = run.progress.diagram.branches.size();
  points_ = run.progress.diagram.points.size();
  if (!writes_) return;
  std::size_t number = 0;
  forEachRecord(file, [&](const std::string& record) {
    if (number > run.records) return false;
    if (number++ > 0) put(record);  // the first one is there
    return true;
  });
}

void RestartFile::append(const path::BranchProgress& progress, const RunMarks& marks) {
  put(packed(progress, branches_, points_, tree_, marks));
  branches_ = progress.diagram.branches.size();
  points_ = progress.diagram.points.size();
}

void RestartFile::put(const std::string& record) {
  if (writes_) out_.write(bytesOf(record.size()) + bytesOf(checkSum(record)) + record);
}

Continued readRestart(const std::string& directory, std::optional<RestartPlace> place,
                      const RunProblem& problem, const path::RCP<const path::Map>& map) {
  Continued run;
  run.directory = directory;
  const std::string file = directory + "/restart.bin";
  std::size_t records = 0;
  RestartPlace last;
  bool first = true;
  forEachRecord(file, [&](const std::string& record) {
    if (std::exchange(first, false)) {
      const std::string other = firstDifference(problemOf(record, file), problem);
      if (!other.empty())
        throw std::invalid_argument(fmt::format("{}: is of another problem: {}", file, other));
      return true;
    }
    ++records;
    const RestartHead head = headOf(record, file);
    run.tree = head.tree;
    last = head.place;
    const bool asked = place && !head.over && last.branch == place->branch && last.step == place->step;
    if (asked || !place) {
      run.records = records;
      run.marks = head.marks;
    }
    return !asked;
  });
  if (records == 0) throw std::invalid_argument(fmt::format("{}: holds no finished step", file));
  if (run.records == 0)
    throw std::invalid_argument(
        fmt::format("{}: holds no step {} of branch {}; its last one is {} of branch {}", file, place->step,
                    place->branch, last.step, last.branch));
  std::size_t number = 0;
  forEachRecord(file, [&](const std::string& record) {
    if (number > 0) apply(record, number == run.records, file, map, run.progress);
    return number++ < run.records;
  });
  return run;
}

}  // namespace atrapos
