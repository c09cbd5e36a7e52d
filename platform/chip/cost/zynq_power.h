#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <systemc>
#include <vector>

#include <chip/cost/parts.h>
#include <chip/cost/power_options.h>
#include <chip/cost/power_states.h>
#include <chip/system/zynq.h>
#include <facts/result.h>
#include <facts/summary.h>
#include <fpga/power/leakage.h>
#include <fpga/power/power_table.h>
#include <vp/power_meter.h>
#include <vp/signal.h>

namespace platform {

/// Power over simulated time: from each point on, until the next, these watts flow.
///
/// A point is where a clock changes, the processor falls asleep or wakes, the PL begins or ends
/// a frame, and where a frame's period begins or ends. Energy of events is spread evenly over the
/// period of the frame that they belong to, so the integral over a frame's period is its energy.
struct PowerTimeline {
  struct Point {
    std::uint64_t ps = 0;
    std::vector<double> watts;  ///< one a group
  };

  std::vector<std::string> groups;  ///< "ps", "feature_extraction", …, "static"
  std::vector<Point> points;        ///< in the order of time; the last one has 0 W
};

/// The energy of a run, frame by frame: an account of what the simulation counts anyway, made up
/// when a frame is over.
///
/// The energy of a result is that of the time that the frame rate divides by
/// (facts::FramePeriods): its frame's period, and those of frames that the software gave up before
/// it. So watts = millijoules a frame × frames a second. Static power is that of the temperature at
/// which the chip would settle if the frame were repeated for ever.
class ZynqPower : public sc_core::sc_module, private PowerStates::Observer {
 public:
  /// `uses_pl`: whether the PL is configured, and `usual`: what is estimated, unless the user says
  /// otherwise. Throws vp::InputError for a table that cannot be used, and for thermal runaway.
  ZynqPower(sc_core::sc_module_name name, Zynq& zynq, bool uses_pl,
            PowerMode usual = PowerMode::vivado_default);

  PowerOptions options;
  // What flows now, W, for traces. Without the energy of events, which is known later (mode
  // `activity`); static power as of the last frame.
  vp::Signal<double> total{"total"};
  vp::Signal<double> ps{"ps"};
  vp::Signal<double> pl{"pl"};
  vp::Signal<double> static_power{"static"};

  /// Keeps the signals above up to date. Default: they show the start.
  void follow() { follows_ = true; }
  /// Keeps the power over time from here on, which grows with the run; or stops.
  void record_timeline(bool record = true) { records_ = record && is_known_; }
  const PowerTimeline& timeline() const { return timeline_; }

  /// The program takes an input: events from here on are its unit's.
  void frame_begins() { meter_.mark(); }
  /// The program published a result, now: fills in `energy`, unless it gave the frame up.
  void frame_ends(facts::UnitReport& frame);

  /// The figures of all parts are. If not, frames get no energy, and there is nothing to report or
  /// to follow.
  bool is_known() const { return is_known_; }

  // The run so far.
  /// `end_ps` of the run, for one without frames.
  facts::PowerReport power_report(std::uint64_t end_ps) const;
  facts::ResourceReport resource_report() const;
  facts::ClockReport clock_report() const;
  facts::TimingReport timing_report(const TimingClosure& timing) const;
  /// What was taken: by module, rail and kind.
  const vp::EnergyLedger& ledger() const { return ledger_; }
  const power::PowerTable& table() const { return table_; }
  const std::vector<Part>& parts() const { return parts_; }

 private:
  void states_changed(std::uint64_t ps) override;
  vp::EnergyLedger with_static(vp::EnergyLedger ledger, double seconds, double& junction_c) const;
  std::vector<facts::PowerReport::Activity> activity(const vp::EnergyLedger& ledger) const;
  void deliver(facts::UnitReport& frame);
  void record(const vp::EnergyLedger& ledger, const std::vector<vp::Interval>& period,
              double seconds, std::uint64_t from_ps, std::uint64_t to_ps);
  void show(std::uint64_t ps);

  Zynq& zynq_;
  power::PowerTable table_;
  std::vector<Part> parts_;
  power::Leaking leaking_;
  bool is_known_;
  std::vector<std::string> groups_;  ///< "ps", those of the design, "static"
  PowerStates states_;
  vp::PowerMeter meter_;
  facts::FramePeriods periods_;
  vp::EnergyLedger open_;    ///< since the last result, without static energy
  double open_seconds_ = 0;  ///< of periods
  vp::EnergyLedger ledger_;  ///< until the last result
  std::uint64_t results_ = 0;
  double seconds_ = 0;           ///< of periods
  double junction_seconds_ = 0;  ///< C s
  double static_w_ = 0;          ///< of the last frame
  bool follows_ = false;
  bool records_ = false;
  PowerTimeline timeline_;
};

}  // namespace platform
