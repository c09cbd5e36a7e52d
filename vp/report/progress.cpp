#include <unistd.h>
#include <vp/progress.h>
#include <vp/text.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace vp {
namespace {

constexpr auto draw_interval = std::chrono::milliseconds(200);
constexpr const char* clear_line = "\r\033[K";

std::string readable_duration(double seconds) {
  const auto whole = static_cast<std::uint64_t>(std::ceil(seconds));
  if (whole < 60) return std::to_string(whole) + " s";
  if (whole < 3600) return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
  return std::to_string(whole / 3600) + " h " + std::to_string(whole % 3600 / 60) + " min";
}

}  // namespace

std::string progress_line(const std::string& label, std::uint64_t done, std::uint64_t total,
                          double seconds) {
  constexpr std::size_t width = 30;
  done = std::min(done, total);
  const double fraction = total == 0 ? 1.0 : static_cast<double>(done) / static_cast<double>(total);
  const auto filled = static_cast<std::size_t>(fraction * width);
  std::string line = visible(label) + "  [" + std::string(filled, '#') +
                     std::string(width - filled, '.') + "]  " +
                     std::to_string(static_cast<int>(fraction * 100)) + " %  " +
                     std::to_string(done) + "/" + std::to_string(total);
  if (done > 0 && done < total)
    line += "  " + readable_duration(seconds * (1.0 / fraction - 1.0)) + " left";
  return line;
}

Progress::Progress(std::string label, std::uint64_t total)
    : label_(std::move(label)),
      total_(total),
      terminal_(isatty(STDERR_FILENO) == 1),
      start_(HostClock::now()),
      next_draw_(start_ + draw_interval) {}

Progress::~Progress() {
  if (drawn_) std::fputs(clear_line, stderr);
}

void Progress::update(std::uint64_t done) {
  done_ = done;
  if (!terminal_) return;
  const HostClock::time_point now = HostClock::now();
  if (now < next_draw_) return;
  next_draw_ = now + draw_interval;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  std::fputs((clear_line + progress_line(label_, done_, total_, seconds)).c_str(), stderr);
  std::fflush(stderr);
  drawn_ = true;
}

}  // namespace vp
