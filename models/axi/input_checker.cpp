#include <axi/input_checker.h>

#include <vp/clock_scheduler.h>
#include <vp/unit.h>

namespace axi {

namespace {

constexpr unsigned reset_clocks = 16;  ///< what AMD's IP ask for
constexpr unsigned stable_clocks = 2;  ///< of who samples: a path of several cycles

}  // namespace

// A reset that is active at the start is so from time 0 on.
void InputChecker::watch_reset(const std::string& pin, vp::SignalBase& signal, bool active_low,
                               const vp::Clock& clock) {
  signal.attach(*this, static_cast<std::uint32_t>(inputs_.size()));
  inputs_.push_back({pin, &clock, nullptr, active_low ? 1u : 0u, 0});
}

void InputChecker::watch_wire(const std::string& pin, vp::SignalBase& signal, const vp::Clock& from,
                              const vp::Clock& clock) {
  if (&from.source() == &clock.source() || signal.width() == 1) return;
  signal.attach(*this, static_cast<std::uint32_t>(inputs_.size()));
  inputs_.push_back({pin, &clock, &from, 0, vp::Clock::never});
}

void InputChecker::on_change(vp::SignalBase& signal, std::uint32_t id) {
  Input& input = inputs_[id];
  const std::uint64_t now = input.clock->scheduler().now_ps();
  if (input.from) {
    check_change(input, now);
  } else if (signal.bits() == input.inactive) {
    check_release(input, now);
  }
  input.since_ps = now;
}

void InputChecker::check_release(const Input& reset, std::uint64_t now_ps) {
  const vp::Clock& clock = *reset.clock;
  if (clock.frequency_hz() == 0) return;
  const std::uint64_t width = now_ps - reset.since_ps;
  if (width < clock.duration_ps(reset_clocks))
    reports_.violate(vp::Rule::reset_width, &clock,
                     "'" + reset.pin + "' was active for " + vp::format_time(width));
  if (clock.edge_at_or_after(now_ps) != now_ps)
    reports_.violate(vp::Rule::reset_domain, &clock, "'" + reset.pin + "' ends between two edges");
}

void InputChecker::check_change(const Input& wire, std::uint64_t now_ps) {
  if (wire.since_ps == vp::Clock::never || wire.clock->frequency_hz() == 0) return;
  const std::uint64_t stood = now_ps - wire.since_ps;
  if (stood >= wire.clock->duration_ps(stable_clocks)) return;
  reports_.violate(vp::Rule::clock_crossing, wire.clock,
                   "'" + wire.pin + "' comes from " + wire.from->name() + " and stayed for " +
                       vp::format_time(stood));
}

}  // namespace axi
