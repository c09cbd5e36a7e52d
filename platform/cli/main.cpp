#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include <cli/interrupt.h>
#include <cli/program.h>
#include <cli/zynq_simulation.h>

/// libsystemc refers to sc_main; the program has a main() of its own.
int sc_main(int, char**) {
  return 1;
}

int main(int argc, char* argv[]) {
  platform::cli::end_at_interrupts();
  ::setenv("SYSTEMC_DISABLE_COPYRIGHT_MESSAGE", "1", 1);
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  return platform::cli::run_program(arguments, platform::cli::make_zynq_simulation, std::cout,
                                    std::cerr);
}
