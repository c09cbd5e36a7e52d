#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <chip/system/design.h>
#include <marker/designs/marker/blob_figure.h>
#include <marker/designs/marker/handshake_watch.h>
#include <marker/designs/marker/marker_parts.h>
#include <marker/scene/pose.h>
#include <trace/vocabulary.h>
#include <vp/signal.h>

namespace platform {

/// What a marker design delivers: how what its programs publish becomes a frame of the result.
class MarkerWork : public Design, private vp::SignalListener {
 public:
  /// `parts` and `ports` outlive it.
  MarkerWork(const MarkerParts& parts, PlPorts& ports);

  facts::Work work() const override;
  facts::InputNeed input() const override;
  void describe(const facts::UnitInput& input, hal_frame& frame) const override;
  void place(const facts::SharedInput& input) override;
  void settle() override;
  std::optional<double> program_option(const std::string& name) const override;
  void note_option(const std::string& name, double value) override {
    if (name == "unoptimised") is_unoptimised_ = value >= 0.5;
    if (name == "marker_side") marker_side_m_ = value;
  }
  /// The threshold in use is that of the frame before.
  std::uint32_t settling_showings() const override { return 1; }
  bool report(const Publication& publication, facts::UnitReport& frame) override;
  void check(facts::UnitReport& frame) override;
  void finish() override { handshake_.finish_frame(); }

  void add_power_options() override { blob_figure_.add(); }
  bool has_net_figures() const override { return blob_figure_.is_net(); }
  vp::Signal<bool>* busy() override;
  std::vector<std::string> groups() const override;
  std::vector<ClockRole> clock_roles() override;
  TimelineEngines timeline() override;

 private:
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  void show_models(pl::FeatureExtraction& models, TimelineEngines& shown);

  const MarkerParts parts_;
  PlPorts& ports_;
  HandshakeWatch handshake_;
  BlobFigure blob_figure_;
  double marker_side_m_ = marker_side_m;
  bool is_unoptimised_ = false;  ///< the program: -O2 would be faster
  std::uint8_t threshold_ = 0;   ///< in use when the frame began
};

/// The words of the marker designs.
const trace::Vocabulary& marker_words();

}  // namespace platform
