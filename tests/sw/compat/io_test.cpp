// Xil_In…, Xil_Out…, cache names, exceptions.
#include <boost/test/unit_test.hpp>

#include <xil_cache.h>
#include <xil_cache_l.h>
#include <xil_exception.h>
#include <xil_io.h>
#include <xil_misc_psreset_api.h>
#include <xpseudo_asm.h>

#include "fake_hal.h"

extern "C" {
void write_undeclared(unsigned address, unsigned value);
unsigned read_undeclared(unsigned address);
}

namespace {

using fake_hal::Access;
using fake_hal::state;

struct Fixture {
  Fixture() { fake_hal::reset(); }
};

constexpr UINTPTR gpio = 0x4120'0000;
constexpr UINTPTR last_register = 0xFFFF'FFFC;

void note(void* context) {
  ++*static_cast<int*>(context);
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(xil_io, Fixture)

BOOST_AUTO_TEST_CASE(words_of_devices_go_through_the_hal) {
  Xil_Out32(gpio, 0x1234'5678);
  BOOST_CHECK_EQUAL(Xil_In32(gpio), 0x1234'5678u);
  Xil_Out32(last_register, 1);
  BOOST_REQUIRE_EQUAL(state().accesses.size(), 3);
  BOOST_CHECK(state().accesses[0] == (Access{true, 0x4120'0000, 0x1234'5678}));
  BOOST_CHECK(state().accesses[1] == (Access{false, 0x4120'0000, 0x1234'5678}));
  BOOST_CHECK(state().accesses[2] == (Access{true, 0xFFFF'FFFC, 1}));
}

BOOST_AUTO_TEST_CASE(parts_of_a_word_are_cut_out_and_put_in) {
  Xil_Out32(gpio, 0x4433'2211);
  BOOST_CHECK_EQUAL(Xil_In8(gpio), 0x11);
  BOOST_CHECK_EQUAL(Xil_In8(gpio + 3), 0x44);
  BOOST_CHECK_EQUAL(Xil_In16(gpio), 0x2211);
  BOOST_CHECK_EQUAL(Xil_In16(gpio + 2), 0x4433);
  Xil_Out8(gpio + 1, 0xAA);
  BOOST_CHECK_EQUAL(Xil_In32(gpio), 0x4433'AA11u);
  Xil_Out16(gpio + 2, 0xBEEF);
  BOOST_CHECK_EQUAL(Xil_In32(gpio), 0xBEEF'AA11u);
  Xil_Out64(gpio + 8, 0x0123'4567'89AB'CDEF);
  BOOST_CHECK_EQUAL(Xil_In32(gpio + 8), 0x89AB'CDEFu);
  BOOST_CHECK_EQUAL(Xil_In32(gpio + 12), 0x0123'4567u);
  BOOST_CHECK_EQUAL(Xil_In64(gpio + 8), 0x0123'4567'89AB'CDEFu);
}

BOOST_AUTO_TEST_CASE(memory_is_reached_by_pointer) {
  u32 words[4] = {};
  const auto address = reinterpret_cast<UINTPTR>(words);
  Xil_Out32(address, 0x4433'2211);
  Xil_Out8(address + 1, 0xAA);
  Xil_Out16(address + 2, 0xBEEF);
  Xil_Out64(address + 8, 0x0123'4567'89AB'CDEF);
  BOOST_CHECK_EQUAL(words[0], 0xBEEF'AA11u);
  BOOST_CHECK_EQUAL(words[2], 0x89AB'CDEFu);
  BOOST_CHECK_EQUAL(Xil_In8(address + 1), 0xAA);
  BOOST_CHECK_EQUAL(Xil_In16(address + 2), 0xBEEF);
  BOOST_CHECK_EQUAL(Xil_In32(address), 0xBEEF'AA11u);
  BOOST_CHECK_EQUAL(Xil_In64(address + 8), 0x0123'4567'89AB'CDEFu);
  BOOST_CHECK(state().accesses.empty());
}

BOOST_AUTO_TEST_CASE(the_border_between_memory_and_registers) {
  BOOST_CHECK(!markervp_is_register(0x3FFF'FFFF));
  BOOST_CHECK(markervp_is_register(0x4000'0000));
  BOOST_CHECK(markervp_is_register(0xFFFF'FFFF));
  BOOST_CHECK(!markervp_is_register(UINTPTR{0x1'0000'0000}));
}

BOOST_AUTO_TEST_CASE(cache_ranges) {
  char buffer[64];
  const auto address = reinterpret_cast<INTPTR>(buffer);
  Xil_DCacheEnable();
  Xil_ICacheEnable();
  BOOST_REQUIRE_EQUAL(state().whole_cache_operations.size(), 1);
  BOOST_CHECK(state().whole_cache_operations[0] == HAL_CACHE_ENABLE);
  BOOST_CHECK(state().flushed.empty());
  Xil_DCacheFlushRange(address, 64);
  Xil_DCacheInvalidateRange(address + 32, 32);
  BOOST_REQUIRE_EQUAL(state().flushed.size(), 1);
  BOOST_CHECK(state().flushed[0].first == buffer && state().flushed[0].second == 64);
  BOOST_REQUIRE_EQUAL(state().invalidated.size(), 2);
  BOOST_CHECK(state().invalidated[0].first == buffer && state().invalidated[0].second == 64);
  BOOST_CHECK(state().invalidated[1].first == buffer + 32 && state().invalidated[1].second == 32);
}

BOOST_AUTO_TEST_CASE(only_irq_has_a_handler) {
  int calls = 0;
  Xil_ExceptionInit();
  Xil_ExceptionRegisterHandler(0, &note, &calls);
  BOOST_CHECK(state().handler == nullptr);
  Xil_ExceptionRegisterHandler(XIL_EXCEPTION_ID_INT, &note, &calls);
  BOOST_REQUIRE(state().handler == &note);
  state().handler(state().handler_context);
  BOOST_CHECK_EQUAL(calls, 1);
  BOOST_CHECK(!state().enabled);
  Xil_ExceptionEnable();
  BOOST_CHECK(state().enabled);
  Xil_ExceptionDisableMask(0x40);  // FIQ
  BOOST_CHECK(state().enabled);
  Xil_ExceptionDisable();
  BOOST_CHECK(!state().enabled);
  Xil_ExceptionRemoveHandler(XIL_EXCEPTION_ID_INT);
  BOOST_CHECK(state().handler == nullptr);
}

BOOST_AUTO_TEST_CASE(a_registered_handler_is_told_until_it_is_removed) {
  int irqs = 0, aborts = 0;
  Xil_ExceptionHandler handler = nullptr;
  void* data = nullptr;
  Xil_ExceptionRegisterHandler(XIL_EXCEPTION_ID_IRQ_INT, &note, &irqs);
  Xil_ExceptionRegisterHandler(XIL_EXCEPTION_ID_DATA_ABORT_INT, &note, &aborts);
  Xil_GetExceptionRegisterHandler(XIL_EXCEPTION_ID_IRQ_INT, &handler, &data);
  BOOST_CHECK(handler == &note);
  BOOST_CHECK_EQUAL(data, &irqs);
  Xil_GetExceptionRegisterHandler(XIL_EXCEPTION_ID_DATA_ABORT_INT, &handler, &data);
  BOOST_CHECK_EQUAL(data, &aborts);
  for (const u32 id : {XIL_EXCEPTION_ID_IRQ_INT, XIL_EXCEPTION_ID_DATA_ABORT_INT}) {
    Xil_ExceptionRemoveHandler(id);
    Xil_GetExceptionRegisterHandler(id, &handler, &data);
    BOOST_CHECK(handler == nullptr);
    BOOST_CHECK(data == nullptr);
  }
  data = &irqs;
  Xil_GetExceptionRegisterHandler(XIL_EXCEPTION_ID_LAST + 1, &handler, &data);
  BOOST_CHECK_EQUAL(data, &irqs);
}

BOOST_AUTO_TEST_CASE(a_handler_of_fiq_is_warned_of) {
  int calls = 0;
  Xil_ExceptionRegisterHandler(XIL_EXCEPTION_ID_IRQ_INT, &note, &calls);
  Xil_ExceptionRegisterHandler(XIL_EXCEPTION_ID_DATA_ABORT_INT, &note, &calls);
  Xil_ExceptionRemoveHandler(XIL_EXCEPTION_ID_FIQ_INT);
  BOOST_CHECK(state().warnings.empty());
  Xil_ExceptionRegisterHandler(XIL_EXCEPTION_ID_FIQ_INT, &note, &calls);
  BOOST_REQUIRE_EQUAL(state().warnings.size(), 1);
  BOOST_CHECK(state().warnings[0].find("FIQ, which is not modelled") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(the_coprocessor_says_which_processor_and_core_it_is) {
  BOOST_CHECK_EQUAL(mfcp(XREG_CP15_MAIN_ID) >> 4 & 0xFFF, 0xC09u);  // a Cortex-A9
  BOOST_CHECK_EQUAL(mfcp(XREG_CP15_MULTI_PROC_AFFINITY), 0x8000'0000u);
  mtcp(XREG_CP15_INVAL_UTLB_UNLOCKED, 0);
  BOOST_CHECK(state().accesses.empty());
}

BOOST_AUTO_TEST_CASE(the_first_level_of_the_cache_flushes_nothing_for_devices) {
  int word = 0;
  Xil_L1DCacheFlush();
  Xil_L1DCacheFlushRange(reinterpret_cast<INTPTR>(&word), sizeof word);
  BOOST_CHECK(state().flushed.empty());
}

BOOST_AUTO_TEST_CASE(the_lock_of_the_slcr_has_its_addresses) {
  Xil_Out32(XSLCR_UNLOCK_ADDR, XSLCR_UNLOCK_CODE);
  BOOST_REQUIRE_EQUAL(state().accesses.size(), 1);
  BOOST_CHECK(state().accesses[0] == (Access{true, 0xF800'0008, 0xDF0D}));
}

BOOST_AUTO_TEST_CASE(code_without_the_header_reaches_devices) {
  write_undeclared(gpio, 0x8765'4321);
  BOOST_CHECK_EQUAL(read_undeclared(gpio), 0x8765'4321u);
  BOOST_REQUIRE_EQUAL(state().accesses.size(), 2);
  BOOST_CHECK(state().accesses[0] == (Access{true, 0x4120'0000, 0x8765'4321}));
}

BOOST_AUTO_TEST_SUITE_END()
