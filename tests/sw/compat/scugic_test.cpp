// XScuGic against the driver of this project: both must leave the controller alike.
#include <boost/test/unit_test.hpp>

#include <gic_registers.h>
#include <xscugic.h>

#include "fake_hal.h"

namespace {

using fake_hal::state;
using fake_hal::writes_to;
using Words = std::vector<std::uint32_t>;

constexpr std::uint32_t cpu = gic::cpu_interface_base;
constexpr std::uint32_t distributor = gic::distributor_base;

struct Fixture {
  Fixture() {
    fake_hal::reset();
    config = XScuGic_LookupConfig(XPAR_SCUGIC_SINGLE_DEVICE_ID);
    BOOST_REQUIRE(config != nullptr);
    BOOST_REQUIRE_EQUAL(XScuGic_CfgInitialize(&controller, config, config->CpuBaseAddress),
                        XST_SUCCESS);
  }
  XScuGic_Config* config;
  XScuGic controller;
};

void note(void* context) {
  ++*static_cast<int*>(context);
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(xscugic, Fixture)

BOOST_AUTO_TEST_CASE(initialisation) {
  BOOST_CHECK_EQUAL(controller.IsReady, XIL_COMPONENT_IS_READY);
  BOOST_CHECK((writes_to(distributor + gic::ICDDCR) == Words{0, 1}));
  BOOST_CHECK(writes_to(distributor + gic::ICDIPR(23)) == Words{0xA0A0'A0A0});
  BOOST_CHECK(writes_to(distributor + gic::ICDIPTR(23)) == Words{0x0101'0101});
  BOOST_CHECK(writes_to(distributor + gic::ICDICER(2)) == Words{0xFFFF'FFFF});
  BOOST_CHECK(writes_to(cpu + gic::ICCPMR) == Words{0xF0});
  BOOST_CHECK(writes_to(cpu + gic::ICCICR) == Words{7});
  BOOST_CHECK(XScuGic_LookupConfig(1) == nullptr);
  BOOST_CHECK_EQUAL(XScuGic_CfgInitialize(&controller, nullptr, 0), XST_INVALID_PARAM);
}

BOOST_AUTO_TEST_CASE(an_interrupt_reaches_its_handler_and_is_ended) {
  int calls = 0;
  BOOST_CHECK_EQUAL(XScuGic_Connect(&controller, 61, &note, &calls), XST_SUCCESS);
  XScuGic_Enable(&controller, 61);
  BOOST_CHECK(writes_to(distributor + gic::ICDISER(1)) == Words{1u << 29});
  state().registers[cpu + gic::ICCIAR] = 61;
  XScuGic_InterruptHandler(&controller);
  BOOST_CHECK_EQUAL(calls, 1);
  BOOST_CHECK(writes_to(cpu + gic::ICCEOIR) == Words{61});
  BOOST_CHECK_EQUAL(controller.UnhandledInterrupts, 0);
}

BOOST_AUTO_TEST_CASE(without_handler_it_is_counted_and_ended) {
  int calls = 0;
  XScuGic_Connect(&controller, 62, &note, &calls);
  XScuGic_Disconnect(&controller, 62);
  state().registers[cpu + gic::ICCIAR] = 62;
  XScuGic_InterruptHandler(&controller);
  BOOST_CHECK_EQUAL(calls, 0);
  BOOST_CHECK_EQUAL(controller.UnhandledInterrupts, 1);
  BOOST_CHECK(writes_to(cpu + gic::ICCEOIR) == Words{62});
}

BOOST_AUTO_TEST_CASE(a_spurious_interrupt_is_not_ended) {
  state().registers[cpu + gic::ICCIAR] = gic::spurious_id;
  XScuGic_InterruptHandler(&controller);
  BOOST_CHECK(writes_to(cpu + gic::ICCEOIR).empty());
}

BOOST_AUTO_TEST_CASE(priority_and_trigger_of_one_interrupt) {
  state().registers[distributor + gic::ICDICFR(3)] = 0x5555'5555;
  XScuGic_SetPriorityTriggerType(&controller, 61, 0x37, 3);
  BOOST_CHECK_EQUAL(state().registers[distributor + gic::ICDIPR(15)], 0xA0A0'30A0u);
  BOOST_CHECK_EQUAL(state().registers[distributor + gic::ICDICFR(3)], 0x5D55'5555u);
}

// Nothing is written to a read-only register that holds it already; what it does not hold is
// reported.
BOOST_AUTO_TEST_CASE(the_sense_of_a_cpus_own_interrupt) {
  constexpr std::uint32_t senses = distributor + gic::ICDICFR(1);
  state().registers[senses] = 0x7DC0'0000;
  XScuGic_SetPriorityTriggerType(&controller, 29, 0xA0, 3);
  BOOST_CHECK(writes_to(senses).empty());
  XScuGic_SetPriorityTriggerType(&controller, 29, 0xA0, 1);
  BOOST_CHECK(writes_to(senses) == Words{0x75C0'0000});
}

BOOST_AUTO_TEST_CASE(targets) {
  constexpr std::uint32_t of_61 = distributor + gic::ICDIPTR(15);
  state().registers[of_61] = 0x0101'0101;
  XScuGic_InterruptMaptoCpu(&controller, 1, 61);
  BOOST_CHECK_EQUAL(state().registers[of_61], 0x0101'0301u);
  XScuGic_InterruptUnmapFromCpu(&controller, 0, 61);
  BOOST_CHECK_EQUAL(state().registers[of_61], 0x0101'0201u);
  XScuGic_UnmapAllInterruptsFromCpu(&controller, 0);
  BOOST_CHECK_EQUAL(state().registers[of_61], 0x0000'0200u);
  BOOST_CHECK_EQUAL(state().registers[distributor + gic::ICDIPTR(23)], 0u);
}

BOOST_AUTO_TEST_CASE(of_another_cpu) {
  XScuGic_SetCpuID(1);
  BOOST_CHECK_EQUAL(XScuGic_GetCpuID(), 1u);
  XScuGic_CfgInitialize(&controller, config, config->CpuBaseAddress);
  BOOST_CHECK_EQUAL(state().registers[distributor + gic::ICDIPTR(23)], 0x0202'0202u);
  XScuGic_SetCpuID(0);
}

BOOST_AUTO_TEST_CASE(registers_by_name) {
  XScuGic_CPUWriteReg(&controller, XSCUGIC_CPU_PRIOR_OFFSET, 0x50);
  BOOST_CHECK_EQUAL(XScuGic_CPUReadReg(&controller, XSCUGIC_CPU_PRIOR_OFFSET), 0x50u);
  XScuGic_DistWriteReg(&controller, XSCUGIC_PENDING_SET_OFFSET, 1);
  BOOST_CHECK(writes_to(distributor + gic::ICDISPR(0)) == Words{1});
  BOOST_CHECK_EQUAL(XScuGic_DistReadReg(&controller, XSCUGIC_PENDING_SET_OFFSET), 1u);
}

BOOST_AUTO_TEST_CASE(numbers_beyond_the_last_are_refused) {
  int calls = 0;
  BOOST_CHECK_EQUAL(XScuGic_Connect(&controller, 96, &note, &calls), XST_INVALID_PARAM);
  BOOST_CHECK_EQUAL(XScuGic_Connect(&controller, 61, nullptr, &calls), XST_INVALID_PARAM);
  state().accesses.clear();
  XScuGic_Enable(&controller, 96);
  XScuGic_Disable(&controller, 96);
  XScuGic_Disconnect(&controller, 96);
  XScuGic_SetPriorityTriggerType(&controller, 96, 0, 1);
  BOOST_CHECK(state().accesses.empty());
}

BOOST_AUTO_TEST_SUITE_END()
