#include <board/xadc.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace board {

namespace {

constexpr double full_scale = 65536.0;
constexpr std::uint16_t result_bits = 0xFFF0;  // 12 bits, left-justified
// UG480: T = code / 65536 · 503.975 − 273.15 °C; supplies code / 65536 · 3 V; others 0 to 1 V.
constexpr double kelvin_span = 503.975, kelvin_zero = 273.15, supply_span = 3.0;
constexpr double usual_temperature = 45.0;  // assumed: a board at room temperature
constexpr unsigned first_extreme = 0x20, first_config = 0x40, first_limit = 0x50;
constexpr unsigned sequencer_shift = 12;

/// A supply or the temperature, with the places of its limits, extremes and switch.
struct Monitor {
  unsigned channel, highest, lowest, upper_limit, lower_limit;
  std::uint16_t off;  // bit of configuration register 1
};
constexpr Monitor monitors[] = {
    {Xadc::temperature, 0x20, 0x24, 0x50, 0x54, 1u << 1},
    {Xadc::vccint, 0x21, 0x25, 0x51, 0x55, 1u << 2},
    {Xadc::vccaux, 0x22, 0x26, 0x52, 0x56, 1u << 3},
    {Xadc::vbram, 0x23, 0x27, 0x58, 0x5C, 1u << 8},
    {Xadc::vccpint, 0x28, 0x2C, 0x59, 0x5D, 1u << 9},
    {Xadc::vccpaux, 0x29, 0x2D, 0x5A, 0x5E, 1u << 10},
    {Xadc::vcco_ddr, 0x2A, 0x2E, 0x5B, 0x5F, 1u << 11},
};

double span_of(unsigned channel) {
  const bool is_supply = channel == Xadc::vccint || channel == Xadc::vccaux ||
                         channel == Xadc::vbram || channel == Xadc::vccpint ||
                         channel == Xadc::vccpaux || channel == Xadc::vcco_ddr;
  return is_supply ? supply_span : 1.0;
}

}  // namespace

Xadc::Xadc() {
  reset();
  set(temperature, usual_temperature);
  set(vccint, 1.0);
  set(vccaux, 1.8);
  set(vbram, 1.0);
  set(vccpint, 1.0);
  set(vccpaux, 1.8);
  set(vcco_ddr, 1.5);
  reset();
}

bool Xadc::is_input(unsigned channel) {
  return (channel >= vaux_0 && channel < vaux_0 + aux_count) || channel <= vp_vn ||
         channel == vbram || (channel >= vccpint && channel <= vcco_ddr);
}

void Xadc::set(unsigned channel, double value) {
  if (!is_input(channel)) {
    throw std::out_of_range("the XADC has no input " + std::to_string(channel) +
                            ": 0 temperature, 1 VCCINT, 2 VCCAUX, 3 VP/VN, 6 VBRAM, 13 to 15 "
                            "supplies of the PS, 16 to 31 VAUX");
  }
  volts_[channel] = value;
  const double part =
      channel == temperature ? (value + kelvin_zero) / kelvin_span : value / span_of(channel);
  const double code = std::clamp(part * full_scale + 8.0, 0.0, full_scale - 1);  // rounds 12 bits
  words_[channel] = static_cast<std::uint16_t>(code) & result_bits;
  note_extremes(channel);
}

void Xadc::note_extremes(unsigned channel) {
  for (const Monitor& monitor : monitors) {
    if (monitor.channel != channel) continue;
    words_[monitor.highest] = std::max(words_[monitor.highest], words_[channel]);
    words_[monitor.lowest] = std::min(words_[monitor.lowest], words_[channel]);
  }
}

// UG480: registers 4C and 4D of the sequencer, or bit 10 of configuration register 0 while a single
// channel is converted.
bool Xadc::is_bipolar(unsigned channel) const {
  constexpr std::uint16_t single_channel = 3, bipolar = 1u << 10, vp_vn_bipolar = 1u << 11;
  const bool is_aux = channel >= vaux_0 && channel < vaux_0 + aux_count;
  if (channel != vp_vn && !is_aux) return false;
  if (words_[config_1] >> sequencer_shift == single_channel)
    return (words_[first_config] & bipolar) != 0;
  return is_aux ? (words_[0x4D] >> (channel - vaux_0) & 1) != 0
                : (words_[0x4C] & vp_vn_bipolar) != 0;
}

std::uint16_t Xadc::read(unsigned address) const {
  if (address == flags) return alarms();
  if (is_bipolar(address)) {
    const double steps = std::clamp(std::floor(volts_[address] * 4096.0 + 0.5), -2048.0, 2047.0);
    return static_cast<std::uint16_t>(static_cast<int>(steps) * 16);
  }
  return words_.at(address);
}

void Xadc::write(unsigned address, std::uint16_t word) {
  if (address >= first_config && address < register_count) words_[address] = word;
}

void Xadc::reset() {
  for (unsigned address = first_extreme; address < register_count; ++address) words_[address] = 0;
  for (const Monitor& monitor : monitors) words_[monitor.lowest] = 0xFFFF;
  for (const Monitor& monitor : monitors) note_extremes(monitor.channel);
}

std::uint8_t Xadc::alarms() const {
  const std::uint16_t config = words_[config_1];
  if (config >> sequencer_shift == 0) return 0;
  std::uint8_t bits = 0, bit = 1;
  for (const Monitor& monitor : monitors) {
    const std::uint16_t now = words_[monitor.channel];
    const bool outside = now > words_[monitor.upper_limit] || now < words_[monitor.lower_limit];
    if (outside && (config & monitor.off) == 0) bits |= bit;
    bit = static_cast<std::uint8_t>(bit << 1);
  }
  constexpr unsigned over_temperature = first_limit + 3;
  constexpr std::uint16_t set_by_user = 3;       // UG480: its lowest bits make the limit valid
  constexpr std::uint16_t usual_limit = 0xCA30;  // 125 °C
  const std::uint16_t limit = (words_[over_temperature] & 0xF) == set_by_user
                                  ? words_[over_temperature] & result_bits
                                  : usual_limit;
  if (words_[temperature] > limit && (config & 1) == 0) bits |= bit;
  return bits;
}

}  // namespace board
