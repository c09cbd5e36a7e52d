// The parts of a frame one by one, and OpenCV's FAST on the same image.
#include <benchmark/benchmark.h>
#include <marker/scene/renderer.h>
#include <marker/scene/scene.h>
#include <pl/blob_detection/core.h>
#include <pl/common/simd_target.h>
#include <pl/corner_detection/core.h>
#include <pl/global_threshold/core.h>

#include <opencv2/core/utility.hpp>
#include <opencv2/features2d.hpp>
#include <string>
#include <vector>

#include "images.h"

extern "C" int sc_main(int, char**) {
  return 1;
}

namespace {

const pl::Geometry geometry;
constexpr std::uint32_t corner_threshold = 30;

/// Dark corners with strength, direction and non-maximum suppression, as packets.
void corner_frame(benchmark::State& state, const std::string& name) {
  const harness::Image image = bench::make_image(name);
  pl::CornerFrame corners(geometry, corner_threshold);
  std::vector<pl::StampedWord> found;
  for (auto _ : state) {
    found.clear();
    corners.detect(image.data(), found);
    benchmark::DoNotOptimize(found.data());
  }
  state.counters["corners"] = static_cast<double>(found.size());
}

/// The same with instructions that every processor has.
void corner_frame_baseline(benchmark::State& state, const std::string& name) {
  pl::use_simd_target(pl::simd_targets().back());
  corner_frame(state, name);
  pl::use_simd_target("");
}

/// Dark and bright corners with strength and non-maximum suppression, on one core.
void opencv_fast(benchmark::State& state, const std::string& name) {
  harness::Image image = bench::make_image(name);
  const cv::Mat picture(static_cast<int>(geometry.height), static_cast<int>(geometry.width), CV_8U,
                        image.data());
  cv::setNumThreads(1);
  std::vector<cv::KeyPoint> found;
  for (auto _ : state) {
    cv::FAST(picture, found, static_cast<int>(corner_threshold), true,
             cv::FastFeatureDetector::TYPE_9_16);
    benchmark::DoNotOptimize(found.data());
  }
  state.counters["corners"] = static_cast<double>(found.size());
}

void threshold_frame(benchmark::State& state, const std::string& name) {
  const harness::Image image = bench::make_image(name);
  pl::ThresholdFrame threshold(geometry);
  for (auto _ : state) {
    threshold.begin(image.data());
    threshold.advance(geometry.pixels());
    benchmark::DoNotOptimize(threshold.end());
  }
}

void blob_frame(benchmark::State& state, const std::string& name) {
  constexpr std::uint32_t labels = 128, minimum_side = 24;
  const harness::Image image = bench::make_image(name);
  pl::ThresholdFrame threshold(geometry);
  for (int i = 0; i < 2; ++i) {  // the second time with the threshold that the image gives
    threshold.begin(image.data());
    threshold.advance(geometry.pixels());
    threshold.end();
  }
  pl::BlobFrame blobs(geometry, labels, minimum_side);
  std::vector<pl::StampedBlob> found;
  for (auto _ : state) {
    found.clear();
    blobs.begin();
    blobs.advance(threshold.words().data(), geometry.pixels(), found);
    blobs.finish(found);
    benchmark::DoNotOptimize(found.data());
  }
  state.counters["blobs"] = static_cast<double>(found.size());
}

void render_scene(benchmark::State& state) {
  const platform::Scene scene = platform::make_scene("demo");
  for (auto _ : state) benchmark::DoNotOptimize(platform::render(scene));
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  for (const std::string& image : bench::image_names()) {
    const auto add = [&image](const char* name,
                              void (*kernel)(benchmark::State&, const std::string&)) {
      benchmark::RegisterBenchmark((name + ("/" + image)).c_str(), kernel, image)
          ->Unit(benchmark::kMillisecond);
    };
    add("corner_frame", corner_frame);
    add("corner_frame_baseline", corner_frame_baseline);
    add("opencv_fast", opencv_fast);
    add("threshold_frame", threshold_frame);
    add("blob_frame", blob_frame);
  }
  benchmark::RegisterBenchmark("render_scene/demo", render_scene)->Unit(benchmark::kMillisecond);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
