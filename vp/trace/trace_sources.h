#pragma once

#include <vp/clock.h>
#include <vp/probe.h>
#include <vp/signal.h>
#include <vp/trace.h>
#include <vp/wave_writer.h>

#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <systemc>
#include <vector>

namespace vp {

/// Something that a trace can show: a signal, a probe, or a standard sc_signal of a foreign module.
struct TraceSource {
  std::string path;
  unsigned width = 1;
  bool real = false;
  SignalBase* signal = nullptr;                 ///< null for a standard sc_signal
  const ProbeBase* probe = nullptr;             ///< the same object, if it is a probe
  const TextSignal* text = nullptr;             ///< the same object, if it is a text
  std::function<std::uint64_t()> foreign_bits;  ///< of a standard sc_signal
  const sc_core::sc_event* foreign_event = nullptr;

  std::uint64_t bits() const { return signal ? signal->bits() : foreign_bits(); }
};

/// All of the simulation, in the order in which they were made.
std::vector<TraceSource> find_trace_sources();

/// The clocks that `scheduler` runs, in the order in which they were made.
std::vector<Clock*> find_clocks(const ClockScheduler& scheduler);

/// Looks at all traced probes at the end of an instant. Probes that lie in memory are compared
/// without a call, which makes thousands of them bearable.
class ProbePoll {
 public:
  void add(const ProbeBase& probe, WaveWriter::Id id) {
    if (!probe.address()) {
      called_.push_back({&probe, id});
      return;
    }
    switch (probe.byte_count()) {
      case 1:
        bytes_.push_back({probe.address(), id});
        break;
      case 2:
        halves_.push_back({probe.address(), id});
        break;
      case 4:
        words_.push_back({probe.address(), id});
        break;
      default:
        doubles_.push_back({probe.address(), id});
        break;
    }
  }

  /// Calls changed(id, bits) for every probe whose value is not values[id].
  template <class Changed>
  void run(const std::vector<std::uint64_t>& values, const Changed& changed) const {
    compare<std::uint8_t>(bytes_, values, changed);
    compare<std::uint16_t>(halves_, values, changed);
    compare<std::uint32_t>(words_, values, changed);
    compare<std::uint64_t>(doubles_, values, changed);
    for (const Called& called : called_) {
      const std::uint64_t bits = called.probe->bits();
      if (bits != values[called.id]) changed(called.id, bits);
    }
  }

 private:
  struct InMemory {
    const void* address;
    WaveWriter::Id id;
  };
  struct Called {
    const ProbeBase* probe;
    WaveWriter::Id id;
  };

  template <class Word, class Changed>
  static void compare(const std::vector<InMemory>& probes, const std::vector<std::uint64_t>& values,
                      const Changed& changed) {
    for (const InMemory& probe : probes) {
      Word word;
      std::memcpy(&word, probe.address, sizeof word);
      if (word != values[probe.id]) changed(probe.id, std::uint64_t{word});
    }
  }

  std::vector<InMemory> bytes_, halves_, words_, doubles_;
  std::vector<Called> called_;
};

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
