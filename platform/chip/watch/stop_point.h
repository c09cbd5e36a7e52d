#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include <chip/system/zynq.h>
#include <chip/watch/bus_log.h>
#include <vp/report.h>

namespace platform {

/// The moment of a run at which its program is to be looked at.
struct StopOptions {
  enum class When { at_time, access, warning, failure };
  When when = When::failure;
  std::uint64_t ps = 0;      ///< at_time
  std::string address;       ///< access: "axi_dma_0.MM2S_DMASR", "ddr+0x100", "0x41200000"
  bool writes_only = false;  ///< access: count only these
  std::uint64_t number = 1;  ///< access, warning: the first is 1
};

/// Waits for a moment of a run, while it lives. The program's calls are then under way, and the
/// simulation stands: no time passes, and no result changes.
class StopPoint {
 public:
  /// Gets what was met: "access 3 of axi_dma_0.MM2S_DMASR: read 0x00001002, at 15.2 ms of program
  /// 'mine', pc …". Of accesses and warnings the later ones are reported, too.
  using Listener = std::function<void(const std::string& what)>;

  /// Before the simulation starts. Throws vp::InputError for an invalid address.
  StopPoint(const StopOptions& options, Zynq& zynq, vp::ReportRouter& reports, Listener listener);
  ~StopPoint();
  StopPoint(const StopPoint&) = delete;
  StopPoint& operator=(const StopPoint&) = delete;

  /// Why the moment did not come in the run, which is over, and what to do; "" if it came.
  std::string missed() const;

 private:
  class Accesses;

  void count(const std::string& what, const ps::Cpu& cpu);
  void meet(const std::string& what);

  StopOptions options_;
  Zynq& zynq_;
  vp::ReportRouter& reports_;
  Listener listener_;
  std::uint64_t counted_ = 0;
  bool met_ = false;
  std::unique_ptr<Accesses> accesses_;
};

}  // namespace platform
