#pragma once

#include <array>
#include <cstdint>

namespace board {

/// The XADC of a 7-series device (UG480): its registers behind the dynamic reconfiguration port and
/// what its inputs measure. Results follow the inputs at once; conversions take no time here.
class Xadc {
 public:
  static constexpr unsigned register_count = 128;
  static constexpr unsigned aux_count = 16;
  /// Addresses of the results.
  static constexpr unsigned temperature = 0x00, vccint = 0x01, vccaux = 0x02, vp_vn = 0x03,
                            vbram = 0x06, vccpint = 0x0D, vccpaux = 0x0E, vcco_ddr = 0x0F,
                            vaux_0 = 0x10;
  static constexpr unsigned flags = 0x3F, config_1 = 0x41;

  Xadc();

  /// Sets an input by the address of its result: °C for `temperature`, else volts. Values beyond
  /// what the converter measures stop at its ends: 0 to 1 V of VP/VN and VAUX, -0.5 to 0.5 V where
  /// their registers say bipolar. Throws std::out_of_range for an address without
  /// an input.
  void set(unsigned channel, double value);

  std::uint16_t read(unsigned address) const;
  /// Results, extremes and flags ignore writes.
  void write(unsigned address, std::uint16_t word);
  /// As after power-on; inputs stay.
  void reset();

  /// Alarms, as the wires: bits 0 temperature, 1 VCCINT, 2 VCCAUX, 3 VBRAM, 4 VCCPINT, 5 VCCPAUX, 6
  /// VCCO_DDR, 7 over-temperature. Off while the sequencer is in its default mode.
  std::uint8_t alarms() const;

 private:
  static bool is_input(unsigned channel);
  bool is_bipolar(unsigned channel) const;
  void note_extremes(unsigned channel);

  std::array<std::uint16_t, register_count> words_{};
  std::array<double, vaux_0 + aux_count> volts_{};  ///< of VP/VN and VAUX
};

}  // namespace board
