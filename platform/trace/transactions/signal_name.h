#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace platform::trace {

/// The path of a signal, cut into what names of buses are made of.
struct SignalName {
  enum class Direction : std::uint8_t { none, in, out };

  /// `path`: levels separated by '.'.
  explicit SignalName(std::string_view path);

  /// All words of the path in small letters, without separators, without the direction and without
  /// the structures' `req` and `resp`: signals of one bus have equal keys but for their role.
  std::string key;
  std::vector<std::string> words;         ///< of the last level, and of one or two levels before it
  Direction direction = Direction::none;  ///< of "_i", "_o", "i_", "o_"

  /// The last words are this role: "awvalid" of `aw_valid`, `req.aw.valid`, `gmem_AWVALID`. Roles
  /// of five letters and more that begin with `aw` or `ar` need no separator before them.
  bool ends_in(std::string_view role) const;
  /// The key without a role that it ends in.
  std::string stem(std::string_view role) const {
    return key.substr(0, key.size() - role.size() - index_.size()) + index_;
  }

 private:
  std::string index_;  ///< of an array's element, "[0]", which `key` ends with
};

/// The key of the signal that has this role on the bus of `stem`.
std::string key_with(const std::string& stem, std::string_view role);

/// What the path says without its role, direction and `req`: "tb.dut.m_axi". Its level alone if
/// the bus has a level to itself.
std::string name_without(const std::string& path, std::string_view role);

}  // namespace platform::trace
