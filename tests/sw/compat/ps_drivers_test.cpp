// XGpioPs, XTtcPs, XTmrCtr, XAdcPs and the waits of xil_util.h.
#include <boost/test/unit_test.hpp>

#include <ps_gpio_registers.h>
#include <ps_xadc_registers.h>
#include <ttc_registers.h>
#include <xadcps.h>
#include <xgpiops.h>
#include <xiicps_hw.h>
#include <xil_util.h>
#include <xspips_hw.h>
#include <xtmrctr.h>
#include <xttcps.h>

#include <utility>

#include "fake_hal.h"

namespace {

using fake_hal::state;
using fake_hal::writes_to;
using Words = std::vector<std::uint32_t>;

struct Fixture {
  Fixture() { fake_hal::reset(); }
};

struct GpioFixture : Fixture {
  GpioFixture() {
    BOOST_REQUIRE_EQUAL(XGpioPs_CfgInitialize(&gpio, XGpioPs_LookupConfig(0), ps_gpio::base),
                        XST_SUCCESS);
  }
  std::uint32_t& at(std::uint32_t offset) { return state().registers[ps_gpio::base + offset]; }
  XGpioPs gpio;
};

unsigned banks_called, last_status;

}  // namespace

BOOST_FIXTURE_TEST_SUITE(xgpiops, GpioFixture)

BOOST_AUTO_TEST_CASE(one_device_with_masked_interrupts) {
  BOOST_CHECK(writes_to(ps_gpio::base + ps_gpio::INT_DIS_0 + 0xC0) == Words{~0u});
  BOOST_CHECK(XGpioPs_LookupConfig(ps_gpio::base) == XGpioPs_LookupConfig(0));
  BOOST_CHECK(XGpioPs_LookupConfig(1) == nullptr);
}

