// Counts of block memories, against the aspect ratios of UG473.
#include <xilinx/bram/bram.h>

#include <boost/test/unit_test.hpp>

using xilinx::block_ram_36;

BOOST_AUTO_TEST_SUITE(block_ram)

BOOST_AUTO_TEST_CASE(each_aspect_ratio_is_one_block) {
  for (const auto& [depth, width] :
       {std::pair{32768, 1}, {16384, 2}, {8192, 4}, {4096, 9}, {2048, 18}, {1024, 36}, {512, 72}}) {
    BOOST_TEST(block_ram_36(static_cast<std::uint64_t>(depth), static_cast<std::uint32_t>(width)) ==
               1.0);
    BOOST_TEST(block_ram_36(static_cast<std::uint64_t>(depth) + 1,
                            static_cast<std::uint32_t>(width)) > 1.0);
  }
}

BOOST_AUTO_TEST_CASE(half_a_block_is_one_of_18_kbit) {
  BOOST_TEST(block_ram_36(1024, 8) == 0.5);  // a line FIFO of the corner detection
  BOOST_TEST(block_ram_36(2048, 9) == 0.5);
  BOOST_TEST(block_ram_36(2049, 9) == 1.0);
  BOOST_TEST(block_ram_36(1, 1) == 0.5);
}

// 640 × 480 bytes are 2 457 600 bits: exactly 75 blocks of 32 768 bits without parity.
BOOST_AUTO_TEST_CASE(the_frame_store) {
  BOOST_TEST(block_ram_36(76'800, 32, false) == 75.0);
  BOOST_TEST(block_ram_36(320 * 240 / 4, 32, false) == 19.0);
  BOOST_TEST(block_ram_36(1024 * 512 / 4, 32, false) == 128.0);
}

BOOST_AUTO_TEST_CASE(parity_bits_hold_data_if_both_ports_can) {
  BOOST_TEST(block_ram_36(1024, 36, true) == 1.0);
  BOOST_TEST(block_ram_36(1024, 36, false) == 1.5);
}

BOOST_AUTO_TEST_SUITE_END()
