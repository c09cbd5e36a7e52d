// The whole work of a frame as plain functions: image in, marker and pose out.
//   --mode=fast   the functions over whole frames that the transaction level uses (the usual one)
//   --mode=scalar the same in plain C++: without SIMD
//   --mode=naive  pixel by pixel
#include <marker/scene/pose.h>
#include <pl/common/simd_target.h>

#include <stdexcept>

#include "frame_benchmark.h"
#include "images.h"
#include "plain_function.h"

namespace {

template <class Detector>
void measure(benchmark::State& state, const std::string& image_name) {
  const harness::Image image = bench::make_image(image_name);
  const platform::Camera seen;
  const marker::Camera camera{seen.fx, seen.fy, seen.cx, seen.cy};
  bench::PlainFunction<Detector> function{pl::Geometry{}};
  const auto run = [&] { benchmark::DoNotOptimize(function.run(image.data(), camera)); };
  for (int i = 0; i < bench::warm_up_frames; ++i) run();
  for (auto _ : state) run();
  state.counters["feature_words"] = static_cast<double>(function.feature_words());
  state.counters["marker"] = function.marker_id();
}

void measure_mode(benchmark::State& state, const bench::Arguments& arguments) {
  if (arguments.mode.empty() || arguments.mode == "fast") {
    measure<bench::FrameDetector>(state, arguments.image);
  } else if (arguments.mode == "scalar") {
    if (!pl::use_simd_target("SCALAR")) throw std::invalid_argument("no scalar functions");
    measure<bench::FrameDetector>(state, arguments.image);
  } else if (arguments.mode == "naive") {
    measure<bench::PixelDetector>(state, arguments.image);
  } else {
    throw std::invalid_argument("no mode '" + arguments.mode + "'");
  }
}

}  // namespace

int main(int argc, char** argv) {
  return bench::run_frames(argc, argv, "function", measure_mode);
}
