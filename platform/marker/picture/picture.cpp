#include <marker/picture/picture.h>

#include <facts/result.h>
#include <facts/summary.h>
#include <fmt/format.h>
#include <marker/picture/canvas.h>
#include <marker/report/marker_frame.h>
#include <marker/report/marker_text.h>
#include <png.h>
#include <result/console.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>
#include <zlib.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <csetjmp>
#include <string>
#include <vector>

namespace platform::picture {

namespace {

/// Height of the strip below the image, px.
constexpr int strip_height = 118;

/// Fills the strip: ID and time, pose, error and counts on the left, on the right what the colours
/// mean that were drawn, if there is room.
void draw_strip(cv::Mat& strip, const facts::UnitReport& frame);

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

std::string title(const facts::UnitReport& frame) {
  std::string text = frame.input;
  if (!frame.delivered()) return text + "   no result: " + frame.gave_up;
  const MarkerFrame& found = marker_frame(frame);
  if (found.markers.empty()) return text + "   no marker";
  for (const FoundMarker& marker : found.markers) text += fmt::format("   ID {}", marker.id);
  return text;
}

/// No rate: frames may overlap.
std::string time_taken(const facts::UnitReport& frame) {
  if (!frame.delivered() || frame.end_ps <= frame.start_ps) return "";
  return fmt::format("{:.2f} ms", static_cast<double>(frame.end_ps - frame.start_ps) / ps_per_ms);
}

std::string pose_line(const FoundMarker& marker) {
  if (!marker.has_pose) return "no pose: the corners admit none";
  const auto metres = [&](std::size_t axis) {
    return vp::format_fixed(marker.pose.translation[axis], 3);
  };
  return fmt::format("x {}   y {}   z {} m     {}", metres(0), metres(1), metres(2),
                     angles_text(marker.pose.rotation));
}

std::string error_line(const MarkerFrame& frame, const FoundMarker& marker) {
  if (const GroundTruth* truth = truth_of(frame, marker)) {
    return "error   " + error_text(marker, *truth);
  }
  if (frame.truth) return another_marker_text(frame);
  if (!marker.reprojection_px) return {};
  return fmt::format("reprojection {:.2f} px", *marker.reprojection_px);
}

struct Entry {
  const char* text;
  cv::Scalar colour;
  enum { corner, thin, thick } kind;
  int dx, dy;
};

constexpr int legend_rows = 4;

/// Of what the frame shows; column by column, legend_rows each.
std::vector<Entry> legend(const MarkerFrame& frame) {
  std::vector<Entry> entries;
  const Features& drawn = frame.features;
  if (!drawn.corners.empty()) {
    entries = {{"corner, tip north", palette::sky_blue, Entry::corner, 0, -1},
               {"corner, tip east", palette::bluish_green, Entry::corner, 1, 0},
               {"corner, tip south", palette::orange, Entry::corner, 0, 1},
               {"corner, tip west", palette::vermilion, Entry::corner, -1, 0}};
  }
  if (!drawn.blobs.empty()) entries.push_back({"blob", palette::reddish_purple, Entry::thin, 0, 0});
  if (!drawn.candidates.empty())
    entries.push_back({"candidate", palette::blue, Entry::thick, 0, 0});
  if (!frame.markers.empty()) entries.push_back({"marker", palette::yellow, Entry::thick, 0, 0});
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

void draw_legend(cv::Mat& strip, const std::vector<Entry>& entries) {
  const int left = strip.cols - legend_columns * legend_column + legend_sample;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const int column = static_cast<int>(i) / legend_rows;
    const int row = static_cast<int>(i) % legend_rows;
    draw_entry(strip, {left + column * legend_column, first_baseline - 5 + row * line_pitch},
               entries[i]);
  }
}

void draw_strip(cv::Mat& strip, const facts::UnitReport& frame) {
  strip.setTo(palette::strip);
  const std::string head = title(frame);
  draw_text(strip, {left_margin, first_baseline}, head, palette::text, title_size);
  const int after = left_margin + text_width(head, title_size) + title_gap;
  draw_text(strip, {after, first_baseline}, time_taken(frame), palette::yellow, title_size);
  int baseline = first_baseline;
  const auto add_line = [&](const std::string& text, const cv::Scalar& colour) {
    draw_text(strip, {left_margin, baseline += line_pitch}, text, colour, line_size);
  };
  const MarkerFrame& found = marker_frame(frame);
  if (!found.markers.empty()) {
    add_line(pose_line(found.markers.front()), palette::text);
    add_line(error_line(found, found.markers.front()), palette::text);
  }
  add_line(result::counts_text(frame), palette::faint_text);
  if (strip.cols >= widest_text + legend_columns * legend_column) draw_legend(strip, legend(found));
}

}  // namespace

namespace {

constexpr int usual_width = 1280;
constexpr double corner_size = 4.5;
constexpr double near_plane_m = 0.01;
/// The image is drawn a little paler and darker than it is, so that colours stand out.
constexpr double contrast = 0.80;
constexpr double brightness = 16;

PixelPoint centre_of(double column, double row) {
  return {column + pixel_centre, row + pixel_centre};
}

struct Heading {
  int dx, dy;
  const cv::Scalar& colour;
};

Heading heading(marker::Direction direction) {
  switch (direction) {
    case marker::Direction::north:
      return {0, -1, palette::sky_blue};
    case marker::Direction::south:
      return {0, 1, palette::orange};
    case marker::Direction::east:
      return {1, 0, palette::bluish_green};
    default:
      return {-1, 0, palette::vermilion};
  }
}

void draw_features(Canvas& canvas, const Features& features) {
  for (const marker::BoundingBox& box : features.blobs) {
    canvas.box(box.sx, box.sy, box.ex + 1, box.ey + 1, palette::reddish_purple);
  }
  for (const auto& corners : features.candidates) {
    std::vector<PixelPoint> points;
    points.reserve(corners.size());
    for (const PixelPoint& corner : corners) points.push_back(centre_of(corner.x, corner.y));
    canvas.outline(points, palette::blue, 2);
  }
  for (const marker::Corner& corner : features.corners) {
    const Heading to = heading(corner.direction);
    canvas.triangle(centre_of(corner.x, corner.y), to.dx, to.dy, to.colour, corner_size);
  }
}

/// Arrows of half the marker's side from its own top left corner; w points away from the viewer.
void draw_axes(Canvas& canvas, const Camera& camera, const Pose& pose) {
  constexpr double length = marker_side_m / 2;
  struct Axis {
    const char* name;
    Eigen::Vector3d end;
    const cv::Scalar& colour;
  };
  const std::array<Axis, 3> axes{{{"w", {0, 0, length}, palette::blue},
                                  {"v", {0, length, 0}, palette::bluish_green},
                                  {"u", {length, 0, 0}, palette::vermilion}}};
  const Eigen::Vector3d origin = transform(pose, {0, 0, 0});
  if (origin[2] < near_plane_m) return;
  for (const Axis& axis : axes) {
    const Eigen::Vector3d end = transform(pose, axis.end);
    if (end[2] < near_plane_m) continue;
    const PixelPoint from = project(camera, origin);
    const PixelPoint to = project(camera, end);
    canvas.arrow(from, to, axis.colour, 3);
    const PixelPoint name{from.x + (to.x - from.x) * 1.12, from.y + (to.y - from.y) * 1.12};
    canvas.label(name, axis.name, palette::text, 0.45);
  }
}

PixelPoint outwards(PixelPoint middle, PixelPoint corner, double px) {
  const double dx = corner.x - middle.x;
  const double dy = corner.y - middle.y;
  const double length = std::max(1.0, std::sqrt(dx * dx + dy * dy));
  return {corner.x + dx / length * px, corner.y + dy / length * px};
}

void draw_marker(Canvas& canvas, const FoundMarker& found, const Camera& camera) {
  const auto& corners = found.corners_px;
  PixelPoint middle;
  double top = corners[0].y;
  for (const PixelPoint& corner : corners) {
    middle.x += corner.x / 4;
    middle.y += corner.y / 4;
    top = std::min(top, corner.y);
  }
  canvas.outline({corners.begin(), corners.end()}, palette::yellow, 3);
  if (found.has_pose) draw_axes(canvas, camera, found.pose);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    canvas.dot(corners[i], palette::yellow, i == 0 ? 6 : 4);
    canvas.label(outwards(middle, corners[i], 9), std::to_string(i + 1), palette::yellow, 0.45);
  }
  canvas.label({middle.x, top - 22}, fmt::format("ID {}", found.id), palette::yellow, 0.8);
}

void draw_image(const GreyImage& image, int enlargement, cv::Mat target) {
  // OpenCV's type has no const view of pixels that it does not own; they are only read.
  const cv::Mat grey(image.height, image.width, CV_8UC1,
                     const_cast<std::uint8_t*>(image.pixels.data()));
  cv::Mat paler;
  grey.convertTo(paler, CV_8U, contrast, brightness);
  cv::Mat enlarged;
  cv::resize(paler, enlarged, {}, enlargement, enlargement, cv::INTER_NEAREST);
  cv::cvtColor(enlarged, target, cv::COLOR_GRAY2RGB);
}

}  // namespace

