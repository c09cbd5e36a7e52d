#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <chip/run/camera_timing.h>
#include <chip/run/software_options.h>
#include <chip/system/xparameters.h>
#include <chip/system/zynq.h>
#include <chip/watch/software_watch.h>
#include <facts/result.h>
#include <facts/summary.h>
#include <hal/hal.h>
#include <ps/cpu/cpu.h>
#include <vp/report.h>

namespace platform {

/// The test bench around the PS program: puts inputs into DDR when they come, and hands over what
/// the program publishes, as the design makes a unit of work of it. A design that takes no input
/// may publish units whenever it likes.
///
/// With inputs at a fixed rate the program sleeps until the next one; those that came while it was
/// busy are lost, whole. A unit is handed over when its period is over: when the program takes the
/// next input, or the inputs are used up.
///
/// Logic may learn from one unit for the next. So an input that has nothing to do with the one
/// before it (UnitInput::settles_after) is given first as often as the design needs
/// (Design::settling_showings). What comes of that is not handed over, but for its warnings, and
/// its time and energy are in no period.
class FrameBench : public ps::TestBench {
 public:
  using NextFrame = std::function<facts::SharedInput()>;
  using FrameDone = std::function<bool(facts::UnitReport&&)>;
  using FrameBegins = std::function<void()>;
  /// Changes the bytes of unit `unit`, from 1.
  using Spoil = std::function<void(std::uint64_t unit, std::vector<std::uint8_t>& bytes)>;

  /// What is passed must outlive the bench. Memory for an input is taken from the DDR's DMA memory.
  FrameBench(Zynq& zynq, const CameraTiming& camera, const SoftwareOptions& options,
             const vp::ReportRouter& reports);

  /// Where frames come from and reports go to, for one run; `begins` is called whenever the program
  /// wants an input.
  void start(FrameBegins begins, NextFrame next, FrameDone done);
  /// What is wrong with inputs on their way into memory. Before the run.
  void spoil_inputs(Spoil spoil) { spoil_ = std::move(spoil); }
  /// The run is over, however it ended. Returns the warnings that stand in no frame's report.
  std::vector<std::string> finish();

  CacheContract& cache_contract() { return cache_contract_; }

  /// Inputs that the program took.
  std::uint64_t taken() const { return taken_; }
  /// Inputs that the program took and of which it published nothing.
  std::uint64_t unpublished() const { return taken_ - std::min(published_, taken_); }
  /// None: there is no rate, or the program never asked for a second input.
  std::optional<facts::CameraReport> camera_report() const;

  // ps::TestBench
  std::uint64_t next_frame_ps(std::uint64_t now_ps) override;
  const hal_frame* next_frame(std::uint64_t now_ps) override;
  bool publish(std::uint32_t kind, const void* data, std::size_t size,
               std::uint64_t now_ps) override;
  double option(std::uint32_t option, const hal_option_info& info) override;
  std::string_view option_data(std::uint32_t option) override { return options_.data(option); }
  std::optional<std::uint32_t> xparameter(const char* name) override;

 private:
  /// An input as the program has it, until it publishes what it found.
  struct Shown {
    facts::SharedInput input;
    std::uint32_t number;  ///< that the program knows it by
    std::uint32_t index;   ///< in reports
    bool counts;           ///< false: the logic settles
  };

  facts::SharedInput next_input();
  bool take_input();
  std::uint64_t came_ps(std::uint64_t number) const;
  facts::SharedInput spoiled(const facts::SharedInput& input) const;
  void place(const facts::SharedInput& right);
  Shown published(std::uint32_t number);
  void keep_settling(const facts::UnitReport& report);
  void hand_over(std::optional<std::uint64_t> until_ps);
  void take_new_warnings(std::vector<std::string>& list);

  Zynq& zynq_;
  CacheContract cache_contract_;
  const CameraTiming& camera_;
  const SoftwareOptions& options_;
  const vp::ReportRouter& reports_;
  FrameBegins begins_;
  Spoil spoil_;
  NextFrame next_;
  FrameDone done_;
  hal_frame frame_{};
  const bool takes_input_;
  const facts::Work work_;
  std::uint32_t inputs_ = 0;  ///< that there were, lost ones too
  std::deque<Shown> shown_;
  facts::SharedInput input_;             ///< given now
  std::uint32_t showings_left_ = 0;      ///< of it; the last one counts
  std::uint32_t settling_showings_ = 0;  ///< of all inputs
  facts::UnitReport settling_;           ///< of the input that settles: warnings, end and number
  std::uint64_t taken_ = 0, published_ = 0;
  std::optional<facts::UnitReport> waiting_;  ///< for the end of its period
  bool waiting_counts_ = true;

  // Of inputs at a rate.
  std::optional<std::uint64_t> first_ps_;  ///< when its first input came
  std::uint64_t awaited_ = 0;              ///< the input that the program waits for, or took last
  std::uint64_t period_from_ps_ = 0;       ///< end of the last period
  std::uint64_t missed_ = 0;               ///< inputs that came since
  std::uint64_t dropped_ = 0;
  facts::Statistic busy_ps_;

  std::size_t warnings_reported_ = 0;
  bool stop_ = false;
  std::shared_ptr<const xparameters::Values> xparameters_;  ///< once a program asked for one
};

}  // namespace platform
