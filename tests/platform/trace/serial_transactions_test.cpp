// Transactions of buses without a clock wire of the design: UART, I2C, SPI, interrupts.
#include <boost/test/unit_test.hpp>

#include "clocked_bus.h"

using namespace platform::trace;

namespace {

/// A line that is driven step by step; changes are collected in one order.
class Lines {
 public:
  explicit Lines(const std::string& first) : changes_("#0 " + first + "\n") {}
  Lines& after(unsigned ns) {
    now_ += ns;
    changes_ += "#" + std::to_string(now_) + "\n";
    return *this;
  }
  Lines& set(const std::string& value) {
    changes_ += value + "\n";
    return *this;
  }
  const std::string& text() const { return changes_; }

 private:
  std::string changes_;
  unsigned now_ = 0;
};

/// A byte at 100 ns a bit.
void send(Lines& lines, unsigned value, const char* stop = "1!", unsigned bits = 8) {
  lines.set("0!");
  for (unsigned bit = 0; bit < bits; ++bit)
    lines.after(100).set((value >> bit & 1U) != 0 ? "1!" : "0!");
  lines.after(100).set(stop).after(100);
}

std::string bytes_of(const FoundTransactions& found) {
  std::string text;
  for (const Transaction& one : found.all)
    text += (one.data.empty() ? "-" : one.data.front()) + "@" +
            std::to_string(one.begin_ps / 1000) + " ";
  return text;
}

/// A byte of I2C with its acknowledgement; SCL is `!`, SDA `"`.
void i2c_byte(Lines& lines, unsigned value, bool acknowledged) {
  for (int bit = 7; bit >= -1; --bit) {
    const bool high = bit >= 0 ? (value >> bit & 1) != 0 : !acknowledged;
    lines.set("0!").after(10).set(high ? "z\"" : "0\"").after(10).set("z!").after(20);
  }
  lines.set("0!").after(10);
}

/// Two bytes on MOSI `"` and their complement on MISO `#`; clock `!`, select `$`.
std::string spi_changes(unsigned mode) {
  const bool idle = mode >= 2, second = (mode & 1U) != 0;
  const std::string rest = idle ? "1!" : "0!", active = idle ? "0!" : "1!";
  Lines lines(rest + " 0\" 0# 1$");
  lines.after(100).set("0$");
  for (const unsigned byte : {0xa5U, 0x3cU}) {
    for (int bit = 7; bit >= 0; --bit) {
      const bool high = (byte >> bit & 1U) != 0;
      const std::string data = std::string(high ? "1" : "0") + "\"\n" + (high ? "0" : "1") + "#";
      if (!second) lines.set(data);
      lines.after(50).set(active);
      if (second) lines.set(data);
      lines.after(50).set(rest);
    }
  }
  lines.after(50).set("1$").after(100).set("0\"");
  return lines.text();
}

}  // namespace

BOOST_AUTO_TEST_SUITE(serial_transactions)

