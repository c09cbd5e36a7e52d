#pragma once

#include <cstdint>
#include <deque>
#include <systemc>

#include <board/hosts.h>
#include <vp/clock.h>
#include <vp/register_bank.h>
#include <vp/signal.h>

namespace ps {

/// I2C controller of the processing system as a master, at the level of whole bytes: a start takes
/// one period of SCL, each byte with its acknowledge nine. A slave's side, arbitration and
/// time-outs are not modelled.
class I2c : public vp::Clocked, public board::I2cHost {
 public:
  I2c(sc_core::sc_module_name name, vp::Clock& cpu_1x_clk);
  const char* kind() const override { return "ps::I2c"; }

  vp::RegisterBank registers;
  vp::Signal<bool> irq{"irq"};    ///< active high
  vp::Signal<bool> busy{"busy"};  ///< a transfer has the bus

  board::I2cBus bus;  ///< what it is wired to
  board::I2cBus& i2c_bus() override { return bus; }

  /// The SLCR holds the block in reset.
  void hold_in_reset(bool hold);

 private:
  enum class State { idle, address, sending, receiving, held_sending, held_receiving, full };

  void edge() override;

  void wire();
  void control_written(std::uint32_t word);
  void address_written();
  void data_written(std::uint32_t word);
  void data_read();
  void size_written();

  std::uint64_t scl_cycles() const;
  void start_transfer();
  void take(State state, std::uint64_t scl_periods);
  void address_sent();
  void send_next();
  void receive_next();
  void byte_sent();
  void byte_received();
  void refused();
  void finish();
  void rest(State held);
  std::uint32_t status() const;
  void raise(std::uint32_t events);
  void update();

  vp::Register& cr_;
  vp::Register& addr_;
  vp::Register& isr_;
  vp::Register& trans_size_;
  vp::Register& slv_pause_;
  vp::Register& imr_;
  State state_ = State::idle;
  bool reads_ = false;     ///< direction of the transfer
  bool monitors_ = false;  ///< it polls an address, until SLVMON is cleared
  bool overflow_ = false;  ///< SR.RXOVF
  std::deque<std::uint8_t> fifo_;
  std::uint8_t shifted_ = 0;  ///< the byte that is being sent
  std::uint64_t done_at_ = vp::Clock::never;
};

}  // namespace ps
