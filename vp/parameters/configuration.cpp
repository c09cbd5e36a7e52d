#include <vp/configuration.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>
#include <vp/yaml.h>

#include <algorithm>
#include <cstdint>

namespace vp {
namespace {

Configuration* current_configuration = nullptr;

/// A module in the tree of parameters; the leaves are positions in a list.
struct Group {
  std::string name;
  std::vector<std::size_t> leaves;
  std::vector<Group> groups;

  Group& group(const std::string& wanted) {
    for (Group& existing : groups) {
      if (existing.name == wanted) return existing;
    }
    groups.push_back({wanted, {}, {}});
    return groups.back();
  }

  void collect(std::vector<std::size_t>& order) const {
    order.insert(order.end(), leaves.begin(), leaves.end());
    for (const Group& inner : groups) inner.collect(order);
  }
};

constexpr std::size_t longest_key = 500;
/// What is_key() asks for, in words.
constexpr const char* key_form = "a name, or names joined by dots, of at most 500 characters";

/// True for names joined by single dots, without white space.
bool is_key(const std::string& text) {
  if (text.size() > longest_key) return false;
  const std::vector<std::string> parts = split(text, '.');
  const auto bad = [](const std::string& part) {
    return part.empty() || part.find_first_of(" \t\r\n") != std::string::npos;
  };
  return std::none_of(parts.begin(), parts.end(), bad);
}

/// "[{what: flip, bit: 3}]": a list is the value of a parameter that takes one.
std::string in_one_line(const YAML::Node& list) {
  YAML::Emitter text;
  text.SetSeqFormat(YAML::Flow);
  text.SetMapFormat(YAML::Flow);
  text << list;
  std::string line = text.c_str();
  std::replace(line.begin(), line.end(), '\n', ' ');
  return line;
}

/// Reads the leaves of nested maps or dotted keys.
class ConfigurationReader {
 public:
  explicit ConfigurationReader(const std::string& origin) : origin_(origin) {}

  std::map<std::string, Setting> read(const std::string& text) {
    const YAML::Node document = load_yaml(text, origin_);
    if (!document.IsNull()) read_map(document, "");
    return std::move(settings_);
  }

 private:
  [[noreturn]] void fail(const YAML::Mark& mark, const std::string& problem) const {
    fail_in_yaml(origin_, mark, problem);
  }

  void read_map(const YAML::Node& node, const std::string& prefix) {
    if (!node.IsMap())
      fail(node.Mark(), "expected 'key: value' lines" + (prefix.empty() ? "" : " for " + prefix));
    for (const auto& entry : node) {
      const YAML::Node& key = entry.first;
      const std::string name = key.IsScalar() ? key.Scalar() : "";
      const std::string path = prefix.empty() ? name : prefix + "." + name;
      if (!is_key(name) || !is_key(path)) fail(key.Mark(), std::string("a key is ") + key_form);
      read_value(key, entry.second, path);
    }
  }

  void read_value(const YAML::Node& key, const YAML::Node& value, const std::string& path) {
    if (value.IsMap()) return read_map(value, path);
    const bool is_list =
        value.IsSequence() && std::all_of(value.begin(), value.end(),
                                          [](const YAML::Node& item) { return item.IsMap(); });
    if (value.IsSequence() && !is_list)
      fail(value.Mark(), "'" + path + "' is a list: write one value for each key");
    if (!value.IsScalar() && !is_list) fail(key.Mark(), "'" + path + "' has no value");
    const int line = key.Mark().line + 1;
    const auto [existing, is_new] =
        settings_.emplace(path, Setting{is_list ? in_one_line(value) : value.Scalar(),
                                        origin_ + ":" + std::to_string(line), is_list});
    if (!is_new)
      fail(key.Mark(), "'" + path + "' is set twice, first at " + existing->second.origin);
  }

