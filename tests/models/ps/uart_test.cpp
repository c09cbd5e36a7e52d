#include <uart_registers.h>

#include <ps/uart/uart.h>
#include <vp/report.h>
#include <boost/test/unit_test.hpp>
#include <sstream>
#include <string>

#include "bench.h"
#include "register_policy.h"

using namespace bench;

namespace {

constexpr std::uint32_t at = uart::uart1_base;
/// 50 MHz / (62 × 7) = 115 207 baud: 434 cycles of 20 ns a bit, 86.8 us a character of 8N1.
constexpr std::uint32_t baudgen = 62, baud_div = 6;
constexpr std::uint64_t bit_ps = 434 * 20'000, character_ps = 10 * bit_ps;

struct UartBench : Bench {
  UartBench() {
    reports.redirect(text);
    bus.map("uart1", at, 0x1000).bind(dut.registers.socket);
    dut.rst(rst);
    dut.on_transmit = [this](std::uint8_t byte) {
      sent += static_cast<char>(byte);
      sent_at.push_back(scheduler.now_ps());
    };
    dut.console.connect([this](const std::string& line) { lines.push_back(line); }, "uart1: ");
  }
  vp::Clock ref_clk{"ref_clk", scheduler, 50'000'000};
  vp::Signal<bool> rst{"rst"};
  ps::Uart dut{"uart", ref_clk};
  Changes<bool> irq{dut.irq, scheduler};
  std::string sent;
  std::vector<std::uint64_t> sent_at;
  std::vector<std::string> lines;
  std::ostringstream text;
  vp::ReportRouter reports;
};

using Times = std::vector<std::uint64_t>;

void after_ps(std::uint64_t ps) {
  hal_work(step, ps / 1000);  // the CPU has 1 GHz
}
std::uint32_t get(std::uint32_t offset) {
  return hal_read32(at + offset);
}
void set(std::uint32_t offset, std::uint32_t value) {
  hal_write32(at + offset, value);
}
void set_up(std::uint32_t mode = uart::mr::PAR_none) {
  set(uart::MR, mode);
  set(uart::BAUDGEN, baudgen);
  set(uart::BAUD_DIV, baud_div);
  set(uart::CR, uart::cr::TXEN | uart::cr::RXEN | uart::cr::TXRES | uart::cr::RXRES);
}
/// Time to the next edge of the reference clock does not count: at its edges only.
void send(const char* text) {
  for (; *text != 0; ++text) set(uart::FIFO, static_cast<std::uint8_t>(*text));
}

}  // namespace

BOOST_AUTO_TEST_SUITE(uart_test)

BOOST_AUTO_TEST_CASE(reset_values) {
  UartBench b;
  b.run([] {
    for (const vp::RegisterInfo& info : uart::registers) {
      if (info.offset == uart::SR || info.offset == uart::FIFO) continue;
      BOOST_TEST(get(info.offset) == seen_after_reset(info), info.name);
    }
    BOOST_TEST(get(uart::SR) == (uart::sr::REMPTY | uart::sr::TEMPTY), "both FIFOs are empty");
    BOOST_TEST(get(0x3C) == 0u, "a hole");
    return 0;
  });
  BOOST_TEST(!b.dut.irq.get());
}

