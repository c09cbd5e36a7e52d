#include <sys/mman.h>

#include <ps/ddr/fixed_mapping.h>
#include <vp/error.h>
#include <vp/text.h>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

namespace ps {

namespace {

/// The first mapping of this process that lies in [first, end): "/usr/bin/x at 0x400000 to
/// 0x452000".
std::string occupant(std::uint64_t first, std::uint64_t end) {
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    std::istringstream fields(line);
    std::uint64_t from = 0, to = 0;
    char dash = 0;
    fields >> std::hex >> from >> dash >> to;
    if (!fields || to <= first || from >= end) continue;
    std::string permissions, offset, device, inode, name;
    fields >> permissions >> offset >> device >> inode;
    std::getline(fields >> std::ws, name);
    if (name.empty()) name = "memory without a name (another platform in this process?)";
    return name + " at " + vp::hex(from) + " to " + vp::hex(to);
  }
  return {};
}

}  // namespace

FixedMapping::FixedMapping(const std::string& what, std::uint64_t first, std::uint64_t size)
    : size_(size) {
  void* wanted = reinterpret_cast<void*>(first);
  void* got = mmap(wanted, size, PROT_READ | PROT_WRITE,
                   MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_FIXED_NOREPLACE, -1, 0);
  if (got == wanted) {
    data_ = static_cast<unsigned char*>(got);
    return;
  }
  const std::string reason = got == MAP_FAILED ? std::strerror(errno) : "address not granted";
  if (got != MAP_FAILED) munmap(got, size);
  const std::string range = vp::hex(first) + " to " + vp::hex(first + size);
  const std::string who = occupant(first, first + size);
  throw vp::InputError(
      what + " needs the host addresses " + range + ", " +
      (who.empty() ? "which the host refuses (" + reason + "): choose a smaller size"
                   : "but they are occupied by " + who +
                         ": build programs position-independent (-pie), or choose a smaller size"));
}

FixedMapping::~FixedMapping() {
  munmap(data_, size_);
}

void FixedMapping::clear() {
  madvise(data_, size_, MADV_DONTNEED);
}

}  // namespace ps
