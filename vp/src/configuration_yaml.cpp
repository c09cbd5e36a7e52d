#include "configuration_yaml.h"

#include <vp/text.h>
#include <vp/yaml.h>

#include <algorithm>

namespace vp {
namespace {

class Reader {
 public:
  explicit Reader(const std::string& origin) : origin_(origin) {}

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
    if (value.IsSequence())
      fail(value.Mark(), "'" + path + "' is a list: write one value for each key");
    if (!value.IsScalar()) fail(key.Mark(), "'" + path + "' has no value");
    const int line = key.Mark().line + 1;
    const auto [existing, is_new] =
        settings_.emplace(path, Setting{value.Scalar(), origin_ + ":" + std::to_string(line)});
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
  if (parameter.value != parameter.default_value)
    facts.push_back("default " + parameter.default_value);
  std::string text = parameter.documentation + " (" + join(facts, "; ") + ")";
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

}  // namespace

bool is_key(const std::string& text) {
  if (text.size() > longest_key) return false;
  const std::vector<std::string> parts = split(text, '.');
  const auto bad = [](const std::string& part) {
    return part.empty() || part.find_first_of(" \t\r\n") != std::string::npos;
  };
  return std::none_of(parts.begin(), parts.end(), bad);
}

std::map<std::string, Setting> read_yaml(const std::string& text, const std::string& origin) {
  return Reader(origin).read(text);
}

std::string write_yaml(const std::vector<ParameterDescription>& parameters) {
  constexpr std::size_t comment_column = 48;
  std::string text;
  std::vector<std::string> open;
  for (const ParameterDescription& parameter : parameters) {
    std::vector<std::string> parts = split(parameter.path, '.');
    const std::string name = parts.back();
    parts.pop_back();
    const auto [common, unused] =
        std::mismatch(parts.begin(), parts.end(), open.begin(), open.end());
    (void)unused;
    for (auto group = common; group != parts.end(); ++group) {
      text += std::string(2 * (group - parts.begin()), ' ') + *group + ":\n";
    }
    std::string line = std::string(2 * parts.size(), ' ') + name + ": ";
    line += is_plain(parameter.value) ? parameter.value : quoted(parameter.value);
    line.resize(std::max(line.size(), comment_column), ' ');
    text += line + "  # " + comment(parameter) + "\n";
    open = std::move(parts);
  }
  return text;
}

}  // namespace vp
