// XGpio and XAxiDma.
#include <boost/test/unit_test.hpp>

#include <axi_dma_registers.h>
#include <axi_gpio_registers.h>
#include <xaxidma.h>
#include <xgpio.h>

#include "fake_hal.h"

namespace {

using fake_hal::state;
using fake_hal::writes_to;
using Words = std::vector<std::uint32_t>;

struct Fixture {
  Fixture() { fake_hal::reset(); }
};

constexpr std::uint32_t gpio = XPAR_AXI_GPIO_0_BASEADDR;
constexpr std::uint32_t dma_0 = XPAR_AXI_DMA_0_BASEADDR;
constexpr std::uint32_t dma_1 = XPAR_AXI_DMA_1_BASEADDR;

/// An engine whose reset takes `polls` reads.
void add_engine(std::uint32_t control, unsigned polls) {
  state().on_read[control] = [control, polls]() mutable {
    auto& value = state().registers[control];
    if ((value & axi_dma::dmacr::Reset) && polls-- == 0) value = 0x0001'0002;
    return value;
  };
}

struct DmaFixture : Fixture {
  DmaFixture() {
    add_engine(dma_0 + axi_dma::MM2S_DMACR, 2);
    add_engine(dma_1 + axi_dma::S2MM_DMACR, 2);
    BOOST_REQUIRE_EQUAL(XAxiDma_CfgInitialize(&sender, XAxiDma_LookupConfig(0)), XST_SUCCESS);
    BOOST_REQUIRE_EQUAL(XAxiDma_CfgInitialize(&receiver, XAxiDma_LookupConfig(1)), XST_SUCCESS);
    state().registers[dma_0 + axi_dma::MM2S_DMASR] = axi_dma::dmasr::Halted;
    state().registers[dma_1 + axi_dma::S2MM_DMASR] = axi_dma::dmasr::Halted;
  }
  XAxiDma sender, receiver;
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(xgpio, Fixture)

BOOST_AUTO_TEST_CASE(devices_of_the_platform) {
  XGpio instance;
  BOOST_CHECK_EQUAL(XGpio_Initialize(&instance, 0), XST_SUCCESS);
  BOOST_CHECK_EQUAL(instance.BaseAddress, 0x4120'0000u);
  BOOST_CHECK_EQUAL(XGpio_Initialize(&instance, 1), XST_SUCCESS);
  BOOST_CHECK_EQUAL(instance.BaseAddress, 0x4121'0000u);
  BOOST_CHECK_EQUAL(XGpio_Initialize(&instance, 2), XST_DEVICE_NOT_FOUND);
}

BOOST_AUTO_TEST_CASE(both_channels) {
  XGpio instance;
  XGpio_Initialize(&instance, 0);
  XGpio_SetDataDirection(&instance, 1, 0xF0);
  XGpio_SetDataDirection(&instance, 2, 0x0F);
  XGpio_DiscreteWrite(&instance, 1, 0x11);
  XGpio_DiscreteWrite(&instance, 2, 0x22);
  BOOST_CHECK(writes_to(gpio + axi_gpio::GPIO_TRI) == Words{0xF0});
  BOOST_CHECK(writes_to(gpio + axi_gpio::GPIO2_TRI) == Words{0x0F});
  BOOST_CHECK_EQUAL(XGpio_GetDataDirection(&instance, 2), 0x0Fu);
  BOOST_CHECK_EQUAL(XGpio_DiscreteRead(&instance, 1), 0x11u);
  BOOST_CHECK_EQUAL(XGpio_DiscreteRead(&instance, 2), 0x22u);
  XGpio_DiscreteSet(&instance, 1, 0x06);
  XGpio_DiscreteClear(&instance, 1, 0x12);
  BOOST_CHECK((writes_to(gpio + axi_gpio::GPIO_DATA) == Words{0x11, 0x17, 0x05}));
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_FIXTURE_TEST_SUITE(xaxidma, DmaFixture)

BOOST_AUTO_TEST_CASE(initialisation_resets_the_channel_that_is_there) {
  BOOST_CHECK(writes_to(dma_0 + axi_dma::MM2S_DMACR) == Words{axi_dma::dmacr::Reset});
  BOOST_CHECK(writes_to(dma_1 + axi_dma::S2MM_DMACR) == Words{axi_dma::dmacr::Reset});
  BOOST_CHECK(XAxiDma_LookupConfig(2) == nullptr);
  BOOST_CHECK_EQUAL(XAxiDma_CfgInitialize(&sender, nullptr), XST_INVALID_PARAM);
  BOOST_CHECK_EQUAL(XAxiDma_HasSg(&sender), 0);
}

BOOST_AUTO_TEST_CASE(a_reset_that_never_ends) {
  add_engine(dma_0 + axi_dma::MM2S_DMACR, 1'000'000);
  BOOST_CHECK_EQUAL(XAxiDma_CfgInitialize(&sender, XAxiDma_LookupConfig(0)), XST_FAILURE);
}

BOOST_AUTO_TEST_CASE(a_transfer_writes_address_run_length_in_that_order) {
  state().accesses.clear();
  BOOST_CHECK_EQUAL(XAxiDma_SimpleTransfer(&receiver, 0x1000'0000, 128, XAXIDMA_DEVICE_TO_DMA),
                    XST_SUCCESS);
  std::vector<fake_hal::Access> writes;
  for (const auto& access : state().accesses) {
    if (access.write) writes.push_back(access);
  }
  const std::vector<fake_hal::Access> expected = {{true, dma_1 + axi_dma::S2MM_DA, 0x1000'0000},
                                                  {true, dma_1 + axi_dma::S2MM_DMACR, 0x0001'0003},
                                                  {true, dma_1 + axi_dma::S2MM_LENGTH, 128}};
  BOOST_CHECK(writes == expected);
}

BOOST_AUTO_TEST_CASE(what_does_not_fit_the_build_is_refused) {
  state().accesses.clear();
  const auto send = [&](UINTPTR address, u32 bytes, int direction = XAXIDMA_DMA_TO_DEVICE) {
    return XAxiDma_SimpleTransfer(&sender, address, bytes, direction);
  };
  BOOST_CHECK_EQUAL(send(0x1000'0000, 0), XST_INVALID_PARAM);
  BOOST_CHECK_EQUAL(send(0x1000'0000, 1 << 14), XST_INVALID_PARAM);
  BOOST_CHECK_EQUAL(send(0x1000'0002, 4), XST_INVALID_PARAM);
  BOOST_CHECK_EQUAL(send(0x1000'0000, 4, XAXIDMA_DEVICE_TO_DMA), XST_INVALID_PARAM);
  BOOST_CHECK_EQUAL(send(UINTPTR{0x7F00'0000'0000}, 4), XST_INVALID_PARAM);
  BOOST_CHECK(state().accesses.empty());
  BOOST_CHECK_EQUAL(send(0x1000'0000, (1 << 14) - 1), XST_SUCCESS);
}

BOOST_AUTO_TEST_CASE(a_busy_channel_refuses) {
  state().registers[dma_0 + axi_dma::MM2S_DMASR] = 0;
  BOOST_CHECK_EQUAL(XAxiDma_Busy(&sender, XAXIDMA_DMA_TO_DEVICE), TRUE);
  BOOST_CHECK_EQUAL(XAxiDma_SimpleTransfer(&sender, 0x1000'0000, 4, XAXIDMA_DMA_TO_DEVICE),
                    XST_FAILURE);
  state().registers[dma_0 + axi_dma::MM2S_DMASR] = axi_dma::dmasr::Idle;
  BOOST_CHECK_EQUAL(XAxiDma_Busy(&sender, XAXIDMA_DMA_TO_DEVICE), FALSE);
}

BOOST_AUTO_TEST_CASE(interrupts) {
  constexpr std::uint32_t control = dma_1 + axi_dma::S2MM_DMACR;
  constexpr std::uint32_t status = dma_1 + axi_dma::S2MM_DMASR;
  XAxiDma_IntrEnable(&receiver, XAXIDMA_IRQ_ALL_MASK | 1, XAXIDMA_DEVICE_TO_DMA);
  BOOST_CHECK_EQUAL(state().registers[control], 0x0001'7002u);
  XAxiDma_IntrDisable(&receiver, XAXIDMA_IRQ_DELAY_MASK, XAXIDMA_DEVICE_TO_DMA);
  BOOST_CHECK_EQUAL(state().registers[control], 0x0001'5002u);
  state().registers[status] = 0x1002;
  BOOST_CHECK_EQUAL(XAxiDma_IntrGetIrq(&receiver, XAXIDMA_DEVICE_TO_DMA), XAXIDMA_IRQ_IOC_MASK);
  XAxiDma_IntrAckIrq(&receiver, XAXIDMA_IRQ_IOC_MASK, XAXIDMA_DEVICE_TO_DMA);
  BOOST_CHECK(writes_to(status) == Words{0x1000});
}

BOOST_AUTO_TEST_SUITE_END()
