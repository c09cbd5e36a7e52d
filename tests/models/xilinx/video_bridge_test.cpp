// Native video to a stream and back, and frames as files.
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cstdint>
#include <cstdio>
#include <deque>
#include <string>
#include <vector>

#include <vp/axi_stream.h>
#include <vp/configuration.h>
#include <vp/error.h>
#include <vp/file.h>
#include <xilinx/v_axi4s_vid_out/v_axi4s_vid_out.h>
#include <xilinx/v_tc/v_tc.h>
#include <xilinx/v_vid_in_axi4s/v_vid_in_axi4s.h>
#include "bus_master.h"
#include "input_error.h"
#include "temporary_files.h"
#include "video_bench.h"

using video_bench::Bench;
using video_bench::fixed_generator;
using video_bench::line_active;
using video_bench::line_blank;
using video_bench::Scope;
using video_bench::times;

namespace {

/// A picture whose pixels all differ.
xilinx::VideoPicture test_picture(unsigned width, unsigned height, unsigned first) {
  xilinx::VideoPicture picture;
  picture.width = width;
  picture.height = height;
  for (unsigned i = 0; i < 3 * width * height; ++i)
    picture.bytes.push_back(static_cast<unsigned char>(first + i));
  return picture;
}

std::string write_picture(const kit::TemporaryFolder& folder, const std::string& name,
                          const xilinx::VideoPicture& picture) {
  const std::string path = folder / name;
  vp::write_file(path, format_picture(picture));
  return path;
}

/// Sends frames: the pixels of a line are 1, 2, 3 … with the line's number above.
class Sender : public vp::Clocked {
 public:
  Sender(sc_core::sc_module_name name, vp::Clock& clock) : Clocked(name, clock) {
    vp::StreamShape shape{this->name(), 3};
    shape.user = 1;
    m_axis.set_shape(shape);
  }
  vp::AxiStreamMaster m_axis{"m_axis", *this};
  unsigned pause = 0;  ///< clocks behind each beat

  void send(unsigned width, unsigned lines, unsigned count = 1) {
    for (unsigned frame = 0; frame < count; ++frame)
      for (unsigned line = 0; line < lines; ++line)
        for (unsigned i = 0; i < width; ++i)
          beats_.push_back({line << 8 | (i + 1), line == 0 && i == 0, i + 1 == width});
    wake();
  }

 private:
  struct Beat {
    std::uint64_t data;
    bool first, last;
  };
  void edge() override {
    if (!m_axis.free()) return;
    if (waits_ != 0 || beats_.empty()) {
      waits_ -= waits_ != 0 ? 1 : 0;
      return m_axis.withdraw();
    }
    const Beat beat = beats_.front();
    beats_.pop_front();
    vp::StreamBytes bytes;
    for (unsigned i = 0; i < 3; ++i) {
      bytes.data[i] = static_cast<unsigned char>(beat.data >> 8 * i);
      bytes.keep.set(i);
    }
    for (auto& part : m_axis.link().parts())
      if (part.part.field == vp::StreamField::user) part.wire = beat.first ? 1 : 0;
    m_axis.offer(bytes, beat.last);
    waits_ = pause;
  }
  std::deque<Beat> beats_;
  unsigned waits_ = 0;
};

xilinx::VAxi4sVidOutBuild small_out() {
  xilinx::VAxi4sVidOutBuild build;
  build.fifo_depth = 64;
  build.hysteresis = 4;
  build.lock_frames = 2;
  return build;
}

/// A stream, and the timing controller that is its slave or its master.
struct Output : Bench {
  explicit Output(const xilinx::VAxi4sVidOutBuild& build = small_out())
      : tc("tc", pixel_clk, fixed_generator()), out("out", pixel_clk, aclk, build) {
    bus.socket.bind(tc.ctrl.socket);
    if (!build.timing_is_master) tc.gen_clken(out.vtg_ce);
    out.vtg_active_video(tc.active_video_out);
    out.vtg_hsync(tc.hsync_out);
    out.vtg_vsync(tc.vsync_out);
    out.vtg_hblank(tc.hblank_out);
    out.vtg_vblank(tc.vblank_out);
    sender.m_axis(link);
    out.s_axis_video()(link);
    for (vp::Signal<bool>* wire : {&out.vid_active_video, &out.locked, &out.underflow})
      scope.look_at(*wire);
  }
  xilinx::VTc tc;
  xilinx::VAxi4sVidOut out;
  kit::BusMaster bus{"bus"};
  vp::AxiStream link{"link"};
  Sender sender{"sender", aclk};
  Scope scope{"scope", pixel_clk};
};

}  // namespace

