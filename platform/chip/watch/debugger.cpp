#include <chip/watch/debugger.h>

#include <ps/cpu/line_guard.h>

#include <chip/system/hardware_map.h>
#include <vp/kernel.h>
#include <vp/text.h>
#include <vp/unit.h>
#include <csignal>
#include <iostream>
#include <optional>
#include <utility>

namespace platform {

namespace {

Zynq* debugged = nullptr;

/// The program's innermost call that is under way was compiled without debug information.
bool is_without_lines() {
  const ps::CodeLocator* const code = debugged ? debugged->ps.cpu.code() : nullptr;
  if (!code) return false;
  for (const std::uintptr_t call : ps::return_addresses()) {
    if (code->contains(call)) return !code->knows_line(call);
  }
  return false;
}

void print(const facts::HardwareMap::Device& device) {
  for (const facts::HardwareMap::Register& r : device.registers) {
    if (!r.built) continue;
    const auto address = static_cast<std::uint32_t>(device.base + r.offset);
    const std::optional<std::uint32_t> word = debugged->peek(address);
    std::cout << vp::hex(address) << "  " << (word ? vp::hex(*word) : "no answer ") << "  "
              << r.name << "\n";
  }
}

}  // namespace

Debugged::Debugged(Zynq& zynq) {
  debugged = &zynq;
}

Debugged::~Debugged() {
  debugged = nullptr;
}

// From here on no page is guarded: the debugger would stop at each fault.
void stop_for_debugger(const std::string& what) {
  ps::LineGuard::program_is_over();
  std::cout << "stopped: " << what << "\n";
  if (is_without_lines()) {
    std::cout << "the program has no debug information there: compile it with -g, as "
                 "markervp_add_program() does\n";
  }
  std::cout << std::flush;
  markervp_stop();
}

}  // namespace platform

using platform::debugged;

extern "C" {

std::uint32_t markervp_peek(std::uint32_t address) {
  return debugged ? debugged->peek(address).value_or(0xFFFF'FFFF) : 0xFFFF'FFFF;
}

void markervp_registers(const char* device) {
  if (!debugged) return;
  std::vector<std::string> names;
  for (const auto& candidate : platform::hardware_map(*debugged).devices) {
    if (candidate.registers.empty()) continue;
    if (candidate.name == device) {
      platform::print(candidate);
      std::cout << std::flush;
      return;
    }
    names.push_back(candidate.name);
  }
  std::cout << "no device '" << device << "' with registers: choose " << vp::one_of(names)
            << std::endl;
}

void markervp_time() {
  if (!debugged) return;
  const ps::Cpu& cpu = debugged->ps.cpu;
  std::cout << vp::format_time(debugged->scheduler.now_ps());
  const std::uint32_t function = cpu.activity().function();
  if (function != ps::Activity::none) {
    std::cout << ", in '" << cpu.activity().functions().at(function).name << "'";
  }
  std::cout << std::endl;
}

int markervp_is_program(const void* address) {
  const ps::CodeLocator* const code = debugged ? debugged->ps.cpu.code() : nullptr;
  return code && code->contains(reinterpret_cast<std::uintptr_t>(address)) ? 1 : 0;
}

__attribute__((noinline)) void markervp_stop() {
  static bool waits = true;
  if (std::exchange(waits, false)) vp::raise_again(SIGSTOP);
}

}  // extern "C"
