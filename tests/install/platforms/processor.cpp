// A processor with DDR, nothing else, and a program that is part of the executable.
#include <hal/hal.h>
#include <pl/common/simd_target.h>
#include <ps/cpu/cpu.h>
#include <ps/cpu/cpu_time.h>
#include <ps/cpu/program.h>
#include <ps/memory/memory.h>
#include <vp/clock.h>
#include <vp/clock_scheduler.h>
#include <vp/error.h>

#include <cstring>
#include <iostream>
#include <systemc>

namespace {

int program() {
  const char text[] = "hello from the program\n";
  const hal_dma_buffer buffer = hal_dma_allocate(sizeof text, 32);
  std::memcpy(buffer.data, text, sizeof text);
  hal_console_write(reinterpret_cast<const char*>(std::uintptr_t{buffer.bus_address}),
                    std::strlen(text));
  return 5;
}

const hal_program description = {HAL_ABI, "hello", program, nullptr, 0, nullptr, 0, nullptr, 0};

struct Platform : sc_core::sc_module {
  explicit Platform(sc_core::sc_module_name name) : sc_module(name) {
    cpu.m_axi.socket.bind(ddr.socket);
    cpu.connect(ddr.dma_memory());
    cpu.console.connect([](const std::string& line) { std::cout << line << std::endl; });
  }

  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock cpu_clk{"cpu_clk", scheduler, 666'666'667};
  ps::Cpu cpu{"cpu", cpu_clk};
  ps::Ddr ddr{"ddr"};
};

}  // namespace

int sc_main(int, char**) {
  try {
    Platform platform("platform");
    const auto hello = ps::Program::linked(description);
    platform.cpu.load(*hello, ps::CostTable("none"));
    sc_core::sc_start();
    platform.cpu.check();
    std::cout << "ended with " << platform.cpu.exit_code() << std::endl;
    return pl::simd_targets().empty() ? 1 : 0;
  } catch (const vp::InputError& error) {
    std::cerr << error.what() << std::endl;
    return 2;
  }
}