BOOST_AUTO_TEST_SUITE(video_out)

BOOST_AUTO_TEST_CASE(the_timing_waits_for_the_first_pixel_of_the_stream) {
  Output b;
  b.run(200);
  BOOST_TEST(b.scope.seen[0] == std::string(200, '0'));
  b.sender.send(6, 3, 4);
  b.run(240);
  BOOST_TEST(b.out.frames.get() == 4u);
  BOOST_TEST(b.out.black.get() == 0u);
  BOOST_TEST(b.out.locked.get());
  // At 4 us, with clock 200, edge 300 of the stream's clock is over: pixels pass on edges 302 to
  // 305. The fourth one, behind clock 203, shows three clocks later, and the first goes out on 206.
  const std::size_t begin = b.scope.seen[0].find('1');
  BOOST_TEST(begin == 206u);  // seen on clock 207
  const std::string frame = times(3, line_active) + times(3, line_blank);
  BOOST_TEST(b.scope.seen[0].substr(begin, 230) == times(4, frame).substr(0, 230));
  BOOST_TEST(b.scope.seen[2].find('1') == std::string::npos);
  // It locks with the vertical sync of the second frame: 60 clocks and 37 behind the first pixel.
  BOOST_TEST(b.scope.seen[1].find('1') == begin + 97);
}

BOOST_AUTO_TEST_CASE(frames_of_a_stream_go_into_files) {
  const kit::TemporaryFolder folder;
  const std::string to = folder / "screen";
  vp::Configuration configuration;
  configuration.set("out.frames_to=" + to);
  const vp::Configuration::Scope scope(configuration);
  Output b;
  b.sender.send(6, 3, 2);
  b.run(300);
  BOOST_TEST(b.out.frames.get() == 2u);
  const xilinx::VideoPicture shown = xilinx::read_picture(to + "/frame_0001.ppm");
  BOOST_TEST(shown.width == 6u);
  BOOST_TEST(shown.height == 3u);
  // The lowest component is green, then blue, then red.
  BOOST_TEST(unsigned{shown.bytes[3 * (2 * 6 + 4) + 1]} == 5u);
  BOOST_TEST(unsigned{shown.bytes[3 * (2 * 6 + 4) + 2]} == 2u);
  BOOST_TEST(unsigned{shown.bytes[3 * (2 * 6 + 4)]} == 0u);
}

BOOST_AUTO_TEST_CASE(a_stream_that_is_too_slow_underflows) {
  Output b;
  b.sender.pause = 3;
  b.sender.send(6, 3, 4);
  b.run(600);
  BOOST_TEST(b.scope.seen[2].find('1') != std::string::npos);
  BOOST_TEST(!b.out.locked.get());
  BOOST_TEST(b.said("ran empty"));
}

BOOST_AUTO_TEST_CASE(lines_and_frames_of_another_size_lose_the_lock) {
  struct Case {
    unsigned width, lines;
    const char* words;
  };
  for (const Case& wrong : {Case{5, 3, "shorter"}, Case{7, 3, "longer"},
                            Case{6, 2, "number of lines"}, Case{6, 4, "number of lines"}}) {
    Output b;
    b.sender.send(6, 3, 2);
    b.sender.send(wrong.width, wrong.lines);
    b.sender.send(6, 3, 3);
    b.run(900);
    BOOST_TEST(b.said(wrong.words), wrong.words);
    BOOST_TEST(b.out.frames.get() >= 4u, wrong.words);
    BOOST_TEST(b.scope.seen[1].find("10") != std::string::npos, wrong.words);
  }
}

