// A frame's result on the console of the chip: what a user wants to see first.
#include <hal/hal.h>
#include <marker/result.h>

#include <cstring>

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

void print_marker(const marker::Marker& marker) {
  Line line;
  line.text("  marker ").number(marker.identity.id).text(" at");
  for (const marker::Point& corner : marker.corners) {
    line.text(" (").thousandths(corner.x).text(", ").thousandths(corner.y).text(")");
  }
  line.text(" px").write();
  if (!marker.pose.valid) return;
  const auto& t = marker.pose.translation;
  Line()
      .text("  translation ")
      .thousandths(t[0])
      .text(", ")
      .thousandths(t[1])
      .text(", ")
      .thousandths(t[2])
      .text(" m, reprojection error ")
      .thousandths(marker.pose.reprojection_px)
      .text(" px after ")
      .number(marker.pose.iterations)
      .text(" iterations")
      .write();
}

}  // namespace

/// Called by hal_publish(). False if the result is of another kind.
extern "C" bool chip_print_result(uint32_t kind, const void* data, size_t size) {
  static marker::FrameResult result;
  if (kind != marker::frame_result_kind || size != sizeof result) return false;
  std::memcpy(&result, data, sizeof result);
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
