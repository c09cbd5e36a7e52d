// What GHDL makes of VHDL, put right: choices, names and constants.
#include <boost/test/unit_test.hpp>

#include <bus_master.h>
#include <memory_target.h>
#include <simulation.h>

#include <cstdint>
#include <string>
#include <vector>

#include <axi/rtl_part.h>
#include <vp/clock_scheduler.h>

BOOST_FIXTURE_TEST_CASE(vhdl_keeps_its_defaults_and_its_names, kit::Simulation) {
  vp::ClockScheduler scheduler("scheduler");
  vp::Clock clock("clock", scheduler, 100'000'000);
  kit::BusMaster script("script");
  kit::MemoryTarget nothing("nothing", 4);
  script.socket.bind(nothing.socket);
  vp::Signal<bool> go("go");
  vp::Signal<std::uint8_t> sel("sel"), reg("reg");
  axi::RtlPart part("part", MARKERVP_CHOICE_RTL, {{"clk", &clock}});
  part.input("go", go);
  part.input("sel", sel);
  part.input("reg", reg);
  auto& output = part.output<std::uint8_t>("output");
  auto& pulse = part.output<bool>("pulse");
  std::string pulses;
  script.simulate([&] {
    script.wait_until(15'000);
    reg = 0xC;
    for (const unsigned choice : {0u, 1u, 2u, 7u, 0u}) {
      sel = static_cast<std::uint8_t>(choice);
      BOOST_TEST(output == (choice == 0 ? 0xA : choice == 1 ? 0x5 : 0xC));
    }
    go = true;  // a pulse on every third clock: the machine returns to its first state
    for (unsigned i = 0; i < 9; ++i) {
      sc_core::wait(10, sc_core::SC_NS);
      pulses += pulse ? '1' : '0';
    }
  });
  BOOST_TEST(pulses == "010010010");
}

BOOST_FIXTURE_TEST_CASE(vhdl_keeps_its_wide_constants, kit::Simulation) {
  vp::ClockScheduler scheduler("scheduler");
  vp::Clock clock("clock", scheduler, 100'000'000);
  kit::BusMaster script("script");
  kit::MemoryTarget nothing("nothing", 4);
  script.socket.bind(nothing.socket);
  vp::Signal<std::uint8_t> choose("choose");
  vp::Signal<std::uint32_t> value("value");
  axi::RtlPart part("part", MARKERVP_WIDE_RTL, {{"clk", &clock}});
  part.input("choose", choose);
  part.input("value", value);
  auto& sum = part.output<std::uint64_t>("sum");
  auto& chosen = part.output<std::uint64_t>("chosen");
  auto& count = part.output<std::uint64_t>("count");
  auto& same = part.output<bool>("same");
  auto& settings = part.output<std::uint64_t>("settings");
  const std::vector<std::uint64_t> choices{
      0x0123'4567'89AB'CDEF, 0x7'0000'0000,         0x8000'0000'0000'0000, 0,
      ~std::uint64_t{0},     0xFFFF'FFFF'FFFF'0001, 0x5'0000'0000,         0x5'0000'0000};
  script.simulate([&] {
    script.wait_until(15'000);
    BOOST_TEST(settings == 0x1A'1000'0002);  // of generics that are no numbers
    BOOST_TEST(sum == 0x8000'0000'0000'0001);
    BOOST_TEST(!same);
    value = 0xFFFF'0001;
    BOOST_TEST(sum == 0x8000'0000'FFFF'0002);
    BOOST_TEST(same);
    for (std::size_t i = 0; i < choices.size(); ++i) {
      choose = static_cast<std::uint8_t>(i);
      BOOST_TEST(chosen == choices[i]);
    }
    const std::uint64_t before = count;
    sc_core::wait(20, sc_core::SC_NS);
    constexpr std::uint64_t bits = 0xFFFF'FFFF'FFFF, start = 0xFFFF'FFFF'FFF0, step = 0x1'0000'0001;
    BOOST_TEST(count == ((before + 2 * step) & bits));
    BOOST_TEST(((before - start) & bits) % step == 0u);
  });
}

BOOST_FIXTURE_TEST_CASE(vhdl_keeps_constants_whose_lower_words_are_0, kit::Simulation) {
  vp::ClockScheduler scheduler("scheduler");
  vp::Clock clock("clock", scheduler, 100'000'000);
  kit::BusMaster script("script");
  kit::MemoryTarget nothing("nothing", 4);
  script.socket.bind(nothing.socket);
  vp::Signal<std::uint8_t> choose("choose");
  vp::Signal<std::uint64_t> value("value");
  axi::RtlPart part("part", MARKERVP_CONSTANTS_RTL, {{"clk", &clock}});
  part.input("choose", choose);
  part.input("value", value);
  auto& chosen = part.output<std::uint64_t>("chosen");
  auto& same = part.output<bool>("same");
  auto& kept = part.output<std::uint64_t>("kept");
  const std::vector<std::uint64_t> choices{
      0x8000'0100'0000'0000, 0xFFFF'FFFF'0000'0000, 0, 0x4000'0000'0000'0000,
      0x1000'0000'0000'0000, 0x4000'0000'0000'0000, 0};
  script.simulate([&] {
    script.wait_until(15'000);
    for (std::size_t i = 0; i < choices.size(); ++i) {
      choose = static_cast<std::uint8_t>(i);
      BOOST_TEST(chosen == choices[i]);
    }
    BOOST_TEST(!same);
    value = choices[0];
    BOOST_TEST(same);
    BOOST_TEST(kept == 0x2000'0000'0000'0000);
    choose = std::uint8_t{7};
    BOOST_TEST(chosen == (0xFFFF'FFFF'0000'0000 ^ choices[0]));
    sc_core::wait(20, sc_core::SC_NS);
    BOOST_TEST(kept == 0);
  });
}
