#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <designs/marker/handshake_watch.h>
#include <designs/marker/programmable_logic.h>
#include <trace/vocabulary.h>
#include <zynq/design.h>

namespace platform {

/// The marker detector's logic in the Zynq: the thesis' wiring, and how what its programs publish
/// becomes a frame of the result.
class MarkerDesign : public ProgrammableLogic, public Design, private vp::SignalListener {
 public:
  /// `filter`: models of a filter between sensor and detectors; null: there is none.
  MarkerDesign(sc_core::sc_module_name name, PlPorts& ports,
               const pl::Models<pl::PixelFilter>* filter = nullptr);

  input::ImageSize frame_size() const override;
  void show_image(const GreyImage& image) override;
  void settle() override { ProgrammableLogic::settle(); }
  std::optional<double> program_option(const std::string& name) const override;
  bool report(const Publication& publication, report::FrameReport& frame) override;
  void finish() override { handshake_.finish_frame(); }

  vp::Signal<bool>* busy() override { return &sensor_input.frame_ena; }
  std::vector<std::string> groups() const override;
  std::vector<ClockRole> clock_roles() override;
  TimelineEngines timeline() override;

 private:
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;

  PlPorts& ports_;
  HandshakeWatch handshake_;
  std::uint8_t threshold_ = 0;  ///< in use when the frame began
};

/// For DesignInfo::make.
std::unique_ptr<Design> make_marker_design(const char* name, PlPorts& ports);

/// The words of the marker designs.
const trace::Vocabulary& marker_words();

}  // namespace platform
