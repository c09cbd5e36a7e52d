// What the HAL's functions do, but for those that only make time pass (cpu_time.cpp).
#include <ps/cpu/cpu.h>

namespace ps {

std::uint32_t Cpu::read32(std::uint32_t address) {
  return access(true, address, 0);
}

void Cpu::write32(std::uint32_t address, std::uint32_t value) {
  access(false, address, value);
}

void Cpu::barrier() {
  ++barriers;
  spend_cycles(barrier_cycles);
  catch_up();
}

void Cpu::maintain_cache(CacheCall call, const void* data, std::size_t size) {
  constexpr std::uintptr_t line = DmaAllocator::cache_line;
  const auto first = reinterpret_cast<std::uintptr_t>(data) / line;
  const auto end = (reinterpret_cast<std::uintptr_t>(data) + size + line - 1) / line;
  const std::uint64_t lines = size == 0 ? 0 : end - first;
  cache_lines.add(lines);
  spend_cycles(cache_call_cycles + cache_line_cycles * lines);
  barrier();
  if (cache_listener_) cache_listener_(call, reinterpret_cast<std::uintptr_t>(data), size);
}

hal_dma_buffer Cpu::allocate_dma(std::size_t size, std::size_t alignment) {
  hal_dma_buffer buffer{nullptr, 0, size};
  if (!dma_memory_) return buffer;
  if (const auto address = dma_memory_->allocate(size, alignment)) {
    buffer.bus_address = *address;
    buffer.data = reinterpret_cast<void*>(std::uintptr_t{*address});
  }
  return buffer;
}

void Cpu::connect_interrupt(hal_interrupt_handler handler, void* context) {
  catch_up();
  handler_ = handler;
  handler_context_ = context;
}

bool Cpu::enable_interrupt(bool enable) {
  catch_up();
  const bool was_enabled = !masked_;
  masked_ = !enable;
  take_interrupts();
  return was_enabled;
}

void Cpu::write_console(const char* text, std::size_t length) {
  look_at(text, length);
  catch_up();
  console.write(text, length);
}

const hal_frame* Cpu::next_frame() {
  catch_up();
  const hal_frame* next = bench_ ? bench_->next_frame(now_ps()) : nullptr;
  scheduler_.forget_horizon();
  if (next) {
    frame = frame + 1;
    deadline_ps_ = now_ps() + timeout;
    start_ahead();
  }
  return next;
}

void Cpu::publish(std::uint32_t kind, const void* data, std::size_t size) {
  look_at(data, size);
  catch_up();
  if (bench_) bench_->publish(kind, data, size, now_ps());
  results = results + 1;
  scheduler_.forget_horizon();
}

double Cpu::option(std::uint32_t option) {
  const hal_program& program = program_->description();
  if (option >= program.option_count) {
    misuse("hal_option(" + std::to_string(option) + "): no such option");
  }
  const hal_option_info& info = program.options[option];
  return bench_ ? bench_->option(option, info) : info.default_value;
}

std::string Cpu::name_of_function() const {
  if (function == 0 || !program_) return {};
  return program_->description().functions[function - 1];
}

// Without the place in the file, which changes with every build.
std::string Cpu::name_of_handler() const {
  if (!in_handler || !code_) return in_handler ? "handler" : "";
  const std::string place = code_->text(reinterpret_cast<std::uintptr_t>(handler_));
  const auto from = place.find(' '), to = place.rfind('+');
  if (from == std::string::npos || to == std::string::npos || to < from) return "handler";
  return place.substr(from + 1, to - from - 1);
}

}  // namespace ps
