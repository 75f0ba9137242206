// The one source that knows yaml-cpp: its events become a tree, its errors lines of ours.
#include "deck/YamlTree.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <sstream>

#include "deck/Deck.hpp"
#include "deck/DeckValue.hpp"
#include "deck/YamlSource.hpp"

namespace atrapos::deck {
namespace {

using Kind = YamlNode::Kind;

constexpr std::size_t deepest = 64;
constexpr std::size_t mostByAliases = 1000000;
constexpr const char* mergeKey = "<<";

std::string noEntry(const std::string& text) {
  const bool digits = text.find_first_not_of("0123456789") == std::string::npos;
  const bool colon = text.find(':') != std::string::npos;
  return fmt::format("expected 'key: value', got '{}'{}", shortened(text),
                     digits  ? " (decimals are written with a point: 0.3)"
                     : colon ? " (a blank follows the colon)"
                             : "");
}

class TreeBuilder : public YAML::EventHandler {
 public:
  explicit TreeBuilder(const YamlSource& source) : source_(source) {}

  const YamlTree& root() const { return root_; }

  // What the explanation of an error looks at.
  /// Begin of the last scalar, or of the list or map that began after it.
  std::size_t lastBegin() const { return lastBegin_; }
  /// Begins of the brackets that are open, the innermost last.
  std::vector<std::size_t> openBrackets() const {
    std::vector<std::size_t> begins;
    for (const Open& open : open_) {
      if (open.flow) begins.push_back(open.begin);
    }
    return begins;
  }
  /// Column of the items of the list in a block that has just ended; -1: something else has.
  int endedList() const { return endedList_; }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (!documentEnded_) return;
    const auto at = begin(mark);
    if (source_.text().compare(at, 3, "---") == 0 || source_.line(mark.line - 1).compare(0, 3, "...") == 0) {
      source_.fail(at, "a deck is one YAML document");
    }
    const std::string found = source_.character(at);
    source_.fail(at, std::ispunct(static_cast<unsigned char>(found[0])) != 0
                         ? fmt::format("unexpected '{}'", found)
                         : "the indentation matches no enclosing block");
  }
  void OnDocumentEnd() override { documentEnded_ = true; }

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    refuseMissingColon();
    add(node(Kind::Nothing, mark, "?"), begin(mark), anchor, count_++);
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    lastBegin_ = begin(mark);
    auto scalar = node(Kind::Scalar, mark, tag);
    scalar->quoted = tag == "!";
    scalar->text = value;
    add(scalar, lastBegin_, anchor, count_++);
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto named = anchors_.find(anchor);
    if (named == anchors_.end()) {
      fail(mark, "the alias stands within what it names");
    }
    countByAliases(named->second.size, begin(mark));
    add(named->second.tree, begin(mark), 0, count_);
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value style) override {
    if (open_.empty()) {
      fail(mark, "a deck is a map of blocks such as 'mesh: ...', one per line, not a list");
    }
    start(Kind::List, mark, tag, anchor, style);
  }
  void OnSequenceEnd() override {
    endedList_ = open_.back().flow ? -1 : open_.back().column;
    finish();
  }

  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value style) override {
    start(Kind::Map, mark, tag, anchor, style);
  }
  void OnMapEnd() override {
    endedList_ = -1;
    merge();
    finish();
  }

 private:
  struct Open {
    std::shared_ptr<YamlNode> node;
    std::size_t begin = 0;  // in the text
    int column = 0;
    bool flow = false;
    YAML::anchor_t anchor = 0;
    std::size_t countBefore = 0;
    std::map<std::string, int> lines = {};  // of the keys
    std::size_t keyBegin = 0;               // of the last one
    std::vector<YamlTree> merged = {};
  };
  struct Anchored {
    YamlTree tree;
    std::size_t size = 0;  // values it stands for
  };

  std::size_t begin(const YAML::Mark& mark) const { return source_.offset(mark.line, mark.column); }
  [[noreturn]] void fail(const YAML::Mark& mark, const std::string& what) const {
    source_.fail(begin(mark), what);
  }

  bool expectsKey() const {
    return !open_.empty() && open_.back().node->kind == Kind::Map &&
           open_.back().node->keys.size() == open_.back().node->items.size();
  }

  std::shared_ptr<YamlNode> node(Kind kind, const YAML::Mark& mark, const std::string& tag) const {
    if (tag != "?" && tag != "!" && !tag.empty()) {
      fail(mark, "tags are not used in decks; quotes make a text of a value");
    }
    auto made = std::make_shared<YamlNode>();
    made->kind = kind;
    made->line = mark.line + 1;
    return made;
  }

  void start(Kind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
             YAML::EmitterStyle::value style) {
    if (open_.size() == deepest) {
      fail(mark, fmt::format("lists and maps stand within each other more than {} deep", deepest));
    }
    lastBegin_ = begin(mark);
    open_.push_back({node(kind, mark, tag), lastBegin_, mark.column, style == YAML::EmitterStyle::Flow,
                     anchor, count_++});
  }

  void finish() {
    const Open ended = std::move(open_.back());
    open_.pop_back();
    add(ended.node, ended.begin, ended.anchor, ended.countBefore);
  }

  /// A value that is whole, with all within it.
  void add(const YamlTree& value, std::size_t at, YAML::anchor_t anchor, std::size_t countBefore) {
    if (anchor != 0) {
      anchors_[anchor] = {value, count_ - countBefore};
    }
    if (open_.empty()) {
      root_ = value;
    } else if (open_.back().node->kind == Kind::List) {
      open_.back().node->items.push_back(value);
    } else if (expectsKey()) {
      addKey(*value, at);
    } else {
      addValue(value);
    }
  }

  void addKey(const YamlNode& key, std::size_t at) {
    Open& map = open_.back();
    if (source_.text()[at] == '*') {
      source_.fail(at, "an alias stands for a whole value: 'key: *alias'");
    }
    if (key.kind != Kind::Scalar) {
      source_.fail(at, "a key must be a text");
    }
    const auto [previous, isNew] = map.lines.emplace(key.text, key.line);
    if (!isNew) {
      source_.fail(
          at, fmt::format("'{}{}' is given twice, first on line {}", path(), key.text, previous->second));
    }
    map.keyBegin = at;
    map.node->keys.push_back({key.text, key.line});
  }

  void addValue(const YamlTree& value) {
    Open& map = open_.back();
    if (map.node->keys.back().name != mergeKey) {
      map.node->items.push_back(value);
      return;
    }
    map.node->keys.pop_back();
    const auto& maps = value->kind == Kind::List ? value->items : std::vector<YamlTree>{value};
    for (const YamlTree& each : maps) {
      if (each->kind != Kind::Map) {
        source_.fail(map.keyBegin, "'<<' takes a map, or a list of maps, to take over the keys of");
      }
    }
    map.merged = maps;
  }

  /// Takes over the keys that the map itself, and maps before, do not have.
  void merge() {
    Open& map = open_.back();
    for (const YamlTree& other : map.merged) {
      countByAliases(other->keys.size(), map.keyBegin);
      for (std::size_t i = 0; i < other->keys.size(); ++i) {
        if (map.lines.emplace(other->keys[i].name, other->keys[i].line).second) {
          map.node->keys.push_back(other->keys[i]);
          map.node->items.push_back(other->items[i]);
        }
      }
    }
  }

  /// The same value again costs no memory, but time where it is read.
  void countByAliases(std::size_t values, std::size_t at) {
    count_ += values;
    byAliases_ += values;
    if (byAliases_ > mostByAliases) {
      source_.fail(at, fmt::format("the aliases stand for more than {} values", mostByAliases));
    }
  }

  /// A key alone is a key without a value to the parser; to the user a colon or a blank is missing.
  void refuseMissingColon() const {
    if (open_.empty() || open_.back().node->kind != Kind::Map || expectsKey()) return;
    const auto& key = open_.back().node->keys.back().name;
    const auto& text = source_.text();
    const auto at = open_.back().keyBegin;
    if (text.compare(at, key.size(), key) != 0) return;  // in quotes
    const auto next = text.find_first_not_of(" \t", at + key.size());
    if (next == std::string::npos ? open_.back().flow : text[next] == ':') return;
    source_.fail(at, noEntry(key));
  }

  /// Keys above the map that is open, each with a '/'.
  std::string path() const {
    std::string path;
    for (std::size_t i = 0; i + 1 < open_.size(); ++i) {
      if (open_[i].node->kind == Kind::Map) path += open_[i].node->keys.back().name + '/';
    }
    return path;
  }

  const YamlSource& source_;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, Anchored> anchors_;
  YamlTree root_;
  bool documentEnded_ = false;
  std::size_t count_ = 0, byAliases_ = 0;
  std::size_t lastBegin_ = 0;
  int endedList_ = -1;
};

