#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <systemc>

#include <board/spi_flash.h>
#include <vp/clock.h>
#include <vp/register_bank.h>
#include <vp/signal.h>

/// Devices of the processing system that boot code and templates set up: their registers answer as
/// the chip's do while nothing is connected, so that no program hangs at them.
namespace ps {

/// SD host controller without a card. A command ends with a time-out, as on the chip.
class Sdio : public sc_core::sc_module {
 public:
  Sdio(sc_core::sc_module_name name, vp::ClockScheduler& scheduler);
  const char* kind() const override { return "ps::Sdio"; }

  vp::RegisterBank registers;
  vp::Signal<bool> irq{"irq"};  ///< active high

 private:
  void update();
};

/// Ethernet controller without PHY and network: a read of the PHY gives 0xFFFF; nothing comes, and
/// what is to be sent stays.
class Gem : public sc_core::sc_module {
 public:
  Gem(sc_core::sc_module_name name, vp::ClockScheduler& scheduler);
  const char* kind() const override { return "ps::Gem"; }

  vp::RegisterBank registers;
};

/// USB controller without transceiver: resets end at once, and the port stays empty.
class Usb : public sc_core::sc_module {
 public:
  Usb(sc_core::sc_module_name name, vp::ClockScheduler& scheduler);
  const char* kind() const override { return "ps::Usb"; }

  vp::RegisterBank registers;
};

/// Quad-SPI controller in I/O mode, one bit wide; transfers take no time. Without a flash its
/// status register reads 0 (ready) and all else 0xFF, so that a program that waits for the end of a
/// write does not wait for ever. The memory-mapped mode is not modelled.
class Qspi : public sc_core::sc_module {
 public:
  Qspi(sc_core::sc_module_name name, vp::ClockScheduler& scheduler);
  const char* kind() const override { return "ps::Qspi"; }

  vp::RegisterBank registers;
  vp::Signal<bool> irq{"irq"};  ///< interrupt 51, active high

  /// Wires a flash to it.
  void attach(std::shared_ptr<board::SpiDevice> flash) { flash_ = std::move(flash); }

 private:
  struct Word {
    std::uint32_t bits;
    unsigned bytes;
  };
  void send(std::uint32_t word, unsigned bytes);
  void transfer();
  void select(bool selected);
  std::uint32_t status() const;
  void update();

  vp::Register& config_;
  vp::Register& intr_status_;
  vp::Register& intr_mask_;
  vp::Register& tx_thres_;
  vp::Register& rx_thres_;
  std::shared_ptr<board::SpiDevice> flash_;
  std::deque<Word> tx_;
  std::deque<std::uint32_t> rx_;
  bool selected_ = false;
  std::uint64_t bytes_ = 0;   ///< since it was selected
  std::uint8_t command_ = 0;  ///< the first of them
};

/// Device configuration interface. A transfer to the PL ends after its time at the port's rate; the
/// PL keeps its design, and a warning says so.
class Devcfg : public vp::Clocked {
 public:
  Devcfg(sc_core::sc_module_name name, vp::Clock& cpu_1x_clk);
  const char* kind() const override { return "ps::Devcfg"; }

  vp::RegisterBank registers;   ///< at 0xF800_7000
  vp::Signal<bool> irq{"irq"};  ///< interrupt 40, active high

 private:
  void edge() override;
  void start();
  void update();

  vp::Register& int_sts_;
  vp::Register& int_mask_;
  std::uint64_t done_at_ = vp::Clock::never;
};

}  // namespace ps
