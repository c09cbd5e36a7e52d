#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <ps/memory/memory.h>
#include <ps/memory/residents.h>
#include <vp/clock.h>
#include <vp/clock_scheduler.h>
#include <vp/error.h>
#include <vp/report.h>
#include <vp/text.h>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <utility>

namespace ps {

using namespace vp::literals;

namespace {

std::uint64_t round_up(std::uint64_t value, std::uint64_t power_of_two) {
  return (value + power_of_two - 1) & ~(power_of_two - 1);
}

constexpr std::uint64_t page = 4096;

/// The size as a whole number of pages, so that the range can be mapped.
std::uint64_t checked_size(const std::string& name, std::uint64_t size) {
  if (size % page == 0) return size;
  throw vp::InputError(name + ".size is " + std::to_string(size) +
                       " B: it must be a multiple of 4096");
}

std::uint64_t checked_dma_base(const std::string& name, std::uint64_t dma_base, std::uint64_t end) {
  if (dma_base < end) return dma_base;
  throw vp::InputError(name + ".dma_base is " + vp::hex(dma_base) + ", but the memory ends at " +
                       vp::hex(end) + ": choose a lower address or a larger " + name + ".size");
}

/// A file without a name; -1: the host has none of that size (ulimit -f).
int file_of(std::uint64_t size) {
  rlimit limit{};
  if (getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur < size) return -1;
  const int file = memfd_create("memory", MFD_CLOEXEC);
  if (file < 0 || ftruncate(file, static_cast<off_t>(size)) == 0) return file;
  close(file);
  return -1;
}

}  // namespace

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

FixedMapping::FixedMapping(const std::string& what, std::uint64_t first, std::uint64_t size)
    : data_(reinterpret_cast<unsigned char*>(first)), size_(size), descriptor_(file_of(size)) {
  const int flags = MAP_SHARED | MAP_NORESERVE | (descriptor_ < 0 ? MAP_ANONYMOUS : 0);
  void* const second = mmap(nullptr, size, PROT_READ | PROT_WRITE, flags, descriptor_, 0);
  if (second == MAP_FAILED) {
    const std::string reason = std::strerror(errno);
    close(descriptor_);
    throw vp::InputError(what + ": the host has no room for " + std::to_string(size) + " bytes (" +
                         reason + "): choose a smaller size");
  }
  second_view_ = static_cast<unsigned char*>(second);
  try {
    for (const Piece& piece : pieces_in(what)) {
      map(what, piece);
      pieces_.push_back(piece);
    }
  } catch (...) {
    for (const Piece& piece : pieces_) unmap(piece);
    munmap(second_view_, size_);
    close(descriptor_);
    throw;
  }
}

FixedMapping::~FixedMapping() {
  for (const Piece& piece : pieces_) unmap(piece);
  munmap(second_view_, size_);
  close(descriptor_);
}

// All but the code of programs.
std::vector<FixedMapping::Piece> FixedMapping::pieces_in(const std::string& what) const {
  const auto first = reinterpret_cast<std::uintptr_t>(data_);
  const std::uint64_t end = first + size_;
  std::vector<Piece> pieces;
  std::uint64_t at = first;
  for (const Resident* resident : Resident::in(first, end)) {
    if (resident->first() < first || resident->end() > end) {
      throw vp::InputError("program '" + resident->program() + "' takes the addresses " +
                           vp::hex(resident->first()) + " to " + vp::hex(resident->end() - 1) +
                           ", and the memory of " + what + " ends at " + vp::hex(end - 1) +
                           ": make its variables smaller, or the memory larger");
    }
    for (const Resident::Part& part : resident->parts()) {
      if (part.first > at) pieces.push_back({at, part.first, false});
      if (part.variables) pieces.push_back({part.first, part.end, true});
      at = part.end;
    }
  }
  if (at < end) pieces.push_back({at, end, false});
  return pieces;
}

// From a length of 0 mremap() makes another mapping of the same pages: mremap(2).
void FixedMapping::map(const std::string& what, const Piece& piece) {
  void* const wanted = reinterpret_cast<void*>(piece.first);
  const std::uint64_t bytes = piece.end - piece.first;
  if (piece.of_program) {
    map_ahead(behind(piece.first), bytes);
    copy_variables(behind(piece.first), wanted, bytes);
  } else {
    void* const got =
        mmap(wanted, bytes, PROT_NONE,
             MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_FIXED_NOREPLACE, -1, 0);
    const std::string reason = got == MAP_FAILED ? std::strerror(errno) : "address not granted";
    if (got != wanted) {
      if (got != MAP_FAILED) munmap(got, bytes);
      const std::string range = vp::hex(piece.first) + " to " + vp::hex(piece.end);
      const std::string who = occupant(piece.first, piece.end);
      throw vp::InputError(
          what + " needs the host addresses " + range + ", " +
          (who.empty() ? "which the host refuses (" + reason + "): choose a smaller size"
                       : "but they are occupied by " + who +
                             ": build programs position-independent (-pie), or choose a smaller "
                             "size"));
    }
  }
  if (mremap(behind(piece.first), 0, bytes, MREMAP_MAYMOVE | MREMAP_FIXED, wanted) == wanted)
    return;
  const std::string reason = std::strerror(errno);
  if (!piece.of_program) munmap(wanted, bytes);
  throw vp::InputError(what + ": the host has no room for a second view of " +
                       std::to_string(size_) + " bytes (" + reason + "): choose a smaller size");
}

// A program that was unloaded meanwhile has taken its pages along.
void FixedMapping::unmap(const Piece& piece) {
  void* const at = reinterpret_cast<void*>(piece.first);
  const std::uint64_t bytes = piece.end - piece.first;
  if (!piece.of_program || Resident::in(piece.first, piece.end).empty()) {
    munmap(at, bytes);
    return;
  }
  const int flags = MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED;
  // Without memory of their own the variables stay where they are.
  if (mmap(at, bytes, PROT_READ | PROT_WRITE, flags, -1, 0) == MAP_FAILED) return;
  map_ahead(at, bytes);
  copy_variables(at, behind(piece.first), bytes);
}

void FixedMapping::clear() {
  madvise(second_view_, size_, MADV_REMOVE);
}

namespace {

/// Pages [first, end) with other access rights than reading and writing.
struct Restricted {
  std::uint64_t first, end;
  int protection;
};

std::vector<Restricted> restricted_in(std::uint64_t first, std::uint64_t end) {
  std::vector<Restricted> list;
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    std::uint64_t from = 0, to = 0;
    char rights[5] = {};
    if (std::sscanf(line.c_str(), "%lx-%lx %4s", &from, &to, rights) != 3) continue;
    if (to <= first || from >= end || (rights[0] == 'r' && rights[1] == 'w')) continue;
    list.push_back({std::max(from, first), std::min(to, end),
                    (rights[0] == 'r' ? PROT_READ : 0) | (rights[1] == 'w' ? PROT_WRITE : 0)});
  }
  return list;
}

/// Throws vp::HostError for memory that a call did not give.
void require(bool given) {
  if (!given)
    throw vp::HostError(std::string("no memory for a copy of a run (") + std::strerror(errno) +
                        "): run fewer at a time (--jobs)");
}

}  // namespace