Picture annotate(const GreyImage& image, const facts::UnitReport& frame) {
  cv::setNumThreads(1);  // a pool of threads costs more than it gives here
  const int enlargement = std::max(1, usual_width / image.width);
  const int rows = image.height * enlargement;
  Picture picture{image.width * enlargement, rows + strip_height, {}};
  picture.rgb.resize(static_cast<std::size_t>(picture.width) *
                     static_cast<std::size_t>(picture.height) * 3);
  cv::Mat whole(picture.height, picture.width, CV_8UC3, picture.rgb.data());
  cv::Mat view = whole.rowRange(0, rows);
  draw_image(image, enlargement, view);
  Canvas canvas(view, enlargement);
  const MarkerFrame& found = marker_frame(frame);
  draw_features(canvas, found.features);
  for (const FoundMarker& marker : found.markers) draw_marker(canvas, marker, found.camera);
  cv::Mat strip = whole.rowRange(rows, picture.height);
  draw_strip(strip, frame);
  return picture;
}

std::string picture_name(const facts::UnitReport& frame) {
  // Names of files have at most 255 bytes, and more is added to this one.
  constexpr std::size_t longest_stem = 200;
  std::string stem = frame.input.substr(0, frame.input.rfind('.'));
  const std::size_t number = frame.input.rfind('#');  // of a video's picture
  if (number != std::string::npos && number > stem.size()) stem += frame.input.substr(number);
  if (marker_frame(frame).truth) stem = frame.input;  // a scene: "z1.0" has no extension
  stem.resize(std::min(stem.size(), longest_stem));
  for (char& c : stem) {
    const bool usual =
        std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '.' || c == '_';
    if (!usual) c = '_';
  }
  return fmt::format("{:04}_{}.png", frame.index, stem);
}

