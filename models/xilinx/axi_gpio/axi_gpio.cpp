#include <xilinx/axi_gpio/axi_gpio.h>

#include <vp/clock_scheduler.h>
#include <xilinx/common/axi_lite_ip.h>

#include <algorithm>

namespace xilinx {

namespace {

std::uint32_t reset_direction(GpioDirection direction, std::uint32_t tri_default) {
  switch (direction) {
    case GpioDirection::all_outputs:
      return 0;
    case GpioDirection::all_inputs:
      return 0xFFFFFFFF;
    default:
      return tri_default;
  }
}

using namespace axi_gpio;

constexpr std::uint32_t all_ones = 0xFFFFFFFF;

// Listener ids: pins of channel 1, pins of channel 2, the reset.
constexpr std::uint32_t pins_1 = 1, pins_2 = 2, reset_pin = 3;

}  // namespace

AxiGpioChannel::AxiGpioChannel(const std::string& prefix, const GpioChannelBuild& build,
                               vp::Clocked& owner)
    : direction((prefix + "_direction").c_str(), build.direction,
                {{"mixed", GpioDirection::mixed},
                 {"all_outputs", GpioDirection::all_outputs},
                 {"all_inputs", GpioDirection::all_inputs}},
                vp::Source::published, "build option All Outputs / All Inputs (PG144)"),
      width((prefix + "_width").c_str(), build.width, vp::Unit::none, {1, 32},
            vp::Source::published, "bits of the channel (PG144)"),
      dout_default((prefix + "_dout_default").c_str(), build.dout_default, vp::Unit::address,
                   vp::Source::published, "output register after reset (PG144)"),
      tri_default((prefix + "_tri_default").c_str(), build.tri_default, vp::Unit::address,
                  vp::Source::published, "direction register after reset (PG144)"),
      io_i((prefix + "_io_i").c_str(), &owner),
      io_o((prefix + "_io_o").c_str(), width,
           direction == GpioDirection::all_inputs ? 0 : dout_default & mask()),
      io_t((prefix + "_io_t").c_str(), width, reset_direction(direction, tri_default) & mask()) {}

void AxiGpioChannel::drive(std::uint32_t data, std::uint32_t tri) {
  if (direction != GpioDirection::all_inputs) io_o = data;
  if (direction == GpioDirection::mixed) io_t = tri;
}

void AxiGpioChannel::start() {
  last_taken_ = io_i.bound() ? io_i.read() & mask() : 0;
  history_.assign(1, Sample{0, last_taken_});
}

void AxiGpioChannel::record(std::uint64_t cycle, bool track) {
  const Sample sample{cycle, io_i.read() & mask()};
  if (history_.size() > 1 && history_.back().cycle == cycle) {
    history_.back() = sample;  // the first flip-flop never saw the value between
    if (track) under_way_.back() = sample;
  } else {
    history_.push_back(sample);
    if (track) under_way_.push_back(sample);
  }
  while (history_.size() > 1 && history_[1].cycle + memory <= cycle) history_.pop_front();
}

std::uint32_t AxiGpioChannel::delayed(std::uint64_t cycle, std::uint64_t latency) const {
  std::size_t i = history_.size() - 1;
  while (i > 0 && history_[i].cycle + latency > cycle) --i;
  return history_[i].value;
}

std::uint64_t AxiGpioChannel::next_delayed(std::uint64_t cycle, std::uint64_t latency) const {
  std::uint64_t next = vp::Clock::never;
  for (std::size_t i = history_.size(); i > 1 && history_[i - 1].cycle + latency > cycle; --i) {
    next = history_[i - 1].cycle + latency;
  }
  return next;
}

std::uint64_t AxiGpioChannel::next_change(std::uint64_t latency) const {
  return under_way_.empty() ? vp::Clock::never : under_way_.front().cycle + latency;
}

bool AxiGpioChannel::take_changes(std::uint64_t cycle, std::uint64_t latency) {
  bool changed = false;
  while (!under_way_.empty() && under_way_.front().cycle + latency <= cycle) {
    changed |= under_way_.front().value != last_taken_;
    last_taken_ = under_way_.front().value;
    under_way_.pop_front();
  }
  return changed;
}

AxiGpio::AxiGpio(sc_core::sc_module_name name, vp::Clock& s_axi_aclk, const AxiGpioBuild& build)
    : Clocked(name, s_axi_aclk),
      Ip(&s_axi_aclk),
      is_dual("is_dual", build.is_dual, vp::Source::published,
              "build option Enable Dual Channel (PG144)"),
      interrupt_present("interrupt_present", build.interrupt_present, vp::Source::published,
                        "build option Enable Interrupt (PG144)"),
      input_latency("input_latency", 5, vp::Unit::cycles, {1, 8}, vp::Source::published,
                    "pin to register: 4 synchroniser stages and a register (HDL of v2.0)"),
      interrupt_latency("interrupt_latency", 2, vp::Unit::cycles, {0, 8}, vp::Source::published,
                        "register to interrupt status (HDL of v2.0)"),
      s_axi("s_axi", registers, axi_lite_options(address_bits), &s_axi_aclk.scheduler()),
      gpio("gpio", build.gpio, *this),
      gpio2("gpio2", build.gpio2, *this),
      gpio_data(s_axi[GPIO_DATA]),
      gpio_tri(s_axi[GPIO_TRI]),
      gpio2_data(s_axi[GPIO2_DATA]),
      gpio2_tri(s_axi[GPIO2_TRI]),
      gier(s_axi[GIER]),
      ip_isr(s_axi[IP_ISR]),
      ip_ier(s_axi[IP_IER]) {
  build_channel(gpio, gpio_data, gpio_tri);
  if (is_dual) {
    build_channel(gpio2, gpio2_data, gpio2_tri);
  } else {
    build_without_channel_2();
  }
  build_interrupt();
}

// One channel. Inputs pass a synchroniser of four registers (PG144).
vp::IpEstimate AxiGpio::own_estimate() const {
  const bool inputs = gpio.direction == GpioDirection::all_inputs;
  vp::IpEstimate e = axi_estimate("axi_gpio", inputs ? 90 : 70, inputs ? 260 : 110, 0);
  e.active_clocks = [this] { return clocks_per_access * accesses(s_axi); };
  return e;
}

void AxiGpio::build_channel(AxiGpioChannel& channel, vp::Register& data, vp::Register& tri) {
  data.set_writable(channel.mask());
  data.set_reset_value(channel.dout_default & channel.mask());
  tri.set_writable(channel.mask());
  tri.set_reset_value(channel.tri_default & channel.mask());
  data.computed_by([this, &channel, &data, &tri] { return read_data(channel, data, tri); });
  if (channel.direction == GpioDirection::all_inputs) {
    data.stable_until([this, &channel] {
      const std::uint64_t next = channel.next_delayed(clock().cycle(), input_latency);
      return next == vp::Clock::never ? next : clock().time_of(next);
    });
  }
  if (channel.direction != GpioDirection::mixed) tri.computed_by([] { return all_ones; });
  const auto write = [&channel, &data, &tri](std::uint32_t) { channel.drive(data, tri); };
  data.after_write(write);
  tri.after_write(write);
}

void AxiGpio::build_without_channel_2() {
  gpio2_data.remove();
  gpio2_tri.computed_by([] { return all_ones; });
}

void AxiGpio::build_interrupt() {
  if (!interrupt_present) {
    gier.remove();
    ip_isr.remove();
    ip_ier.remove();
    return;
  }
  const std::uint32_t channels = channel::Channel_1 | (is_dual ? channel::Channel_2 : 0);
  ip_isr.set_writable(channels);
  ip_ier.set_writable(channels);
  for (vp::Register* r : {&gier, &ip_isr, &ip_ier}) {
    r->after_write([this](std::uint32_t) { update_interrupt(); });
  }
}

std::uint32_t AxiGpio::read_data(const AxiGpioChannel& channel, const vp::Register& data,
                                 const vp::Register& tri) const {
  if (channel.direction == GpioDirection::all_outputs) return data;
  const std::uint32_t pins = channel.delayed(clock().cycle(), input_latency);
  if (channel.direction == GpioDirection::all_inputs) return pins;
  return (data & ~tri & channel.mask()) | (pins & tri);
}

void AxiGpio::before_end_of_elaboration() {
  Clocked::before_end_of_elaboration();
  if (gpio.io_i.bound()) gpio.io_i.signal()->attach(*this, pins_1);
  if (is_dual && gpio2.io_i.bound()) gpio2.io_i.signal()->attach(*this, pins_2);
  if (s_axi_aresetn.bound()) s_axi_aresetn.signal()->attach(*this, reset_pin);
}

void AxiGpio::start_of_simulation() {
  gpio.start();
  gpio2.start();
  s_axi.hold_in_reset(s_axi_aresetn.bound() && !s_axi_aresetn);
}

void AxiGpio::on_change(vp::SignalBase&, std::uint32_t id) {
  if (id == reset_pin) {
    if (!s_axi_aresetn) reset();
    s_axi.hold_in_reset(!s_axi_aresetn);
    return;
  }
  (id == pins_1 ? gpio : gpio2).record(clock().cycle(), interrupt_present);
  plan_interrupt();
}

// The synchronisers have no reset; what is under way through them is not seen by the interrupt
// logic in reset.
void AxiGpio::reset() {
  s_axi.reset();
  gpio.drive(gpio_data, gpio_tri);
  if (is_dual) gpio2.drive(gpio2_data, gpio2_tri);
  update_interrupt();
}

void AxiGpio::plan_interrupt() {
  if (!interrupt_present) return;
  const std::uint64_t latency = std::uint64_t{input_latency} + interrupt_latency;
  const std::uint64_t due = std::min(gpio.next_change(latency), gpio2.next_change(latency));
  if (due != vp::Clock::never) wake_at(due);
}

// Runs only when an input change reaches the interrupt status. Any change counts, enabled or not.
void AxiGpio::edge() {
  sleep();
  if (!interrupt_present) return;
  const std::uint64_t latency = std::uint64_t{input_latency} + interrupt_latency;
  const std::uint64_t cycle = clock().cycle();
  std::uint32_t changed = 0;
  if (gpio.take_changes(cycle, latency)) changed |= channel::Channel_1;
  if (gpio2.take_changes(cycle, latency)) changed |= channel::Channel_2;
  if (changed != 0 && !s_axi.held_in_reset()) {
    ip_isr.set_bits(changed);
    update_interrupt();
  }
  plan_interrupt();
}

void AxiGpio::update_interrupt() {
  ip2intc_irpt = gier.any(axi_gpio::gier::Global_Interrupt_Enable) && (ip_isr & ip_ier) != 0;
}

}  // namespace xilinx
