#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <systemc>
#include <vector>

#include <input/image_file.h>
#include <report/result.h>
#include <scene/grey_image.h>
#include <trace/vocabulary.h>
#include <vp/signal.h>
#include <zynq/pl_ports.h>
#include <zynq/timeline_engines.h>

namespace platform {

/// What the program published, and when.
struct Publication {
  std::uint32_t kind;
  const void* data;
  std::size_t size;
  std::uint64_t ps;
};

/// What stands in the programmable logic, and how the platform shows it: the module `pl` derives
/// from this, besides. Its parts say themselves what they are as hardware (vp::Ip); memory masters,
/// DMA engines and register devices are found in the hierarchy, too.
class Design {
 public:
  virtual ~Design() = default;

  /// The module.
  sc_core::sc_module& module() { return dynamic_cast<sc_core::sc_module&>(*this); }

  /// Of the images that the program is given.
  virtual input::ImageSize frame_size() const = 0;
  /// Puts an image where one is that nobody uploads: a sensor's memory. Default: nowhere.
  virtual void show_image(const GreyImage& /*image*/) {}
  /// Brings memories and counters up to now, for whoever looks at them from outside.
  virtual void settle() {}

  /// Fills in a frame: times, counts, markers, features, and warnings of what was lost. False: no
  /// program of this design publishes such a thing.
  virtual bool report(const Publication& publication, report::FrameReport& frame) = 0;
  /// The run is over, perhaps in the middle of a frame: watchers warn of what they still know.
  virtual void finish() {}

  /// High while a frame passes the logic, which works then, where it does not count its work. Null:
  /// it always works.
  virtual vp::Signal<bool>* busy() { return nullptr; }
  /// The groups of its parts, in the order of reports. Groups that are missing follow.
  virtual std::vector<std::string> groups() const { return {}; }
  /// A clock of the PL, as power reports name its root: `pl.clocks.<role>`.
  struct ClockRole {
    std::string role;
    const vp::Clock* clock;
    std::string group;  ///< its power counts there
  };
  /// Default: the clocks of its parts, each in the group of the first one.
  virtual std::vector<ClockRole> clock_roles();

  /// What the timeline shows of the logic.
  virtual TimelineEngines timeline() { return {}; }
};

/// For designs whose signals nobody knows.
const trace::Vocabulary& no_words();

/// A kind of design: what is known of it before it is built.
struct DesignInfo {
  std::string name;
  std::string description;  ///< one line
  /// PS programs that belong to it, by name; the first runs if none is asked for. One that is asked
  /// for without a design chooses the design that it belongs to.
  std::vector<std::string> programs;
  bool draws_power = true;  ///< the PL is configured with it
  /// The words of its signals. Default: none are known.
  const trace::Vocabulary& (*words)() = no_words;
  /// Builds it as the module `name`, wired to `ports`, which outlive it.
  std::unique_ptr<Design> (*make)(const char* name, PlPorts& ports);
};

}  // namespace platform
