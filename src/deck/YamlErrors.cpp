#include "deck/YamlErrors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "deck/Characters.hpp"

namespace atrapos::deck {
namespace {

/// Where the text in quotes begins that is never closed: after the last value that was read.
std::size_t openQuote(const std::string& text, std::size_t from) {
  const auto mayBegin = [&](std::size_t i) {
    return i == 0 || std::string(" \t\n[{,:-").find(text[i - 1]) != std::string::npos;
  };
  for (std::size_t i = from; i < text.size(); ++i) {
    if (text[i] == '#' && mayBegin(i)) {
      i = std::min(text.find('\n', i), text.size());
    } else if ((text[i] == '"' || text[i] == '\'') && mayBegin(i)) {
      auto end = i + 1;
      const char escape = text[i] == '"' ? '\\' : '\'';
      while (end < text.size() && (text[end] != text[i] || text.compare(end, 2, "''") == 0)) {
        end += text[end] == escape ? 2 : 1;
      }
      if (end >= text.size()) return i;
      i = end;
    }
  }
  return from;
}

std::size_t indentation(const std::string& line) {
  return std::min(line.find_first_not_of(" \t"), line.size());
}

/// A ':' where no key can be: the line before is no entry, or this one is indented as if it were.
std::string unexpectedColon(const YamlSource& source, int line, int column) {
  const std::string own = source.line(line);
  int above = line - 1;
  while (above >= 0 && indentation(source.line(above)) == source.line(above).size()) --above;
  const std::string before = source.line(above);
  const auto begin = indentation(own);
  const bool firstOnLine = own.find(':', begin) == static_cast<std::size_t>(column);
  const bool entry = above < 0 || before[indentation(before)] == '-' || before.back() == ':' ||
                     before.find(": ") != std::string::npos;
  if (firstOnLine && !entry) {
    return fmt::format("line {} is no entry: {}", above + 1, noEntry(before.substr(indentation(before))));
  }
  if (firstOnLine && above >= 0 && begin > indentation(before)) {
    return "this line is indented more than the one before, which begins no block";
  }
  return "unexpected ':'; a text that holds ': ' needs quotes, and an entry a line of its own or a ',' "
         "before it";
}

/// The parser wanted another key, or item.
std::string endOfBlock(const YamlSource& source, const YamlProgress& progress, int line, int column) {
  const std::string own = source.line(line);
  const std::string rest = own.substr(std::min(static_cast<std::size_t>(column), own.size()));
  if (indentation(own) != static_cast<std::size_t>(column) || rest.empty() ||
      std::string(",[]{}\"'&*").find(rest[0]) != std::string::npos) {
    return fmt::format("unexpected '{}'; expected 'key: value' on a line of its own", shortened(rest));
  }
  if (rest == "-" || rest.compare(0, 2, "- ") == 0) {
    return "a list item must be indented below its key, as the items before it";
  }
  return progress.endedList == column ? "expected a list item, '- ...'"
                                      : "the indentation matches no enclosing block";
}

/// Words for what needs no look at the text around it.
std::string otherwise(const std::string& message) {
  namespace msg = YAML::ErrorMsg;
  constexpr const char* directive = "a deck has no directives but '%YAML 1.2', of its version, at its begin";
  constexpr const char* tag = "tags are not used in decks; quotes make a text of a value";
  constexpr const char* escape =
      "the escape is no character; expected 2 hexadecimal digits after \\x, 4 after \\u, 8 after \\U";
  constexpr const char* anchor = "expected a name of letters and digits after '&' or '*'";
  constexpr const char* anchors = "expected one anchor at most for a value, and nothing besides an alias";
  constexpr const char* text = "the lines of a text begun with '|' or '>' are indented by spaces, alike";
  const std::pair<const char*, const char*> words[] = {
      {msg::YAML_DIRECTIVE_ARGS, directive},
      {msg::YAML_VERSION, directive},
      {msg::YAML_MAJOR_VERSION, directive},
      {msg::REPEATED_YAML_DIRECTIVE, directive},
      {msg::TAG_DIRECTIVE_ARGS, directive},
      {msg::REPEATED_TAG_DIRECTIVE, directive},
      {msg::CHAR_IN_TAG_HANDLE, tag},
      {msg::TAG_WITH_NO_SUFFIX, tag},
      {msg::END_OF_VERBATIM_TAG, tag},
      {msg::MULTIPLE_TAGS, tag},
      {msg::INVALID_HEX, escape},
      {msg::INVALID_UNICODE, escape},
      {msg::ALIAS_NOT_FOUND, anchor},
      {msg::ANCHOR_NOT_FOUND, anchor},
      {msg::CHAR_IN_ALIAS, anchor},
      {msg::CHAR_IN_ANCHOR, anchor},
      {msg::MULTIPLE_ANCHORS, anchors},
      {msg::ALIAS_CONTENT, anchors},
      {msg::CHAR_IN_BLOCK, text},
      {msg::ZERO_INDENT_IN_BLOCK, text},
  };
  for (const auto& [begin, own] : words) {
    if (message.rfind(begin, 0) == 0) return own;
  }
  return "this is no YAML here; a text with signs that mean something needs quotes";
}

}  // namespace

std::string noEntry(const std::string& text) {
  const bool digits = text.find_first_not_of("0123456789") == std::string::npos;
  const bool colon = text.find(':') != std::string::npos;
  return fmt::format("expected 'key: value', got '{}'{}", shortened(text),
                     digits  ? " (decimals are written with a point: 0.3)"
                     : colon ? " (a blank follows the colon)"
                             : "");
}

void explain(const YAML::Exception& error, const YamlSource& source, const YamlProgress& progress) {
  namespace msg = YAML::ErrorMsg;
  const int line = error.mark.line, column = error.mark.column;
  const auto at = source.offset(line, column);
  const std::string own = source.line(line);
  const std::string found = source.character(at);
  const auto fail = [&](const std::string& what) { source.fail(at, what); };
  const auto is = [&](const char* message) { return error.msg == message; };

  if (progress.openBrackets.empty() && own.substr(0, indentation(own)).find('\t') != std::string::npos) {
    source.fail(source.offset(line, 0), "indentation takes spaces, not tabs");
  }
  if (is(msg::EOF_IN_SCALAR) || is(msg::DOC_IN_SCALAR)) {
    source.fail(openQuote(source.text(), progress.lastBegin), "the text in quotes is never closed");
  }
  if (is(msg::END_OF_MAP_FLOW) || is(msg::END_OF_SEQ_FLOW)) {
    const std::string pair = is(msg::END_OF_SEQ_FLOW) ? "[]" : "{}";
    const auto open = progress.openBrackets.empty() ? at : progress.openBrackets.back();
    if (found.empty()) {
      source.fail(open, fmt::format("'{}' is never closed", pair[0]));
    }
    fail(fmt::format("unexpected '{}'; expected ',' or '{}' for the '{}' on line {}", found, pair[1], pair[0],
                     source.lineOf(open)));
  }
  if (is(msg::FLOW_END)) fail(fmt::format("'{}' closes nothing", found));
  if (is(msg::MAP_VALUE)) fail(unexpectedColon(source, line, column));
  if (is(msg::END_OF_MAP)) fail(endOfBlock(source, progress, line, column));
  if (is(msg::END_OF_SEQ)) fail("expected a list item, '- ...'");
  if (is(msg::BLOCK_ENTRY))
    fail("a list item, '- ...', begins a line of its own; '-' as a text needs quotes");
  if (is(msg::MAP_KEY)) fail("unexpected '?'; a text that begins with it needs quotes");
  if (is(msg::UNKNOWN_TOKEN))
    fail(fmt::format("unexpected '{}'; a text that begins with it needs quotes", found));
  if (error.msg.rfind(msg::INVALID_ESCAPE, 0) == 0) {
    source.fail(at - 2, fmt::format("unknown escape '\\{}'; in single quotes a backslash is itself",
                                    source.character(at - 1)));
  }
  if (is(msg::UNKNOWN_ANCHOR)) {
    const auto end = source.text().find_first_of(" \t\n,]}", at);
    fail(fmt::format("no anchor '&{}' stands before this alias",
                     shortened(source.text().substr(at + 1, end - at - 1))));
  }
  source.fail(at, otherwise(error.msg));
}

}  // namespace atrapos::deck
