// A shared object with the interface of Verilated RTL that is not one: its registers are those of
// the model's core, for noise of 64 x 32 pixels. THRESHOLD, DELAY in clocks, and no RESET of the
// pipeline plant bugs; without STATE it does not show what its evaluations depend on. Evaluation
// KILLED_AT ends the process.
#include <pl/common/rtl_interface.h>
#include <pl/corner_detection/core.h>

#include <array>
#include <csignal>
#include <cstring>

#include <sys/syscall.h>
#include <unistd.h>

namespace {

/// As by another process: raise() and kill() would be noticed before.
void be_killed() {
  long number = SYS_kill;
  asm volatile("syscall" : "+a"(number) : "D"(::getpid()), "S"(SIGKILL) : "rcx", "r11", "memory");
}

struct Pins {
  std::uint8_t clk, ena, rst, pixel, corner_out;
  std::uint16_t x, y;
  std::uint32_t corner_data;
};

class CornerObject {
 public:
  struct Output {
    std::uint32_t valid, word;
  };
  struct State {
    Pins pins;
    std::uint64_t core;  ///< represents it: how often it changed
    std::array<Output, pl::CornerCore::latency + 1 + DELAY> pipeline;
    std::uint8_t clk_before;
  };

  static std::uint64_t evaluations;  ///< of all objects
  State state{};

  void eval() {
    ++evaluations;
    if (evaluations == KILLED_AT) be_killed();
    if (state.pins.clk && !state.clk_before) edge();
    state.clk_before = state.pins.clk;
  }

 private:
  void edge() {
    Pins& pins = state.pins;
    auto& pipeline = state.pipeline;
    std::memmove(&pipeline[1], &pipeline[0], (pipeline.size() - 1) * sizeof pipeline[0]);
    pipeline[0] = {};
    if (pins.rst) {
      core_.reset();
      state.core = 0;
      if (RESET) pipeline = {};
    } else if (pins.ena) {
      pl::Corner corner;
      ++state.core;
      if (core_.push(pins.pixel, pins.x, pins.y, corner)) {
        pipeline[0] = {
            1, geometry_.words().corner(corner.strength, corner.direction, corner.x, corner.y)};
      }
    }
    pins.corner_out = static_cast<std::uint8_t>(pipeline.back().valid);
    pins.corner_data = pipeline.back().word;  // nothing while corner_out is low: not the model's
  }

  pl::Geometry geometry_{64, 32};
  pl::CornerCore core_{geometry_, THRESHOLD};
};

std::uint64_t CornerObject::evaluations = 0;

CornerObject& of(void* model) {
  return *static_cast<CornerObject*>(model);
}

const RtlPort ports[] = {
    {"clk", 1, 0, "corner.sv:1"},        {"ena", 1, 0, "corner.sv:2"},
    {"rst", 1, 0, "corner.sv:3"},        {"pixel", 8, 0, "corner.sv:4"},
    {"x", 10, 0, "corner.sv:5"},         {"y", 9, 0, "corner.sv:6"},
    {"corner_out", 1, 1, "corner.sv:7"}, {"corner_data", 32, 1, "corner.sv:8"},
};

void* pin(void* model, std::uint32_t port) {
  Pins& pins = of(model).state.pins;
  void* const places[] = {&pins.clk, &pins.ena, &pins.rst,        &pins.pixel,
                          &pins.x,   &pins.y,   &pins.corner_out, &pins.corner_data};
  return places[port];
}

const RtlDescriptor descriptor = {
    RTL_INTERFACE,
    "corner_detection",
    "corner",
    "corner.sv:1",
    sizeof ports / sizeof *ports,
    ports,
    0,
    nullptr,
    0,
    nullptr,
    [](const char*, std::uint64_t) -> void* { return new CornerObject; },
    [](void* model) { delete &of(model); },
    [](void* model) -> const RtlEnd* {
      of(model).eval();
      return nullptr;
    },
    nullptr,
    [](void*) -> const RtlEnd* { return nullptr; },
    nullptr,
    pin,
    STATE ? sizeof(CornerObject::State) : 0,
    [](void* model) -> const void* { return &of(model).state; },
    0,
    nullptr,
    nullptr};

}  // namespace

extern "C" __attribute__((visibility("default"))) const RtlDescriptor* markervp_rtl(void) {
  return &descriptor;
}

extern "C" __attribute__((visibility("default"))) std::uint64_t evaluations(void) {
  return CornerObject::evaluations;
}
