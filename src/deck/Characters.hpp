#pragma once

#include <cstddef>
#include <string>

namespace atrapos::deck {

/// Bytes of the UTF-8 character that begins at i, 0 where none does: bytes of the wrong kind, overlong forms,
/// surrogates, beyond U+10FFFF.
std::size_t characterSize(const std::string& text, std::size_t i);

/// The character that begins at i, which must be one.
unsigned codeOf(const std::string& text, std::size_t i);

/// Whether a character moves, ends or changes lines where it is shown: control characters, C1 among them, and
/// Unicode's ends of lines and paragraphs.
bool isControl(unsigned code);

/// Whether a text in UTF-8 has such characters.
bool hasControl(const std::string& text);

/// The first bytes of a text, so many at most, without a part of a character.
std::string beginOf(const std::string& text, std::size_t bytes);

/// The text with blanks for control characters, and for bytes that are no UTF-8.
std::string plainLine(const std::string& text);

/// A text cut to a length that suits a message, as plainLine.
std::string shortened(const std::string& text);

}  // namespace atrapos::deck