// Only pages that were ever touched are copied. Code of programs is theirs, and a fork copies it.
void FixedMapping::leave_to_parent() {
  const int file = file_of(size_);
  require(file >= 0 && descriptor_ >= 0);
  const auto size = static_cast<off_t>(size_);
  for (off_t at = 0; at < size;) {
    const off_t from = lseek(descriptor_, at, SEEK_DATA);
    if (from < 0) break;
    at = std::min(std::max(lseek(descriptor_, from, SEEK_HOLE), from), size);
    for (off_t done = from; done < at;) {
      const ssize_t wrote = pwrite(file, second_view_ + done, at - done, done);
      require(wrote > 0);
      done += wrote;
    }
  }
  constexpr int flags = MAP_SHARED | MAP_NORESERVE | MAP_FIXED;
  require(mmap(second_view_, size_, PROT_READ | PROT_WRITE, flags, file, 0) != MAP_FAILED);
  const auto base = reinterpret_cast<std::uintptr_t>(data_);
  for (const Piece& piece : pieces_) {
    const std::vector<Restricted> restricted = restricted_in(piece.first, piece.end);
    require(mmap(reinterpret_cast<void*>(piece.first), piece.end - piece.first,
                 PROT_READ | PROT_WRITE, flags, file,
                 static_cast<off_t>(piece.first - base)) != MAP_FAILED);
    for (const Restricted& pages : restricted)
      mprotect(reinterpret_cast<void*>(pages.first), pages.end - pages.first, pages.protection);
  }
  close(std::exchange(descriptor_, file));
}

