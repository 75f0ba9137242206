#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace atrapos {

/// Fowler, Noll and Vo's hash (FNV-1a, 64 bits) of what is added one after the other: sees what was lost or
/// damaged, not what was forged.
class Digest {
 public:
  void add(const std::string& bytes) {
    for (const unsigned char c : bytes) add(std::uint64_t{c});
  }
  /// In words of 64 bits: any change of a bit changes the hash.
  void add(const double* values, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      std::uint64_t word = 0;
      std::memcpy(&word, values + i, sizeof word);
      add(word);
    }
  }
  void add(const std::vector<double>& values) { add(values.data(), values.size()); }
  void add(std::uint64_t word) { value_ = (value_ ^ word) * 1099511628211ull; }

  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 14695981039346656037ull;
};

/// How far a file of a run had come: its rows or states so far, and what they hold.
struct Mark {
  std::uint64_t count = 0, digest = Digest().value();
  bool operator==(const Mark& other) const { return count == other.count && digest == other.digest; }
};

}  // namespace atrapos
