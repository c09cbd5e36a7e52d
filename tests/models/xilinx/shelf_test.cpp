// The IP of the shelf, each alone on a bus: timer, interrupt controller, UART Lite, IIC, Quad SPI,
// FIFO.
#include <boost/test/unit_test.hpp>
#include <functional>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <simulation.h>
#include <vp/clock_scheduler.h>
#include <vp/error.h>
#include <vp/report.h>
#include <xilinx/axi_fifo_mm_s/axi_fifo_mm_s.h>
#include <xilinx/axi_iic/axi_iic.h>
#include <xilinx/axi_intc/axi_intc.h>
#include <xilinx/axi_quad_spi/axi_quad_spi.h>
#include <xilinx/axi_timer/axi_timer.h>
#include <xilinx/axi_uartlite/axi_uartlite.h>
#include "bus_master.h"

using kit::BusMaster;

namespace {

constexpr std::uint64_t period = 10'000;  // ps: 100 MHz

struct Bench : kit::Simulation {
  Bench() { reports.redirect(text); }
  bool said(const char* words) const { return text.str().find(words) != std::string::npos; }

  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clock{"clock", scheduler, 100'000'000};
  BusMaster master{"master"};
  std::ostringstream text;
  vp::ReportRouter reports;
};

/// The times at which a signal rose, in clocks.
class Rises : public vp::SignalListener {
 public:
  Rises(vp::Signal<bool>& signal, const vp::ClockScheduler& scheduler) : scheduler_(scheduler) {
    signal.attach(*this);
  }
  void on_change(vp::SignalBase& signal, std::uint32_t) override {
    (signal.bits() != 0 ? rises : falls).push_back(scheduler_.now_ps() / period);
  }
  std::vector<std::uint64_t> rises, falls;

 private:
  const vp::ClockScheduler& scheduler_;
};

}  // namespace

BOOST_AUTO_TEST_SUITE(shelf)

// As measured on the vendor's RTL: TLR + 2 clocks a period, the first pulse two clocks later.
BOOST_AUTO_TEST_CASE(timer_reloads) {
  using namespace axi_timer;
  Bench b;
  xilinx::AxiTimer timer("axi_timer_0", b.clock);
  b.master.socket.bind(timer.s_axi.socket);
  Rises pulses(timer.generateout0, b.scheduler);
  b.master.simulate([&] {
    b.master.write(TLR0, 100);
    b.master.write(TCSR0, tcsr::LOAD);
    BOOST_TEST(b.master.read(TCR0) == 100u);
    BusMaster::wait_until(100 * period);
    b.master.write(TCSR0, tcsr::ENT | tcsr::UDT | tcsr::ARHT | tcsr::GENT | tcsr::ENIT);
    BusMaster::wait_until(150 * period);
    BOOST_TEST(b.master.read(TCR0) == 52u);
    BusMaster::wait_until(420 * period);
    BOOST_TEST((b.master.read(TCSR0) & tcsr::TINT) != 0u);
    BOOST_TEST(timer.interrupt.get());
    b.master.write(TCSR0, b.master.read(TCSR0));
    BOOST_TEST(!timer.interrupt.get());
  });
  BOOST_REQUIRE(pulses.rises.size() == 3u);
  BOOST_TEST(pulses.rises[0] == 204u);
  BOOST_TEST(pulses.rises[1] == 306u);
  BOOST_TEST(pulses.rises[2] == 408u);
  BOOST_TEST(pulses.falls[0] == 205u);
}

