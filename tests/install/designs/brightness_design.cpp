// No marker detector: frames, stages, counts and words of its own, and nothing in the PL.
#include <chip/system/design_plugin.h>
#include <marker/input/image_need.h>

#include <cstring>
#include <utility>

#include "brightness.h"

namespace {

class Brightness : public sc_core::sc_module, public platform::Design {
 public:
  explicit Brightness(sc_core::sc_module_name name) : sc_module(name) {}

  platform::facts::Work work() const override { return {"frame", "no pixel is left uncounted"}; }
  platform::facts::InputNeed input() const override {
    return platform::input::image_need({64, 48});
  }

  bool report(const platform::Publication& publication,
              platform::facts::UnitReport& frame) override {
    brightness::Result result;
    if (publication.kind != brightness::kind || publication.size != sizeof result) return false;
    std::memcpy(&result, publication.data, sizeof result);
    frame.index = result.frame;
    frame.start_ps = std::exchange(end_ps_, publication.ps);
    frame.end_ps = end_ps_;
    const std::uint64_t ps = frame.end_ps - frame.start_ps;
    frame.times = {{"measure", ps, frame.start_ps, "frame", "", "a row after the other"},
                   {"frame", ps, frame.start_ps}};
    frame.counts.set("bright_pixels", result.bright);
    frame.counts.lose("uncounted", result.lost);
    if (result.lost > 0)
      frame.warnings.push_back(std::to_string(result.lost) +
                               " pixels not counted: 1000 is the end");
    return true;
  }

 private:
  std::uint64_t end_ps_ = 0;
};

const platform::trace::Vocabulary& words() {
  static const platform::trace::Vocabulary words = [] {
    platform::trace::Vocabulary v;
    v.groups = {{"Images", {"ps.cpu.frame"}}};
    return v;
  }();
  return words;
}

const platform::DesignInfo& info() {
  static const platform::DesignInfo brightness{
      "brightness",
      "measures how bright an image is",
      {"measuring"},
      false,
      words,
      [](const char* name, platform::PlPorts&) -> std::unique_ptr<platform::Design> {
        return std::make_unique<Brightness>(name);
      }};
  return brightness;
}

}  // namespace

MARKERVP_DESIGN(info)
