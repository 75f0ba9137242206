#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "RawFile.hpp"

/// Changes NetCDF files at random, in one to three places: their structure as well as values.
class RawMutator {
 public:
  explicit RawMutator(unsigned seed) : random_(seed) {}

  RawFile operator()(RawFile raw) {
    for (std::size_t n = 1 + below(3); n > 0 && !raw.variables.empty(); --n)
      once(raw, raw.variables[below(raw.variables.size())]);
    return raw;
  }
  std::size_t below(std::size_t n) { return n == 0 ? 0 : random_() % n; }

 private:
  void once(RawFile& raw, RawFile::Variable& variable) {
    static const std::vector<std::size_t> lengths{1, 2, 3, 5, 8, 31, 33, 100, 5000};
    switch (below(8)) {
      case 0:
        if (!variable.dimensions.empty())
          raw.stretch(variable, below(variable.dimensions.size()), lengths[below(lengths.size())]);
        break;
      case 1:
        variable.type = static_cast<nc_type>(1 + below(6));
        break;
      case 2:
        for (std::size_t n = 1 + below(6); n > 0 && !variable.bytes.empty(); --n)
          variable.bytes[below(variable.bytes.size())] = static_cast<char>(random_());
        break;
      case 3:
        if (!variable.attributes.empty() && below(2) == 0)
          change(variable.attributes[below(variable.attributes.size())]);
        else if (!raw.attributes.empty())
          change(raw.attributes[below(raw.attributes.size())]);
        break;
      case 4:
        raw.variables.erase(raw.variables.begin() + (&variable - raw.variables.data()));
        break;
      case 5: {
        if (raw.dimensions.empty()) break;
        auto& dimension = raw.dimensions[below(raw.dimensions.size())];
        if (!dimension.unlimited)
          dimension.length = below(2) == 0 ? dimension.length + 1 : lengths[below(lengths.size())];
        break;
      }
      case 6: {
        const auto numbers = wholeNumbers();
        if (variable.type == NC_INT && variable.bytes.size() >= 4)
          std::copy_n(reinterpret_cast<const char*>(&numbers[below(numbers.size())]), 4,
                      &variable.bytes[4 * below(variable.bytes.size() / 4)]);
        break;
      }
      default:
        if (!variable.dimensions.empty()) std::swap(variable.dimensions.front(), variable.dimensions.back());
    }
  }

  void change(RawFile::Attribute& attribute) {
    const std::size_t size = attribute.type == NC_CHAR ? 1 : 4;
    attribute.bytes.resize(size * lengths_[below(lengths_.size())], 'x');
    if (below(2) == 0 && !attribute.bytes.empty())
      attribute.bytes[below(attribute.bytes.size())] = static_cast<char>(random_());
  }

  static std::vector<int> wholeNumbers() {
    return {0, -1, 1, 2, 1000, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()};
  }

  const std::vector<std::size_t> lengths_{0, 1, 2, 32, 33, 34, 300, 4000};
  std::mt19937 random_;
};
