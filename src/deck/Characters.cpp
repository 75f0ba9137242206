#include "deck/Characters.hpp"

#include <algorithm>

namespace atrapos::deck {

std::size_t characterSize(const std::string& text, std::size_t i) {
  const auto byte = [&](std::size_t k) {
    return i + k < text.size() ? static_cast<unsigned char>(text[i + k]) : 0u;
  };
  const unsigned first = byte(0);
  const std::size_t size = first < 0x80                     ? 1
                           : first >= 0xC2 && first <= 0xDF ? 2
                           : first >= 0xE0 && first <= 0xEF ? 3
                           : first >= 0xF0 && first <= 0xF4 ? 4
                                                            : 0;
  for (std::size_t k = 1; k < size; ++k) {
    if ((byte(k) & 0xC0) != 0x80) return 0;
  }
  const unsigned second = byte(1);
  const bool outside = (first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) ||
                       (first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F);
  return outside ? 0 : size;
}

unsigned codeOf(const std::string& text, std::size_t i) {
  const std::size_t size = characterSize(text, i);
  unsigned code = static_cast<unsigned char>(text[i]) & (size < 2 ? 0x7Fu : 0xFFu >> (size + 1));
  for (std::size_t k = 1; k < size; ++k) {
    code = code << 6 | (static_cast<unsigned char>(text[i + k]) & 0x3Fu);
  }
  return code;
}

bool isControl(unsigned code) {
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0x2028 || code == 0x2029;
}

bool hasControl(const std::string& text) { return plainLine(text) != text; }

std::string beginOf(const std::string& text, std::size_t bytes) {
  std::size_t size = std::min(bytes, text.size());
  while (size > 0 && size < text.size() && (static_cast<unsigned char>(text[size]) & 0xC0) == 0x80) --size;
  return text.substr(0, size);
}

std::string plainLine(const std::string& text) {
  std::string line;
  for (std::size_t i = 0, size = 1; i < text.size(); i += std::max<std::size_t>(size, 1)) {
    size = characterSize(text, i);
    line += size > 0 && !isControl(codeOf(text, i)) ? text.substr(i, size) : " ";
  }
  return line;
}

std::string shortened(const std::string& text) {
  constexpr std::size_t most = 60;
  return plainLine(beginOf(text, most)) + (text.size() > most ? "..." : "");
}

}  // namespace atrapos::deck
