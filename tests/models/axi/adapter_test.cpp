// The adapters of a link back to back: bytes, bursts, responses and exact times.
#include <boost/test/unit_test.hpp>

#include <array>
#include <cstdint>
#include <numeric>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <vp/configuration.h>
#include <vp/report.h>

#include "adapter_bench.h"

namespace {

constexpr auto reading = tlm::TLM_READ_COMMAND;
constexpr auto writing = tlm::TLM_WRITE_COMMAND;

/// Least latencies on both sides of the link.
struct Fast {
  Fast() {
    configuration.set("pair.subordinate.read_latency", "1 cycles");
    configuration.set("pair.subordinate.write_latency", "1 cycles");
  }
  vp::Configuration configuration;
  vp::Configuration::Scope scope{configuration};
};

struct Bench : Fast, kit::AdapterBench {
  explicit Bench(const axi::Shape& shape = {}, bool stalls = false) : AdapterBench(shape, stalls) {
    std::iota(memory.bytes.begin(), memory.bytes.end(), static_cast<unsigned char>(0));
    pair.watch = [this](const axi::Wires& wires) {
      for (const auto* channel : {&wires.aw, &wires.ar}) {
        if (channel->passes()) requests.push_back(channel->beat);
      }
    };
  }
  std::vector<axi::Address> requests;  ///< that passed, both directions
};

struct Lite : Bench {
  static axi::Shape lite() {
    axi::Shape shape;
    shape.lite = true;
    shape.burst_beats = 1;
    return shape;
  }
  Lite() : Bench(lite()) {}
};

std::array<unsigned char, 2048> buffer;

}  // namespace

BOOST_FIXTURE_TEST_CASE(a_word_takes_two_clocks_each_way, Bench) {
  memory.direct = true;
  software.simulate([&] {
    software.wait_until(period);
    BOOST_TEST(access(writing, 0x100, buffer.data(), 4) == 2u);
    BOOST_TEST(access(reading, 0x100, buffer.data(), 4) == 2u);
  });
  BOOST_TEST(requests.size() == 2u);
  BOOST_TEST(pair.manager.stalls == 0u);
}

BOOST_FIXTURE_TEST_CASE(a_burst_of_n_beats_takes_n_plus_1, Bench) {
  memory.direct = true;
  software.simulate([&] {
    software.wait_until(period);
    BOOST_TEST(access(writing, 0x200, buffer.data(), 64) == 17u);
    BOOST_TEST(access(reading, 0x200, buffer.data(), 64) == 17u);
    BOOST_TEST(access(reading, 0x204, buffer.data(), 64) == 17u);  // no natural alignment
  });
  BOOST_TEST(requests.size() == 3u);
  BOOST_TEST(requests[2].beats == 16u);
}

