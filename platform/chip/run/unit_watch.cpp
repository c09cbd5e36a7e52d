#include <chip/run/unit_watch.h>

#include <vp/clock_scheduler.h>

namespace platform {

// A pin changes in the middle of an edge: the bench looks at the chip behind it, at the same time.
UnitWatch::UnitWatch(sc_core::sc_module_name name, Zynq& zynq, UnitSource& source,
                     FrameBench& bench)
    : sc_module(name), zynq_(zynq), source_(source), bench_(bench) {
  if (vp::SignalBase* signal = source_.unit_end()) {
    signal->defer_writes();
    signal->attach(*this);
  }
  SC_HAS_PROCESS(UnitWatch);
  SC_METHOD(ended);
  sensitive << rose_;
  dont_initialize();
}

void UnitWatch::on_change(vp::SignalBase& signal, std::uint32_t) {
  if (signal.bits() != 0) zynq_.scheduler.notify(rose_);
}

void UnitWatch::printed(const std::string& line) {
  const std::string& text = source_.unit_line();
  if (!text.empty() && line.find(text) != std::string::npos) ended();
}

void UnitWatch::ended() {
  zynq_.scheduler.synchronise();
  bench_.publish(0, nullptr, 0, zynq_.scheduler.now_ps());
}

}  // namespace platform
