#include <xilinx/xadc_wiz/xadc_wiz.h>

#include <xilinx/common/axi_lite_ip.h>

#include <array>

namespace xilinx {

namespace {

using namespace xadc_wiz;

constexpr std::array alarm_pins{
    "user_temp_alarm_out", "vccint_alarm_out",  "vccaux_alarm_out",  "vbram_alarm_out",
    "vccpint_alarm_out",   "vccpaux_alarm_out", "vccddro_alarm_out", "ot_out"};
constexpr std::uint64_t adcclk_per_conversion = 26;  // UG480

}  // namespace

XadcWiz::XadcWiz(sc_core::sc_module_name name, vp::Clock& s_axi_aclk, const XadcWizBuild& build)
    : Clocked(name, s_axi_aclk),
      Ip(&s_axi_aclk),
      sequence_channels("sequence_channels", build.sequence_channels, vp::Unit::none, {1, 32},
                        vp::Source::published, "conversions in a sequence (PG091)"),
      adcclk_divisor("adcclk_divisor", build.adcclk_divisor, vp::Unit::none, {2, 255},
                     vp::Source::published,
                     "clocks of the registers in one of ADCCLK, 26 MHz at most (UG480)"),
      s_axi_lite("s_axi_lite", xadc_wiz::registers, axi_lite_options(xadc_wiz::address_bits),
                 &s_axi_aclk.scheduler()),
      initial_(build.initial),
      gie_(s_axi_lite[GIER]),
      isr_(s_axi_lite[IPISR]),
      ier_(s_axi_lite[IPIER]) {
  for (const char* pin : alarm_pins) alarm.emplace_back(pin);
  reset_converter();
  wire();
}

// A public report has 262 LUT, 340 FF and a block memory (7z007s, with stream).
vp::IpEstimate XadcWiz::own_estimate() const {
  vp::IpEstimate e = axi_estimate("xadc_wiz", 262, 340, 0);
  e.active_clocks = [this] { return clocks_per_access * accesses(s_axi_lite); };
  return e;
}

void XadcWiz::wire() {
  for (vp::Register* r : {&gie_, &isr_, &ier_}) {
    r->after_write([this](std::uint32_t) { update(); });
  }
  s_axi_lite[SRR].after_write([this](std::uint32_t word) {
    if (word == reset_key) reset();
  });
  s_axi_lite[SYSMONRR].after_write([this](std::uint32_t word) {
    if ((word & 1) != 0) reset_converter();
  });
  vp::Register& status = s_axi_lite[SR];
  status.computed_by([this] { return ends(); });
  status.after_read([this](std::uint32_t) { seen_ = clock().cycle(); });
  s_axi_lite[AOSR].computed_by([this] { return std::uint32_t{converter.alarms()}; });
  for (unsigned n = 0; n < drp_count; ++n) {
    vp::Register& r = s_axi_lite[drp + 4 * n];
    r.computed_by([this, n] { return std::uint32_t{converter.read(n)}; });
    r.after_write([this, n](std::uint32_t word) {
      converter.write(n, static_cast<std::uint16_t>(word));
      show_alarms();
    });
  }
}

void XadcWiz::reset() {
  s_axi_lite.reset();
  reset_converter();
  origin_ = seen_ = clock().cycle();
  update();
}

void XadcWiz::reset_converter() {
  converter.reset();
  for (const auto& [address, word] : initial_) converter.write(address, word);
  show_alarms();
}

void XadcWiz::set_input(unsigned channel, double value) {
  converter.set(channel, value);
  show_alarms();
}

// PG091: alarm_out is the logical or of the alarms, over-temperature apart.
void XadcWiz::show_alarms() {
  const std::uint8_t bits = converter.alarms();
  for (std::size_t n = 0; n < alarm.size(); ++n) alarm[n] = (bits >> n & 1) != 0;
  alarm_out = (bits & 0x7F) != 0;
}

void XadcWiz::before_end_of_elaboration() {
  Clocked::before_end_of_elaboration();
  if (s_axi_aresetn.bound()) s_axi_aresetn.signal()->attach(*this);
}

void XadcWiz::on_change(vp::SignalBase&, std::uint32_t) {
  reset();
  s_axi_lite.hold_in_reset(!s_axi_aresetn);
}

std::uint64_t XadcWiz::conversion_clocks() const {
  return adcclk_per_conversion * adcclk_divisor;
}

// Whether a conversion, or a sequence, ended since SR was read last.
std::uint32_t XadcWiz::ends() const {
  const std::uint64_t one = conversion_clocks(), all = one * sequence_channels;
  const std::uint64_t now = clock().cycle() - origin_, then = seen_ - origin_;
  std::uint32_t bits = static_cast<std::uint32_t>(now / one % sequence_channels) & 0x1F;
  if (now / one != then / one) bits |= sr::EOC;
  if (now / all != then / all) bits |= sr::EOS;
  return bits;
}

void XadcWiz::edge() {
  sleep();
  const std::uint64_t now = clock().cycle() - origin_;
  if (now % conversion_clocks() == 0) isr_.set_bits(event_EOC);
  if (now % (conversion_clocks() * sequence_channels) == 0) isr_.set_bits(event_EOS);
  update();
}

void XadcWiz::update() {
  ip2intc_irpt = gie_.any(gier_GIE) && (isr_ & ier_) != 0;
  const bool wanted = (ier_ & ~isr_ & (event_EOC | event_EOS)) != 0;
  const std::uint64_t one = conversion_clocks();
  wake_at(wanted ? origin_ + ((clock().cycle() - origin_) / one + 1) * one : vp::Clock::never);
}

}  // namespace xilinx
