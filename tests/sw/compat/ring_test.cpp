// Rings of descriptors of XAxiDma, in memory that has bus addresses.
#include <boost/test/unit_test.hpp>

#include <sys/mman.h>

#include <axi_dma_registers.h>
#include <xaxidma.h>
#include <xgpio.h>

#include "fake_hal.h"

namespace {

using fake_hal::state;
using fake_hal::writes_to;
using Words = std::vector<std::uint32_t>;
using namespace axi_dma;

constexpr std::uint32_t base = XPAR_AXI_DMA_0_BASEADDR;
constexpr u32 eof = XAXIDMA_BD_CTRL_TXEOF_MASK, sof = XAXIDMA_BD_CTRL_TXSOF_MASK;

/// An engine with both channels and scatter-gather whose registers run and halt at once.
struct Ring {
  Ring() {
    fake_hal::reset();
    state().xparameters["AXI_DMA_0_INCLUDE_S2MM"] = 1;
    state().xparameters["AXI_DMA_0_INCLUDE_SG"] = 1;
    for (const std::uint32_t channel : {MM2S_DMACR, S2MM_DMACR}) {
      const std::uint32_t control = base + channel, status = control + MM2S_DMASR;
      state().registers[status] = dmasr::Halted;
      state().on_write[control] = [control, status](std::uint32_t word) {
        state().registers[control] = word & ~dmacr::Reset;
        state().registers[status] = (word & dmacr::RS) != 0 ? 0 : dmasr::Halted;
      };
    }
    XAxiDma_Config config{};
    config = *XAxiDma_LookupConfig(0);
    config.HasMm2S = config.HasS2Mm = config.HasSg = 1;
    BOOST_REQUIRE_EQUAL(XAxiDma_CfgInitialize(&dma, &config), XST_SUCCESS);
    memory = mmap(nullptr, 0x1000, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_32BIT,
                  -1, 0);
    BOOST_REQUIRE(memory != MAP_FAILED);
  }
  ~Ring() { munmap(memory, 0x1000); }

  UINTPTR space() const { return reinterpret_cast<UINTPTR>(memory); }
  void create(XAxiDma_BdRing* ring, int count) {
    BOOST_REQUIRE_EQUAL(XAxiDma_BdRingCreate(ring, space(), space(), 64, count), XST_SUCCESS);
    BOOST_REQUIRE_EQUAL(XAxiDma_BdRingCheck(ring), XST_SUCCESS);
  }
  XAxiDma_Bd* allocate(XAxiDma_BdRing* ring, int count) {
    XAxiDma_Bd* first = nullptr;
    BOOST_REQUIRE_EQUAL(XAxiDma_BdRingAlloc(ring, count, &first), XST_SUCCESS);
    XAxiDma_Bd* bd = first;
    for (int i = 0; i < count; ++i, bd = XAxiDma_BdRingNext(ring, bd)) {
      XAxiDma_BdSetBufAddr(bd, 0x10000000);
      XAxiDma_BdSetLength(bd, 64, ring->MaxTransferLen);
      XAxiDma_BdSetCtrl(bd, i == 0 ? sof : 0);
      if (i + 1 == count) XAxiDma_BdSetCtrl(bd, XAxiDma_BdGetCtrl(bd) | eof);
    }
    return first;
  }
  static void complete(XAxiDma_Bd* bd, u32 frame = 0) {
    XAxiDma_BdWrite(bd, XAXIDMA_BD_STS_OFFSET, XAXIDMA_BD_STS_COMPLETE_MASK | frame | 64);
  }

