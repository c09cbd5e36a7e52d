#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <exception>
#include <iosfwd>
#include <memory>
#include <string>

#include <chip/run/simulation.h>
#include <host/output_folder.h>
#include <marker/input/frame_source.h>
#include <result/page/report_page.h>
#include <result/result_json.h>
#include <vp/progress.h>

namespace platform::cli {

/// Where a run's frames come from and where its reports go: between inputs, simulation, pictures,
/// console and result file. Memory does not grow with the number of frames.
class FrameRunner {
 public:
  struct Outputs {
    host::OutputFolder* pictures = nullptr;  ///< gets a picture a frame; null: none
    bool text = true;                        ///< a few lines per frame on `out`
    bool progress = false;                   ///< a bar on stderr
    std::atomic<std::uint64_t>* done;        ///< counts frames; may be null
    std::ostream& out;
    result::ResultSink& result;
    page::RunExtras* page = nullptr;  ///< gets images and features; null: no page
  };

  /// Makes the first frame, so that a bad input shows before anything else happens. Throws
  /// vp::InputError.
  explicit FrameRunner(input::FrameSource& source);

  /// Runs the simulation on all frames. Errors of inputs, outputs and simulation are kept in
  /// error(), not thrown.
  void run(Simulation& simulation, const Outputs& outputs);

  /// What ended the run early; null if nothing did. An interrupt is none.
  std::exception_ptr error() const { return error_; }
  std::uint64_t frames() const { return frames_; }
  /// In the reports of all frames.
  std::uint64_t warnings() const { return warnings_; }
  std::uint64_t without_marker() const { return without_marker_; }
  /// Why the first board was refused; empty if one fitted in any frame, or none was seen.
  std::string misfit() const { return boards_fit_ ? std::string() : misfit_; }
  /// The first input in which no marker was found.
  const std::string& first_without_marker() const { return first_without_marker_; }

 private:
  input::SharedFrame give(input::FrameSource& source);
  bool take(facts::FrameReport report, const Outputs& outputs);
  const input::InputFrame& input_of(const facts::FrameReport& report);
  void write(facts::FrameReport& report, const input::InputFrame& input, const Outputs& outputs);

  input::FrameSource& source_;
  input::SharedFrame first_;
  std::deque<input::SharedFrame> pending_;  ///< given to the simulation, report not yet taken
  std::uint32_t first_pending_ = 0;         ///< index of the first of them
  std::unique_ptr<vp::Progress> progress_;
  std::exception_ptr error_;
  std::uint64_t frames_ = 0;
  std::uint64_t warnings_ = 0;
  std::uint64_t without_marker_ = 0;
  std::string first_without_marker_;
  std::string misfit_;
  bool boards_fit_ = false;
};

}  // namespace platform::cli