BOOST_AUTO_TEST_CASE(timer_up_once_and_captures) {
  using namespace axi_timer;
  Bench b;
  vp::Signal<bool> trigger{"trigger"};
  xilinx::AxiTimer timer("axi_timer_0", b.clock);
  timer.capturetrig1(trigger);
  b.master.socket.bind(timer.s_axi.socket);
  b.master.simulate([&] {
    b.master.write(TLR0, 0xFFFF'FF9B);
    b.master.write(TCSR0, tcsr::LOAD);
    b.master.write(TCSR0, tcsr::ENT);
    BusMaster::wait_until(300 * period);
    BOOST_TEST(b.master.read(TCR0) == 0u, "it holds one past its end");
    BOOST_TEST((b.master.read(TCSR0) & (tcsr::TINT | tcsr::ENT)) == (tcsr::TINT | tcsr::ENT));
    b.master.write(TCSR1, tcsr::MDT | tcsr::CAPT | tcsr::ENT);
    BusMaster::wait_until(352 * period);
    trigger = true;
    BOOST_TEST(b.master.read(TLR1) == 50u);
    trigger = false;
    BusMaster::wait_until(400 * period);
    trigger = true;
    BOOST_TEST(b.master.read(TLR1) == 50u, "TINT is not cleared");
  });
}

BOOST_AUTO_TEST_CASE(timer_modulates_a_pulse) {
  using namespace axi_timer;
  Bench b;
  xilinx::AxiTimer timer("axi_timer_0", b.clock);
  b.master.socket.bind(timer.s_axi.socket);
  Rises pwm(timer.pwm0, b.scheduler);
  b.master.simulate([&] {
    b.master.write(TLR0, 98);
    b.master.write(TLR1, 18);
    constexpr std::uint32_t mode = tcsr::PWMA | tcsr::GENT | tcsr::UDT | tcsr::ARHT;
    for (const std::uint32_t at : {TCSR0, TCSR1}) b.master.write(at, mode | tcsr::LOAD);
    b.master.write(TCSR0, mode);
    b.master.write(TCSR1, mode | tcsr::ENALL);
    BusMaster::wait_until(1000 * period);
  });
  BOOST_REQUIRE(pwm.rises.size() > 4u);
  BOOST_TEST(pwm.rises[3] - pwm.rises[2] == 100u);
  const std::size_t late = pwm.falls.size() > pwm.rises.size() ? 1 : 0;
  BOOST_TEST(pwm.falls[2 + late] - pwm.rises[2] == 20u);
}

BOOST_AUTO_TEST_CASE(intc_latches_levels_until_acknowledged) {
  using namespace axi_intc;
  Bench b;
  xilinx::AxiIntcBuild build;
  build.num_intr_inputs = 4;
  build.kind_of_intr = 8;
  vp::Signal<bool> level{"level"}, edge{"edge"};
  xilinx::AxiIntc intc("axi_intc_0", b.clock, build);
  intc.intr(1)(level);
  intc.intr(3)(edge);
  b.master.socket.bind(intc.s_axi.socket);
  b.master.simulate([&] {
    b.master.write(ISR, 0xFF);
    BOOST_TEST(b.master.read(ISR) == 0xFu, "software sets it until MER.HIE");
    b.master.write(IAR, ~0u);
    b.master.write(IER, 0xF);
    b.master.write(MER, mer::ME | mer::HIE);
    b.master.write(MER, mer::ME);
    BOOST_TEST(b.master.read(MER) == 3u, "HIE stays");
    BOOST_TEST(b.master.read(IVR) == ~0u);
    level = true;
    edge = true;
    BusMaster::wait_until(20 * period);
    edge = false;
    level = false;
    BusMaster::wait_until(40 * period);
    BOOST_TEST(b.master.read(IPR) == 0xAu);
    BOOST_TEST(b.master.read(IVR) == 1u);
    BOOST_TEST(intc.irq.get());
    b.master.write(IAR, 2);
    BOOST_TEST(b.master.read(IVR) == 3u);
    b.master.write(CIE, 8);
    BOOST_TEST(!intc.irq.get());
  });
  BOOST_CHECK_THROW(intc.intr(4), std::out_of_range);
}

BOOST_AUTO_TEST_CASE(uartlite_sends_and_receives) {
  using namespace axi_uartlite;
  Bench b;
  xilinx::AxiUartliteBuild build;
  build.baudrate = 625'000;  // 160 clocks a bit
  xilinx::AxiUartlite uart("axi_uartlite_0", b.clock, build);
  b.master.socket.bind(uart.s_axi.socket);
  std::string sent;
  std::vector<std::uint64_t> times;
  uart.on_transmit = [&](std::uint8_t byte) {
    sent += static_cast<char>(byte);
    times.push_back(b.scheduler.now_ps() / period);
  };
  Rises irq(uart.interrupt, b.scheduler);
  b.master.simulate([&] {
    b.master.write(CTRL_REG, ctrl::Rst_Rx_FIFO | ctrl::Rst_Tx_FIFO | ctrl::Enable_Intr);
    BOOST_TEST(b.master.read(STAT_REG) == (stat::Tx_FIFO_Empty | stat::Intr_Enabled));
    for (const char c : {'a', 'b'}) b.master.write(TX_FIFO, static_cast<std::uint32_t>(c));
    uart.receive("xyz");
    BusMaster::wait_until(6000 * period);
    BOOST_TEST(b.master.read(RX_FIFO) == 'x');
    BOOST_TEST(b.master.read(RX_FIFO) == 'y');
    BOOST_TEST(b.master.read(RX_FIFO) == 'z');
    BOOST_TEST((b.master.read(STAT_REG) & stat::Rx_FIFO_Valid_Data) == 0u);
    b.master.read(RX_FIFO);
    for (int n = 0; n < 18; ++n) b.master.write(TX_FIFO, 0);
    uart.receive(std::string(17, 'o'));
    BusMaster::wait_until(60'000 * period);
    BOOST_TEST((b.master.read(STAT_REG) & stat::Overrun_Error) != 0u);
    BOOST_TEST((b.master.read(STAT_REG) & stat::Overrun_Error) == 0u, "a read clears it");
  });
  BOOST_TEST(sent.substr(0, 2) == "ab");
  BOOST_TEST(times[1] - times[0] == 1600u);
  BOOST_TEST(irq.falls[0] - irq.rises[0] == 1u);
  BOOST_TEST(b.said("RX_FIFO read while it is empty"));
  BOOST_TEST(b.said("TX_FIFO written while it is full"));
}

BOOST_AUTO_TEST_CASE(iic_dynamic_write_and_read) {
  using namespace axi_iic;
  Bench b;
  xilinx::AxiIic iic("axi_iic_0", b.clock);
  iic.bus.attach(0x50, std::make_unique<board::I2cEeprom>());
  b.master.socket.bind(iic.s_axi.socket);
  const auto until_free = [&] {
    while ((b.master.read(SR) & sr::BB) != 0) BusMaster::wait_until(b.scheduler.now_ps() + period);
  };
  b.master.simulate([&] {
    BOOST_TEST(b.master.read(SR) == 0xC0u);
    b.master.write(SOFTR, reset_key);
    BOOST_TEST(b.master.read(ISR) == 0xD0u);
    b.master.write(RX_FIFO_PIRQ, 0xF);
    b.master.write(CR, cr::EN);
    for (const std::uint32_t word : {0x100u | 0xA0u, 0x20u, 0x11u, 0x200u | 0x22u}) {
      b.master.write(TX_FIFO, word);
    }
    const std::uint64_t start = b.scheduler.now_ps();
    until_free();
    // A start, four bytes of nine periods and a stop, at 100 kHz.
    BOOST_TEST(b.scheduler.now_ps() - start >= 38 * 1000 * period - period);
    BOOST_TEST((b.master.read(ISR) & event::tx_error) == 0u);
    for (const std::uint32_t word : {0x100u | 0xA0u, 0x20u, 0x100u | 0xA1u, 0x200u | 2u}) {
      b.master.write(TX_FIFO, word);
    }
    until_free();
    BOOST_TEST(b.master.read(RX_FIFO_OCY) == 1u);
    BOOST_TEST(b.master.read(RX_FIFO) == 0x11u);
    BOOST_TEST(b.master.read(RX_FIFO) == 0x22u);
    b.master.write(ISR, b.master.read(ISR));
    b.master.write(TX_FIFO, 0x100u | 0x42u);
    until_free();
    BOOST_TEST((b.master.read(ISR) & event::tx_error) != 0u, "no device");
  });
}

BOOST_AUTO_TEST_CASE(iic_static_transfer) {
  using namespace axi_iic;
  Bench b;
  xilinx::AxiIic iic("axi_iic_0", b.clock);
  board::I2cDevice& sensor = iic.bus.attach(0x18, std::make_unique<board::I2cRegisterFile>());
  b.master.socket.bind(iic.s_axi.socket);
  const auto pass = [&](std::uint64_t clocks) {
    BusMaster::wait_until(b.scheduler.now_ps() + clocks * period);
  };
  b.master.simulate([&] {
    b.master.write(CR, cr::EN);
    b.master.write(TX_FIFO, 0x30);
    b.master.write(CR, cr::EN | cr::MSMS | cr::TX);
    BOOST_TEST((b.master.read(SR) & sr::BB) != 0u);
    pass(12'000);
    BOOST_TEST((b.master.read(ISR) & event::tx_empty) != 0u, "the throttle");
    b.master.write(TX_FIFO, 5);
    pass(10'000);
    b.master.write(CR, cr::EN | cr::TX);
    b.master.write(TX_FIFO, 0x77);
    pass(15'000);
    BOOST_TEST((b.master.read(SR) & sr::BB) == 0u, "stopped behind the last byte");
  });
  BOOST_TEST(sensor.peek(5) == 0x77);
}

BOOST_AUTO_TEST_CASE(quad_spi_loops_back_and_reads_a_flash) {
  using namespace axi_quad_spi;
  Bench b;
  xilinx::AxiQuadSpi spi("axi_quad_spi_0", b.clock);
  spi.attach(0, std::make_shared<board::SpiFlash>());
  BOOST_CHECK_THROW(spi.attach(1, nullptr), std::out_of_range);
  b.master.socket.bind(spi.s_axi.socket);
  b.master.simulate([&] {
    BOOST_TEST(b.master.read(SPICR) == 0x180u);
    BOOST_TEST(b.master.read(SPISR) == 0x25u);
    BOOST_TEST(b.master.read(SPISSR) == 1u);
    b.master.write(SPICR, spicr::LOOP | spicr::SPE | spicr::Master);
    b.master.write(SPI_DTR, 0x5A);
    BusMaster::wait_until(127 * period);
    BOOST_TEST((b.master.read(SPISR) & spisr::RX_Empty) != 0u);
    BusMaster::wait_until(130 * period);
    BOOST_TEST(b.master.read(SPI_DRR) == 0x5Au);
    b.master.write(SPICR, spicr::SPE | spicr::Master | spicr::Manual_SS | spicr::Inhibit);
    b.master.write(SPISSR, 0);
    for (const std::uint32_t byte : {0x9Fu, 0u, 0u}) b.master.write(SPI_DTR, byte);
    BOOST_TEST(b.master.read(TX_OCY) == 2u);
    b.master.write(SPICR, spicr::SPE | spicr::Master | spicr::Manual_SS);
    BusMaster::wait_until(1000 * period);
    BOOST_TEST((b.master.read(IPISR) & event::DTR_Empty) != 0u);
    BOOST_TEST(b.master.read(SPI_DRR) == 0xFFu);
    BOOST_TEST(b.master.read(SPI_DRR) == 0xEFu);
    BOOST_TEST(b.master.read(SPI_DRR) == 0x40u);
    b.master.read(SPI_DRR);
  });
  BOOST_TEST(b.said("SPI_DRR read while it is empty"));
}

// The flash sees the same bytes, whichever bit of a word is the first one.
BOOST_AUTO_TEST_CASE(quad_spi_has_words_of_16_bits) {
  using namespace axi_quad_spi;
  Bench b;
  xilinx::AxiQuadSpiBuild build;
  build.num_transfer_bits = 16;
  xilinx::AxiQuadSpi spi("axi_quad_spi_0", b.clock, build);
  spi.attach(0, std::make_shared<board::SpiFlash>());
  b.master.socket.bind(spi.s_axi.socket);
  b.master.simulate([&] {
    const std::uint32_t running = spicr::SPE | spicr::Master | spicr::Manual_SS;
    b.master.write(SPICR, spicr::LOOP | spicr::SPE | spicr::Master);
    b.master.write(SPI_DTR, 0x1'5A5B);
    BusMaster::wait_until(255 * period);
    BOOST_TEST((b.master.read(SPISR) & spisr::RX_Empty) != 0u, "a word is 16 periods of 16 clocks");
    BusMaster::wait_until(258 * period);
    BOOST_TEST(b.master.read(SPI_DRR) == 0x5A5Bu);
    b.master.write(SPICR, running);
    b.master.write(SPISSR, 0);
    for (const std::uint32_t word : {0x9F00u, 0u}) b.master.write(SPI_DTR, word);
    BusMaster::wait_until(1'000 * period);
    BOOST_TEST(b.master.read(SPI_DRR) == 0xFFEFu);
    BOOST_TEST(b.master.read(SPI_DRR) == 0x4016u);
    b.master.write(SPISSR, 1);
    b.master.write(SPICR, running | spicr::LSB_First);
    b.master.write(SPISSR, 0);
    for (const std::uint32_t word : {0x00F9u, 0u}) b.master.write(SPI_DTR, word);
    BusMaster::wait_until(2'000 * period);
    BOOST_TEST(b.master.read(SPI_DRR) == 0xF7FFu);
    BOOST_TEST(b.master.read(SPI_DRR) == 0x6802u);
  });
}

BOOST_AUTO_TEST_CASE(quad_spi_has_words_of_whole_bytes) {
  Bench b;
  xilinx::AxiQuadSpiBuild build;
  build.num_transfer_bits = 12;
  BOOST_CHECK_THROW(xilinx::AxiQuadSpi("axi_quad_spi_0", b.clock, build), vp::InputError);
}

BOOST_AUTO_TEST_CASE(fifo_sends_packets_to_itself) {
  using namespace axi_fifo_mm_s;
  Bench b;
  vp::AxiStream stream("stream");
  xilinx::AxiFifoMmSBuild build;
  build.has_tkeep = true;
  xilinx::AxiFifoMmS fifo("axi_fifo_mm_s_0", b.clock, build);
  fifo.axi_str_txd(stream);
  fifo.axi_str_rxd(stream);
  b.master.socket.bind(fifo.s_axi.socket);
  b.master.simulate([&] {
    BOOST_TEST(b.master.read(ISR) == (event::TRC | event::RRC));
    b.master.write(ISR, ~0u);
    BOOST_TEST(b.master.read(ISR) == 0u);
    BOOST_TEST(b.master.read(TDFV) == 508u);
    for (std::uint32_t word = 1; word <= 3; ++word) b.master.write(TDFD, word);
    BOOST_TEST(b.master.read(RDFO) == 0u);
    b.master.write(TLR, 10);
    BusMaster::wait_until(50 * period);
    BOOST_TEST(b.master.read(ISR) == (event::TC | event::RC));
    BOOST_TEST(b.master.read(RDFO) == 3u);
    BOOST_TEST(b.master.read(RLR) == 10u);
    for (std::uint32_t word = 1; word <= 3; ++word) BOOST_TEST(b.master.read(RDFD) == word);
    b.master.write(ISR, ~0u);
    b.master.write(TDFD, 1);
    b.master.write(TLR, 8);
    BOOST_TEST(b.master.read(ISR) == event::TSE, "the length is that of another packet");
    b.master.read(RDFD);
    BOOST_TEST((b.master.read(ISR) & event::RPUE) != 0u);
  });
  BOOST_TEST(b.said("TLR does not agree with the words"));
}

BOOST_AUTO_TEST_SUITE_END()
