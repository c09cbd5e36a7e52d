// The native back end of the HAL: each function goes to the processor whose program runs. What
// they do, but for those that only make time pass (cpu_catch_up.cpp).
#include <hal/hal.h>
#include <hal/native_program.h>
#include <hal/option_data.h>

#include <ps/cpu/cpu.h>
#include <ps/cpu/program_watch.h>
#include <ps/memory/memory.h>
#include <vp/report.h>

namespace ps {

std::uint32_t Cpu::read32(std::uint32_t address) {
  return access(true, address, 0);
}

void Cpu::write32(std::uint32_t address, std::uint32_t value) {
  access(false, address, value);
}

void Cpu::barrier() {
  ++barriers;
  spend_cycles(settings_.barrier_cycles);
  catch_up();
}

void Cpu::maintain_cache(CacheCall call, const void* data, std::size_t size) {
  constexpr std::uintptr_t line = DmaAllocator::cache_line;
  const auto first = reinterpret_cast<std::uintptr_t>(data) / line;
  const auto end = (reinterpret_cast<std::uintptr_t>(data) + size + line - 1) / line;
  const std::uint64_t lines = size == 0 ? 0 : end - first;
  cache_lines.add(lines);
  spend_cycles(settings_.cache_call_cycles + settings_.cache_line_cycles * lines);
  barrier();
  tell_cache(call, data, size);
}

void Cpu::tell_cache(CacheCall call, const void* data, std::size_t size) const {
  const CacheListener& listener = cores_->all.front()->cache_listener_;
  if (listener) listener(call, reinterpret_cast<std::uintptr_t>(data), size);
}

void Cpu::maintain_all(hal_cache_whole operation) {
  spend_cycles(settings_.cache_call_cycles);
  if (operation != HAL_CACHE_ENABLE) spend_cycles(settings_.cache_all_cycles);
  barrier();
  bool& off = cores_->all.front()->caches_off_;
  switch (operation) {
    case HAL_CACHE_FLUSH:
      return tell_cache(CacheCall::flush_all, nullptr, 0);
    case HAL_CACHE_INVALIDATE:
      return tell_cache(CacheCall::invalidate_all, nullptr, 0);
    case HAL_CACHE_DISABLE:
      if (!off) tell_cache(CacheCall::disable, nullptr, 0);
      off = true;
      return;
    case HAL_CACHE_ENABLE:
      if (off) tell_cache(CacheCall::enable, nullptr, 0);
      off = false;
      return;
  }
  misuse("hal_cache_all(" + std::to_string(operation) + "): no such operation");
}

void Cpu::set_cached(const void* data, std::size_t size, bool cached) {
  maintain_all(HAL_CACHE_FLUSH);
  tell_cache(cached ? CacheCall::cache : CacheCall::uncache, data, size);
}

hal_dma_buffer Cpu::allocate_dma(std::size_t size, std::size_t alignment) {
  hal_dma_buffer buffer{nullptr, 0, size};
  DmaAllocator* const memory = cores_->all.front()->dma_memory_;
  if (!memory) return buffer;
  if (const auto address = memory->allocate(size, alignment)) {
    buffer.bus_address = *address;
    buffer.data = reinterpret_cast<void*>(std::uintptr_t{*address});
  }
  return buffer;
}

void Cpu::write_console(const char* text, std::size_t length) {
  look_at(text, length);
  catch_up();
  cores_->all.front()->console.write(text, length);
}

// What came before the call comes first.
void Cpu::warn(const char* text) {
  catch_up();
  vp::warn(*this, "/markervp/cpu/program", text);
}

const hal_frame* Cpu::next_frame() {
  if (number_ != 0) misuse("hal_frame_next(): inputs go to the first core");
  catch_up();
  if (bench_) sleep_until(bench_->next_frame_ps(now_ps()));
  const hal_frame* next = bench_ ? bench_->next_frame(now_ps()) : nullptr;
  scheduler_.forget_horizon();
  if (next) {
    frame = frame + 1;
    deadline_.set_timeout(now_ps() + settings_.timeout);
    start_ahead();
  }
  return next;
}

void Cpu::publish(std::uint32_t kind, const void* data, std::size_t size) {
  if (number_ != 0) misuse("hal_publish(): results come from the first core");
  look_at(data, size);
  catch_up();
  if (!bench_ || bench_->publish(kind, data, size, now_ps())) results = results + 1;
  scheduler_.forget_horizon();
}

double Cpu::option(std::uint32_t option) {
  const hal_program& program = program_->description();
  if (option >= program.option_count) {
    misuse("hal_option(" + std::to_string(option) + "): no such option");
  }
  const hal_option_info& info = program.options[option];
  TestBench* const bench = cores_->all.front()->bench_;
  return bench ? bench->option(option, info) : info.default_value;
}

std::string_view Cpu::option_data(std::uint32_t option) {
  const hal_program& program = program_->description();
  if (option >= program.option_count ||
      program.options[option].unit != std::string_view(HAL_UNIT_FILE)) {
    misuse("hal_option_data(" + std::to_string(option) + "): no such option of a file");
  }
  TestBench* const bench = cores_->all.front()->bench_;
  return bench ? bench->option_data(option) : std::string_view();
}

std::uint32_t Cpu::xparameter(const char* name, std::uint32_t built_in) {
  TestBench* const bench = cores_->all.front()->bench_;
  return bench ? bench->xparameter(name).value_or(built_in) : built_in;
}

std::string Cpu::name_of_function() const {
  if (function == 0 || !program_) return {};
  return program_->description().functions[function - 1];
}

// Without the place in the file, which changes with every build.
std::string Cpu::name_of_handler() const {
  if (!in_handler) return {};
  const std::string name =
      code_ ? code_->symbol(reinterpret_cast<std::uintptr_t>(irq_.handler())) : std::string();
  return name.empty() ? "handler" : name;
}

}  // namespace ps