bool FixedMapping::renew(const std::string& what) {
  if (descriptor_ < 0 || pieces_in(what) != pieces_) return false;
  for (const Piece& piece : pieces_) {
    const std::uint64_t bytes = piece.end - piece.first;
    if (!piece.of_program && madvise(behind(piece.first), bytes, MADV_REMOVE) != 0) return false;
    if (mprotect(reinterpret_cast<void*>(piece.first), bytes, PROT_READ | PROT_WRITE) != 0)
      return false;
  }
  return true;
}

namespace {

/// A mapping without a platform.
struct Unused {
  std::uint64_t first;
  std::unique_ptr<FixedMapping> mapping;
};

/// Never destroyed: the end of the process frees them.
std::vector<Unused>& unused() {
  static auto* const mappings = new std::vector<Unused>;
  return *mappings;
}

pid_t keeping_process = 0;

std::unique_ptr<FixedMapping> take_unused(const std::string& what, std::uint64_t first,
                                          std::uint64_t size) {
  std::vector<Unused>& all = unused();
  for (auto at = all.begin(); at != all.end();) {
    if (at->first >= first + size || at->first + at->mapping->size() <= first) {
      ++at;
      continue;
    }
    std::unique_ptr<FixedMapping> found = std::move(at->mapping);
    const bool fits = at->first == first && found->size() == size && keeping_process == getpid();
    at = all.erase(at);
    if (fits && found->renew(what)) return found;
  }
  return nullptr;
}

}  // namespace

PlatformMapping::PlatformMapping(const std::string& what, std::uint64_t first, std::uint64_t size)
    : mapping_(take_unused(what, first, size)) {
  if (!mapping_) mapping_ = std::make_unique<FixedMapping>(what, first, size);
}

PlatformMapping::~PlatformMapping() {
  if (keeping_process != getpid()) return;
  const auto first = reinterpret_cast<std::uintptr_t>(mapping_->data());
  unused().push_back({first, std::move(mapping_)});
}

// What it has of the process that forked it is memory of both.
void PlatformMapping::keep(bool wanted) {
  const pid_t process = wanted ? getpid() : 0;
  if (keeping_process == process) return;
  end_unused();
  keeping_process = process;
}

void PlatformMapping::end_unused() {
  unused().clear();
}

std::optional<std::uint32_t> DmaAllocator::allocate(std::size_t size, std::size_t alignment) {
  if (alignment == 0 || (alignment & (alignment - 1)) != 0) return std::nullopt;
  const std::uint64_t range = end_ - first_;
  if (size > range || alignment > range) return std::nullopt;
  const std::uint64_t start = round_up(next_, std::max<std::uint64_t>(alignment, cache_line));
  // An empty buffer has an address of its own, too.
  const std::uint64_t end = start + round_up(std::max<std::uint64_t>(size, 1), cache_line);
  if (end > end_) return std::nullopt;
  next_ = end;
  buffers_.push_back({start, start + size});
  return static_cast<std::uint32_t>(start);
}

std::optional<DmaAllocator::Buffer> DmaAllocator::buffer_at(std::uint64_t address) const {
  const auto after =
      std::upper_bound(buffers_.begin(), buffers_.end(), address,
                       [](std::uint64_t a, const Buffer& buffer) { return a < buffer.first; });
  if (after == buffers_.begin() || address >= std::prev(after)->end) return std::nullopt;
  return *std::prev(after);
}

Ddr::Ddr(sc_core::sc_module_name name)
    : MemoryTarget(name),
      size(
          "size", 511_MiB, vp::Unit::bytes, {1_MiB, 1023_MiB}, vp::Source::published,
          "DDR from address 0x100000 on: 512 MiB less the first (ZedBoard), at most 1 GiB (UG585)"),
      dma_base("dma_base", 0x1000'0000, vp::Unit::address, {base, 0x3FFF'F000},
               vp::Source::decision, "first address of the DMA buffers"),
      memory_(std::string(this->name()) + " (DDR)", base, checked_size(this->name(), size)),
      dma_memory_(checked_dma_base(this->name(), dma_base, base + size), base + size) {
  show(memory_->second_view(), base, size);
}

