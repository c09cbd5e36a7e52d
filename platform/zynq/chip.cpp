#include <zynq/chip.h>

#include <cmath>

#include <vp/error.h>

namespace platform {

namespace {

const device::Device& chosen(const vp::Parameter<std::string>& name) {
  try {
    return device::find_device(name);
  } catch (const vp::InputError& error) {
    throw vp::InputError(std::string(name.name()) + ": " + error.what());
  }
}

}  // namespace

Chip::Chip()
    : name(
          "device", "xc7z020-1", vp::Source::published,
          "chip and speed grade: what fits, how fast, which clocks; 'markervp devices' lists them"),
      clocks("clocks", ClockMode::made, {{"made", ClockMode::made}, {"exact", ClockMode::exact}},
             vp::Source::decision,
             "made: clocks have what PLLs and dividers give, the nearest to what is asked for; "
             "exact: just that"),
      data(chosen(name)) {}

ClockSource::ClockSource(sc_core::sc_module_name name, vp::ClockScheduler& scheduler,
                         std::uint64_t default_hz, vp::Source source,
                         const std::string& documentation)
    : sc_module(name),
      frequency("frequency", default_hz, vp::Unit::frequency, {1'000, 1'000'000'000'000}, source,
                documentation),
      clk("clk", scheduler, frequency),
      start_hz_(frequency) {}

void ClockSource::make(double hz) {
  start_hz_ = static_cast<std::uint64_t>(std::llround(hz));
  if (clk.frequency_hz() != start_hz_) clk.set_frequency(start_hz_);
}

}  // namespace platform
