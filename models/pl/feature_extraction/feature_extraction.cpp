#include <pl/feature_extraction/feature_extraction.h>

#include <pl/common/simd_target.h>
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

FidelityChoice::FidelityChoice(sc_core::sc_module_name name, Fidelity otherwise,
                               const Models<PixelFilter>* filter_models)
    : sc_module(name),
      axi_image_store(AxiImageStore::models(), otherwise),
      axi_threshold_bridge(AxiThresholdBridge::models(), otherwise),
      blob_detection(BlobDetection::models(), otherwise),
      global_threshold(GlobalThreshold::models(), otherwise, {&blob_detection}),
      corner_detection(CornerDetection::models(), otherwise),
      filter(filter_models ? std::make_unique<Choice<PixelFilter>>(
                                 *filter_models, otherwise,
                                 ChoiceBase::Feeds{&corner_detection, &global_threshold})
                           : nullptr),
      sensor_input(SensorInput::models(), otherwise,
                   filter ? ChoiceBase::Feeds{filter.get()}
                          : ChoiceBase::Feeds{&corner_detection, &global_threshold}),
      frame_status(FrameStatus::models(), otherwise),
      clock_crossing(ClockCrossing::models(), otherwise),
      feature_packaging(FeaturePackaging::models(), otherwise) {}

FeatureExtraction::FeatureExtraction(sc_core::sc_module_name name, vp::Clock& system_clk,
                                     vp::Clock& pixel_clk, Fidelity otherwise,
                                     const Models<PixelFilter>* filter_models)
    : sc_module(name),
      fidelity("fidelity", otherwise, filter_models),
      bram("bram", geometry().pixels() / pixels_per_word),
      frame_status_(fidelity.frame_status.make({pixel_clk, geometry()})),
      clock_crossing_(fidelity.clock_crossing.make({pixel_clk, geometry()})),
      feature_packaging_(fidelity.feature_packaging.make({system_clk, geometry()})),
      sensor_input_(fidelity.sensor_input.make({pixel_clk, geometry()})),
      axi_image_store_(fidelity.axi_image_store.make({system_clk, geometry()})),
      filter(fidelity.filter ? fidelity.filter->make({pixel_clk, geometry()}) : nullptr),
      corner_detection_(fidelity.corner_detection.make({pixel_clk, geometry()})),
      global_threshold_(fidelity.global_threshold.make({pixel_clk, geometry()})),
      blob_detection_(fidelity.blob_detection.make({pixel_clk, geometry()})),
      axi_threshold_bridge_(fidelity.axi_threshold_bridge.make({system_clk, geometry()})) {
  clock_crossing.cross_to(system_clk);
  control_block.set_logic_clock(system_clk);
  bram.set_logic_clock(pixel_clk);
  choose_simd(simd);
  check_holds_a_frame(bram, geometry());
}

void FeatureExtraction::before_end_of_elaboration() {
  connect_controls();
  connect_pixels();
  connect_frames();
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
  axi_image_store.bram(bram);
  sensor_input.bram(bram);
  if (filter) {
    filter->rst(control_block.rst_out);
    filter->ena(sensor_input.frame_ena);
    filter->pixel(sensor_input.pixel);
    filter->x(sensor_input.pixel_x);
    filter->y(sensor_input.pixel_y);
    connect_detectors(*filter, filter->pixel_out);
  } else {
    connect_detectors(sensor_input, sensor_input.pixel);
  }
  blob_detection.ena(global_threshold.binary_ena);
  blob_detection.pixel(global_threshold.binary_out);
  blob_detection.x(global_threshold.binary_x);
  blob_detection.y(global_threshold.binary_y);
}

template <class Source>
void FeatureExtraction::connect_detectors(Source& source, vp::Signal<std::uint8_t>& pixel) {
  corner_detection.ena(source.frame_ena);
  corner_detection.pixel(pixel);
  corner_detection.x(source.pixel_x);
  corner_detection.y(source.pixel_y);
  global_threshold.frame_ena(source.frame_ena);
  global_threshold.pixel(pixel);
  global_threshold.x(source.pixel_x);
  global_threshold.y(source.pixel_y);
  frame_status.frame_ena(source.frame_ena);
}

// A port whose source has no frames stays open.
void FeatureExtraction::connect_frames() {
  const bool sensor = fidelity.sensor_input.gives().frames;
  if (filter && sensor) filter->frames_in(sensor_input.frames);
  if (filter ? fidelity.filter->gives().frames : sensor) {
    GreyFrames& frames = filter ? filter->frames : sensor_input.frames;
    corner_detection.frames(frames);
    global_threshold.frames(frames);
  }
  if (fidelity.global_threshold.gives().frames) {
    blob_detection.frames(global_threshold.binary_frames);
    clock_crossing.thresh_frames(global_threshold.binary_frames);
  }
  axi_threshold_bridge.crossing(clock_crossing);
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
