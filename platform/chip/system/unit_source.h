#pragma once

#include <string>

#include <vp/signal.h>

namespace platform {

/// What a design derives from, besides, whose units of work end without the program's word.
class UnitSource {
 public:
  virtual ~UnitSource() = default;
  /// A unit ends when it rises; null: no signal says so.
  virtual vp::SignalBase* unit_end() = 0;
  /// A unit ends when the program prints a line with this text; "": no line says so.
  virtual const std::string& unit_line() const = 0;
};

}  // namespace platform