  std::string origin_;
  std::map<std::string, Setting> settings_;
};

/// True if YAML reads the text back without quotes.
bool is_plain(const std::string& value) {
  constexpr const char* letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_./";
  constexpr const char* digits = "0123456789";
  if (value.empty() || trim(value) != value) return false;
  if (value == "null" || value == "Null" || value == "NULL") return false;
  if (value.find_first_not_of(std::string(letters) + digits + " +-%") != std::string::npos)
    return false;
  const std::size_t first = value[0] == '-' ? 1 : 0;
  if (first == 1) return value.find_first_of(digits) == 1;
  return (std::string(letters) + digits).find(value[0]) != std::string::npos;
}

std::string quoted(const std::string& value) {
  std::string text = "\"";
  for (const char c : value) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      text += std::string("\\") + c;
    } else if (byte < 0x20 || byte == 0x7f) {
      text += std::string("\\x") + "0123456789abcdef"[byte >> 4] + "0123456789abcdef"[byte & 15];
    } else {
      text += c;
    }
  }
  return text + "\"";
}

std::string comment(const ParameterDescription& parameter) {
  std::vector<std::string> facts{to_string(parameter.source)};
  if (!parameter.allowed.empty()) facts.push_back(parameter.allowed);
  if (!parameter.follows.empty()) facts.push_back("follows " + parameter.follows);
  if (parameter.value != parameter.default_value)
    facts.push_back("default " + parameter.default_value);
  std::string text = parameter.documentation + " (" + join(facts, "; ") + ")";
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// True for what a file must hold; the rest follows from it.
bool is_pinned(const ParameterDescription& parameter) {
  return parameter.follows.empty() || parameter.value != parameter.default_value;
}

/// A line of YAML at its depth; as a comment if it is not `live`.
std::string yaml_line(std::size_t depth, bool live, const std::string& text) {
  return std::string(2 * depth, ' ') + (live ? "" : "# ") + text;
}

/// Parameters (those of one module together, as Configuration::parameters() orders them) as YAML
/// that reads back.
std::string write_yaml(const std::vector<ParameterDescription>& parameters) {
  constexpr std::size_t comment_column = 48;
  const auto holds_pinned = [&parameters](const std::string& group) {
    return std::any_of(parameters.begin(), parameters.end(), [&group](const auto& parameter) {
      return is_pinned(parameter) && parameter.path.compare(0, group.size(), group) == 0;
    });
  };
  std::string text;
  std::vector<std::string> open;
  for (const ParameterDescription& parameter : parameters) {
    std::vector<std::string> parts = split(parameter.path, '.');
    const std::string name = parts.back();
    parts.pop_back();
    const auto common = std::mismatch(parts.begin(), parts.end(), open.begin(), open.end()).first;
    for (auto group = common; group != parts.end(); ++group) {
      const std::string path = join({parts.begin(), group + 1}, ".") + ".";
      text += yaml_line(group - parts.begin(), holds_pinned(path), *group + ":\n");
    }
    const std::string value = is_plain(parameter.value) ? parameter.value : quoted(parameter.value);
    std::string line = yaml_line(parts.size(), is_pinned(parameter), name + ": " + value);
    line.resize(std::max(line.size(), comment_column), ' ');
    text += line + "  # " + comment(parameter) + "\n";
    open = std::move(parts);
  }
  return text;
}

}  // namespace

const char* to_string(Source source) {
  switch (source) {
    case Source::measured:
      return "measured";
    case Source::published:
      return "published";
    case Source::derived:
      return "derived";
    case Source::assumed:
      return "assumed";
    case Source::decision:
      return "decision";
  }
  return "";
}

void Configuration::load_file(const std::string& path) {
  load_text(read_text(path, "configuration"), path);
}

void Configuration::load_text(const std::string& yaml, const std::string& origin) {
  for (auto& [key, setting] : ConfigurationReader(origin).read(yaml)) from_files_[key] = setting;
}

void Configuration::set(std::string_view assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos) {
    throw InputError("--set '" + std::string(assignment) +
                     "': write path=value, such as --set pl.width='320 px'");
  }
  set(assignment.substr(0, equals), assignment.substr(equals + 1));
}

