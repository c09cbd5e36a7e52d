#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <systemc>
#include <vector>

#include <vp/clock.h>
#include <vp/register_bank.h>
#include <vp/signal.h>

namespace ps {

/// GPIO of the processing system: 54 pins of the MIO and 64 wires of the EMIO to the PL.
///
/// A pin that the program drives shows its output register. Any other pin shows what the board
/// drives (set_pin(), connect_pins()), an EMIO wire what `emio_gpio_i` brings; with neither an MIO
/// pin has its pull-up (set_pull_up()), and what has none is low. MIO pins 7 and 8 are outputs only
/// and read 0. Registers see a level `synchroniser_clocks` after the pin.
class Gpio : public vp::Clocked {
 public:
  /// Flip-flops between a pin and the registers, in clocks of CPU_1x. Assumed: UG585 draws a
  /// synchroniser without saying how long it is.
  static constexpr std::uint64_t synchroniser_clocks = 2;

  Gpio(sc_core::sc_module_name name, vp::Clock& cpu_1x_clk);
  const char* kind() const override { return "ps::Gpio"; }

  vp::RegisterBank registers;  ///< at 0xE000_A000

  vp::Signal<bool> irq{"irq"};                                      ///< interrupt 52, active high
  vp::Signal<std::uint64_t> mio_o{"mio_o", 54};                     ///< level of the MIO pins
  vp::Signal<std::uint64_t> emio_gpio_o{"emio_gpio_o"};             ///< to the PL
  vp::Signal<std::uint64_t> emio_gpio_t{"emio_gpio_t", 64, ~0ull};  ///< 1: the PS does not drive it
  vp::In<std::uint64_t> emio_gpio_i{"emio_gpio_i"};  ///< from the PL; may be left open

  // The board. Pins are numbered as the vendor's driver does: 0 to 53 MIO, 54 to 117 EMIO. All
  // throw std::out_of_range beyond that.
  /// Drives a pin from outside.
  void set_pin(unsigned pin, bool level);
  /// No longer drives it.
  void release_pin(unsigned pin);
  /// A wire from one pin to another: `to` follows `from`.
  void connect_pins(unsigned from, unsigned to);
  /// The SLCR switches the pull-up of an MIO pin; off at first.
  void set_pull_up(unsigned pin, bool on);
  /// The level of a pin.
  bool pin(unsigned pin) const;

  /// The SLCR holds the block in reset.
  void hold_in_reset(bool hold);

 private:
  /// What drives a pin from outside.
  struct Outside {
    enum Kind { nothing, level, wire } kind = nothing;
    bool high = false;
    unsigned from = 0;
  };
  struct Bank {
    vp::Register &data, &dirm, &oen, &mask, &stat, &type, &polarity, &any;
    std::uint32_t now = 0;   ///< level of the pins
    std::uint32_t seen = 0;  ///< the same behind the synchroniser
  };
  struct Change {
    std::uint64_t due;  ///< cycle
    std::array<std::uint32_t, 4> level;
  };

  void edge() override;
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  void before_end_of_elaboration() override;
  void end_of_elaboration() override {}  // the EMIO may be left open
  void start_of_simulation() override;

  Bank bank_at(unsigned number);
  void wire_bank(unsigned number);
  void write_masked(unsigned number, unsigned shift, std::uint32_t word);
  Outside& outside(unsigned pin);
  bool outside_level(unsigned pin, unsigned hops) const;
  std::uint32_t driven(unsigned number) const;
  std::uint32_t level_of(unsigned number) const;
  void update_pins();
  void take(const std::array<std::uint32_t, 4>& level);
  void update();

  std::vector<Bank> banks_;
  std::vector<Outside> outside_;
  std::uint64_t pull_ups_ = 0;  ///< by MIO pin
  std::deque<Change> under_way_;
};

}  // namespace ps
