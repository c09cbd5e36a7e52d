#include <axi_dma_registers.h>
#include <drivers/axi_dma.h>

#include <boost/test/unit_test.hpp>

#include "fake_hal.h"

using drivers::AxiDma;
using drivers::AxiDmaConfig;
using fake_hal::Access;
using Channel = drivers::AxiDmaConfig::Channel;

namespace {

constexpr std::uint32_t base = 0x4040'0000;

/// The registers of one channel; the soft reset reads back as set `reset_reads` times.
struct Fixture {
  Fixture() {
    fake_hal::reset();
    auto& s = fake_hal::state();
    for (const std::uint32_t control : {axi_dma::MM2S_DMACR, axi_dma::S2MM_DMACR}) {
      s.on_write[base + control] = [this](std::uint32_t value) { dmacr = value; };
      s.on_read[base + control] = [this] {
        if (reset_reads == 0) dmacr &= ~axi_dma::dmacr::Reset;
        if (reset_reads > 0) --reset_reads;
        return dmacr;
      };
    }
    s.registers[base + axi_dma::MM2S_DMASR] = axi_dma::dmasr::Halted;
    s.registers[base + axi_dma::S2MM_DMASR] = axi_dma::dmasr::Halted;
  }

  std::uint32_t dmacr = 0;
  unsigned reset_reads = 3;
  AxiDma dma{};
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(axi_dma_driver, Fixture)

BOOST_AUTO_TEST_CASE(initialise_resets_and_enables_interrupts) {
  BOOST_TEST(dma.initialise({base, Channel::memory_to_stream}));
  const auto writes = fake_hal::writes_to(base + axi_dma::MM2S_DMACR);
  BOOST_REQUIRE(writes.size() == 2u);
  BOOST_TEST(writes[0] == 0x4u);
  BOOST_TEST(writes[1] == 0x5000u);  // IOC and Err
}

BOOST_AUTO_TEST_CASE(reset_that_never_ends_is_reported) {
  reset_reads = 100'000;
  BOOST_TEST(!dma.initialise({base, Channel::stream_to_memory}));
  BOOST_TEST(fake_hal::state().accesses.size() == 1u + AxiDma::reset_polls);
}

BOOST_AUTO_TEST_CASE(start_writes_length_last) {
  dma.initialise({base, Channel::stream_to_memory});
  fake_hal::state().accesses.clear();
  BOOST_TEST(dma.start(0x1000'0080, 128));
  const std::vector<Access> expected = {
      {false, base + axi_dma::S2MM_DMASR, 1},      {true, base + axi_dma::S2MM_DA, 0x1000'0080},
      {false, base + axi_dma::S2MM_DMACR, 0x5000}, {true, base + axi_dma::S2MM_DMACR, 0x5001},
      {true, base + axi_dma::S2MM_LENGTH, 128},
  };
  BOOST_TEST((fake_hal::state().accesses == expected));
}

BOOST_AUTO_TEST_CASE(start_again_writes_address_and_length_only) {
  dma.initialise({base, Channel::stream_to_memory});
  fake_hal::state().accesses.clear();
  BOOST_TEST(dma.start_again(0x1000'0080, 128));
  const std::vector<Access> expected = {{true, base + axi_dma::S2MM_DA, 0x1000'0080},
                                        {true, base + axi_dma::S2MM_LENGTH, 128}};
  BOOST_TEST((fake_hal::state().accesses == expected));
  BOOST_TEST(!dma.start_again(0x1000'0082, 128));
  BOOST_TEST(!dma.start_again(0x1000'0080, 0));
}

BOOST_AUTO_TEST_CASE(start_uses_the_source_address_of_the_other_channel) {
  dma.initialise({base, Channel::memory_to_stream});
  dma.start(0x1000'0000, 128);
  BOOST_TEST(fake_hal::writes_to(base + axi_dma::MM2S_SA).at(0) == 0x1000'0000u);
  BOOST_TEST(fake_hal::writes_to(base + axi_dma::MM2S_LENGTH).at(0) == 128u);
}

BOOST_AUTO_TEST_CASE(busy_channel_is_left_alone) {
  dma.initialise({base, Channel::memory_to_stream});
  fake_hal::state().registers[base + axi_dma::MM2S_DMASR] = 0;  // neither halted nor idle
  BOOST_TEST(!dma.start(0x1000'0000, 128));
  BOOST_TEST(fake_hal::writes_to(base + axi_dma::MM2S_LENGTH).empty());
}

BOOST_AUTO_TEST_CASE(idle_channel_starts) {
  dma.initialise({base, Channel::memory_to_stream});
  fake_hal::state().registers[base + axi_dma::MM2S_DMASR] = axi_dma::dmasr::Idle;
  BOOST_TEST(dma.start(0x1000'0000, 128));
}

BOOST_AUTO_TEST_CASE(length_and_address_must_fit_the_build) {
  dma.initialise({base, Channel::memory_to_stream});
  BOOST_TEST(!dma.start(0x1000'0000, 0));
  BOOST_TEST(!dma.start(0x1000'0000, 16384));
  BOOST_TEST(!dma.start(0x1000'0002, 128));
  BOOST_TEST(fake_hal::writes_to(base + axi_dma::MM2S_LENGTH).empty());
  BOOST_TEST(dma.start(0x1000'0000, 16383));
}

BOOST_AUTO_TEST_CASE(acknowledge_clears_what_it_saw_and_only_interrupts) {
  dma.initialise({base, Channel::memory_to_stream});
  fake_hal::state().registers[base + axi_dma::MM2S_DMASR] = 0x1002;
  const std::uint32_t status = dma.acknowledge();
  BOOST_TEST(AxiDma::is_complete(status));
  BOOST_TEST(!AxiDma::is_error(status));
  BOOST_TEST(fake_hal::writes_to(base + axi_dma::MM2S_DMASR).at(0) == 0x1000u);
}

BOOST_AUTO_TEST_CASE(every_error_bit_is_an_error) {
  for (const std::uint32_t bit : {0x10u, 0x20u, 0x40u, 0x4000u}) BOOST_TEST(AxiDma::is_error(bit));
  BOOST_TEST(!AxiDma::is_error(0x3003u));
}

BOOST_AUTO_TEST_SUITE_END()
