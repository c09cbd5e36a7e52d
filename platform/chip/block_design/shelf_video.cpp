#include <chip/block_design/shelf.h>

#include <string>
#include <utility>

// IP of video, by the parameters of the product guides.
namespace platform::block_design {

namespace {

ParameterRule fixed(const char* name, const char* value) {
  return {name, value, {value}};
}

/// The usual frame is one of 1280x720.
IpRule timing_controller() {
  std::vector<ParameterRule> list{
      {"C_HAS_AXI4_LITE", "1", {"0", "1"}}, {"C_GENERATE_EN", "1", {"0", "1"}},
      {"C_DETECT_EN", "1", {"0", "1"}},     fixed("C_SYNC_EN", "0"),
      fixed("C_INTERLACE_EN", "0"),         fixed("C_GEN_INTERLACED", "0"),
      fixed("C_ARBITRARY_RES_EN", "0"),     fixed("C_GEN_AUTO_SWITCH", "0"),
      {"C_NUM_FSYNCS", "1", {}, 1, 16}};
  const std::pair<const char*, const char*> sizes[] = {
      {"HACTIVE_SIZE", "1280"},   {"HFRAME_SIZE", "1650"},     {"HSYNC_START", "1390"},
      {"HSYNC_END", "1430"},      {"VACTIVE_SIZE", "720"},     {"F0_VFRAME_SIZE", "750"},
      {"F0_VSYNC_VSTART", "724"}, {"F0_VSYNC_VEND", "729"},    {"F0_VBLANK_HSTART", "1280"},
      {"F0_VBLANK_HEND", "1280"}, {"F0_VSYNC_HSTART", "1280"}, {"F0_VSYNC_HEND", "1280"}};
  for (const auto& [name, usual] : sizes) list.push_back({std::string("C_GEN_") + name, usual});
  for (const char* name : {"VBLANK", "HBLANK", "VSYNC", "HSYNC", "AVIDEO"})
    list.push_back({std::string("C_GEN_") + name + "_POLARITY", "1"});
  for (unsigned n = 0; n < 16; ++n) {
    list.push_back({"C_FSYNC_VSTART" + std::to_string(n), "0"});
    list.push_back({"C_FSYNC_HSTART" + std::to_string(n), "0"});
  }
  return {"v_tc", Kind::model,
          "video timing controller of progressive frames: generator, and detector of syncs and "
          "active video (PG016)",
          std::move(list)};
}

IpRule video_out() {
  return {"v_axi4s_vid_out",
          Kind::model,
          "AXI4-Stream to Video Out, a pixel a clock (PG044); `frames_to` writes its frames into "
          "files",
          {{"C_S_AXIS_VIDEO_FORMAT", "2", {}, 0, 15},
           {"C_COMPONENTS_PER_PIXEL", "3", {"1", "2", "3", "4"}},
           {"C_S_AXIS_COMPONENT_WIDTH", "8", {"8", "10", "12", "16"}},
           {"C_NATIVE_COMPONENT_WIDTH", "8", {"8", "10", "12", "16"}},
           {"C_ADDR_WIDTH", "10", {}, 5, 13},
           {"C_HYSTERESIS_LEVEL", "12", {}, 1, 8192},
           {"C_SYNC_LOCK_THRESHOLD", "4", {}, 1, 255},
           {"C_HAS_ASYNC_CLK", "0", {"0", "1"}},
           {"C_VTG_MASTER_SLAVE", "0", {"0", "1"}},
           fixed("C_PIXELS_PER_CLOCK", "1"),
           fixed("C_INCLUDE_PIXEL_REPEAT", "0"),
           fixed("C_INCLUDE_PIXEL_REMAP_420", "0"),
           fixed("C_ARBITRARY_RES_EN", "0")}};
}

IpRule video_in() {
  return {"v_vid_in_axi4s",
          Kind::model,
          "Video In to AXI4-Stream, a pixel a clock (PG043); `frames_from` puts files at its pins",
          {{"C_M_AXIS_VIDEO_FORMAT", "2", {}, 0, 15},
           {"C_COMPONENTS_PER_PIXEL", "3", {"1", "2", "3", "4"}},
           {"C_M_AXIS_COMPONENT_WIDTH", "8", {"8", "10", "12", "16"}},
           {"C_NATIVE_COMPONENT_WIDTH", "8", {"8", "10", "12", "16"}},
           {"C_ADDR_WIDTH", "10", {}, 5, 13},
           {"C_HAS_ASYNC_CLK", "0", {"0", "1"}},
           fixed("C_PIXELS_PER_CLOCK", "1"),
           fixed("C_INCLUDE_PIXEL_DROP", "0"),
           fixed("C_INCLUDE_PIXEL_REMAP_420", "0")}};
}

}  // namespace

std::vector<IpRule> video_rules() {
  return {timing_controller(), video_out(), video_in()};
}

}  // namespace platform::block_design
