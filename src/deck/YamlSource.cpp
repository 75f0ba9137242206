#include "deck/YamlSource.hpp"

#include <fmt/format.h>
#include <cerrno>
#include <cstring>
#include <fstream>

#include <algorithm>

#include "deck/Characters.hpp"
#include "deck/Deck.hpp"

namespace atrapos::deck {
std::string readText(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::string text(mostBytes + 1, ' ');  // no more: the file may have no end
  if (!in || !(in.read(text.data(), static_cast<std::streamsize>(text.size())) || in.eof())) {
    throw DeckError(fmt::format("{}: cannot be read: {}", file, std::strerror(errno)));
  }
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

YamlSource::YamlSource(const std::string& text, const std::string& file) : file_(file) {
  if (text.size() > mostBytes) {
    fail(fmt::format("is too large for a deck; expected at most {} bytes", mostBytes));
  }
  for (std::size_t i = text.compare(0, 3, "\xEF\xBB\xBF") == 0 ? 3 : 0; i < text.size(); ++i) {
    if (text.compare(i, 2, "\r\n") != 0) text_ += text[i];
  }
  text_.erase(text_.find_last_not_of(" \t\n") + 1);
  starts_.push_back(0);
  for (auto end = text_.find('\n'); end != std::string::npos; end = text_.find('\n', end + 1)) {
    starts_.push_back(end + 1);
  }
  checkCharacters();
}

void YamlSource::checkCharacters() const {
  std::size_t size = 1;
  for (std::size_t i = 0; i < text_.size(); i += size) {
    const unsigned byte = static_cast<unsigned char>(text_[i]);
    size = characterSize(text_, i);
    if (size == 0) {
      fail(i, fmt::format("the byte 0x{:02x} is no UTF-8 here; a deck is text in UTF-8 or ASCII", byte));
    }
    const unsigned code = codeOf(text_, i);
    if (isControl(code) && byte != '\t' && byte != '\n') {
      fail(i, fmt::format("control character U+{:04X}; a deck is text in UTF-8 or ASCII", code));
    }
  }
}

std::string YamlSource::line(int number) const {
  const auto index = static_cast<std::size_t>(number);
  if (number < 0 || index >= starts_.size()) return "";
  return text_.substr(starts_[index], text_.find('\n', starts_[index]) - starts_[index]);
}

std::size_t YamlSource::offset(int line, int column) const {
  const auto index = static_cast<std::size_t>(std::max(line, 0));
  if (index >= starts_.size()) return text_.size();
  return std::min(starts_[index] + static_cast<std::size_t>(std::max(column, 0)), text_.size());
}

std::string YamlSource::character(std::size_t offset) const {
  return text_.substr(offset, characterSize(text_, offset));
}

std::size_t YamlSource::lineOf(std::size_t offset) const {
  return static_cast<std::size_t>(std::upper_bound(starts_.begin(), starts_.end(), offset) - starts_.begin());
}

void YamlSource::fail(std::size_t offset, const std::string& what) const {
  const auto line = lineOf(offset);
  const auto before = text_.substr(starts_[line - 1], offset - starts_[line - 1]);
  const auto column = 1 + std::count_if(before.begin(), before.end(), [](char c) {
                        return (static_cast<unsigned char>(c) & 0xC0) != 0x80;  // begins a character
                      });
  throw DeckError(plainLine(fmt::format("{}:{}:{}: {}", file_, line, column, what)));
}

void YamlSource::fail(const std::string& what) const {
  throw DeckError(plainLine(fmt::format("{}: {}", file_, what)));
}

}  // namespace atrapos::deck
