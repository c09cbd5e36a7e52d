#include <axi_dma_registers.h>
#include <drivers/axi_dma.h>
#include <drivers/axi_dma_ring.h>

#include <boost/test/unit_test.hpp>

#include "fake_hal.h"

using drivers::AxiDmaRing;
using fake_hal::Access;
namespace word = axi_dma::descriptor;

namespace {

constexpr std::uint32_t base = 0x4040'0000;
constexpr std::uint32_t whole = word::Cmplt | word::StartOfFrame | word::EndOfFrame;

/// A ring of three; the core leaves its reset at once.
struct Fixture {
  Fixture() {
    fake_hal::reset();
    auto& s = fake_hal::state();
    s.on_write[base + axi_dma::S2MM_DMACR] = [this](std::uint32_t value) { dmacr = value; };
    s.on_read[base + axi_dma::S2MM_DMACR] = [this] {
      if (!stuck) dmacr &= ~axi_dma::dmacr::Reset;
      return dmacr;
    };
    descriptors = hal_dma_allocate(3 * word::alignment, word::alignment);
  }

  /// A word of a descriptor.
  std::uint32_t& at(unsigned number, std::uint32_t offset) {
    auto* const bytes = static_cast<std::uint8_t*>(descriptors.data);
    return *reinterpret_cast<std::uint32_t*>(bytes + number * word::alignment + offset);
  }
  bool start() { return ring.initialise({base, descriptors, 18}); }

