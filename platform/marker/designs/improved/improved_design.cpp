#include <marker/designs/improved/board_check.h>
#include <marker/designs/improved/improved_design.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include <blob_stream.h>
#include <chip/system/designs.h>
#include <facts/result.h>
#include <marker/input/image_need.h>
#include <marker/report/marker_frame.h>
#include <marker_logic.h>
#include <vp/clock.h>
#include <vp/text.h>

namespace platform {

namespace {

/// A word of the pictures' stream (pl::check()).
constexpr std::uint32_t most_pixels_per_clock = 4;

Pose pose_of(const marker::BoardPose& pose) {
  return {Eigen::Matrix<double, 3, 3, Eigen::RowMajor>::Map(pose.rotation.data()),
          Eigen::Vector3d::Map(pose.translation.data())};
}

std::optional<PoseMotion> motion_of(const marker::PoseMotion& motion) {
  if (motion.frames == 0) return std::nullopt;
  return PoseMotion{motion.frames, motion.velocity, motion.turn_rate};
}

FoundMarker found_marker(const marker::Detection& detection, double side_m) {
  const marker::DetectedMarker& m = detection.marker;
  FoundMarker found;
  found.id = m.id;
  found.side_m = side_m;
  found.corrected = m.corrected;
  for (std::size_t i = 0; i < 4; ++i) found.corners_px[i] = {m.fit.image[i].x, m.fit.image[i].y};
  found.has_pose = detection.pose.valid;
  if (!found.has_pose) return found;
  found.pose = pose_of(detection.pose.best);
  found.covariance = detection.pose.best.covariance;
  found.motion = motion_of(detection.motion);
  return found;
}

/// A result as long as it says that it is.
bool read(const Publication& publication, marker::DetectionResult& result) {
  if (publication.kind != marker::detection_result_kind) return false;
  marker::clear(result.found);
  if (publication.size > sizeof result ||
      publication.size < sizeof result - sizeof result.found.markers) {
    return false;
  }
  std::memcpy(&result, publication.data, publication.size);
  return result.found.count <= marker::max_detections &&
         publication.size == marker::published_bytes(result);
}

}  // namespace

ImprovedDesign::ImprovedDesign(sc_core::sc_module_name name, PlPorts& ports,
                               const pl::Geometry& usual)
    : ImprovedLogic(name, ports.fclk_clk(0), ports.fidelity, usual), ports_(ports) {
  ports.m_axi_gp0(axi_interconnect);
  ports.s_axi_hp0(axi_mem_interconnect);
  ports.irq_f2p(concat.dout);
  proc_sys_reset.ext_reset_in(ports.fclk_reset0_n());
  camera.frame_ena.attach(*this);
  blob_labelling.blob_out.attach(*this);
  logic_rst().attach(*this);
}

facts::Work ImprovedDesign::work() const {
  return marker_work();
}

facts::InputNeed ImprovedDesign::input() const {
  constexpr bool corrects_lens = true;
  return input::image_need(
      {static_cast<int>(geometry().width), static_cast<int>(geometry().height)}, corrects_lens);
}

void ImprovedDesign::describe(const facts::UnitInput& input, hal_frame& frame) const {
  input::describe_camera(input, frame);
}

void ImprovedDesign::on_change(vp::SignalBase& signal, std::uint32_t) {
  if (&signal == &logic_rst()) {
    // Which the reset is about to clear.
    settle();
    note_dropped();
    counted_ = {counted_[0], 0, 0, 0};
    return;
  }
  if (&signal == &blob_labelling.blob_out) {
    if (signal.bits() != 0) note_blob();
    return;
  }
  note_frame();
}

void ImprovedDesign::note_frame() {
  const std::uint32_t number = camera.frame_number;
  Sent& frame = slot(number);
  if (camera.frame_ena) {
    frame = {number, camera.mid_exposure_ps()};
  } else {
    frame.end_ps = ports_.scheduler.now_ps();
  }
}

// A frame's blobs all come before the camera may take the next one.
void ImprovedDesign::note_blob() {
  const auto point = [this](blob_stream::Extreme extreme) {
    return blob_labelling.extreme[extreme].written();
  };
  marker::BoundingBox box{};
  box.sx = static_cast<std::uint16_t>(blob_stream::x(point(blob_stream::least_x)));
  box.sy = static_cast<std::uint16_t>(blob_stream::y(point(blob_stream::least_y)));
  box.ex = static_cast<std::uint16_t>(blob_stream::x(point(blob_stream::greatest_x)));
  box.ey = static_cast<std::uint16_t>(blob_stream::y(point(blob_stream::greatest_y)));
  slot(camera.frame_number).blobs.push_back(box);
}

bool ImprovedDesign::report(const Publication& publication, facts::UnitReport& frame) {
  if (!read(publication, result_)) return false;
  fill_in(frame, publication.ps);
  add_times(frame, publication.ps);
  add_counts(frame);
  return true;
}

void ImprovedDesign::fill_in(facts::UnitReport& frame, std::uint64_t now_ps) const {
  frame.index = result_.frame;
  MarkerFrame& found = marker_frame(frame);
  if (has_frame_threshold()) found.threshold = result_.threshold;
  if (result_.status != marker::DetectionStatus::ok) {
    frame.gave_up = marker::status_name(result_.status);
    frame.warnings.push_back("the software gave up: " + frame.gave_up);
  }
  const double side_m = option("marker_side").value_or(marker_side_m);
  for (std::uint32_t i = 0; i < result_.found.count; ++i)
    found.markers.push_back(found_marker(result_.found.markers[i], side_m));
  const marker::ResponseUse& response = result_.found.response;
  if (response.is_said) {
    found.response = {marker::response_name(response.origin), response.exponent};
  }
  const marker::BoardPoses& board = result_.found.board;
  if (board.valid) {
    found.board = {result_.found.board_markers, pose_of(board.best), board.best.covariance,
                   motion_of(result_.found.board_motion)};
  }
  frame.end_ps = now_ps;
}

void ImprovedDesign::add_times(facts::UnitReport& frame, std::uint64_t now_ps) {
  // Stamps count pairs of CPU cycles.
  const vp::Clock& cpu = ports_.ps.cpu_clk.clk;
  const auto duration = [&cpu](std::uint64_t counts) {
    return cpu.duration_ps(2.0 * static_cast<double>(counts));
  };
  const marker::DetectionTimes& t = result_.times;
  frame.start_ps = now_ps - std::min(now_ps, duration(t.frame.end - t.frame.start));
  const auto stage = [&](const char* name, const marker::StageTime& time, const char* part_of) {
    facts::StageTime shown;
    shown.name = name;
    shown.ps = duration(time.end - time.start);
    shown.start_ps = frame.start_ps + duration(time.start - t.frame.start);
    shown.part_of = part_of;
    return shown;
  };
  const facts::StageTime whole = stage("frame", t.frame, "");
  if (!frame.delivered()) {
    frame.times = {stage("capture", t.capture, "frame"), whole};
    return;
  }
  facts::StageTime detection = stage("detection", t.detection, "frame");
  facts::StageTime pose = stage("pose", t.pose, "frame");
  detection.levers = pose.levers = software_levers();
  frame.times = {detection, pose, whole};
  Sent& sent = slot(result_.camera_frame);
  if (sent.number != result_.camera_frame || sent.end_ps < frame.start_ps) return;
  const auto between = [](const char* name, std::uint64_t from_ps, std::uint64_t to_ps,
                          const char* part_of) {
    facts::StageTime shown;
    shown.name = name;
    shown.ps = to_ps - std::min(from_ps, to_ps);
    shown.start_ps = from_ps;
    shown.part_of = part_of;
    return shown;
  };
  facts::StageTime capture = between("capture", frame.start_ps, sent.end_ps, "frame");
  explain_capture(capture);
  facts::StageTime wait = between("wait", sent.end_ps, detection.start_ps, "frame");
  wait.why =
      "the last blobs and their DMA, the trigger of the next frame, and what the software still "
      "had to do for the one before";
  wait.waits = true;
  frame.times.insert(frame.times.begin(), {capture, wait});
  marker_frame(frame).taken_ps = sent.mid_exposure_ps;
  marker_frame(frame).features.blobs = std::move(sent.blobs);
  frame.times.push_back(between("last_pixel_to_result", sent.end_ps, now_ps, ""));
  frame.times.push_back(between("mid_exposure_to_result", sent.mid_exposure_ps, now_ps, ""));
}

// What it lasts, and what makes most of that shorter.
void ImprovedDesign::explain_capture(facts::StageTime& capture) {
  const vp::Clock& clock = camera_clk.own() ? camera_clk.clk() : ports_.fclk_clk(0);
  const std::uint32_t p = pixels_per_clock;
  capture.why = p == 1 ? std::string("one pixel a clock") : std::to_string(p) + " pixels a clock";
  if (camera.line_blanking != 0) capture.why += " and pl.camera.line_blanking";
  capture.why = camera.exposure == 0 ? capture.why + ", so it lasts as long as the image does"
                                     : "the exposure (pl.camera.exposure), then " + capture.why;
  const auto of_clocks = [&](std::uint64_t clocks) {
    return clock.duration_ps(static_cast<double>(clocks));
  };
  const auto half = [](const auto& parameter, const char* unit) {
    return std::string(parameter.name()) + "=" + std::to_string(parameter.get() / 2) + " " + unit;
  };
  const std::uint64_t pixels = of_clocks(geometry().clocks());
  const std::uint64_t lines = of_clocks(std::uint64_t{camera.line_blanking} * height);
  const std::uint64_t rest = of_clocks(camera.frame_blanking);
  const std::uint64_t most = std::max({pixels, lines, rest, camera.exposure.get()});
  if (most == camera.exposure) {
    capture.levers = {half(camera.exposure, "ps")};
    return;
  }
  capture.clock = camera_clk.own() ? camera_clk.name() : "ps.fclk_clk0";
  if (most == lines) capture.levers = {half(camera.line_blanking, "cycles")};
  if (most == rest) capture.levers = {half(camera.frame_blanking, "cycles")};
  if (most == pixels && p < most_pixels_per_clock)
    capture.levers = {std::string(pixels_per_clock.name()) + "=" + std::to_string(2 * p)};
}

void ImprovedDesign::note_option(const std::string& name, double value) {
  own_markers_.check(name, value);
  options_[name] = value;
}

std::optional<double> ImprovedDesign::option(const char* name) const {
  const auto found = options_.find(name);
  return found == options_.end() ? std::nullopt : std::optional(found->second);
}

bool ImprovedDesign::has_option(const char* name) const {
  return option(name).value_or(0) >= 0.5;
}

// A second core has nothing to do where only one blob is worth a look.
std::vector<std::string> ImprovedDesign::software_levers() const {
  std::vector<std::string> levers;
  if (has_option("unoptimised")) levers.emplace_back("sw.opt=O2");
  const auto& refused = result_.found.blobs.refused;
  const auto with_cells = [&](marker::Refusal why) {
    return refused[static_cast<std::size_t>(why)];
  };
  const std::uint32_t looked_at = result_.found.count + with_cells(marker::Refusal::plain) +
                                  with_cells(marker::Refusal::border) +
                                  with_cells(marker::Refusal::unknown);
  if (looked_at > 1 && !has_option("second_core")) levers.emplace_back("sw.second_core=1");
  return levers;
}

namespace {

/// As the program reads them: sw/apps/improved/options.cpp.
marker::Board board_of(const std::map<std::string, double>& options) {
  const auto value = [&](const char* name) {
    const auto found = options.find(name);
    return found == options.end() ? 0 : found->second;
  };
  const auto whole = [&](const char* name) { return static_cast<std::uint32_t>(value(name)); };
  marker::Board board;
  board.kind = static_cast<marker::Board::Kind>(whole("board"));
  board.marker_side = value("marker_side");
  board.grid = {whole("board_columns"), whole("board_rows"), board.marker_side, value("board_gap"),
                whole("board_first_id")};
  board.charuco = {whole("board_columns"), whole("board_rows"), value("board_square"),
                   board.marker_side, value("board_white_first") >= 0.5};
  return board;
}

std::string board_text(const BoardFit& fit, const std::vector<std::string>& layouts) {
  const std::string off =
      fmt::format("its corners are {:.1f} px ({:.0f} % of a side) from where it has them",
                  fit.residual_px, 100 * fit.share);
  std::string text = "the board does not fit its markers: " + off;
  if (fit.is_good()) {
    text = fit.strangers > 0 ? "markers beside the board: " + std::to_string(fit.strangers)
                             : "the board fits badly: " + off;
  }
  return layouts.empty() ? text + "; no other columns, squares or gaps explain them"
                         : text + "; what fits all: " + vp::join(layouts, ", or ");
}

}  // namespace

// A threshold of each pixel's own knows no frame before. Where the logic takes a frame while the
// software works on the one before, its period depends on that work, too: the second showing makes
// it the image's own, as in a steady stream.
std::uint32_t ImprovedDesign::settling_showings() const {
  if (!has_frame_threshold()) return 0;
  return has_option("overlap") ? 2 : 1;
}

void ImprovedDesign::check(facts::UnitReport& frame) {
  take_truth(frame);
  judge(frame);
  MarkerFrame& found = marker_frame(frame);
  for (std::size_t i = 0; i < found.markers.size(); ++i) {
    FoundMarker& marker = found.markers[i];
    if (const auto* own = own_markers_.dictionary()) marker.code_cells = own->cells * own->cells;
    if (marker.has_pose)
      marker.reprojection_px =
          reprojection_px(found.camera, marker.pose, marker.side_m, ideal_corners(i));
  }
  warn_of_vague_markers(frame);
  check_board(frame);
}

void ImprovedDesign::warn_of_vague_markers(facts::UnitReport& frame) const {
  const auto which = static_cast<std::size_t>(option("dictionary").value_or(0));
  if (which >= marker::dictionaries.size()) return;
  const marker::Dictionary* const own = own_markers_.dictionary();
  const marker::Dictionary& dictionary = own ? *own : marker::dictionaries[which];
  for (const FoundMarker& found : marker_frame(frame).markers) {
    const auto id = static_cast<std::uint32_t>(found.id);
    if (id < dictionary.size && marker::equals_itself_turned(dictionary, id))
      frame.warnings.push_back(fmt::format(
          "marker {} of {} looks the same when it is turned by half: its rotation is a guess", id,
          dictionary.name));
  }
}

std::array<PixelPoint, 4> ImprovedDesign::ideal_corners(std::size_t index) const {
  const marker::Quad& corners = result_.found.markers[index].marker.fit.ideal;
  std::array<PixelPoint, 4> px;
  for (std::size_t i = 0; i < px.size(); ++i) px[i] = {corners[i].x, corners[i].y};
  return px;
}

void ImprovedDesign::check_board(facts::UnitReport& frame) {
  const marker::Board board = board_of(options_);
  if (board.kind == marker::Board::Kind::none) return;
  MarkerFrame& found = marker_frame(frame);
  std::vector<BoardMarker> markers;
  for (std::uint32_t i = 0; i < result_.found.count; ++i) {
    BoardMarker& seen = markers.emplace_back();
    seen.id = result_.found.markers[i].marker.id;
    seen.ideal_px = ideal_corners(i);
  }
  std::string doubles = text_of_doubles(board, markers);
  if (!doubles.empty()) frame.warnings.push_back(std::move(doubles));
  if (!found.board) return;
  const BoardFit fit = platform::check_board(board, found.camera, found.board->pose, markers);
  for (std::size_t i = 0; i < markers.size(); ++i)
    found.markers[i].residual_px = markers[i].residual_px;
  found.board->residual_px = fit.residual_px;
  if (!fit.is_odd() && fit.strangers == 0) return;
  const std::vector<std::string> layouts = fitting_layouts(board, markers);
  const bool explains_strangers = fit.strangers > 0 && !layouts.empty();
  if (!fit.is_odd() && !explains_strangers) return;
  frame.warnings.push_back(board_text(fit, layouts));
  // A single marker fits any place.
  if (fit.is_good() && !(explains_strangers && found.board->markers == 1)) return;
  found.board->misfit = frame.warnings.back();
  found.board->layouts = layouts;
}

ImprovedDesign::Dropped ImprovedDesign::counters() const {
  return {camera.dropped_triggers, pixel_stream.dropped_frames, pixel_stream.cut_frames,
          blob_stream.dropped_frames};
}

void ImprovedDesign::note_dropped() {
  const Dropped now = counters();
  for (std::size_t i = 0; i < now.size(); ++i)
    dropped_[i] += now[i] < counted_[i] ? now[i] : now[i] - counted_[i];
  counted_ = now;
}

namespace {

/// More than one pixel a clock brings another FIFO.
std::string lost_in_logic_warning(std::uint32_t pixels_per_clock) {
  return std::string("blobs dropped or dark pixels without label: pl.blob_labelling.label_count") +
         (pixels_per_clock == 1 ? "" : ", pl.blob_labelling.run_fifo_depth") +
         " or pl.blob_stream.fifo_depth is too small";
}

}  // namespace

void ImprovedDesign::add_counts(facts::UnitReport& frame) {
  const marker::Detections& found = result_.found;
  frame.counts.set("blobs", found.blobs.received);
  frame.counts.set("markers", found.count);
  note_dropped();
  const Dropped dropped = std::exchange(dropped_, {});
  const auto lose = [&frame](const char* name, std::uint64_t count, const std::string& warning) {
    frame.counts.lose(name, count);
    if (count != 0) frame.warnings.push_back(std::to_string(count) + " " + warning);
  };
  lose("lost_in_logic", result_.lost_in_logic, lost_in_logic_warning(pixels_per_clock));
  lose("lost_markers", found.blobs.lost, "markers without room in the software");
  lose("malformed", found.blobs.malformed, "blobs that cannot be: outside of the picture");
  lose("dropped_triggers", dropped[0], "triggers dropped: a frame was under way");
  lose("dropped_pictures", dropped[1], "pictures dropped: DMA 0 was not armed in time");
  lose("cut_pictures", dropped[2],
       "pictures cut: DMA 0 did not keep up, pl.pixel_stream.fifo_depth is too small");
  lose("dropped_packets", dropped[3], "packets of blobs dropped: DMA 1 was not armed in time");
}

std::vector<Design::ClockRole> ImprovedDesign::clock_roles() {
  if (!camera_clk.own()) return {{"pixel", &ports_.fclk_clk(0), "feature_extraction"}};
  return {{"pixel", &camera_clk.clk(), "feature_extraction"},
          {"system", &ports_.fclk_clk(0), "data_bridge"}};
}

TimelineEngines ImprovedDesign::timeline() {
  constexpr bool active_low = true, critical = true;
  TimelineEngines shown;
  shown.engines = {{"Camera", &camera.frame_ena, !active_low, critical},
                   {"Blob labelling", &blob_labelling.idle, active_low},
                   {"Blob stream", &blob_stream.busy, !active_low, critical}};
  shown.channels = {
      {"DMA 0, pixels out", &axi_dma_0.s2mm(), "IRQ of DMA 0", &axi_dma_0.s2mm_introut},
      {"DMA 1, blobs out", &axi_dma_1.s2mm(), "IRQ of DMA 1", &axi_dma_1.s2mm_introut}};
  shown.levels = {
      {"Blob FIFO", "words", static_cast<double>(blob_stream.fifo_depth), &blob_stream.fifo_count}};
  shown.waiting = "capture";
  return shown;
}

const DesignInfo& improved_design() {
  static const DesignInfo info{
      "improved",
      "all markers between pixels: blobs and pictures by DMA, one frame ahead of the "
      "software",
      {"improved"},
      true,
      improved_words,
      [](const char* name, PlPorts& ports) -> std::unique_ptr<Design> {
        return std::make_unique<ImprovedDesign>(name, ports,
                                                ImprovedDesign::usual_geometry(640, 480));
      },
      {}};
  return info;
}

// The same logic and program for other ends: other sizes and settings.
const DesignInfo& hd_design() {
  static const DesignInfo info{"hd",
                               "the improved design for frames of 1280x720",
                               {"improved"},
                               true,
                               improved_words,
                               [](const char* name, PlPorts& ports) -> std::unique_ptr<Design> {
                                 return std::make_unique<ImprovedDesign>(
                                     name, ports, ImprovedDesign::usual_geometry(1280, 720));
                               },
                               {{"ps.fclk_clk0.frequency", "111.111111 MHz"}}};
  return info;
}

// What `markervp explore sixty-fps` finds.
const DesignInfo& eco_design() {
  static const DesignInfo info{"eco",
                               "the improved design with the least energy at 60 images a second",
                               {"improved"},
                               true,
                               improved_words,
                               improved_design().make,
                               {{"camera.rate", "60 fps"},
                                {"ps.fclk_clk0.frequency", "25 MHz"},
                                {"ps.cpu_clk.frequency", "333.333333 MHz"},
                                {"power.ddr.width", "16"},
                                {"power.ddr.frequency", "400 MHz"},
                                {"power.ddr.voltage", "1.35 V"}}};
  return info;
}

// What dim or uneven light leaves, and what something touches or covers in part.
const DesignInfo& careful_design() {
  static const DesignInfo info{
      "careful",
      "the improved design for dim or uneven light, and for what is touched or hidden",
      {"improved"},
      true,
      improved_words,
      improved_design().make,
      {{"pl.threshold_rule", "local"}, {"sw.tries", "outlines"}, {"sw.second_core", "1"}}};
  return info;
}

}  // namespace platform
