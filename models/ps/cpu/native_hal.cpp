// The native back end of the HAL: each call goes to the processor whose program runs.
#include <hal/hal.h>

#include <ps/cpu/cpu.h>
#include <ps/cpu/native_hal.h>
#include <ps/cpu/program_watch.h>

namespace {

template <class Call>
auto on_cpu(const char* name, Call call) {
  ps::Cpu& cpu = ps::Cpu::running(name);
  return cpu.guarded([&] { return call(cpu); });
}

}  // namespace

namespace ps {

void use_native_hal() {}

}  // namespace ps

extern "C" {

uint32_t hal_read32(uint32_t address) {
  return on_cpu("hal_read32", [&](ps::Cpu& cpu) { return cpu.read32(address); });
}

void hal_write32(uint32_t address, uint32_t value) {
  on_cpu("hal_write32", [&](ps::Cpu& cpu) { cpu.write32(address, value); });
}

hal_poll_result hal_poll_until_changed(uint32_t address, uint32_t previous, uint32_t cycles,
                                       uint32_t limit) {
  return on_cpu("hal_poll_until_changed", [&](ps::Cpu& cpu) {
    return cpu.poll_until_changed(address, previous, cycles, limit);
  });
}

void hal_barrier(void) {
  on_cpu("hal_barrier", [](ps::Cpu& cpu) { cpu.barrier(); });
}

void hal_cache_flush(const void* data, size_t size) {
  on_cpu("hal_cache_flush",
         [&](ps::Cpu& cpu) { cpu.maintain_cache(ps::Cpu::CacheCall::flush, data, size); });
}

void hal_cache_invalidate(void* data, size_t size) {
  on_cpu("hal_cache_invalidate",
         [&](ps::Cpu& cpu) { cpu.maintain_cache(ps::Cpu::CacheCall::invalidate, data, size); });
}

hal_dma_buffer hal_dma_allocate(size_t size, size_t alignment) {
  return on_cpu("hal_dma_allocate",
                [&](ps::Cpu& cpu) { return cpu.allocate_dma(size, alignment); });
}

void hal_interrupt_connect(hal_interrupt_handler handler, void* context) {
  on_cpu("hal_interrupt_connect", [&](ps::Cpu& cpu) { cpu.connect_interrupt(handler, context); });
}

bool hal_interrupt_enable(bool enable) {
  return on_cpu("hal_interrupt_enable", [&](ps::Cpu& cpu) { return cpu.enable_interrupt(enable); });
}

void hal_wait_for_interrupt(void) {
  on_cpu("hal_wait_for_interrupt", [](ps::Cpu& cpu) { cpu.wait_for_interrupt(); });
}

void hal_console_write(const char* text, size_t length) {
  on_cpu("hal_console_write", [&](ps::Cpu& cpu) { cpu.write_console(text, length); });
}

const hal_frame* hal_frame_next(void) {
  return on_cpu("hal_frame_next", [](ps::Cpu& cpu) { return cpu.next_frame(); });
}

void hal_publish(uint32_t kind, const void* data, size_t size) {
  on_cpu("hal_publish", [&](ps::Cpu& cpu) { cpu.publish(kind, data, size); });
}

double hal_option(uint32_t option) {
  return on_cpu("hal_option", [&](ps::Cpu& cpu) { return cpu.option(option); });
}

void hal_work(uint32_t item, uint64_t count) {
  on_cpu("hal_work", [&](ps::Cpu& cpu) { cpu.do_work(item, count); });
}

void hal_function_enter(uint32_t function) {
  on_cpu("hal_function_enter", [&](ps::Cpu& cpu) { cpu.enter_function(function); });
}

void hal_function_leave(void) {
  on_cpu("hal_function_leave", [](ps::Cpu& cpu) { cpu.leave_function(); });
}

// Programs call it in every basic block.
void __sanitizer_cov_trace_pc(void) {
  using Watch = ps::ProgramWatch;
  if (--Watch::blocks_left != 0 || !Watch::runs) return;
  if (Watch::stop != Watch::Stop::none) {
    if (ps::FaultTrap::can_leave()) ps::FaultTrap::leave_at_stop();
    return;
  }
  const unsigned before = Watch::suspicions();
  on_cpu("a loop", [before](ps::Cpu& cpu) { cpu.notice_loop(before); });
  Watch::suspect_again(before);
}

}  // extern "C"
