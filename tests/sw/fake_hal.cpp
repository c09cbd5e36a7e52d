#include "fake_hal.h"
#include <hal/option_data.h>

#include <stdexcept>

namespace fake_hal {
namespace {

State the_state;

/// Where interrupts are taken: as long as one is pending, but with the handler itself masked.
void take_interrupts() {
  State& s = state();
  while (s.enabled && s.handler != nullptr && s.interrupt_pending()) {
    s.enabled = false;
    s.handler(s.handler_context);
    s.enabled = true;
  }
}

}  // namespace

State& state() {
  return the_state;
}

void reset() {
  the_state = State{};
}

std::uint8_t& memory(std::uint32_t bus_address) {
  auto next = state().buffers.upper_bound(bus_address);
  if (next == state().buffers.begin()) throw std::out_of_range("no memory at this bus address");
  auto& [start, bytes] = *std::prev(next);
  return bytes.at(bus_address - start);
}

std::vector<std::uint32_t> writes_to(std::uint32_t address) {
  std::vector<std::uint32_t> values;
  for (const Access& access : state().accesses) {
    if (access.write && access.address == address) values.push_back(access.value);
  }
  return values;
}

}  // namespace fake_hal

using fake_hal::state;

extern "C" {

std::uint32_t hal_read32(std::uint32_t address) {
  if (address % 4 != 0) throw std::logic_error("unaligned register read");
  const auto hook = state().on_read.find(address);
  const std::uint32_t value =
      hook != state().on_read.end() ? hook->second() : state().registers[address];
  if (state().record_accesses) state().accesses.push_back({false, address, value});
  fake_hal::take_interrupts();
  return value;
}

void hal_write32(std::uint32_t address, std::uint32_t value) {
  if (address % 4 != 0) throw std::logic_error("unaligned register write");
  if (state().record_accesses) state().accesses.push_back({true, address, value});
  const auto hook = state().on_write.find(address);
  if (hook != state().on_write.end()) {
    hook->second(value);
  } else {
    state().registers[address] = value;
  }
  fake_hal::take_interrupts();
}

hal_poll_result hal_poll_until_changed(std::uint32_t address, std::uint32_t previous, std::uint32_t,
                                       std::uint32_t limit) {
  hal_poll_result result{previous, 0, false};
  while (result.polls < limit && !result.changed) {
    result.value = hal_read32(address);
    ++result.polls;
    result.changed = result.value != previous;
  }
  return result;
}

void hal_barrier(void) {
  fake_hal::take_interrupts();
}

void hal_cache_flush(const void* data, std::size_t size) {
  state().flushed.emplace_back(data, size);
}

void hal_cache_invalidate(void* data, std::size_t size) {
  state().invalidated.emplace_back(data, size);
}

void hal_cache_all(hal_cache_whole operation) {
  state().whole_cache_operations.push_back(operation);
}

hal_dma_buffer hal_dma_allocate(std::size_t size, std::size_t alignment) {
  if (state().out_of_memory) return {nullptr, 0, size};
  const auto mask = static_cast<std::uint32_t>(alignment - 1);
  const std::uint32_t bus_address = (state().next_bus_address + mask) & ~mask;
  state().next_bus_address = bus_address + static_cast<std::uint32_t>(size);
  auto& bytes = state().buffers[bus_address];
  bytes.resize(size);
  return {bytes.data(), bus_address, size};
}

void hal_interrupt_connect(hal_interrupt_handler handler, void* context) {
  state().handler = handler;
  state().handler_context = context;
}

bool hal_interrupt_enable(bool enable) {
  const bool before = state().enabled;
  state().enabled = enable;
  return before;
}

void hal_wait_for_interrupt(void) {
  ++state().sleeps;
  if (!state().interrupt_pending()) state().on_idle();
  if (!state().interrupt_pending()) throw std::logic_error("the program would sleep for ever");
  fake_hal::take_interrupts();
}

void hal_console_write(const char* text, std::size_t length) {
  state().console.append(text, length);
}

// One core, undisturbed.
unsigned hal_cpu_number(void) {
  return 0;
}

void hal_cpu_start(unsigned, void (*)(void)) {
  throw std::logic_error("there is no second core");
}

void hal_wait_for_event(void) {
  throw std::logic_error("no other core sends an event");
}

void hal_send_event(void) {}

std::uint32_t hal_load_acquire(const volatile std::uint32_t* word) {
  return *word;
}

void hal_store_release(volatile std::uint32_t* word, std::uint32_t value) {
  *word = value;
}

void hal_lock_acquire(hal_lock* lock) {
  lock->taken = 1;
}

void hal_lock_release(hal_lock* lock) {
  lock->taken = 0;
}

void hal_shared_read(const volatile void*, size_t) {}
void hal_shared_write(volatile void*, size_t) {}

void hal_warn(const char* text) {
  state().warnings.emplace_back(text);
}

const hal_frame* hal_frame_next(void) {
  if (state().next_frame == state().frames.size()) return nullptr;
  return &state().frames[state().next_frame++];
}

void hal_publish(std::uint32_t kind, const void* data, std::size_t size) {
  const auto* bytes = static_cast<const std::uint8_t*>(data);
  state().publications.push_back({kind, {bytes, bytes + size}});
}

double hal_option(std::uint32_t option) {
  return state().options[option];
}

const void* hal_option_data(std::uint32_t option, std::size_t* size) {
  const std::string& data = state().option_data[option];
  *size = data.size();
  return data.empty() ? nullptr : data.data();
}

std::uint32_t hal_xpar(const char* name, std::uint32_t built_in) {
  const auto found = state().xparameters.find(name);
  return found != state().xparameters.end() ? found->second : built_in;
}

void hal_work(std::uint32_t item, std::uint64_t count) {
  state().work[item] += count;
}

void hal_function_enter(std::uint32_t function) {
  state().function_stack.push_back(function);
  ++state().function_calls[function];
}

void hal_function_leave(void) {
  if (state().function_stack.empty()) throw std::logic_error("left a function never entered");
  state().function_stack.pop_back();
}

}  // extern "C"
