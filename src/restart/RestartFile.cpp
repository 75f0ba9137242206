#include "restart/RestartFile.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <functional>
#include <stdexcept>

#include "machine/Ranks.hpp"

namespace atrapos {
namespace {

/// At the head of the file: the format's name and version, and a number that tells another byte order.
struct Head {
  char name[16] = "atrapos restart";
  std::uint32_t version = 5, byteOrder = 0x01020304;
};

/// Fowler, Noll and Vo's hash (FNV-1a, 64 bits): sees a record that was cut or damaged.
std::uint64_t checkSum(const std::string& bytes) {
  std::uint64_t hash = 14695981039346656037ull;
  for (const unsigned char c : bytes) hash = (hash ^ c) * 1099511628211ull;
  return hash;
}

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

RestartFile::RestartFile(const std::string& file, bool tree)
    : file_(file), tree_(tree), writes_(ranks::isFirst()) {
  if (!writes_) return;
  out_.open(file, std::ios::binary | std::ios::trunc);
  const Head head;
  out_.write(reinterpret_cast<const char*>(&head), sizeof head);
  out_.flush();
  if (!out_) throw std::runtime_error(fmt::format("{}: cannot be written", file_));
}

void RestartFile::goOn(const std::string& file, const Continued& run) {
  branches_ = run.progress.diagram.branches.size();
  points_ = run.progress.diagram.points.size();
  if (!writes_) return;
  std::size_t left = run.records;
  forEachRecord(file, [&](const std::string& record) {
    if (left == 0) return false;
    --left;
    put(record);
    return true;
  });
}

void RestartFile::append(const path::BranchProgress& progress) {
  put(packed(progress, branches_, points_, tree_));
  branches_ = progress.diagram.branches.size();
  points_ = progress.diagram.points.size();
}

void RestartFile::put(const std::string& record) {
  if (!writes_) return;
  const std::uint64_t length = record.size(), sum = checkSum(record);
  out_.write(reinterpret_cast<const char*>(&length), sizeof length);
  out_.write(reinterpret_cast<const char*>(&sum), sizeof sum);
  out_.write(record.data(), static_cast<std::streamsize>(record.size()));
  out_.flush();
  if (!out_) throw std::runtime_error(fmt::format("{}: cannot be written (disk full?)", file_));
}

Continued readRestart(const std::string& directory, std::optional<RestartPlace> place,
                      const path::RCP<const path::Map>& map) {
  Continued run;
  run.directory = directory;
  const std::string file = directory + "/restart.bin";
  std::size_t records = 0;
  RestartPlace last;
  forEachRecord(file, [&](const std::string& record) {
    ++records;
    const RestartHead head = headOf(record);
    run.tree = head.tree;
    last = head.place;
    const bool asked = place && !head.over && last.branch == place->branch && last.step == place->step;
    if (asked || !place) run.records = records;
    return !asked;
  });
  if (records == 0) throw std::invalid_argument(fmt::format("{}: holds no finished step", file));
  if (run.records == 0)
    throw std::invalid_argument(
        fmt::format("{}: holds no step {} of branch {}; its last one is {} of branch {}", file, place->step,
                    place->branch, last.step, last.branch));
  std::size_t left = run.records;
  forEachRecord(file, [&](const std::string& record) {
    --left;
    apply(record, left == 0, file, map, run.progress);
    return left > 0;
  });
  return run;
}

}  // namespace atrapos
