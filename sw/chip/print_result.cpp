// A frame's result on the console of the chip: what a user wants to see first.
#include <hal/hal.h>
#include <marker/detection_result.h>
#include <marker/result.h>

#include <array>

namespace {

/// A line put together without the standard library's formatting.
class Line {
 public:
  Line& text(const char* text) {
    while (*text != 0) put(*text++);
    return *this;
  }

  Line& number(std::uint32_t value) {
    char digits[10];
    unsigned count = 0;
    do {
      digits[count++] = static_cast<char>('0' + value % 10);
      value /= 10;
    } while (value != 0);
    while (count > 0) put(digits[--count]);
    return *this;
  }

  /// `value` with three decimal places, within ± 4 million.
  Line& thousandths(double value) {
    if (value < 0) put('-');
    const auto scaled = static_cast<std::uint64_t>((value < 0 ? -value : value) * 1000 + 0.5);
    number(static_cast<std::uint32_t>(scaled / 1000)).text(".");
    for (std::uint32_t place = 100; place > 0; place /= 10) {
      put(static_cast<char>('0' + scaled / place % 10));
    }
    return *this;
  }

  void write() {
    put('\n');
    hal_console_write(line_, length_);
  }

 private:
  void put(char character) {
    if (length_ < sizeof line_) line_[length_++] = character;
  }

  char line_[256];
  std::size_t length_ = 0;
};

/// Counts of the global timer at the CPU's 666.67 MHz.
constexpr double counts_per_millisecond = 333'333.343;

double milliseconds(const marker::StageTime& stage) {
  return static_cast<double>(stage.end - stage.start) / counts_per_millisecond;
}

void print_corners(std::uint32_t id, const marker::Quad& corners) {
  Line line;
  line.text("  marker ").number(id).text(" at");
  for (const marker::Point& corner : corners) {
    line.text(" (").thousandths(corner.x).text(", ").thousandths(corner.y).text(")");
  }
  line.text(" px").write();
}

Line& add_translation(Line& line, const std::array<double, 3>& t) {
  return line.text("  translation ")
      .thousandths(t[0])
      .text(", ")
      .thousandths(t[1])
      .text(", ")
      .thousandths(t[2])
      .text(" m");
}

void print_marker(const marker::Marker& marker) {
  print_corners(marker.identity.id, marker.corners);
  if (!marker.pose.valid) return;
  Line line;
  add_translation(line, marker.pose.translation)
      .text(", reprojection error ")
      .thousandths(marker.pose.reprojection_px)
      .text(" px after ")
      .number(marker.pose.iterations)
      .text(" iterations")
      .write();
}

void print_pose(const marker::BoardPoses& pose) {
  if (!pose.valid) return;
  Line line;
  add_translation(line, pose.best.translation).write();
}

bool print(const marker::FrameResult& result) {
  Line()
      .text("frame ")
      .number(result.frame)
      .text(": ")
      .text(marker::status_name(result.status))
      .text(", ")
      .number(result.features.corner_count)
      .text(" corners, ")
      .number(result.features.blob_count)
      .text(" blobs, ")
      .number(result.marker_count)
      .text(result.marker_count == 1 ? " marker, " : " markers, ")
      .thousandths(milliseconds(result.times.frame))
      .text(" ms")
      .write();
  for (std::uint32_t i = 0; i < result.marker_count; ++i) print_marker(result.markers[i]);
  return true;
}

bool print(const marker::DetectionResult& result) {
  const marker::Detections& found = result.found;
  Line()
      .text("frame ")
      .number(result.frame)
      .text(": ")
      .text(marker::status_name(result.status))
      .text(", ")
      .number(found.blobs.received)
      .text(" blobs, ")
      .number(found.count)
      .text(found.count == 1 ? " marker, " : " markers, ")
      .thousandths(milliseconds(result.times.frame))
      .text(" ms")
      .write();
  for (std::uint32_t i = 0; i < found.count; ++i) {
    print_corners(found.markers[i].marker.id, found.markers[i].marker.fit.image);
    print_pose(found.markers[i].pose);
  }
  print_pose(found.board);
  return true;
}

}  // namespace

/// Called by hal_publish(). False if the result is of another kind.
extern "C" bool chip_print_result(uint32_t kind, const void* data, size_t size) {
  if (kind == marker::frame_result_kind && size == sizeof(marker::FrameResult)) {
    return print(*static_cast<const marker::FrameResult*>(data));
  }
  if (kind == marker::detection_result_kind && size <= sizeof(marker::DetectionResult)) {
    return print(*static_cast<const marker::DetectionResult*>(data));
  }
  return false;
}