  XAxiDma dma;
  XAxiDma_BdRing* tx = XAxiDma_GetTxRing(&dma);
  XAxiDma_BdRing* rx = XAxiDma_GetRxRing(&dma);
  void* memory;
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(rings, Ring)

BOOST_AUTO_TEST_CASE(space_that_is_none) {
  BOOST_CHECK_EQUAL(XAxiDma_BdRingCreate(tx, space(), space(), 32, 4), XST_INVALID_PARAM);
  BOOST_CHECK_EQUAL(XAxiDma_BdRingCreate(tx, space(), space(), 96, 4), XST_INVALID_PARAM);
  BOOST_CHECK_EQUAL(XAxiDma_BdRingCreate(tx, space() + 4, space() + 4, 64, 4), XST_INVALID_PARAM);
  BOOST_CHECK_EQUAL(XAxiDma_BdRingCreate(tx, space(), space(), 64, 0), XST_INVALID_PARAM);
  constexpr UINTPTR no_bus_address = UINTPTR{1} << 32;
  BOOST_CHECK_EQUAL(XAxiDma_BdRingCreate(tx, no_bus_address, no_bus_address, 64, 4),
                    XST_INVALID_PARAM);
  BOOST_CHECK_EQUAL(XAxiDma_BdRingCheck(tx), XST_DMA_SG_NO_LIST);
  BOOST_CHECK_EQUAL(XAxiDma_BdRingStart(tx), XST_DMA_SG_NO_LIST);
  XAxiDma_Bd pattern = {};
  BOOST_CHECK_EQUAL(XAxiDma_BdRingClone(tx, &pattern), XST_DMA_SG_NO_LIST);
  BOOST_CHECK_EQUAL(XAxiDma_Resume(&dma), XST_DMA_ERROR);
  BOOST_CHECK_EQUAL(XAxiDma_BdRingCntCalc(64, 0x1000), 64u);
  BOOST_CHECK_EQUAL(XAxiDma_BdRingMemCalc(128, 3), 384u);
}

BOOST_AUTO_TEST_CASE(a_packet_goes_round) {
  create(tx, 4);
  BOOST_CHECK_EQUAL(XAxiDma_BdRingStart(tx), XST_SUCCESS);
  BOOST_CHECK_EQUAL(XAxiDma_BdRingCheck(tx), XST_IS_STARTED);
  BOOST_CHECK(writes_to(base + MM2S_CURDESC) == Words{static_cast<std::uint32_t>(space())});
  BOOST_CHECK(writes_to(base + MM2S_TAILDESC).empty());
  XAxiDma_Bd* const packet = allocate(tx, 3);
  BOOST_CHECK_EQUAL(XAxiDma_BdRingGetFreeCnt(tx), 1);
  BOOST_CHECK_EQUAL(XAxiDma_BdRingToHw(tx, 3, packet), XST_SUCCESS);
  BOOST_CHECK(writes_to(base + MM2S_TAILDESC) == Words{static_cast<std::uint32_t>(space()) + 0x80});
  XAxiDma_Bd* done = nullptr;
  BOOST_CHECK_EQUAL(XAxiDma_BdRingFromHw(tx, XAXIDMA_ALL_BDS, &done), 0);
  complete(packet);
  complete(packet + 1);
  BOOST_CHECK_EQUAL(XAxiDma_BdRingFromHw(tx, XAXIDMA_ALL_BDS, &done), 0);  // whole packets only
  complete(packet + 2);
  BOOST_CHECK_EQUAL(XAxiDma_BdRingFromHw(tx, XAXIDMA_ALL_BDS, &done), 3);
  BOOST_CHECK(done == packet);
  BOOST_CHECK_EQUAL(XAxiDma_BdRingFree(tx, 1, packet + 1), XST_DMA_SG_LIST_ERROR);
  BOOST_CHECK_EQUAL(XAxiDma_BdRingFree(tx, 3, packet), XST_SUCCESS);
  BOOST_CHECK_EQUAL(XAxiDma_BdRingGetFreeCnt(tx), 4);

  // Around the end, and with the Cmplt of before.
  XAxiDma_Bd* const next = allocate(tx, 2);
  BOOST_CHECK(XAxiDma_BdRingNext(tx, next) == packet);
  BOOST_CHECK_EQUAL(XAxiDma_BdRingToHw(tx, 2, next), XST_SUCCESS);
  BOOST_CHECK(!XAxiDma_BdHwCompleted(packet));
}

BOOST_AUTO_TEST_CASE(what_cannot_be_handed_over) {
  create(tx, 4);
  XAxiDma_Bd* more = nullptr;
  BOOST_CHECK_EQUAL(XAxiDma_BdRingAlloc(tx, 5, &more), XST_FAILURE);
  BOOST_REQUIRE_EQUAL(fake_hal::state().warnings.size(), 1u);
  BOOST_TEST(fake_hal::state().warnings.front().find("no room") != std::string::npos);
  XAxiDma_Bd* const packet = allocate(tx, 2);
  BOOST_CHECK_EQUAL(XAxiDma_BdRingToHw(tx, 2, packet + 1), XST_DMA_SG_LIST_ERROR);
  BOOST_CHECK_EQUAL(XAxiDma_BdRingToHw(tx, 1, packet), XST_FAILURE);  // a packet without its end
  XAxiDma_BdWrite(packet + 1, XAXIDMA_BD_CTRL_LEN_OFFSET, eof);
  BOOST_CHECK_EQUAL(XAxiDma_BdRingToHw(tx, 2, packet), XST_FAILURE);  // no length
  BOOST_CHECK_EQUAL(XAxiDma_BdRingToHw(tx, -1, packet), XST_INVALID_PARAM);
  BOOST_CHECK_EQUAL(XAxiDma_BdRingToHw(tx, 0, packet), XST_SUCCESS);
  BOOST_CHECK_EQUAL(XAxiDma_BdRingUnAlloc(tx, 1, packet), XST_FAILURE);
  BOOST_CHECK_EQUAL(XAxiDma_BdRingUnAlloc(tx, 1, packet + 1), XST_SUCCESS);
  BOOST_CHECK_EQUAL(XAxiDma_BdSetLength(packet, 0, 0x3FFF), XST_INVALID_PARAM);
  BOOST_CHECK_EQUAL(XAxiDma_BdSetLength(packet, 0x4000, 0x3FFF), XST_INVALID_PARAM);
  BOOST_CHECK_EQUAL(XAxiDma_BdSetBufAddr(packet, UINTPTR{1} << 32), XST_INVALID_PARAM);
  XAxiDma_Bd pattern = {};
  BOOST_CHECK_EQUAL(XAxiDma_BdRingClone(tx, &pattern), XST_DMA_SG_LIST_ERROR);  // one is in use
}

BOOST_AUTO_TEST_CASE(received_packets_end_where_the_hardware_says) {
  create(rx, 4);
  XAxiDma_Bd* const first = allocate(rx, 4);
  BOOST_CHECK_EQUAL(XAxiDma_BdRingToHw(rx, 4, first), XST_SUCCESS);
  BOOST_CHECK_EQUAL(XAxiDma_BdRingStart(rx), XST_SUCCESS);
  BOOST_CHECK(writes_to(base + S2MM_TAILDESC) == Words{static_cast<std::uint32_t>(space()) + 0xC0});
  complete(first, XAXIDMA_BD_STS_RXSOF_MASK);
  complete(first + 1, XAXIDMA_BD_STS_RXEOF_MASK);
  complete(first + 2, XAXIDMA_BD_STS_RXSOF_MASK);
  XAxiDma_Bd* done = nullptr;
  BOOST_CHECK_EQUAL(XAxiDma_BdRingFromHw(rx, XAXIDMA_ALL_BDS, &done), 2);
  BOOST_CHECK_EQUAL(XAxiDma_BdGetActualLength(done, rx->MaxTransferLen), 64u);
  BOOST_CHECK_EQUAL(XAxiDma_BdRingFromHw(rx, XAXIDMA_ALL_BDS, &done), 0);
}

// In cyclic mode descriptors stay with the hardware: what was seen done is done again a round
// later.
BOOST_AUTO_TEST_CASE(a_ring_that_goes_round_by_itself) {
  create(rx, 4);
  XAxiDma_Bd* const first = allocate(rx, 4);
  XAxiDma_BdRingEnableCyclicDMA(rx);
  BOOST_CHECK_EQUAL(XAxiDma_SelectCyclicMode(&dma, XAXIDMA_DEVICE_TO_DMA, 1), XST_SUCCESS);
  BOOST_CHECK_EQUAL(XAxiDma_BdRingToHw(rx, 4, first), XST_SUCCESS);
  BOOST_CHECK_EQUAL(XAxiDma_BdRingStart(rx), XST_SUCCESS);
  BOOST_CHECK_NE(state().registers[base + S2MM_DMACR] & dmacr::Cyclic_BD_Enable, 0u);
  XAxiDma_Bd* done = nullptr;
  for (int round = 0; round < 3; ++round) {
    BOOST_CHECK_EQUAL(XAxiDma_BdRingFromHw(rx, XAXIDMA_ALL_BDS, &done), 0);
    for (int i = 0; i < 4; ++i) complete(first + i, XAXIDMA_BD_STS_RXEOF_MASK);
    BOOST_CHECK_EQUAL(XAxiDma_BdRingFromHw(rx, 3, &done), 3);
    BOOST_CHECK(done == first);
    BOOST_CHECK(!XAxiDma_BdHwCompleted(first));
    BOOST_CHECK_EQUAL(XAxiDma_BdRingFromHw(rx, XAXIDMA_ALL_BDS, &done), 1);
    BOOST_CHECK(done == first + 3);
  }
  BOOST_CHECK_EQUAL(XAxiDma_BdRingCreate(rx, space(), space(), 64, 4), XST_FAILURE);
  BOOST_CHECK_EQUAL(rx->Cyclic, 0);
}

// A paused ring takes descriptors, and the hardware hears of them when it continues.
BOOST_AUTO_TEST_CASE(a_pause) {
  dma.HasS2Mm = 0;
  create(tx, 4);
  BOOST_CHECK_EQUAL(XAxiDma_BdRingStart(tx), XST_SUCCESS);
  BOOST_CHECK_EQUAL(XAxiDma_Pause(&dma), XST_SUCCESS);
  BOOST_CHECK(XAxiDma_BdRingHwIsStarted(tx));
  XAxiDma_Bd* const packet = allocate(tx, 1);
  BOOST_CHECK_EQUAL(XAxiDma_BdRingToHw(tx, 1, packet), XST_SUCCESS);
  BOOST_CHECK(writes_to(base + MM2S_TAILDESC).empty());
  BOOST_CHECK_EQUAL(XAxiDma_Resume(&dma), XST_SUCCESS);
  BOOST_CHECK(writes_to(base + MM2S_TAILDESC) == Words{static_cast<std::uint32_t>(space())});
}

BOOST_AUTO_TEST_CASE(registers_and_descriptors_are_printed) {
  create(tx, 4);
  XAxiDma_Bd* const packet = allocate(tx, 1);
  XAxiDma_BdSetId(packet, 0x1234);
  XAxiDma_DumpBd(packet);
  XAxiDma_BdRingDumpRegs(rx);
  BOOST_TEST(state().console.find("buffer 10000000, control C000040, status 0, ID 1234\n") !=
             std::string::npos);
  BOOST_TEST(state().console.find("channel 40400030:\n control 0, status 1,") != std::string::npos);
  BOOST_CHECK_EQUAL(XAxiDma_BdRingGetSr(rx), dmasr::Halted);
}

BOOST_AUTO_TEST_CASE(coalescing) {
  u32 packets = 0, delay = 0;
  BOOST_CHECK_EQUAL(XAxiDma_BdRingSetCoalesce(tx, 8, 100), XST_SUCCESS);
  BOOST_CHECK_EQUAL(XAxiDma_BdRingSetCoalesce(tx, XAXIDMA_NO_CHANGE, 5), XST_SUCCESS);
  XAxiDma_BdRingGetCoalesce(tx, &packets, &delay);
  BOOST_CHECK_EQUAL(packets, 8u);
  BOOST_CHECK_EQUAL(delay, 5u);
  BOOST_CHECK_EQUAL(XAxiDma_BdRingSetCoalesce(tx, 0, 0), XST_FAILURE);
  BOOST_CHECK_EQUAL(XAxiDma_BdRingSetCoalesce(tx, 256, 0), XST_FAILURE);
  BOOST_CHECK_EQUAL(XAxiDma_BdRingSetCoalesce(tx, 1, 256), XST_FAILURE);
}

// An instance with scatter-gather has no simple transfers.
BOOST_AUTO_TEST_CASE(one_mode_or_the_other) {
  BOOST_CHECK_EQUAL(XAxiDma_SimpleTransfer(&dma, 0x10000000, 64, XAXIDMA_DMA_TO_DEVICE),
                    XST_FAILURE);
  BOOST_CHECK_EQUAL(XAxiDma_SelectCyclicMode(&dma, XAXIDMA_DMA_TO_DEVICE, 1), XST_SUCCESS);
  dma.HasSg = 0;
  BOOST_CHECK_EQUAL(XAxiDma_SelectCyclicMode(&dma, XAXIDMA_DMA_TO_DEVICE, 1), XST_INVALID_PARAM);
  XAxiDma_BdRingStart(tx);
  BOOST_CHECK_EQUAL(XAxiDma_Resume(&dma), XST_SUCCESS);
  BOOST_CHECK_EQUAL(state().registers[base + MM2S_DMASR], 0u);
  BOOST_CHECK_EQUAL(XAxiDma_Pause(&dma), XST_SUCCESS);
  BOOST_CHECK_EQUAL(state().registers[base + MM2S_DMASR], dmasr::Halted);
  dma.Initialized = 0;
  BOOST_CHECK_EQUAL(XAxiDma_Pause(&dma), XST_NOT_SGDMA);
  BOOST_CHECK_EQUAL(XAxiDma_Resume(&dma), XST_NOT_SGDMA);
}

BOOST_AUTO_TEST_SUITE_END()

// The status toggles where a 1 is written: bits that are not set stay so.
BOOST_AUTO_TEST_CASE(a_gpio_interrupt_is_cleared_only_where_it_is_set) {
  fake_hal::reset();
  XGpio gpio;
  BOOST_REQUIRE_EQUAL(XGpio_Initialize(&gpio, 0), XST_SUCCESS);
  const std::uint32_t status = static_cast<std::uint32_t>(gpio.BaseAddress) + XGPIO_ISR_OFFSET;
  state().registers[status] = XGPIO_IR_CH1_MASK;
  XGpio_InterruptClear(&gpio, XGPIO_IR_MASK);
  BOOST_CHECK(writes_to(status) == Words{XGPIO_IR_CH1_MASK});
}
