#pragma once

#include <cstdint>
#include <string>

#include <vp/error.h>
#include <nlohmann/json.hpp>

/// What a command of a test holds, by key. Each throws vp::InputError that names the key.
namespace platform {

inline std::string text_of(const nlohmann::json& command, const char* key) {
  const auto found = command.find(key);
  if (found == command.end() || !found->is_string())
    throw vp::InputError("needs '" + std::string(key) + "', a text");
  return found->get<std::string>();
}

inline std::uint64_t number_of(const nlohmann::json& command, const char* key, std::uint64_t most) {
  const auto found = command.find(key);
  if (found == command.end() || !found->is_number_unsigned() || found->get<std::uint64_t>() > most)
    throw vp::InputError("needs '" + std::string(key) + "', a whole number up to " +
                         std::to_string(most));
  return found->get<std::uint64_t>();
}

/// `otherwise` where the command does not have it.
inline std::uint64_t number_of(const nlohmann::json& command, const char* key, std::uint64_t most,
                               std::uint64_t otherwise) {
  return command.contains(key) ? number_of(command, key, most) : otherwise;
}

}  // namespace platform
