#include <marker/picture/page_view.h>

#include <fmt/format.h>

#include <array>

#include <marker/picture/picture.h>
#include <marker/report/marker_frame.h>
#include <result/page/report_page.h>

namespace platform::picture {

namespace {

/// Appends "[a,b],[c,d]": thousands of corners a frame are too many for a tree of values.
template <class Items, class Write>
void append_list(std::string& out, const char* name, const Items& items, Write write) {
  out += fmt::format(",\"{}\":[", name);
  bool first = true;
  for (const auto& item : items) {
    if (!first) out += ',';
    first = false;
    write(out, item);
  }
  out += ']';
}

}  // namespace

std::string page_view(const GreyImage& image, const facts::UnitReport& frame) {
  const MarkerFrame& found = marker_frame(frame);
  const Camera& camera = found.camera;
  std::string out = fmt::format(
      R"({{"width":{},"height":{},"camera":{{"fx":{},"fy":{},"cx":{},"cy":{}}},"png":")",
      image.width, image.height, camera.fx, camera.fy, camera.cx, camera.cy);
  out += page::base64(encode_png(image));
  out += '"';
  const Features& features = found.features;
  append_list(out, "corners", features.corners, [](std::string& to, const marker::Corner& c) {
    to += fmt::format("[{},{},{}]", c.x, c.y, static_cast<int>(c.direction));
  });
  append_list(out, "blobs", features.blobs, [](std::string& to, const marker::BoundingBox& b) {
    to += fmt::format("[{},{},{},{}]", b.sx, b.sy, b.ex, b.ey);
  });
  append_list(out, "candidates", features.candidates,
              [](std::string& to, const std::array<PixelPoint, 4>& quad) {
                to += fmt::format("[[{},{}],[{},{}],[{},{}],[{},{}]]", quad[0].x, quad[0].y,
                                  quad[1].x, quad[1].y, quad[2].x, quad[2].y, quad[3].x, quad[3].y);
              });
  return out + "}";
}

}  // namespace platform::picture