unsigned char* Ddr::at(std::uint32_t address, std::uint64_t bytes) const {
  return memory_->data() + (behind(address, bytes) - memory_->second_view());
}

unsigned char* Ddr::behind(std::uint32_t address, std::uint64_t bytes) const {
  if (contains(address, bytes)) return memory_->second_view() + (address - base);
  throw vp::ProtocolError(std::to_string(bytes) + " bytes at " + vp::hex(address) +
                          " are not in the DDR (" + vp::hex(base) + " to " + vp::hex(end() - 1) +
                          ")");
}

void Ddr::account(tlm::tlm_command command, std::uint64_t bytes) {
  if (command == tlm::TLM_READ_COMMAND) {
    ++reads;
    bytes_read.add(bytes);
  } else if (command == tlm::TLM_WRITE_COMMAND) {
    ++writes;
    bytes_written.add(bytes);
  }
}

void Ddr::clear() {
  memory_->clear();
  dma_memory_.reset();
}

void Ddr::answered(const tlm::tlm_generic_payload& payload, sc_core::sc_time&) {
  if (payload.is_response_ok()) account(payload.get_command(), payload.get_data_length());
}

StackMemory::StackMemory(sc_core::sc_module_name name, std::uint64_t bytes)
    : MemoryTarget(name),
      memory_(std::string(this->name()) + " (stacks of programs)", ddr_end - bytes, bytes) {
  show(memory_->second_view(), ddr_end - bytes, bytes);
}

Ocm::Ocm(sc_core::sc_module_name name, const vp::Clock& cpu_clock)
    : MemoryTarget(name),
      read_cycles("read_cycles", 24, vp::Unit::cycles, {0, 10'000}, vp::Source::assumed,
                  "CPU cycles of a read through the SCU: about those of the L2 cache"),
      write_cycles("write_cycles", 24, vp::Unit::cycles, {0, 10'000}, vp::Source::assumed,
                   "CPU cycles of a write through the SCU"),
      cpu_clock_(cpu_clock),
      memory_(size, 0) {
  show(memory_.data(), 0, size);
}

bool Ocm::is_at_top(std::uint64_t offset) const {
  constexpr std::uint64_t quarter = size / 4;
  return !at_top_ || (at_top_() >> offset / quarter & 1) != 0;
}

void Ocm::answered(const tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
  if (const std::uint64_t at = payload.get_address(); !is_at_top(at) && !warned_) {
    warned_ = true;
    vp::warn(*this, "/markervp/ocm/elsewhere",
             "access to " + vp::hex(base + at) +
                 ", where nothing is on the chip: this quarter of the on-chip memory is at " +
                 vp::hex(at) +
                 " after boot; move it to the top (SLCR_UNLOCK 0xDF0D, then OCM_CFG 0x1F), or use "
                 "0xFFFF0000 and above");
  }
  take_time(payload, delay);
}

void Ocm::take_time(const tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
  constexpr unsigned bytes_per_cycle = 8;  // a 64-bit port
  const unsigned length = payload.get_data_length();
  const unsigned further = length == 0 ? 0 : (length - 1) / bytes_per_cycle;
  const std::uint32_t first = payload.is_read() ? read_cycles : write_cycles;
  delay += vp::from_ps(cpu_clock_.duration_ps(first + further));
  if (payload.is_response_ok()) ++(payload.is_read() ? reads : writes);
}

sc_core::sc_time Ocm::latency(bool read) const {
  return vp::from_ps(cpu_clock_.duration_ps(read ? read_cycles : write_cycles));
}

OcmLow::OcmLow(sc_core::sc_module_name name, Ocm& ocm) : MemoryTarget(name), ocm_(ocm) {
  show(ocm.contents().data(), 0, Ocm::size);
}

tlm::tlm_response_status OcmLow::check(const tlm::tlm_generic_payload& payload) const {
  return ocm_.is_at_top(payload.get_address()) ? tlm::TLM_ADDRESS_ERROR_RESPONSE
                                               : tlm::TLM_OK_RESPONSE;
}

void OcmLow::answered(const tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
  ocm_.take_time(payload, delay);
}

}  // namespace ps
