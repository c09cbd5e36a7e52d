#include <zynq/frame_bench.h>

#include <vp/clock_scheduler.h>
#include <vp/error.h>
#include <vp/unit.h>
#include <algorithm>
#include <cstring>

namespace platform {

FrameBench::FrameBench(Zynq& zynq, const SoftwareOptions& options, const vp::ReportRouter& reports)
    : zynq_(zynq), cache_contract_(zynq), spin_watch_(zynq), options_(options), reports_(reports) {
  const input::ImageSize size = zynq_.design().frame_size();
  const auto pixels = static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
  const auto address = zynq_.ps.ddr.dma_memory().allocate(pixels, 4096);
  if (!address) throw vp::InputError("ps.ddr.size leaves no memory for an image");
  frame_.width = static_cast<std::uint32_t>(size.width);
  frame_.height = static_cast<std::uint32_t>(size.height);
  frame_.bus_address = *address;
  frame_.pixels = zynq_.ps.ddr.at(*address, pixels);
}

void FrameBench::start(NextFrame next, FrameDone done) {
  next_ = std::move(next);
  done_ = std::move(done);
}

const hal_frame* FrameBench::next_frame(std::uint64_t) {
  const input::InputFrame* frame = stop_ ? nullptr : next_();
  if (!frame) return nullptr;
  place(*frame);
  return &frame_;
}

// A program that does not upload its images finds them in the image store.
void FrameBench::place(const input::InputFrame& frame) {
  if (options_.value("upload", 1) < 0.5) zynq_.design().show_image(frame.image);
  std::memcpy(zynq_.ps.ddr.at(frame_.bus_address, frame.image.pixels.size()),
              frame.image.pixels.data(), frame.image.pixels.size());
  cache_contract_.placed(frame_.bus_address, frame.image.pixels.size());
  frame_.index = frames_++;
  frame_.fx = frame.camera.fx;
  frame_.fy = frame.camera.fy;
  frame_.cx = frame.camera.cx;
  frame_.cy = frame.camera.cy;
}

bool FrameBench::publish(std::uint32_t kind, const void* data, std::size_t size,
                         std::uint64_t now_ps) {
  cache_contract_.published();
  zynq_.settle();
  report::FrameReport report;
  if (!zynq_.design().report({kind, data, size, now_ps}, report)) {
    throw vp::ProtocolError(
        "the program published a result of unknown kind or size: build it against the HAL and "
        "marker headers of this version" +
        zynq_.ps.cpu.where());
  }
  spin_watch_.finish();
  take_new_warnings(report.warnings);
  const bool delivered = report.delivered();
  stop_ = !done_(std::move(report)) || stop_;
  return delivered;
}

double FrameBench::option(std::uint32_t option, const hal_option_info&) {
  return options_.value(option);
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
  zynq_.design().finish();
  spin_watch_.finish();
  std::vector<std::string> list;
  take_new_warnings(list);
  return list;
}

}  // namespace platform
