#include <picture/strip.h>

#include <fmt/format.h>

#include <string>
#include <vector>

#include <picture/canvas.h>
#include <picture/palette.h>
#include <report/error_measure.h>
#include <report/words.h>
#include <vp/text.h>

namespace platform::picture {

namespace {

constexpr double title_size = 0.62;
constexpr double line_size = 0.48;
constexpr double legend_size = 0.44;
constexpr int left_margin = 14;
constexpr int first_baseline = 27;
constexpr int line_pitch = 25;
constexpr int title_gap = 28;
constexpr int widest_text = 820;
constexpr int legend_column = 172;
constexpr int legend_columns = 2;
constexpr int legend_sample = 12;  ///< half the length of a sample line
constexpr double ps_per_ms = 1e9;
constexpr double ps_per_s = 1e12;

std::string title(const report::FrameReport& frame) {
  std::string text = frame.input;
  if (!frame.delivered()) return text + "   no result: " + frame.gave_up;
  if (frame.markers.empty()) return text + "   no marker";
  for (const report::FoundMarker& marker : frame.markers)
    text += fmt::format("   ID {}", marker.id);
  return text;
}

std::string speed(const report::FrameReport& frame) {
  if (!frame.delivered() || frame.end_ps <= frame.start_ps) return "";
  const auto time = static_cast<double>(frame.end_ps - frame.start_ps);
  return fmt::format("{:.1f} FPS   {:.2f} ms", ps_per_s / time, time / ps_per_ms);
}

std::string pose_line(const report::FoundMarker& marker) {
  if (!marker.has_pose) return "no pose: the corners admit none";
  const auto metres = [&](std::size_t axis) {
    return vp::format_fixed(marker.pose.translation[axis], 3);
  };
  return fmt::format("x {}   y {}   z {} m     {}", metres(0), metres(1), metres(2),
                     report::angles_text(marker.pose.rotation));
}

std::string error_line(const report::FrameReport& frame, const report::FoundMarker& marker) {
  if (const GroundTruth* truth = report::truth_of(frame, marker)) {
    return "error   " + report::error_text(marker, *truth);
  }
  if (frame.truth) return fmt::format("another marker: the scene has {}", frame.truth->marker_id);
  return fmt::format("reprojection {:.2f} px", marker.reprojection_px);
}

std::string counts_line(const report::FrameReport& frame) {
  const report::Counts& counts = frame.counts;
  return fmt::format("{}   {}   {}   threshold {}", report::counted(counts.corners, "corner"),
                     report::counted(counts.blobs, "blob"),
                     report::counted(counts.candidates, "candidate"), frame.threshold);
}

struct Entry {
  const char* text;
  const cv::Scalar& colour;
  enum { corner, thin, thick } kind;
  int dx, dy;
};

constexpr int legend_rows = 4;

/// Column by column, legend_rows each.
const std::vector<Entry>& legend() {
  static const std::vector<Entry> entries{
      {"corner, tip north", palette::sky_blue, Entry::corner, 0, -1},
      {"corner, tip east", palette::bluish_green, Entry::corner, 1, 0},
      {"corner, tip south", palette::orange, Entry::corner, 0, 1},
      {"corner, tip west", palette::vermillion, Entry::corner, -1, 0},
      {"blob", palette::reddish_purple, Entry::thin, 0, 0},
      {"candidate", palette::blue, Entry::thick, 0, 0},
      {"marker", palette::yellow, Entry::thick, 0, 0},
  };
  return entries;
}

void draw_entry(cv::Mat& strip, cv::Point place, const Entry& entry) {
  Canvas canvas(strip, 1);
  const PixelPoint middle{place.x + 0.5, place.y + 0.5};
  const PixelPoint left{middle.x - legend_sample, middle.y};
  const PixelPoint right{middle.x + legend_sample, middle.y};
  switch (entry.kind) {
    case Entry::corner:
      canvas.triangle(middle, entry.dx, entry.dy, entry.colour, 5);
      break;
    case Entry::thin:
      canvas.line(left, right, entry.colour, 1);
      break;
    case Entry::thick:
      canvas.line(left, right, entry.colour, 3);
      break;
  }
  draw_text(strip, {place.x + legend_sample + 10, place.y + 5}, entry.text, palette::faint_text,
            legend_size);
}

void draw_legend(cv::Mat& strip) {
  const int left = strip.cols - legend_columns * legend_column + legend_sample;
  for (std::size_t i = 0; i < legend().size(); ++i) {
    const int column = static_cast<int>(i) / legend_rows;
    const int row = static_cast<int>(i) % legend_rows;
    draw_entry(strip, {left + column * legend_column, first_baseline - 5 + row * line_pitch},
               legend()[i]);
  }
}

}  // namespace

void draw_strip(cv::Mat& strip, const report::FrameReport& frame) {
  strip.setTo(palette::strip);
  const std::string head = title(frame);
  draw_text(strip, {left_margin, first_baseline}, head, palette::text, title_size);
  const int after = left_margin + text_width(head, title_size) + title_gap;
  draw_text(strip, {after, first_baseline}, speed(frame), palette::yellow, title_size);
  int baseline = first_baseline;
  const auto add_line = [&](const std::string& text, const cv::Scalar& colour) {
    draw_text(strip, {left_margin, baseline += line_pitch}, text, colour, line_size);
  };
  if (!frame.markers.empty()) {
    add_line(pose_line(frame.markers.front()), palette::text);
    add_line(error_line(frame, frame.markers.front()), palette::text);
  }
  add_line(counts_line(frame), palette::faint_text);
  if (strip.cols >= widest_text + legend_columns * legend_column) draw_legend(strip);
}

}  // namespace platform::picture
