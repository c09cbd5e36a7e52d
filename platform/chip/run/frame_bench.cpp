#include <chip/run/frame_bench.h>

#include <chip/system/hardware_map.h>
#include <vp/clock_scheduler.h>
#include <vp/error.h>
#include <vp/unit.h>
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace platform {

FrameBench::FrameBench(Zynq& zynq, const CameraTiming& camera, const SoftwareOptions& options,
                       const vp::ReportRouter& reports)
    : zynq_(zynq), cache_contract_(zynq), camera_(camera), options_(options), reports_(reports) {
  const input::ImageSize size = zynq_.design().frame_size();
  const auto pixels = static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
  const auto address = zynq_.ps.ddr.dma_memory().allocate(pixels, 4096);
  if (!address) throw vp::InputError("ps.ddr.size leaves no memory for an image");
  frame_.width = static_cast<std::uint32_t>(size.width);
  frame_.height = static_cast<std::uint32_t>(size.height);
  frame_.bus_address = *address;
  frame_.pixels = zynq_.ps.ddr.at(*address, pixels);
}

void FrameBench::start(FrameBegins begins, NextFrame next, FrameDone done) {
  begins_ = std::move(begins);
  next_ = std::move(next);
  done_ = std::move(done);
}

// The image after the last one that the program took at the earliest; it was busy since then. One
// that settles stays before the camera.
std::uint64_t FrameBench::next_frame_ps(std::uint64_t now_ps) {
  if (!camera_.has_rate()) return now_ps;
  if (!first_ps_) {
    first_ps_ = period_from_ps_ = now_ps;
    return now_ps;
  }
  const std::uint64_t after = awaited_ + 1;
  const bool settles = showings_left_ > 0;
  if (!settles) busy_ps_.add(static_cast<double>(now_ps - came_ps(awaited_)));
  awaited_ = std::max(after, camera_.first_after(now_ps - *first_ps_));
  missed_ = settles ? 0 : awaited_ - after;
  dropped_ += missed_;
  return came_ps(awaited_);
}

const hal_frame* FrameBench::next_frame(std::uint64_t) {
  if (waiting_ && camera_.has_rate()) {
    waiting_->camera_missed = missed_;
    hand_over(came_ps(awaited_));
  }
  begins_();
  if (showings_left_ == 0 && !take_image()) return nullptr;
  --showings_left_;
  place(image_);
  return &frame_;
}

input::SharedFrame FrameBench::next_image() {
  input::SharedFrame frame = stop_ ? nullptr : next_();
  if (frame) ++images_;
  return frame;
}

/// False: there is none.
bool FrameBench::take_image() {
  input::SharedFrame frame = next_image();
  for (; frame && missed_ > 0; --missed_) frame = next_image();
  if (!frame) return false;
  showings_left_ = 1 + (settles(*frame) ? zynq_.design().settling_showings() : 0);
  image_ = std::move(frame);
  ++taken_;
  return true;
}

bool FrameBench::settles(const input::InputFrame& frame) const {
  using Kind = input::InputItem::Kind;
  const bool is_behind_still = image_ && image_->kind == Kind::image;
  if (frame.kind != Kind::image && !(frame.kind == Kind::scene && is_behind_still)) return false;
  return !image_ || image_->image.pixels != frame.image.pixels;
}

std::uint64_t FrameBench::came_ps(std::uint64_t number) const {
  return *first_ps_ + camera_.offset_ps(number);
}

// Of a program that does not upload its images: in the image store, or before the camera.
void FrameBench::place(const input::SharedFrame& frame) {
  if (!options_.uploads()) zynq_.design().show_image({frame, &frame->image});
  const std::vector<std::uint8_t>& pixels = frame->image.pixels;
  std::memcpy(zynq_.ps.ddr.behind(frame_.bus_address, pixels.size()), pixels.data(), pixels.size());
  cache_contract_.placed(frame_.bus_address, pixels.size());
  const bool counts = showings_left_ == 0;
  frame_.index = images_ - 1 + settling_showings_;
  shown_.push_back({frame, frame_.index, images_ - 1, counts});
  if (!counts) ++settling_showings_;
  const Camera& camera = frame->camera;
  frame_.fx = camera.fx;
  frame_.fy = camera.fy;
  frame_.cx = camera.cx;
  frame_.cy = camera.cy;
  static_assert(sizeof camera.distortion == sizeof frame_.distortion);
  std::copy(camera.distortion.begin(), camera.distortion.end(), frame_.distortion);
  frame_.lens_model = static_cast<std::uint32_t>(camera.lens_model);
  frame_.light = camera.response.light ? camera.response.light->data() : nullptr;
  frame_.response = frame_.light != nullptr     ? HAL_RESPONSE_TABLE
                    : camera.response.is_linear ? HAL_RESPONSE_LINEAR
                                                : HAL_RESPONSE_UNKNOWN;
}

bool FrameBench::publish(std::uint32_t kind, const void* data, std::size_t size,
                         std::uint64_t now_ps) {
  zynq_.settle();
  facts::FrameReport report;
  if (!zynq_.design().report({kind, data, size, now_ps}, report)) {
    throw vp::ProtocolError(
        "the program published a result of unknown kind or size: build it against the HAL and "
        "marker headers of this version" +
        zynq_.ps.cpu.where());
  }
  const Shown shown = published(report.index);
  report.index = shown.index;
  report.camera = shown.frame->camera;
  zynq_.design().check(report);
  take_new_warnings(report.warnings);
  const bool delivered = report.delivered();
  if (shown.counts) ++published_;
  if (waiting_) hand_over(waiting_->end_ps);
  waiting_ = std::move(report);
  waiting_counts_ = shown.counts;
  if (!camera_.has_rate()) hand_over(std::nullopt);
  return delivered;
}

/// A program may leave out images, but not go back or ahead.
FrameBench::Shown FrameBench::published(std::uint32_t number) {
  while (!shown_.empty() && shown_.front().number < number) shown_.pop_front();
  if (shown_.empty() || shown_.front().number != number) {
    throw vp::ProtocolError("the program reported frame " + std::to_string(number) +
                            ", which it was not given or reported already" + zynq_.ps.cpu.where());
  }
  Shown shown = std::move(shown_.front());
  shown_.pop_front();
  return shown;
}

/// The period of the frame that waits for it ends at `until_ps`; none: with its result.
void FrameBench::hand_over(std::optional<std::uint64_t> until_ps) {
  if (!waiting_) return;
  if (until_ps) {
    waiting_->camera_period = vp::Interval{period_from_ps_, *until_ps};
    period_from_ps_ = *until_ps;
  }
  facts::FrameReport report = *std::exchange(waiting_, std::nullopt);
  if (!waiting_counts_) return keep_settling(report);
  if (settling_.index == report.index && settling_.settling_showings > 0) {
    report.settling_showings = settling_.settling_showings;
    report.settled_ps = settling_.end_ps;
    report.warnings.insert(report.warnings.begin(), settling_.warnings.begin(),
                           settling_.warnings.end());
  }
  settling_ = {};
  stop_ = !done_(std::move(report)) || stop_;
}

/// Of a showing that does not count: what its frame needs to know.
void FrameBench::keep_settling(const facts::FrameReport& report) {
  if (settling_.index != report.index) settling_ = {};
  settling_.index = report.index;
  settling_.end_ps = report.end_ps;
  ++settling_.settling_showings;
  settling_.warnings.insert(settling_.warnings.end(), report.warnings.begin(),
                            report.warnings.end());
}

std::optional<facts::CameraReport> FrameBench::camera_report() const {
  if (busy_ps_.count() == 0) return std::nullopt;
  return facts::CameraReport{camera_.fps(), busy_ps_.count() + dropped_, dropped_, busy_ps_.mean(),
                             busy_ps_.max()};
}

double FrameBench::option(std::uint32_t option, const hal_option_info&) {
  return options_.value(option);
}

// The program gets what its header would have, had it been written for this configuration.
std::optional<std::uint32_t> FrameBench::xparameter(const char* name) {
  if (xparameters_.empty()) xparameters_ = xparameters_header(zynq_);
  const std::string line = "#define XPAR_" + std::string(name) + " ";
  const std::size_t at = xparameters_.find(line);
  if (at == std::string::npos) return std::nullopt;
  return static_cast<std::uint32_t>(
      std::strtoul(xparameters_.c_str() + at + line.size(), nullptr, 0));
}

void FrameBench::take_new_warnings(std::vector<std::string>& list) {
  const auto& all = reports_.warnings();
  for (; warnings_reported_ < all.size(); ++warnings_reported_) {
    const vp::Warning& w = all[warnings_reported_];
    list.push_back(w.where + ": " + w.message + " (" + w.id + " at " + vp::format_time(w.time_ps) +
                   ")");
  }
}

std::vector<std::string> FrameBench::finish() {
  if (waiting_) hand_over(waiting_->end_ps);
  zynq_.design().finish();
  std::vector<std::string> list;
  if (settling_.settling_showings > 0) list = std::move(settling_.warnings);
  take_new_warnings(list);
  return list;
}

}  // namespace platform
