#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <hal/hal.h>
#include <input/frame_source.h>
#include <ps/cpu/test_bench.h>
#include <report/result.h>
#include <vp/report.h>
#include <zynq/cache_contract.h>
#include <zynq/software_options.h>
#include <zynq/spin_watch.h>
#include <zynq/zynq.h>

namespace platform {

/// The test bench around the PS program: puts images into DDR, and hands over what the program
/// publishes, as the design makes a frame of it.
class FrameBench : public ps::TestBench {
 public:
  using NextFrame = std::function<const input::InputFrame*()>;
  using FrameDone = std::function<bool(report::FrameReport&&)>;

  /// What is passed must outlive the bench. Memory for the image is taken from the DDR's DMA
  /// memory.
  FrameBench(Zynq& zynq, const SoftwareOptions& options, const vp::ReportRouter& reports);

  /// Where frames come from and reports go to, for one run.
  void start(NextFrame next, FrameDone done);
  /// The run is over, however it ended. Returns the warnings that stand in no frame's report.
  std::vector<std::string> finish();

  // ps::TestBench
  const hal_frame* next_frame(std::uint64_t now_ps) override;
  bool publish(std::uint32_t kind, const void* data, std::size_t size,
               std::uint64_t now_ps) override;
  double option(std::uint32_t option, const hal_option_info& info) override;

 private:
  void place(const input::InputFrame& frame);
  void take_new_warnings(std::vector<std::string>& list);

  Zynq& zynq_;
  CacheContract cache_contract_;
  SpinWatch spin_watch_;
  const SoftwareOptions& options_;
  const vp::ReportRouter& reports_;
  NextFrame next_;
  FrameDone done_;
  hal_frame frame_{};
  std::uint32_t frames_ = 0;
  std::size_t warnings_reported_ = 0;
  bool stop_ = false;
};

}  // namespace platform
