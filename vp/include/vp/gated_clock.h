#pragma once

#include <cstdint>

#include <vp/clock.h>

namespace vp {

/// A clock behind a gate that lets whole periods through (BUFGCE or BUFHCE, UG472): while it is
/// open, its edges are those of its source; they are counted on their own.
///
/// Its modules see the same sequence of edges whatever the gate does: a module that counts clocks
/// needs no enable. At coincident edges they run before those of the source, so that one of these
/// may work the gate.
class GatedClock : public Clock, private ClockListener {
 public:
  /// Open.
  GatedClock(const char* name, Clock& source);

  /// What the source's edges after now are: let through, or not. Not on an edge of this clock.
  void open(bool open);
  const Clock& source() const override { return source_; }

 private:
  void before_change(Clock&) override {}
  void after_change(Clock&) override;

  Clock& source_;
  bool open_ = true;
};

}  // namespace vp
