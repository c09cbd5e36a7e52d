// IP of video and of streams as parts of a design: from a camera of files through the memory to a
// screen of files, and how hand-offs have them.
#include <axi_vdma_registers.h>
#include <chip/block_design/import_design.h>
#include <chip/handoff/handoff.h>
#include <v_tc_registers.h>
#include <vp/file.h>
#include <xilinx/axi_vdma/axi_vdma.h>
#include <xilinx/axis_clock_fifo/axis_clock_fifo.h>
#include <xilinx/axis_subset_converter/axis_subset_converter.h>
#include <xilinx/fifo_generator/fifo_generator.h>
#include <xilinx/v_axi4s_vid_out/v_axi4s_vid_out.h>
#include <xilinx/v_tc/v_tc.h>
#include <xilinx/v_vid_in_axi4s/v_vid_in_axi4s.h>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <string>

#include "built_design.h"
#include "input_error.h"
#include "small_handoff.h"
#include "temporary_files.h"

using kit::BuiltDesign;
using kit::replaced;
using platform::block_design::ImportedPart;
using platform::block_design::Kind;

namespace {

std::string video_part(const std::string& name, const std::string& ip,
                       const std::string& parameters, const std::string& pins,
                       const std::string& buses) {
  return "  " + name + ":\n    ip: xilinx.com:ip:" + ip + "\n    parameters: {" + parameters +
         "}\n    pins: {" + pins + "}\n    buses: {" + buses + "}\n";
}

constexpr unsigned width = 16, height = 8;
/// Stream at 100 MHz and pixels at 50; between camera and memory a FIFO of two clocks and a
/// converter that swaps two components, and swaps them back before the screen.
std::string pipeline() {
  const std::string on = "aclk: ps.FCLK_CLK0, aresetn: rst.peripheral_aresetn";
  const std::string swap =
      "S_TDATA_NUM_BYTES: 3, M_TDATA_NUM_BYTES: 3, S_TUSER_WIDTH: 1, "
      "M_TUSER_WIDTH: 1, TDATA_REMAP: 'tdata[15:8],tdata[23:16],tdata[7:0]'";
  return "name: video\nsettings:\n  device: xc7z020-1\n  ps.fclk_clk0.frequency: 100 MHz\n"
         "  ps.fclk_clk1.frequency: 50 MHz\nparts:\n" +
         video_part("ps", "processing_system7:5.5", "", "M_AXI_GP0_ACLK: ps.FCLK_CLK0",
                    "S_AXI_HP0: mem.M00_AXI") +
         video_part("rst", "proc_sys_reset:5.0", "",
                    "slowest_sync_clk: ps.FCLK_CLK0, ext_reset_in: ps.FCLK_RESET0_N", "") +
         video_part("bus", "axi_interconnect:2.1", "", "ACLK: ps.FCLK_CLK0",
                    "S00_AXI: ps.M_AXI_GP0") +
         video_part("mem", "axi_interconnect:2.1", "", "ACLK: ps.FCLK_CLK0",
                    "S00_AXI: vdma.M_AXI_MM2S, S01_AXI: vdma.M_AXI_S2MM") +
         video_part("one", "xlconstant:1.1", "", "", "") +
         video_part("camera", "v_vid_in_axi4s:5.0", "C_HAS_ASYNC_CLK: 1",
                    "aclk: ps.FCLK_CLK1, aclken: one.dout, vid_io_in_clk: ps.FCLK_CLK1", "") +
         video_part("fifo", "axis_data_fifo:2.0",
                    "TDATA_NUM_BYTES: 3, TUSER_WIDTH: 1, IS_ACLK_ASYNC: 1, FIFO_DEPTH: 64",
                    "s_axis_aclk: ps.FCLK_CLK1, m_axis_aclk: ps.FCLK_CLK0, "
                    "s_axis_aresetn: rst.peripheral_aresetn",
                    "S_AXIS: camera.video_out") +
         video_part("swap_in", "axis_subset_converter:1.1", swap, on, "S_AXIS: fifo.M_AXIS") +
         video_part("vdma", "axi_vdma:6.3",
                    "C_MM2S_GENLOCK_MODE: 3, C_S2MM_GENLOCK_MODE: 2, "
                    "C_M_AXIS_MM2S_TDATA_WIDTH: 24, C_S_AXIS_S2MM_TDATA_WIDTH: 24",
                    "s_axi_lite_aclk: ps.FCLK_CLK0, m_axi_mm2s_aclk: ps.FCLK_CLK0, "
                    "m_axis_mm2s_aclk: ps.FCLK_CLK0, m_axi_s2mm_aclk: ps.FCLK_CLK0, "
                    "s_axis_s2mm_aclk: ps.FCLK_CLK0, axi_resetn: rst.peripheral_aresetn",
                    "S_AXI_LITE: bus.M00_AXI, S_AXIS_S2MM: swap_in.M_AXIS") +
         video_part("swap_out", "axis_subset_converter:1.1", swap, on, "S_AXIS: vdma.M_AXIS_MM2S") +
         video_part("tc", "v_tc:6.2",
                    "C_DETECT_EN: 0, C_GEN_HACTIVE_SIZE: 16, C_GEN_HFRAME_SIZE: 176, "
                    "C_GEN_HSYNC_START: 64, C_GEN_HSYNC_END: 96, C_GEN_VACTIVE_SIZE: 8, "
                    "C_GEN_F0_VFRAME_SIZE: 38, C_GEN_F0_VSYNC_VSTART: 10, "
                    "C_GEN_F0_VSYNC_VEND: 16, C_GEN_F0_VBLANK_HSTART: 16, "
                    "C_GEN_F0_VBLANK_HEND: 16, C_GEN_F0_VSYNC_HSTART: 64, "
                    "C_GEN_F0_VSYNC_HEND: 64",
                    "clk: ps.FCLK_CLK1, s_axi_aclk: ps.FCLK_CLK0, gen_clken: screen.vtg_ce, "
                    "s_axi_aresetn: rst.peripheral_aresetn",
                    "ctrl: bus.M01_AXI") +
         video_part("screen", "v_axi4s_vid_out:4.0", "C_HAS_ASYNC_CLK: 1, C_SYNC_LOCK_THRESHOLD: 2",
                    on + ", vid_io_out_clk: ps.FCLK_CLK1, vtg_active_video: tc.active_video_out, "
                         "vtg_vsync: tc.vsync_out, vtg_hsync: tc.hsync_out, "
                         "vtg_vblank: tc.vblank_out, vtg_hblank: tc.hblank_out",
                    "video_in: swap_out.M_AXIS") +
         "addresses:\n  ps.M_AXI_GP0:\n    vdma.S_AXI_LITE: [0x43000000, 64 KiB]\n"
         "    tc.ctrl: [0x43C00000, 64 KiB]\n"
         "  vdma.M_AXI_MM2S:\n    ps.S_AXI_HP0: [0x0, 512 MiB]\n"
         "  vdma.M_AXI_S2MM:\n    ps.S_AXI_HP0: [0x0, 512 MiB]\n";
}

void start(xilinx::AxiVdma& vdma, const axi_vdma::ChannelOffsets& channel, std::uint32_t control) {
  constexpr std::uint32_t stores = 0x1000'0000, store_size = 0x1000;
  auto& bank = vdma.s_axi_lite;
  BuiltDesign::write(bank, channel.control, control);
  for (std::uint32_t n = 0; n < 3; ++n)
    BuiltDesign::write(bank, channel.first_address + 4 * n, stores + n * store_size);
  BuiltDesign::write(bank, channel.stride, 3 * width);
  BuiltDesign::write(bank, channel.hsize, 3 * width);
  BuiltDesign::write(bank, channel.vsize, height);
}

/// Edges run up to here, and none ahead of it.
void pass_exactly_us(unsigned us) {
  sc_core::sc_event end;
  end.notify(us, sc_core::SC_US);
  BuiltDesign::pass_us(us);
}

xilinx::VideoPicture some_picture(unsigned first) {
  xilinx::VideoPicture picture;
  picture.width = width;
  picture.height = height;
  for (unsigned i = 0; i < 3 * width * height; ++i)
    picture.bytes.push_back(static_cast<unsigned char>(first + 7 * i));
  return picture;
}

std::string problem(const std::string& what, const std::string& by) {
  return input_error([&] { const BuiltDesign chip(replaced(pipeline(), what, by)); });
}

/// The part of the name in an import of a design with one more part.
ImportedPart imported(const std::string& vlnv, const std::string& parameters,
                      const std::string& pins = "") {
  kit::HwhText text = kit::small_handoff();
  text.module("part", vlnv, parameters, pins);
  const auto design =
      platform::block_design::import_design(platform::handoff::read_hwh(text.text(), "small.hwh"));
  for (const ImportedPart& part : design.parts)
    if (part.name == "part") return part;
  BOOST_FAIL("the part is missing");
  return {};
}

}  // namespace

