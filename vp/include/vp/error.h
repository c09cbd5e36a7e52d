#pragma once

#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

namespace vp {

/// The user asked for something that cannot be: a wrong key, unit, file or input. The message is
/// one line that says what, where and what to do; the command line prints it and exits with code 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A value that the parameter `path` does not take, whatever the other parameters are.
class ParameterError : public InputError {
 public:
  ParameterError(std::string path, const std::string& message)
      : InputError(message), path_(std::move(path)) {}

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// The machine failed: a disk is full or broken, or no file descriptor is left. What ends with it
/// says nothing about the design or its inputs.
class HostError : public InputError {
 public:
  using InputError::InputError;

  /// Whether an error of the system is one of the machine, not of what was asked for.
  static bool is_cause(const std::error_code& code);
};

/// The modelled hardware or the software broke a protocol rule in a way that ends the run: exit
/// code 3.
class ProtocolError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace vp