BOOST_AUTO_TEST_CASE(every_bit) {
  UartBench b;
  b.run([] {
    for (const vp::RegisterInfo& info : uart::registers) {
      if (info.offset == uart::MR || info.offset == uart::BAUDGEN || info.offset == uart::RXTOUT ||
          info.offset == uart::RXWM || info.offset == uart::MODEMCR ||
          info.offset == uart::FLOW_DELAY || info.offset == uart::TX_FIFO_LEVEL) {
        check_stored_bits(at, info);
      }
    }
    for (unsigned bit = 0; bit < 32; ++bit) {
      set(uart::CR, 1u << bit);
      constexpr std::uint32_t clears_itself = uart::cr::RXRES | uart::cr::TXRES | uart::cr::TORST;
      BOOST_TEST(get(uart::CR) == (1u << bit & 0x1FF & ~clears_itself), "CR bit " << bit);
      set(uart::IER, 1u << bit);
      BOOST_TEST(get(uart::IMR) == (1u << bit & uart::event::all), "IMR bit " << bit);
      set(uart::IDR, 1u << bit);
      BOOST_TEST(get(uart::IMR) == 0u, "IMR bit " << bit);
    }
    set(uart::IER, 0xFFFF'FFFF);
    set(uart::IMR, 0);
    BOOST_TEST(get(uart::IMR) == uart::event::all, "read only");
    set(uart::IDR, 0);
    BOOST_TEST(get(uart::IMR) == uart::event::all);
    BOOST_TEST(get(uart::IER) == 0u);
    BOOST_TEST(get(uart::IDR) == 0u);
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(a_small_second_divisor_is_not_taken) {
  UartBench b;
  b.run([] {
    for (std::uint32_t value = 0; value < 256; ++value) {
      set(uart::BAUD_DIV, 15);
      set(uart::BAUD_DIV, value);
      BOOST_TEST(get(uart::BAUD_DIV) == (value < 4 ? 15 : value));
    }
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(flow_control_shows_in_the_modem_status) {
  UartBench b;
  b.run([] {
    set(uart::MODEMCR, uart::modemcr::FCM);
    BOOST_TEST(get(uart::MODEMSR) == uart::modemsr::FCMS);
    set(uart::MODEMSR, 0xFFFF'FFFF);
    BOOST_TEST(get(uart::MODEMSR) == uart::modemsr::FCMS);
    set(uart::MODEMCR, 0);
    BOOST_TEST(get(uart::MODEMSR) == 0u);
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(bytes_leave_at_the_baud_rate) {
  UartBench b;
  b.run([] {
    set_up();
    send("Hi\n");
    BOOST_TEST(get(uart::SR) == (uart::sr::REMPTY | uart::sr::TACTIVE), "the first is under way");
    after_ps(character_ps - 1'000);
    BOOST_TEST(get(uart::SR) == (uart::sr::REMPTY | uart::sr::TACTIVE));
    after_ps(1'000);
    after_ps(character_ps);
    BOOST_TEST(get(uart::SR) == (uart::sr::REMPTY | uart::sr::TACTIVE | uart::sr::TEMPTY));
    after_ps(character_ps);
    BOOST_TEST(get(uart::SR) == (uart::sr::REMPTY | uart::sr::TEMPTY));
    return 0;
  });
  BOOST_TEST(b.sent == "Hi\n");
  BOOST_TEST(b.sent_at == (Times{character_ps, 2 * character_ps, 3 * character_ps}),
             boost::test_tools::per_element());
  BOOST_TEST(b.lines == std::vector<std::string>{"uart1: Hi"}, boost::test_tools::per_element());
  BOOST_TEST(b.dut.transmitted == 3u);
}

BOOST_AUTO_TEST_CASE(format_and_clock_make_the_length_of_a_character) {
  constexpr std::uint32_t none = uart::mr::PAR_none;
  const struct {
    std::uint32_t mode;
    std::uint64_t half_bits;
  } cases[] = {{none, 20},
               {0u << uart::mr::PAR_shift, 22},            // even parity
               {3u << uart::mr::PAR_shift, 22},            // mark
               {none | 2u << uart::mr::CHRL_shift, 18},    // 7 bits
               {none | 3u << uart::mr::CHRL_shift, 16},    // 6 bits
               {none | 1u << uart::mr::CHRL_shift, 20},    // 8 bits
               {none | 1u << uart::mr::NBSTOP_shift, 21},  // 1.5 stop bits
               {none | 2u << uart::mr::NBSTOP_shift, 22},
               {none | uart::mr::CLKS, 160}};
  for (const auto& c : cases) {
    UartBench b;
    b.run([&] {
      set_up(c.mode);
      send("x");
      after_ps(100 * bit_ps);
      return 0;
    });
    BOOST_TEST(b.sent_at == Times{c.half_bits * bit_ps / 2}, boost::test_tools::per_element());
  }
}

BOOST_AUTO_TEST_CASE(nothing_leaves_without_transmitter_or_baud_rate) {
  UartBench b;
  b.run([] {
    set_up();
    set(uart::CR, uart::cr::RXEN | uart::cr::TXEN | uart::cr::TXDIS);
    send("x");
    after_ps(2 * character_ps);
    BOOST_TEST((get(uart::SR) & (uart::sr::TEMPTY | uart::sr::TACTIVE)) == 0u);
    set(uart::BAUDGEN, 0);
    set(uart::CR, uart::cr::RXEN | uart::cr::TXEN);
    after_ps(2 * character_ps);
    BOOST_TEST((get(uart::SR) & uart::sr::TACTIVE) == 0u);
    set(uart::BAUDGEN, baudgen);
    BOOST_TEST((get(uart::SR) & uart::sr::TACTIVE) != 0u);
    after_ps(character_ps);
    return 0;
  });
  BOOST_TEST(b.sent_at == Times{5 * character_ps}, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(the_transmit_fifo_fills) {
  UartBench b;
  b.run([] {
    set_up();
    set(uart::CR, uart::cr::TXEN | uart::cr::TXDIS);
    set(uart::TX_FIFO_LEVEL, 10);
    for (unsigned n = 1; n <= 64; ++n) {
      set(uart::FIFO, n);
      const std::uint32_t expected = uart::sr::REMPTY | (n >= 10 ? uart::sr::TTRIG : 0) |
                                     (n == 63 ? uart::sr::TNFUL : 0) |
                                     (n == 64 ? uart::sr::TFUL : 0);
      BOOST_TEST(get(uart::SR) == expected, n << " bytes");
    }
    BOOST_TEST(get(uart::ISR) == (uart::event::TTRIG | uart::event::TNFUL | uart::event::TFUL));
    set(uart::ISR, uart::event::TTRIG);
    BOOST_TEST(get(uart::ISR) == (uart::event::TNFUL | uart::event::TFUL));
    set(uart::FIFO, 65);
    BOOST_TEST((get(uart::ISR) & uart::event::TOVR) != 0u);
    set(uart::TX_FIFO_LEVEL, 0);
    BOOST_TEST((get(uart::SR) & uart::sr::TTRIG) == 0u, "0 is no trigger");
    set(uart::CR, uart::cr::TXRES);
    BOOST_TEST((get(uart::SR) & uart::sr::TEMPTY) != 0u);
    return 0;
  });
  BOOST_TEST(b.dut.lost == 1u);
  BOOST_TEST(b.reports.count("/markervp/uart/overflow") == 1u);
  BOOST_TEST(b.sent == "");
}

BOOST_AUTO_TEST_CASE(an_empty_transmit_fifo_interrupts_when_it_becomes_so) {
  UartBench b;
  b.run([] {
    set_up();
    set(uart::IER, uart::event::TEMPTY);
    after_ps(1'000'000);
    BOOST_TEST(get(uart::ISR) == 0u, "empty from the start is no event");
    send("ab");
    BOOST_TEST(get(uart::ISR) == uart::event::TEMPTY, "'a' went straight to the shifter");
    set(uart::ISR, uart::event::TEMPTY);
    after_ps(3 * character_ps);
    set(uart::ISR, uart::event::all);
    return 0;
  });
  // Raised with 'a' and cleared, raised again when 'b' follows, cleared.
  BOOST_TEST(b.irq.times == (Times{1'000'000, 1'000'000, 1'000'000 + character_ps,
                                   1'000'000 + 3 * character_ps}),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(bytes_arrive_at_the_baud_rate) {
  UartBench b;
  b.run([&] {
    set_up();
    b.dut.receive("OK");
    BOOST_TEST((get(uart::SR) & (uart::sr::RACTIVE | uart::sr::REMPTY)) ==
               (uart::sr::RACTIVE | uart::sr::REMPTY));
    after_ps(character_ps - 1'000);
    BOOST_TEST((get(uart::SR) & uart::sr::REMPTY) != 0u);
    after_ps(1'000);
    BOOST_TEST((get(uart::SR) & uart::sr::REMPTY) == 0u);
    after_ps(character_ps);
    BOOST_TEST(get(uart::FIFO) == 'O');
    BOOST_TEST(get(uart::ISR) == 0u);
    BOOST_TEST(get(uart::FIFO) == 'K');
    BOOST_TEST(get(uart::ISR) == uart::event::REMPTY);
    BOOST_TEST(get(uart::FIFO) == 0u);
    return 0;
  });
  BOOST_TEST(b.dut.received == 2u);
  BOOST_TEST(b.reports.count("/markervp/uart/read_empty") == 1u);
}

BOOST_AUTO_TEST_CASE(the_receive_fifo_fills_and_overflows) {
  UartBench b;
  b.run([&] {
    set_up();
    set(uart::RXWM, 3);
    set(uart::FLOW_DELAY, 60);
    set(uart::IER, uart::event::RTRIG);
    b.dut.receive(std::string(65, 'r'));
    after_ps(2 * character_ps);
    BOOST_TEST((get(uart::SR) & uart::sr::RTRIG) == 0u);
    BOOST_TEST(get(uart::ISR) == 0u);
    after_ps(character_ps);
    BOOST_TEST((get(uart::SR) & uart::sr::RTRIG) != 0u);
    BOOST_TEST(get(uart::ISR) == uart::event::RTRIG);
    after_ps(56 * character_ps);
    BOOST_TEST((get(uart::SR) & uart::sr::FDELT) == 0u);
    after_ps(character_ps);
    BOOST_TEST((get(uart::SR) & uart::sr::FDELT) != 0u);
    after_ps(4 * character_ps);
    BOOST_TEST((get(uart::SR) & uart::sr::RFUL) != 0u);
    BOOST_TEST(get(uart::ISR) == (uart::event::RTRIG | uart::event::RFUL));
    after_ps(character_ps);
    BOOST_TEST(get(uart::ISR) == (uart::event::RTRIG | uart::event::RFUL | uart::event::ROVR));
    set(uart::RXWM, 0);
    set(uart::FLOW_DELAY, 3);
    BOOST_TEST((get(uart::SR) & (uart::sr::RTRIG | uart::sr::FDELT)) == 0u, "off");
    set(uart::CR, uart::cr::RXRES);
    BOOST_TEST((get(uart::SR) & uart::sr::REMPTY) != 0u);
    return 0;
  });
  BOOST_TEST(b.irq.times == Times{3 * character_ps}, boost::test_tools::per_element());
  BOOST_TEST(b.dut.lost == 1u);
}

BOOST_AUTO_TEST_CASE(a_receiver_that_is_off_hears_nothing) {
  UartBench b;
  b.run([&] {
    set_up();
    set(uart::CR, uart::cr::RXEN | uart::cr::RXDIS);
    b.dut.receive("x");
    after_ps(2 * character_ps);
    BOOST_TEST((get(uart::SR) & uart::sr::REMPTY) != 0u);
    BOOST_TEST(get(uart::ISR) == 0u);
    return 0;
  });
  BOOST_TEST(b.dut.lost == 1u);
}

BOOST_AUTO_TEST_CASE(the_time_out_counts_from_the_last_start_bit) {
  UartBench b;
  b.run([&] {
    set_up();
    set(uart::RXTOUT, 10);  // 43 bits
    set(uart::IER, uart::event::TIMEOUT);
    b.dut.receive("ab");
    after_ps(character_ps + 43 * bit_ps - 1'000);
    BOOST_TEST(get(uart::ISR) == 0u);
    after_ps(1'000);
    BOOST_TEST(get(uart::ISR) == uart::event::TIMEOUT);
    set(uart::ISR, uart::event::TIMEOUT);
    after_ps(1000 * bit_ps);
    BOOST_TEST(get(uart::ISR) == 0u, "once");
    set(uart::CR, uart::cr::RXEN | uart::cr::TXEN | uart::cr::TORST);
    after_ps(43 * bit_ps);
    BOOST_TEST(get(uart::ISR) == uart::event::TIMEOUT, "again after a restart");
    return 0;
  });
}

// The receiver sees the start bits of what the transmitter sends.
BOOST_AUTO_TEST_CASE(the_time_out_in_local_loopback) {
  UartBench b;
  b.run([&] {
    set_up(uart::mr::PAR_none | uart::mr::CHMODE_local_loopback);
    set(uart::RXTOUT, 10);  // 43 bits
    send("ab");
    after_ps(character_ps + 43 * bit_ps - 1'000);
    BOOST_TEST((get(uart::ISR) & uart::event::TIMEOUT) == 0u);
    after_ps(1'000);
    BOOST_TEST((get(uart::ISR) & uart::event::TIMEOUT) == uart::event::TIMEOUT);
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(channel_modes) {
  UartBench local;
  local.run([&] {
    set_up(uart::mr::PAR_none | uart::mr::CHMODE_local_loopback);
    send("L");
    local.dut.receive("no");
    after_ps(3 * character_ps);
    BOOST_TEST(get(uart::FIFO) == 'L');
    BOOST_TEST((get(uart::SR) & uart::sr::REMPTY) != 0u);
    return 0;
  });
  BOOST_TEST(local.sent == "");

  UartBench echo;
  echo.run([&] {
    set_up(uart::mr::PAR_none | uart::mr::CHMODE_echo);
    echo.dut.receive("E");
    after_ps(3 * character_ps);
    BOOST_TEST(get(uart::FIFO) == 'E');
    return 0;
  });
  BOOST_TEST(echo.sent == "E");
  BOOST_TEST(echo.sent_at == Times{2 * character_ps}, boost::test_tools::per_element());

  UartBench remote;
  remote.run([&] {
    set_up(uart::mr::PAR_none | uart::mr::CHMODE_remote_loopback);
    remote.dut.receive("R");
    send("no");
    after_ps(3 * character_ps);
    BOOST_TEST((get(uart::SR) & uart::sr::REMPTY) != 0u);
    return 0;
  });
  BOOST_TEST(remote.sent == "R");
  BOOST_TEST(remote.reports.count("/markervp/uart/remote_loopback") == 2u);
}

BOOST_AUTO_TEST_CASE(it_follows_its_clock_and_stops_with_it) {
  UartBench b;
  b.device.written = [&](std::uint32_t hertz) { b.ref_clk.set_frequency(hertz); };
  b.run([&] {
    set_up();
    send("abc");
    after_ps(character_ps);
    hal_write32(device_address, 100'000'000);
    after_ps(character_ps / 2);
    hal_write32(device_address, 0);
    after_ps(10 * character_ps);
    hal_write32(device_address, 50'000'000);
    after_ps(2 * character_ps);
    return 0;
  });
  BOOST_TEST(b.sent_at == (Times{character_ps, character_ps * 3 / 2, character_ps * 25 / 2}),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(a_reset_forgets_everything) {
  UartBench b;
  b.run(
      [&] {
        set_up();
        send("abc");
        b.dut.receive("xyz");
        after_ps(character_ps);
        hal_barrier();  // the processor may be ahead
        b.rst = true;
        after_ps(character_ps);
        hal_barrier();
        b.rst = false;
        BOOST_TEST(get(uart::CR) == 0x128u);
        BOOST_TEST(get(uart::BAUDGEN) == 0x28Bu);
        BOOST_TEST(get(uart::SR) == (uart::sr::REMPTY | uart::sr::TEMPTY));
        after_ps(10 * character_ps);
        hal_barrier();
        b.rst = true;
        return static_cast<int>(get(uart::SR));  // a bus error
      },
      false);
  BOOST_TEST(b.sent == "a");
  BOOST_TEST(b.reports.count("/markervp/register_bank/in_reset") == 1u);
  BOOST_TEST(!b.failure().empty());
}

BOOST_AUTO_TEST_SUITE_END()
