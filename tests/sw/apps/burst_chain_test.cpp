#include <apps/hybrid/burst_chain.h>
#include <axi_dma_registers.h>

#include <boost/test/unit_test.hpp>

#include "fake_hal.h"

namespace {

constexpr std::uint32_t base = 0x4041'0000;
constexpr std::uint32_t burst = 64;  // bytes

struct Fixture {
  Fixture() {
    fake_hal::reset();
    auto& s = fake_hal::state();
    s.on_read[base + axi_dma::S2MM_DMACR] = [] { return 0x5000u; };
    status(axi_dma::dmasr::Halted);
    chain.initialise({base, drivers::AxiDmaConfig::Channel::stream_to_memory}, burst);
  }
  void status(std::uint32_t value) {
    fake_hal::state().on_read[base + axi_dma::S2MM_DMASR] = [value] { return value; };
  }
  std::vector<std::uint32_t> addresses() { return fake_hal::writes_to(base + axi_dma::S2MM_DA); }

  hybrid::BurstChain chain{};
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(burst_chain, Fixture)

BOOST_AUTO_TEST_CASE(each_interrupt_starts_the_next_burst) {
  chain.start(0x1000'0000, 3 * burst);
  status(0x1002);
  for (int i = 0; i < 2; ++i) {
    BOOST_TEST(!chain.is_over());
    hybrid::BurstChain::on_interrupt(&chain);
  }
  BOOST_TEST(!chain.is_over());
  hybrid::BurstChain::on_interrupt(&chain);
  BOOST_TEST(chain.is_over());
  BOOST_TEST(!chain.failed());
  BOOST_TEST(chain.done() == 3u);
  BOOST_TEST((addresses() == std::vector<std::uint32_t>{0x1000'0000, 0x1000'0040, 0x1000'0080}));
}

BOOST_AUTO_TEST_CASE(last_interrupt_waits_until_it_is_released) {
  auto& control = fake_hal::state();
  std::uint32_t dmacr = 0x5000;
  control.on_read[0x4041'0000 + axi_dma::S2MM_DMACR] = [&] { return dmacr; };
  control.on_write[0x4041'0000 + axi_dma::S2MM_DMACR] = [&](std::uint32_t value) { dmacr = value; };
  chain.start(0x1000'0000, 2 * burst, hybrid::BurstChain::LastInterrupt::waits);
  BOOST_TEST(dmacr == 0x5001u);
  status(0x1002);
  hybrid::BurstChain::on_interrupt(&chain);
  BOOST_TEST(dmacr == 0x4001u);
  chain.release_last();
  BOOST_TEST(dmacr == 0x5001u);
}

BOOST_AUTO_TEST_CASE(last_interrupt_released_early_is_not_held_back_later) {
  auto& control = fake_hal::state();
  std::uint32_t dmacr = 0x5000;
  control.on_read[0x4041'0000 + axi_dma::S2MM_DMACR] = [&] { return dmacr; };
  control.on_write[0x4041'0000 + axi_dma::S2MM_DMACR] = [&](std::uint32_t value) { dmacr = value; };
  chain.start(0x1000'0000, 2 * burst, hybrid::BurstChain::LastInterrupt::waits);
  chain.release_last();
  status(0x1002);
  hybrid::BurstChain::on_interrupt(&chain);
  BOOST_TEST(dmacr == 0x5001u);
}

BOOST_AUTO_TEST_CASE(interrupt_without_cause_changes_nothing) {
  chain.start(0x1000'0000, 2 * burst);
  status(0);
  hybrid::BurstChain::on_interrupt(&chain);
  BOOST_TEST(chain.done() == 0u);
  BOOST_TEST(addresses().size() == 1u);
}

BOOST_AUTO_TEST_CASE(interrupt_after_the_end_changes_nothing) {
  chain.start(0x1000'0000, 1 * burst);
  status(0x1002);
  hybrid::BurstChain::on_interrupt(&chain);
  hybrid::BurstChain::on_interrupt(&chain);
  BOOST_TEST(chain.done() == 1u);
  BOOST_TEST(addresses().size() == 1u);
}

BOOST_AUTO_TEST_CASE(error_ends_the_chain) {
  chain.start(0x1000'0000, 3 * burst);
  status(0x5011);
  hybrid::BurstChain::on_interrupt(&chain);
  BOOST_TEST(chain.is_over());
  BOOST_TEST(chain.failed());
  BOOST_TEST(chain.status() == 0x5011u);
  BOOST_TEST(addresses().size() == 1u);
}

BOOST_AUTO_TEST_CASE(busy_engine_fails_the_chain) {
  status(0);
  chain.start(0x1000'0000, 3 * burst);
  BOOST_TEST(chain.failed());
  BOOST_TEST(addresses().empty());
}

BOOST_AUTO_TEST_SUITE_END()
