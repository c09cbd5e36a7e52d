#pragma once

#include <string>
#include <vector>

/// What a program printed and how it ended.
struct ChipRun {
  int exit_code;
  std::vector<std::string> lines;     ///< the program's own
  std::vector<std::string> messages;  ///< the HAL's, which begin with "chip: "
};

/// Boots NAME.elf in QEMU's Zynq; the console is UART 1.
ChipRun boot(const std::string& name);

/// Runs NAME.elf in QEMU's user mode.
ChipRun run_hosted(const std::string& name);