BOOST_AUTO_TEST_CASE(pins_of_all_banks) {
  u8 bank = 0, bit = 0;
  XGpioPs_GetBankPin(117, &bank, &bit);
  BOOST_CHECK_EQUAL(bank, 3);
  BOOST_CHECK_EQUAL(bit, 31);
  XGpioPs_SetDirectionPin(&gpio, 54, 1);
  XGpioPs_SetOutputEnablePin(&gpio, 54, 1);
  BOOST_CHECK_EQUAL(at(ps_gpio::DIRM_0 + 0x80), 1u);
  BOOST_CHECK_EQUAL(XGpioPs_GetOutputEnablePin(&gpio, 54), 1u);
  XGpioPs_WritePin(&gpio, 50, 1);  // bit 18 of bank 1
  BOOST_CHECK(writes_to(ps_gpio::base + ps_gpio::MASK_DATA_0_MSW + 8) == Words{0xFFFB'0004});
  at(ps_gpio::DATA_0_RO + 4) = 1u << 18;
  BOOST_CHECK_EQUAL(XGpioPs_ReadPin(&gpio, 50), 1u);
  BOOST_CHECK_EQUAL(XGpioPs_ReadPin(&gpio, 51), 0u);
}

BOOST_AUTO_TEST_CASE(a_reset_reaches_every_bank) {
  XGpioPs_ResetHw(ps_gpio::base);
  for (std::uint32_t bank = 0; bank < ps_gpio::bank_count; ++bank) {
    const std::uint32_t registers = ps_gpio::base + bank * ps_gpio::bank_stride;
    BOOST_CHECK(writes_to(registers + XGPIOPS_DIRM_OFFSET) == Words{0});
    BOOST_CHECK(writes_to(registers + XGPIOPS_OUTEN_OFFSET) == Words{0});
    BOOST_CHECK(writes_to(registers + XGPIOPS_INTSTS_OFFSET) == Words{~0u});
  }
  BOOST_CHECK(writes_to(ps_gpio::base + ps_gpio::bank_stride + XGPIOPS_INTTYPE_OFFSET) ==
              Words{0x003F'FFFF});
}

BOOST_AUTO_TEST_CASE(kinds_of_interrupts) {
  for (u8 kind = 0; kind <= XGPIOPS_IRQ_TYPE_LEVEL_LOW; ++kind) {
    XGpioPs_SetIntrTypePin(&gpio, 14, kind);
    BOOST_CHECK_EQUAL(XGpioPs_GetIntrTypePin(&gpio, 14), kind);
  }
  BOOST_CHECK_EQUAL(XGpioPs_SelfTest(&gpio), XST_SUCCESS);
}

BOOST_AUTO_TEST_CASE(the_handler_gets_enabled_events_only) {
  banks_called = 0;
  XGpioPs_SetCallbackHandler(&gpio, nullptr, [](void*, u32 bank, u32 status) {
    banks_called |= 1u << bank;
    last_status = status;
  });
  at(ps_gpio::INT_MASK_0) = at(ps_gpio::INT_MASK_0 + 0x40) = ~0u;
  at(ps_gpio::INT_MASK_0 + 0xC0) = ~0u;
  at(ps_gpio::INT_MASK_0 + 0x80) = ~6u;
  at(ps_gpio::INT_STAT_0) = 1;
  at(ps_gpio::INT_STAT_0 + 0x80) = 5;
  XGpioPs_IntrHandler(&gpio);
  BOOST_CHECK_EQUAL(banks_called, 4u);
  BOOST_CHECK_EQUAL(last_status, 4u);
  BOOST_CHECK(writes_to(ps_gpio::base + ps_gpio::INT_STAT_0 + 0x80) == Words{4});
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_FIXTURE_TEST_SUITE(xttcps, Fixture)

BOOST_AUTO_TEST_CASE(counters_have_numbers_and_addresses) {
  BOOST_CHECK_EQUAL(XTtcPs_LookupConfig(4)->BaseAddress, 0xF800'2004u);
  BOOST_CHECK_EQUAL(XTtcPs_LookupConfig(0xF800'1008)->DeviceId, 2);
  BOOST_CHECK(XTtcPs_LookupConfig(6) == nullptr);
}

BOOST_AUTO_TEST_CASE(a_running_counter_is_left_alone) {
  XTtcPs timer;
  BOOST_CHECK_EQUAL(XTtcPs_CfgInitialize(&timer, XTtcPs_LookupConfig(0), ttc::ttc0_base),
                    XST_DEVICE_IS_STARTED);
  BOOST_CHECK(writes_to(ttc::ttc0_base + ttc::CLK_CTRL_1).empty());
}

BOOST_AUTO_TEST_CASE(options_interval_and_prescaler) {
  state().registers[ttc::ttc0_base + ttc::CNT_CTRL_1] = 0x21;
  XTtcPs timer;
  BOOST_REQUIRE_EQUAL(XTtcPs_CfgInitialize(&timer, XTtcPs_LookupConfig(0), ttc::ttc0_base),
                      XST_SUCCESS);
  constexpr u32 options = XTTCPS_OPTION_INTERVAL_MODE | XTTCPS_OPTION_WAVE_DISABLE;
  XTtcPs_SetOptions(&timer, options);
  BOOST_CHECK_EQUAL(XTtcPs_GetOptions(&timer), options);
  XInterval interval = 0;
  u8 prescaler = 0;
  timer.Config.InputClockHz = 111'111'111;
  XTtcPs_CalcIntervalFromFreq(&timer, 100, &interval, &prescaler);  // 1 111 111 clocks
  BOOST_CHECK_EQUAL(interval, 34'722);
  BOOST_CHECK_EQUAL(prescaler, 4);
  XTtcPs_SetPrescaler(&timer, prescaler);
  BOOST_CHECK_EQUAL(XTtcPs_GetPrescaler(&timer), 4);
  XTtcPs_CalcIntervalFromFreq(&timer, 100'000'000, &interval, &prescaler);
  BOOST_CHECK_EQUAL(prescaler, 0xFF);
  XTtcPs_CalcIntervalFromFreq(&timer, 10'000, &interval, &prescaler);
  BOOST_CHECK_EQUAL(interval, 11'111);
  BOOST_CHECK_EQUAL(prescaler, XTTCPS_CLK_CNTRL_PS_DISABLE);
}

BOOST_AUTO_TEST_SUITE_END()

namespace {

constexpr std::uint32_t timer_base = 0x4280'0000;

struct TimerFixture : Fixture {
  TimerFixture() {
    state().xparameters = {{"TMRCTR_0_BASEADDR", timer_base},
                           {"TMRCTR_0_CLOCK_FREQ_HZ", 100'000'000},
                           {"TMRCTR_5_BASEADDR", 0x4285'0000},
                           {"XTMRCTR_NUM_INSTANCES", 6}};
    BOOST_REQUIRE_EQUAL(XTmrCtr_Initialize(&timer, 0), XST_SUCCESS);
    state().accesses.clear();
  }
  std::uint32_t& control(unsigned number) {
    return state().registers[timer_base + number * XTC_TIMER_COUNTER_OFFSET];
  }
  XTmrCtr timer{};
  std::vector<u8> handled;
};

void handle(void* of, u8 number) {
  static_cast<TimerFixture*>(of)->handled.push_back(number);
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(xtmrctr, TimerFixture)

BOOST_AUTO_TEST_CASE(timers_have_numbers_and_addresses) {
  BOOST_CHECK(XTmrCtr_LookupConfig(timer_base) == XTmrCtr_LookupConfig(0));
  BOOST_CHECK_EQUAL(XTmrCtr_LookupConfig(5)->BaseAddress, 0x4285'0000u);
  BOOST_CHECK(XTmrCtr_LookupConfig(0x4285'0000) == XTmrCtr_LookupConfig(5));
  BOOST_CHECK(XTmrCtr_LookupConfig(6) == nullptr);
  BOOST_CHECK_EQUAL(XTmrCtr_Initialize(&timer, 6), XST_DEVICE_NOT_FOUND);
}

// Its control word goes back as it was read: a handler that resets the timer is not called again.
BOOST_AUTO_TEST_CASE(a_reset_takes_the_event_away) {
  control(0) = XTC_CSR_ENABLE_INT_MASK | XTC_CSR_INT_OCCURED_MASK | XTC_CSR_ENABLE_TMR_MASK;
  XTmrCtr_Reset(&timer, 0);
  BOOST_CHECK(writes_to(timer_base) == (Words{0x1E0, 0x1C0}));
}

// One that runs is left alone.
BOOST_AUTO_TEST_CASE(it_is_set_up_a_second_time) {
  XTmrCtr_Start(&timer, 0);
  state().accesses.clear();
  BOOST_CHECK_EQUAL(XTmrCtr_Initialize(&timer, 0), XST_SUCCESS);
  BOOST_CHECK(writes_to(timer_base).empty());
  BOOST_CHECK(writes_to(timer_base + 0x10) == (Words{0x120, 0}));
}

BOOST_AUTO_TEST_CASE(starts_from_the_reset_value) {
  XTmrCtr_SetOptions(&timer, 1, XTC_INT_MODE_OPTION | XTC_AUTO_RELOAD_OPTION);
  BOOST_CHECK_EQUAL(XTmrCtr_GetOptions(&timer, 1), XTC_INT_MODE_OPTION | XTC_AUTO_RELOAD_OPTION);
  XTmrCtr_SetResetValue(&timer, 1, 7);
  XTmrCtr_Start(&timer, 1);
  BOOST_CHECK(writes_to(timer_base + 0x14) == Words{7});
  BOOST_CHECK(writes_to(timer_base + 0x10) == (Words{0x50, 0x20, 0xD0}));
  BOOST_CHECK_EQUAL(XTmrCtr_InitHw(&timer), XST_SUCCESS);  // of the other one
  BOOST_CHECK_EQUAL(control(1), 0xD0u);
  XTmrCtr_Stop(&timer, 1);
  BOOST_CHECK_EQUAL(control(1), 0x50u);
}

BOOST_AUTO_TEST_CASE(an_interrupt_stops_a_timer_that_does_not_reload) {
  XTmrCtr_SetHandler(&timer, handle, this);
  control(0) = XTC_CSR_ENABLE_INT_MASK | XTC_CSR_INT_OCCURED_MASK | XTC_CSR_ENABLE_TMR_MASK;
  control(1) = XTC_CSR_INT_OCCURED_MASK;  // masked
  XTmrCtr_InterruptHandler(&timer);
  BOOST_CHECK(handled == std::vector<u8>{0});
  BOOST_CHECK(writes_to(timer_base) == (Words{0x160, 0x140}));
  BOOST_CHECK(writes_to(timer_base + 0x10).empty());
  control(0) = XTC_CSR_ENABLE_INT_MASK | XTC_CSR_INT_OCCURED_MASK | XTC_CSR_ENABLE_TMR_MASK |
               XTC_CSR_AUTO_RELOAD_MASK;
  XTmrCtr_InterruptHandler(&timer);
  BOOST_CHECK_EQUAL(writes_to(timer_base).back(), 0x1D0u);
  XTmrCtrStats stats;
  XTmrCtr_GetStats(&timer, &stats);
  BOOST_CHECK_EQUAL(stats.Interrupts, 2u);
}

BOOST_AUTO_TEST_CASE(pulse_width) {
  BOOST_CHECK_EQUAL(XTmrCtr_PwmConfigure(&timer, 1000, 250), 23);  // 98 and 23 counts
  BOOST_CHECK(writes_to(timer_base + 4) == Words{98});
  BOOST_CHECK(writes_to(timer_base + 0x14) == Words{23});
  BOOST_CHECK_EQUAL(XTmrCtr_PwmConfigure(&timer, 100, 200), XST_INVALID_PARAM);
}

BOOST_AUTO_TEST_SUITE_END()

namespace {

/// The registers of the XADC behind the FIFOs of its interface.
struct AdcFixture : Fixture {
  AdcFixture() {
    state().on_write[ps_xadc::base + XADCPS_CMDFIFO_OFFSET] = [this](std::uint32_t word) {
      const std::uint32_t at = (word & XADCPS_JTAG_ADDR_MASK) >> XADCPS_JTAG_ADDR_SHIFT;
      if ((word & XADCPS_JTAG_CMD_MASK) == XADCPS_JTAG_CMD_WRITE_MASK)
        inside[at] = word & XADCPS_JTAG_DATA_MASK;
      answer = std::exchange(result, inside[at]);
    };
    state().on_read[ps_xadc::base + XADCPS_RDFIFO_OFFSET] = [this] { return answer; };
    adc.Config.BaseAddress = ps_xadc::base;
    adc.IsReady = XIL_COMPONENT_IS_READY;
  }
  std::map<std::uint32_t, std::uint32_t> inside;
  std::uint32_t answer = 0;  ///< to the command before
  std::uint32_t result = 0;
  XAdcPs adc{};
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(xadcps, AdcFixture)

BOOST_AUTO_TEST_CASE(modes_leave_the_rest_of_their_registers) {
  inside = {{XADCPS_CFR0_OFFSET, 0x3102}, {XADCPS_CFR2_OFFSET, 0x0400}};
  XAdcPs_SetMuxMode(&adc, 1, 0x11);
  BOOST_CHECK_EQUAL(inside[XADCPS_CFR0_OFFSET], 0x3913u);
  XAdcPs_SetMuxMode(&adc, 0, 0x11);
  XAdcPs_SetSequencerEvent(&adc, 1);
  BOOST_CHECK_EQUAL(inside[XADCPS_CFR0_OFFSET], 0x3313u);
  BOOST_CHECK_EQUAL(XAdcPs_GetSamplingMode(&adc), 1);
  XAdcPs_SetSequencerEvent(&adc, 0);
  BOOST_CHECK_EQUAL(XAdcPs_GetSamplingMode(&adc), 0);
  XAdcPs_SetPowerdownMode(&adc, XADCPS_PD_MODE_XADC);
  BOOST_CHECK_EQUAL(inside[XADCPS_CFR2_OFFSET], 0x0420u);
  BOOST_CHECK_EQUAL(XAdcPs_GetPowerdownMode(&adc), 0x40u);
}

BOOST_AUTO_TEST_CASE(an_over_temperature_of_the_users) {
  inside[XADCPS_ATR_OT_UPPER_OFFSET] = 0xCA3F;
  XAdcPs_DisableUserOverTemp(&adc);
  BOOST_CHECK_EQUAL(inside[XADCPS_ATR_OT_UPPER_OFFSET], 0xCA30u);
  XAdcPs_EnableUserOverTemp(&adc);
  BOOST_CHECK_EQUAL(inside[XADCPS_ATR_OT_UPPER_OFFSET], 0xCA33u);
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_FIXTURE_TEST_SUITE(resets, Fixture)

BOOST_AUTO_TEST_CASE(an_i2c_controller_is_off_and_empty) {
  XIicPs_ResetHw(0xE000'4000);
  BOOST_CHECK(writes_to(0xE000'4000 + XIICPS_IDR_OFFSET) == Words{XIICPS_IXR_ALL_INTR_MASK});
  BOOST_CHECK((writes_to(0xE000'4000 + XIICPS_CR_OFFSET) == Words{XIICPS_CR_CLR_FIFO_MASK, 0}));
  BOOST_CHECK(writes_to(0xE000'4000 + XIICPS_TIME_OUT_OFFSET) == Words{0xFF});
}

BOOST_AUTO_TEST_CASE(an_spi_controller_selects_no_slave) {
  XSpiPs_ResetHw(0xE000'6000);
  BOOST_CHECK(writes_to(0xE000'6000 + XSPIPS_ER_OFFSET) == Words{0});
  BOOST_CHECK(writes_to(0xE000'6000 + XSPIPS_CR_OFFSET) == Words{0x0002'3C00});
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_FIXTURE_TEST_SUITE(xil_waits, Fixture)

BOOST_AUTO_TEST_CASE(the_bits_are_the_event) {
  constexpr std::uint32_t address = 0xE000'002C;
  state().on_read[XPAR_GLOBAL_TMR_BASEADDR] = [counter = 0u]() mutable { return counter += 1000; };
  state().registers[address] = 2;
  BOOST_CHECK_EQUAL(Xil_WaitForEvent(address, 2, 0, 3), static_cast<u32>(XST_FAILURE));
  BOOST_CHECK_EQUAL(Xil_WaitForEvent(address, 1, 0, 3), static_cast<u32>(XST_SUCCESS));
  u32 events = 9;
  BOOST_CHECK_EQUAL(Xil_WaitForEvents(address, 6, 3, 3, &events), static_cast<u32>(XST_SUCCESS));
  BOOST_CHECK_EQUAL(events, 2u);
  BOOST_CHECK_EQUAL(Xil_WaitForEvents(address, 4, 4, 3, &events), static_cast<u32>(XST_TIMEOUT));
  BOOST_CHECK_EQUAL(events, 0u);
}

BOOST_AUTO_TEST_SUITE_END()
