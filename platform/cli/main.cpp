#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include <cli/program.h>
#include <host/process.h>
#include <host/stack_limit.h>
#include <vp/foreign_object.h>

/// libsystemc refers to sc_main; the program has a main() of its own.
extern "C" int sc_main(int, char**) {
  return 1;
}

int main(int argc, char* argv[]) {
  platform::host::fill_standard_descriptors();
  const int ready = platform::host::exit_code_of(
      [&] {
        platform::host::ensure_stack(argv);
        return platform::host::done;
      },
      std::cerr);
  if (ready != platform::host::done) return ready;
  platform::host::prepare_signals();
  ::setenv("SYSTEMC_DISABLE_COPYRIGHT_MESSAGE", "1", 1);
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  int code = platform::host::exit_code_of(
      [&] {
        int ended = platform::host::done;
        vp::call_objects(
            [&] { ended = platform::cli::run_program(arguments, std::cout, std::cerr); });
        return ended;
      },
      std::cerr);
  if (code == platform::host::done) {
    code = platform::host::exit_code_of(
        [] {
          platform::host::check_standard_output();
          return platform::host::done;
        },
        std::cerr);
  }
  vp::exit_with_objects(code);
}
