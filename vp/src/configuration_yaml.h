#pragma once

#include <vp/configuration.h>

#include <map>
#include <string>
#include <vector>

namespace vp {

constexpr std::size_t longest_key = 500;
/// What is_key() asks for, in words.
constexpr const char* key_form = "a name, or names joined by dots, of at most 500 characters";

/// True for names joined by single dots, without white space.
bool is_key(const std::string& text);

/// The leaves of a YAML document of nested maps or dotted keys. Throws InputError
/// "origin:line:column: …" for malformed YAML, lists, missing values, duplicate keys, several
/// documents.
std::map<std::string, Setting> read_yaml(const std::string& text, const std::string& origin);

/// Parameters (those of one module together, as Configuration::parameters() orders them) as YAML
/// that reads back.
std::string write_yaml(const std::vector<ParameterDescription>& parameters);

}  // namespace vp