// ------------------------------------------------------------------------------- what went wrong, in words

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
std::string endOfBlock(const YamlSource& source, const TreeBuilder& builder, int line, int column) {
  const std::string own = source.line(line);
  const std::string rest = own.substr(std::min(static_cast<std::size_t>(column), own.size()));
  if (indentation(own) != static_cast<std::size_t>(column) || rest.empty() ||
      std::string(",[]{}\"'&*").find(rest[0]) != std::string::npos) {
    return fmt::format("unexpected '{}'; expected 'key: value' on a line of its own", shortened(rest));
  }
  if (rest == "-" || rest.compare(0, 2, "- ") == 0) {
    return "a list item must be indented below its key, as the items before it";
  }
  return builder.endedList() == column ? "expected a list item, '- ...'"
                                       : "the indentation matches no enclosing block";
}

[[noreturn]] void explain(const YAML::Exception& error, const YamlSource& source,
                          const TreeBuilder& builder) {
  namespace msg = YAML::ErrorMsg;
  const int line = error.mark.line, column = error.mark.column;
  const auto at = source.offset(line, column);
  const std::string own = source.line(line);
  const std::string found = source.character(at);
  const auto fail = [&](const std::string& what) { source.fail(at, what); };
  const auto is = [&](const char* message) { return error.msg == message; };

  if (builder.openBrackets().empty() && own.substr(0, indentation(own)).find('\t') != std::string::npos) {
    source.fail(line, 0, "indentation takes spaces, not tabs");
  }
  if (is(msg::EOF_IN_SCALAR) || is(msg::DOC_IN_SCALAR)) {
    source.fail(openQuote(source.text(), builder.lastBegin()), "the text in quotes is never closed");
  }
  if (is(msg::END_OF_MAP_FLOW) || is(msg::END_OF_SEQ_FLOW)) {
    const std::string pair = is(msg::END_OF_SEQ_FLOW) ? "[]" : "{}";
    const auto open = builder.openBrackets().empty() ? at : builder.openBrackets().back();
    if (found.empty()) {
      source.fail(open, fmt::format("'{}' is never closed", pair[0]));
    }
    fail(fmt::format("unexpected '{}'; expected ',' or '{}' for the '{}' on line {}", found, pair[1], pair[0],
                     source.lineOf(open)));
  }
  if (is(msg::FLOW_END)) fail(fmt::format("'{}' closes nothing", found));
  if (is(msg::MAP_VALUE)) fail(unexpectedColon(source, line, column));
  if (is(msg::END_OF_MAP)) fail(endOfBlock(source, builder, line, column));
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
    fail(fmt::format("no anchor '&{}' stands before this alias", source.text().substr(at + 1, end - at - 1)));
  }
  source.fail(at, error.msg);
}

}  // namespace

YamlTree readYaml(const std::string& text, const std::string& file) {
  const YamlSource source(text, file);
  TreeBuilder builder(source);
  // The mark of the end: without it the parser takes a quote that is never closed for closed, and what stands
  // last in open brackets for a key.
  std::istringstream in(source.text() + "\n...\n");
  try {
    YAML::Parser parser(in);
    // The second document is refused; some that are none would never end.
    if (parser.HandleNextDocument(builder)) parser.HandleNextDocument(builder);
  } catch (const YAML::Exception& error) {
    explain(error, source, builder);
  }
  const YamlTree root = builder.root();
  if (!root || root->kind == Kind::Nothing) {
    throw DeckError(file + ": the deck is empty; expected the blocks mesh, materials, supports, path, ...");
  }
  if (root->kind == Kind::Scalar) {
    source.fail(builder.lastBegin(), noEntry(root->text));
  }
  return root;
}

}  // namespace atrapos::deck
