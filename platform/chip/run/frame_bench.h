#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <chip/run/camera_timing.h>
#include <chip/run/software_options.h>
#include <chip/system/zynq.h>
#include <chip/watch/software_watch.h>
#include <facts/result.h>
#include <facts/summary.h>
#include <hal/hal.h>
#include <marker/input/frame_source.h>
#include <ps/cpu/cpu.h>
#include <vp/report.h>

namespace platform {

/// The test bench around the PS program: puts images into DDR when the camera takes them, and hands
/// over what the program publishes, as the design makes a frame of it.
///
/// With a camera of a fixed rate the program sleeps until the next image; those that came while it
/// was busy are lost, whole. A frame is handed over when its period is over: when the program takes
/// the next image, or there is none.
///
/// The logic's threshold comes from the frame before, which of a still image says nothing. So an
/// image file that is not the picture before it, and a scene behind one, is shown first as often as
/// the design needs (Design::settling_showings). What comes of that is not handed over, but for its
/// warnings, and its time and energy are in no period. Pictures of a video are shown once.
class FrameBench : public ps::TestBench {
 public:
  using NextFrame = std::function<input::SharedFrame()>;
  using FrameDone = std::function<bool(facts::FrameReport&&)>;
  using FrameBegins = std::function<void()>;

  /// What is passed must outlive the bench. Memory for the image is taken from the DDR's DMA
  /// memory.
  FrameBench(Zynq& zynq, const CameraTiming& camera, const SoftwareOptions& options,
             const vp::ReportRouter& reports);

  /// Where frames come from and reports go to, for one run; `begins` is called whenever the program
  /// wants an image.
  void start(FrameBegins begins, NextFrame next, FrameDone done);
  /// The run is over, however it ended. Returns the warnings that stand in no frame's report.
  std::vector<std::string> finish();

  CacheContract& cache_contract() { return cache_contract_; }

  /// Images that the program took.
  std::uint64_t taken() const { return taken_; }
  /// Images that the program took and of which it published nothing.
  std::uint64_t unpublished() const { return taken_ - std::min(published_, taken_); }
  /// None: the camera has no rate, or the program never asked for a second image.
  std::optional<facts::CameraReport> camera_report() const;

  // ps::TestBench
  std::uint64_t next_frame_ps(std::uint64_t now_ps) override;
  const hal_frame* next_frame(std::uint64_t now_ps) override;
  bool publish(std::uint32_t kind, const void* data, std::size_t size,
               std::uint64_t now_ps) override;
  double option(std::uint32_t option, const hal_option_info& info) override;
  std::optional<std::uint32_t> xparameter(const char* name) override;

 private:
  /// An image as the program has it, until it publishes what it found.
  struct Shown {
    input::SharedFrame frame;
    std::uint32_t number;  ///< that the program knows it by
    std::uint32_t index;   ///< in reports
    bool counts;           ///< false: the threshold settles
  };

  input::SharedFrame next_image();
  bool take_image();
  bool settles(const input::InputFrame& frame) const;
  std::uint64_t came_ps(std::uint64_t number) const;
  void place(const input::SharedFrame& frame);
  Shown published(std::uint32_t number);
  void keep_settling(const facts::FrameReport& report);
  void hand_over(std::optional<std::uint64_t> until_ps);
  void take_new_warnings(std::vector<std::string>& list);

  Zynq& zynq_;
  CacheContract cache_contract_;
  const CameraTiming& camera_;
  const SoftwareOptions& options_;
  const vp::ReportRouter& reports_;
  FrameBegins begins_;
  NextFrame next_;
  FrameDone done_;
  hal_frame frame_{};
  std::uint32_t images_ = 0;  ///< that there were, lost ones too
  std::deque<Shown> shown_;
  input::SharedFrame image_;             ///< before the camera
  std::uint32_t showings_left_ = 0;      ///< of it; the last one counts
  std::uint32_t settling_showings_ = 0;  ///< of all images
  facts::FrameReport settling_;          ///< of the image that settles: warnings, end and number
  std::uint64_t taken_ = 0, published_ = 0;
  std::optional<facts::FrameReport> waiting_;  ///< for the end of its period
  bool waiting_counts_ = true;

  // Of a camera with a rate.
  std::optional<std::uint64_t> first_ps_;  ///< when its first image came
  std::uint64_t awaited_ = 0;              ///< the image that the program waits for, or took last
  std::uint64_t period_from_ps_ = 0;       ///< end of the last period
  std::uint64_t missed_ = 0;               ///< images that came since
  std::uint64_t dropped_ = 0;
  facts::Statistic busy_ps_;

  std::size_t warnings_reported_ = 0;
  bool stop_ = false;
  std::string xparameters_;  ///< the header, once a program asked for a value of it
};

}  // namespace platform
