#pragma once

#include <cstdint>
#include <systemc>

#include <pl/axi_image_store/clocked.h>
#include <pl/axi_threshold_bridge/clocked.h>
#include <pl/blob_detection/clocked.h>
#include <pl/clock_crossing/clock_crossing.h>
#include <pl/common/geometry.h>
#include <pl/control_block/control_block.h>
#include <pl/corner_detection/clocked.h>
#include <pl/feature_packaging/clocked.h>
#include <pl/frame_status/frame_status.h>
#include <pl/global_threshold/clocked.h>
#include <pl/sensor_input/clocked.h>
#include <vp/axi_stream.h>
#include <vp/clock.h>
#include <vp/parameter.h>
#include <vp/signal.h>
#include <xilinx/bram/bram.h>

namespace pl {

/// The feature extraction with its data bridge, wired as the thesis' figure E.1: pixels from a BRAM
/// in, feature words and the binary image out. What connects it to the PS (GPIO, DMA) is outside.
class FeatureExtraction : public sc_core::sc_module {
 public:
  /// `system_clk` must have been made before `pixel_clk`.
  FeatureExtraction(sc_core::sc_module_name name, vp::Clock& system_clk, vp::Clock& pixel_clk);

  vp::Parameter<std::uint32_t> width{"width", 640, vp::Unit::pixels, vp::Source::published,
                                     "width of a frame (thesis 4.3.1)"};
  vp::Parameter<std::uint32_t> height{"height", 480, vp::Unit::pixels, vp::Source::published,
                                      "height of a frame (thesis 4.3.1)"};
  Geometry geometry() const { return {width, height}; }

  /// Wires that the surroundings drive.
  vp::In<std::uint32_t>& gpio_in() { return control_block.gpio_in; }
  vp::In<bool>& por() { return control_block.por; }
  vp::AxiStreamSlave& image_stream() { return axi_image_store.m; }
  vp::AxiStreamMaster& binary_stream() { return axi_threshold_bridge.m; }
  const vp::Signal<std::uint32_t>& feature() const { return feature_packaging.feature; }

 private:
  void before_end_of_elaboration() override;
  void connect_controls();
  void connect_pixels();
  void connect_features();

  /// Refuses sizes that cannot be built before any memory is made for them.
  struct SizeCheck {
    explicit SizeCheck(const Geometry& geometry) { check(geometry); }
  } size_check_{geometry()};
  vp::Signal<bool> always_{"always", 1, true};

 public:
  ControlBlock control_block{"control_block"};
  xilinx::Bram bram;
  AxiImageStoreClocked axi_image_store;
  SensorInputClocked sensor_input;
  CornerDetectionClocked corner_detection;
  GlobalThresholdClocked global_threshold;
  BlobDetectionClocked blob_detection;
  FrameStatus frame_status;
  ClockCrossing clock_crossing;
  FeaturePackagingClocked feature_packaging;
  AxiThresholdBridgeClocked axi_threshold_bridge;
};

}  // namespace pl
