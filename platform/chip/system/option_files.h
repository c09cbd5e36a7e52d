#pragma once

#include <string>

namespace platform {

/// A design that knows what the files mean that its program's options name (hal_option_info). The
/// program gets what they hold as it is, unless the design is one of these too.
class OptionFiles {
 public:
  OptionFiles() = default;
  virtual ~OptionFiles() = default;
  OptionFiles(const OptionFiles&) = delete;
  OptionFiles& operator=(const OptionFiles&) = delete;

  /// What the program gets of the file `path` that the user names for its option `name`. Before the
  /// run, and before note_option(). Throws vp::InputError if it cannot be used.
  virtual std::string option_data(const std::string& name, const std::string& path) = 0;
};

}  // namespace platform
