#include <vp/error.h>
#include <vp/text.h>
#include <vp/yaml.h>
#include <yaml-cpp/eventhandler.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <sstream>
#include <vector>

namespace vp {

namespace {

/// No file for this program is nested deeper than a few levels.
constexpr std::size_t deepest_nesting = 32;
constexpr std::uint64_t most_values = 500'000;

/// Goes through a text without keeping it, and measures what its tree would be.
class Inspection final : public YAML::EventHandler {
 public:
  Inspection(const std::string& origin, YamlDocuments documents)
      : origin_(origin), documents_(documents) {}

  void inspect(const std::string& text) {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(*this) && documents_ == YamlDocuments::only_one) continue;
  }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++count_ > 1)
      fail_in_yaml(origin_, mark,
                   "a second document: leave out all behind '---', the file has one");
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { add(mark, anchor, leaf); }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                const std::string&) override {
    add(mark, anchor, leaf);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const Size size = anchor < named_.size() ? named_[anchor] : Size();
    if (size.values == 0)
      fail_in_yaml(origin_, mark, "an alias inside its own anchor: write the values out");
    add(mark, YAML::NullAnchor, size);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(mark, anchor);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(mark, anchor);
  }
  void OnMapEnd() override { close(); }

 private:
  /// Of a part of the tree, aliases expanded.
  struct Size {
    std::uint64_t values = 0;
    std::size_t levels = 0;
  };
  static constexpr Size leaf{1, 0};
  struct Open {
    YAML::Mark mark;
    YAML::anchor_t anchor;
    Size size;
  };

  void open(const YAML::Mark& mark, YAML::anchor_t anchor) {
    open_.push_back({mark, anchor, {1, 1}});
    check_depth(mark, 0);
  }

  void close() {
    const Open done = open_.back();
    open_.pop_back();
    add(done.mark, done.anchor, done.size);
  }

  void add(const YAML::Mark& mark, YAML::anchor_t anchor, const Size& size) {
    if (anchor != YAML::NullAnchor) {
      named_.resize(std::max<std::size_t>(named_.size(), anchor + 1));
      named_[anchor] = size;
    }
    check_depth(mark, size.levels);
    if (open_.empty()) return;
    Size& parent = open_.back().size;
    parent.values += size.values;
    parent.levels = std::max(parent.levels, size.levels + 1);
    if (parent.values > most_values) {
      fail_in_yaml(origin_, mark,
                   "more than " + std::to_string(most_values) +
                       " values, aliases counted as what they stand for: write less");
    }
  }

  void check_depth(const YAML::Mark& mark, std::size_t levels) const {
    if (open_.size() + levels > deepest_nesting) {
      fail_in_yaml(
          origin_, mark,
          "nested more than " + std::to_string(deepest_nesting) + " levels deep: write it flatter");
    }
  }

  const std::string& origin_;
  YamlDocuments documents_;
  std::size_t count_ = 0;
  std::vector<Size> named_;  ///< by anchor; of those that are whole
  std::vector<Open> open_;
};

}  // namespace

void fail_in_yaml(const std::string& origin, const YAML::Mark& mark, const std::string& problem) {
  std::string where = origin;
  if (!mark.is_null())
    where += ":" + std::to_string(mark.line + 1) + ":" + std::to_string(mark.column + 1);
  throw InputError(where + ": " + problem);
}

YAML::Node load_yaml(const std::string& text, const std::string& origin, YamlDocuments documents) {
  if (text.find('\0') != std::string::npos)
    throw InputError(origin + ": it has bytes that are not text: name a YAML file");
  try {
    Inspection(origin, documents).inspect(text);
    return YAML::Load(text);
  } catch (const YAML::Exception& error) {
    fail_in_yaml(origin, error.mark,
                 "this is not YAML, here or in a line above: check that lines are indented with "
                 "spaces, that a space follows each ':', and that every quote, '[' and '{' is "
                 "closed");
  }
}

std::string YamlReader::where(const YAML::Node& node) const {
  if (node.Mark().is_null()) return origin_;
  return origin_ + ":" + std::to_string(node.Mark().line + 1);
}

void YamlReader::fail(const YAML::Node& node, const std::string& problem) const {
  throw InputError(where(node) + ": " + problem);
}

void YamlReader::for_each(const YAML::Node& map, const Keys& keys, const std::string& what) const {
  if (!map.IsMap()) fail(map, what + " is 'key: value' lines");
  std::set<std::string> seen;
  for (const auto& entry : map) {
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "";
    const auto found = keys.find(key);
    if (found == keys.end()) {
      std::vector<std::string> names;
      for (const auto& [name, unused] : keys) names.push_back(name);
      const std::string nearest = nearest_match(key, names);
      fail(entry.first, "unknown key '" + key + "' of " + what + ": " +
                            (nearest.empty() ? "" : "did you mean '" + nearest + "'? ") +
                            "there are " + join(names, ", "));
    }
    if (!seen.insert(key).second) fail(entry.first, "'" + key + "' is listed twice");
    found->second(entry.second);
  }
}

std::string YamlReader::scalar(const YAML::Node& node, const std::string& key) const {
  if (!node.IsScalar()) fail(node, "'" + key + "' takes one value");
  return node.Scalar();
}

std::vector<std::string> YamlReader::scalars(const YAML::Node& node, const std::string& key) const {
  if (node.IsScalar()) return {node.Scalar()};
  if (!node.IsSequence() || node.size() == 0) fail(node, "'" + key + "' takes a list of values");
  std::vector<std::string> values;
  for (const YAML::Node& item : node) values.push_back(scalar(item, key));
  return values;
}

std::string YamlReader::choice(const YAML::Node& node, const std::string& key,
                               const std::vector<std::string>& names) const {
  std::string value = scalar(node, key);
  if (std::find(names.begin(), names.end(), value) != names.end()) return value;
  const std::string nearest = nearest_match(value, names);
  fail(node, "'" + value + "' for '" + key + "': write " + one_of(names) +
                 (nearest.empty() ? "" : " (did you mean '" + nearest + "'?)"));
}

std::uint64_t YamlReader::whole(const YAML::Node& node, const std::string& key, std::uint64_t min,
                                std::uint64_t max) const {
  const std::string text = scalar(node, key);
  std::uint64_t value = 0;
  const bool digits = !text.empty() && text.size() < 19 &&
                      text.find_first_not_of("0123456789") == std::string::npos;
  if (digits) value = std::stoull(text);
  if (!digits || value < min || value > max) {
    fail(node, "'" + text + "' for '" + key + "': write a whole number from " +
                   std::to_string(min) + " to " + std::to_string(max));
  }
  return value;
}

std::uint64_t YamlReader::quantity(const YAML::Node& node, const std::string& key, Unit unit,
                                   std::uint64_t max) const {
  const std::string text = scalar(node, key);
  std::optional<Decimal::Whole> whole;
  try {
    whole = parse_quantity(text, unit).whole();
  } catch (const InputError& error) {
    fail(node, "'" + text + "' for '" + key + "' " + error.what());
  }
  if (!whole || *whole < 0 || *whole > static_cast<Decimal::Whole>(max))
    fail(node, "'" + text + "' for '" + key + "': write a whole number from 0 to " +
                   std::to_string(max) + (unit == Unit::none ? "" : " " + base_unit(unit)));
  return static_cast<std::uint64_t>(*whole);
}

}  // namespace vp