namespace {

template <class Call>
auto on_cpu(const char* name, Call call) {
  ps::Cpu& cpu = ps::Cpu::running(name);
  return cpu.guarded([&] { return call(cpu); });
}

/// The program has run for a while without a call of the HAL.
void look_at_loop(bool is_empty) {
  using Watch = ps::ProgramWatch;
  if (Watch::stop != Watch::Stop::none) {
    if (vp::FaultTrap::can_leave()) vp::FaultTrap::leave_at_stop();
    return;
  }
  const unsigned before = Watch::suspicions();
  on_cpu("a loop", [&](ps::Cpu& cpu) { cpu.notice_loop(before, is_empty); });
  Watch::suspect_again(before);
}

}  // namespace

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

void hal_cache_all(hal_cache_whole operation) {
  on_cpu("hal_cache_all", [&](ps::Cpu& cpu) { cpu.maintain_all(operation); });
}

void hal_memory_cached(const void* data, size_t size, bool cached) {
  on_cpu("hal_memory_cached", [&](ps::Cpu& cpu) { cpu.set_cached(data, size, cached); });
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

void hal_after_interrupt(void (*hook)(void)) {
  on_cpu("hal_after_interrupt", [&](ps::Cpu& cpu) { cpu.after_interrupt(hook); });
}

void hal_wait_for_interrupt(void) {
  on_cpu("hal_wait_for_interrupt", [](ps::Cpu& cpu) { cpu.wait_for_interrupt(); });
}

unsigned hal_cpu_number(void) {
  return on_cpu("hal_cpu_number", [](ps::Cpu& cpu) { return cpu.number(); });
}

void hal_cpu_start(unsigned cpu, void (*entry)(void)) {
  on_cpu("hal_cpu_start", [&](ps::Cpu& self) { self.start_core(cpu, entry); });
}

void hal_wait_for_event(void) {
  on_cpu("hal_wait_for_event", [](ps::Cpu& cpu) { cpu.wait_for_event(); });
}

void hal_send_event(void) {
  on_cpu("hal_send_event", [](ps::Cpu& cpu) { cpu.send_event(); });
}

uint32_t hal_load_acquire(const volatile uint32_t* word) {
  return on_cpu("hal_load_acquire", [&](ps::Cpu& cpu) { return cpu.load_acquire(word); });
}

void hal_store_release(volatile uint32_t* word, uint32_t value) {
  on_cpu("hal_store_release", [&](ps::Cpu& cpu) { cpu.store_release(word, value); });
}

uint32_t hal_load_exclusive(const volatile uint32_t* word) {
  return on_cpu("hal_load_exclusive", [&](ps::Cpu& cpu) { return cpu.load_exclusive(word); });
}

bool hal_store_exclusive(volatile uint32_t* word, uint32_t value) {
  return on_cpu("hal_store_exclusive",
                [&](ps::Cpu& cpu) { return cpu.store_exclusive(word, value); });
}

void hal_lock_acquire(hal_lock* lock) {
  on_cpu("hal_lock_acquire", [&](ps::Cpu& cpu) { cpu.acquire(*lock); });
}

void hal_lock_release(hal_lock* lock) {
  on_cpu("hal_lock_release", [&](ps::Cpu& cpu) { cpu.release(*lock); });
}

void hal_shared_read(const volatile void* data, size_t size) {
  on_cpu("hal_shared_read", [&](ps::Cpu& cpu) { cpu.access_shared(false, data, size); });
}

void hal_shared_write(volatile void* data, size_t size) {
  on_cpu("hal_shared_write", [&](ps::Cpu& cpu) { cpu.access_shared(true, data, size); });
}

void hal_console_write(const char* text, size_t length) {
  on_cpu("hal_console_write", [&](ps::Cpu& cpu) { cpu.write_console(text, length); });
}

void hal_warn(const char* text) {
  on_cpu("hal_warn", [&](ps::Cpu& cpu) { cpu.warn(text); });
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

const void* hal_option_data(uint32_t option, size_t* size) {
  const std::string_view data =
      on_cpu("hal_option_data", [&](ps::Cpu& cpu) { return cpu.option_data(option); });
  *size = data.size();
  return data.empty() ? nullptr : data.data();
}

uint32_t hal_xpar(const char* name, uint32_t built_in) {
  return on_cpu("hal_xpar", [&](ps::Cpu& cpu) { return cpu.xparameter(name, built_in); });
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
  const bool counts = Watch::block_counts || Watch::charge;
  if (Watch::stop == Watch::Stop::none && counts &&
      Watch::count_block(reinterpret_cast<std::uintptr_t>(__builtin_return_address(0))))
    return;
  look_at_loop(false);
}

// Programs whose code takes time call it when they have used up what they may at once.
void markervp_charge_spent(void) {
  if (ps::ProgramWatch::runs) look_at_loop(false);
}

}  // extern "C"

void ps::Cpu::make_access(PointerAccess& access) {
  on_cpu("a pointer to a register", [&](ps::Cpu& cpu) { cpu.access_by_pointer(access); });
  access.resume();
}

void ps::look_at_empty_loop() {
  look_at_loop(true);
}
