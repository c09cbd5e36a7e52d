#pragma once

#include <stdexcept>

namespace vp {

/// The user asked for something that cannot be: a wrong key, unit, file or image. The message is
/// one line that says what, where and what to do; the command line prints it and exits with code 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The modelled hardware or the software broke a protocol rule in a way that ends the run: exit
/// code 3.
class ProtocolError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace vp
