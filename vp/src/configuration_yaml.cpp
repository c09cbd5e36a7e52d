#include "configuration_yaml.h"

#include <vp/error.h>
#include <vp/text.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>

namespace vp {
namespace {

/// No platform is nested deeper; an alias that contains itself is.
constexpr int max_depth = 32;

class Reader {
 public:
  explicit Reader(const std::string& origin) : origin_(origin) {}

  std::map<std::string, Setting> read(const std::string& text) {
    try {
      const std::vector<YAML::Node> documents = YAML::LoadAll(text);
      if (documents.size() > 1)
        fail(documents[1].Mark(), "a second document: a configuration file has one");
      if (!documents.empty() && !documents[0].IsNull()) read_map(documents[0], "", 0);
    } catch (const YAML::Exception& error) {
      fail(error.mark, error.msg);
    }
    return std::move(settings_);
  }

 private:
  [[noreturn]] void fail(const YAML::Mark& mark, const std::string& problem) const {
    std::string where = origin_;
    if (!mark.is_null())
      where += ":" + std::to_string(mark.line + 1) + ":" + std::to_string(mark.column + 1);
    throw InputError(where + ": " + problem);
  }

  void read_map(const YAML::Node& node, const std::string& prefix, int depth) {
    if (!node.IsMap())
      fail(node.Mark(), "expected 'key: value' lines" + (prefix.empty() ? "" : " for " + prefix));
    if (depth > max_depth) fail(node.Mark(), "nested too deeply");
    for (const auto& entry : node) {
      const YAML::Node& key = entry.first;
      if (!key.IsScalar() || !is_key(key.Scalar()))
        fail(key.Mark(), "a key is a name, or names joined by dots");
      const std::string path = prefix.empty() ? key.Scalar() : prefix + "." + key.Scalar();
      read_value(key, entry.second, path, depth);
    }
  }

  void read_value(const YAML::Node& key, const YAML::Node& value, const std::string& path,
                  int depth) {
    if (value.IsMap()) return read_map(value, path, depth + 1);
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
