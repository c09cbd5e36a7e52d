#include <designs/marker/marker_design.h>

#include <designs/marker/frame_report.h>
#include <cstring>

namespace platform {

MarkerDesign::MarkerDesign(sc_core::sc_module_name name, PlPorts& ports,
                           const pl::Models<pl::PixelFilter>* filter)
    : ProgrammableLogic(name, ports.fclk_clk(0), ports.fclk_clk(1), ports.fidelity, filter),
      ports_(ports),
      handshake_(*this, ports.ps.cpu, ports.scheduler) {
  ports.m_axi_gp0(axi_interconnect);
  ports.s_axi_hp0(axi_mem_interconnect);
  ports.irq_f2p(concat.dout);
  proc_sys_reset.ext_reset_in(ports.fclk_reset0_n());
  sensor_input.frame_ena.attach(*this);
}

std::unique_ptr<Design> make_marker_design(const char* name, PlPorts& ports) {
  return std::make_unique<MarkerDesign>(name, ports);
}

input::ImageSize MarkerDesign::frame_size() const {
  return {static_cast<int>(geometry().width), static_cast<int>(geometry().height)};
}

void MarkerDesign::show_image(const GreyImage& image) {
  bram.load(image.pixels);
}

// The threshold of a frame is the one in use when it starts; it changes at the frame's end.
void MarkerDesign::on_change(vp::SignalBase& signal, std::uint32_t) {
  if (signal.bits() != 0) threshold_ = global_threshold.active_threshold;
}

bool MarkerDesign::report(const Publication& publication, report::FrameReport& frame) {
  if (publication.kind != marker::frame_result_kind ||
      publication.size != sizeof(marker::FrameResult)) {
    return false;
  }
  // Static: a result is too large for the stack of the program's thread.
  static marker::FrameResult result;
  std::memcpy(&result, publication.data, publication.size);
  frame.threshold = threshold_;
  fill_in(frame, result, publication.ps, ports_.ps.cpu_clk.clk);
  add_counts(frame);
  if (result.has_threshold) frame.counts.label_overflow = result.label_overflow;
  add_losses(frame, result);
  const std::uint64_t stray = handshake_.finish_frame();
  if (stray > 1) {
    frame.warnings.push_back(std::to_string(stray) +
                             " toggles of `ready` with nothing to acknowledge");
  }
  return true;
}

void MarkerDesign::add_counts(report::FrameReport& frame) {
  frame.counts.feature_overflow = feature_packaging.feature_overflow;
  frame.counts.label_overflow = blob_detection.label_overflow;
  frame.counts.bridge_overflow = axi_threshold_bridge.bridge_overflow;
  frame.counts.crossing_overflow = clock_crossing.crossing_overflow;
}

std::vector<std::string> MarkerDesign::groups() const {
  return {"feature_extraction", "data_bridge", "image_memory"};
}

std::vector<Design::ClockRole> MarkerDesign::clock_roles() {
  return {{"pixel", &ports_.fclk_clk(1), "feature_extraction"},
          {"system", &ports_.fclk_clk(0), "data_bridge"}};
}

TimelineEngines MarkerDesign::timeline() {
  constexpr bool active_low = true, critical = true;
  const auto depth = static_cast<double>(feature_packaging.buffer_depth);
  TimelineEngines shown;
  shown.engines = {{"Sensor input", &sensor_input.frame_ena, !active_low, critical},
                   {"Corners, threshold", &frame_status.busy},
                   {"Blob detection", &blob_detection.idle, active_low, critical}};
  shown.channels = {
      {"DMA 0, image in", &axi_dma_0.mm2s(), "IRQ of DMA 0", &axi_dma_0.mm2s_introut},
      {"DMA 1, binary out", &axi_dma_1.s2mm(), "IRQ of DMA 1", &axi_dma_1.s2mm_introut}};
  shown.levels = {{"Corner buffer", "words", depth, &feature_packaging.corner_count},
                  {"Blob buffer", "words", depth, &feature_packaging.blob_count}};
  shown.peaks = {{"Bridge FIFO, most in a burst", "words",
                  static_cast<double>(axi_threshold_bridge.fifo_depth), 1, [this] {
                    axi_threshold_bridge.settle();
                    return static_cast<double>(axi_threshold_bridge.packet_peak());
                  }}};
  shown.handshake = {"Feature words", &control_block.ena, &feature_packaging.feature,
                     &control_block.ready};
  shown.waiting = "feature_extraction";
  return shown;
}

}  // namespace platform
