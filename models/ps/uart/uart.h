#pragma once

#include <board/hosts.h>
#include <ps/cpu/console.h>
#include <vp/clock.h>
#include <vp/counter.h>
#include <vp/parameter.h>
#include <vp/register_bank.h>
#include <vp/signal.h>
#include <cstdint>
#include <deque>
#include <string_view>
#include <systemc>

namespace ps {

/// UART of the Zynq-7000, at the level of whole characters: each takes its bits at the baud rate. A
/// character leaves (and a received one arrives) when its last stop bit is over.
///
/// What software sends goes to `console` and to `on_transmit`; receive() is the other end of the
/// line, which sends with the same settings. Breaks, modem lines and errors on the line are not
/// modelled.
class Uart : public vp::Clocked, public board::SerialHost {
 public:
  Uart(sc_core::sc_module_name name, vp::Clock& uart_ref_clk);
  const char* kind() const override { return "ps::Uart"; }

  vp::Parameter<bool> enabled;

  vp::RegisterBank registers;
  vp::Signal<bool> irq{"irq"};  ///< active high
  vp::In<bool> rst{"rst"};      ///< active high, from the SLCR; may be left open

  Console console;

  vp::Counter transmitted{"transmitted", "bytes that left"};
  vp::Counter received{"received", "bytes that came into the receive FIFO"};
  vp::Counter lost{"lost", "bytes that met a full FIFO or a receiver that was off"};

  void receive(std::string_view bytes) override;

 private:
  /// What is under way on one direction of the line.
  struct Shifter {
    std::uint8_t byte = 0;
    std::uint64_t done_at = vp::Clock::never;  ///< cycle of the end of its last bit
    bool busy() const { return done_at != vp::Clock::never; }
  };

  void edge() override;
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  void end_of_elaboration() override;

  void wire();
  void control_written(std::uint32_t word);
  void fifo_written(std::uint32_t word);
  void fifo_read();
  void reset();

  std::uint64_t half_bits() const;
  std::uint64_t cycles_per_bit() const;
  std::uint64_t frame_cycles() const;
  bool transmitter_on() const;
  bool receiver_on() const;
  std::uint32_t mode() const;
  std::uint32_t status() const;

  void put(std::uint8_t byte);
  void take(std::uint8_t byte);
  void end_of_transmission();
  void end_of_reception();
  void start_shifters();
  void restart_timeout();
  void raise(std::uint32_t events);
  void update();

  vp::Register& cr_;
  vp::Register& mr_;
  vp::Register& imr_;
  vp::Register& isr_;
  vp::Register& baudgen_;
  vp::Register& rxtout_;
  vp::Register& rxwm_;
  vp::Register& baud_div_;
  vp::Register& flow_delay_;
  vp::Register& tx_fifo_level_;
  std::deque<std::uint8_t> tx_fifo_, rx_fifo_, line_;
  Shifter tx_, rx_;
  std::uint64_t timeout_at_ = vp::Clock::never;
  std::uint32_t accepted_baud_div_;
};

}  // namespace ps
