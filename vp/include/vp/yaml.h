#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

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

}  // namespace vp
