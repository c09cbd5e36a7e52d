// The vendor's cells in RTL (models/xilinx/cells).
#include <axi/rtl_part.h>
#include <simulation.h>
#include <vp/clock.h>
#include <boost/test/unit_test.hpp>

#include <cstdint>
#include <string>

namespace {

/// A bit for each group of cells that differed from what it should do, in 1000 clocks.
template <class T>
T wrong_in(const std::string& file) {
  kit::Simulation simulation;
  vp::ClockScheduler scheduler("scheduler");
  vp::Clock clock("clock", scheduler, 100'000'000);
  axi::RtlPart part("part", file, {{"clk", &clock}});
  auto& wrong = part.output<T>("wrong");
  auto& compared = part.output<std::uint16_t>("compared");
  sc_core::sc_start(sc_core::sc_time(10, sc_core::SC_US));
  BOOST_TEST(compared.get() >= 990);
  return wrong.get();
}

}  // namespace

BOOST_AUTO_TEST_SUITE(rtl_cells)

BOOST_AUTO_TEST_CASE(they_do_what_the_vendor_says) {
  BOOST_TEST(wrong_in<std::uint16_t>(MARKERVP_CELLS_RTL) == 0u);
}

BOOST_AUTO_TEST_CASE(a_cell_that_differs_is_seen) {
  constexpr std::uint16_t flip_flops = 1 << 1;
  BOOST_TEST(wrong_in<std::uint16_t>(MARKERVP_BROKEN_CELLS_RTL) == flip_flops);
}

#ifdef MARKERVP_PRIMITIVES_RTL
BOOST_AUTO_TEST_CASE(those_of_vhdl_do_what_the_vendor_says) {
  BOOST_TEST(wrong_in<std::uint8_t>(MARKERVP_PRIMITIVES_RTL) == 0u);
  BOOST_TEST(wrong_in<std::uint8_t>(MARKERVP_BROKEN_PRIMITIVES_RTL) == 1u, "the FDRE alone");
}
#endif

BOOST_AUTO_TEST_SUITE_END()
