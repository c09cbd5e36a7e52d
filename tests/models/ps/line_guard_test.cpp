// Reads of guarded cache lines, by the program's own instructions.
#include <boost/test/unit_test.hpp>

#include <ps/cpu/line_guard.h>
#include <ps/cpu/load_emulation.h>
#include <ps/memory/memory.h>
#include <ucontext.h>

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

// Loads are executed in the program's place, anything else by a step.
BOOST_AUTO_TEST_CASE(whatever_reads_beside_guarded_lines_gets_what_is_there) {
  guard.read_from(memory.second_view());
  for (unsigned i = 0; i < line; ++i)
    memory.second_view()[i] = static_cast<unsigned char>(0xF1 + i);
  guard.guard(first + line, line);
  run([&] {
    BOOST_TEST(*reinterpret_cast<volatile std::uint8_t*>(first + 1) == 0xF2u);
    BOOST_TEST(*reinterpret_cast<volatile std::int8_t*>(first + 1) == -14);
    BOOST_TEST(*reinterpret_cast<volatile std::uint16_t*>(first + 2) == 0xF4F3u);
    BOOST_TEST(*reinterpret_cast<volatile std::int16_t*>(first + 2) == -0x0B0D);
    BOOST_TEST(*reinterpret_cast<volatile std::uint32_t*>(first + 4) == 0xF8F7F6F5u);
    BOOST_TEST(*reinterpret_cast<volatile std::uint64_t*>(first) == 0xF8F7F6F5F4F3F2F1u);
    BOOST_TEST(told.empty());
    static_cast<void>(read(first + line));
  });
  BOOST_TEST(told.size() == 1u);
}

#if defined(__x86_64__)
BOOST_AUTO_TEST_CASE(plain_loads_are_executed_and_no_other_instruction) {
  struct Case {
    std::vector<unsigned char> code;
    std::uint64_t loaded;  ///< into RAX
  };
  // RDX is the address less 0x10, RCX 2, RAX all ones.
  const Case plain[] = {
      {{0x0F, 0xB6, 0x42, 0x10}, 0x81},                // movzx eax, byte [rdx+16]
      {{0x0F, 0xB7, 0x42, 0x10}, 0x8281},              // movzx eax, word [rdx+16]
      {{0x48, 0x0F, 0xB6, 0x44, 0xCA, 0x00}, 0x81},    // movzx rax, byte [rdx+8*rcx]
      {{0x8B, 0x42, 0x10}, 0x84838281},                // mov eax, [rdx+16]
      {{0x48, 0x8B, 0x42, 0x10}, 0x8887868584838281},  // mov rax, [rdx+16]
  };
  const std::vector<unsigned char> others[] = {
      {0x0F, 0xBE, 0x42, 0x10},        // movsx eax, byte [rdx+16]
      {0x66, 0x8B, 0x42, 0x10},        // mov ax, [rdx+16]
      {0x8A, 0x42, 0x10},              // mov al, [rdx+16]
      {0x03, 0x42, 0x10},              // add eax, [rdx+16]
      {0x89, 0x42, 0x10},              // mov [rdx+16], eax
      {0x0F, 0xB6, 0x42, 0x11},        // movzx eax, byte [rdx+17]: not what faulted
      {0x64, 0x0F, 0xB6, 0x42, 0x10},  // movzx eax, byte fs:[rdx+16]
      {0x06, 0x90, 0x90, 0x90},        // no instruction
  };
  const unsigned char source[] = {0x81, 0x82, 0x83, 0x84, 0x85, 0x86, 0x87, 0x88};
  ucontext_t context{};
  auto& registers = context.uc_mcontext.gregs;
  std::vector<unsigned char> code;
  const auto execute = [&](std::vector<unsigned char> instruction, std::size_t most) {
    code = std::move(instruction);
    code.resize(code.size() + 16, 0x90);
    registers[REG_RIP] = reinterpret_cast<greg_t>(code.data());
    registers[REG_RDX] = first - 0x10;
    registers[REG_RCX] = 2;
    registers[REG_RAX] = -1;
    return ps::emulate_load(&context, first, source, most);
  };
  for (const Case& load : plain) {
    BOOST_TEST(execute(load.code, sizeof source));
    BOOST_TEST(static_cast<std::uint64_t>(registers[REG_RAX]) == load.loaded);
    BOOST_TEST(registers[REG_RIP] == reinterpret_cast<greg_t>(code.data() + load.code.size()));
  }
  for (const auto& instruction : others) {
    BOOST_TEST(!execute(instruction, sizeof source));
    BOOST_TEST(registers[REG_RAX] == -1);
    BOOST_TEST(registers[REG_RIP] == reinterpret_cast<greg_t>(code.data()));
  }
  BOOST_TEST(!execute(plain[4].code, 7));  // it would reach into the next page
}
#endif

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
