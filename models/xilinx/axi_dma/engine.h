#pragma once

#include <string>

namespace xilinx {

/// What moves data by itself, whether or not the program waits for it.
class Engine {
 public:
  virtual ~Engine() = default;
  /// What it is doing that nothing else reports at the end of a program: "MM2S was sending 64
  /// bytes". "" at rest.
  virtual std::string under_way() const = 0;
};

}  // namespace xilinx