BOOST_AUTO_TEST_CASE(enables_and_resets_stop_the_stream_and_the_pixels) {
  Output b;
  vp::Signal<bool> enable("enable"), reset("reset");
  b.out.aclken(enable);
  b.out.vid_io_out_reset(reset);
  b.sender.send(6, 3, 8);
  b.run(100);
  BOOST_TEST(b.link.beats.get() == 0u);
  enable = true;
  b.run(200);
  BOOST_TEST(b.out.locked.get());
  const std::uint64_t frames = b.out.frames.get();
  BOOST_TEST(frames == 3u);
  reset = true;
  b.run(100);
  BOOST_TEST(!b.out.locked.get());
  BOOST_TEST(b.out.frames.get() == frames);
  reset = false;
  b.run(200);
  // The rest of the frame under way is dropped, and those behind it are in place again.
  BOOST_TEST(b.out.locked.get());
  BOOST_TEST(b.out.frames.get() == frames + 3);
}

BOOST_AUTO_TEST_CASE(a_timing_that_is_the_master_is_not_held) {
  xilinx::VAxi4sVidOutBuild build = small_out();
  build.timing_is_master = true;
  Output b(build);
  b.run(121);
  b.sender.send(6, 3, 3);
  b.run(360);
  BOOST_TEST(b.out.frames.get() == 3u);
  const std::string frame = times(3, line_active) + times(3, line_blank);
  BOOST_TEST(b.scope.seen[0].substr(2, 420) == times(7, frame));
}

