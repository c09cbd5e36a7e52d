#include <drivers/slcr.h>
#include <hal/hal.h>
#include <slcr_registers.h>

namespace drivers {
namespace {

constexpr std::uint32_t largest_divisor = 63;
constexpr std::uint32_t largest_product = largest_divisor * largest_divisor;

std::uint32_t read(std::uint32_t offset) {
  return hal_read32(slcr::base + offset);
}

/// Writes are taken while it lives.
class Unlocked {
 public:
  Unlocked() : was_locked_(read(slcr::SLCR_LOCKSTA) != 0) {
    if (was_locked_) hal_write32(slcr::base + slcr::SLCR_UNLOCK, slcr::unlock_key);
  }
  ~Unlocked() {
    if (was_locked_) hal_write32(slcr::base + slcr::SLCR_LOCK, slcr::lock_key);
  }
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;

  void write(std::uint32_t offset, std::uint32_t value) const {
    hal_write32(slcr::base + offset, value);
  }
  void change(std::uint32_t offset, std::uint32_t mask, std::uint32_t bits) const {
    write(offset, (read(offset) & ~mask) | bits);
  }

 private:
  bool was_locked_;
};

constexpr std::uint32_t of_clock(std::uint32_t register_of_clock_0, unsigned number) {
  return register_of_clock_0 + number * slcr::fclk_stride;
}

std::uint32_t divisor(std::uint32_t clk_ctrl, std::uint32_t mask, unsigned shift) {
  const std::uint32_t value = (clk_ctrl & mask) >> shift;
  return value == 0 ? 1 : value;
}

/// The larger of two divisors whose product is `product`, as alike as possible; 0 if impossible.
std::uint32_t larger_divisor(std::uint32_t product) {
  for (std::uint32_t large = 1; large <= largest_divisor; ++large) {
    if (large * large >= product && product % large == 0) return large;
  }
  return 0;
}

std::uint32_t rounded_hertz(std::uint64_t millihertz, std::uint32_t product) {
  // A product is 1 at least. NOLINTNEXTLINE(clang-analyzer-core.DivideZero)
  const std::uint64_t divided = (millihertz + product / 2) / product;
  return static_cast<std::uint32_t>((divided + 500) / 1000);
}

std::uint32_t distance(std::uint32_t a, std::uint32_t b) {
  return a > b ? a - b : b - a;
}

/// The product of two divisors that divides `millihertz` nearest to `hertz`.
std::uint32_t nearest_product(std::uint64_t millihertz, std::uint32_t hertz) {
  const std::uint64_t ideal = hertz == 0 ? largest_product : millihertz / 1000 / hertz;
  std::uint32_t below =
      ideal > largest_product ? largest_product : static_cast<std::uint32_t>(ideal);
  if (below == 0) below = 1;
  std::uint32_t above = below < largest_product ? below + 1 : below;
  while (larger_divisor(below) == 0) --below;
  while (larger_divisor(above) == 0) ++above;
  const bool take_below = distance(rounded_hertz(millihertz, below), hertz) <=
                          distance(rounded_hertz(millihertz, above), hertz);
  return take_below ? below : above;
}

}  // namespace

void Slcr::initialise(const SlcrConfig& config) {
  ps_clk_millihertz_ = config.ps_clk_millihertz;
}

std::uint64_t Slcr::pll_millihertz(std::uint32_t pll_ctrl) const {
  const std::uint32_t control = read(pll_ctrl);
  if (control & slcr::pll_ctrl::PLL_BYPASS_FORCE) return ps_clk_millihertz_;
  if (control & (slcr::pll_ctrl::PLL_RESET | slcr::pll_ctrl::PLL_PWRDWN)) return 0;
  return ps_clk_millihertz_ *
         ((control & slcr::pll_ctrl::PLL_FDIV) >> slcr::pll_ctrl::PLL_FDIV_shift);
}

std::uint64_t Slcr::source_millihertz(std::uint32_t clk_ctrl) const {
  switch ((clk_ctrl & slcr::clk_ctrl::SRCSEL) >> slcr::clk_ctrl::SRCSEL_shift) {
    case slcr::peripheral_source::arm_pll:
      return pll_millihertz(slcr::ARM_PLL_CTRL);
    case slcr::peripheral_source::ddr_pll:
      return pll_millihertz(slcr::DDR_PLL_CTRL);
    default:
      return pll_millihertz(slcr::IO_PLL_CTRL);
  }
}

std::uint32_t Slcr::set_pl_clock(unsigned number, std::uint32_t hertz) const {
  const std::uint64_t pll = pll_millihertz(slcr::IO_PLL_CTRL);
  if (number >= pl_clock_count || pll == 0) return 0;
  const std::uint32_t product = nearest_product(pll, hertz);
  const std::uint32_t large = larger_divisor(product);
  const Unlocked registers;
  registers.write(
      of_clock(slcr::FPGA0_CLK_CTRL, number),
      large << slcr::clk_ctrl::DIVISOR0_shift | product / large << slcr::clk_ctrl::DIVISOR1_shift);
  return rounded_hertz(pll, product);
}

std::uint32_t Slcr::pl_clock(unsigned number) const {
  if (number >= pl_clock_count) return 0;
  const std::uint32_t control = read(of_clock(slcr::FPGA0_CLK_CTRL, number));
  const std::uint32_t product =
      divisor(control, slcr::clk_ctrl::DIVISOR0, slcr::clk_ctrl::DIVISOR0_shift) *
      divisor(control, slcr::clk_ctrl::DIVISOR1, slcr::clk_ctrl::DIVISOR1_shift);
  return rounded_hertz(source_millihertz(control), product);
}

std::uint32_t Slcr::cpu_clock() const {
  // Source and divisor lie as in the registers of other clocks; the sources' numbers do not.
  const std::uint32_t control = read(slcr::ARM_CLK_CTRL);
  const std::uint32_t source = (control & slcr::clk_ctrl::SRCSEL) >> slcr::clk_ctrl::SRCSEL_shift;
  const std::uint32_t pll_ctrl = source == slcr::cpu_source::ddr_pll  ? slcr::DDR_PLL_CTRL
                                 : source == slcr::cpu_source::io_pll ? slcr::IO_PLL_CTRL
                                                                      : slcr::ARM_PLL_CTRL;
  return rounded_hertz(pll_millihertz(pll_ctrl),
                       divisor(control, slcr::clk_ctrl::DIVISOR0, slcr::clk_ctrl::DIVISOR0_shift));
}

// A throttle of 1 clock that is never started: the way Linux gates these clocks.
void Slcr::gate_pl_clock(unsigned number, bool stop) const {
  if (number >= pl_clock_count) return;
  Unlocked().write(of_clock(slcr::FPGA0_THR_CNT, number), stop ? 1 : 0);
}

void Slcr::reset_pl(unsigned number, bool reset) const {
  if (number >= pl_clock_count) return;
  const std::uint32_t bit = slcr::fpga_rst_ctrl::FPGA0_OUT_RST << number;
  Unlocked().change(slcr::FPGA_RST_CTRL, bit, reset ? bit : 0);
}

void Slcr::enable_level_shifters(bool on) const {
  Unlocked().write(slcr::LVL_SHFTR_EN, on ? slcr::lvl_shftr_en::all : slcr::lvl_shftr_en::none);
}

bool Slcr::wait_for_plls(unsigned polls) const {
  constexpr std::uint32_t all_locked = 7 * slcr::pll_status::LOCK;
  for (unsigned n = 0; n < polls; ++n) {
    if ((read(slcr::PLL_STATUS) & all_locked) == all_locked) return true;
  }
  return false;
}

}  // namespace drivers
