#include <chip/watch/software_watch.h>

#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <string_view>

#include <ps/memory/residents.h>
#include <vp/ip.h>
#include <vp/report.h>
#include <vp/text.h>
#include <xilinx/axi_dma/axi_dma.h>
#include <xilinx/axi_dma/dma_channel.h>

namespace platform {

namespace {

constexpr std::uint64_t line = ps::DmaAllocator::cache_line;

/// Larger than buffers: a program may invalidate all of the memory.
constexpr std::uint64_t most_ahead = std::uint64_t{4} << 20;

}  // namespace

CacheContract::Watch::Watch(CacheContract& contract, vp::MmLink& link)
    : contract_(contract), link_(link) {
  link_.add_observer(*this);
}

void CacheContract::Watch::after(vp::MmLink& link, tlm::tlm_generic_payload& payload,
                                 sc_core::sc_time&) {
  if (!payload.is_response_ok()) return;
  direct(link, payload.get_command(), payload.get_address(), payload.get_data_length());
}

void CacheContract::Watch::direct(vp::MmLink&, tlm::tlm_command command, std::uint64_t address,
                                  std::uint64_t bytes) {
  if (contract_.owner_problem_) contract_.check_owner(command, address, bytes);
  if (command == tlm::TLM_READ_COMMAND) {
    contract_.device_reads(address, bytes);
  } else {
    contract_.device_wrote(address, bytes);
  }
}

void CacheContract::check_owner(tlm::tlm_command command, std::uint64_t address,
                                std::uint64_t bytes) {
  const std::string problem = owner_problem_(address, bytes);
  if (problem.empty()) return;
  owner_problem_ = nullptr;
  vp::warn(
      zynq_.ps.cpu, "/markervp/cpu/no_owner",
      std::string("a DMA ") + (command == tlm::TLM_READ_COMMAND ? "reads " : "writes ") + problem);
}

CacheContract::CacheContract(Zynq& zynq)
    : zynq_(zynq),
      first_(ps::Ddr::base),
      end_(zynq.ps.ddr.dma_memory().end()),
      lines_((end_ - first_) / line),
      memory_(end_ - first_),
      written_(zynq.ps.ddr.behind(static_cast<std::uint32_t>(first_))),
      guard_(first_, end_, zynq.ps.cache_guard_steps,
             [this](std::uintptr_t address) { program_reads(address); }),
      early_reads_(zynq, guard_, first_, end_) {
  guard_.read_from(written_);
  for (xilinx::MemoryPort* port : vp::all_below<xilinx::MemoryPort>(zynq.pl())) {
    watches_.emplace_back(*this, port->link);
  }
  zynq.ps.cpu.on_cache_call([this](ps::Cpu::CacheCall call, std::uintptr_t address,
                                   std::size_t bytes) { take(call, address, bytes); });
  zynq.on_poke([this](std::uint32_t address) { placed(address, sizeof address); });
  leave_alone();
  check_transfers();
}

// Code cannot lose its access rights, and the simulator works on the program's stack, too.
void CacheContract::leave_alone() {
  const std::uint64_t stacks = zynq_.ps.cpus().size() * zynq_.ps.cpu.settings().stack_size;
  const std::uint64_t top = zynq_.ps.cpu.stack_end();
  if (top <= end_ && stacks < top - first_) guard_.exclude(top - stacks, top);
  for (const ps::Resident* program : ps::Resident::in(first_, end_)) {
    for (const ps::Resident::Part& part : program->parts()) {
      if (!part.variables) guard_.exclude(part.first, part.end);
    }
  }
}

CacheContract::~CacheContract() {
  zynq_.ps.cpu.on_cache_call(nullptr);
  zynq_.on_poke(nullptr);
  for (xilinx::AxiDma* dma : vp::all_below<xilinx::AxiDma>(zynq_.pl())) dma->check_buffers(nullptr);
}

void CacheContract::take(ps::Cpu::CacheCall call, std::uint64_t address, std::uint64_t bytes) {
  using Call = ps::Cpu::CacheCall;
  switch (call) {
    case Call::flush:
      return flushed(address, bytes);
    case Call::invalidate:
      return invalidate(address, bytes);
    case Call::flush_all:
      return flush_all();
    case Call::invalidate_all:
      return for_each_used([this](auto from, auto size) { invalidate(from, size); });
    case Call::disable:
    case Call::enable:
      off_ = call == Call::disable;
      return flush_all();
    case Call::uncache:
    case Call::cache:
      return mark(address, bytes, call == Call::uncache ? uncached : 0,
                  call == Call::uncache ? 0 : uncached);
  }
}

// All of the memory that was ever touched: its file has data there.
template <class Action>
void CacheContract::for_each_used(Action action) {
  const int file = zynq_.ps.ddr.descriptor();
  const auto size = static_cast<off_t>(end_ - first_);
  for (off_t at = 0; at < size;) {
    const off_t from = file < 0 ? at : lseek(file, at, SEEK_DATA);
    if (from < 0 || from >= size) return;
    const off_t hole = file < 0 ? size : lseek(file, from, SEEK_HOLE);
    at = std::min(hole < 0 ? size : hole, size);
    action(first_ + static_cast<std::uint64_t>(from), static_cast<std::uint64_t>(at - from));
  }
}

// Nothing is in the caches: devices see what the program does, and it sees what they wrote.
void CacheContract::flush_all() {
  all_current_ = true;
  for_each_used([this](auto from, auto size) {
    flushed(from, size);
    mark(from, size, invalidated, dropped);
    guard_.release(from, size);
  });
}

// What is not of hal_dma_allocate() may end where the program likes.
void CacheContract::check_transfers() {
  const ps::DmaAllocator& memory = zynq_.ps.ddr.dma_memory();
  const auto check = [this, &memory](const std::string& who, std::uint64_t address,
                                     std::uint64_t bytes) -> std::string {
    if (std::string_view(who) == "S2MM") device_will_write(address, bytes);
    const auto buffer = memory.buffer_at(address);
    if (!buffer || address + bytes <= buffer->end) return {};
    return "leaves its buffer, " + std::to_string(buffer->end - buffer->first) + " bytes at " +
           vp::hex(buffer->first) + ", by " + std::to_string(address + bytes - buffer->end) +
           " bytes: allocate more, or transfer less";
  };
  for (xilinx::AxiDma* dma : vp::all_below<xilinx::AxiDma>(zynq_.pl())) dma->check_buffers(check);
}

bool CacheContract::watches(std::uint64_t address, std::uint64_t bytes) const {
  return bytes != 0 && address >= first_ && address < end_;
}

unsigned char& CacheContract::marks_at(std::uint64_t address) {
  return lines_[(address - first_) / line];
}

void CacheContract::mark(std::uint64_t address, std::uint64_t bytes, unsigned marks,
                         unsigned cleared) {
  if (!watches(address, bytes)) return;
  const auto bits = static_cast<unsigned char>(marks);
  const auto kept = static_cast<unsigned char>(~cleared);
  unsigned char* const from = &marks_at(address);
  const std::ptrdiff_t count = &marks_at(std::min(address + bytes, end_) - 1) - from + 1;
  for (std::ptrdiff_t i = 0; i < count; ++i)
    from[i] = static_cast<unsigned char>((from[i] & kept) | bits);
}

// Whole lines leave the cache.
void CacheContract::flushed(std::uint64_t address, std::uint64_t bytes) {
  if (!watches(address, bytes)) return;
  mark(address, bytes, current, given);
  const std::uint64_t from = address / line * line;
  copy(from, (address + bytes + line - 1) / line * line - from);
}

// The HAL flushes lines that are named in part before it drops them.
void CacheContract::invalidate(std::uint64_t address, std::uint64_t bytes) {
  if (!watches(address, bytes)) return;
  const std::uint64_t end = std::min(address + bytes, end_);
  const std::uint64_t whole = (address + line - 1) / line * line, whole_end = end / line * line;
  if (whole != address) flushed(address, 1);
  if (whole_end != end) flushed(end - 1, 1);
  mark(address, bytes, invalidated, dropped);
  guard_.release(address, bytes);
  for (std::uint64_t at = whole; at < whole_end; at = (at / line + 1) * line) {
    const std::optional<std::uint64_t> lost = first_dirty(at, whole_end - at, given);
    if (!lost) return;
    at = *lost;
    mark(at, 1, dropped);
    guard_.guard(at, 1);
  }
}

void CacheContract::device_wrote(std::uint64_t address, std::uint64_t bytes) {
  if (!watches(address, bytes)) return;
  mark(address, bytes, current, dropped);
  copy(address, bytes);
  early_reads_.written(address, bytes);
  if (!off_ && (marks_at(address) & uncached) == 0) guard_.guard(address, bytes);
}

// From what the program sees to what lies behind the caches.
void CacheContract::copy(std::uint64_t address, std::uint64_t bytes) {
  bytes = std::min(address + bytes, end_) - address;
  const std::uint64_t at = address - first_;
  std::memcpy(memory_.data() + at, written_ + at, bytes);
}

// The first address whose byte a device does not see as the program does, in a line without one of
// the marks `but`. Nearly always there is none: large pieces are compared first.
std::optional<std::uint64_t> CacheContract::first_dirty(std::uint64_t address, std::uint64_t bytes,
                                                        unsigned but) {
  constexpr std::uint64_t piece = 128 * line;
  const std::uint64_t end = std::min(address + bytes, end_);
  const unsigned char* const seen = memory_.data() - first_;
  const unsigned char* const wrote = written_ - first_;
  if (end - address <= most_ahead) {
    ps::map_ahead(seen + address, end - address);
    ps::map_ahead(wrote + address, end - address);
  }
  const auto next_after = [end](std::uint64_t at, std::uint64_t size) {
    return std::min(end, (at / size + 1) * size);
  };
  const auto equal = [seen, wrote](std::uint64_t at, std::uint64_t until) {
    return std::memcmp(seen + at, wrote + at, until - at) == 0;
  };
  const auto first_in_lines = [&](std::uint64_t at, std::uint64_t until) {
    while (at < until && ((marks_at(at) & but) != 0 || equal(at, next_after(at, line))))
      at = next_after(at, line);
    while (at < until && seen[at] == wrote[at]) ++at;
    return at;
  };
  for (std::uint64_t at = address, until = 0; at < end; at = until) {
    until = next_after(at, piece);
    if (equal(at, until)) continue;
    const std::uint64_t first = first_in_lines(at, until);
    if (first < until) return first;
  }
  return std::nullopt;
}

// The first that was never flushed, or was written since.
std::optional<std::uint64_t> CacheContract::first_unflushed(std::uint64_t address,
                                                            std::uint64_t bytes) {
  const std::uint64_t end = std::min(address + bytes, end_);
  const unsigned char* const from = &marks_at(address);
  const unsigned char* const last = &marks_at(end - 1);
  const auto* const never = std::find_if(from, last + 1, [this](unsigned char marks) {
    return !all_current_ && (marks & (current | uncached)) == 0;
  });
  const std::uint64_t flushed_end =
      never > last ? end : std::max(address, (address / line + (never - from)) * line);
  const auto dirty = first_dirty(address, flushed_end - address, given | uncached);
  if (dirty || never > last) return dirty;
  return flushed_end;
}

// Nearly every read of a device is a burst of lines that are all given, or were all flushed and not
// written since.
bool CacheContract::is_flushed_piece(std::uint64_t address, std::uint64_t bytes) {
  if (bytes > end_ - address) return false;
  const unsigned char* const last = &marks_at(address + bytes - 1);
  unsigned marks = current | given;  // that all lines have
  for (const unsigned char* at = &marks_at(address); at <= last; ++at) marks &= *at;
  if (marks == (current | given)) return true;
  const std::uint64_t at = address - first_;
  return marks == current && std::memcmp(memory_.data() + at, written_ + at, bytes) == 0;
}

void CacheContract::device_reads(std::uint64_t address, std::uint64_t bytes) {
  if (warned_of_read_ || off_ || !watches(address, bytes) || is_flushed_piece(address, bytes))
    return;
  const std::optional<std::uint64_t> stale = first_unflushed(address, bytes);
  if (!stale) return;
  warned_of_read_ = true;
  const bool once = (marks_at(*stale) & current) != 0;
  vp::warn(zynq_.ps.cpu, "/markervp/cpu/not_flushed",
           "a DMA reads " + vp::hex(*stale) +
               (once ? ", which the program wrote after it was flushed"
                     : ", which the program never flushed") +
               ": it works here, and fails on the chip; " + flush_call_ + " " +
               (once ? "between the last write and the transfer" : "before the transfer"));
}

// Data that share a line with the buffer are written back with it.
void CacheContract::device_will_write(std::uint64_t address, std::uint64_t bytes) {
  if (warned_of_write_ || off_ || !watches(address, bytes)) return;
  const std::uint64_t from = address / line * line;
  const std::uint64_t end = (address + bytes + line - 1) / line * line;
  const std::optional<std::uint64_t> dirty =
      first_dirty(from, end - from, given | dropped | uncached);
  if (!dirty) return;
  warned_of_write_ = true;
  vp::warn(zynq_.ps.cpu, "/markervp/cpu/written_over",
           "a DMA is about to write the cache line of " + vp::hex(*dirty) +
               ", which the program wrote and has not flushed: it works here; on the chip the "
               "cache writes it back at any time, over what the DMA wrote; " +
               flush_call_ +
               " before the transfer, and keep other data out of the buffer's cache lines");
}

// In a signal handler, between two instructions of the program.
void CacheContract::program_reads(std::uint64_t address) {
  guard_.stop();
  const unsigned marks = marks_at(address);
  if ((marks & dropped) != 0) {
    vp::warn(zynq_.ps.cpu, "/markervp/cpu/dropped",
             "the program reads " + vp::hex(address) +
                 ", which it wrote and then invalidated without a flush: it works here, and the "
                 "chip has dropped what was written; invalidate only what a device wrote");
    return;
  }
  const bool early = (marks & invalidated) != 0;
  vp::warn(
      zynq_.ps.cpu, "/markervp/cpu/not_invalidated",
      "the program reads " + vp::hex(address) + ", which a DMA wrote " +
          (early ? "after the program invalidated it" : "and the program never invalidated") +
          ": it works here, and can fail on the chip, where the caches may hold what was there "
          "before; " +
          invalidate_call_ + " between the transfer and the first read");
}

}  // namespace platform
