#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include <trace/replay.h>

namespace platform::trace {

/// A part of a trace.
struct Window {
  std::uint64_t from_ps = 0;
  std::uint64_t to_ps = std::numeric_limits<std::uint64_t>::max();  ///< the first that is not in it
};

/// Takes the values that are there when a window begins, and then what changes in it.
class WindowReader : public vp::WaveHandler {
 public:
  /// ps, and the femtoseconds beyond them.
  using Moment = std::pair<std::uint64_t, unsigned>;

 protected:
  WindowReader(TraceFile& file, const Window& window) : file_(file), window_(window) {}

  /// Enters the trace as late as it can be. Throws vp::InputError if the window has nothing of it.
  void read();
  /// Once, when the values at the start are there: those of changes at `start` too.
  virtual void begin(Moment start) = 0;
  /// In each instant behind the start.
  virtual void reach(Moment now) = 0;

  bool begun() const { return begun_; }
  /// Where the file has got to, or the window's end.
  Moment now() const { return now_; }
  /// An event counts: it occurs in the window, not before it.
  bool is_inside() const { return begun_ || now_ == start(); }
  /// A trace has nothing before its first instant.
  Moment start() const { return std::max(Moment(window_.from_ps, 0), first_.value_or(Moment())); }

  /// steps() counts in ps, or in fs where a step of the file is no whole number of ps.
  bool counts_femtoseconds() const { return file_.reader().timescale_fs() % fs_per_ps != 0; }
  std::uint64_t steps(Moment moment) const;

  TraceFile& file_;

 private:
  static constexpr std::uint64_t fs_per_ps = 1000;
  bool at(std::uint64_t ps) final;
  void begin_once();

  Window window_;
  std::optional<Moment> first_;
  Moment now_;
  bool begun_ = false;
};

}  // namespace platform::trace
