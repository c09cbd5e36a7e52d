#include <simulation.h>
#include <sys/mman.h>

#include <ps/memory/memory.h>
#include <vp/configuration.h>
#include <vp/error.h>
#include <vp/mm_link.h>

#include <boost/test/unit_test.hpp>
#include <cstring>
#include <memory>
#include <optional>

using ps::Ddr;

namespace {

struct DdrBench : kit::Simulation {
  DdrBench() { link.socket.bind(ddr.socket); }
  Ddr ddr{"ddr"};
  vp::MmLink link{"link"};
  tlm::tlm_generic_payload payload;

  tlm::tlm_generic_payload& transaction(tlm::tlm_command command, std::uint64_t address, void* data,
                                        unsigned length) {
    payload.set_command(command);
    payload.set_address(address);
    payload.set_data_ptr(static_cast<unsigned char*>(data));
    payload.set_data_length(length);
    payload.set_streaming_width(length);
    payload.set_byte_enable_ptr(nullptr);
    payload.set_dmi_allowed(false);
    payload.set_response_status(tlm::TLM_INCOMPLETE_RESPONSE);
    return payload;
  }
  /// In a process; expects no time to pass.
  tlm::tlm_response_status transport() {
    tlm::tlm_response_status status = tlm::TLM_INCOMPLETE_RESPONSE;
    sc_core::sc_spawn([&] {
      sc_core::sc_time delay = sc_core::SC_ZERO_TIME;
      link.transport(payload, delay);
      BOOST_TEST(delay.value() == 0u);
      status = payload.get_response_status();
    });
    sc_core::sc_start(sc_core::SC_ZERO_TIME);
    return status;
  }
};

}  // namespace

BOOST_AUTO_TEST_SUITE(ddr)

