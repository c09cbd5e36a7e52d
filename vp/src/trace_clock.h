#pragma once

#include <vp/clock.h>
#include <vp/trace.h>
#include <vp/wave_writer.h>

#include <cstdint>

namespace vp {

/// Watches the edges of one clock for a tracer; sleeps outside the time window.
class TraceClock final : public Clocked {
 public:
  TraceClock(sc_core::sc_module_name name, Clock& clock, Tracer& tracer)
      : Clocked(name, clock), tracer_(tracer) {
    sleep();
  }

  /// Whether the clock is high at `ps`, the present instant, and if so until when. Right after a
  /// change of frequency it is taken as high, as after an edge.
  bool high_at(std::uint64_t ps, std::uint64_t& until_ps) const {
    const std::uint64_t next = clock().cycle_at_or_after(ps);
    if (next == Clock::never) return false;
    const bool rises_now = clock().time_of(next) == ps;
    if (!rises_now && next == 1) return false;
    until_ps = (rises_now ? ps : clock().time_of(next - 1)) + half_period_ps();
    return ps < until_ps;
  }
  std::uint64_t half_period_ps() const { return clock().duration_ps(0.5); }

  bool selected = false;
  WaveWriter::Id id = 0;
  std::uint64_t fall_ps = Clock::never;

 private:
  void edge() override {
    if (tracer_.recording_) {
      tracer_.rise(*this, clock().scheduler().now_ps());
    } else {
      sleep();
    }
  }

  Tracer& tracer_;
};

}  // namespace vp
