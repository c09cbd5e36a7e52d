#include <xilinx/axi_vdma/vdma_channel.h>

#include <algorithm>
#include <string>
#include <utility>

#include <vp/report.h>
#include <vp/text.h>

namespace xilinx {

namespace {

using namespace axi_vdma;

constexpr std::uint32_t sr_count = 0x00FF0000;

}  // namespace

VdmaChannel::VdmaChannel(sc_core::sc_module_name name, vp::Clock& clock, vp::RegisterBank& bank,
                         const ChannelOffsets& offsets, const VdmaChannelBuild& build,
                         std::uint32_t frame_stores, const char* memory_name,
                         vp::Signal<bool>& introut)
    : Clocked(name, clock),
      memory_bytes("memory_bytes", build.memory_bytes, vp::Unit::bytes, {4, 128},
                   vp::Source::published, "build option Memory Map Data Width, in bytes (PG020)"),
      stream_bytes("stream_bytes", build.stream_bytes, vp::Unit::bytes, {1, 128},
                   vp::Source::published, "build option Stream Data Width, in bytes (PG020)"),
      burst_beats("burst_beats", build.burst_beats, vp::Unit::none, {2, 256}, vp::Source::published,
                  "build option Burst Size (PG020)"),
      line_buffer("line_buffer", build.line_buffer, vp::Unit::none, {128, 65536},
                  vp::Source::published, "build option Line Buffer Depth, in beats (PG020)"),
      m_axi(memory_name, clock.scheduler()),
      frames("frames", "frames completed"),
      title_(offsets.control == mm2s.control ? "MM2S" : "S2MM"),
      genlock_(build.genlock),
      dre_(build.dre),
      frame_stores_(frame_stores),
      park_shift_(offsets.park_shift),
      cr_(bank[offsets.control]),
      sr_(bank[offsets.status]),
      vsize_(bank[offsets.vsize]),
      hsize_(bank[offsets.hsize]),
      stride_(bank[offsets.stride]),
      park_(bank[PARK_PTR_REG]),
      introut_(introut) {
  for (std::uint32_t i = 0; i < most_frame_stores; ++i) {
    addresses_.push_back(&bank[offsets.first_address + 4 * i]);
    if (i >= frame_stores_) addresses_.back()->remove();
  }
  // The delay exists where a plain slave follows (vendor's HDL); as master there is no genlock.
  if (genlock_ == GenlockMode::slave) {
    stride_.set_reset_value(1u << 24);
  } else {
    stride_.set_writable(0xFFFF);
  }
  if (genlock_ == GenlockMode::master) cr_.set_writable(~(vdmacr::GenlockEn | vdmacr::GenlockSrc));
  wire();
}

// Where both channels are locked inside the core the bit is 1 after reset (vendor's HDL).
void VdmaChannel::lock_to(const VdmaChannel& other) {
  other_ = &other;
  if (genlock_ != GenlockMode::master) cr_.set_reset_value(cr_.reset_value() | vdmacr::GenlockSrc);
}

void VdmaChannel::wire() {
  cr_.after_write([this](std::uint32_t word) { control(word); });
  sr_.after_write([this](std::uint32_t) { update(); });
  vsize_.after_write([this](std::uint32_t) { start(); });
}

void VdmaChannel::control(std::uint32_t word) {
  if ((word & vdmacr::Reset) != 0) return reset();
  const std::uint32_t count = cr_ >> vdmacr::IRQFrameCount_shift & vdmacr::count_mask;
  if (count == 0) cr_.set_bits(1u << vdmacr::IRQFrameCount_shift);
  sr_ = (sr_ & ~sr_count) | (cr_ & sr_count);
  if (cr_.any(vdmacr::DlyCnt_IrqEn) && (cr_ >> vdmacr::IRQDelayCount_shift) != 0) {
    vp::warn(*this, "/markervp/axi_vdma/delay",
             "interrupts of the delay counter are not modelled: none will come");
  }
  if (cr_.any(vdmacr::RS)) {
    sr_.clear_bits(vdmasr::Halted);
  } else if (!in_frame()) {
    halt();
  }
  update();
}

void VdmaChannel::start() {
  if (!cr_.any(vdmacr::RS)) return;  // remembered for the next start, which writes it again
  if (!is_order_possible()) {
    raise(vdmasr::VDMAIntErr);
    return halt();
  }
  if (armed_) return;  // the frame under way ends as it began
  armed_ = true;
  started();
}

bool VdmaChannel::is_order_possible() {
  const std::uint32_t stride = stride_ & 0xFFFF;
  std::string problem;
  if (vsize_ == 0 || hsize_ == 0) {
    problem = "VSIZE or HSIZE is 0 (VDMAIntErr)";
  } else if (!dre_ && stride % memory_bytes != 0 && vsize_ > 1) {
    problem = "the stride, " + std::to_string(stride) + ", is no multiple of " +
              std::to_string(memory_bytes) + " bytes, which a build without realignment needs";
  }
  for (std::uint32_t i = 0; i < frame_stores_ && problem.empty() && !dre_; ++i) {
    if (*addresses_[i] % memory_bytes != 0) {
      problem = "START_ADDRESS" + std::to_string(i + 1) + " is no multiple of " +
                std::to_string(memory_bytes) + " bytes, which a build without realignment needs";
    }
  }
  if (!problem.empty()) {
    vp::warn(*this, "/markervp/axi_vdma/order", std::string(title_) + ": " + problem);
  } else if (stride < hsize_ && vsize_ > 1) {
    vp::warn(*this, "/markervp/axi_vdma/stride",
             std::string(title_) + ": the stride, " + std::to_string(stride) +
                 " bytes, is less than HSIZE, " + std::to_string(hsize_.value()) +
                 ": lines overlap in memory");
    return true;
  }
  return problem.empty();
}

void VdmaChannel::order_stores() {
  m_axi.orders.is_cyclic = true;
  const std::uint32_t bytes = (vsize_ - 1) * (stride_ & 0xFFFF) + hsize_;
  const bool parks = !cr_.any(vdmacr::Circular_Park);
  if (parks)
    return m_axi.orders.add(*addresses_[(park_ >> park_shift_ & park_mask) % frame_stores_], bytes);
  const std::uint32_t count =
      cr_.any(vdmacr::FrameCntEn) ? (cr_ & sr_count) >> vdmacr::IRQFrameCount_shift : frame_stores_;
  for (std::uint32_t i = 0; i < std::min(count, frame_stores_); ++i)
    m_axi.orders.add(*addresses_[(following() + i) % frame_stores_], bytes);
}

VdmaChannel::Frame VdmaChannel::begin_frame() {
  const bool parks = !cr_.any(vdmacr::Circular_Park);
  const bool locked = cr_.any(vdmacr::GenlockEn) && cr_.any(vdmacr::GenlockSrc);
  if (cr_.any(vdmacr::GenlockEn) && !locked && !std::exchange(told_of_genlock_, true)) {
    vp::warn(*this, "/markervp/axi_vdma/genlock",
             std::string(title_) +
                 ": genlock with another core (GenlockSrc = 0) is not modelled: "
                 "the frame stores follow one another");
  }
  store_ = parks ? park_ >> park_shift_ & park_mask : next_store(locked ? other_ : nullptr);
  store_ %= frame_stores_;
  begun_ = true;
  return {vsize_, hsize_, stride_ & 0xFFFF, *addresses_[store_]};
}

void VdmaChannel::end_frame() {
  ++frames;
  m_axi.orders.end();
  newest_ = store_;
  std::uint32_t left = (sr_ & sr_count) >> vdmacr::IRQFrameCount_shift;
  const bool was_last = left <= 1;
  left = was_last ? (cr_ & sr_count) >> vdmacr::IRQFrameCount_shift : left - 1;
  sr_ = (sr_ & ~sr_count) | left << vdmacr::IRQFrameCount_shift;
  if (was_last) {
    sr_.set_bits(vdmasr::FrmCnt_Irq);
    if (cr_.any(vdmacr::FrameCntEn)) cr_.clear_bits(vdmacr::RS);
  }
  if (!cr_.any(vdmacr::RS)) halt();
  update();
}

void VdmaChannel::raise(std::uint32_t errors, bool interrupts) {
  sr_.set_bits(errors | (interrupts ? vdmasr::Err_Irq : 0));
  update();
}

void VdmaChannel::fail_on_bus(std::uint64_t address) {
  const bool nothing_there = m_axi.response() == tlm::TLM_ADDRESS_ERROR_RESPONSE;
  vp::warn(*this, "/markervp/axi_vdma/bus_error",
           std::string(title_) + ": " + vp::hex(static_cast<std::uint32_t>(address)) +
               (nothing_there ? " is out of reach of its memory port (DECERR): see its addresses "
                                "in the design"
                              : " refuses the access (SLVERR)"));
  raise(nothing_there ? vdmasr::VDMADecErr : vdmasr::VDMASlvErr);
  cr_.clear_bits(vdmacr::RS);
  abandon();
  halt();
}

void VdmaChannel::halt() {
  armed_ = false;
  cr_.clear_bits(vdmacr::RS);
  sr_.set_bits(vdmasr::Halted);
  m_axi.orders.drop();
  abandon();
}

void VdmaChannel::reset() {
  for (vp::Register* r : {&cr_, &sr_, &vsize_, &hsize_, &stride_}) r->reset();
  for (vp::Register* r : addresses_) r->reset();
  armed_ = begun_ = false;
  newest_ = -1;
  store_ = 0;
  m_axi.orders.drop();
  abandon();
  update();
}

std::string VdmaChannel::under_way() const {
  if (!armed_) return {};
  const bool sends = std::string(title_) == "MM2S";
  return std::string(title_) + " was " + (sends ? "sending" : "writing") + " frames of " +
         std::to_string(vsize_.value()) + " lines of " + std::to_string(hsize_.value()) +
         " bytes, " + std::to_string(frames.get()) + " of them so far,";
}

std::uint32_t VdmaChannel::store_behind(std::uint32_t store, std::uint32_t frames) const {
  return (store + frame_stores_ - frames % frame_stores_) % frame_stores_;
}

void VdmaChannel::update() {
  introut_ = (sr_ & cr_ & vdmasr::interrupts) != 0;
}

}  // namespace xilinx
