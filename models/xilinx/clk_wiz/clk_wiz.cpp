#include <xilinx/clk_wiz/clk_wiz.h>

#include <cmath>
#include <string>

#include <vp/error.h>
#include <vp/report.h>
#include <xilinx/common/axi_lite_ip.h>

namespace xilinx {

namespace {

using namespace clk_wiz;

constexpr double thousandths = 1000.0, hz_per_mhz = 1e6;

std::uint32_t in_thousandths(std::uint32_t whole, std::uint32_t fraction) {
  return whole * 1000 + fraction;
}

}  // namespace

ClkWiz::ClkWiz(sc_core::sc_module_name name, vp::Clock& clk_in1, const ClkWizBuild& build,
               vp::Clock* s_axi_aclk)
    : Clocked(name, s_axi_aclk ? *s_axi_aclk : clk_in1),
      Ip(&clk_in1),
      lock_us("lock_us", 100, vp::Unit::none, {1, 10'000}, vp::Source::published,
              "longest time until an MMCM has locked, us (DS187)"),
      s_axi_lite("s_axi_lite", clk_wiz::registers, axi_lite_options(clk_wiz::address_bits),
                 &clk_in1.scheduler()),
      clk_in1_(clk_in1),
      limits_(manager_limits(build.pll, build.grade)),
      build_(build) {
  if (build.divide.empty() || build.divide.size() > output_count)
    throw vp::InputError(std::string(this->name()) + ": an MMCM has 1 to 7 outputs");
  if (!is_legal())
    throw vp::InputError(std::string(this->name()) + ": its VCO would run at " +
                         std::to_string(std::llround(vco_hz() / hz_per_mhz)) +
                         " MHz; choose factors that give " + legal_range());
  for (unsigned n = 0; n < build.divide.size(); ++n) {
    outputs_.push_back(std::make_unique<vp::Clock>(("clk_out" + std::to_string(n + 1)).c_str(),
                                                   clk_in1.scheduler(), output_hz(n)));
  }
  show(build);
  clk_in1_.add_listener(*this);
  s_axi_lite[SR].computed_by([this] { return locked ? sr_LOCKED : 0u; });
  s_axi_lite[SRR].after_write([this, build](std::uint32_t word) {
    if (word != reset_key) return;
    s_axi_lite.reset();
    build_ = build;
    show(build);
    load();
  });
  s_axi_lite[CCR23].after_write([this](std::uint32_t word) {
    if ((word & ccr23::LOAD) == 0) return;
    const std::uint32_t factors = s_axi_lite[CCR0];
    build_.divclk = factors & ccr0::DIVCLK;
    build_.multiply = in_thousandths((factors & ccr0::MULT) >> ccr0::MULT_shift,
                                     (factors & ccr0::FRAC) >> ccr0::FRAC_shift);
    for (unsigned n = 0; n < build_.divide.size(); ++n) {
      const std::uint32_t divisor = s_axi_lite[CCR2 + n * output_stride];
      build_.divide[n] =
          in_thousandths(divisor & divide::Divide, (divisor & divide::FRAC) >> divide::FRAC_shift);
    }
    load();
  });
}

// The MMCM is no LUT; with registers a public report has about 500 LUT for their AXI4-Lite side.
vp::IpEstimate ClkWiz::own_estimate() const {
  vp::IpEstimate e = axi_estimate("clk_wiz", 1, 0, 0);
  e.fmax_hz = 464'000'000;  // DS187: outputs of an MMCM, -1
  e.fmax_documentation = "highest output of an MMCM, speed grade -1 (DS187)";
  e.active_clocks = [this] { return clocks_per_access * accesses(s_axi_lite); };
  return e;
}

double ClkWiz::vco_hz() const {
  const double input = static_cast<double>(clk_in1_.frequency_hz());
  return input * build_.multiply / thousandths / build_.divclk;
}

bool ClkWiz::is_legal() const {
  bool legal = build_.divclk != 0 && build_.divclk <= limits_.divclk_max &&
               build_.multiply >= 2000 && build_.multiply <= 64'000;
  for (const std::uint32_t divisor : build_.divide) legal &= divisor >= 1000 && divisor <= 128'000;
  return legal && vco_hz() >= limits_.vco_min && vco_hz() <= limits_.vco_max;
}

std::string ClkWiz::legal_range() const {
  return std::to_string(std::llround(limits_.vco_min / hz_per_mhz)) + " to " +
         std::to_string(std::llround(limits_.vco_max / hz_per_mhz)) + " MHz";
}

std::uint64_t ClkWiz::output_hz(unsigned number) const {
  return static_cast<std::uint64_t>(
      std::llround(vco_hz() * thousandths / build_.divide.at(number)));
}

// What the build made of the factors is in the registers.
void ClkWiz::show(const ClkWizBuild& build) {
  s_axi_lite[CCR0] = build.divclk | build.multiply / 1000 << ccr0::MULT_shift |
                     build.multiply % 1000 << ccr0::FRAC_shift;
  for (unsigned n = 0; n < build.divide.size(); ++n) {
    s_axi_lite[CCR2 + n * output_stride] = build.divide[n] / 1000 | build.divide[n] % 1000
                                                                        << divide::FRAC_shift;
  }
}

// Factors that no MMCM takes leave it unlocked, and its outputs stopped.
void ClkWiz::load() {
  locked = false;
  for (const auto& output : outputs_) output->set_frequency(0);
  locked_at_ = vp::Clock::never;
  if (!is_legal()) {
    vp::warn(*this, "/markervp/clk_wiz/factors",
             "factors that put the VCO outside " + legal_range() +
                 ", or that it does not have: it does not lock, and its outputs stop");
    return wake_at(locked_at_);
  }
  locked_at_ = clock().cycle() + 1 + lock_us * (clock().frequency_hz() / 1'000'000);
  wake_at(locked_at_);
}

void ClkWiz::edge() {
  sleep();
  if (locked_at_ > clock().cycle()) return wake_at(locked_at_);
  locked_at_ = vp::Clock::never;
  drive();
  locked = true;
}

void ClkWiz::drive() {
  for (unsigned n = 0; n < outputs_.size(); ++n) outputs_[n]->set_frequency(output_hz(n));
}

void ClkWiz::after_change(vp::Clock&) {
  if (locked) drive();
}

}  // namespace xilinx
