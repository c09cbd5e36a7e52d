#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace vp {

/// A file that a user named, open for reading: a regular file or a pipe (`<(…)`, /dev/stdin).
/// Neither opening nor reading waits for ever, whatever stands behind the name.
class InputFile {
 public:
  using HostClock = std::chrono::steady_clock;

  /// How long a pipe may let its reader wait.
  static constexpr std::chrono::seconds patience{10};

  /// `what` says in messages what the file is: "trace". Throws InputError "cannot read trace
  /// 'name': reason" for what cannot be opened, a folder or a device.
  InputFile(const std::filesystem::path& path, std::string what);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// Up to `size` bytes; 0 at the end. Throws InputError if nothing has come until `deadline`.
  std::size_t read(char* to, std::size_t size, HostClock::time_point deadline);

  bool is_regular() const { return is_regular_; }
  /// In bytes, when it was opened; 0 for a pipe.
  std::uint64_t size() const { return size_; }
  /// For the kernel's calls on it.
  int descriptor() const { return descriptor_; }

 private:
  [[noreturn]] void fail(const std::string& reason) const;
  void wait_for_bytes(HostClock::time_point deadline) const;

  std::filesystem::path path_;
  std::string what_;
  int descriptor_ = -1;
  bool is_regular_ = false;
  std::uint64_t size_ = 0;
};

/// The largest document that a person writes: a configuration, a sweep, checks. 4 MiB.
constexpr std::uint64_t largest_by_hand = 1 << 22;

/// The whole file, of at most `most` bytes. A pipe has `patience` to end. Throws InputError as
/// InputFile does, and for a larger one.
std::string read_text(const std::filesystem::path& path, const std::string& what,
                      std::uint64_t most = largest_by_hand);

/// What to say of a shared object that dlopen() refused; `said` is the text of dlerror(). Continues
/// "cannot load program 'x.so': ".
std::string load_problem(const std::string& path, std::string_view said);

}  // namespace vp
