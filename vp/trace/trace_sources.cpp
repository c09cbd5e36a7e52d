#include "trace_sources.h"

namespace vp {

namespace {

template <class Visit>
void visit_objects(const std::vector<sc_core::sc_object*>& objects, const Visit& visit) {
  for (sc_core::sc_object* object : objects) {
    visit(*object);
    visit_objects(object->get_child_objects(), visit);
  }
}

template <class T>
bool adopt(sc_core::sc_object& object, TraceSource& source) {
  auto* signal = dynamic_cast<sc_core::sc_signal_in_if<T>*>(&object);
  if (!signal) return false;
  source.width = default_width<T>();
  source.foreign_bits = [signal] { return static_cast<std::uint64_t>(signal->read()); };
  source.foreign_event = &signal->value_changed_event();
  return true;
}

/// The types that Verilator and common models use for pins of up to 64 bits.
bool adopt_foreign(sc_core::sc_object& object, TraceSource& source) {
  return adopt<bool>(object, source) || adopt<std::uint8_t>(object, source) ||
         adopt<std::uint16_t>(object, source) || adopt<std::uint32_t>(object, source) ||
         adopt<std::uint64_t>(object, source) || adopt<std::int32_t>(object, source);
}

}  // namespace

std::vector<TraceSource> find_trace_sources() {
  std::vector<TraceSource> sources;
  visit_objects(sc_core::sc_get_top_level_objects(), [&](sc_core::sc_object& object) {
    TraceSource source;
    source.path = object.name();
    if (auto* signal = dynamic_cast<SignalBase*>(&object)) {
      source.width = signal->width();
      source.real = signal->is_real();
      source.signal = signal;
      source.probe = dynamic_cast<const ProbeBase*>(signal);
      source.text = dynamic_cast<const TextSignal*>(signal);
    } else if (!adopt_foreign(object, source)) {
      return;
    }
    sources.push_back(std::move(source));
  });
  return sources;
}

std::vector<Clock*> find_clocks(const ClockScheduler& scheduler) {
  std::vector<Clock*> clocks;
  visit_objects(sc_core::sc_get_top_level_objects(), [&](sc_core::sc_object& object) {
    auto* clock = dynamic_cast<Clock*>(&object);
    if (clock && &clock->scheduler() == &scheduler) clocks.push_back(clock);
  });
  return clocks;
}

ProbeBase::ProbeBase(const char* name, unsigned width, const void* address, std::size_t byte_count)
    : SignalBase(name), width_(width), address_(address), byte_count_(byte_count) {}

// Nobody writes through a probe.
void ProbeBase::commit() {}

}  // namespace vp
