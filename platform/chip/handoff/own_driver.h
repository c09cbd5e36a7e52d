#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace platform::handoff {

/// A file by its path below an archive's or a packaged IP's folder, and what is in it.
using PathAndText = std::pair<std::string, std::string>;

/// Software that the owner packaged with an IP: programs include its headers and call it.
struct OwnDriver {
  std::string name;                                          ///< of its folder: "filter_v1_0"
  std::vector<std::string> peripherals;                      ///< the IP that it drives: "filter"
  std::vector<std::pair<std::string, std::string>> sources;  ///< of C: name, text
  /// What its script has the vendor's tools write, by command: the words behind it.
  std::map<std::string, std::vector<std::string>> scripts;

  bool drives(const std::string& ip) const;
  /// Whether a source is called so.
  bool has(const std::string& source) const;
};

/// Whether this is a file of a driver: drivers/NAME/src/… or …/data/….
bool is_of_driver(const std::string& path);

/// The drivers among files for which that holds. What runs on Linux alone is left out.
std::vector<OwnDriver> own_drivers(const std::vector<PathAndText>& files);

}  // namespace platform::handoff
