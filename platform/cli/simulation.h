#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <input/frame_source.h>
#include <input/image_file.h>
#include <report/hardware_map.h>
#include <report/result.h>
#include <report/timeline.h>
#include <vp/configuration.h>
#include <vp/trace.h>

namespace platform::cli {

/// What the command line asks of the simulation.
struct SimulationOptions {
  std::optional<std::string> program;  ///< file or name of the PS program; none: that of the design
  std::optional<vp::TraceOptions> trace;    ///< waveforms to record
  std::optional<std::string> bus_log;       ///< file of one line an access
  std::vector<std::string> bus_log_filter;  ///< devices, addresses, ranges FIRST:LAST; none: all
  std::uint32_t timeline_frames = 0;        ///< to record a timeline of
  std::optional<std::string> register_coverage;  ///< file: which registers the program used
};

/// The platform, elaborated and ready to run once.
class Simulation {
 public:
  /// The next image, or null when the run is over. Valid until that frame's report was handed over.
  using NextFrame = std::function<const input::InputFrame*()>;
  /// Takes each frame's report, in order. False: end the run.
  using FrameDone = std::function<bool(report::FrameReport&&)>;

  virtual ~Simulation() = default;

  /// The resolution that the platform is built for.
  virtual input::ImageSize image_size() const = 0;

  /// What runs; `configuration` may be left empty.
  virtual report::RunFacts facts() const = 0;

  /// Addresses, registers, interrupts and clocks, before it runs.
  virtual report::HardwareMap map() = 0;

  /// Of the first frames, after it ran; empty if none was asked for.
  virtual report::Timeline timeline() const { return {}; }

  /// There is a trace of what ran: see SimulationOptions::trace.
  virtual bool wrote_trace() const { return false; }

  /// Runs the PS program until `next` gives no more images. Neither function throws. `index` in a
  /// report counts the images given; it lacks `input`, `truth` and `camera`, which the caller
  /// knows. The trace file is made here, not earlier, and is whole when this returns or throws.
  /// Throws vp::ProtocolError if hardware or software broke a rule; the reports until then have
  /// been handed over.
  virtual void run(const NextFrame& next, const FrameDone& done) = 0;

  /// Lets run() return soon, in the middle of a frame. May be called in a signal handler, at any
  /// time.
  virtual void interrupt() {}
};

/// Builds the platform with the current vp::Configuration. Throws vp::InputError for a wrong value
/// or a program that cannot be loaded.
using SimulationFactory = std::function<std::unique_ptr<Simulation>(const SimulationOptions&)>;

}  // namespace platform::cli
