#include <xilinx/v_axi4s_vid_out/v_axi4s_vid_out.h>

#include <vp/report.h>
#include <xilinx/bram/bram.h>
#include <xilinx/common/axi_lite_ip.h>
#include <xilinx/common/video_stream.h>

#include <string>

namespace xilinx {

namespace {

/// Places that the FIFO keeps free (registers of the published v3.0).
constexpr std::uint32_t guard = 3;

}  // namespace

VAxi4sVidOut::VAxi4sVidOut(sc_core::sc_module_name name, vp::Clock& vid_io_out_clk, vp::Clock& aclk,
                           const VAxi4sVidOutBuild& build)
    : Clocked(name, vid_io_out_clk),
      Ip(&vid_io_out_clk),
      fifo_depth("fifo_depth", build.fifo_depth, vp::Unit::none, {16, 1u << 16},
                 vp::Source::published, "pixels that its FIFO holds (PG044)"),
      hysteresis("hysteresis", build.hysteresis, vp::Unit::none, {1, 1u << 16},
                 vp::Source::published, "pixels in the FIFO before a frame begins (PG044)"),
      lock_frames("lock_frames", build.lock_frames, vp::Unit::none, {1, 255}, vp::Source::assumed,
                  "frames in a row that are in place when it locks: C_SYNC_LOCK_THRESHOLD"),
      frames_to("frames_to", "", vp::Source::decision,
                "folder for whole frames as PPM or PGM files; empty: none are written"),
      most_frames("most_frames", 100, vp::Unit::none, {1, 10'000}, vp::Source::decision,
                  "files that it writes; later frames are counted only"),
      component_order("component_order", "gbr", vp::Source::published,
                      "components of a pixel in such files, the lowest one first (UG934)"),
      vid_data("vid_data", build.components * build.native_bits),
      build_(build),
      stream_bytes_(video_stream_bytes(build.components, build.component_bits, build.native_bits,
                                       this->name())),
      fifo_(aclk, vid_io_out_clk, build.has_async_clk ? pointer_clocks : 1),
      stream_(std::make_unique<Stream>("stream", aclk, *this, stream_bytes_)),
      writer_(frames_to,
              {build.format, build.components, build.native_bits, component_order.get()}) {}

vp::IpEstimate VAxi4sVidOut::own_estimate() const {
  const std::uint32_t bits = build_.components * build_.component_bits + 3;
  vp::IpEstimate e = axi_estimate("v_axi4s_vid_out", 316, 586, block_ram_36(fifo_depth, bits));
  e.source = "public reports of syntheses out of context, 7 series, of 24 bits a pixel";
  return e;
}

void VAxi4sVidOut::before_end_of_elaboration() {
  Clocked::before_end_of_elaboration();
  for (vp::In<bool>* pin : {&vid_io_out_ce, &vid_io_out_reset, &aresetn, &vtg_active_video,
                            &vtg_hsync, &vtg_vsync, &vtg_hblank, &vtg_vblank})
    if (pin->bound()) pin->signal()->attach(*this);
}

bool VAxi4sVidOut::in_reset() const {
  return (vid_io_out_reset.bound() && vid_io_out_reset) || (aresetn.bound() && !aresetn);
}

void VAxi4sVidOut::reset() {
  waiting_.clear();
  aligned_ = in_frame_ = false;
  good_frames_ = 0;
  locked = false;
  underflow = false;
}

// ---- the timing

void VAxi4sVidOut::edge() {
  underflow = false;
  const bool enabled = !vid_io_out_ce.bound() || vid_io_out_ce;
  if (in_reset()) {
    reset();
    ce_one_ago_ = ce_two_ago_ = vtg_ce.written();
    vtg_ce = true;
    return sleep();
  }
  take_timing();
  bool held = !enabled;
  if (enabled) {
    if (!aligned_) drop_to_frame();
    if (!waiting_.empty()) held = show(waiting_.front()) == Step::held;
    if (!waiting_.empty() && !held) waiting_.pop_front();
  }
  ce_two_ago_ = ce_one_ago_;
  ce_one_ago_ = !held;
  vtg_ce = !held;
  const bool steady = ce_one_ago_ && ce_two_ago_ && waiting_.empty() && !last_timing_.active;
  const bool idle = steady && (aligned_ || fifo_.reader_level() == 0 || fifo_.front().first);
  if (idle && !underflow.written())
    return sleep_until(aligned_ ? vp::Clock::never : fifo_.next_visible());
  // It is held until pixels come, of which the stream's side tells.
  const bool waits = held && enabled && !ce_two_ago_ && waiting_.size() == 2;
  if (waits && fifo_.next_visible() == vp::Clock::never) return sleep();
  wake();
}

// The generator has moved on the last edge if it was enabled there, by what vtg_ce was before.
void VAxi4sVidOut::take_timing() {
  if (!ce_two_ago_) return;
  const auto high = [](const vp::In<bool>& pin) { return pin.bound() && pin.read(); };
  Timing now;
  now.levels = {high(vtg_hsync), high(vtg_vsync), high(vtg_hblank), high(vtg_vblank),
                high(vtg_active_video)};
  const VideoLevels& before = last_timing_;
  if (now.levels.vsync != before.vsync || now.levels.vblank != before.vblank) frame_next_ = true;
  now.first = now.levels.active && !before.active && frame_next_;
  if (now.levels.active) frame_next_ = false;
  last_timing_ = now.levels;
  waiting_.push_back(now);
}

VAxi4sVidOut::Step VAxi4sVidOut::show(const Timing& now) {
  if (now.first && !aligned_) {
    if (may_begin()) {
      aligned_ = true;
      in_frame_ = false;
      last_pixel_ = {0, false, true};
    } else if (!build_.timing_is_master) {
      return Step::held;
    }
  }
  if (aligned_ && shown_.active && !now.levels.active) end_line();
  if (now.levels.vsync != shown_.vsync && in_frame_) end_frame();
  vid_data = now.levels.active ? next_pixel(now) : 0;
  vid_active_video = now.levels.active;
  vid_hsync = now.levels.hsync;
  vid_vsync = now.levels.vsync;
  vid_hblank = now.levels.hblank;
  vid_vblank = now.levels.vblank;
  shown_ = now.levels;
  return Step::passed;
}

// ---- the pixels

bool VAxi4sVidOut::may_begin() {
  return fifo_.reader_level() >= hysteresis && fifo_.front().first;
}

void VAxi4sVidOut::drop_to_frame() {
  if (fifo_.reader_level() != 0 && !fifo_.front().first) pop();
}

VAxi4sVidOut::Pixel VAxi4sVidOut::pop() {
  const Pixel pixel = fifo_.front();
  fifo_.pop();
  if (stream_->waits_for_room()) stream_->wake();
  return pixel;
}

std::uint64_t VAxi4sVidOut::next_pixel(const Timing& now) {
  if (aligned_ && fifo_.reader_level() == 0) {
    underflow = true;
    lose("its FIFO ran empty: what sends the stream is too slow for this pixel clock");
  }
  if (aligned_ && fifo_.front().first != now.first)
    lose("a frame of the stream has another number of lines than the timing");
  if (aligned_ && shown_.active && last_pixel_.last)
    lose("a line of the stream is shorter than that of the timing");
  if (!aligned_) {
    ++black;
    return 0;
  }
  if (now.first) begin_frame();
  last_pixel_ = pop();
  last_pixel_.data =
      resized(last_pixel_.data, build_.components, build_.component_bits, build_.native_bits);
  if (writer_.is_on() && in_frame_) writer_.add(last_pixel_.data);
  return last_pixel_.data;
}

void VAxi4sVidOut::begin_frame() {
  in_frame_ = true;
  if (writer_.is_on()) writer_.begin();
}

void VAxi4sVidOut::end_line() {
  if (!last_pixel_.last) return lose("a line of the stream is longer than that of the timing");
  if (writer_.is_on() && in_frame_) writer_.end_line();
}

void VAxi4sVidOut::end_frame() {
  in_frame_ = false;
  ++frames;
  if (++good_frames_ >= lock_frames) locked = true;
  if (writer_.is_on() && writer_.written() < most_frames) writer_.end();
}

void VAxi4sVidOut::lose(const char* why) {
  aligned_ = in_frame_ = false;
  good_frames_ = 0;
  locked = false;
  if (warned_) return;
  warned_ = true;
  vp::warn(*this, "/markervp/v_axi4s_vid_out/lock", std::string("it lost its lock: ") + why);
}

// ---- the stream

VAxi4sVidOut::Stream::Stream(sc_core::sc_module_name name, vp::Clock& aclk, VAxi4sVidOut& out,
                             unsigned bytes)
    : Clocked(name, aclk), out_(out), bytes_(bytes) {
  vp::StreamShape shape{std::string(out.name()) + ".s_axis_video", bytes};
  shape.user = 1;
  shape.ignores_upper_bits = true;
  s_axis_video.set_shape(shape);
  wake_on(s_axis_video.tvalid);
}

void VAxi4sVidOut::Stream::end_of_elaboration() {
  Clocked::end_of_elaboration();
  user_ = start_of_frame(s_axis_video.link());
  if (out_.aclken.bound()) out_.aclken.signal()->attach(*this);
  if (out_.aresetn.bound()) out_.aresetn.signal()->attach(*this);
}

void VAxi4sVidOut::Stream::edge() {
  const bool took = s_axis_video.sample();
  if (took) {
    out_.fifo_.push({video_data(s_axis_video.link().beat(), bytes_),
                     user_ && (user_->get() & 1) != 0, s_axis_video.tlast.read()});
    if (!out_.aligned_) out_.wake();
  }
  const std::size_t level = out_.fifo_.writer_level();
  full_ = level + guard >= out_.fifo_depth;
  const bool stopped =
      (out_.aresetn.bound() && !out_.aresetn) || (out_.aclken.bound() && !out_.aclken);
  s_axis_video.tready = !full_ && !stopped;
  if (stopped) return sleep();
  if (full_) return sleep_until(out_.fifo_.next_free());
  if (!took && !s_axis_video.tvalid.read()) return sleep();
  wake();
}

}  // namespace xilinx
