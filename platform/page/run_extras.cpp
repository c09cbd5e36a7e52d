#include <fmt/format.h>

#include <cstdint>

#include <page/run_extras.h>
#include <picture/picture.h>
#include <report/result_json.h>

namespace platform::page {

std::string base64(std::string_view bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  const auto byte = [&](std::size_t i) -> std::uint32_t {
    return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0;
  };
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::uint32_t three = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    for (int shift = 18; shift >= 0; shift -= 6) text += digits[three >> shift & 63];
  }
  const std::size_t missing = (3 - bytes.size() % 3) % 3;
  text.replace(text.size() - missing, missing, missing, '=');
  return text;
}

namespace {

using report::Json;

std::string text_of(const std::string& text) {
  return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
}

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

std::string view_json(const GreyImage& image, const report::FrameReport& frame) {
  const Camera& camera = frame.camera;
  std::string out = fmt::format(
      R"({{"width":{},"height":{},"camera":{{"fx":{},"fy":{},"cx":{},"cy":{}}},"png":")",
      image.width, image.height, camera.fx, camera.fy, camera.cx, camera.cy);
  out += base64(picture::encode_png(image));
  out += '"';
  const report::Features& features = frame.features;
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

}  // namespace

void RunExtras::add(const GreyImage& image, const report::FrameReport& frame) {
  if (full_ || count_ >= most_frames) return;
  const std::string view = view_json(image, frame);
  if (count_ > 0 && frames_.size() + view.size() > most_bytes) {
    full_ = true;
    return;
  }
  frames_ += fmt::format("{}\"{}\":{}", count_++ == 0 ? "" : ",", frame.index, view);
}

void RunExtras::add_member(std::string name, std::string json) {
  members_ += fmt::format(",{}:{}", text_of(name), json);
}

std::string RunExtras::json(const std::vector<vp::ParameterDescription>& parameters) const {
  std::string text = "{\"frames\":{" + frames_ + "},\"parameters\":[";
  bool first = true;
  for (const vp::ParameterDescription& p : parameters) {
    text +=
        fmt::format("{}[{},{},\"{}\",{}]", first ? "" : ",", text_of(p.path),
                    text_of(p.default_value), vp::to_string(p.source), text_of(p.documentation));
    first = false;
  }
  return text + "]" + members_ + "}";
}

}  // namespace platform::page
