// Reads of guarded cache lines, by the program's own instructions.
#include <boost/test/unit_test.hpp>

#include <ps/cpu/line_guard.h>
#include <ps/memory/memory.h>

#include "bench.h"

using namespace bench;

namespace {

constexpr std::uintptr_t page = 4096, line = ps::LineGuard::line;
constexpr std::uintptr_t first = 0x2000'0000, end = first + 8 * page;

constexpr unsigned steps = 1'000;

struct Guarded {
  Guarded()
      : guard(first, end, steps, [this](std::uintptr_t address) { told.push_back(address); }) {}

  /// Runs a program that reads and writes the memory.
  void run(std::function<void()> body) {
    Bench().run([&] {
      hal_barrier();  // what is guarded is closed when the program runs again
      body();
      return 0;
    });
  }

  ps::FixedMapping memory{"the test", first, end - first};
  std::vector<std::uintptr_t> told;
  ps::LineGuard guard;
};

volatile unsigned char& at(std::uintptr_t address) {
  return *reinterpret_cast<volatile unsigned char*>(address);
}
unsigned char read(std::uintptr_t address) {
  return at(address);
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(line_guard, Guarded)

BOOST_AUTO_TEST_CASE(reads_of_guarded_lines_are_told_once_a_line) {
  memory.second_view()[line + 5] = 42;
  guard.guard(first + line, 2 * line);
  run([&] {
    BOOST_TEST(read(first + line + 5) == 42);
    BOOST_TEST(read(first + line + 6) == 0);
    BOOST_TEST(read(first + 3 * line - 1) == 0);
  });
  const std::vector<std::uintptr_t> expected{first + line + 5, first + 3 * line - 1};
  BOOST_TEST(told == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(what_lies_beside_them_may_be_read_and_written) {
  guard.guard(first + line, line);
  run([&] {
    at(first + line - 1) = 7;
    BOOST_TEST(read(first + line - 1) == 7);
    BOOST_TEST(read(first + 2 * line) == 0);
    BOOST_TEST(told.empty());
    static_cast<void>(read(first + line));
  });
  BOOST_TEST(told.size() == 1u);
}

BOOST_AUTO_TEST_CASE(the_simulator_sees_the_memory_from_elsewhere) {
  guard.guard(first, page);
  run([&] {
    memory.second_view()[3] = 9;
    BOOST_TEST(memory.second_view()[3] == 9);
    BOOST_TEST(told.empty());
    BOOST_TEST(read(first + 3) == 9);
  });
  BOOST_TEST(told.size() == 1u);
}

BOOST_AUTO_TEST_CASE(who_writes_a_line_may_read_it) {
  guard.guard(first, 2 * line);
  run([&] {
    at(first + 1) = 7;
    BOOST_TEST(read(first + 1) == 7);
    BOOST_TEST(told.empty());
    static_cast<void>(read(first + line));
  });
  BOOST_TEST(told.size() == 1u);
}

BOOST_AUTO_TEST_CASE(released_lines_are_free) {
  guard.guard(first + page - line, 2 * page);
  guard.release(first + page - line, page);
  run([&] {
    static_cast<void>(read(first + page - 1));
    static_cast<void>(read(first + 2 * page - line - 1));
    BOOST_TEST(told.empty());
    static_cast<void>(read(first + 2 * page - line));
  });
  BOOST_TEST(told.size() == 1u);
}

BOOST_AUTO_TEST_CASE(an_instruction_may_need_two_pages) {
  guard.guard(first + line, line);
  guard.guard(first + page + line, line);
  run([&] {
    struct __attribute__((packed)) Anywhere {
      std::uint32_t word;
    };
    const std::uint32_t word = reinterpret_cast<const volatile Anywhere*>(first + page - 2)->word;
    BOOST_TEST(word == 0u);
    BOOST_TEST(told.empty());
    static_cast<void>(read(first + line));
    static_cast<void>(read(first + page + line));
  });
  BOOST_TEST(told.size() == 2u);
}

// The others are guarded as before.
BOOST_AUTO_TEST_CASE(who_runs_out_of_steps_is_left_alone) {
  guard.guard(first + line, 2 * page);
  guard.guard(first + 5 * page, page);
  run([&] {
    for (unsigned i = 0; i <= steps; ++i) static_cast<void>(read(first));
    static_cast<void>(read(first + line));
    static_cast<void>(read(first + page));
    BOOST_TEST(told.empty());
    static_cast<void>(read(first + 5 * page));
  });
  BOOST_TEST(told.size() == 1u);
}

// A quarter of the steps is theirs, 8 a page; what is guarded keeps its own.
BOOST_AUTO_TEST_CASE(watched_lines_are_offered_as_long_as_wanted) {
  std::vector<std::uintptr_t> offered;
  bool wanted = true;
  guard.on_watched([&](std::uintptr_t address, std::uintptr_t) {
    offered.push_back(address);
    return wanted;
  });
  guard.watch(first, page);
  guard.watch(first + page, page);
  guard.guard(first + page + line, line);
  guard.watch(first + 2 * page, page);
  guard.forget(first + 2 * page, line);
  run([&] {
    for (int i = 0; i < 3; ++i) static_cast<void>(read(first + 5));
    wanted = false;
    for (int i = 0; i < 3; ++i) static_cast<void>(read(first + 5));
    BOOST_TEST(offered.size() == 4u);
    for (int i = 0; i < 8; ++i) static_cast<void>(read(first + 5));  // steps of the page
    static_cast<void>(read(first + line));
    BOOST_TEST(offered.size() == 4u);
    static_cast<void>(read(first + page + line));
    BOOST_TEST(offered.size() == 5u);
    BOOST_TEST(told.size() == 1u);
    static_cast<void>(read(first + 2 * page));
    BOOST_TEST(offered.size() == 5u);
    static_cast<void>(read(first + 2 * page + line));
    BOOST_TEST(offered.size() == 6u);
    at(first + 2 * page + 2 * line) = 1;
    static_cast<void>(read(first + 2 * page + 2 * line));
    BOOST_TEST(offered.size() == 6u);
  });
}

BOOST_AUTO_TEST_CASE(who_is_stopped_guards_nothing) {
  guard.guard(first, page);
  guard.stop();
  guard.guard(first, page);
  run([&] { static_cast<void>(read(first)); });
  BOOST_TEST(told.empty());
}

BOOST_AUTO_TEST_SUITE_END()
