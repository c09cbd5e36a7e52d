#include <boost/test/unit_test.hpp>
#include <sstream>
#include <stdexcept>
#include <vector>

#include <bus_master.h>
#include <simulation.h>
#include <vp/clock.h>
#include <vp/clock_scheduler.h>
#include <vp/register_bank.h>
#include <vp/report.h>

namespace {

constexpr vp::RegisterInfo table[] = {
    {"CONTROL", 0x00, 0x00000005, vp::Access::read_write, 0x000000FF, ""},
    {"STATUS", 0x04, 0x000000F0, vp::Access::read_only, 0x00000000, ""},
    {"COMMAND", 0x08, 0x00000000, vp::Access::write_only, 0xFFFFFFFF, ""},
    {"EVENT", 0x10, 0x000000FF, vp::Access::write_1_to_clear, 0x0000000F, ""},
    {"TOGGLE", 0x14, 0x00000000, vp::Access::write_1_to_toggle, 0x00000003, ""},
    {"SET", 0x18, 0x00000010, vp::Access::write_1_to_set, 0x0000000F, ""},
};
constexpr std::uint32_t hole = 0x0C;

using Options = vp::RegisterBankOptions;

Options options(Options::Holes holes, Options::ByteEnables enables) {
  Options o;
  o.holes = holes;
  o.byte_enables = enables;
  o.address_bits = 6;
  return o;
}

struct Bench : kit::Simulation {
  explicit Bench(const Options& o = options(Options::Holes::error, Options::ByteEnables::error))
      : bank("bank", table, o, &scheduler) {
    reports.redirect(text);
    master.socket.bind(bank.socket);
  }
  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clock{"clock", scheduler, 100'000'000};
  kit::BusMaster master{"master"};
  vp::RegisterBank bank;
  std::ostringstream text;
  vp::ReportRouter reports;
};

struct LenientBench : Bench {
  LenientBench() : Bench(options(Options::Holes::acknowledge, Options::ByteEnables::ignore)) {}
};

}  // namespace

