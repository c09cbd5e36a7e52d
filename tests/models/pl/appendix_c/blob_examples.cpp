// C.8 to C.12: the blob detection on small pictures, with the registers inside it.
#include "blob_examples.h"

#include <pl/blob_detection/blob_detection.h>

#include "bench.h"

namespace appendix_c {

namespace {

/// A binary picture, drawn bar by bar; 1 is dark.
struct Picture {
  std::uint16_t width, height;
  std::vector<bool> pixels = std::vector<bool>(std::size_t{width} * height);

  Picture& bar(unsigned sx, unsigned sy, unsigned ex, unsigned ey) {
    for (unsigned y = sy; y <= ey; ++y) {
      for (unsigned x = sx; x <= ex; ++x) pixels[y * width + x] = true;
    }
    return *this;
  }
  /// The pixel is at the module's input from this edge on, and is labelled on the next one.
  std::uint64_t edge_of(unsigned x, unsigned y) const { return std::uint64_t{y} * width + x + 1; }
};

/// The labels of the neighbouring window of the pixel that is at the module's input.
class WindowView : public vp::Clocked {
 public:
  WindowView(sc_core::sc_module_name name, vp::Clock& clk, const pl::BlobDetectionClocked& ip,
             RasterSource<bool>& source, const Picture& picture)
      : Clocked(name, clk), ip_(ip), width_(picture.width), labels_(picture.pixels.size()) {
    x_(source.x);
    y_(source.y);
  }
  /// Runs before the module on each edge, so it sees the label of the edge before.
  void follow(vp::Signal<bool>& of_the_module) { order_(of_the_module); }

 private:
  void edge() override {
    if (pending_) labels_[position_] = ip_.core().label();
    position_ = std::size_t{y_} * width_ + x_;
    pending_ = clock().cycle() >= 2;
  }
  std::uint8_t at(int dx, int dy) const {
    const int x = x_ + dx, y = y_ + dy;
    if (x < 0 || y < 0 || x >= width_) return 0;
    const auto position = static_cast<std::size_t>(y * width_ + x);
    const bool newest = pending_ && position == position_;
    return static_cast<std::uint8_t>(newest ? ip_.core().label() : labels_[position]);
  }

  const pl::BlobDetectionClocked& ip_;
  int width_;
  std::vector<pl::BlobCore::Label> labels_;
  std::size_t position_ = 0;
  bool pending_ = false;
  vp::In<std::uint16_t> x_{"x", this}, y_{"y", this};
  vp::In<bool> order_{"order", this};
  vp::Probe<std::uint8_t> left_far_{"left_far", [this] { return at(-2, 0); }};
  vp::Probe<std::uint8_t> left_near_{"left_near", [this] { return at(-1, 0); }};
  vp::ProbeArray<std::uint8_t> above_{
      "above", 5, [this](std::size_t i) { return at(static_cast<int>(i) - 2, -1); }};
};

/// What is known of one label.
struct LabelView : sc_core::sc_module {
  LabelView(sc_core::sc_module_name name, const pl::BlobCore& core, pl::BlobCore::Label label)
      : sc_module(name),
        active("active", [&core, label] { return core.active(label); }),
        sx(
            "sx", [&core, label] { return core.box(label).sx; }, 10),
        sy(
            "sy", [&core, label] { return core.box(label).sy; }, 9),
        ex(
            "ex", [&core, label] { return core.box(label).ex; }, 10),
        ey(
            "ey", [&core, label] { return core.box(label).ey; }, 9),
        x_width(
            "x_width",
            [&core, label] {
              return static_cast<std::uint16_t>(core.box(label).ex - core.box(label).sx);
            },
            10) {}
  vp::Probe<bool> active;
  vp::Probe<std::uint16_t> sx, sy, ex, ey, x_width;
};

struct BlobBench : sc_core::sc_module {
  BlobBench(sc_core::sc_module_name name, vp::ClockScheduler& scheduler, const Picture& picture,
            const std::vector<pl::BlobCore::Label>& shown)
      : sc_module(name),
        clk("clk", scheduler, clock_hz),
        source("source", clk, picture.pixels, picture.width),
        blob_detection("blob_detection", {clk, {picture.width, picture.height}}),
        window("window", clk, blob_detection, source, picture) {
    blob_detection.ena(source.ena);
    blob_detection.rst(rst);
    blob_detection.pixel(source.pixel);
    blob_detection.x(source.x);
    blob_detection.y(source.y);
    window.follow(blob_detection.idle);
    for (const pl::BlobCore::Label label : shown) {
      labels_.push_back(std::make_unique<LabelView>(("label_" + std::to_string(label)).c_str(),
                                                    blob_detection.core(), label));
    }
  }
  const pl::BlobCore& core() const { return blob_detection.core(); }
  const pl::BoundingBox& retired() const { return core().retired(); }

  vp::Clock clk;
  vp::Signal<bool> rst{"rst"};
  RasterSource<bool> source;
  pl::BlobDetectionClocked blob_detection;
  WindowView window;
  vp::Probe<std::uint8_t> label{"label",
                                [this] { return static_cast<std::uint8_t>(core().label()); }};
  vp::Probe<std::uint8_t> next_label{
      "next_label", [this] { return static_cast<std::uint8_t>(core().next_label()); }};
  vp::Probe<std::uint8_t> free_labels{
      "free_labels", [this] { return static_cast<std::uint8_t>(core().free_labels()); }};
  vp::Probe<std::uint8_t> retired_label{
      "retired_label", [this] { return static_cast<std::uint8_t>(core().retired_label()); }};
  vp::Probe<std::uint16_t> retired_sx{"retired_sx", [this] { return retired().sx; }, 10};
  vp::Probe<std::uint16_t> retired_sy{"retired_sy", [this] { return retired().sy; }, 9};
  vp::Probe<std::uint16_t> retired_ex{"retired_ex", [this] { return retired().ex; }, 10};
  vp::Probe<std::uint16_t> retired_ey{"retired_ey", [this] { return retired().ey; }, 9};

