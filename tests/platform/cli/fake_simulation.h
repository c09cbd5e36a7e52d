#pragma once

#include <cli/simulation.h>
#include <vp/error.h>
#include <vp/parameter.h>
#include <functional>
#include <optional>
#include <stdexcept>

namespace cli_test {

/// A platform that knows the truth of each scene and takes 8 ms a frame.
class FakeSimulation : public platform::cli::Simulation {
 public:
  struct Behaviour {
    platform::input::ImageSize size{64, 32};
    std::optional<std::uint32_t> break_at;     ///< vp::ProtocolError instead of this frame's report
    std::function<void(std::uint32_t)> after;  ///< called when a frame's report was handed over
    bool refuses = false;                      ///< vp::InputError as soon as it runs
    bool takes_images = true;                  ///< false: the program never asks for one
    std::optional<int> exit_code;              ///< of the program; none: it did not end
    std::uint32_t runs = 0;                    ///< times that run() was entered
  };

  explicit FakeSimulation(Behaviour& behaviour) : behaviour_(behaviour) {}

  platform::input::ImageSize image_size() const override { return behaviour_.size; }
  platform::report::RunFacts facts() const override {
    platform::report::RunFacts facts{"clocked", "hybrid", "thesis", "assumed", {}};
    if (behaviour_.exit_code) facts.end = {*behaviour_.exit_code, 1'500'000};
    return facts;
  }

  platform::report::HardwareMap map() override {
    using Map = platform::report::HardwareMap;
    static const int kind = 0, bits = 0;
    const std::vector<Map::Field> fields{{"ON", 0x8000'0001, "rw", 1, "On | off"},
                                         {"LEVEL", 0x0000'0FF0, "w1c", 0x12, "How much"}};
    Map::Device memory{"ddr",      "DDR memory",   "ps.ddr", 0x10'0000,
                       511u << 20, "its own port", {},       {}};
    Map::Device timer{
        "timer",
        "a timer",
        "ps.timer.registers",
        0xF000'0000,
        0x100,
        "bus",
        {{"CONTROL", 0x10, 0x121, 0x121, true, 0x121, "rw", 0xF, "Control", fields, &bits},
         {"CONTROL_2", 0x14, 0, 0, true, 0, "rw", 0xF, "Control", fields, &bits},
         {"LOAD", 0, 5, 0, true, 0x123, "rw", 0xFFFF, "Start value"},
         {"STATUS", 0xC, 1, 0, false, 0, "w1c", 0x1, "Event | flag"}},
        &kind};
    Map::Device second = timer;
    second.name = "timer_1";
    second.base = 0xF000'1000;
    return {{memory, timer, second},
            {{29, "ps.timer.irq"}},
            {{"ps.clk", 50'000'000, "CLK_CTRL", 50'000'000}, {"ps.odd", 7, "CLK_2", 8}},
            "#define XPAR_TIMER_BASEADDR 0xF0000000U\n"};
  }

  void run(const NextFrame& next, const FrameDone& done) override {
    ++behaviour_.runs;
    if (behaviour_.refuses) throw vp::InputError("the trace filter matches no signal");
    if (!behaviour_.takes_images) return;
    for (std::uint32_t index = 0; const platform::input::InputFrame* frame = next(); ++index) {
      if (behaviour_.break_at == index) throw vp::ProtocolError("the DMA was not armed");
      if (!done(report_of(*frame, index))) return;
      if (behaviour_.after) behaviour_.after(index);
    }
  }

 private:
  static platform::report::FrameReport report_of(const platform::input::InputFrame& frame,
                                                 std::uint32_t index) {
    platform::report::FrameReport report;
    report.index = index;
    report.start_ps = index * 8'000'000'000ull;
    report.end_ps = report.start_ps + 8'000'000'000;
    report.times = {{"frame", 8'000'000'000}};
    if (!frame.truth) return report;
    platform::report::FoundMarker marker;
    marker.id = frame.truth->marker_id;
    marker.corners_px = frame.truth->corners_px;
    marker.pose = frame.truth->pose;
    report.markers.push_back(marker);
    return report;
  }

  vp::Parameter<std::uint32_t> depth_{
      "depth", 100, vp::Unit::none, {1, 1000}, vp::Source::decision, "words of the FIFO"};
  vp::Parameter<std::string> design_{"design", "thesis", vp::Source::decision, "what is in the PL"};
  vp::Parameter<std::string> fidelity_{
      "fidelity", "clocked", {"clocked"}, vp::Source::decision, "how it is modelled"};
  Behaviour& behaviour_;
};

}  // namespace cli_test
