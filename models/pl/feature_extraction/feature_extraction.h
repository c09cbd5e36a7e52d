#pragma once

#include <cstdint>
#include <memory>
#include <systemc>

#include <pl/axi_image_store/axi_image_store.h>
#include <pl/axi_threshold_bridge/axi_threshold_bridge.h>
#include <pl/blob_detection/blob_detection.h>
#include <pl/clock_crossing/clock_crossing.h>
#include <pl/common/fidelity.h>
#include <pl/common/frame_channel.h>
#include <pl/common/geometry.h>
#include <pl/control_block/control_block.h>
#include <pl/corner_detection/corner_detection.h>
#include <pl/feature_packaging/clocked.h>
#include <pl/frame_status/frame_status.h>
#include <pl/global_threshold/global_threshold.h>
#include <pl/sensor_input/sensor_input.h>
#include <vp/axi_stream.h>
#include <vp/clock.h>
#include <vp/parameter.h>
#include <vp/signal.h>
#include <xilinx/bram/bram.h>

namespace pl {

/// The chosen model of each IP that has more than one.
struct FidelityChoice : sc_core::sc_module {
  /// `otherwise`: the default. `filter`: may be null.
  FidelityChoice(sc_core::sc_module_name name, Fidelity otherwise,
                 const Models<PixelFilter>* filter);

  // Producers come after their consumers.
  Choice<AxiImageStore> axi_image_store;
  Choice<AxiThresholdBridge> axi_threshold_bridge;
  Choice<BlobDetection> blob_detection;
  Choice<GlobalThreshold> global_threshold;
  Choice<CornerDetection> corner_detection;
  std::unique_ptr<Choice<PixelFilter>> filter;  ///< may be null
  Choice<SensorInput> sensor_input;
  Choice<FrameStatus> frame_status;
  Choice<ClockCrossing> clock_crossing;
  Choice<FeaturePackaging> feature_packaging;
};

/// The feature extraction with its data bridge, wired as the thesis' figure E.1: pixels from a BRAM
/// in, feature words and the binary image out. What connects it to the PS (GPIO, DMA) is outside.
class FeatureExtraction : public sc_core::sc_module {
 public:
  /// `otherwise`: the fidelity of the IP for which no other is configured. `filter`: the models of
  /// a filter between sensor and detectors; may be null.
  FeatureExtraction(sc_core::sc_module_name name, vp::Clock& system_clk, vp::Clock& pixel_clk,
                    Fidelity otherwise = Fidelity::clocked,
                    const Models<PixelFilter>* filter = nullptr);

  FidelityChoice fidelity;
  vp::Parameter<std::string> simd{
      "simd", "best", vp::Source::decision,
      "instruction set of the transaction level, among those of the host; no result depends on it"};

  vp::Parameter<std::uint32_t> width{"width", 640, vp::Unit::pixels, vp::Source::published,
                                     "width of a frame (thesis 4.3.1)"};
  vp::Parameter<std::uint32_t> height{"height", 480, vp::Unit::pixels, vp::Source::published,
                                      "height of a frame (thesis 4.3.1)"};
  vp::Parameter<std::uint32_t> burst_words{
      "burst_words",
      marker_logic::usual_burst_words,
      vp::Unit::none,
      {marker_logic::min_burst_words, marker_logic::max_burst_words},
      vp::Source::published,
      "words of a burst: of a packet of the bridge, a transfer of either DMA in the software, and "
      "an access of these to the memory; 2, 4, 8, … 256 (thesis 4.4.2)"};
  Geometry geometry() const { return {width, height, burst_words}; }

  /// Wires that the surroundings drive.
  vp::In<std::uint32_t>& gpio_in() { return control_block.gpio_in; }
  vp::In<bool>& por() { return control_block.por; }
  vp::AxiStreamSlave& image_stream() { return axi_image_store.m; }
  vp::AxiStreamMaster& binary_stream() { return axi_threshold_bridge.m; }
  const vp::Signal<std::uint32_t>& feature() const { return feature_packaging.feature; }

  /// Brings memories and counters up to date, for access from outside.
  void settle() {
    axi_image_store.settle();
    sensor_input.settle();
    axi_threshold_bridge.settle();
    blob_detection.settle();
  }

 private:
  void before_end_of_elaboration() override;
  void connect_controls();
  void connect_pixels();
  void connect_frames();
  template <class Source>
  void connect_detectors(Source& source, vp::Signal<std::uint8_t>& pixel);
  void connect_features();

  /// Refuses sizes that cannot be built before any memory is made for them.
  struct SizeCheck {
    explicit SizeCheck(const Geometry& geometry) { check(geometry); }
  } size_check_{geometry()};
  vp::Signal<bool> always_{"always", 1, true};

 public:
  ControlBlock control_block{"control_block"};
  xilinx::Bram bram;

  // Modelled as `fidelity` says.
  const std::unique_ptr<FrameStatus> frame_status_;
  FrameStatus& frame_status = *frame_status_;
  const std::unique_ptr<ClockCrossing> clock_crossing_;
  ClockCrossing& clock_crossing = *clock_crossing_;
  const std::unique_ptr<FeaturePackaging> feature_packaging_;
  FeaturePackaging& feature_packaging = *feature_packaging_;
  const std::unique_ptr<SensorInput> sensor_input_;
  SensorInput& sensor_input = *sensor_input_;
  const std::unique_ptr<AxiImageStore> axi_image_store_;
  AxiImageStore& axi_image_store = *axi_image_store_;
  const std::unique_ptr<PixelFilter> filter;  ///< may be null
  const std::unique_ptr<CornerDetection> corner_detection_;
  CornerDetection& corner_detection = *corner_detection_;
  const std::unique_ptr<GlobalThreshold> global_threshold_;
  GlobalThreshold& global_threshold = *global_threshold_;
  const std::unique_ptr<BlobDetection> blob_detection_;
  BlobDetection& blob_detection = *blob_detection_;
  const std::unique_ptr<AxiThresholdBridge> axi_threshold_bridge_;
  AxiThresholdBridge& axi_threshold_bridge = *axi_threshold_bridge_;
};

}  // namespace pl
