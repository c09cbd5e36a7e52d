#include <pl/feature_extraction/feature_extraction.h>

#include <vp/error.h>
#include <string>

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

}  // namespace

FeatureExtraction::FeatureExtraction(sc_core::sc_module_name name, vp::Clock& system_clk,
                                     vp::Clock& pixel_clk)
    : sc_module(name),
      bram("bram", geometry().pixels() / pixels_per_word),
      axi_image_store("axi_image_store", system_clk, bram),
      sensor_input("sensor_input", pixel_clk, geometry(), bram),
      corner_detection("corner_detection", pixel_clk, geometry()),
      global_threshold("global_threshold", pixel_clk),
      blob_detection("blob_detection", pixel_clk, geometry()),
      frame_status("frame_status", pixel_clk),
      clock_crossing("clock_crossing", pixel_clk, system_clk),
      feature_packaging("feature_packaging", system_clk),
      axi_threshold_bridge("axi_threshold_bridge", system_clk) {
  check_holds_a_frame(bram, geometry());
}

void FeatureExtraction::before_end_of_elaboration() {
  connect_controls();
  connect_pixels();
  connect_features();
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
  corner_detection.ena(sensor_input.frame_ena);
  corner_detection.pixel(sensor_input.pixel);
  corner_detection.x(sensor_input.pixel_x);
  corner_detection.y(sensor_input.pixel_y);
  global_threshold.frame_ena(sensor_input.frame_ena);
  global_threshold.pixel(sensor_input.pixel);
  global_threshold.x(sensor_input.pixel_x);
  global_threshold.y(sensor_input.pixel_y);
  blob_detection.ena(global_threshold.binary_ena);
  blob_detection.pixel(global_threshold.binary_out);
  blob_detection.x(global_threshold.binary_x);
  blob_detection.y(global_threshold.binary_y);
}

void FeatureExtraction::connect_features() {
  frame_status.frame_ena(sensor_input.frame_ena);
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
