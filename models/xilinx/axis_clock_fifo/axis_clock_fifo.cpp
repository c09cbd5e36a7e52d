#include <xilinx/axis_clock_fifo/axis_clock_fifo.h>

#include <string>

#include <vp/error.h>
#include <xilinx/bram/bram.h>
#include <xilinx/common/axi_lite_ip.h>

namespace xilinx {

namespace {

constexpr std::uint32_t fifo_reset_pin = 1;
constexpr std::uint32_t least_memory_depth = 64;  ///< deeper FIFOs are block memory (PG085)

}  // namespace

AxisClockFifo::AxisClockFifo(sc_core::sc_module_name name, vp::Clock& s_axis_aclk,
                             vp::Clock& m_axis_aclk, const AxisClockFifoBuild& build)
    : Clocked(name, s_axis_aclk),
      Ip(&s_axis_aclk),
      depth("depth", build.depth, vp::Unit::none, {2, 1u << 16}, vp::Source::published,
            "beats that it holds (PG085)"),
      pointer_latency("pointer_latency", pointer_clocks, vp::Unit::cycles, {1, 64},
                      vp::Source::assumed,
                      "clocks of one side until it sees what the other one did"),
      bytes_(build.bytes),
      fifo_(s_axis_aclk, m_axis_aclk, pointer_latency) {
  if (bytes_ < 1 || bytes_ > vp::most_stream_bytes)
    throw vp::InputError(std::string(this->name()) + ": streams of " + std::to_string(bytes_) +
                         " bytes are not modelled, those of 1 to " +
                         std::to_string(vp::most_stream_bytes) + " are");
  out_ = std::make_unique<Out>("out", m_axis_aclk, *this);
  const auto shape = [&](const char* end) {
    return vp::StreamShape{
        std::string(this->name()) + end, bytes_, build.strobe, build.user, build.id, build.dest};
  };
  s_axis.set_shape(shape(".s_axis"));
  out_->m_axis.set_shape(shape(".m_axis"));
  wake_on(s_axis.tvalid);
}

void AxisClockFifo::end_of_elaboration() {
  Clocked::end_of_elaboration();
  if (aresetn.bound()) aresetn.signal()->attach(*this, fifo_reset_pin);
  for (auto& from : s_axis.link().parts()) {
    if (from.part.field == vp::StreamField::data || from.part.field == vp::StreamField::keep)
      continue;
    for (auto& to : out_->m_axis.link().parts())
      if (to.part.field == from.part.field && to.part.low == from.part.low)
        sides_.push_back({&from.wire, &to.wire});
  }
}

void AxisClockFifo::on_change(vp::SignalBase& signal, std::uint32_t id) {
  if (id != fifo_reset_pin) return Clocked::on_change(signal, id);
  wake();
  out_->wake();
}

void AxisClockFifo::edge() {
  const bool took = s_axis.sample();
  if (in_reset()) {
    fifo_.clear();
    s_axis.tready = false;
    return sleep();
  }
  if (took) {
    Beat beat{s_axis.link().beat(), {}, s_axis.tlast.read()};
    for (const Side& side : sides_) beat.sides.push_back(side.from->get());
    fifo_.push(std::move(beat));
    out_->wake();
  }
  full_ = fifo_.writer_level() >= depth;
  s_axis.tready = !full_;
  if (full_) return sleep_until(fifo_.next_free());
  if (!took && !s_axis.tvalid.read()) return sleep();
  wake();
}

vp::IpEstimate AxisClockFifo::own_estimate() const {
  const std::uint32_t bits = 9 * bytes_ + 1;
  const bool deep = depth >= least_memory_depth;
  vp::IpEstimate e = axi_estimate("axis_clock_fifo", 90 + (deep ? 40 : bits * depth / 32),
                                  140 + 2 * bits, deep ? block_ram_36(depth, bits) : 0);
  e.source = "assumed: pointers in both clocks, and distributed or block memory for the beats";
  e.active_clocks = [this] { return s_axis.bound() ? s_axis.link().beats.get() : 0; };
  return e;
}

AxisClockFifo::Out::Out(sc_core::sc_module_name name, vp::Clock& clock, AxisClockFifo& fifo)
    : Clocked(name, clock), owner_(fifo) {
  wake_on(m_axis.tready);
}

void AxisClockFifo::Out::edge() {
  Fifo& fifo = owner_.fifo_;
  if (owner_.in_reset()) {
    m_axis.excuse();
    m_axis.withdraw();
    return sleep();
  }
  if (!m_axis.free()) return sleep();
  if (fifo.reader_level() == 0) {
    m_axis.withdraw();
    return sleep_until(fifo.next_visible());
  }
  const Beat& beat = fifo.front();
  m_axis.offer(beat.bytes, beat.last);
  for (std::size_t i = 0; i < owner_.sides_.size(); ++i) *owner_.sides_[i].to = beat.sides[i];
  fifo.pop();
  if (owner_.full_) owner_.wake();
  if (!m_axis.tready) return sleep();
  wake();
}

}  // namespace xilinx
