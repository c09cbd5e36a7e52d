#include <pl/feature_extraction/feature_extraction.h>

#include <pl/axi_image_store/tlm.h>
#include <pl/axi_threshold_bridge/tlm.h>
#include <pl/blob_detection/clocked.h>
#include <pl/blob_detection/tlm.h>
#include <pl/common/simd_target.h>
#include <pl/corner_detection/clocked.h>
#include <pl/corner_detection/tlm.h>
#include <pl/global_threshold/clocked.h>
#include <pl/global_threshold/tlm.h>
#include <pl/sensor_input/clocked.h>
#include <pl/sensor_input/tlm.h>
#include <vp/error.h>
#include <vp/text.h>
#include <string>
#include <vector>

namespace pl {

namespace {

constexpr std::uint32_t pixels_per_word = 4;

void check_holds_a_frame(const xilinx::Bram& bram, const Geometry& geometry) {
  const std::uint32_t words = geometry.pixels() / pixels_per_word;
  if (bram.depth_a >= words) return;
  throw vp::InputError(std::string(bram.name()) + ".depth_a is " + std::to_string(bram.depth_a) +
                       ": a frame of " + std::to_string(geometry.width) + "x" +
                       std::to_string(geometry.height) + " px needs " + std::to_string(words) +
                       " words");
}

void choose_simd(const vp::Parameter<std::string>& simd) {
  if (use_simd_target(simd.get() == "best" ? "" : simd.get())) return;
  std::vector<std::string> targets = simd_targets();
  targets.insert(targets.begin(), "best");
  throw vp::InputError(std::string(simd.name()) + " = " + simd.get() +
                       ": this host and build have " + vp::one_of(targets));
}

}  // namespace

FeatureExtraction::FeatureExtraction(sc_core::sc_module_name name, vp::Clock& system_clk,
                                     vp::Clock& pixel_clk, Fidelity otherwise,
                                     const MakeFilter& make_filter)
    : sc_module(name),
      fidelity("fidelity", otherwise),
      bram("bram", geometry().pixels() / pixels_per_word),
      frame_status("frame_status", pixel_clk),
      clock_crossing("clock_crossing", pixel_clk, system_clk),
      feature_packaging("feature_packaging", system_clk),
      sensor_input_(make_sensor_input(pixel_clk)),
      axi_image_store_(make_image_store(system_clk)),
      filter(make(make_filter, pixel_clk)),
      corner_detection_(make_corner_detection(pixel_clk)),
      global_threshold_(make_global_threshold(pixel_clk)),
      blob_detection_(make_blob_detection(pixel_clk)),
      axi_threshold_bridge_(make_threshold_bridge(system_clk, pixel_clk)) {
  control_block.set_logic_clock(system_clk);
  bram.set_logic_clock(pixel_clk);
  choose_simd(simd);
  check_holds_a_frame(bram, geometry());
}

std::unique_ptr<SensorInput> FeatureExtraction::make_sensor_input(vp::Clock& clk) {
  if (fidelity.sensor_input == Fidelity::tlm) {
    return std::make_unique<SensorInputTlm>("sensor_input", clk, geometry(), bram);
  }
  return std::make_unique<SensorInputClocked>("sensor_input", clk, geometry(), bram);
}

std::unique_ptr<AxiImageStoreClocked> FeatureExtraction::make_image_store(vp::Clock& clk) {
  if (fidelity.axi_image_store == Fidelity::tlm) {
    return std::make_unique<AxiImageStoreTlm>("axi_image_store", clk, bram, sensor_input.view);
  }
  return std::make_unique<AxiImageStoreClocked>("axi_image_store", clk, bram);
}

std::unique_ptr<PixelFilter> FeatureExtraction::make(const MakeFilter& make_filter,
                                                     vp::Clock& clk) {
  if (!make_filter) return nullptr;
  return make_filter({clk, geometry(), fidelity.sensor_input, sensor_input.view});
}

/// What the detectors see at transaction level.
FrameChannel& FeatureExtraction::frames() {
  return filter ? filter->frames() : sensor_input.view;
}

std::unique_ptr<CornerDetection> FeatureExtraction::make_corner_detection(vp::Clock& clk) {
  if (fidelity.corner_detection == Fidelity::tlm) {
    return std::make_unique<CornerDetectionTlm>("corner_detection", clk, geometry(), frames());
  }
  return std::make_unique<CornerDetectionClocked>("corner_detection", clk, geometry());
}

std::unique_ptr<GlobalThreshold> FeatureExtraction::make_global_threshold(vp::Clock& clk) {
  if (fidelity.global_threshold == Fidelity::tlm) {
    return std::make_unique<GlobalThresholdTlm>("global_threshold", clk, geometry(), frames());
  }
  return std::make_unique<GlobalThresholdClocked>("global_threshold", clk, geometry());
}

std::unique_ptr<BlobDetection> FeatureExtraction::make_blob_detection(vp::Clock& clk) {
  if (fidelity.blob_detection == Fidelity::tlm) {
    return std::make_unique<BlobDetectionTlm>("blob_detection", clk, geometry(),
                                              global_threshold.binary);
  }
  return std::make_unique<BlobDetectionClocked>("blob_detection", clk, geometry());
}

// Without a binary image as a whole there is nothing that it could take at once.
std::unique_ptr<AxiThresholdBridgeClocked> FeatureExtraction::make_threshold_bridge(
    vp::Clock& clk, vp::Clock& pixel_clk) {
  if (fidelity.axi_threshold_bridge == Fidelity::tlm &&
      fidelity.global_threshold == Fidelity::tlm) {
    return std::make_unique<AxiThresholdBridgeTlm>("axi_threshold_bridge", clk, pixel_clk,
                                                   global_threshold.binary, clock_crossing);
  }
  return std::make_unique<AxiThresholdBridgeClocked>("axi_threshold_bridge", clk);
}

void FeatureExtraction::before_end_of_elaboration() {
  connect_controls();
  connect_pixels();
  connect_features();
}

void FeatureExtraction::end_of_elaboration() {
  global_threshold.show_words(!axi_threshold_bridge.direct());
}

void FeatureExtraction::connect_controls() {
  for (vp::In<bool>* rst :
       {&axi_image_store.rst, &sensor_input.rst, &corner_detection.rst, &global_threshold.rst,
        &blob_detection.rst, &frame_status.rst, &clock_crossing.rst, &feature_packaging.rst,
        &axi_threshold_bridge.rst}) {
    rst->bind(control_block.rst_out);
  }
  sensor_input.ena(control_block.ena);
  axi_image_store.ena(control_block.wr_en);
  global_threshold.por(*por().signal());
  global_threshold.wr_thresh(control_block.wr_thresh);
  global_threshold.threshold(control_block.threshold);
  feature_packaging.ena(always_);
  feature_packaging.ready(control_block.ready);
  axi_threshold_bridge.ena(always_);
}

void FeatureExtraction::connect_pixels() {
  if (filter) {
    filter->rst(control_block.rst_out);
    filter->ena(sensor_input.frame_ena);
    filter->pixel(sensor_input.pixel);
    filter->x(sensor_input.pixel_x);
    filter->y(sensor_input.pixel_y);
    connect_detectors(filter->frame_ena, filter->pixel_out, filter->pixel_x, filter->pixel_y);
  } else {
    connect_detectors(sensor_input.frame_ena, sensor_input.pixel, sensor_input.pixel_x,
                      sensor_input.pixel_y);
  }
  blob_detection.ena(global_threshold.binary_ena);
  blob_detection.pixel(global_threshold.binary_out);
  blob_detection.x(global_threshold.binary_x);
  blob_detection.y(global_threshold.binary_y);
}

void FeatureExtraction::connect_detectors(vp::Signal<bool>& frame_ena,
                                          vp::Signal<std::uint8_t>& pixel,
                                          vp::Signal<std::uint16_t>& x,
                                          vp::Signal<std::uint16_t>& y) {
  corner_detection.ena(frame_ena);
  corner_detection.pixel(pixel);
  corner_detection.x(x);
  corner_detection.y(y);
  global_threshold.frame_ena(frame_ena);
  global_threshold.pixel(pixel);
  global_threshold.x(x);
  global_threshold.y(y);
  frame_status.frame_ena(frame_ena);
}

void FeatureExtraction::connect_features() {
  frame_status.idle(blob_detection.idle);
  frame_status.corner_out(corner_detection.corner_out);
  frame_status.blob_out(blob_detection.blob_out);
  clock_crossing.corner_out(corner_detection.corner_out);
  clock_crossing.corner_data(corner_detection.corner_data);
  clock_crossing.blob_out(blob_detection.blob_out);
  clock_crossing.blob_start(blob_detection.blob_start);
  clock_crossing.blob_end(blob_detection.blob_end);
  clock_crossing.thresh_out(global_threshold.thresh_out);
  clock_crossing.thresh_data(global_threshold.thresh_data);
  clock_crossing.corner.set_seen(feature_packaging.corner_seen);
  clock_crossing.blob.set_seen(feature_packaging.blob_seen);
  clock_crossing.binary.set_seen(axi_threshold_bridge.thresh_seen);
  feature_packaging.corner_in(clock_crossing.corner.toggle);
  feature_packaging.corner_data(clock_crossing.corner.word);
  feature_packaging.blob_in(clock_crossing.blob.toggle);
  feature_packaging.blob_start(clock_crossing.blob.word);
  feature_packaging.blob_end(clock_crossing.blob.second_word);
  feature_packaging.done(frame_status.done);
  axi_threshold_bridge.thresh_in(clock_crossing.binary.toggle);
  axi_threshold_bridge.thresh_data(clock_crossing.binary.word);
}

}  // namespace pl