  std::uint32_t dmacr = 0;
  bool stuck = false;
  hal_dma_buffer descriptors;
  AxiDmaRing ring{};
  AxiDmaRing::Packet packet{};
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(axi_dma_ring_driver, Fixture)

BOOST_AUTO_TEST_CASE(descriptors_are_linked_before_the_channel_runs) {
  BOOST_REQUIRE(start());
  for (unsigned i = 0; i < 3; ++i) {
    BOOST_TEST(at(i, word::NXTDESC) == descriptors.bus_address + (i + 1) % 3 * word::alignment);
    BOOST_TEST(at(i, word::STATUS) == 0u);
  }
  BOOST_REQUIRE(fake_hal::state().flushed.size() == 1u);
  BOOST_TEST(fake_hal::state().flushed[0].second == descriptors.size);
  const std::vector<Access> expected = {
      {true, base + axi_dma::S2MM_DMACR, axi_dma::dmacr::Reset},
      {false, base + axi_dma::S2MM_DMACR, 0},
      {true, base + axi_dma::S2MM_CURDESC, descriptors.bus_address},
      {true, base + axi_dma::S2MM_DMACR, 0x0001'5001},  // a packet an interrupt, IOC and Err, RS
  };
  BOOST_TEST((fake_hal::state().accesses == expected));
}

BOOST_AUTO_TEST_CASE(a_ring_that_cannot_be) {
  BOOST_TEST(!ring.initialise({base, {}, 18}));
  stuck = true;
  BOOST_TEST(!start());
  BOOST_TEST(fake_hal::state().accesses.size() == 1u + drivers::AxiDma::reset_polls);
}

// A descriptor is in memory before the engine hears of it.
BOOST_AUTO_TEST_CASE(a_buffer_is_given_by_one_write) {
  start();
  fake_hal::state().accesses.clear();
  fake_hal::state().flushed.clear();
  fake_hal::state().on_write[base + axi_dma::S2MM_TAILDESC] = [this](std::uint32_t) {
    BOOST_TEST(fake_hal::state().flushed.size() == 1u);
    BOOST_TEST(at(0, word::BUFFER_ADDRESS) == 0x1000'0080u);
    BOOST_TEST(at(0, word::CONTROL) == 128u);
  };
  BOOST_TEST(ring.give(0x1000'0080, 128));
  BOOST_TEST((fake_hal::state().accesses ==
              std::vector<Access>{{true, base + axi_dma::S2MM_TAILDESC, descriptors.bus_address}}));
  BOOST_TEST(fake_hal::state().flushed[0].second == word::bytes);
}

BOOST_AUTO_TEST_CASE(what_does_not_fit_is_not_given) {
  start();
  fake_hal::state().accesses.clear();
  BOOST_TEST(!ring.give(0x1000'0000, 0));
  BOOST_TEST(!ring.give(0x1000'0000, 1u << 18));
  BOOST_TEST(!ring.give(0x1000'0002, 128));
  BOOST_TEST(fake_hal::state().accesses.empty());
  for (unsigned i = 0; i < 3; ++i) BOOST_TEST(ring.give(0x1000'0000, (1u << 18) - 1));
  BOOST_TEST(!ring.give(0x1000'0000, 128));
}

BOOST_AUTO_TEST_CASE(packets_are_taken_in_order) {
  start();
  BOOST_TEST(!ring.take(packet));
  ring.give(0x1000'0000, 1024);
  ring.give(0x1000'0400, 1024);
  fake_hal::state().invalidated.clear();
  BOOST_TEST(!ring.take(packet));
  BOOST_TEST(fake_hal::state().invalidated.size() == 1u);  // looked at memory, not at a cache
  at(1, word::STATUS) = whole | 96;                        // not its turn
  BOOST_TEST(!ring.take(packet));
  at(0, word::STATUS) = whole | 48;
  BOOST_TEST(ring.take(packet));
  BOOST_TEST(packet.address == 0x1000'0000u);
  BOOST_TEST(packet.bytes == 48u);
  BOOST_TEST(packet.whole);
  BOOST_TEST(ring.take(packet));
  BOOST_TEST(packet.address == 0x1000'0400u);
  BOOST_TEST(packet.bytes == 96u);
  BOOST_TEST(!ring.take(packet));
}

// The engine meets no descriptor twice whose status says that it is complete.
BOOST_AUTO_TEST_CASE(the_ring_goes_round) {
  start();
  for (unsigned n = 0; n < 7; ++n) {
    BOOST_REQUIRE(ring.give(0x1000'0000 + n * 64, 64));
    BOOST_TEST(at(n % 3, word::STATUS) == 0u);
    BOOST_TEST(fake_hal::writes_to(base + axi_dma::S2MM_TAILDESC).back() ==
               descriptors.bus_address + n % 3 * word::alignment);
    at(n % 3, word::STATUS) = whole | 64;
    BOOST_REQUIRE(ring.take(packet));
    BOOST_TEST(packet.address == 0x1000'0000 + n * 64);
  }
}

BOOST_AUTO_TEST_CASE(a_packet_cut_or_in_error_is_not_whole) {
  start();
  for (const std::uint32_t status :
       {word::Cmplt | word::StartOfFrame, word::Cmplt | word::EndOfFrame, whole | word::DMAIntErr,
        whole | word::DMASlvErr, whole | word::DMADecErr}) {
    ring.give(0x1000'0000, 64);
    const unsigned last = static_cast<unsigned>(
        (fake_hal::writes_to(base + axi_dma::S2MM_TAILDESC).back() - descriptors.bus_address) /
        word::alignment);
    at(last, word::STATUS) = status | 64;
    BOOST_TEST(ring.take(packet));
    BOOST_TEST(!packet.whole);
  }
}

BOOST_AUTO_TEST_CASE(acknowledge_clears_what_it_saw) {
  start();
  fake_hal::state().registers[base + axi_dma::S2MM_DMASR] =
      axi_dma::dmasr::SGIncld | axi_dma::dmasr::IOC_Irq;
  BOOST_TEST(ring.acknowledge() == (axi_dma::dmasr::SGIncld | axi_dma::dmasr::IOC_Irq));
  BOOST_TEST(fake_hal::writes_to(base + axi_dma::S2MM_DMASR).back() == axi_dma::dmasr::IOC_Irq);
}

BOOST_AUTO_TEST_SUITE_END()
