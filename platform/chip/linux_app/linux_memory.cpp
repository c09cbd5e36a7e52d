// The memory that a Linux application shares with devices: u-dma-bufs, and what it maps of
// /dev/mem.
#include <algorithm>
#include <cerrno>
#include <cstdlib>

#include <chip/linux_app/linux_run.h>
#include <vp/text.h>

namespace platform {

namespace {

constexpr std::size_t buffer_alignment = 4096;

/// A whole number as the kernel reads it: decimal, 0x or 0. None: it is no number.
std::optional<std::uint64_t> number_in(const std::string& text) {
  char* end = nullptr;
  errno = 0;
  const std::uint64_t value = std::strtoull(text.c_str(), &end, 0);
  if (end == text.c_str() || errno != 0 || text.front() == '-') return std::nullopt;
  if (std::string(end).find_first_not_of(" \n") != std::string::npos) return std::nullopt;
  return value;
}

}  // namespace

void LinuxRun::make_buffers() {
  const auto size = static_cast<std::size_t>(devices_->udmabuf_size);
  std::uint64_t fixed = devices_->udmabuf_address;
  for (std::size_t i = 0; i < devices_->udmabufs; ++i) {
    Buffer buffer;
    if (fixed != 0) {
      buffer.base = fixed;
      fixed += (size + buffer_alignment - 1) / buffer_alignment * buffer_alignment;
    } else {
      const hal_dma_buffer memory = hal_dma_allocate(size, buffer_alignment);
      if (memory.data == nullptr) fail("no memory is left for /dev/udmabuf" + std::to_string(i));
      buffer.base = memory.bus_address;
    }
    buffer.size = buffer.sync_size = size;
    show(buffer, i);
    buffers_.push_back(buffer);
    memory_.emplace_back(buffer.base, buffer.base + size);
    print("linux: /dev/udmabuf" + std::to_string(i) + " has " + std::to_string(buffer.size) +
          " bytes at " + vp::hex(static_cast<std::uint32_t>(buffer.base)));
  }
}

// What the caches do not hold needs no maintenance. What is mapped of /dev/mem is the application's
// to keep free of Linux.
void LinuxRun::map(const Request& request) {
  const std::uint64_t end = request.a + request.b;
  if ((request.c & linux_app::of_buffer) == 0 && !owner_problem(request.a, request.b).empty()) {
    memory_.emplace_back(request.a, end);
    print(
        "linux: " + std::to_string(request.b) + " bytes of the DDR at " +
        vp::hex(static_cast<std::uint32_t>(request.a)) +
        " are mapped by /dev/mem: on the board keep them free of Linux, by reserved-memory in the "
        "device tree or mem= of the kernel");
  }
  bool cached = (request.c & linux_app::o_sync) == 0;
  if ((request.c & linux_app::of_buffer) != 0) {
    const std::uint64_t mode = buffers_.at(request.c >> 8).sync_mode;
    cached = (mode & 3) == 0 || (cached && (mode & 4) == 0);
  }
  if (!cached) caches_->placed(request.a, std::min(request.b, zynq_->ps.ddr.end() - request.a));
}

/// What is wrong with a device's access there; "" if the application owns that memory.
std::string LinuxRun::owner_problem(std::uint64_t address, std::uint64_t bytes) const {
  for (const auto& [first, end] : memory_)
    if (first <= address && address + bytes <= end) return {};
  const std::string place = vp::hex(static_cast<std::uint32_t>(address));
  std::string owned;
  for (std::size_t i = 0; i < buffers_.size(); ++i) {
    owned += "/dev/udmabuf" + std::to_string(i) + " has " + std::to_string(buffers_[i].size) +
             " bytes at " + vp::hex(static_cast<std::uint32_t>(buffers_[i].base)) + "; ";
  }
  return place +
         ", which is no memory of the application's: on the board Linux has its own data "
         "there. " +
         owned +
         "take the address that phys_addr says, or, if the program has it as a constant, "
         "set linux.udmabuf_address=" +
         place + ", or map that memory by /dev/mem";
}

// The driver's documentation: github.com/ikwzm/udmabuf.
void LinuxRun::show(const Buffer& buffer, std::size_t number) const {
  folder_->write("/dev/udmabuf" + std::to_string(number), "");
  show(number, "phys_addr", vp::hex(static_cast<std::uint32_t>(buffer.base)));
  show(number, "size", std::to_string(buffer.size));
  show(number, "sync_mode", std::to_string(buffer.sync_mode));
  show(number, "sync_size", std::to_string(buffer.sync_size));
  for (const char* const zero : {"sync_offset", "sync_direction", "sync_for_cpu", "sync_for_device",
                                 "sync_owner", "dma_coherent"})
    show(number, zero, "0");
}

void LinuxRun::show(std::size_t number, const std::string& attribute,
                    const std::string& value) const {
  folder_->write("/sys/class/u-dma-buf/udmabuf" + std::to_string(number) + "/" + attribute,
                 value + "\n");
}

/// What was written to an attribute; an errno, or 0.
int LinuxRun::store(Buffer& buffer, std::size_t number, const std::string& text) {
  const std::size_t space = text.find(' ');
  const std::string name = text.substr(0, space);
  const std::optional<std::uint64_t> value = number_in(text.substr(space + 1));
  if (!value) return EINVAL;
  if (name == "sync_for_cpu") return synchronise(buffer, false, *value);
  if (name == "sync_for_device") return synchronise(buffer, true, *value);
  constexpr std::uint64_t last_mode = 7, last_direction = 2;
  const std::pair<const char*, std::pair<std::uint64_t*, std::uint64_t>> numbers[] = {
      {"sync_mode", {&buffer.sync_mode, last_mode}},
      {"sync_offset", {&buffer.sync_offset, buffer.size}},
      {"sync_size", {&buffer.sync_size, buffer.size}},
      {"sync_direction", {&buffer.sync_direction, last_direction}}};
  for (const auto& [attribute, target] : numbers) {
    if (name != attribute) continue;
    if (*value > target.second) return EINVAL;
    *target.first = *value;
    show(number, name, std::to_string(*value));
    return 0;
  }
  return EACCES;
}

// 1 takes what the other attributes say; a larger number says it itself: offset in the upper half,
// then size, direction in bits 3:2, and bit 0. Which way caches are maintained is that of
// arch/arm/mm/dma-mapping.c.
int LinuxRun::synchronise(const Buffer& buffer, bool for_device, std::uint64_t value) const {
  std::uint64_t offset = buffer.sync_offset, size = buffer.sync_size;
  std::uint64_t direction = buffer.sync_direction;
  if (value > 1) {
    offset = value >> 32;
    size = value & 0xFFFF'FFF0;
    direction = value >> 2 & 3;
  }
  constexpr std::uint64_t to_device = 1, from_device = 2;
  if (direction > from_device || offset > buffer.size || size > buffer.size - offset) return EINVAL;
  if ((value & 1) == 0) return 0;
  auto* const data = reinterpret_cast<void*>(static_cast<std::uintptr_t>(buffer.base + offset));
  if (for_device && direction != from_device) {
    hal_cache_flush(data, size);
  } else if (for_device || direction != to_device) {
    hal_cache_invalidate(data, size);
  }
  return 0;
}

}  // namespace platform
