#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include <chip/block_design/place_ports.h>
#include <xilinx/v_axi4s_vid_out/v_axi4s_vid_out.h>
#include <xilinx/v_tc/v_tc.h>
#include <xilinx/v_vid_in_axi4s/v_vid_in_axi4s.h>

// IP of video: timing, and bridges between native video and streams.
namespace platform::block_design {

namespace {

/// A clock enable that the model does not have may be tied high, or be left open.
void expect_enabled(const Placement& at, const std::string& pin, Placed& placed) {
  placed.unused_inputs.insert(pin);
  const auto source = at.part.pins.find(pin);
  if (source == at.part.pins.end()) return;
  const PlacedPart* driver = at.design.part(source->second.part);
  const IpRule* rule = driver ? driver->rule() : nullptr;
  if (rule && (rule->ip == "xlconstant" || rule->ip == "ilconstant")) return;
  at.refuse("its pin " + pin + " is driven by " + source->second.text() +
            ", and its model has no clock enable there: tie it high, or leave the part out with "
            "'as: stub'");
}

xilinx::VideoTiming timing_of(const Placement& at) {
  xilinx::VideoTiming t;
  t.hactive = word(at, "C_GEN_HACTIVE_SIZE");
  t.htotal = word(at, "C_GEN_HFRAME_SIZE");
  t.hsync_start = word(at, "C_GEN_HSYNC_START");
  t.hsync_end = word(at, "C_GEN_HSYNC_END");
  t.vactive = word(at, "C_GEN_VACTIVE_SIZE");
  t.vtotal = word(at, "C_GEN_F0_VFRAME_SIZE");
  t.vsync_start = word(at, "C_GEN_F0_VSYNC_VSTART");
  t.vsync_end = word(at, "C_GEN_F0_VSYNC_VEND");
  t.vblank_hstart = word(at, "C_GEN_F0_VBLANK_HSTART");
  t.vblank_hend = word(at, "C_GEN_F0_VBLANK_HEND");
  t.vsync_hstart = word(at, "C_GEN_F0_VSYNC_HSTART");
  t.vsync_hend = word(at, "C_GEN_F0_VSYNC_HEND");
  return t;
}

xilinx::VTcBuild timing_controller(const Placement& at) {
  namespace polarity = v_tc::polarity;
  xilinx::VTcBuild build;
  build.has_axi4_lite = at.flag("C_HAS_AXI4_LITE");
  build.generate = at.flag("C_GENERATE_EN");
  build.detect = at.flag("C_DETECT_EN");
  build.timing = timing_of(at);
  build.frame_syncs = std::clamp<std::uint32_t>(word(at, "C_NUM_FSYNCS"), 1, v_tc::frame_syncs);
  for (unsigned n = 0; n < build.frame_syncs; ++n) {
    const std::string number = std::to_string(n);
    build.frame_sync[n] = {word(at, "C_FSYNC_VSTART" + number),
                           word(at, "C_FSYNC_HSTART" + number)};
  }
  const std::pair<const char*, std::uint32_t> outputs[] = {{"VBLANK", polarity::VBLANK},
                                                           {"HBLANK", polarity::HBLANK},
                                                           {"VSYNC", polarity::VSYNC},
                                                           {"HSYNC", polarity::HSYNC},
                                                           {"AVIDEO", polarity::ACTIVE_VIDEO}};
  for (const auto& [name, bit] : outputs) {
    if (!at.flag("C_GEN_" + std::string(name) + "_POLARITY")) build.polarity &= ~bit;
  }
  return build;
}

Placed place_timing(const Placement& at) {
  auto tc =
      std::make_unique<xilinx::VTc>(at.part.name.c_str(), at.clock({"clk"}), timing_controller(at));
  Placed placed;
  placed.slaves = {{"ctrl", registers(tc->ctrl)}};
  placed.inputs = {{"resetn", input(at, "resetn", tc->resetn)},
                   {"s_axi_aresetn", input(at, "s_axi_aresetn", tc->s_axi_aresetn)},
                   {"clken", input(at, "clken", tc->clken)},
                   {"gen_clken", input(at, "gen_clken", tc->gen_clken)},
                   {"det_clken", input(at, "det_clken", tc->det_clken)},
                   {"hsync_in", input(at, "hsync_in", tc->hsync_in)},
                   {"vsync_in", input(at, "vsync_in", tc->vsync_in)},
                   {"active_video_in", input(at, "active_video_in", tc->active_video_in)}};
  // The detector finds all that it shows from syncs and active video. What follows is looked at by
  // generators that are built to follow a frame sync, and by none here.
  placed.unused_inputs = {"hblank_in",   "vblank_in", "active_chroma_in",
                          "field_id_in", "fsync_in",  "sof_state"};
  expect_enabled(at, "s_axi_aclken", placed);
  placed.outputs = {{"hsync_out", &tc->hsync_out},
                    {"vsync_out", &tc->vsync_out},
                    {"hblank_out", &tc->hblank_out},
                    {"vblank_out", &tc->vblank_out},
                    {"fsync_out", &tc->fsync_out},
                    {"active_video_out", &tc->active_video_out},
                    {"irq", &tc->irq}};
  placed.object = std::move(tc);
  return placed;
}

/// The clock of the native side; that of the stream where the IP has one clock.
vp::Clock& native_clock(const Placement& at, const std::string& pin, bool has_async_clk) {
  return has_async_clk ? at.clock({pin}) : at.clock({"aclk"});
}

Placed place_video_out(const Placement& at) {
  xilinx::VAxi4sVidOutBuild build;
  build.format = static_cast<xilinx::VideoFormat>(word(at, "C_S_AXIS_VIDEO_FORMAT"));
  build.components = word(at, "C_COMPONENTS_PER_PIXEL");
  build.component_bits = word(at, "C_S_AXIS_COMPONENT_WIDTH");
  build.native_bits = word(at, "C_NATIVE_COMPONENT_WIDTH");
  build.fifo_depth = 1u << word(at, "C_ADDR_WIDTH");
  build.hysteresis = word(at, "C_HYSTERESIS_LEVEL");
  build.lock_frames = word(at, "C_SYNC_LOCK_THRESHOLD");
  build.has_async_clk = at.flag("C_HAS_ASYNC_CLK");
  build.timing_is_master = at.flag("C_VTG_MASTER_SLAVE");
  vp::Clock& aclk = at.clock({"aclk"});
  auto out = std::make_unique<xilinx::VAxi4sVidOut>(
      at.part.name.c_str(), native_clock(at, "vid_io_out_clk", build.has_async_clk), aclk, build);
  Placed placed;
  placed.inputs = {{"aresetn", input(at, "aresetn", out->aresetn)},
                   {"aclken", input(at, "aclken", out->aclken)},
                   {"vid_io_out_ce", input(at, "vid_io_out_ce", out->vid_io_out_ce)},
                   {"vid_io_out_reset", input(at, "vid_io_out_reset", out->vid_io_out_reset)},
                   {"vtg_active_video", input(at, "vtg_active_video", out->vtg_active_video)},
                   {"vtg_hsync", input(at, "vtg_hsync", out->vtg_hsync)},
                   {"vtg_vsync", input(at, "vtg_vsync", out->vtg_vsync)},
                   {"vtg_hblank", input(at, "vtg_hblank", out->vtg_hblank)},
                   {"vtg_vblank", input(at, "vtg_vblank", out->vtg_vblank)}};
  placed.unused_inputs = {"fid", "vtg_field_id"};  // of interlaced frames
  placed.outputs = {{"vtg_ce", &out->vtg_ce},         {"vid_active_video", &out->vid_active_video},
                    {"vid_hsync", &out->vid_hsync},   {"vid_vsync", &out->vid_vsync},
                    {"vid_hblank", &out->vid_hblank}, {"vid_vblank", &out->vid_vblank},
                    {"vid_data", &out->vid_data},     {"locked", &out->locked},
                    {"overflow", &out->overflow},     {"underflow", &out->underflow}};
  placed.stream_slaves["video_in"] = {
      [model = out.get()](vp::AxiStream& link, vp::Clock&) { model->s_axis_video()(link); }, &aclk,
      out->stream_bytes()};
  placed.object = std::move(out);
  return placed;
}

Placed place_video_in(const Placement& at) {
  xilinx::VVidInAxi4sBuild build;
  build.format = static_cast<xilinx::VideoFormat>(word(at, "C_M_AXIS_VIDEO_FORMAT"));
  build.components = word(at, "C_COMPONENTS_PER_PIXEL");
  build.component_bits = word(at, "C_M_AXIS_COMPONENT_WIDTH");
  build.native_bits = word(at, "C_NATIVE_COMPONENT_WIDTH");
  build.fifo_depth = 1u << word(at, "C_ADDR_WIDTH");
  build.has_async_clk = at.flag("C_HAS_ASYNC_CLK");
  vp::Clock& aclk = at.clock({"aclk"});
  auto in = std::make_unique<xilinx::VVidInAxi4s>(
      at.part.name.c_str(), native_clock(at, "vid_io_in_clk", build.has_async_clk), aclk, build);
  Placed placed;
  placed.inputs = {{"aresetn", input(at, "aresetn", in->aresetn)},
                   {"aclken", input(at, "aclken", in->aclken)},
                   {"axis_enable", input(at, "axis_enable", in->axis_enable)},
                   {"vid_io_in_ce", input(at, "vid_io_in_ce", in->vid_io_in_ce)},
                   {"vid_io_in_reset", input(at, "vid_io_in_reset", in->vid_io_in_reset)},
                   {"vid_active_video", input(at, "vid_active_video", in->vid_active_video)},
                   {"vid_hsync", input(at, "vid_hsync", in->vid_hsync)},
                   {"vid_vsync", input(at, "vid_vsync", in->vid_vsync)},
                   {"vid_hblank", input(at, "vid_hblank", in->vid_hblank)},
                   {"vid_vblank", input(at, "vid_vblank", in->vid_vblank)},
                   {"vid_data", input(at, "vid_data", in->vid_data)}};
  placed.unused_inputs = {"vid_field_id"};
  placed.outputs = {{"vtd_active_video", &in->vtd_active_video},
                    {"vtd_hsync", &in->vtd_hsync},
                    {"vtd_vsync", &in->vtd_vsync},
                    {"vtd_hblank", &in->vtd_hblank},
                    {"vtd_vblank", &in->vtd_vblank},
                    {"overflow", &in->overflow},
                    {"underflow", &in->underflow}};
  placed.stream_masters["video_out"] = {
      [model = in.get()](vp::AxiStream& link, vp::Clock&) { model->m_axis_video()(link); }, &aclk,
      in->stream_bytes()};
  placed.object = std::move(in);
  return placed;
}

}  // namespace

Placer video_placer(const std::string& ip) {
  static const std::map<std::string, Placer> placers{{"v_tc", place_timing},
                                                     {"v_axi4s_vid_out", place_video_out},
                                                     {"v_vid_in_axi4s", place_video_in}};
  const auto found = placers.find(ip);
  return found == placers.end() ? nullptr : found->second;
}

}  // namespace platform::block_design