BOOST_AUTO_TEST_SUITE(video_parts)

BOOST_AUTO_TEST_CASE(pictures_go_through_the_memory_to_the_screen) {
  const kit::TemporaryFolder folder;
  const auto one = some_picture(3), two = some_picture(100);
  vp::write_file(folder / "one.ppm", format_picture(one));
  vp::write_file(folder / "two.ppm", format_picture(two));
  const std::string to = folder / "screen";
  BuiltDesign chip(pipeline(),
                   {"pl.camera.frames_from=" + (folder / "one.ppm") + "," + (folder / "two.ppm"),
                    "pl.screen.frames_to=" + to, "pl.screen.most_frames=3"});
  auto& vdma = chip.part<xilinx::AxiVdma>("vdma");
  auto& tc = chip.part<xilinx::VTc>("tc");
  auto& screen = chip.part<xilinx::VAxi4sVidOut>("screen");
  constexpr std::uint32_t run = axi_vdma::vdmacr::RS | axi_vdma::vdmacr::Circular_Park |
                                axi_vdma::vdmacr::GenlockEn | axi_vdma::vdmacr::GenlockSrc |
                                1u << 16;
  pass_exactly_us(1);
  start(vdma, axi_vdma::s2mm, run);
  pass_exactly_us(300);  // two frames of the camera
  BOOST_TEST(vdma.s2mm()->frames.get() >= 1u);
  BOOST_TEST(screen.frames.get() == 0u);
  start(vdma, axi_vdma::mm2s, run);
  BuiltDesign::write(tc.ctrl, v_tc::CONTROL, v_tc::control::GEN_ENABLE);
  pass_exactly_us(800);
  BOOST_TEST(chip.part<xilinx::VVidInAxi4s>("camera").lost.get() == 0u);
  BOOST_TEST(screen.locked.get());
  BOOST_TEST(screen.frames.get() == 6u);
  BOOST_TEST(!vp::output_problem(to + "/frame_0002.ppm"));
  for (const char* name : {"/frame_0000.ppm", "/frame_0001.ppm", "/frame_0002.ppm"}) {
    const auto shown = xilinx::read_picture(to + name);
    BOOST_TEST(shown.width == width);
    BOOST_TEST((shown.bytes == one.bytes || shown.bytes == two.bytes), name);
  }
  BOOST_CHECK_THROW(xilinx::read_picture(to + "/frame_0003.ppm"), vp::InputError);
  // In the memory two components are the other way round: blue is above red.
  const unsigned char* pixel = chip.zynq->ps.ddr.at(0x1000'0000, 3);
  const auto& source = pixel[0] == one.bytes[1] ? one : two;
  BOOST_TEST(unsigned{pixel[0]} == unsigned{source.bytes[1]});
  BOOST_TEST(unsigned{pixel[1]} == unsigned{source.bytes[0]});
  BOOST_TEST(unsigned{pixel[2]} == unsigned{source.bytes[2]});
}

BOOST_AUTO_TEST_CASE(what_does_not_fit_together_is_refused) {
  BOOST_TEST(problem("'tdata[15:8],tdata[23:16],tdata[7:0]'", "'tdata[15:8],tdata[7:0]'")
                 .find("TDATA_REMAP has 16 bits, and its signal 24") != std::string::npos);
  BOOST_TEST(problem("'tdata[15:8],tdata[23:16],tdata[7:0]'", "'tdata[31:8]'")
                 .find("takes bit 24 of a signal that has 24") != std::string::npos);
  BOOST_TEST(problem("C_GEN_HACTIVE_SIZE: 16", "C_GEN_HACTIVE_SIZE: 176")
                 .find("active pixels and lines must be fewer") != std::string::npos);
  BOOST_TEST(problem("IS_ACLK_ASYNC: 1, ", "").find("different clocks") != std::string::npos);
  BOOST_TEST(problem("vtg_vsync: tc.vsync_out", "vtg_vsinc: tc.vsync_out")
                 .find("did you mean 'vtg_vsync'?") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(values_of_hand_offs_that_are_modelled_are_no_stubs) {
  const auto p = [](const char* name, const char* value) { return kit::parameter(name, value); };
  struct Case {
    const char* vlnv;
    std::string parameters;
    const char* why;  ///< "": it is a model
  };
  const Case cases[] = {
      {"xilinx.com:ip:v_tc:6.2", p("C_HAS_AXI4_LITE", "0") + p("C_DETECT_EN", "0"), ""},
      {"xilinx.com:ip:v_tc:6.1", p("C_INTERLACE_EN", "1"), "C_INTERLACE_EN = 1 is not modelled"},
      {"xilinx.com:ip:v_axi4s_vid_out:4.0", p("C_ADDR_WIDTH", "12") + p("C_HAS_ASYNC_CLK", "1"),
       ""},
      {"xilinx.com:ip:v_axi4s_vid_out:4.0", p("C_PIXELS_PER_CLOCK", "2"),
       "C_PIXELS_PER_CLOCK = 2 is not modelled"},
      {"xilinx.com:ip:v_vid_in_axi4s:5.0",
       p("C_M_AXIS_VIDEO_FORMAT", "12") + p("C_COMPONENTS_PER_PIXEL", "1"), ""},
      {"xilinx.com:ip:axis_data_fifo:2.0", p("IS_ACLK_ASYNC", "1"), ""},
      {"xilinx.com:ip:axis_data_fifo:2.0", p("FIFO_MODE", "2"), "FIFO_MODE = 2 is not modelled"},
      {"xilinx.com:ip:axis_subset_converter:1.1", p("TDATA_REMAP", "tdata[7:0],16'h0000"), ""},
      {"xilinx.com:ip:axis_broadcaster:1.1", p("NUM_MI", "3"), ""},
      {"xilinx.com:ip:axis_combiner:1.1", p("TDEST_WIDTH", "4"), "TDEST_WIDTH = 4 is not modelled"},
      {"xilinx.com:ip:fifo_generator:13.2", p("C_COMMON_CLOCK", "0"), ""},
      {"xilinx.com:ip:fifo_generator:13.2", p("INTERFACE_TYPE", "AXI_MEMORY_MAPPED"),
       "INTERFACE_TYPE = AXI_MEMORY_MAPPED is not modelled"}};
  for (const Case& one : cases) {
    const ImportedPart part = imported(one.vlnv, one.parameters);
    const bool is_model = std::string(one.why).empty();
    BOOST_TEST((part.kind == (is_model ? Kind::model : Kind::stub)), one.vlnv);
    BOOST_TEST((part.why.find(one.why) != std::string::npos), part.why);
  }
}

BOOST_AUTO_TEST_CASE(a_stream_parts_and_comes_together) {
  const std::string on = "aclk: ps.FCLK_CLK1, aresetn: rst.peripheral_aresetn";
  const std::string parts =
      video_part("fan", "axis_broadcaster:1.1",
                 "S_TDATA_NUM_BYTES: 3, M_TDATA_NUM_BYTES: 1, S_TUSER_WIDTH: 1, "
                 "M00_TDATA_REMAP: 'tdata[7:0]', M01_TDATA_REMAP: 'tdata[23:16]'",
                 on, "S_AXIS: camera.video_out") +
      video_part("join", "axis_combiner:1.1", "TDATA_NUM_BYTES: 1, TUSER_WIDTH: 1", on,
                 "S00_AXIS: fan.M00_AXIS, S01_AXIS: fan.M01_AXIS") +
      video_part("grey", "axis_subset_converter:1.1",
                 "S_TDATA_NUM_BYTES: 2, M_TDATA_NUM_BYTES: 3, S_TUSER_WIDTH: 1, M_TUSER_WIDTH: 1, "
                 "TDATA_REMAP: 'tdata[15:8],8''h00,tdata[7:0]'",
                 on, "S_AXIS: join.M_AXIS");
  std::string text = replaced(pipeline(), "S_AXIS: camera.video_out", "S_AXIS: grey.M_AXIS");
  text = replaced(text, "addresses:\n", parts + "addresses:\n");
  const kit::TemporaryFolder folder;
  const auto picture = some_picture(9);
  vp::write_file(folder / "one.ppm", format_picture(picture));
  BuiltDesign chip(text, {"pl.camera.frames_from=" + (folder / "one.ppm")});
  auto& vdma = chip.part<xilinx::AxiVdma>("vdma");
  pass_exactly_us(1);
  start(vdma, axi_vdma::s2mm, axi_vdma::vdmacr::RS | axi_vdma::vdmacr::Circular_Park | 1u << 16);
  pass_exactly_us(200);
  BOOST_TEST(vdma.s2mm()->frames.get() == 1u);
  // Blue is gone, and green and red have changed places on the way into the memory.
  const unsigned char* pixel = chip.zynq->ps.ddr.at(0x1000'0000, 3);
  BOOST_TEST(unsigned{pixel[0]} == unsigned{picture.bytes[1]});
  BOOST_TEST(unsigned{pixel[1]} == unsigned{picture.bytes[0]});
  BOOST_TEST(unsigned{pixel[2]} == 0u);
}

// As Vivado writes them: timing and native video are pins with nets, and streams are buses.
BOOST_AUTO_TEST_CASE(a_hand_off_of_a_video_loop_is_built_without_a_stub_of_it) {
  const auto clocked = [](const char* name) {
    return kit::pin("I", name, "ps_FCLK_CLK0", 1, R"(SIGIS="clk" CLKFREQUENCY="100000000")");
  };
  std::string sizes = kit::parameter("C_HAS_AXI4_LITE", "0") + kit::parameter("C_DETECT_EN", "0") +
                      kit::parameter("VIDEO_MODE", "Custom");
  const std::pair<const char*, const char*> frame[] = {
      {"HACTIVE_SIZE", "16"},    {"HFRAME_SIZE", "176"},    {"HSYNC_START", "64"},
      {"HSYNC_END", "96"},       {"VACTIVE_SIZE", "8"},     {"F0_VFRAME_SIZE", "38"},
      {"F0_VSYNC_VSTART", "10"}, {"F0_VSYNC_VEND", "16"},   {"F0_VBLANK_HSTART", "16"},
      {"F0_VBLANK_HEND", "16"},  {"F0_VSYNC_HSTART", "64"}, {"F0_VSYNC_HEND", "64"}};
  for (const auto& [name, value] : frame)
    sizes += kit::parameter(std::string("C_GEN_") + name, value);
  std::string timing = clocked("clk") + kit::pin("I", "gen_clken", "vid_out_vtg_ce");
  std::string screen = clocked("aclk") + clocked("vid_io_out_clk") +
                       kit::pin("O", "vtg_ce", "vid_out_vtg_ce") +
                       kit::pin("O", "vid_data", "vid_out_vid_data", 24);
  for (const std::string wire : {"hsync", "vsync", "hblank", "vblank", "active_video"}) {
    timing += kit::pin("O", wire + "_out", "tc_" + wire);
    screen += kit::pin("I", "vtg_" + wire, "tc_" + wire);
  }
  kit::HwhText text = kit::small_handoff();
  text.module("v_tc_0", "xilinx.com:ip:v_tc:6.2", sizes, timing)
      .module("vid_out", "xilinx.com:ip:v_axi4s_vid_out:4.0", kit::parameter("C_ADDR_WIDTH", "10"),
              screen, kit::bus("TARGET", "video_in", "vid_in_video_out", "axis"))
      .module("vid_in", "xilinx.com:ip:v_vid_in_axi4s:5.0", "",
              clocked("aclk") + clocked("vid_io_in_clk"),
              kit::bus("INITIATOR", "video_out", "vid_in_video_out", "axis"));
  const auto design =
      platform::block_design::import_design(platform::handoff::read_hwh(text.text(), "small.hwh"));
  for (const ImportedPart& part : design.parts)
    BOOST_TEST(((part.kind == Kind::stub) == (part.name == "own_0")), part.name);
  for (const char* setting : {"pl.vid_in.frames_from", "pl.vid_out.frames_to"})
    BOOST_TEST(
        std::count_if(design.notes.begin(), design.notes.end(), [&](const std::string& note) {
          return note.find(setting) != std::string::npos;
        }) == 1);
  const kit::TemporaryFolder folder;
  const auto picture = some_picture(1);
  vp::write_file(folder / "one.ppm", format_picture(picture));
  BuiltDesign chip(design.text, {"pl.vid_in.frames_from=" + (folder / "one.ppm"),
                                 "pl.vid_out.frames_to=" + (folder / "screen")});
  pass_exactly_us(200);  // frames of 67 us
  auto& out = chip.part<xilinx::VAxi4sVidOut>("vid_out");
  BOOST_TEST(out.frames.get() == 2u);
  BOOST_TEST(out.black.get() == 0u);
  BOOST_TEST(!out.locked.get());  // with four
  BOOST_TEST((xilinx::read_picture(folder / "screen/frame_0001.ppm").bytes == picture.bytes));
  pass_exactly_us(150);
  BOOST_TEST(out.locked.get());
}

BOOST_AUTO_TEST_CASE(a_generated_fifo_has_the_pins_of_the_vendor) {
  const std::string text =
      replaced(pipeline(), "addresses:\n",
               video_part("words", "fifo_generator:13.2", "C_DIN_WIDTH: 8, C_WR_DEPTH: 16",
                          "clk: ps.FCLK_CLK0, srst: rst.peripheral_reset, wr_en: one.dout, "
                          "din: external.value",
                          "") +
                   "addresses:\n") +
      "external:\n  value: {width: 8, level: 5}\n";
  BuiltDesign chip(text);
  BuiltDesign::pass_us(3);
  auto& fifo = chip.part<xilinx::FifoGenerator>("words");
  BOOST_TEST(fifo.writes.get() == 16u);
  BOOST_TEST(fifo.full.get());
  BOOST_TEST(fifo.lost.get() > 0u);
  BOOST_TEST(!fifo.reader().empty.get());
}

BOOST_AUTO_TEST_SUITE_END()
