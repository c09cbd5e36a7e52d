#include "platform_run.h"

#include <deque>
#include <functional>
#include <memory>
#include <stdexcept>

#include <chip/run/simulation.h>
#include <marker/input/image_input.h>
#include <marker/report/marker_frame.h>
#include <vp/configuration.h>

#include "simulation.h"

namespace integration {

namespace {

using platform::Simulation;
using platform::facts::UnitReport;
using platform::input::ImageSize;
using platform::input::InputFrame;
using platform::input::SharedFrame;

using Next = std::function<SharedFrame()>;

PlatformRun run(const Settings& settings, System system,
                const std::function<Next(ImageSize)>& open) {
  const kit::Simulation context;
  vp::Configuration configuration;
  for (const auto& [path, value] : settings) configuration.set(path, value);
  const vp::Configuration::Scope scope(configuration);
  Simulation simulation({system == System::hybrid ? MARKERVP_HYBRID : MARKERVP_PS_ONLY});
  configuration.check_unused();

  PlatformRun result;
  const Next next = open(platform::input::image_size(simulation.input()));
  simulation.run([&] { return next(); },
                 [&](UnitReport&& report) {
                   result.frames.push_back(std::move(report));
                   return true;
                 });
  result.facts = simulation.facts();
  return result;
}

}  // namespace

PlatformRun run_scenes(const std::vector<std::string>& scenes, const Settings& settings,
                       System system) {
  return run(settings, system, [&](ImageSize size) -> Next {
    platform::input::InputOptions options;
    options.size = size;
    std::shared_ptr<platform::input::FrameSource> source =
        platform::input::open_inputs(scenes, options);
    return [source] { return source->next(); };
  });
}

PlatformRun run_images(const std::vector<platform::GreyImage>& images, const Settings& settings,
                       System system) {
  return run(settings, system, [&](ImageSize size) -> Next {
    const auto camera = platform::Camera::for_resolution(size.width, size.height);
    return [&images, camera, given = std::size_t{0}]() mutable -> SharedFrame {
      if (given == images.size()) return nullptr;
      const std::string name = "image" + std::to_string(given);
      return std::make_shared<InputFrame>(InputFrame{name, images[given++], camera});
    };
  });
}

double stage_us(const UnitReport& frame, const std::string& stage) {
  for (const auto& time : frame.times) {
    if (time.name == stage) return static_cast<double>(time.ps) / 1e6;
  }
  throw std::out_of_range("no stage " + stage);
}

std::uint64_t overflows(const UnitReport& frame) {
  const auto& counts = frame.counts;
  return counts["feature_overflow"] + counts["label_overflow"] + counts["bridge_overflow"] +
         counts["crossing_overflow"];
}

std::vector<std::string> features(const UnitReport& frame) {
  std::vector<std::string> words;
  for (const marker::Corner& c : platform::marker_frame(frame).features.corners) {
    words.push_back("corner " + std::to_string(c.x) + " " + std::to_string(c.y) + " " +
                    std::to_string(c.strength) + " " +
                    std::to_string(static_cast<int>(c.direction)));
  }
  for (const marker::BoundingBox& b : platform::marker_frame(frame).features.blobs) {
    words.push_back("blob " + std::to_string(b.sx) + " " + std::to_string(b.sy) + " " +
                    std::to_string(b.ex) + " " + std::to_string(b.ey));
  }
  return words;
}

}  // namespace integration
