#pragma once

#include <vp/clock.h>
#include <vp/probe.h>
#include <vp/signal.h>
#include <vp/text_signal.h>

#include <cstdint>
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

}  // namespace vp