BOOST_FIXTURE_TEST_CASE(reset_values_and_access_policies, Bench) {
  master.simulate([&] {
    BOOST_TEST(master.read(0x00) == 0x05u);
    master.write(0x00, 0xFFFFFFFF);
    BOOST_TEST(master.read(0x00) == 0xFFu, "only writable bits change");
    bank[0x00] = 0xABCD'EF55;
    master.write(0x00, 0x11);
    BOOST_TEST(master.read(0x00) == 0xABCD'EF11u, "the others keep what the hardware set");
    master.write(0x00, 0xFF);

    master.write(0x04, 0x12345678);
    BOOST_TEST(master.response() == tlm::TLM_OK_RESPONSE, "AXI acknowledges it");
    BOOST_TEST(master.read(0x04) == 0xF0u);
    BOOST_TEST(reports.count("/markervp/register_bank/ignored_write") == 1u);
    master.write(0x04, 0xF0);
    BOOST_TEST(reports.count("/markervp/register_bank/ignored_write") == 1u, "it is there");

    master.write(0x08, 0x12345678);
    BOOST_TEST(master.read(0x08) == 0u);
    BOOST_TEST(bank[0x08].value() == 0x12345678u);

    master.write(0x10, 0xFFFFFFF5);
    BOOST_TEST(master.read(0x10) == 0xFAu, "ones clear within the writable bits");

    master.write(0x18, 0xFFFFFFF5);
    master.write(0x18, 0x00000002);
    BOOST_TEST(master.read(0x18) == 0x17u, "ones set within the writable bits, zeros keep");

    master.write(0x14, 0x7);
    BOOST_TEST(master.read(0x14) == 0x3u);
    master.write(0x14, 0x1);
    BOOST_TEST(master.read(0x14) == 0x2u, "ones toggle");
  });
  bank.reset();
  for (const vp::Register& r : bank.registers()) BOOST_TEST(r.value() == r.info().reset);
}

BOOST_FIXTURE_TEST_CASE(what_a_register_did_is_over_when_it_is_removed, Bench) {
  unsigned effects = 0;
  vp::Register& control = bank[0x00];
  control.computed_by([] { return 77u; });
  control.after_read([&](std::uint32_t) { ++effects; });
  control.after_write([&](std::uint32_t) { ++effects; });
  control.stable_until([] { return vp::Clock::never; });
  control.remove();
  master.simulate([&] {
    BOOST_TEST(master.read(0x00) == 0u);
    master.write(0x00, 0xFF);
    BOOST_TEST(master.response() == tlm::TLM_OK_RESPONSE);
    std::uint32_t word = 0xFF;
    BOOST_TEST(master.debug(tlm::TLM_WRITE_COMMAND, 0x00, &word, 4) == 4u);
  });
  bank.reset();
  BOOST_TEST(control.value() == 0u);
  BOOST_TEST(effects == 0u);
  BOOST_TEST(control.use().reads == 1u, "but it is counted");
  BOOST_TEST(control.use().writes == 1u);
}

BOOST_FIXTURE_TEST_CASE(strict_bank_refuses_odd_accesses, Bench) {
  master.simulate([&] {
    master.read(hole);
    BOOST_TEST(master.response() == tlm::TLM_ADDRESS_ERROR_RESPONSE);
    master.read(0x02);
    BOOST_TEST(master.response() == tlm::TLM_BURST_ERROR_RESPONSE, "unaligned");

    std::uint64_t two_words = 0;
    master.prepare(tlm::TLM_WRITE_COMMAND, 0x00, &two_words, 8);
    master.send();
    BOOST_TEST(master.response() == tlm::TLM_BURST_ERROR_RESPONSE, "64 bits");
    master.prepare(tlm::TLM_WRITE_COMMAND, 0x00, &two_words, 2);
    master.send();
    BOOST_TEST(master.response() == tlm::TLM_BURST_ERROR_RESPONSE, "16 bits");
    master.prepare(tlm::TLM_READ_COMMAND, 0x00, &two_words, 4);
    master.payload.set_streaming_width(2);
    master.send();
    BOOST_TEST(master.response() == tlm::TLM_BURST_ERROR_RESPONSE, "streaming width");
    master.prepare(tlm::TLM_IGNORE_COMMAND, 0x00, &two_words, 4);
    master.send();
    BOOST_TEST(master.response() == tlm::TLM_COMMAND_ERROR_RESPONSE);

    unsigned char enables[4] = {TLM_BYTE_ENABLED, TLM_BYTE_DISABLED, TLM_BYTE_ENABLED,
                                TLM_BYTE_ENABLED};
    master.prepare(tlm::TLM_WRITE_COMMAND, 0x00, &two_words, 4);
    master.payload.set_byte_enable_ptr(enables);
    master.payload.set_byte_enable_length(4);
    master.send();
    BOOST_TEST(master.response() == tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE);
    enables[1] = TLM_BYTE_ENABLED;
    master.payload.set_response_status(tlm::TLM_INCOMPLETE_RESPONSE);
    master.send();
    BOOST_TEST(master.response() == tlm::TLM_OK_RESPONSE, "all bytes enabled is a plain access");
  });
  BOOST_TEST(bank[0x00].use().writes == 1u, "refused accesses are not counted");
}

BOOST_FIXTURE_TEST_CASE(lenient_bank_acknowledges_holes_and_ignores_strobes, LenientBench) {
  master.simulate([&] {
    master.write(hole, 0x1234);
    BOOST_TEST(master.response() == tlm::TLM_OK_RESPONSE);
    BOOST_TEST(reports.count("/markervp/register_bank/no_register") == 1u);
    BOOST_TEST(master.read(hole) == 0u);
    BOOST_TEST(reports.count("/markervp/register_bank/no_register") == 2u);

    std::uint32_t word = 0x000000AA;
    unsigned char enables[1] = {TLM_BYTE_DISABLED};
    master.prepare(tlm::TLM_WRITE_COMMAND, 0x00, &word, 4);
    master.payload.set_byte_enable_ptr(enables);
    master.payload.set_byte_enable_length(1);
    master.send();
    BOOST_TEST(master.response() == tlm::TLM_OK_RESPONSE);
    BOOST_TEST(master.read(0x00) == 0xAAu);
    BOOST_TEST(master.read(0x40) == 0xAAu, "registers repeat above the decoded address bits");
  });
}

BOOST_FIXTURE_TEST_CASE(handlers_run_after_the_policy, Bench) {
  std::vector<std::uint32_t> seen;
  bank[0x00].after_write([&](std::uint32_t word) {
    seen.push_back(word);
    seen.push_back(bank[0x00]);
  });
  std::uint32_t count = 7;
  bank[0x04].computed_by([&] { return count; });
  bank[0x04].after_read([&](std::uint32_t word) { count = word + 1; });
  master.simulate([&] {
    master.write(0x00, 0x1FF);
    BOOST_TEST(seen == (std::vector<std::uint32_t>{0x1FF, 0xFF}), boost::test_tools::per_element());
    BOOST_TEST(master.read(0x04) == 7u);
    BOOST_TEST(master.read(0x04) == 8u, "reading has an effect");
    std::uint32_t word = 0;
    BOOST_TEST(master.debug(tlm::TLM_READ_COMMAND, 0x04, &word, 4) == 4u);
    BOOST_TEST(word == 9u);
    BOOST_TEST(master.read(0x04) == 9u, "a debug read has none");
  });
}

BOOST_FIXTURE_TEST_CASE(debug_access_is_free_and_bytewise, Bench) {
  unsigned char bytes[64] = {};
  unsigned handled = 0;
  bank[0x00].after_write([&](std::uint32_t) { ++handled; });
  master.simulate([&] {
    BOOST_TEST(master.debug(tlm::TLM_READ_COMMAND, 0x00, bytes, 12) == 12u);
    BOOST_TEST(bytes[0] == 0x05);
    BOOST_TEST(bytes[4] == 0xF0);
    BOOST_TEST(master.debug(tlm::TLM_READ_COMMAND, 0x00, bytes, 64) == 12u, "up to the hole");
    BOOST_TEST(master.debug(tlm::TLM_READ_COMMAND, hole, bytes, 4) == 0u);
    unsigned char byte = 0x42;
    BOOST_TEST(master.debug(tlm::TLM_WRITE_COMMAND, 0x05, &byte, 1) == 1u);
    BOOST_TEST(bank[0x04].value() == 0x42F0u);
    BOOST_TEST(sc_core::sc_time_stamp() == sc_core::SC_ZERO_TIME);
  });
  BOOST_TEST(handled == 0u);
  BOOST_TEST(bank[0x00].use().reads == 0u);
}

BOOST_FIXTURE_TEST_CASE(use_is_recorded_per_bit, Bench) {
  master.simulate([&] {
    master.write(0x00, 0x0F);
    master.write(0x00, 0xF0);
    master.read(0x00);
  });
  const vp::Register::Use& use = bank[0x00].use();
  BOOST_TEST(use.writes == 2u);
  BOOST_TEST(use.reads == 1u);
  BOOST_TEST(use.written_ones == 0xFFu);
  BOOST_TEST(use.written_zeros == 0xFFFFFFFFu);
  BOOST_TEST(use.read_ones == 0xF0u);
  BOOST_TEST(use.read_zeros == 0xFFFFFF0Fu);
  BOOST_TEST(bank[0x04].use().reads == 0u);
}

BOOST_FIXTURE_TEST_CASE(annotated_delay_passes_before_the_access, Bench) {
  std::uint64_t at = 0;
  bank[0x00].after_write([&](std::uint32_t) { at = kit::now_ps(); });
  master.simulate([&] {
    master.delay = sc_core::sc_time(70, sc_core::SC_NS);
    master.write(0x00, 1);
    BOOST_TEST(at == 70'000u);
    BOOST_TEST(kit::now_ps() == 70'000u, "the bank itself takes no time");
  });
}

namespace {

struct CyclesModule : vp::Clocked {
  using Clocked::Clocked;
  std::uint32_t edges = 0;
  void edge() override { ++edges; }
};

}  // namespace

BOOST_FIXTURE_TEST_CASE(access_sees_all_edges_up_to_its_time, Bench) {
  CyclesModule counter("counter", clock);
  bank[0x04].computed_by([&] { return counter.edges; });
  master.simulate([&] {
    kit::BusMaster::wait_until(50'000);
    BOOST_TEST(master.read(0x04) == 5u, "the edge at the access's own time included");
    kit::BusMaster::wait_until(59'999);
    BOOST_TEST(master.read(0x04) == 5u);
    kit::BusMaster::wait_until(60'000);
    BOOST_TEST(master.read(0x04) == 6u);
  });
}

BOOST_FIXTURE_TEST_CASE(build_options_change_registers, Bench) {
  bank[0x00].set_writable(0x3);
  bank[0x00].set_reset_value(0x2);
  bank[0x10].remove();
  master.simulate([&] {
    BOOST_TEST(master.read(0x00) == 0x2u);
    master.write(0x00, 0xFFFFFFFF);
    BOOST_TEST(master.read(0x00) == 0x3u);
    BOOST_TEST(master.read(0x10) == 0u);
    master.write(0x10, 0xFF);
    BOOST_TEST(master.read(0x10) == 0u);
    BOOST_TEST(reports.count("/markervp/register_bank/ignored_write") == 1u);
    BOOST_TEST(reports.count("/markervp/register_bank/no_register") == 2u);
  });
  bank.reset();
  BOOST_TEST(bank[0x00].value() == 0x2u);
  BOOST_TEST(bank[0x10].value() == 0u);
}

BOOST_FIXTURE_TEST_CASE(every_byte_must_be_enabled, Bench) {
  master.simulate([&] {
    std::uint32_t word = 0;
    for (unsigned off = 0; off < 4; ++off) {
      unsigned char enables[] = {TLM_BYTE_ENABLED, TLM_BYTE_ENABLED, TLM_BYTE_ENABLED,
                                 TLM_BYTE_ENABLED};
      enables[off] = TLM_BYTE_DISABLED;
      master.prepare(tlm::TLM_WRITE_COMMAND, 0x00, &word, 4);
      master.payload.set_byte_enable_ptr(enables);
      master.payload.set_byte_enable_length(4);
      master.send();
      BOOST_TEST(master.response() == tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE, "byte " << off);
    }
    unsigned char enabled = TLM_BYTE_ENABLED;
    for (const unsigned length : {0u, 1u}) {
      master.prepare(tlm::TLM_WRITE_COMMAND, 0x00, &word, 4);
      master.payload.set_byte_enable_ptr(&enabled);
      master.payload.set_byte_enable_length(length);
      master.send();
      BOOST_TEST(master.response() ==
                 (length == 0 ? tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE : tlm::TLM_OK_RESPONSE));
    }
  });
}

BOOST_FIXTURE_TEST_CASE(a_refused_read_leaves_the_data_alone, Bench) {
  bank.hold_in_reset(true);
  master.simulate([&] {
    std::uint32_t word = 0x1234'5678;
    master.prepare(tlm::TLM_READ_COMMAND, 0x00, &word, 4);
    master.send();
    BOOST_TEST(master.response() == tlm::TLM_GENERIC_ERROR_RESPONSE);
    BOOST_TEST(word == 0x1234'5678u);
  });
}

BOOST_FIXTURE_TEST_CASE(a_hole_answers_no_more_than_a_register_in_reset, LenientBench) {
  bank.hold_in_reset(true);
  master.simulate([&] {
    master.read(hole);
    BOOST_TEST(master.response() == tlm::TLM_GENERIC_ERROR_RESPONSE);
  });
}

BOOST_FIXTURE_TEST_CASE(access_in_reset_is_an_error, Bench) {
  master.simulate([&] {
    master.write(0x00, 0x33);
    bank.hold_in_reset(true);
    master.write(0x00, 0x44);
    BOOST_TEST(master.response() == tlm::TLM_GENERIC_ERROR_RESPONSE);
    BOOST_TEST(reports.count("/markervp/register_bank/in_reset") == 1u);
    bank.hold_in_reset(false);
    BOOST_TEST(master.read(0x00) == 0x05u);
  });
}

BOOST_AUTO_TEST_CASE(a_wrong_table_is_refused) {
  kit::Simulation simulation;
  static constexpr vp::RegisterInfo twice[] = {{"A", 0, 0, vp::Access::read_write, 0, ""},
                                               {"B", 0, 0, vp::Access::read_write, 0, ""}};
  static constexpr vp::RegisterInfo unaligned[] = {{"A", 2, 0, vp::Access::read_write, 0, ""}};
  static constexpr vp::RegisterInfo outside[] = {{"A", 0x1000, 0, vp::Access::read_write, 0, ""}};
  BOOST_CHECK_THROW(vp::RegisterBank("twice", twice), std::logic_error);
  BOOST_CHECK_THROW(vp::RegisterBank("unaligned", unaligned), std::logic_error);
  BOOST_CHECK_THROW(vp::RegisterBank("outside", outside), std::logic_error);
  vp::RegisterBank bank("bank", table);
  BOOST_CHECK_THROW(bank[hole], std::logic_error);
  BOOST_CHECK_THROW(bank[0x02], std::logic_error);
}