void Configuration::set(std::string_view path, std::string_view value, std::string_view origin) {
  const std::string key(trim(path));
  if (!is_key(key)) {
    throw InputError("'" + key + "' (" + std::string(origin) + ") is not a key: write " + key_form);
  }
  from_command_line_[key] = {std::string(trim(value)), std::string(origin)};
}

const Setting* Configuration::find(const std::string& path) const {
  for (const Settings* layer : {&from_command_line_, &from_files_}) {
    const auto found = layer->find(path);
    if (found != layer->end()) return &found->second;
  }
  return nullptr;
}

void Configuration::add(ParameterDescription description) {
  const auto [position, is_new] = index_.emplace(description.path, parameters_.size());
  if (is_new) {
    parameters_.push_back(std::move(description));
  } else {
    parameters_[position->second] = std::move(description);
  }
}

void Configuration::set_follows(const std::string& path, const std::string& others) {
  parameters_.at(index_.at(path)).follows = others;
}

std::string Configuration::unknown_key(const std::string& key, const Setting& setting) const {
  const std::string start = "unknown key '" + key + "' (" + setting.origin + "): ";
  std::vector<std::string> paths;
  std::vector<std::string> inside;
  for (const ParameterDescription& parameter : parameters_) {
    paths.push_back(parameter.path);
    if (parameter.path.compare(0, key.size() + 1, key + ".") == 0) inside.push_back(parameter.path);
  }
  if (!inside.empty())
    return start + "it is a group of parameters, such as '" + inside.front() + "'";
  const std::string nearest = nearest_match(key, paths);
  if (nearest.empty()) {
    return start + "the configuration has nothing like it; `markervp config` prints its keys";
  }
  return start + "did you mean '" + nearest + "'?";
}

void Configuration::check_unused() const {
  // Each one is compared with every key there is.
  constexpr std::size_t most_told = 10;
  std::vector<std::string> problems;
  std::size_t untold = 0;
  for (const Settings* layer : {&from_files_, &from_command_line_}) {
    for (const auto& [key, setting] : *layer) {
      if (index_.count(key) != 0) continue;
      if (problems.size() < most_told)
        problems.push_back(unknown_key(key, setting));
      else
        ++untold;
    }
  }
  if (untold > 0) problems.push_back("and " + std::to_string(untold) + " more");
  if (!problems.empty()) throw InputError(join(problems, "; "));
}

std::vector<ParameterDescription> Configuration::parameters() const {
  Group root;
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    const std::vector<std::string> parts = split(parameters_[i].path, '.');
    Group* group = &root;
    for (std::size_t depth = 0; depth + 1 < parts.size(); ++depth)
      group = &group->group(parts[depth]);
    group->leaves.push_back(i);
  }
  std::vector<std::size_t> order;
  root.collect(order);
  std::vector<ParameterDescription> ordered;
  ordered.reserve(order.size());
  for (const std::size_t i : order) ordered.push_back(parameters_[i]);
  return ordered;
}

std::string Configuration::to_yaml() const {
  return write_yaml(parameters());
}

std::map<std::string, std::string> Configuration::values() const {
  std::map<std::string, std::string> values;
  for (const ParameterDescription& parameter : parameters_)
    values[parameter.path] = parameter.value;
  return values;
}

std::string Configuration::hash() const {
  std::uint64_t hash = 0xcbf29ce484222325;
  const auto mix = [&hash](const std::string& text) {
    for (const unsigned char byte : text) hash = (hash ^ byte) * 0x100000001b3;
    hash = hash * 0x100000001b3;  // a zero byte: "ab", "c" is not "a", "bc"
  };
  for (const auto& [path, value] : values()) {
    mix(path);
    mix(value);
  }
  std::string digits;
  for (int shift = 60; shift >= 0; shift -= 4) digits += "0123456789abcdef"[(hash >> shift) & 15];
  return digits;
}

Configuration* Configuration::current() {
  return current_configuration;
}

Configuration::Scope::Scope(Configuration& configuration) : outer_(current_configuration) {
  current_configuration = &configuration;
}

Configuration::Scope::~Scope() {
  current_configuration = outer_;
}

}  // namespace vp
