#include <ps/memory/memory.h>
#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(dma_allocator)

BOOST_AUTO_TEST_CASE(buffers_share_no_cache_line) {
  ps::DmaAllocator memory(0x1000, 0x2000);
  BOOST_TEST(*memory.allocate(1, 1) == 0x1000u);
  BOOST_TEST(*memory.allocate(32, 1) == 0x1020u);
  BOOST_TEST(*memory.allocate(0, 1) == 0x1040u);
  BOOST_TEST(*memory.allocate(1, 1) == 0x1060u);
  BOOST_TEST(memory.used() == 0x80u);
}

BOOST_AUTO_TEST_CASE(alignment) {
  ps::DmaAllocator memory(0x1000, 0x10000);
  BOOST_TEST(*memory.allocate(4, 4) == 0x1000u);
  BOOST_TEST(*memory.allocate(4, 0x1000) == 0x2000u);
  BOOST_TEST(!memory.allocate(4, 0));
  BOOST_TEST(!memory.allocate(4, 48));
  BOOST_TEST(!memory.allocate(4, std::size_t{1} << 63));
}

BOOST_AUTO_TEST_CASE(the_buffer_at_an_address) {
  ps::DmaAllocator memory(0x1000, 0x2000);
  BOOST_TEST(!memory.buffer_at(0x1000));
  memory.allocate(33, 1);
  memory.allocate(4, 1);
  BOOST_TEST(!memory.buffer_at(0xFFF));
  BOOST_TEST(memory.buffer_at(0x1000)->end == 0x1021u);
  BOOST_TEST(memory.buffer_at(0x1020)->first == 0x1000u);
  BOOST_TEST(!memory.buffer_at(0x1021));
  BOOST_TEST(memory.buffer_at(0x1043)->first == 0x1040u);
  BOOST_TEST(!memory.buffer_at(0x1044));
  memory.reset();
  BOOST_TEST(!memory.buffer_at(0x1000));
}

BOOST_AUTO_TEST_CASE(exhaustion_and_reset) {
  ps::DmaAllocator memory(0x1000, 0x1100);
  BOOST_TEST(!memory.allocate(0x101, 4));
  BOOST_TEST(!memory.allocate(~std::size_t{0}, 4));
  BOOST_TEST(*memory.allocate(0x100, 4) == 0x1000u);
  BOOST_TEST(!memory.allocate(1, 4));
  memory.reset();
  BOOST_TEST(*memory.allocate(1, 4) == 0x1000u);
}

BOOST_AUTO_TEST_SUITE_END()
