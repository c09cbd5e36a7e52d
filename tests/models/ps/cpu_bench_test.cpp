// Console, images, results, options and DMA memory.
#include <boost/test/unit_test.hpp>
#include <cstring>
#include <optional>

#include <ps/memory/memory.h>

#include <hal/option_data.h>

#include "bench.h"

using namespace bench;

namespace {

struct Recorder : ps::TestBench {
  const hal_frame* next_frame(std::uint64_t now_ps) override {
    asked.push_back(now_ps);
    frame.index = static_cast<std::uint32_t>(asked.size() - 1);
    return frame.index < frames ? &frame : nullptr;
  }
  bool publish(std::uint32_t kind, const void* data, std::size_t size, std::uint64_t now) override {
    results.push_back({kind, std::string(static_cast<const char*>(data), size), now});
    return true;
  }
  double option(std::uint32_t option, const hal_option_info& info) override {
    return info.maximum + option;
  }
  std::string_view option_data(std::uint32_t option) override {
    return option == 1 ? "what is in it" : "";
  }
  std::optional<std::uint32_t> xparameter(const char* name) override {
    if (std::strcmp(name, "TIMER_BASEADDR") == 0) return 0x4567'0000;
    return std::nullopt;
  }

  struct Result {
    std::uint32_t kind;
    std::string data;
    std::uint64_t ps;
  };
  hal_frame frame{};
  std::uint32_t frames = 2;
  std::vector<std::uint64_t> asked;
  std::vector<Result> results;
};

void print(const char* text) {
  hal_console_write(text, std::strlen(text));
}

}  // namespace

BOOST_AUTO_TEST_SUITE(cpu_bench)

