#pragma once

#include <string>

#include <chip/run/frame_bench.h>
#include <chip/system/unit_source.h>
#include <chip/system/zynq.h>
#include <vp/signal.h>

namespace platform {

/// Tells the bench of each unit of work that a UnitSource shows.
class UnitWatch : public sc_core::sc_module, private vp::SignalListener {
 public:
  /// `bench` outlives it.
  UnitWatch(sc_core::sc_module_name name, Zynq& zynq, UnitSource& source, FrameBench& bench);
  const char* kind() const override { return "platform::UnitWatch"; }

  /// A line that the program printed.
  void printed(const std::string& line);

 private:
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  void ended();

  Zynq& zynq_;
  UnitSource& source_;
  FrameBench& bench_;
  sc_core::sc_event rose_{"rose"};
};

}  // namespace platform
