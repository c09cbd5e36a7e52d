#pragma once

#include <optional>
#include <string>

#include <study/shards.h>

namespace platform::study {

/// A point that the user names: "out/mine:KEY", or a file out/mine/points/KEY.json, kept or not.
struct NamedPoint {
  std::string name;    ///< as the user has it
  std::string folder;  ///< of its sweep
  std::string key;
  AskedPoint asked;
  bool failed = false;
  std::string message;  ///< if it failed
  Json kept;            ///< its whole result, if that is kept; else null
  /// Its complete effective configuration, if that is kept; else empty.
  std::map<std::string, std::string> configuration = {};
};

/// Whether the text has the form of a point's name. It may be missing.
bool names_point(const std::string& text);

/// Throws vp::InputError for a text that names no point, a point that its folder does not have, and
/// a file that is damaged.
NamedPoint named_point(const std::string& text);

}  // namespace platform::study