BOOST_AUTO_TEST_CASE(images_and_results_at_exact_times) {
  Bench b({"cpu.timeout=1 us"});  // two images of 0.8 us: an image starts it anew
  Recorder bench;
  b.cpu.connect(bench);
  b.run([] {
    while (const hal_frame* frame = hal_frame_next()) {
      hal_work(step, 800);
      char text[] = {'a', static_cast<char>('0' + frame->index)};
      hal_publish(HAL_KIND('t', 'e', 's', 't'), text, sizeof text);
      text[0] = 'x';
    }
    return 0;
  });
  const std::vector<std::uint64_t> asked{0, 800'000, 1'600'000};
  BOOST_TEST(bench.asked == asked, boost::test_tools::per_element());
  BOOST_REQUIRE(bench.results.size() == 2u);
  BOOST_TEST(bench.results[1].kind == 0x7473'6574u);
  BOOST_TEST(bench.results[1].data == "a1");
  BOOST_TEST(bench.results[1].ps == 1'600'000u);
}

BOOST_AUTO_TEST_CASE(options_come_from_the_bench) {
  Recorder bench;
  Bench b;
  b.run([] {
    BOOST_TEST(hal_option(0) == 4.0);
    return 0;
  });
  Bench c;
  c.cpu.connect(bench);
  c.run([] {
    BOOST_TEST(hal_option(0) == 20.0);
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(files_of_options_come_from_the_bench) {
  Recorder bench;
  Bench b;
  b.run([] {
    std::size_t size = 1;
    BOOST_TEST(hal_option_data(1, &size) == nullptr);
    BOOST_TEST(size == 0u);
    return 0;
  });
  Bench c;
  c.cpu.connect(bench);
  c.run([] {
    std::size_t size = 0;
    const auto* data = static_cast<const char*>(hal_option_data(1, &size));
    BOOST_TEST(std::string(data, size) == "what is in it");
    return 0;
  });
}

#define XPAR_TIMER_BASEADDR 0x4000'0000u

BOOST_AUTO_TEST_CASE(addresses_come_from_the_bench) {
  Recorder bench;
  Bench b;
  b.run([] {
    BOOST_TEST(HAL_XPAR(TIMER_BASEADDR) == 0x4000'0000u);
    return 0;
  });
  Bench c;
  c.cpu.connect(bench);
  c.run([] {
    BOOST_TEST(HAL_XPAR(TIMER_BASEADDR) == 0x4567'0000u);
    BOOST_TEST(hal_xpar("COUNTER_BASEADDR", 7) == 7u);
    return 0;
  });
  BOOST_TEST(c.cpu.end_ps() == 0u);
}

BOOST_AUTO_TEST_CASE(without_bench_there_are_no_images) {
  Bench b;
  b.run([] {
    hal_publish(0, "", 0);
    return hal_frame_next() ? 1 : 0;
  });
  BOOST_TEST(b.cpu.exit_code() == 0);
}

BOOST_AUTO_TEST_CASE(the_console_makes_lines) {
  Bench b;
  std::vector<std::string> lines;
  b.cpu.console.connect([&](const std::string& line) { lines.push_back(line); }, "hybrid: ");
  b.run([&] {
    print("two ");
    BOOST_TEST(lines.empty());
    print("words\r\n\nlast");
    return 0;
  });
  const std::vector<std::string> expected{"hybrid: two words", "hybrid: ", "hybrid: last"};
  BOOST_TEST(lines == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(text_without_line_end_does_not_pile_up) {
  Bench b;
  std::vector<std::size_t> lengths;
  b.cpu.console.connect([&](const std::string& line) { lengths.push_back(line.size()); });
  b.run([&] {
    for (int i = 0; i < 65'537; ++i) print("a");
    return 0;
  });
  const std::vector<std::size_t> expected{65'536, 1};
  BOOST_TEST(lengths == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(dma_memory_has_one_number_as_pointer_and_bus_address) {
  Bench b;
  ps::DmaAllocator memory(0x1000'0000, 0x1000'1000);
  b.cpu.connect(memory);
  b.run([] {
    const hal_dma_buffer first = hal_dma_allocate(33, 4);
    BOOST_TEST(first.bus_address == 0x1000'0000u);
    BOOST_TEST(reinterpret_cast<std::uintptr_t>(first.data) == 0x1000'0000u);
    BOOST_TEST(first.size == 33u);
    BOOST_TEST(hal_dma_allocate(1, 4).bus_address == 0x1000'0040u);
    BOOST_TEST(hal_dma_allocate(1, 1024).bus_address == 0x1000'0400u);
    const hal_dma_buffer too_large = hal_dma_allocate(0x1000, 4);
    BOOST_TEST(!too_large.data);
    BOOST_TEST(too_large.bus_address == 0u);
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(without_dma_memory_there_is_none) {
  Bench b;
  b.run([] { return hal_dma_allocate(1, 4).data ? 1 : 0; });
  BOOST_TEST(b.cpu.exit_code() == 0);
}

BOOST_AUTO_TEST_CASE(a_bus_observer_sees_the_accesses) {
  Bench b;
  b.run([] {
    hal_write32(device_address, 1);
    hal_read32(device_address);
    return 0;
  });
  BOOST_TEST(b.cpu.m_axi.reads == 1u);
  BOOST_TEST(b.cpu.m_axi.writes == 1u);
}

/// Image n comes at n x 2 us. An interrupt comes at 3 us.
struct Camera : Recorder {
  std::uint64_t next_frame_ps(std::uint64_t now_ps) override {
    wanted.push_back(now_ps);
    return std::max<std::uint64_t>(now_ps, wanted.size() * 2'000'000 - 2'000'000);
  }
  std::vector<std::uint64_t> wanted;
};

// 0.8 us of work on each. The time-out of 1 us does not count while it waits.
BOOST_AUTO_TEST_CASE(a_program_sleeps_until_the_camera_has_an_image) {
  Bench b({"cpu.timeout=1 us"});
  Camera bench;
  b.cpu.connect(bench);
  b.run([] {
    while (hal_frame_next()) hal_work(step, 800);
    return 0;
  });
  BOOST_TEST(bench.wanted == (std::vector<std::uint64_t>{0, 800'000, 2'800'000}),
             boost::test_tools::per_element());
  BOOST_TEST(bench.asked == (std::vector<std::uint64_t>{0, 2'000'000, 4'000'000}),
             boost::test_tools::per_element());
  BOOST_TEST(b.cpu.activity().busy_ps() == 1'600'000u);
  BOOST_TEST(b.cpu.activity().idle_ps() == 2'400'000u);
  BOOST_TEST(!b.cpu.asleep);
}

BOOST_AUTO_TEST_SUITE_END()
