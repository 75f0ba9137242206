#include "atrapos/exodus/Error.hpp"

namespace atrapos::exodus {

std::string Error::plain(std::string line) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    const auto byte = static_cast<unsigned char>(line[i]);
    // U+0080 to U+009F move cursors too.
    const bool second =
        byte >= 0x80 && byte < 0xa0 && i > 0 && static_cast<unsigned char>(line[i - 1]) == 0xc2;
    if (byte < ' ' || byte == 0x7f || second) line[i] = ' ';
    if (second) line[i - 1] = ' ';
  }
  return line;
}

}  // namespace atrapos::exodus
