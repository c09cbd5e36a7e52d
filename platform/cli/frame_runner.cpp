#include <cli/frame_runner.h>

#include <ostream>
#include <utility>

#include <host/process.h>
#include <marker/picture/picture.h>
#include <result/console.h>
#include <vp/error.h>

namespace platform::cli {

FrameRunner::FrameRunner(input::FrameSource& source) : source_(source), first_(source.next()) {}

void FrameRunner::run(Simulation& simulation, const Outputs& outputs) {
  const std::optional<std::uint64_t> total = source_.size();
  if (outputs.progress && total && *total > 1) {
    progress_ = std::make_unique<vp::Progress>("frames", *total);
  }
  try {
    simulation.run([this] { return give(source_); },
                   [&](facts::FrameReport&& report) { return take(std::move(report), outputs); });
  } catch (...) {
    // An error of our own, below, came first and is the cause.
    if (!error_) error_ = std::current_exception();
  }
  progress_.reset();
}

input::SharedFrame FrameRunner::give(input::FrameSource& source) {
  if (error_ || host::InterruptGuard::noted()) return nullptr;
  try {
    input::SharedFrame frame = first_ ? std::move(first_) : source.next();
    if (frame) pending_.push_back(frame);
    return frame;
  } catch (...) {
    error_ = std::current_exception();
    return nullptr;
  }
}

bool FrameRunner::take(facts::FrameReport report, const Outputs& outputs) {
  if (error_) return false;
  try {
    write(report, input_of(report), outputs);
    pending_.pop_front();
    ++first_pending_;
  } catch (...) {
    error_ = std::current_exception();
  }
  return !error_;
}

/// A program may leave out frames, but not go back or ahead.
const input::InputFrame& FrameRunner::input_of(const facts::FrameReport& report) {
  while (first_pending_ < report.index && !pending_.empty()) {
    pending_.pop_front();
    ++first_pending_;
  }
  if (first_pending_ != report.index || pending_.empty()) {
    throw vp::ProtocolError("the program reported frame " + std::to_string(report.index) +
                            ", which it was not given or reported already");
  }
  return *pending_.front();
}

void FrameRunner::write(facts::FrameReport& report, const input::InputFrame& input,
                        const Outputs& outputs) {
  report.input = input.name;
  report.truth = input.truth;
  report.further_truth = input.further_truth;
  report.camera = input.camera;
  if (outputs.pictures) {
    write_png(picture::annotate(input.image, report),
              outputs.pictures->add(picture::picture_name(report)));
  }
  if (outputs.page) outputs.page->add(input.image, report);
  outputs.result.add(report);
  if (report.markers.empty() && without_marker_++ == 0) first_without_marker_ = input.name;
  if (report.board && report.board->misfit.empty()) boards_fit_ = true;
  if (report.board && misfit_.empty() && !report.board->misfit.empty())
    misfit_ = input.name + ": " + report.board->misfit;
  warnings_ += report.warnings.size();
  ++frames_;
  if (progress_) progress_->update(frames_);
  if (outputs.done) ++*outputs.done;
  if (!outputs.text) return;
  outputs.out << result::frame_text(report, source_.size());
  host::check_written(outputs.out);
}

}  // namespace platform::cli