BOOST_FIXTURE_TEST_CASE(bus_address_and_pointer_are_one_number, DdrBench) {
  BOOST_TEST(ddr.end() == 0x2000'0000u);
  unsigned char* memory = ddr.at(0x1000'0000, 16);
  BOOST_TEST(reinterpret_cast<std::uintptr_t>(memory) == 0x1000'0000u);
  BOOST_TEST(static_cast<void*>(ddr.at(Ddr::base)) == reinterpret_cast<void*>(Ddr::base));
  BOOST_TEST(ddr.behind(0x1000'0000) != memory);
  *ddr.behind(0x1000'0007) = 7;
  BOOST_TEST(memory[7] == 7);
  BOOST_CHECK_THROW(ddr.at(Ddr::base - 1), vp::ProtocolError);
  BOOST_CHECK_THROW(ddr.at(0x1FFF'FFFF, 2), vp::ProtocolError);
  BOOST_TEST(ddr.contains(0x1FFF'FFFF, 1));
  BOOST_TEST(!ddr.contains(0x2000'0000, 1));
}

BOOST_FIXTURE_TEST_CASE(transactions, DdrBench) {
  char text[] = "eleven byte";
  transaction(tlm::TLM_WRITE_COMMAND, 0x1000'0003, text, 11);
  BOOST_TEST(transport() == tlm::TLM_OK_RESPONSE);
  BOOST_TEST(payload.is_dmi_allowed());
  BOOST_TEST(std::memcmp(ddr.at(0x1000'0003), text, 11) == 0);
  char back[11] = {};
  transaction(tlm::TLM_READ_COMMAND, 0x1000'0003, back, 11);
  BOOST_TEST(transport() == tlm::TLM_OK_RESPONSE);
  BOOST_TEST(std::memcmp(back, text, 11) == 0);
  BOOST_TEST(ddr.reads == 1u);
  BOOST_TEST(ddr.writes == 1u);
  BOOST_TEST(ddr.bytes_read == 11u);
  BOOST_TEST(ddr.bytes_written == 11u);
}

BOOST_FIXTURE_TEST_CASE(byte_enables_and_fixed_bursts, DdrBench) {
  unsigned char data[8] = {1, 2, 3, 4, 5, 6, 7, 8};
  unsigned char enables[2] = {TLM_BYTE_ENABLED, TLM_BYTE_DISABLED};
  transaction(tlm::TLM_WRITE_COMMAND, 0x1000'0000, data, 4);
  payload.set_byte_enable_ptr(enables);
  payload.set_byte_enable_length(2);
  BOOST_TEST(transport() == tlm::TLM_OK_RESPONSE);
  const unsigned char expected[] = {1, 0, 3, 0, 0, 0, 0, 0};
  BOOST_TEST(std::memcmp(ddr.at(0x1000'0000), expected, 8) == 0);

  transaction(tlm::TLM_WRITE_COMMAND, 0x1000'0000, data, 8);
  payload.set_streaming_width(4);
  BOOST_TEST(transport() == tlm::TLM_OK_RESPONSE);
  const unsigned char last_beat[] = {5, 6, 7, 8, 0, 0, 0, 0};
  BOOST_TEST(std::memcmp(ddr.at(0x1000'0000), last_beat, 8) == 0);
}

BOOST_FIXTURE_TEST_CASE(wrong_transactions_are_answered_with_the_reason, DdrBench) {
  unsigned char data[8] = {};
  transaction(tlm::TLM_WRITE_COMMAND, 0x1FFF'FFFC, data, 8);
  BOOST_TEST(transport() == tlm::TLM_ADDRESS_ERROR_RESPONSE);
  transaction(tlm::TLM_READ_COMMAND, 0, data, 4);
  BOOST_TEST(transport() == tlm::TLM_ADDRESS_ERROR_RESPONSE);
  transaction(tlm::TLM_READ_COMMAND, 0x1000'0000, data, 8).set_streaming_width(0);
  BOOST_TEST(transport() == tlm::TLM_BURST_ERROR_RESPONSE);
  transaction(tlm::TLM_READ_COMMAND, 0x1000'0000, data, 8).set_byte_enable_ptr(data);
  payload.set_byte_enable_length(0);
  BOOST_TEST(transport() == tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE);
  BOOST_TEST(ddr.reads == 0u);
  BOOST_TEST(ddr.writes == 0u);
}

BOOST_FIXTURE_TEST_CASE(debug_access_reaches_to_the_end, DdrBench) {
  unsigned char data[8] = {1, 2, 3, 4, 5, 6, 7, 8};
  transaction(tlm::TLM_WRITE_COMMAND, 0x1FFF'FFFC, data, 8);
  BOOST_TEST(link.transport_debug(payload) == 4u);
  unsigned char back[4] = {};
  transaction(tlm::TLM_READ_COMMAND, 0x1FFF'FFFC, back, 4);
  BOOST_TEST(link.transport_debug(payload) == 4u);
  BOOST_TEST(std::memcmp(back, data, 4) == 0);
  transaction(tlm::TLM_READ_COMMAND, 0x2000'0000, back, 4);
  BOOST_TEST(link.transport_debug(payload) == 0u);
  transaction(tlm::TLM_IGNORE_COMMAND, Ddr::base, back, 4);
  BOOST_TEST(link.transport_debug(payload) == 0u);
}

BOOST_FIXTURE_TEST_CASE(direct_access_gives_all_of_it, DdrBench) {
  tlm::tlm_dmi dmi;
  transaction(tlm::TLM_READ_COMMAND, 0x1000'0000, nullptr, 0);
  BOOST_TEST(link.direct_memory(payload, dmi));
  BOOST_TEST(dmi.get_start_address() == Ddr::base);
  BOOST_TEST(dmi.get_end_address() == 0x1FFF'FFFFu);
  BOOST_TEST(dmi.get_dmi_ptr() == ddr.behind(Ddr::base));
  BOOST_TEST(dmi.is_read_write_allowed());
  transaction(tlm::TLM_READ_COMMAND, 0, nullptr, 0);
  BOOST_TEST(!link.direct_memory(payload, dmi));
}

BOOST_FIXTURE_TEST_CASE(clear_zeroes_and_frees, DdrBench) {
  const std::uint32_t address = *ddr.dma_memory().allocate(64, 4);
  BOOST_TEST(address == 0x1000'0000u);
  *ddr.at(address) = 42;
  ddr.clear();
  BOOST_TEST(*ddr.at(address) == 0u);
  BOOST_TEST(*ddr.dma_memory().allocate(64, 4) == address);
}

BOOST_AUTO_TEST_CASE(many_one_after_the_other_are_fresh) {
  for (int i = 0; i < 50; ++i) {
    kit::Simulation simulation;
    Ddr ddr("ddr");
    BOOST_TEST(*ddr.at(0x1234'5678) == 0u);
    *ddr.at(0x1234'5678) = 1;
  }
}

// As in a sweep: the host's pages stay, but for what was written, and for access rights.
BOOST_AUTO_TEST_CASE(what_a_platform_hands_on_to_the_next_is_as_new) {
  struct Keeping {
    Keeping() { ps::PlatformMapping::keep(true); }
    ~Keeping() { ps::PlatformMapping::keep(false); }
  };
  constexpr std::uint64_t first = 0x2000'0000, size = 0x10'0000, page = 4096;
  std::optional<Keeping> keeping;
  for (const bool is_kept : {false, true}) {
    if (is_kept) keeping.emplace();
    std::optional<ps::PlatformMapping> mapping(std::in_place, "the test", first, size);
    const unsigned char* const before = (*mapping)->second_view();
    (*mapping)->data()[page + 5] = 42;
    (*mapping)->second_view()[7] = 1;
    mprotect((*mapping)->data() + page, page, PROT_NONE);
    mapping.reset();
    BOOST_TEST(ps::occupant(first, first + size).empty() != is_kept);
    mapping.emplace("the test", first, size);
    if (is_kept) BOOST_TEST((*mapping)->second_view() == before);
    BOOST_TEST((*mapping)->data()[page + 5] == 0);
    BOOST_TEST((*mapping)->data()[7] == 0);
    (*mapping)->data()[page + 5] = 43;
    BOOST_TEST((*mapping)->second_view()[page + 5] == 43);
  }
  // One of another size, or at addresses that overlap, finds room.
  ps::PlatformMapping("the test", first, size);
  BOOST_TEST(ps::PlatformMapping("the test", first, 2 * size)->size() == 2 * size);
  BOOST_TEST(ps::PlatformMapping("the test", first + size, size)->data()[0] == 0);
  ps::PlatformMapping::end_unused();
  BOOST_TEST(ps::occupant(first, first + 2 * size).empty());
}

BOOST_AUTO_TEST_CASE(a_gibibyte) {
  kit::Simulation simulation;
  vp::Configuration configuration;
  configuration.set("ddr.size=1023 MiB");
  const vp::Configuration::Scope scope(configuration);
  Ddr ddr("ddr");
  *ddr.at(0x3FFF'FFFF) = 1;
  BOOST_TEST(ddr.end() == 0x4000'0000u);
}

BOOST_AUTO_TEST_CASE(sizes_that_cannot_be) {
  for (const char* setting : {"ddr.size=2097153 B", "ddr.size=16 MiB", "ddr.size=2 GiB"}) {
    kit::Simulation simulation;
    vp::Configuration configuration;
    configuration.set(setting);  // 16 MiB: the DMA buffers would lie behind the end
    const vp::Configuration::Scope scope(configuration);
    BOOST_CHECK_THROW(Ddr("ddr"), vp::InputError);
  }
}

BOOST_AUTO_TEST_CASE(who_occupies_the_range_is_named) {
  void* wanted = reinterpret_cast<void*>(0x1800'0000);
  void* other =
      mmap(wanted, 4096, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED_NOREPLACE, -1, 0);
  BOOST_REQUIRE(other == wanted);
  kit::Simulation simulation;
  BOOST_CHECK_EXCEPTION(Ddr("ddr"), vp::InputError, [](const auto& error) {
    const std::string text = error.what();
    BOOST_TEST_MESSAGE(text);
    return text.find("0x18000000 to 0x18001000") != std::string::npos &&
           text.find("0x00100000 to 0x20000000") != std::string::npos;
  });
  munmap(other, 4096);
}

BOOST_AUTO_TEST_SUITE_END()
