#include <xilinx/v_vid_in_axi4s/v_vid_in_axi4s.h>

#include <algorithm>

#include <vp/error.h>
#include <vp/report.h>
#include <xilinx/bram/bram.h>
#include <xilinx/common/axi_lite_ip.h>
#include <xilinx/common/video_stream.h>

namespace xilinx {

VVidInAxi4s::VVidInAxi4s(sc_core::sc_module_name name, vp::Clock& vid_io_in_clk, vp::Clock& aclk,
                         const VVidInAxi4sBuild& build)
    : Clocked(name, vid_io_in_clk),
      Ip(&vid_io_in_clk),
      fifo_depth("fifo_depth", build.fifo_depth, vp::Unit::none, {16, 1u << 16},
                 vp::Source::published, "pixels that its FIFO holds (PG043)"),
      input_clocks("input_clocks", 3, vp::Unit::cycles, {1, 64}, vp::Source::derived,
                   "a pixel at the pins to the FIFO: registers of the published v3.0"),
      frames_from("frames_from", "", vp::Source::decision,
                  "PPM or PGM files at the native pins, one after the other, with a comma between; "
                  "empty: what is wired there"),
      component_order("component_order", "gbr", vp::Source::published,
                      "components of a pixel in such files, the lowest one first (UG934)"),
      build_(build),
      stream_bytes_(video_stream_bytes(build.components, build.component_bits, build.native_bits,
                                       this->name())),
      fifo_(vid_io_in_clk, aclk, build.has_async_clk ? pointer_clocks : 1),
      stream_(std::make_unique<Stream>("stream", aclk, *this)),
      camera_(frames_from,
              {build.format, build.components, build.native_bits, component_order.get()},
              this->name()) {}

vp::IpEstimate VVidInAxi4s::own_estimate() const {
  const std::uint32_t bits = build_.components * build_.component_bits + 3;
  vp::IpEstimate e = axi_estimate("v_vid_in_axi4s", 219, 511, block_ram_36(fifo_depth, bits));
  e.source = "public reports of syntheses out of context, 7 series, of 24 bits a pixel";
  e.active_clocks = [this] { return pixels.get(); };
  return e;
}

void VVidInAxi4s::before_end_of_elaboration() {
  Clocked::before_end_of_elaboration();
  if (camera_.is_on()) return;
  for (vp::In<bool>* pin : {&vid_io_in_ce, &vid_io_in_reset, &vid_active_video, &vid_hsync,
                            &vid_vsync, &vid_hblank, &vid_vblank})
    if (pin->bound()) pin->signal()->attach(*this);
}

bool VVidInAxi4s::in_reset() const {
  return (vid_io_in_reset.bound() && vid_io_in_reset) || (aresetn.bound() && !aresetn);
}

VVidInAxi4s::Sample VVidInAxi4s::sample(std::uint64_t cycle) const {
  if (camera_.is_on()) {
    Sample now{camera_.levels(cycle)};
    if (now.levels.active) now.data = camera_.data(cycle);
    return now;
  }
  const auto high = [](const vp::In<bool>& pin) { return pin.bound() && pin.read(); };
  return {{high(vid_hsync), high(vid_vsync), high(vid_hblank), high(vid_vblank),
           high(vid_active_video)},
          vid_data.bound() ? vid_data.read() : 0};
}

void VVidInAxi4s::edge() {
  const std::uint64_t cycle = this_edge();
  overflow = false;
  const bool enabled = camera_.is_on() || !vid_io_in_ce.bound() || vid_io_in_ce;
  if (in_reset()) {
    on_way_.clear();
    holds_ = flows_ = false;
  } else if (enabled) {
    ++ticks_;
    take(sample(cycle));
    write_due();
  }
  if (last_.active || holds_ || !on_way_.empty() || overflow.written()) return wake();
  sleep_until(camera_.is_on() ? camera_.next_change(cycle) : vp::Clock::never);
}

void VVidInAxi4s::take(const Sample& now) {
  vtd_active_video = now.levels.active;
  vtd_hsync = now.levels.hsync;
  vtd_vsync = now.levels.vsync;
  vtd_hblank = now.levels.hblank;
  vtd_vblank = now.levels.vblank;
  const bool vertical = now.levels.vsync || now.levels.vblank;
  if (vertical && !(last_.vsync || last_.vblank)) frame_next_ = true;
  const bool starts = now.levels.active && !last_.active;
  if (holds_) {
    held_.pixel.last = !now.levels.active;
    on_way_.push_back(held_);
    holds_ = false;
  }
  if (now.levels.active) {
    ++pixels;
    const std::uint64_t data =
        resized(now.data, build_.components, build_.native_bits, build_.component_bits);
    held_ = {{data, starts && frame_next_, false}, ticks_ + input_clocks};
    holds_ = true;
  }
  if (starts) frame_next_ = false;
  last_ = now.levels;
}

void VVidInAxi4s::write_due() {
  while (!on_way_.empty() && on_way_.front().due <= ticks_) {
    write(on_way_.front().pixel);
    on_way_.pop_front();
  }
}

// Nothing before the first pixel of a frame goes out.
void VVidInAxi4s::write(const Pixel& pixel) {
  if (axis_enable.bound() && !axis_enable) {
    flows_ = false;
    return;
  }
  flows_ = flows_ || pixel.first;
  if (!flows_) return;
  if (fifo_.writer_level() < fifo_depth) {
    fifo_.push(pixel);
    stream_->wake();
    return;
  }
  overflow = true;
  ++lost;
  if (lost.get() != 1) return;
  vp::warn(*this, "/markervp/v_vid_in_axi4s/overflow",
           "its FIFO is full, and pixels are lost: what takes the stream is too slow, or not "
           "running yet");
}

// ---- the stream

VVidInAxi4s::Stream::Stream(sc_core::sc_module_name name, vp::Clock& aclk, VVidInAxi4s& in)
    : Clocked(name, aclk), in_(in) {
  vp::StreamShape shape{std::string(in.name()) + ".m_axis_video", in.stream_bytes_};
  shape.user = 1;
  m_axis_video.set_shape(shape);
  wake_on(m_axis_video.tready);
}

void VVidInAxi4s::Stream::end_of_elaboration() {
  Clocked::end_of_elaboration();
  user_ = start_of_frame(m_axis_video.link());
  if (in_.aclken.bound()) in_.aclken.signal()->attach(*this);
}

void VVidInAxi4s::Stream::edge() {
  if (!m_axis_video.free()) return sleep();
  const bool stopped = in_.aclken.bound() && !in_.aclken;
  Fifo& fifo = in_.fifo_;
  if (stopped || fifo.reader_level() == 0) {
    m_axis_video.withdraw();
    return sleep_until(stopped ? vp::Clock::never : fifo.next_visible());
  }
  offer(fifo.front());
  fifo.pop();
  if (!m_axis_video.tready) return sleep();
  wake();
}

void VVidInAxi4s::Stream::offer(const Pixel& pixel) {
  if (user_) *user_ = pixel.first ? 1 : 0;
  m_axis_video.offer(video_beat(pixel.data, in_.stream_bytes_), pixel.last);
}

}  // namespace xilinx
