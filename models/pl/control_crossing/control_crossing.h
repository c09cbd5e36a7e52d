#pragma once

#include <array>
#include <cstdint>
#include <systemc>

#include <pl/common/fidelity.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/signal.h>

namespace pl {

class IpPorts;

/// What software says to the logic, on its way from the bus clock to the pixel clock: each wire
/// through two registers. One model for both fidelities, and RTL.
///
/// The threshold crosses beside `wr_thresh`, bit by bit: `wr_thresh` is a level and reloads on each
/// clock, so a torn value lasts one clock at most. A level that does not last until an edge of the
/// pixel clock is lost, with a warning.
class ControlCrossing : public vp::Clocked, public vp::Ip {
 public:
  static Models<ControlCrossing>& models();

  // Bus clock.
  vp::In<bool> ena_in{"ena_in", this};
  vp::In<bool> rst_in{"rst_in", this};
  vp::In<bool> por_in{"por_in", this};
  vp::In<bool> wr_thresh_in{"wr_thresh_in", this};
  vp::In<std::uint8_t> threshold_in{"threshold_in", this};
  // Pixel clock.
  vp::Signal<bool> ena{"ena"};
  vp::Signal<bool> rst{"rst"};
  vp::Signal<bool> por{"por"};
  vp::Signal<bool> wr_thresh{"wr_thresh"};
  vp::Signal<std::uint8_t> threshold{"threshold"};

 protected:
  ControlCrossing(sc_core::sc_module_name name, const Site& site);
  /// All ports but the clock, as RTL in its place has them.
  void connect(IpPorts& ports);
  void end_of_elaboration() override;
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  /// On each edge.
  void note_sampled() { unsampled_ = {}; }

 private:
  vp::IpEstimate own_estimate() const override;

  std::array<bool, 4> unsampled_{};  ///< levels that changed since the last edge
};

/// The control crossing clock by clock.
class ControlCrossingClocked : public ControlCrossing {
 public:
  ControlCrossingClocked(sc_core::sc_module_name name, const Site& site)
      : ControlCrossing(name, site) {}

 private:
  struct Levels {
    bool ena = false, rst = false, por = false, wr_thresh = false;
    std::uint8_t threshold = 0;
    bool operator==(const Levels& other) const {
      return ena == other.ena && rst == other.rst && por == other.por &&
             wr_thresh == other.wr_thresh && threshold == other.threshold;
    }
  };

  void edge() override;
  Levels inputs() const { return {ena_in, rst_in, por_in, wr_thresh_in, threshold_in}; }

  Levels first_;  ///< of the two registers; the other one is the output
};

}  // namespace pl
