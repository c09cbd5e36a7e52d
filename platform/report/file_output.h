#pragma once

#include <string>
#include <string_view>

namespace platform::report {

/// Makes the folder (and those above it) if missing and proves that files can be written into it.
/// Throws vp::InputError otherwise; leaves no file behind. Returns whether it made the folder.
bool prepare_output_folder(const std::string& folder);

/// A file that appears under its name only when it is complete: written beside it, then renamed.
/// Without commit() nothing is left. Failures throw vp::InputError that names the file.
class AtomicFile {
 public:
  explicit AtomicFile(std::string path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::string_view bytes);
  void commit();

 private:
  [[noreturn]] void fail(const std::string& what);

  std::string path_;
  std::string temporary_;
  int descriptor_;
};

}  // namespace platform::report
