// yaml-cpp's events become a tree; YamlErrors makes lines of ours of its errors.
#include "deck/YamlTree.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <cctype>
#include <map>
#include <sstream>

#include "deck/Characters.hpp"
#include "deck/YamlErrors.hpp"

namespace atrapos::deck {
namespace {

using Kind = YamlNode::Kind;

constexpr std::size_t deepest = 64;
constexpr std::size_t mostByAliases = 1000000;
constexpr std::size_t longestKey = 200;  // bytes
constexpr const char* mergeKey = "<<";

class TreeBuilder : public YAML::EventHandler {
 public:
  explicit TreeBuilder(const YamlSource& source) : source_(source) {}

  const YamlTree& root() const { return root_; }

  YamlProgress progress() const {
    YamlProgress progress{lastBegin_, {}, endedList_};
    for (const Open& open : open_) {
      if (open.flow) progress.openBrackets.push_back(open.begin);
    }
    return progress;
  }

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
    std::map<std::string, std::size_t> begins = {};  // of the keys
    std::size_t keyBegin = 0;                        // of the last one
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
    made->begin = begin(mark);
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
    if (key.text.size() > longestKey || hasControl(key.text)) {
      source_.fail(at, fmt::format("a key is at most {} bytes without control characters", longestKey));
    }
    const auto [previous, isNew] = map.begins.emplace(key.text, at);
    if (!isNew) {
      source_.fail(at, fmt::format("'{}{}' is given twice, first on line {}", path(), key.text,
                                   source_.lineOf(previous->second)));
    }
    map.keyBegin = at;
    map.node->keys.push_back({key.text, at});
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
        if (map.begins.emplace(other->keys[i].name, other->keys[i].begin).second) {
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

}  // namespace

YamlFile readYaml(const std::string& text, const std::string& file) {
  const auto source = std::make_shared<const YamlSource>(text, file);
  TreeBuilder builder(*source);
  // The mark of the end: without it the parser takes a quote that is never closed for closed, and what stands
  // last in open brackets for a key.
  std::istringstream in(source->text() + "\n...\n");
  try {
    YAML::Parser parser(in);
    // The second document is refused; some that are none would never end.
    if (parser.HandleNextDocument(builder)) parser.HandleNextDocument(builder);
  } catch (const YAML::Exception& error) {
    explain(error, *source, builder.progress());
  }
  const YamlTree root = builder.root();
  if (!root || root->kind == Kind::Nothing) {
    source->fail("the deck is empty; expected the blocks mesh, materials, supports, path, ...");
  }
  if (root->kind == Kind::Scalar) {
    source->fail(root->begin, noEntry(root->text));
  }
  return {source, root};
}

}  // namespace atrapos::deck
