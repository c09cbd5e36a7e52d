#include <xilinx/axi_gpio/axi_gpio_channel.h>

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

}  // namespace xilinx