namespace {

/// Every picture pixel is repeated below itself, so that the difference to the row above is mostly
/// runs of zeros: with these two, 13 ms and 270 KB for 1280x960 px; zlib's default takes three
/// times as long.
constexpr int filter = PNG_FILTER_UP;
constexpr int strategy = Z_RLE;
constexpr int level = 1;
constexpr std::size_t buffer_size = 1 << 16;

/// Bytes of a picture, row by row.
struct Rows {
  int width, height;
  std::size_t channels;  ///< 1 grey, 3 colour
  const std::uint8_t* bytes;
};

void append(png_structp png, png_bytep data, std::size_t size) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), size);
}

void flush(png_structp) {}

/// libpng leaves by longjmp on failure, so nothing here has a destructor.
bool encode(const Rows& rows, std::string& bytes) {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  if (info == nullptr || setjmp(png_jmpbuf(png)) != 0) {
    png_destroy_write_struct(&png, &info);
    return false;
  }
  png_set_write_fn(png, &bytes, append, flush);
  const int colours = rows.channels == 1 ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB;
  png_set_IHDR(png, info, static_cast<png_uint_32>(rows.width),
               static_cast<png_uint_32>(rows.height), 8, colours, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, filter);
  png_set_compression_strategy(png, strategy);
  png_set_compression_level(png, level);
  png_set_compression_buffer_size(png, buffer_size);
  png_write_info(png, info);
  const std::size_t row = static_cast<std::size_t>(rows.width) * rows.channels;
  for (int y = 0; y < rows.height; ++y) {
    png_write_row(png, rows.bytes + static_cast<std::size_t>(y) * row);
  }
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  return true;
}

}  // namespace

std::string encode_png(const GreyImage& image) {
  std::string bytes;
  if (!encode({image.width, image.height, 1, image.pixels.data()}, bytes)) {
    throw vp::InputError("image cannot be encoded as PNG");
  }
  return bytes;
}

void write_png(const Picture& picture, const std::string& path) {
  std::string bytes;
  if (!encode({picture.width, picture.height, 3, picture.rgb.data()}, bytes))
    throw vp::InputError("picture '" + path + "' cannot be encoded");
  vp::write_file(path, bytes);
}

}  // namespace platform::picture
