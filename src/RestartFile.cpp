#include "RestartFile.hpp"

#include <fmt/format.h>

#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <functional>
#include <stdexcept>

#include "Ranks.hpp"
#include "atrapos/linear/OnAllRanks.hpp"

namespace atrapos {
namespace {

/// At the head of the file: the format's name and version, and a number that tells another byte order.
struct Head {
  char name[16] = "atrapos restart";
  std::uint32_t version = 2, byteOrder = 0x01020304;
};

/// Fowler, Noll and Vo's hash (FNV-1a, 64 bits): sees a record that was cut or damaged.
std::uint64_t checkSum(const std::string& bytes) {
  std::uint64_t hash = 14695981039346656037ull;
  for (const unsigned char c : bytes) hash = (hash ^ c) * 1099511628211ull;
  return hash;
}

class Packer {
 public:
  template <class T>
  void put(const T& value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <class T>
  void put(const std::vector<T>& values) {
    put(static_cast<std::uint64_t>(values.size()));
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  }
  void put(const path::Vector& u) { put(linear::onAllRanks(u)); }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Reads what a Packer wrote; the check sum has said that it is whole.
class Unpacker {
 public:
  explicit Unpacker(const std::string& bytes) : bytes_(bytes) {}
  template <class T>
  T get() {
    T value;
    std::memcpy(&value, take(sizeof value), sizeof value);
    return value;
  }
  template <class T>
  std::vector<T> list() {
    std::vector<T> values(get<std::uint64_t>());
    if (!values.empty())
      std::memcpy(values.data(), take(values.size() * sizeof(T)), values.size() * sizeof(T));
    return values;
  }

 private:
  const char* take(std::size_t count) {
    const char* at = bytes_.data() + place_;
    place_ += count;
    return at;
  }
  const std::string& bytes_;
  std::size_t place_ = 0;
};

std::string packed(const path::Start& s) {
  Packer p;
  p.put(static_cast<std::int32_t>(s.steps));
  p.put(s.state.lambda);
  p.put(s.pathLength);
  p.put(s.weight.value());
  p.put(s.length);
  p.put(static_cast<std::int32_t>(s.order));
  p.put(static_cast<std::int32_t>(s.padeFailures));
  p.put(static_cast<std::int32_t>(s.padeWait));
  p.put(s.tangent.value().lambda);
  p.put(*s.state.u);
  p.put(*s.tangent->x.u);
  p.put(s.tangent->x.internal);
  p.put(s.events);
  p.put(s.due);
  p.put(s.conditions);
  return p.bytes();
}

int stepOf(const std::string& record) { return Unpacker(record).get<std::int32_t>(); }

path::Start unpacked(const std::string& record, const std::string& file,
                     const path::RCP<const path::Map>& map) {
  const auto vector = [&](const std::vector<double>& values) {
    if (values.size() != map->getGlobalNumElements())
      throw std::invalid_argument(fmt::format("{}: its states have {} unknowns, the deck's problem has {}",
                                              file, values.size(), map->getGlobalNumElements()));
    auto v = Teuchos::rcp(new path::Vector(map));
    const auto data = v->getDataNonConst();
    for (int i = 0; i < data.size(); ++i) data[i] = values[map->getGlobalElement(i)];
    return v;
  };
  Unpacker u(record);
  path::Start s;
  s.steps = u.get<std::int32_t>();
  s.state.lambda = u.get<double>();
  s.pathLength = u.get<double>();
  s.weight = u.get<double>();
  s.length = u.get<double>();
  s.order = u.get<std::int32_t>();
  s.padeFailures = u.get<std::int32_t>();
  s.padeWait = u.get<std::int32_t>();
  path::PathTangent tangent;
  tangent.lambda = u.get<double>();
  s.state.u = vector(u.list<double>());
  tangent.x.u = vector(u.list<double>());
  tangent.x.internal = u.list<double>();
  s.events = u.list<int>();
  s.due = u.list<int>();
  s.conditions = u.list<int>();
  s.tangent = tangent;
  return s;
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

RestartFile::RestartFile(const std::string& file) : file_(file), writes_(ranks::isFirst()) {
  if (!writes_) return;
  out_.open(file, std::ios::binary | std::ios::trunc);
  const Head head;
  out_.write(reinterpret_cast<const char*>(&head), sizeof head);
  out_.flush();
  if (!out_) throw std::runtime_error(fmt::format("{}: cannot be written", file_));
}

void RestartFile::copyFrom(const std::string& file, int lastStep) {
  if (!writes_) return;
  forEachRecord(file, [&](const std::string& record) {
    if (stepOf(record) > lastStep) return false;
    put(record);
    return true;
  });
}

void RestartFile::append(const path::Start& next) { put(packed(next)); }

void RestartFile::put(const std::string& record) {
  if (!writes_) return;
  const std::uint64_t length = record.size(), sum = checkSum(record);
  out_.write(reinterpret_cast<const char*>(&length), sizeof length);
  out_.write(reinterpret_cast<const char*>(&sum), sizeof sum);
  out_.write(record.data(), static_cast<std::streamsize>(record.size()));
  out_.flush();
  if (!out_) throw std::runtime_error(fmt::format("{}: cannot be written (disk full?)", file_));
}

path::Start readRestart(const std::string& file, std::optional<int> step,
                        const path::RCP<const path::Map>& map) {
  std::string found;
  int last = 0;
  forEachRecord(file, [&](const std::string& record) {
    last = stepOf(record);
    if (!step || last == *step) found = record;
    return !step || last < *step;
  });
  if (found.empty() && last == 0)
    throw std::invalid_argument(fmt::format("{}: holds no finished step", file));
  if (found.empty())
    throw std::invalid_argument(fmt::format("{}: holds no step {}; its last one is {}", file, *step, last));
  return unpacked(found, file, map);
}

}  // namespace atrapos