BOOST_AUTO_TEST_CASE(files_of_video_that_has_other_components_are_refused) {
  const kit::TemporaryFolder folder;
  vp::Configuration configuration;
  configuration.set("out.frames_to=" + (folder / "x"));
  const vp::Configuration::Scope scope(configuration);
  xilinx::VAxi4sVidOutBuild build = small_out();
  build.format = xilinx::VideoFormat::yuv_422;
  build.components = 2;
  BOOST_TEST(input_error([&] { Output b(build); }).find("RGB or grey") != std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE(video_in)

BOOST_AUTO_TEST_CASE(pixels_of_a_timing_become_a_stream) {
  Bench b;
  xilinx::VTc tc("tc", b.pixel_clk, fixed_generator());
  kit::BusMaster bus("bus");
  bus.socket.bind(tc.ctrl.socket);
  xilinx::VVidInAxi4s in("in", b.pixel_clk, b.aclk);
  in.vid_active_video(tc.active_video_out);
  in.vid_vsync(tc.vsync_out);
  vp::Signal<std::uint64_t> data("data", 24, 0x123456);
  in.vid_data(data);
  vp::AxiStream link("link");
  in.m_axis_video()(link);
  vp::StreamSink sink("sink", b.aclk);
  vp::StreamShape shape{"sink", 3};
  shape.user = 1;
  sink.s_axis.set_shape(shape);
  sink.s_axis(link);
  b.run(180);
  // The frame on clock 1 comes without a sync before it, so the first two that count are those on
  // clocks 61 and 121.
  BOOST_TEST_REQUIRE(sink.beats.size() == 36u);
  for (std::size_t i = 0; i < sink.beats.size(); ++i) {
    BOOST_TEST(sink.beats[i].data == 0x123456u);
    BOOST_TEST(sink.beats[i].last == (i % 6 == 5));
    BOOST_TEST_REQUIRE(sink.beats[i].more.size() == 1u);
    BOOST_TEST((sink.beats[i].more[0] != 0) == (i % 18 == 0));
  }
  // Clock 61 drives pixel 0, 62 sees it, 65 writes it at 1300 ns: edge 97 of the stream's clock is
  // the last one before, three later it is there, and one after that it passes.
  BOOST_TEST(sink.beats[0].cycle == 101u);
  BOOST_TEST(in.lost.get() == 0u);
}

BOOST_AUTO_TEST_CASE(pixels_are_lost_where_the_stream_does_not_flow) {
  Bench b;
  xilinx::VTc tc("tc", b.pixel_clk, fixed_generator());
  kit::BusMaster bus("bus");
  bus.socket.bind(tc.ctrl.socket);
  xilinx::VVidInAxi4sBuild build;
  build.fifo_depth = 16;
  xilinx::VVidInAxi4s in("in", b.pixel_clk, b.aclk, build);
  in.vid_active_video(tc.active_video_out);
  in.vid_vblank(tc.vblank_out);
  vp::AxiStream link("link");
  in.m_axis_video()(link);
  vp::StreamSink sink("sink", b.aclk);
  vp::StreamShape shape{"sink", 3};
  shape.user = 1;
  sink.s_axis.set_shape(shape);
  sink.ready_on = [](std::uint64_t) { return false; };
  sink.s_axis(link);
  Scope scope("scope", b.pixel_clk);
  scope.look_at(in.overflow);
  b.run(180);
  // Of 54 pixels, 16 are in the FIFO and one at its output.
  BOOST_TEST(in.lost.get() == 54u - 17u);
  BOOST_TEST(std::count(scope.seen[0].begin(), scope.seen[0].end(), '1') == 54 - 17);
  BOOST_TEST(b.said("pixels are lost"));
}

BOOST_AUTO_TEST_CASE(a_camera_of_files_reaches_a_screen_of_files) {
  const kit::TemporaryFolder folder;
  const auto first = test_picture(6, 3, 1), second = test_picture(6, 3, 90);
  const std::string one = write_picture(folder, "one.ppm", first);
  const std::string two = write_picture(folder, "two.ppm", second);
  const std::string to = folder / "screen";
  vp::Configuration configuration;
  configuration.set("in.frames_from=" + one + "," + two);
  configuration.set("out.frames_to=" + to);
  const vp::Configuration::Scope scope(configuration);
  Bench b;
  xilinx::VVidInAxi4s in("in", b.pixel_clk, b.aclk);
  xilinx::VTcBuild generator = fixed_generator();
  generator.timing = xilinx::usual_timing(6, 3);
  xilinx::VTc tc("tc", b.pixel_clk, generator);
  kit::BusMaster bus("bus");
  bus.socket.bind(tc.ctrl.socket);
  xilinx::VAxi4sVidOut out("out", b.pixel_clk, b.aclk, small_out());
  tc.gen_clken(out.vtg_ce);
  out.vtg_active_video(tc.active_video_out);
  out.vtg_vsync(tc.vsync_out);
  vp::AxiStream link("link");
  in.m_axis_video()(link);
  out.s_axis_video()(link);
  b.run(6 * 166 * 33);
  BOOST_TEST(in.lost.get() == 0u);
  BOOST_TEST(out.frames.get() >= 3u);
  BOOST_TEST(out.locked.get());
  const auto shown = xilinx::read_picture(to + "/frame_0001.ppm");
  const auto next = xilinx::read_picture(to + "/frame_0002.ppm");
  BOOST_TEST((shown.bytes == first.bytes || shown.bytes == second.bytes));
  BOOST_TEST((next.bytes == first.bytes || next.bytes == second.bytes));
  BOOST_TEST((shown.bytes != next.bytes));
}

BOOST_AUTO_TEST_CASE(files_without_a_picture) {
  const auto problem = [](const std::string& bytes) {
    return input_error([&] { xilinx::parse_picture(bytes, "a.ppm"); });
  };
  BOOST_TEST(problem("\x89PNG").find("binary PPM or PGM") != std::string::npos);
  BOOST_TEST(problem("P6\n2 2\n255\nabc").find("ends before its last pixel") != std::string::npos);
  BOOST_TEST(problem("P6\n2 2\n65535\nabc").find("greatest value") != std::string::npos);
  BOOST_TEST(problem("P6\n0 2\n255\n").find("1 to 8192") != std::string::npos);
  BOOST_TEST(problem("P6\nx").find("header") != std::string::npos);
  BOOST_TEST(xilinx::parse_picture("P5 # a comment\n2 1\n255\nab", "a.pgm").bytes.size() == 2u);
}

BOOST_AUTO_TEST_CASE(pictures_of_a_camera_have_one_size) {
  const kit::TemporaryFolder folder;
  const std::string one = write_picture(folder, "one.ppm", test_picture(6, 3, 1));
  const std::string two = write_picture(folder, "two.ppm", test_picture(3, 6, 1));
  const auto camera = [](const std::string& files, const std::string& order) {
    return input_error([&] {
      xilinx::VideoCamera({files}, {xilinx::VideoFormat::rgb, 3, 8, order}, "in");
    });
  };
  BOOST_TEST(camera(one + " " + two, "gbr").find("another size") != std::string::npos);
  BOOST_TEST(camera(one, "gbx").find("letters r, g and b") != std::string::npos);
  BOOST_TEST(camera(one, "rgb") == "nothing thrown");
}

BOOST_AUTO_TEST_SUITE_END()
