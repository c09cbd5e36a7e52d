// gdb on a PS program: breakpoints in it, its variables, and the hardware's registers.
#include <boost/test/unit_test.hpp>

#include "installation.h"

using namespace install_test;

namespace {

/// gdb is there, and may trace processes (containers often forbid it).
bool gdb_works() {
  const std::string gdb = MARKERVP_GDB;
  if (gdb.empty()) return false;
  const kit::Outcome outcome =
      kit::run_process(gdb, {"-nx", "-batch", "-ex", "run", "/bin/true"}, "/");
  return contains(outcome.out, "exited normally");
}

}  // namespace

BOOST_AUTO_TEST_SUITE(debugger)

BOOST_AUTO_TEST_CASE(a_breakpoint_with_live_registers) {
  if (!gdb_works()) {
    BOOST_TEST_MESSAGE("left out: gdb is missing or may not trace");
    return;
  }
  const Installation& installed = Installation::get();
  installed.build(installed / "share/markervp/examples/04_own_program", "template");
  kit::write_file(installed.beside("session.gdb"),
                  "break on_tick\nrun\nbacktrace 1\nsimtime\nregisters private_timer\n"
                  "peek 0xF8F0060C\nregisters nonsense\nnext\nnext\nprint ticks\npeek 0x41200000\n"
                  "delete\ncontinue\n");
  const kit::Outcome outcome = installed.run(
      MARKERVP_GDB, {"-nx", "-batch", "-x", installed / "share/markervp/markervp.gdb", "-x",
                     "session.gdb", "--args", installed / "bin/markervp", "run", "--program",
                     installed.beside("template/first.so"), "--output", "gdb_out"});
  if (contains(outcome.err, "Couldn't write extended state status")) {
    BOOST_TEST_MESSAGE("left out: gdb is older than the processor and cannot restore its vectors");
    return;
  }
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  std::size_t at = 0;
  for (const char* part : {
           "#0", "on_tick", "main.cpp",           // stopped in the handler
           "1.00",                                // ms
           "0xF8F00600", "LOAD",                  // the timer's first register
           "0xF8F0060C  0x00000001",              // its event
           "0x00000001",                          // peeked
           "no device 'nonsense'", "axi_gpio_0",  // with the names there are
           "$1 = 1",                              // ticks
           "0x00000100",                          // the output
           "interrupt 3 after 3000 us",           // it continues, and no time was lost
       }) {
    const std::size_t found = outcome.out.find(part, at);
    BOOST_TEST((found != std::string::npos), part << " is not in its place in:\n" << outcome.out);
    if (found != std::string::npos) at = found;
  }
}

BOOST_AUTO_TEST_SUITE_END()
