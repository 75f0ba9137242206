#pragma once

#include <algorithm>

#include "Target.hpp"
#include "TextMutator.hpp"

namespace atrapos::fuzz {

/// Half of the mutants are made by lines and values of the language, half by libFuzzer.
inline std::size_t mutateText(const test::Language& language, std::uint8_t* data, std::size_t size,
                              std::size_t most, unsigned seed) {
  if (seed % 2 == 0 || size == 0) return LLVMFuzzerMutate(data, size, most);
  const std::string changed = test::TextMutator(language, seed)(textOf(data, size));
  const std::size_t length = std::min(changed.size(), most);
  std::copy_n(changed.begin(), length, data);
  return length;
}

}  // namespace atrapos::fuzz