BOOST_FIXTURE_TEST_CASE(an_access_begins_at_the_first_edge_behind_its_delay, Bench) {
  memory.direct = true;
  software.simulate([&] {
    software.prepare(reading, 0, buffer.data(), 4);
    software.delay = sc_core::sc_time(23, sc_core::SC_NS);
    software.send();
    BOOST_TEST(kit::now_ps() == 50'000u);  // edge at 30 ns, and two more
  });
}

BOOST_FIXTURE_TEST_CASE(unaligned_bytes_are_exact, Bench) {
  memory.direct = true;
  software.simulate([&] {
    const std::vector<unsigned char> written{1, 2, 3, 4, 5, 6};
    std::copy(written.begin(), written.end(), buffer.begin());
    software.wait_until(period);
    BOOST_TEST(access(writing, 0x301, buffer.data(), 6) == 3u);
    access(reading, 0x301, buffer.data(), 6);
    BOOST_TEST(std::equal(written.begin(), written.end(), buffer.begin()));
  });
  BOOST_TEST(memory.bytes[0x300] == 0x00);
  BOOST_TEST(memory.bytes[0x307] == 0x07);  // untouched
  BOOST_TEST(requests[0].address == 0x301u);
  BOOST_TEST(requests[0].beats == 2u);
}

BOOST_FIXTURE_TEST_CASE(one_byte_touches_one_byte, Bench) {
  software.simulate([&] { access(reading, 0x501, buffer.data(), 1); });
  BOOST_TEST(buffer[0] == 0x01);
  BOOST_REQUIRE(memory.accesses.size() == 1u);
  BOOST_TEST(memory.accesses[0].address == 0x501u);
  BOOST_TEST(memory.accesses[0].length == 1u);
}

BOOST_FIXTURE_TEST_CASE(a_streaming_width_of_a_beat_is_a_fixed_burst, Bench) {
  software.simulate([&] {
    buffer[0] = 1, buffer[4] = 2, buffer[8] = 3;
    access(writing, 0x400, buffer.data(), 12, 4);
    access(reading, 0x401, buffer.data(), 3, 1);
  });
  BOOST_REQUIRE(requests.size() == 2u);
  BOOST_TEST((requests[0].burst == axi::BurstType::fixed));
  BOOST_TEST(requests[0].beats == 3u);
  BOOST_TEST(requests[1].size == 0u);
  BOOST_TEST(memory.bytes[0x400] == 3);  // the last one
  BOOST_TEST(memory.accesses[0].width == 4u);
  BOOST_TEST(memory.accesses[1].width == 1u);
}

BOOST_FIXTURE_TEST_CASE(another_streaming_width_is_a_burst_for_each_round, Bench) {
  software.simulate([&] { access(writing, 0x402, buffer.data(), 12, 6); });
  BOOST_TEST(requests.size() == 2u);
  BOOST_TEST(requests[1].address == 0x402u);
}

BOOST_FIXTURE_TEST_CASE(bursts_split_at_4_kib_and_at_the_limit_of_beats, Bench) {
  software.simulate([&] {
    access(reading, 0xFF8, buffer.data(), 16);
    access(reading, 0x2000, buffer.data(), 1028);
  });
  BOOST_REQUIRE(requests.size() == 4u);
  BOOST_TEST(requests[0].beats == 2u);
  BOOST_TEST(requests[1].address == 0x1000u);
  BOOST_TEST(requests[2].beats == 256u);
  BOOST_TEST(requests[3].address == 0x2400u);
}

BOOST_FIXTURE_TEST_CASE(byte_enables_repeat_with_their_length, Bench) {
  unsigned char enables[] = {TLM_BYTE_ENABLED, TLM_BYTE_DISABLED};
  software.simulate([&] {
    std::fill(buffer.begin(), buffer.end(), static_cast<unsigned char>(0xAA));
    software.prepare(writing, 0x600, buffer.data(), 8);
    software.payload.set_byte_enable_ptr(enables);
    software.payload.set_byte_enable_length(2);
    software.send();
    std::fill(buffer.begin(), buffer.end(), static_cast<unsigned char>(0x55));
    software.prepare(reading, 0x600, buffer.data(), 8);
    software.payload.set_byte_enable_ptr(enables);
    software.payload.set_byte_enable_length(2);
    software.send();
  });
  BOOST_TEST(memory.bytes[0x600] == 0xAA);
  BOOST_TEST(memory.bytes[0x601] == 0x01);
  BOOST_TEST(buffer[0] == 0xAA);
  BOOST_TEST(buffer[1] == 0x55);
}

BOOST_FIXTURE_TEST_CASE(every_error_arrives, Bench) {
  software.simulate([&] {
    access(reading, 0x2'0000, buffer.data(), 4);
    BOOST_TEST(software.response() == tlm::TLM_ADDRESS_ERROR_RESPONSE);
    access(writing, 0x2'0000, buffer.data(), 64);
    BOOST_TEST(software.response() == tlm::TLM_ADDRESS_ERROR_RESPONSE);
    for (const auto error : {tlm::TLM_BURST_ERROR_RESPONSE, tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE,
                             tlm::TLM_COMMAND_ERROR_RESPONSE, tlm::TLM_GENERIC_ERROR_RESPONSE}) {
      memory.answer = error;
      for (const auto command : {reading, writing}) {
        access(command, 0x100, buffer.data(), 8);
        BOOST_TEST(software.response() == tlm::TLM_GENERIC_ERROR_RESPONSE);
      }
    }
    // The worst of two bursts: the second one lies where nothing answers.
    memory.answer = tlm::TLM_OK_RESPONSE;
    access(reading, memory_size - 8, buffer.data(), 16);
    BOOST_TEST(software.response() == tlm::TLM_ADDRESS_ERROR_RESPONSE);
  });
}

BOOST_FIXTURE_TEST_CASE(what_is_no_access_never_moves_the_pins, Bench) {
  software.simulate([&] {
    access(tlm::TLM_IGNORE_COMMAND, 0, buffer.data(), 4);
    BOOST_TEST(software.response() == tlm::TLM_COMMAND_ERROR_RESPONSE);
    access(reading, 0, buffer.data(), 0);
    BOOST_TEST(software.response() == tlm::TLM_BURST_ERROR_RESPONSE);
    access(reading, 0, buffer.data(), 4, 0);
    BOOST_TEST(software.response() == tlm::TLM_BURST_ERROR_RESPONSE);
    BOOST_TEST(kit::now_ps() == 0u);
  });
  BOOST_TEST(requests.empty());
}

namespace {

struct FewAddressBits : Bench {
  static axi::Shape shape() {
    axi::Shape shape;
    shape.address_bits = 6;
    return shape;
  }
  FewAddressBits() : Bench(shape()) { reports.redirect(text); }
  vp::ReportRouter reports;
  std::ostringstream text;
};

}  // namespace

BOOST_FIXTURE_TEST_CASE(an_address_beyond_its_pins_is_warned_of_once, FewAddressBits) {
  software.simulate([&] {
    access(reading, 0x3C, buffer.data(), 4);
    BOOST_TEST(reports.count("/markervp/axi/address_bits") == 0u);
    access(reading, 0x3C, buffer.data(), 8);
    access(reading, 0x40, buffer.data(), 4);
  });
  BOOST_TEST(reports.count("/markervp/axi/address_bits") == 1u);
  BOOST_TEST(text.str().find("8 bytes from 0x0000003C") != std::string::npos, text.str());
}

BOOST_FIXTURE_TEST_CASE(lite_has_single_words_one_behind_the_other, Lite) {
  software.simulate([&] {
    software.wait_until(period);
    // One clock more than with memory that gives direct access: the target is called in between.
    BOOST_TEST(access(writing, 0x100, buffer.data(), 16) == 6u);
    BOOST_TEST(access(reading, 0x102, buffer.data(), 2) == 3u);
    BOOST_TEST(access(writing, 0x106, buffer.data(), 2) == 3u);
  });
  BOOST_TEST(requests.size() == 6u);
  BOOST_TEST(memory.accesses.size() == 6u);
  // The target sees whole words (IHI0022 B1.1), of a write the bytes that are written.
  for (const auto& [number, at] : {std::pair{4u, 0x100u}, {5u, 0x104u}}) {
    BOOST_TEST(memory.accesses[number].address == at);
    BOOST_TEST(memory.accesses[number].length == 4u);
  }
  BOOST_TEST(memory.bytes[0x105] == buffer[5]);
  BOOST_TEST(memory.bytes[0x106] == buffer[0]);
}

BOOST_FIXTURE_TEST_CASE(a_slow_target_holds_its_answer_back, Bench) {
  memory.delay_of_all = sc_core::sc_time(100, sc_core::SC_NS);
  software.simulate([&] {
    software.wait_until(period);
    BOOST_TEST(access(reading, 0x100, buffer.data(), 4) == 13u);
    BOOST_TEST(access(writing, 0x100, buffer.data(), 4) == 13u);
  });
}

BOOST_AUTO_TEST_CASE(latencies_are_parameters) {
  kit::AdapterBench bench;
  bench.software.simulate([&] {
    bench.software.wait_until(bench.period);
    BOOST_TEST(bench.access(reading, 0, buffer.data(), 4) == 21u);
    BOOST_TEST(bench.access(writing, 0, buffer.data(), 4) == 21u);
  });
}
