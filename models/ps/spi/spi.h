#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <systemc>

#include <board/spi_flash.h>
#include <vp/clock.h>
#include <vp/register_bank.h>
#include <vp/signal.h>

namespace ps {

/// SPI controller of the processing system as a master, at the level of whole bytes: each takes
/// eight periods of SCK. The slave's side and mode faults are not modelled. Delays between bytes
/// (DELAY) are stored and take no time.
class Spi : public vp::Clocked {
 public:
  static constexpr unsigned slave_count = 3;

  Spi(sc_core::sc_module_name name, vp::Clock& spi_ref_clk);
  const char* kind() const override { return "ps::Spi"; }

  vp::RegisterBank registers;
  vp::Signal<bool> irq{"irq"};                  ///< active high
  vp::Signal<std::uint8_t> ss_n{"ss_n", 3, 7};  ///< selects, active low

  /// What is wired to select `slave`; std::out_of_range beyond 2. Where nothing is, bytes read
  /// 0xFF.
  void attach(unsigned slave, std::shared_ptr<board::SpiDevice> device);
  /// The SLCR holds the block in reset.
  void hold_in_reset(bool hold);

 private:
  static constexpr unsigned none = slave_count;

  void edge() override;
  void wire();
  void control_written(std::uint32_t word);
  void enable_written();
  void send(std::uint32_t word);
  void receive();
  unsigned chosen() const;
  void select(unsigned slave);
  void start();
  void exchange();
  std::uint32_t status() const;
  void update();

  vp::Register& cr_;
  vp::Register& isr_;
  vp::Register& imr_;
  vp::Register& enable_;
  vp::Register& tx_thres_;
  vp::Register& rx_thres_;
  std::deque<std::uint8_t> tx_, rx_;
  std::array<std::shared_ptr<board::SpiDevice>, slave_count> devices_;
  unsigned selected_ = none;
  bool started_ = false;  ///< by MANSTRT
  bool warned_ = false;   ///< of a select without device
  std::uint64_t done_at_ = vp::Clock::never;
};

}  // namespace ps
