#include <xilinx/axi_intc/axi_intc.h>

#include <string>

#include <xilinx/common/axi_lite_ip.h>

namespace xilinx {

namespace {

using namespace axi_intc;

constexpr std::uint32_t reset_pin = 32;  // listener ids below are inputs

}  // namespace

AxiIntc::AxiIntc(sc_core::sc_module_name name, vp::Clock& s_axi_aclk, const AxiIntcBuild& build)
    : Clocked(name, s_axi_aclk),
      Ip(&s_axi_aclk),
      num_intr_inputs("num_intr_inputs", build.num_intr_inputs, vp::Unit::none, {1, 32},
                      vp::Source::published,
                      "build option Number of Peripheral Interrupts (PG099)"),
      kind_of_intr("kind_of_intr", build.kind_of_intr, vp::Unit::address, vp::Source::published,
                   "build option Interrupts type: a 1 for each edge (PG099)"),
      input_latency("input_latency", 3, vp::Unit::cycles, {1, 8}, vp::Source::published,
                    "input to ISR: 2 synchroniser stages and a register (HDL of v4.1)"),
      s_axi("s_axi", axi_intc::registers, axi_lite_options(axi_intc::address_bits),
            &s_axi_aclk.scheduler()),
      isr_(s_axi[ISR]),
      ier_(s_axi[IER]),
      mer_(s_axi[MER]) {
  for (unsigned n = 0; n < num_intr_inputs; ++n) {
    intr_.emplace_back(("intr" + std::to_string(n)).c_str());
  }
  for (const std::uint32_t offset : {ISR, IER, IAR, SIE, CIE}) s_axi[offset].set_writable(all());
  wire();
}

// A public report of a build with 11 inputs has 171 LUT and 167 FF; each input takes about nine.
vp::IpEstimate AxiIntc::own_estimate() const {
  vp::IpEstimate e =
      axi_estimate("axi_intc", 72 + 9 * num_intr_inputs, 68 + 9 * num_intr_inputs, 0);
  e.active_clocks = [this] { return clocks_per_access * accesses(s_axi); };
  return e;
}

std::uint32_t AxiIntc::all() const {
  return num_intr_inputs == 32 ? 0xFFFFFFFF : (1u << num_intr_inputs) - 1;
}

void AxiIntc::wire() {
  isr_.after_write([this](std::uint32_t) { update(); });
  s_axi[IPR].computed_by([this] { return isr_ & ier_; });
  ier_.after_write([this](std::uint32_t) { update(); });
  s_axi[IAR].after_write([this](std::uint32_t word) {
    isr_.clear_bits(word);
    update();
  });
  s_axi[SIE].after_write([this](std::uint32_t word) {
    ier_.set_bits(word & all());
    update();
  });
  s_axi[CIE].after_write([this](std::uint32_t word) {
    ier_.clear_bits(word);
    update();
  });
  s_axi[IVR].computed_by([this] {
    const std::uint32_t pending = isr_ & ier_;
    return pending == 0 ? 0xFFFFFFFFu : static_cast<std::uint32_t>(__builtin_ctz(pending));
  });
  mer_.after_write([this](std::uint32_t) {
    hardware_ = hardware_ || mer_.any(mer::HIE);
    if (hardware_) {
      mer_.set_bits(mer::HIE);
      isr_.set_writable(0);  // the inputs alone set it from now on
    }
    update();
  });
}

void AxiIntc::before_end_of_elaboration() {
  Clocked::before_end_of_elaboration();
  for (unsigned n = 0; n < intr_.size(); ++n) {
    if (intr_[n].bound()) intr_[n].signal()->attach(*this, n);
  }
  if (s_axi_aresetn.bound()) s_axi_aresetn.signal()->attach(*this, reset_pin);
}

void AxiIntc::on_change(vp::SignalBase& signal, std::uint32_t id) {
  if (id == reset_pin) {
    s_axi.hold_in_reset(!s_axi_aresetn);
    hardware_ = false;
    isr_.set_writable(all());
    return update();
  }
  levels_ = signal.bits() != 0 ? levels_ | 1u << id : levels_ & ~(1u << id);
  under_way_.push_back({clock().cycle() + input_latency, levels_});
  wake_at(under_way_.front().due);
}

void AxiIntc::edge() {
  sleep();
  while (!under_way_.empty() && under_way_.front().due <= clock().cycle()) {
    const std::uint32_t risen = under_way_.front().levels & ~seen_;
    seen_ = under_way_.front().levels;
    if (hardware_) isr_.set_bits(risen & kind_of_intr & all());
    under_way_.pop_front();
    update();
  }
  if (!under_way_.empty()) wake_at(under_way_.front().due);
}

void AxiIntc::update() {
  if (hardware_) isr_.set_bits(seen_ & ~kind_of_intr & all());
  irq = mer_.any(mer::ME) && (isr_ & ier_) != 0;
}

}  // namespace xilinx