 private:
  std::vector<std::unique_ptr<LabelView>> labels_;
};

Picture new_label_picture() {
  return Picture{32, 32}.bar(4, 1, 6, 1).bar(11, 1, 15, 1);
}

struct NewLabelBench : BlobBench {
  NewLabelBench(sc_core::sc_module_name name, vp::ClockScheduler& scheduler)
      : BlobBench(name, scheduler, new_label_picture(), {1, 2}) {}
};

/// Line 2 begins the labels 1 to 11, line 3 label 12. Label 7 is two pixels wide, label 12 five.
/// In line 4 the pixel at x = 34 has 7 two columns left above it and 12 two columns right.
Picture existing_label_picture() {
  Picture picture{64, 32};
  for (const unsigned x : {0u, 4u, 8u, 12u, 16u, 20u, 44u, 48u, 52u, 56u}) picture.bar(x, 2, x, 2);
  return picture.bar(31, 2, 32, 3).bar(36, 3, 40, 3).bar(34, 4, 35, 4);
}

struct ExistingLabelBench : BlobBench {
  ExistingLabelBench(sc_core::sc_module_name name, vp::ClockScheduler& scheduler)
      : BlobBench(name, scheduler, existing_label_picture(), {7, 12}) {}
};

Picture bounding_box_picture() {
  return Picture{32, 32}.bar(2, 1, 2, 1).bar(7, 1, 7, 1).bar(13, 1, 16, 1).bar(12, 2, 18, 3);
}

struct BoundingBoxBench : BlobBench {
  BoundingBoxBench(sc_core::sc_module_name name, vp::ClockScheduler& scheduler)
      : BlobBench(name, scheduler, bounding_box_picture(), {3}) {}
};

/// The labels 1 to 3 go on to line 6, label 4 ends in line 2.
Picture deactivated_label_picture() {
  return Picture{32, 32}.bar(2, 1, 4, 6).bar(8, 1, 10, 6).bar(14, 1, 16, 6).bar(20, 1, 24, 2);
}

struct DeactivatedLabelBench : BlobBench {
  DeactivatedLabelBench(sc_core::sc_module_name name, vp::ClockScheduler& scheduler)
      : BlobBench(name, scheduler, deactivated_label_picture(), {4}) {}
};

Picture blob_filter_picture() {
  return Picture{96, 64}.bar(0, 0, 79, 45);
}

struct BlobFilterBench : BlobBench {
  BlobFilterBench(sc_core::sc_module_name name, vp::ClockScheduler& scheduler)
      : BlobBench(name, scheduler, blob_filter_picture(), {1}) {}

  std::uint16_t field(const vp::Signal<std::uint32_t>& packet, unsigned low,
                      std::uint32_t mask) const {
    return static_cast<std::uint16_t>(blob_detection.blob_out ? packet >> low & mask : 0);
  }
  vp::Probe<std::uint16_t> side_x{
      "side_x", [this] { return static_cast<std::uint16_t>(retired().ex - retired().sx); }, 10};
  vp::Probe<std::uint16_t> side_y{
      "side_y", [this] { return static_cast<std::uint16_t>(retired().ey - retired().sy); }, 9};
  vp::Probe<std::uint16_t> packet_sx{
      "packet_sx", [this] { return field(blob_detection.blob_start, 0, 0x3FF); }, 10};
  vp::Probe<std::uint16_t> packet_sy{
      "packet_sy", [this] { return field(blob_detection.blob_start, 10, 0x1FF); }, 9};
  vp::Probe<std::uint16_t> packet_ex{
      "packet_ex", [this] { return field(blob_detection.blob_end, 0, 0x3FF); }, 10};
  vp::Probe<std::uint16_t> packet_ey{
      "packet_ey", [this] { return field(blob_detection.blob_end, 10, 0x1FF); }, 9};
};

}  // namespace

void trace_new_label(const std::filesystem::path& file) {
  const Picture picture = new_label_picture();
  trace<NewLabelBench>("new_label", file, picture.edge_of(2, 1), picture.edge_of(19, 1));
}
void trace_existing_label(const std::filesystem::path& file) {
  const Picture picture = existing_label_picture();
  trace<ExistingLabelBench>("existing_label", file, picture.edge_of(29, 4), picture.edge_of(39, 4));
}
void trace_bounding_box(const std::filesystem::path& file) {
  const Picture picture = bounding_box_picture();
  trace<BoundingBoxBench>("bounding_box", file, picture.edge_of(10, 1), picture.edge_of(22, 3));
}
void trace_deactivated_label(const std::filesystem::path& file) {
  const Picture picture = deactivated_label_picture();
  trace<DeactivatedLabelBench>("deactivated_label", file, picture.edge_of(18, 3),
                               picture.edge_of(3, 4));
}
void trace_blob_filter(const std::filesystem::path& file) {
  const Picture picture = blob_filter_picture();
  trace<BlobFilterBench>("blob_filter", file, picture.edge_of(76, 46), picture.edge_of(90, 46));
}

}  // namespace appendix_c
