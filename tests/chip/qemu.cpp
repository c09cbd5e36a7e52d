#include "qemu.h"

#include <sstream>

#include "child_process.h"

namespace {

/// A program that hangs is a failed test, not a test that hangs.
constexpr const char* timeout_tool = "/usr/bin/timeout";
constexpr const char* longest_run = "60";

const std::string folder = MARKERVP_CHIP_ELF;

ChipRun run(std::vector<std::string> command) {
  command.insert(command.begin(), longest_run);
  const kit::Outcome outcome = kit::run_process(timeout_tool, command, folder);
  ChipRun result{outcome.exit_code, {}, {}};
  std::istringstream text(outcome.out);
  for (std::string line; std::getline(text, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    const bool is_message = line.rfind("chip: ", 0) == 0;
    (is_message ? result.messages : result.lines).push_back(line);
  }
  return result;
}

}  // namespace

ChipRun boot(const std::string& name) {
  // Time follows the instructions instead of the host's clock, and a sleep takes none of the
  // host's.
  return run({MARKERVP_QEMU_SYSTEM_ARM, "-icount", "shift=1,sleep=off", "-M", "xilinx-zynq-a9",
              "-m", "512M", "-display", "none", "-monitor", "none", "-serial", "null", "-serial",
              "stdio", "-semihosting", "-no-reboot", "-kernel", name + ".elf"});
}

ChipRun run_hosted(const std::string& name) {
  return run({MARKERVP_QEMU_ARM, "-cpu", "cortex-a9", name + ".elf"});
}
