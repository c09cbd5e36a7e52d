#include <xilinx/axi_dma/axi_dma.h>

#include <algorithm>
#include <stdexcept>

#include <vp/clock_scheduler.h>
#include <vp/error.h>
#include <vp/report.h>
#include <vp/text.h>
#include <xilinx/common/axi_lite_ip.h>

namespace xilinx {

namespace {

using namespace axi_dma;

constexpr std::uint32_t reset_pin = 1;  // listener id; 0: a stream

[[noreturn]] void not_built(const AxiDma& dma, const char* part) {
  throw std::logic_error(std::string(dma.name()) + " was built without its " + part);
}

}  // namespace

// What S2MM was ordered to write is in its port's orders.
std::string AxiDma::under_way() const {
  if (mm2s_ && mm2s_->is_moving()) return "MM2S was sending " + mm2s_->what_moves();
  if (s2mm_ && s2mm_->is_moving() && s2mm_->cyclic())
    return "S2MM was writing " + s2mm_->what_moves();
  return {};
}

AxiDma::AxiDma(sc_core::sc_module_name name, vp::Clock& aclk, const AxiDmaBuild& build)
    : Clocked(name, aclk),
      Ip(&aclk),
      include_mm2s("include_mm2s", build.include_mm2s, vp::Source::published,
                   "build option Enable Read Channel (PG021)"),
      include_s2mm("include_s2mm", build.include_s2mm, vp::Source::published,
                   "build option Enable Write Channel (PG021)"),
      include_sg("include_sg", build.include_sg, vp::Source::published,
                 "build option Enable Scatter Gather Engine: descriptors in memory instead of the "
                 "address and LENGTH registers (PG021)"),
      length_width("length_width", build.length_width, vp::Unit::none, {8, 26},
                   vp::Source::published,
                   "bits of the LENGTH registers (PG021; 14 is Vivado's default)"),
      mm2s_dre("mm2s_dre", build.mm2s_dre, vp::Source::published,
               "build option Allow Unaligned Transfers, read channel (PG021)"),
      s2mm_dre("s2mm_dre", build.s2mm_dre, vp::Source::published,
               "build option Allow Unaligned Transfers, write channel (PG021)"),
      mm2s_burst_beats("mm2s_burst_beats", build.mm2s_burst_beats, vp::Unit::none, {2, 256},
                       vp::Source::published,
                       "largest burst of the read channel, in beats (PG021; thesis 4.4.2: 32)"),
      s2mm_burst_beats("s2mm_burst_beats", build.s2mm_burst_beats, vp::Unit::none, {2, 256},
                       vp::Source::published,
                       "largest burst of the write channel, in beats (PG021; thesis 4.4.2: 32)"),
      s_axi_lite("s_axi_lite", registers, axi_lite_options(address_bits), &aclk.scheduler()),
      mm2s_widths(build.mm2s),
      s2mm_widths(build.s2mm) {
  if (!include_mm2s && !include_s2mm) {
    throw vp::InputError(std::string(this->name()) +
                         ": include_mm2s and include_s2mm are both false: build one");
  }
  check("mm2s", mm2s_burst_beats, mm2s_widths);
  check("s2mm", s2mm_burst_beats, s2mm_widths);
  build_channels();
  build_scatter_gather();
  s_axi_lite.before_access([this] {
    if (mm2s_ && mm2s_->finishing()) mm2s_->bring_up_to(clock().cycle());
    if (s2mm_ && s2mm_->finishing()) s2mm_->bring_up_to(clock().cycle());
  });
}

void AxiDma::check(const std::string& channel, std::uint32_t burst_beats,
                   const DmaWidths& widths) const {
  if ((burst_beats & (burst_beats - 1)) != 0) {
    throw vp::InputError(std::string(name()) + "." + channel + "_burst_beats = " +
                         std::to_string(burst_beats) + ": must be a power of two from 2 to 256");
  }
  const auto fits = [](std::uint32_t bytes) {
    return bytes >= word_bytes && bytes <= vp::most_stream_bytes && (bytes & (bytes - 1)) == 0;
  };
  if (fits(widths.memory_bytes) && fits(widths.stream_bytes) &&
      widths.memory_bytes >= widths.stream_bytes)
    return;
  throw vp::InputError(std::string(name()) + ": " + channel + " has a memory of " +
                       std::to_string(widths.memory_bytes) + " bytes and a stream of " +
                       std::to_string(widths.stream_bytes) +
                       ": both are powers of two from 4 to 128, and the memory is no narrower");
}

// 32 bit: the DataMover's FIFO for a burst is block memory (PG021). Its logic works on a beat a
// clock. The scatter-gather engine and what each channel has for it come on top.
vp::IpEstimate AxiDma::own_estimate() const {
  const std::uint32_t channels = (include_mm2s ? 1u : 0u) + (include_s2mm ? 1u : 0u);
  const std::uint32_t sg = include_sg ? 1 : 0;
  vp::IpEstimate e =
      axi_estimate("axi_dma", 250 + 900 * channels + sg * (400 + 350 * channels),
                   300 + 1300 * channels + sg * (500 + 450 * channels), 1.0 * channels);
  // Registers and multiplexers for each further word. The memory is no deeper; a block has 8 bytes.
  for (const DmaWidths& widths : {mm2s_widths, s2mm_widths}) {
    const std::uint32_t further = widths.beats_per_clock() * widths.stream_bytes / word_bytes - 1;
    if (further == 0) continue;
    e.lut += 250 * further;
    e.ff += 400 * further;
    e.bram36 += 1.0 * (widths.clocks_per_beat() - 1);
    e.uncertainty_percent = 50;
  }
  e.active_clocks = [this] { return beats(); };
  return e;
}

std::uint64_t AxiDma::beats() const {
  const std::uint64_t read = mm2s_ ? mm2s_->m_axi.link.bytes_read.get() : 0;
  const std::uint64_t written = s2mm_ ? s2mm_->m_axi.link.bytes_written.get() : 0;
  return read / mm2s_widths.stream_bytes + written / s2mm_widths.stream_bytes;
}

void AxiDma::build_channels() {
  DmaChannel::Core& core = *this;
  if (include_mm2s) {
    mm2s_ = std::make_unique<Mm2sChannel>(core, s_axi_lite, *this, mm2s_burst_beats, mm2s_widths);
    mm2s_->configure(length_width, mm2s_dre ? 1 : mm2s_widths.memory_bytes);
    interrupts_.push_back({mm2s_.get(), &mm2s_introut});
  } else {
    for (const std::uint32_t offset :
         {MM2S_DMACR, MM2S_DMASR, MM2S_CURDESC, MM2S_CURDESC_MSB, MM2S_TAILDESC, MM2S_TAILDESC_MSB,
          MM2S_SA, MM2S_SA_MSB, MM2S_LENGTH}) {
      s_axi_lite[offset].remove();
    }
  }
  if (include_s2mm) {
    s2mm_ = std::make_unique<S2mmChannel>(core, s_axi_lite, *this, s2mm_burst_beats, s2mm_widths);
    s2mm_->configure(length_width, s2mm_dre ? 1 : s2mm_widths.memory_bytes);
    interrupts_.push_back({s2mm_.get(), &s2mm_introut});
  } else {
    for (const std::uint32_t offset :
         {S2MM_DMACR, S2MM_DMASR, S2MM_CURDESC, S2MM_CURDESC_MSB, S2MM_TAILDESC, S2MM_TAILDESC_MSB,
          S2MM_DA, S2MM_DA_MSB, S2MM_LENGTH}) {
      s_axi_lite[offset].remove();
    }
  }
}

// The registers of the other mode are not built.
void AxiDma::build_scatter_gather() {
  if (!include_sg) {
    for (const std::uint32_t offset :
         {MM2S_CURDESC, MM2S_CURDESC_MSB, MM2S_TAILDESC, MM2S_TAILDESC_MSB, S2MM_CURDESC,
          S2MM_CURDESC_MSB, S2MM_TAILDESC, S2MM_TAILDESC_MSB}) {
      s_axi_lite[offset].remove();
    }
    return;
  }
  scatter_gather_ = std::make_unique<ScatterGather>(clock().scheduler());
  for (const std::uint32_t offset :
       {MM2S_SA, MM2S_SA_MSB, MM2S_LENGTH, S2MM_DA, S2MM_DA_MSB, S2MM_LENGTH}) {
    s_axi_lite[offset].remove();
  }
  for (const Interrupt& i : interrupts_) i.channel->use(*scatter_gather_);
}

ScatterGather& AxiDma::scatter_gather() {
  if (!scatter_gather_) not_built(*this, "scatter-gather engine");
  return *scatter_gather_;
}

Mm2sChannel& AxiDma::mm2s() {
  if (!mm2s_) not_built(*this, "MM2S channel");
  return *mm2s_;
}

S2mmChannel& AxiDma::s2mm() {
  if (!s2mm_) not_built(*this, "S2MM channel");
  return *s2mm_;
}

void AxiDma::share_memory_path(MemoryPath& path) {
  if (mm2s_) mm2s_->m_axi.share(path);
  if (s2mm_) s2mm_->m_axi.share(path);
  if (scatter_gather_) scatter_gather_->m_axi.share(path);
}

void AxiDma::before_end_of_elaboration() {
  if ((mm2s_ && !mm2s_->m_axis.bound()) || (s2mm_ && !s2mm_->s_axis.bound())) {
    vp::error(*this, "/markervp/axi_dma/unbound",
              "a channel is built but its stream is not connected");
  }
  Clocked::before_end_of_elaboration();
  if (mm2s_) mm2s_->m_axis.set_sender(*mm2s_);
  if (axi_resetn.bound()) axi_resetn.signal()->attach(*this, reset_pin);
}

void AxiDma::show_reset(bool is_active) {
  for (vp::Signal<bool>* signal : reset_outs_) *signal = !is_active;
}

void AxiDma::start_of_simulation() {
  show_reset(axi_resetn.bound() && !axi_resetn);
  s_axi_lite.hold_in_reset(axi_resetn.bound() && !axi_resetn);
}

void AxiDma::on_change(vp::SignalBase& signal, std::uint32_t id) {
  if (id != reset_pin) {
    if (beat_at_ != vp::Clock::never && s2mm_->beat_was_last()) return expect_no_beat();
    return Clocked::on_change(signal, id);
  }
  if (!axi_resetn) reset();
  show_reset(!axi_resetn);
  s_axi_lite.hold_in_reset(!axi_resetn);
}

// The master withdraws, and the next edge has nothing to sample.
void AxiDma::expect_no_beat() {
  beat_at_ = vp::Clock::never;
  wake_at(planned_);
}

bool AxiDma::watched() const {
  return clock().scheduler().observed();
}

void AxiDma::warn(const char* id, const std::string& message) const {
  vp::warn(*this, id, message);
}

void AxiDma::check_buffer(const std::string& who, std::uint32_t address,
                          std::uint32_t bytes) const {
  if (!buffer_check_) return;
  const std::string mistake = buffer_check_(who, address, bytes);
  if (mistake.empty()) return;
  warn("/markervp/axi_dma/past_buffer", who + " transfer of " + std::to_string(bytes) +
                                            " bytes at " + vp::hex(address) + " " + mistake);
}

// A register behind status AND enable.
inline void AxiDma::drive(Interrupt& interrupt) {
  const bool level = !resetting_ && interrupt.channel->interrupt();
  if (level == interrupt.level) return;
  interrupt.level = level;
  interrupt.output->write(level);
}

inline bool AxiDma::interrupts_differ() const {
  for (const Interrupt& i : interrupts_) {
    if (i.level != i.channel->interrupt()) return true;
  }
  return false;
}

// Asleep while no channel has anything to do: software, the streams and alarms wake it.
void AxiDma::edge() {
  const std::uint64_t cycle = this_edge();
  const bool was_stopped = stopped_;
  for (Interrupt& i : interrupts_) {
    if (i.channel->finishing()) i.channel->bring_up_to(cycle - 1);
    drive(i);
  }
  std::uint64_t next = vp::Clock::never;
  bool rest = !resetting_;
  for (const Interrupt& i : interrupts_) {
    if (i.channel->rests()) continue;
    next = std::min(next, i.channel->edge(cycle));
    rest = false;
  }
  if (rest) {
    planned_ = vp::Clock::never;
    return sleep_until(planned_);
  }
  if (resetting_) next = std::min(next, run_soft_reset(cycle));
  if (interrupts_differ()) next = cycle + 1;
  if (stopped_ && !was_stopped) next = cycle + 1;  // a channel that ran before the other failed
  planned_ = std::max(next, cycle + 1);
  beat_at_ = s2mm_ && s2mm_->expects_beat() ? cycle + 1 : vp::Clock::never;
  sleep_until(std::min(planned_, beat_at_));
}

void AxiDma::plan_edge(std::uint64_t cycle) {
  if (cycle >= planned_) return;
  planned_ = cycle;
  wake_at(std::min(planned_, beat_at_));
}

void AxiDma::plan_interrupts() {
  if (interrupts_differ()) plan_edge(clock().cycle() + 1);
}

void AxiDma::stop_channels() {
  stopped_ = true;
  for (const Interrupt& i : interrupts_) i.channel->stop();
}

// The reset of either channel resets the core, and shows in both until it is done (HDL of v7.1; the
// other channel's bit rises a clock later, which no bus access can see).
void AxiDma::request_soft_reset() {
  if (resetting_) return;
  resetting_ = true;
  reset_done_at_ = vp::Clock::never;
  plan_edge(clock().cycle() + 1);
  for (const Interrupt& i : interrupts_) {
    i.channel->dmacr.set_bits(dmacr::Reset);
    i.channel->drop();
  }
}

std::uint64_t AxiDma::run_soft_reset(std::uint64_t cycle) {
  if (reset_done_at_ == vp::Clock::never) {
    const bool quiet = std::all_of(interrupts_.begin(), interrupts_.end(),
                                   [cycle](const Interrupt& i) { return i.channel->quiet(cycle); });
    if (!quiet || (scatter_gather_ && !scatter_gather_->m_axi.done())) return cycle + 1;
    reset_done_at_ = cycle + latencies.reset_cycles;
    show_reset(true);
  }
  if (cycle < reset_done_at_) return reset_done_at_;
  s_axi_lite.reset();
  reset();
  show_reset(false);
  return vp::Clock::never;
}

void AxiDma::reset() {
  resetting_ = stopped_ = false;
  reset_done_at_ = vp::Clock::never;
  for (Interrupt& i : interrupts_) {
    i.channel->reset();
    i.level = false;
    i.output->write(false);
  }
}

}  // namespace xilinx
