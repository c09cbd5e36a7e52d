#pragma once

#include <vp/unit.h>
#include <yaml-cpp/yaml.h>

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace vp {

/// What to do with a file of several documents, which "---" separates.
enum class YamlDocuments { only_one, first };

/// Reads a text that anybody may have written. What a reader of the result needs of stack, memory
/// and time is bounded: nesting to 32 levels, 500 000 values after all aliases are expanded, no
/// anchor inside itself. Null for an empty text. Throws InputError "origin:line:column: …" that
/// says what to do.
YAML::Node load_yaml(const std::string& text, const std::string& origin,
                     YamlDocuments documents = YamlDocuments::only_one);

/// Throws InputError "origin:line:column: problem"; without the place if the mark has none.
[[noreturn]] void fail_in_yaml(const std::string& origin, const YAML::Mark& mark,
                               const std::string& problem);

/// Takes values out of YAML that a person wrote. Each function throws vp::InputError that names
/// file and line, and says what is expected there.
class YamlReader {
 protected:
  using Keys = std::map<std::string, std::function<void(const YAML::Node&)>>;

  explicit YamlReader(std::string origin) : origin_(std::move(origin)) {}

  /// File and line.
  std::string where(const YAML::Node& node) const;
  [[noreturn]] void fail(const YAML::Node& node, const std::string& problem) const;

  /// Calls what belongs to each key of the map; no key may be unknown, or twice.
  void for_each(const YAML::Node& map, const Keys& keys, const std::string& what) const;
  std::string scalar(const YAML::Node& node, const std::string& key) const;
  /// One value or a list of them.
  std::vector<std::string> scalars(const YAML::Node& node, const std::string& key) const;
  /// One of `names`.
  std::string choice(const YAML::Node& node, const std::string& key,
                     const std::vector<std::string>& names) const;
  std::uint64_t whole(const YAML::Node& node, const std::string& key, std::uint64_t min,
                      std::uint64_t max) const;
  /// "1.2 ms": a whole number of the unit's base, 0 to `max`.
  std::uint64_t quantity(const YAML::Node& node, const std::string& key, Unit unit,
                         std::uint64_t max) const;

 private:
  std::string origin_;
};

}  // namespace vp
