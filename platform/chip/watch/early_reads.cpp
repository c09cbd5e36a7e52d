#include <chip/watch/early_reads.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <vp/ip.h>
#include <vp/report.h>
#include <vp/text.h>
#include <vp/unit.h>
#include <xilinx/axi_dma/engine.h>

namespace platform {

namespace {

constexpr std::uint64_t line_bytes = ps::DmaAllocator::cache_line;

/// "S2MM of pl.axi_dma_0", "pl.axi_cdma_0".
std::string name_of(const xilinx::MemoryPort& port) {
  std::string owner = port.get_parent_object() ? port.get_parent_object()->name() : port.name();
  const bool is_channel = std::string_view(port.basename()) == "m_axi_s2mm";
  if (!is_channel) return owner;
  const std::size_t dot = owner.rfind('.');  // a VDMA's channel is a module
  if (dot != owner.npos && owner.substr(dot + 1) == "s2mm") owner.resize(dot);
  return "S2MM of " + owner;
}

}  // namespace

EarlyReads::EarlyReads(Zynq& zynq, ps::LineGuard& guard, std::uint64_t first, std::uint64_t end)
    : zynq_(zynq),
      guard_(guard),
      first_(first),
      end_(end),
      ports_(vp::all_below<xilinx::MemoryPort>(zynq.pl())),
      lines_((end - first) / line_bytes) {
  for (xilinx::MemoryPort* port : ports_) {
    port->orders.on_change(
        [this, port](const auto& order, bool begins) { change(port->orders, order, begins); });
  }
  guard_.on_watched(
      [this](auto address, auto instruction) { return program_reads(address, instruction); });
}

EarlyReads::~EarlyReads() {
  for (xilinx::MemoryPort* port : ports_) port->orders.on_change(nullptr);
}

// Lines that it shares with other data are left out.
void EarlyReads::change(const xilinx::WriteOrders& orders, const xilinx::WriteOrders::Order& order,
                        bool begins) {
  if (is_over_ || order.address < first_ || order.address >= end_) return;
  const std::uint64_t from = (order.address - first_ + line_bytes - 1) / line_bytes;
  const std::uint64_t to = (std::min(order.address + order.bytes, end_) - first_) / line_bytes;
  if (!begins) return forget(from, to);
  const auto has_new_data = [&](std::uint64_t at) {
    return at < to && !(orders.is_cyclic && (lines_[at] & has_data) != 0);
  };
  for (std::uint64_t at = from; at < to; ++at) {
    const std::uint64_t begin = at;
    for (; has_new_data(at); ++at) lines_[at] |= ordered;
    if (at != begin) guard_.watch(first_ + begin * line_bytes, (at - begin) * line_bytes);
  }
}

void EarlyReads::written(std::uint64_t address, std::uint64_t bytes) {
  if (is_over_ || bytes == 0) return;
  const std::uint64_t from = (address - first_) / line_bytes;
  const std::uint64_t to = (std::min(address + bytes, end_) - 1 - first_) / line_bytes + 1;
  for (std::uint64_t at = from; at < to; ++at) lines_[at] |= has_data;
  forget(from, to);
}

// Lines that were read too early stay watched: are they read again?
void EarlyReads::forget(std::uint64_t first_line, std::uint64_t end_line) {
  const auto drops = [&](std::uint64_t at) {
    return at < end_line && (lines_[at] & ordered) != 0 && !is_candidate(at);
  };
  for (std::uint64_t at = first_line; at < end_line; ++at) {
    const std::uint64_t begin = at;
    for (; drops(at); ++at) lines_[at] &= static_cast<unsigned char>(~ordered);
    if (at != begin) guard_.forget(first_ + begin * line_bytes, (at - begin) * line_bytes);
    if (at < end_line) lines_[at] &= static_cast<unsigned char>(~ordered);
  }
}

bool EarlyReads::is_candidate(std::uint64_t number) const {
  return std::any_of(reads_.begin(), reads_.end(), [&](const auto& known) {
    return !known.second.polls && (known.second.address - first_) / line_bytes == number;
  });
}

// In a signal handler, between two instructions of the program.
bool EarlyReads::program_reads(std::uint64_t address, std::uintptr_t instruction) {
  const std::uint64_t number = (address - first_) / line_bytes;
  const bool too_early = (lines_[number] & ordered) != 0;
  const std::string text = zynq_.ps.cpu.program_counter();
  const Place place = place_of(instruction, text);
  const auto known = reads_.find(place);
  if (known == reads_.end()) {
    if (too_early)
      reads_[place] = {address, text, zynq_.scheduler.now_ps(), orderer_of(address), false};
    return true;
  }
  Read& read = known->second;
  if (read.polls || read.address == address) {
    read.polls = true;
    return is_candidate(number);
  }
  if (!too_early) return is_candidate(number);
  warn(read, false);
  return false;
}

// An optimising compiler tests a loop's condition by two instructions, before it and at its end: it
// is the function that counts. A plain main() is compiled without, and a library reads by one of
// its own.
EarlyReads::Place EarlyReads::place_of(std::uintptr_t instruction, const std::string& text) const {
  const ps::CodeLocator* const code = zynq_.ps.cpu.code();
  const bool own = code && code->contains(instruction);
  if (ps::ProgramWatch::charge || !own) return {instruction, text};
  const std::string function = code->symbol(instruction);
  return function.empty() ? Place{instruction, text} : Place{0, function};
}

std::string EarlyReads::orderer_of(std::uint64_t address) const {
  for (const xilinx::MemoryPort* port : ports_) {
    for (const auto& order : port->orders.open()) {
      if (address >= order.address && address - order.address < order.bytes) return name_of(*port);
    }
  }
  return "a DMA";
}

// Later than it happened: where it was is a part of the message.
void EarlyReads::warn(const Read& read, bool later) {
  is_over_ = true;
  guard_.forget(first_, end_ - first_);
  const std::string when = later ? fmt::format(" at {}{}{}", vp::format_time(read.ps),
                                               read.place.empty() ? "" : ", ", read.place)
                                 : "";
  vp::warn(zynq_.ps.cpu, "/markervp/cpu/not_awaited",
           fmt::format("the program read {}{}: {} had been ordered to write it and had not yet, so "
                       "it saw what was there before; wait for the end of the transfer first",
                       vp::hex(static_cast<std::uint32_t>(read.address)), when, read.orderer));
}

// A receiver may leave a transfer open for what might come: one that is no first, without data.
void EarlyReads::look_at_end(const xilinx::MemoryPort& port) {
  const auto& orders = port.orders;
  if (orders.open().empty() || orders.is_cyclic) return;
  const auto& order = orders.open().front();
  if (orders.ended() != 0 && order.written == 0) return;
  vp::warn(zynq_.ps.cpu, "/markervp/cpu/transfer_open",
           fmt::format("the program ended while {} had written {} of the {} bytes at {} that it "
                       "was ordered to write: what the program read there may be what was there "
                       "before; wait for the end of the transfer",
                       name_of(port), order.written, order.bytes,
                       vp::hex(static_cast<std::uint32_t>(order.address))));
}

// No mistake: a picture is to be shown after main(), too. But a run ends with its program.
void EarlyReads::name_engines() const {
  for (const xilinx::Engine* engine : vp::all_below<xilinx::Engine>(zynq_.pl())) {
    const std::string what = engine->under_way();
    if (what.empty()) continue;
    const auto* object = dynamic_cast<const sc_core::sc_object*>(engine);
    vp::info(*object, "/markervp/cpu/engine_runs",
             what +
                 " when the program ended, and the run with it: on the chip it runs on; let "
                 "main() wait for as long as you want to see",
             sc_core::SC_LOW);
  }
}

void EarlyReads::finish() {
  for (const auto& [place, read] : std::exchange(reads_, {})) {
    if (!is_over_ && !read.polls) warn(read, true);
  }
  const ps::Cpu& cpu = zynq_.ps.cpu;
  if (cpu.state() != ps::Cpu::State::finished || cpu.reached_limit()) return;
  for (const xilinx::MemoryPort* port : ports_) look_at_end(*port);
  name_engines();
}

}  // namespace platform