BOOST_AUTO_TEST_CASE(bytes_of_a_uart_at_a_measured_rate) {
  Lines lines("1!");
  lines.after(1000);
  send(lines, 0x55), send(lines, 0x41), lines.after(300), send(lines, 0x00);
  lines.after(500).set("1!");
  const auto found = transactions_of("t.uart_tx 1", lines.text());
  BOOST_TEST(found.survey.interfaces[0].bit_ps == 100'000u);
  BOOST_TEST(bytes_of(found) == "0x55@1000 0x41@2000 0x0@3300 ");
  BOOST_TEST(found.rules() == "");
  BOOST_TEST(*found.all[0].end_ps == 2'000'000u);
  BOOST_TEST(found.all[1].note == "'A'");
}

BOOST_AUTO_TEST_CASE(faults_of_a_uart) {
  const auto rules = [](const std::function<void(Lines&)>& drive,
                        const std::string& settings = "") {
    Lines lines("1!");
    lines.after(1000);
    send(lines, 0x55, "1!", settings.empty() ? 8 : 9);
    drive(lines);
    lines.after(3000).set("1!").after(2000).set("0!");
    TransactionsOptions options;
    options.described = {"uart u: line=t.n baud=10000000" + settings};
    return transactions_of("t.n 1", lines.text(), options).rules();
  };
  BOOST_TEST(rules([](Lines&) {}) == "");
  BOOST_TEST(rules([](Lines& lines) { send(lines, 0x41, "0!"); }) == "UART_FRAMING ");
  BOOST_TEST(rules([](Lines& lines) { send(lines, 0x00, "0!"); }) == "UART_BREAK ");
  BOOST_TEST(rules([](Lines& lines) { lines.set("0!").after(20).set("1!"); }) == "UART_START ");
  // 0x55 has four ones, so its parity bit is 0.
  BOOST_TEST(rules([](Lines& lines) { send(lines, 0x155, "1!", 9); }, " parity=even") ==
             "UART_PARITY ");
  BOOST_TEST(complaint([&] { rules([](Lines&) {}, " bits=12"); }).find("from 5 to 9") !=
             std::string::npos);
  BOOST_TEST(complaint([&] { rules([](Lines&) {}, " parity=mark"); }) != "");
}

BOOST_AUTO_TEST_CASE(transfers_of_i2c) {
  Lines lines("z! z\"");
  const auto start = [&] { lines.after(20).set("0\"").after(20).set("0!").after(10); };
  const auto stop = [&] { lines.set("0\"").after(10).set("z!").after(20).set("z\"").after(40); };
  start(), i2c_byte(lines, 0xa0, true), i2c_byte(lines, 0x12, true), stop();
  start(), i2c_byte(lines, 0xa0, true), i2c_byte(lines, 0x34, true);
  lines.set("z\"").after(10).set("z!").after(10);
  start(), i2c_byte(lines, 0xa1, true), i2c_byte(lines, 0x56, false), stop();
  start(), i2c_byte(lines, 0x10, false), stop();
  const auto found = transactions_of("t.scl 1, t.sda 1", lines.text());
  BOOST_TEST(found.interfaces() == "t:i2c ");
  std::string text;
  for (const Transaction& one : found.all) {
    text += std::string(one.operation) + " " + hexadecimal(*one.address) + " " +
            (one.data.empty() ? "-" : one.data.front()) + " " + one.response + "; ";
  }
  BOOST_TEST(text ==
             "write 0x50 0x12 ACK; write 0x50 0x34 ACK; read 0x50 0x56 ACK; "
             "write 0x8 - NACK; ");
  BOOST_TEST(found.all[1].note == "repeated START");
  BOOST_TEST(found.rules() == "");
  Lines cut("z! z\"");
  cut.after(20).set("0\"").after(20).set("0!").after(10);
  i2c_byte(cut, 0xa0, true);
  for (int bit = 0; bit < 3; ++bit) cut.after(10).set("z!").after(10).set("0!");
  cut.set("0\"").after(10).set("z!").after(20).set("z\"").after(40).set("0!");
  BOOST_TEST(transactions_of("t.scl 1, t.sda 1", cut.text()).rules() == "I2C_BYTE ");
}

BOOST_AUTO_TEST_CASE(the_four_modes_of_spi) {
  TransactionsOptions options;
  options.decode.data_beats = 8;
  for (unsigned mode = 0; mode < 4; ++mode) {
    const auto found =
        transactions_of("t.sck 1, t.mosi 1, t.miso 1, t.cs_n 1", spi_changes(mode), options);
    BOOST_TEST_CONTEXT("mode " << mode) {
      BOOST_TEST_REQUIRE(found.all.size() == 1u);
      BOOST_TEST(found.all[0].data == (std::vector<std::string>{"0xa5", "0x5a", "0x3c", "0xc3"}));
      BOOST_TEST(found.all[0].note == "mode " + std::to_string(mode));
      BOOST_TEST(*found.all[0].end_ps == 1'750'000u);
      BOOST_TEST(found.rules() == "");
    }
  }
  options.described = {"spi t: sclk=sck mosi=mosi miso=miso cs=cs_n order=lsb bits=12 mode=0"};
  const auto twelve =
      transactions_of("t.sck 1, t.mosi 1, t.miso 1, t.cs_n 1", spi_changes(0), options);
  BOOST_TEST(twelve.all[0].data.front() == "0xca5");
  BOOST_TEST(twelve.rules() == "SPI_WORD ");
}

BOOST_AUTO_TEST_CASE(interrupts_from_rise_to_fall) {
  const auto found = transactions_of(
      "t.irq 1, t.irq_f2p 2", "#0 0! b0 \"\n#10 1! b1 \"\n#20 b11 \"\n#30 0! b10 \"\n#50 0!\n");
  std::string text;
  for (const Transaction& one : found.all)
    text += (one.id ? std::to_string(*one.id) : "-") + ":" + brief(one) + " ";
  BOOST_TEST(text == "-:interrupt 10-30 0:interrupt 10-30 1:interrupt 20- ");
  const auto low = transactions_of("t.n_irq 1", "#0 1!\n#10 0!\n#30 1!\n#50 1!\n");
  BOOST_TEST_REQUIRE(low.all.size() == 1u);
  BOOST_TEST(brief(low.all[0]) == "interrupt 10-30");
}

BOOST_AUTO_TEST_SUITE_END()
