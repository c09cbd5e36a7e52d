#include <xilinx/axi_vdma/axi_vdma.h>

#include <string>

#include <vp/error.h>
#include <xilinx/bram/bram.h>
#include <xilinx/common/axi_lite_ip.h>

namespace xilinx {

namespace {

using namespace axi_vdma;

}  // namespace

AxiVdma::AxiVdma(sc_core::sc_module_name name, vp::Clock& s_axi_lite_aclk, vp::Clock& mm2s_aclk,
                 vp::Clock& s2mm_aclk, const AxiVdmaBuild& build)
    : Clocked(name, s_axi_lite_aclk),
      Ip(build.mm2s.include ? &mm2s_aclk : &s2mm_aclk),
      frame_stores("frame_stores", build.frame_stores, vp::Unit::none, {1, most_frame_stores},
                   vp::Source::published, "build option Frame Buffers (PG020)"),
      s_axi_lite("s_axi_lite", registers, axi_lite_options(address_bits),
                 &s_axi_lite_aclk.scheduler()) {
  if (!build.mm2s.include && !build.s2mm.include)
    throw vp::InputError(std::string(this->name()) + ": it has no channel: build one");
  if (build.mm2s.include) {
    mm2s_ = std::make_unique<VdmaReader>("mm2s", mm2s_aclk, s_axi_lite, build.mm2s, frame_stores,
                                         mm2s_introut);
  } else {
    remove_channel(axi_vdma::mm2s);
  }
  if (build.s2mm.include) {
    s2mm_ = std::make_unique<VdmaWriter>("s2mm", s2mm_aclk, s_axi_lite, build.s2mm, frame_stores,
                                         s2mm_introut);
  } else {
    remove_channel(axi_vdma::s2mm);
    s_axi_lite[S2MM_VDMA_IRQ_MASK].remove();
  }
  if (has_internal_genlock()) {
    mm2s_->lock_to(*s2mm_);
    s2mm_->lock_to(*mm2s_);
  }
  vp::Register& park = s_axi_lite[PARK_PTR_REG];
  park.computed_by([this, &park] {
    const std::uint32_t reads = mm2s_ ? mm2s_->store() : 0, writes = s2mm_ ? s2mm_->store() : 0;
    return park.value() | reads << 16 | writes << 24;
  });
}

bool AxiVdma::has_internal_genlock() const {
  if (!mm2s_ || !s2mm_) return false;
  const GenlockMode reads = mm2s_->genlock(), writes = s2mm_->genlock();
  const auto pair = [&](GenlockMode leads, GenlockMode follows) {
    return (reads == leads && writes == follows) || (writes == leads && reads == follows);
  };
  return pair(GenlockMode::master, GenlockMode::slave) ||
         pair(GenlockMode::dynamic_master, GenlockMode::dynamic_slave);
}

void AxiVdma::remove_channel(const ChannelOffsets& offsets) {
  for (const std::uint32_t offset :
       {offsets.control, offsets.status, offsets.vsize, offsets.hsize, offsets.stride}) {
    s_axi_lite[offset].remove();
  }
  for (std::uint32_t i = 0; i < most_frame_stores; ++i)
    s_axi_lite[offsets.first_address + 4 * i].remove();
}

void AxiVdma::before_end_of_elaboration() {
  Clocked::before_end_of_elaboration();
  if (axi_resetn.bound()) axi_resetn.signal()->attach(*this);
}

void AxiVdma::start_of_simulation() {
  s_axi_lite.hold_in_reset(axi_resetn.bound() && !axi_resetn);
}

void AxiVdma::on_change(vp::SignalBase&, std::uint32_t) {
  if (!axi_resetn) {
    s_axi_lite.reset();
    if (mm2s_) mm2s_->reset();
    if (s2mm_) s2mm_->reset();
  }
  s_axi_lite.hold_in_reset(!axi_resetn);
}

// Two channels of 64 bits with three frame stores have about 2600 LUT and 3900 FF in public
// reports. The line buffers are block memory. DataMover: 150 MHz (PG022, -1).
vp::IpEstimate AxiVdma::own_estimate() const {
  const std::uint32_t channels = (mm2s_ ? 1u : 0u) + (s2mm_ ? 1u : 0u);
  double memory = 0;
  for (const VdmaChannel* channel : {static_cast<const VdmaChannel*>(mm2s_.get()),
                                     static_cast<const VdmaChannel*>(s2mm_.get())}) {
    if (channel) memory += block_ram_36(channel->line_buffer, 8 * channel->stream_bytes + 4);
  }
  vp::IpEstimate e = axi_estimate("axi_vdma", 300 + 1150 * channels, 500 + 1700 * channels, memory);
  e.fmax_hz = 150'000'000;
  e.active_clocks = [this] {
    std::uint64_t clocks = clocks_per_access * accesses(s_axi_lite);
    if (mm2s_) clocks += mm2s_->m_axi.link.bytes_read / mm2s_->memory_bytes;
    if (s2mm_) clocks += s2mm_->m_axi.link.bytes_written / s2mm_->memory_bytes;
    return clocks;
  };
  return e;
}

}  // namespace xilinx
