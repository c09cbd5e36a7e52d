#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <chip/system/design.h>
#include <chip/system/option_files.h>
#include <marker/designs/improved/improved_logic.h>
#include <marker/designs/improved/own_markers.h>
#include <marker/designs/marker/blob_figure.h>
#include <marker/detection_result.h>
#include <marker/scene/pose.h>
#include <trace/vocabulary.h>
#include <vp/clock_scheduler.h>

namespace platform {

/// The improved marker detector's logic in the Zynq, and how what its program publishes becomes a
/// frame of the result. While the software works on a frame the logic may be at the next one.
class ImprovedDesign : public ImprovedLogic,
                       public Design,
                       public OptionFiles,
                       private vp::SignalListener {
 public:
  ImprovedDesign(sc_core::sc_module_name name, PlPorts& ports, const pl::Geometry& usual);
  /// With the longest bursts: least time for addresses and gaps (decision).
  static pl::Geometry usual_geometry(std::uint32_t width, std::uint32_t height) {
    return {width, height, marker_logic::max_burst_words};
  }

  facts::Work work() const override;
  facts::InputNeed input() const override;
  void describe(const facts::UnitInput& input, hal_frame& frame) const override;
  void place(const facts::SharedInput& input) override { camera.show({input, &input->bytes()}); }
  void settle() override { settle_counters(); }
  void note_option(const std::string& name, double value) override;
  std::string option_data(const std::string&, const std::string& path) override {
    return own_markers_.read(path);
  }
  std::uint32_t settling_showings() const override;
  bool report(const Publication& publication, facts::UnitReport& frame) override;
  void check(facts::UnitReport& frame) override;

  void add_power_options() override { blob_figure_.add(); }
  bool has_net_figures() const override { return blob_figure_.is_net(); }
  vp::Signal<bool>* busy() override { return &camera.frame_ena; }
  std::vector<std::string> groups() const override { return {"feature_extraction", "data_bridge"}; }
  std::vector<ClockRole> clock_roles() override;
  TimelineEngines timeline() override;

 private:
  /// A frame that left the camera.
  struct Sent {
    std::uint32_t number = 0;
    std::uint64_t mid_exposure_ps = 0;
    std::uint64_t end_ps = 0;                     ///< of its last pixel; 0: no such frame
    std::vector<marker::BoundingBox> blobs = {};  ///< that the labelling showed, for the picture
  };
  /// What the logic dropped: triggers, pictures, the rest of pictures, packets.
  using Dropped = std::array<std::uint64_t, 4>;

  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  void note_frame();
  void note_blob();
  /// Where the camera's frame of this number is, or was, kept.
  Sent& slot(std::uint32_t number) { return sent_[number % sent_.size()]; }
  void fill_in(facts::UnitReport& frame, std::uint64_t now_ps) const;
  void add_times(facts::UnitReport& frame, std::uint64_t now_ps);
  void explain_capture(facts::StageTime& capture);
  std::optional<double> option(const char* name) const;
  bool has_option(const char* name) const;
  std::vector<std::string> software_levers() const;
  void add_counts(facts::UnitReport& frame);
  /// Where a pinhole camera would see the corners of a marker that was found.
  std::array<PixelPoint, 4> ideal_corners(std::size_t index) const;
  void warn_of_vague_markers(facts::UnitReport& frame) const;
  /// Whether the markers can be those of the board, if one was seen.
  void check_board(facts::UnitReport& frame);
  Dropped counters() const;
  void note_dropped();

  PlPorts& ports_;
  BlobFigure blob_figure_;
  std::array<Sent, 4> sent_;  ///< the last ones, by their number
  Dropped counted_{};         ///< what the counters of the logic showed last
  Dropped dropped_{};         ///< since the last frame was reported
  marker::DetectionResult result_;
  std::map<std::string, double> options_;  ///< of the program
  OwnMarkers own_markers_;
};

/// The words of the design's signals.
const trace::Vocabulary& improved_words();

}  // namespace platform
