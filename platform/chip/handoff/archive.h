#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

struct zip;

namespace platform::handoff {

/// A hardware archive of Vivado (.xsa, .hdf): a zip of files in one folder. Nothing is written to
/// disk, and what a member unpacks to is bounded.
class Archive {
 public:
  /// The largest archive, and the largest file that is read from one, in bytes.
  static constexpr std::uint64_t largest = 1ull << 28, largest_member = 1ull << 26;

  /// Whether a file that begins so is a zip.
  static bool is_archive(const std::string& bytes);

  /// `bytes` of the file `origin`. Throws vp::InputError for a damaged archive, one with more
  /// than 10 000 members, or with names that leave its folder.
  Archive(std::string bytes, std::string origin);

  /// The names of its files, in its order.
  const std::vector<std::string>& names() const { return names_; }
  bool has(const std::string& name) const;
  /// The contents of one. Throws vp::InputError if it is missing, damaged or too large.
  std::string read(const std::string& name) const;

 private:
  [[noreturn]] void fail(const std::string& problem) const;

  std::string bytes_;
  std::string origin_;
  std::vector<std::string> names_;
  struct Close {
    void operator()(zip* opened) const;
  };
  std::unique_ptr<zip, Close> zip_;
};

}  // namespace platform::handoff
