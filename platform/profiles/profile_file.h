#pragma once

#include <filesystem>
#include <set>
#include <string>

#include <nlohmann/json.hpp>

namespace platform::profiles {

/// A JSON file whose errors name the file and the entry.
class ProfileFile {
 public:
  using Json = nlohmann::json;

  /// Throws vp::InputError if it cannot be read or is not a JSON object of this version.
  explicit ProfileFile(const std::filesystem::path& path);

  const Json& root() const { return root_; }
  const std::filesystem::path& path() const { return path_; }

  /// Throws vp::InputError: "profile FILE: problem".
  [[noreturn]] void refuse(const std::string& problem) const;

  /// A member of an object; `where` is the object in words, for the message.
  const Json& member(const Json& object, const std::string& key, const std::string& where) const;
  const Json& object(const Json& object, const std::string& key, const std::string& where) const;
  std::string text(const Json& object, const std::string& key, const std::string& where) const;
  /// From `min` to `max`.
  double number(const Json& object, const std::string& key, const std::string& where, double min,
                double max) const;
  /// Throws if `object` has a key that is none of `known`, with the nearest of them.
  void only(const Json& object, const std::set<std::string>& known, const std::string& where) const;

 private:
  std::filesystem::path path_;
  Json root_;
};

}  // namespace platform::profiles
