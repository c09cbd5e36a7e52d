// XGpio, XAxiDma, XUartPs and XScuWdt.
#include <boost/test/unit_test.hpp>

#include <axi_dma_registers.h>
#include <axi_gpio_registers.h>
#include <private_timer_registers.h>
#include <uart_registers.h>
#include <xaxidma.h>
#include <xgpio.h>
#include <xscuwdt.h>
#include <xuartps.h>

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
  BOOST_CHECK_EQUAL(XAxiDma_CfgInitialize(&sender, XAxiDma_LookupConfig(0)), XST_DMA_ERROR);
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

BOOST_FIXTURE_TEST_SUITE(xuartps, Fixture)

BOOST_AUTO_TEST_CASE(devices_have_the_numbers_of_the_platform) {
  BOOST_CHECK_EQUAL(XUartPs_LookupConfig(0)->BaseAddress, uart::uart0_base);
  BOOST_CHECK_EQUAL(XUartPs_LookupConfig(1)->BaseAddress, uart::uart1_base);
  BOOST_CHECK(XUartPs_LookupConfig(2) == nullptr);
  state().xparameters["XUARTPS_NUM_INSTANCES"] = 1;
  BOOST_CHECK(XUartPs_LookupConfig(1) == nullptr);
}

BOOST_AUTO_TEST_CASE(options_are_bits_of_two_registers) {
  XUartPs instance;
  BOOST_REQUIRE_EQUAL(XUartPs_CfgInitialize(&instance, XUartPs_LookupConfig(0), uart::uart0_base),
                      XST_SUCCESS);
  constexpr std::uint32_t control = uart::uart0_base + uart::CR;
  constexpr std::uint32_t modem = uart::uart0_base + uart::MODEMCR;
  state().registers[control] = uart::cr::TXEN | uart::cr::RXEN | uart::cr::STPBRK;
  state().registers[modem] = uart::modemcr::DTR;
  XUartPs_SetOptions(&instance, XUARTPS_OPTION_SET_BREAK | XUARTPS_OPTION_SET_FCM);
  BOOST_CHECK_EQUAL(state().registers[control], uart::cr::TXEN | uart::cr::RXEN | uart::cr::STTBRK);
  BOOST_CHECK_EQUAL(state().registers[modem], uart::modemcr::FCM);
  BOOST_CHECK_EQUAL(XUartPs_GetOptions(&instance),
                    XUARTPS_OPTION_SET_BREAK | XUARTPS_OPTION_SET_FCM);
}

BOOST_AUTO_TEST_CASE(flow_delay_and_modem_status) {
  XUartPs instance;
  BOOST_REQUIRE_EQUAL(XUartPs_CfgInitialize(&instance, XUartPs_LookupConfig(0), uart::uart0_base),
                      XST_SUCCESS);
  XUartPs_SetFlowDelay(&instance, 0xFF);
  BOOST_CHECK(writes_to(uart::uart0_base + uart::FLOW_DELAY) == Words{0x3F});
  BOOST_CHECK_EQUAL(XUartPs_GetFlowDelay(&instance), 0x3F);
  state().registers[uart::uart0_base + uart::MODEMSR] = XUARTPS_MODEMSR_FCMS;
  BOOST_CHECK_EQUAL(XUartPs_GetModemStatus(&instance), XUARTPS_MODEMSR_FCMS);
}

BOOST_AUTO_TEST_CASE(a_reset_turns_both_directions_off) {
  XUartPs_ResetHw(uart::uart1_base);
  BOOST_CHECK(writes_to(uart::uart1_base + uart::IDR) == Words{uart::event::all});
  BOOST_CHECK(writes_to(uart::uart1_base + uart::CR) == Words{0x2B});
  BOOST_CHECK(writes_to(uart::uart1_base + uart::BAUDGEN) == Words{0x28B});
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_FIXTURE_TEST_SUITE(xscuwdt, Fixture)

BOOST_AUTO_TEST_CASE(modes_and_counter) {
  constexpr std::uint32_t base = private_timer::base;
  XScuWdt instance{};
  XScuWdt_Config* const config = XScuWdt_LookupConfig(XPAR_SCUWDT_0_DEVICE_ID);
  BOOST_REQUIRE_EQUAL(config->BaseAddr, base + private_timer::WDT_LOAD);
  BOOST_CHECK(XScuWdt_LookupConfig(1) == nullptr);
  BOOST_CHECK_EQUAL(XScuWdt_CfgInitialize(&instance, config, config->BaseAddr), XST_SUCCESS);
  BOOST_CHECK_EQUAL(XScuWdt_SelfTest(&instance), XST_SUCCESS);
  state().accesses.clear();
  XScuWdt_SetWdMode(&instance);
  XScuWdt_LoadWdt(&instance, 1000);
  XScuWdt_Start(&instance);
  XScuWdt_RestartWdt(&instance);
  BOOST_CHECK((writes_to(base + private_timer::WDT_CONTROL) == Words{0x8, 0x9}));
  BOOST_CHECK((writes_to(base + private_timer::WDT_LOAD) == Words{1000, 1000}));
  BOOST_CHECK_EQUAL(XScuWdt_CfgInitialize(&instance, config, config->BaseAddr),
                    XST_DEVICE_IS_STARTED);
  XScuWdt_SetTimerMode(&instance);
  BOOST_CHECK((writes_to(base + private_timer::WDT_DISABLE) ==
               Words{private_timer::disable_key_1, private_timer::disable_key_2}));
  XScuWdt_Stop(&instance);
  XScuWdt_EnableAutoReload(&instance);
  BOOST_CHECK_EQUAL(XScuWdt_GetControlReg(&instance), 0xAu);
  BOOST_CHECK(!XScuWdt_IsTimerExpired(&instance) && !XScuWdt_IsWdtExpired(&instance));
  state().registers[base + private_timer::WDT_INTERRUPT_STATUS] = 1;
  BOOST_CHECK(XScuWdt_IsTimerExpired(&instance) && !XScuWdt_IsWdtExpired(&instance));
  state().registers[base + private_timer::WDT_RESET_STATUS] = 1;
  BOOST_CHECK(XScuWdt_IsWdtExpired(&instance));
}

BOOST_AUTO_TEST_CASE(a_load_register_that_does_not_hold) {
  XScuWdt instance{};
  XScuWdt_CfgInitialize(&instance, XScuWdt_LookupConfig(0), XPAR_XSCUWDT_0_BASEADDR);
  state().on_read[XPAR_XSCUWDT_0_BASEADDR] = [] { return 0u; };
  BOOST_CHECK_EQUAL(XScuWdt_SelfTest(&instance), XST_FAILURE);
}

BOOST_AUTO_TEST_SUITE_END()
