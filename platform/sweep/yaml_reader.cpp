#include <algorithm>
#include <set>

#include <sweep/yaml_reader.h>
#include <vp/error.h>
#include <vp/text.h>

namespace platform::sweep {

std::string YamlReader::where(const YAML::Node& node) const {
  if (node.Mark().is_null()) return origin_;
  return origin_ + ":" + std::to_string(node.Mark().line + 1);
}

void YamlReader::fail(const YAML::Node& node, const std::string& problem) const {
  throw vp::InputError(where(node) + ": " + problem);
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
      const std::string nearest = vp::nearest_match(key, names);
      fail(entry.first, "unknown key '" + key + "' of " + what + ": " +
                            (nearest.empty() ? "" : "did you mean '" + nearest + "'? ") +
                            "there are " + vp::join(names, ", "));
    }
    if (!seen.insert(key).second) fail(entry.first, "'" + key + "' stands there twice");
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
  const std::string value = scalar(node, key);
  if (std::find(names.begin(), names.end(), value) != names.end()) return value;
  const std::string nearest = vp::nearest_match(value, names);
  fail(node, "'" + value + "' for '" + key + "': write " + vp::one_of(names) +
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

}  // namespace platform::sweep
