#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include <facts/summary.h>
#include <result/console.h>
#include <result/verdict.h>
#include <vp/text.h>
#include <vp/unit.h>

namespace platform::result {

namespace {

constexpr double degrees_per_radian = 57.29577951308232;

std::string degrees(double radians) {
  return vp::format_fixed(radians * degrees_per_radian, 1);
}

/// With so many places; with two more if fewer than two digits were left of it.
std::string error_figure(double value, int places) {
  const bool little = value > 0 && value * std::pow(10, places) < 10;
  return vp::format_fixed(value, little ? places + 2 : places);
}

std::string pose_error_text(double translation_mm, double rotation_deg) {
  return "   translation " + error_figure(translation_mm, 1) + " mm   rotation " +
         error_figure(rotation_deg, 2) + " deg";
}

}  // namespace

std::string counted(std::uint64_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string counts_text(const facts::FrameReport& frame) {
  std::string text;
  for (const facts::Counts::Count& count : frame.counts.list()) {
    if (count.lost) continue;
    std::string noun = count.name.substr(0, count.name.find_last_not_of('s') + 1);
    std::replace(noun.begin(), noun.end(), '_', ' ');
    text += counted(count.value, noun) + "   ";
  }
  return text + "threshold " + std::to_string(frame.threshold);
}

std::string angles_text(const Eigen::Matrix3d& r) {
  return "pitch " + degrees(std::atan2(r(2, 1), r(2, 2))) + " yaw " +
         degrees(std::asin(std::clamp(-r(2, 0), -1.0, 1.0))) + " roll " +
         degrees(std::atan2(r(1, 0), r(0, 0))) + " deg";
}

std::string error_text(const facts::FoundMarker& found, const GroundTruth& truth) {
  const facts::MarkerError error = facts::measure_error(found, truth);
  std::string text = "corner " + error_figure(error.corner_px, 2) + " px";
  if (!facts::has_pose_error(found, truth)) return text;
  return text + pose_error_text(error.translation_mm, error.rotation_deg);
}

namespace {

constexpr double us_per_ms = 1e3;
constexpr const char* label_format = "  {:<11}{}\n";
constexpr std::size_t label_width = 13;
constexpr int bar_width = 30;

std::string line(const char* label, const std::string& text) {
  return fmt::format(label_format, label, text);
}

std::string orientation(int quarter_turns) {
  if (quarter_turns == 0) return "upright";
  return fmt::format("turned {} deg clockwise", 90 * quarter_turns);
}

std::string corners_text(const std::array<PixelPoint, 4>& corners) {
  std::string text;
  for (const PixelPoint& corner : corners) {
    text += fmt::format("{}({:.2f}, {:.2f})", text.empty() ? "" : "  ", corner.x, corner.y);
  }
  return text;
}

std::string pose_text(const Pose& pose) {
  const auto metres = [&](std::size_t axis) { return vp::format_fixed(pose.translation[axis], 3); };
  return fmt::format("t ({}, {}, {}) m   {}", metres(0), metres(1), metres(2),
                     angles_text(pose.rotation));
}

std::string fit_text(const facts::FoundMarker& found) {
  std::string text;
  if (found.iterations) text += "   " + counted(*found.iterations, "iteration");
  if (found.reprojection_px) text += fmt::format(" to {:.2f} px", *found.reprojection_px);
  return text;
}

std::string marker_text(const facts::FrameReport& frame, const facts::FoundMarker& found) {
  std::string text = line("corners px", corners_text(found.corners_px));
  if (found.residual_px) {
    text += line("on board", fmt::format("{:.2f} px from its place", *found.residual_px));
  } else if (!frame.board || found.has_pose) {
    text += line("pose", found.has_pose ? pose_text(found.pose) + fit_text(found)
                                        : "none: the corners admit no pose");
  }
  if (const GroundTruth* truth = facts::truth_of(frame, found)) {
    text += line("error", error_text(found, *truth));
  } else if (frame.truth) {
    text += line("error", facts::another_marker_text(frame));
  }
  return text;
}

std::string board_text(const facts::FoundBoard& board) {
  if (!board.misfit.empty()) return line("board", "refused: " + board.misfit);
  std::string text = counted(board.markers, "marker") + "   " + pose_text(board.pose);
  if (board.residual_px) text += fmt::format("   {:.2f} px from their places", *board.residual_px);
  return line("board", text);
}

/// Stage names over their times; as many lines as the width demands.
std::string times_text(const std::vector<facts::StageTime>& times) {
  std::string text;
  std::string names;
  std::string values;
  const auto flush = [&] {
    if (!names.empty()) text += line("stage", names) + line("us", values);
    names.clear();
    values.clear();
  };
  for (const facts::StageTime& time : times) {
    const std::string value =
        fmt::format("{:.1f}", static_cast<double>(time.ps) / facts::ps_per_us);
    const std::size_t width = std::max(time.name.size(), value.size()) + (names.empty() ? 0 : 2);
    if (label_width + names.size() + width > console_width) flush();
    names += fmt::format("{:>{}}", time.name, width);
    values += fmt::format("{:>{}}", value, width);
  }
  flush();
  return text;
}

std::string heading(const facts::FrameReport& frame, std::optional<std::uint64_t> total) {
  const std::string number = fmt::format("{}", frame.index + 1);
  std::string text =
      total ? fmt::format("[{:>{}}/{}]", number, fmt::formatted_size("{}", *total), *total)
            : fmt::format("[{}]", number);
  text += " " + frame.input + ": ";
  if (!frame.delivered()) return text + "no result, the software gave up: " + frame.gave_up + "\n";
  if (frame.markers.empty()) return text + "no marker\n";
  std::vector<std::string> markers;
  for (const facts::FoundMarker& found : frame.markers) {
    markers.push_back(fmt::format("marker {}, {}", found.id, orientation(found.rotation)));
  }
  return fmt::format("{}{}\n", text, fmt::join(markers, "; "));
}

/// How much of `whole` a stage takes, with a bar.
std::string share_text(double us, double whole) {
  const double share = us / whole;
  const int length = std::clamp(static_cast<int>(std::lround(share * bar_width)), 0, bar_width);
  const std::string bar(static_cast<std::size_t>(length), '#');
  return fmt::format("  {:>5.1f} %{}{}", 100 * share, bar.empty() ? "" : " ", bar);
}

/// The parts of stage `of`, each with its own parts below it, indented. `whole`: the time of which
/// a part of something takes a share.
std::string stage_lines(const facts::Summary& summary, const std::string& of, int depth,
                        double whole) {
  std::string text;
  for (const facts::Summary::Stage& stage : summary.stages()) {
    if (stage.part_of != of) continue;
    const double us = stage.us.mean();
    text += fmt::format("{:<22}{:>12.1f}{:>12.1f}{:>12.1f}",
                        std::string(static_cast<std::size_t>(2 * depth), ' ') + stage.name, us,
                        stage.us.min(), stage.us.max());
    if (depth > 0 && whole > 0) text += share_text(us, whole);
    text += "\n" + stage_lines(summary, stage.name, depth + 1, depth > 0 ? whole : us);
  }
  return text;
}

std::string stage_table(const facts::Summary& summary) {
  return fmt::format("{:<22}{:>12}{:>12}{:>12}   share of frame\n", "stage", "mean us", "min us",
                     "max us") +
         stage_lines(summary, "", 0, 0);
}

/// The camera whose images the results are of, and how much time there was between them.
std::string camera_text(const facts::CameraReport& camera) {
  constexpr double ps_per_ms = 1e9;
  return fmt::format(
      "camera   {:.6g} fps: {} of {} dropped   busy {:.1f} %   slack {:.3f} ms, least {:.3f} ms\n",
      camera.rate_fps, camera.dropped, counted(camera.offered, "frame"),
      camera.utilisation_percent(), (camera.period_ps() - camera.busy_ps) / ps_per_ms,
      (camera.period_ps() - camera.most_busy_ps) / ps_per_ms);
}

std::string fps_text(const facts::Summary& summary, bool has_camera) {
  if (summary.delivered() == 0) return "no result: there is no frame rate and no latency\n";
  const facts::Statistic& fps = summary.fps();
  const facts::Statistic& latency = summary.latency_us();
  return fmt::format(
      "FPS      mean {:.1f}   min {:.1f}   max {:.1f}   ({})\n"
      "latency  mean {:.3f} ms   max {:.3f} ms\n",
      summary.mean_fps(), fps.min(), fps.max(), has_camera ? "delivered" : "image upload excluded",
      latency.mean() / us_per_ms, latency.max() / us_per_ms);
}

/// What sets the rate, and below it what raises the rate.
std::string limit_text(const facts::Limit& limit) {
  const std::string levers = limit.levers_text();
  return "limit    " + limit.text() + "\n" +
         (levers.empty() ? "" : "         faster with " + levers + "\n");
}

std::string mean_error_text(const facts::Summary& summary) {
  return "error    corner " + error_figure(summary.corner_px().mean(), 2) + " px" +
         pose_error_text(summary.translation_mm().mean(), summary.rotation_deg().mean()) +
         "   (mean over " + counted(summary.corner_px().count(), "marker") + ")\n";
}

std::string verdict_text(const Verdict& verdict) {
  if (verdict.feasible() != Holds::yes) {
    return fmt::format("verdict  {}: {}\n",
                       verdict.feasible() == Holds::no ? "INFEASIBLE" : "unknown",
                       fmt::join(verdict.reasons(), "\n         "));
  }
  std::string margins;
  for (const Verdict::Part& part : verdict.parts) {
    if (part.by.empty()) continue;
    margins += fmt::format("{}{} {:.0f} % ({})", margins.empty() ? "   to spare: " : ", ",
                           part.name, *part.margin_percent, part.by);
  }
  return "verdict  feasible" + margins + "\n";
}

std::string end_text(const facts::RunFacts& facts) {
  if (!facts.end) return "no frames: the program was stopped";
  if (facts.end->reached_limit) {
    return fmt::format(
        "no frames: the program reached its time limit, {}, in an endless loop (ps.cpu.timeout)",
        vp::format_time(facts.end->ps));
  }
  return fmt::format("no frames: the program ended at {} with exit code {}",
                     vp::format_time(facts.end->ps), facts.end->exit_code);
}

}  // namespace

std::string frame_text(const facts::FrameReport& frame, std::optional<std::uint64_t> total) {
  std::string text = heading(frame, total);
  for (const facts::FoundMarker& found : frame.markers) text += marker_text(frame, found);
  if (frame.board) text += board_text(*frame.board);
  text += line("counts", counts_text(frame));
  for (const std::string& warning : frame.warnings) text += line("warning", warning);
  return text + times_text(frame.times);
}

std::string summary_text(const facts::Summary& summary, const facts::RunFacts& facts) {
  const std::string point = fmt::format("   ({}, design {}, {}, profile {})\n", facts.system,
                                        facts.design, facts.fidelity, facts.profile);
  if (summary.frames() == 0) return end_text(facts) + point;
  std::string text =
      fmt::format("{}, {} with a marker", counted(summary.frames(), "frame"), summary.detected());
  if (summary.mistaken() > 0) text += fmt::format(", {} of them a wrong one", summary.mistaken());
  if (const std::uint64_t without = summary.frames() - summary.delivered()) {
    text += fmt::format(", {} without a result", without);
  }
  if (facts.unpublished > 0) text += fmt::format(", {} never published", facts.unpublished);
  text += point;
  text += fps_text(summary, facts.camera.has_value());
  if (facts.camera) text += camera_text(*facts.camera);
  if (const std::optional<facts::Limit> limit = summary.limit()) text += limit_text(*limit);
  if (summary.corner_px().count() > 0) text += mean_error_text(summary);
  text += verdict_text(verdict_of(facts, summary));
  if (facts.resources && facts.timing && (facts.power || !facts.resources->unknown.empty())) {
    text += design_text(facts.power, *facts.resources, *facts.timing);
  }
  if (facts.clocks) text += clock_text(*facts.clocks);
  if (summary.settled() > 0) {
    text += fmt::format(
        "settled  the images of {} were shown before, so that each has a threshold of its own; "
        "that is in no time or energy\n",
        counted(summary.settled(), "frame"));
  }
  for (const std::string& note : facts.notes) text += "note     " + note + "\n";
  if (summary.warned() > 0) {
    text +=
        fmt::format("warnings in {}, listed in result.json\n", counted(summary.warned(), "frame"));
  }
  if (!summary.stages().empty()) text += "\n" + stage_table(summary);
  return text;
}

namespace {

/// Highest junction temperature of a device of the commercial range (DS187).
constexpr double commercial_limit_c = 85;

std::string mhz(double value) {
  std::string text = vp::format_fixed(value, 3);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text + " MHz";
}

std::string power_line(const std::optional<facts::PowerReport>& known,
                       const facts::ResourceReport& resources) {
  if (!known)
    return "power    unknown, as the figures of " + vp::join(resources.unknown, ", ") + " are\n";
  const facts::PowerReport& power = *known;
  std::string text =
      fmt::format("power    {:.2f} W ({:.2f} to {:.2f})", power.total_w, power.low_w, power.high_w);
  if (power.per_frame) text += fmt::format("   {:.1f} mJ per frame", power.energy_per_frame_mj);
  return text + fmt::format("   junction {:.0f} C   ({})\n", power.junction_c, power.mode);
}

std::string timing_line(const facts::TimingReport& timing) {
  if (timing.modules.empty()) return "";
  const facts::TimingReport::Module& critical = critical_module(timing);
  if (timing.met) {
    const std::string perhaps =
        critical.fmax_high_mhz > critical.fmax_mhz
            ? fmt::format(", perhaps {:.0f} %", critical.most_margin_percent())
            : "";
    return fmt::format("timing   met, {:.0f} % to spare ({}{})\n", critical.margin_percent,
                       critical.name, perhaps);
  }
  const bool unknown = critical.unknown();
  const auto alike =
      std::count_if(timing.modules.begin(), timing.modules.end(),
                    [&](const auto& m) { return unknown ? m.unknown() : m.missed(); });
  const std::string others = alike > 1 ? fmt::format(" and {} more", alike - 1) : "";
  if (!critical.known)
    return fmt::format("timing   unknown: no Fmax of {}{}\n", critical.name, others);
  const std::string reachable = critical.reachable_mhz > 0
                                    ? fmt::format("; the chip has {}", mhz(critical.reachable_mhz))
                                    : "";
  return fmt::format("timing   {} {}{}: {}, {} {}{}\n", unknown ? "unknown for" : "MISSED by",
                     critical.name, others, mhz(critical.frequency_mhz),
                     unknown ? "known to work up to" : "at most",
                     mhz(unknown ? critical.fmax_mhz : critical.fmax_high_mhz), reachable);
}

std::string resource_line(const facts::ResourceReport& resources) {
  if (resources.modules.empty()) return "";
  if (!resources.unknown.empty() && resources.over.empty()) {
    std::string text = "fits     unknown\n";
    for (const facts::ResourceReport::Module& module : resources.modules) {
      if (!module.known) text += fmt::format("         {}: {}\n", module.name, module.source);
    }
    return text;
  }
  std::string text = resources.over.empty() ? "fits     " : "TOO BIG  ";
  for (const facts::Primitive& p : facts::primitives) {
    text += fmt::format("{}{} {:.0f} of {:.0f}", &p == facts::primitives ? "" : "   ", p.text,
                        resources.total.*p.amount, resources.available.*p.amount);
  }
  return text + fmt::format("   ({})\n", resources.device);
}

}  // namespace

std::vector<std::string> timing_warnings(const facts::TimingReport& timing) {
  std::vector<std::string> warnings;
  // By clock and limit.
  std::map<std::pair<std::string, double>, std::vector<std::string>> unknown;
  for (const auto& module : timing.modules) {
    if (module.met) continue;
    if (!module.known) continue;  // the console's own lines say so
    if (module.unknown()) {
      unknown[{module.clock + " runs at " + mhz(module.frequency_mhz), module.fmax_mhz}].push_back(
          module.name);
      continue;
    }
    warnings.push_back(
        fmt::format("{} misses timing: {} runs at {}, and it reaches {} at most ({:.1f} % less): "
                    "such a chip cannot be built",
                    module.name, module.clock, mhz(module.frequency_mhz), mhz(module.fmax_high_mhz),
                    100 * (1 - module.fmax_high_mhz / module.frequency_mhz)));
  }
  for (const auto& [limit, modules] : unknown) {
    const std::string others =
        modules.size() > 1 ? fmt::format(" and {} more", modules.size() - 1) : "";
    warnings.push_back(fmt::format(
        "whether timing is met is not known: {}, and {}{} is known to work up to {} only",
        limit.first, modules.front(), others, mhz(limit.second)));
  }
  return warnings;
}

std::vector<std::string> resource_warnings(const facts::ResourceReport& resources) {
  std::vector<std::string> warnings;
  for (const facts::Primitive& p : facts::primitives) {
    if (resources.total.*p.amount <= resources.available.*p.amount) continue;
    warnings.push_back(fmt::format(
        "the design does not fit into the {}: it takes about {:.0f} {} "
        "of {:.0f}",
        resources.device, resources.total.*p.amount, p.text, resources.available.*p.amount));
  }
  return warnings;
}

std::vector<std::string> power_warnings(const facts::PowerReport& power) {
  if (power.junction_c <= commercial_limit_c) return {};
  return {
      fmt::format("the junction settles at {:.0f} C, above the {:.0f} C of a commercial device: "
                  "lower power.ambient, power.theta_ja (a heat sink) or the clocks",
                  power.junction_c, commercial_limit_c)};
}

std::vector<std::string> clock_warnings(const facts::ClockReport& report) {
  std::vector<std::string> warnings;
  for (const facts::ClockReport::Clock& clock : report.clocks) {
    if (clock.within || !clock.used) continue;
    warnings.push_back(fmt::format(
        "{} runs at {}, and an {} allows {} at most ({}, {:.1f} % less): such a chip is not sold{}",
        clock.name, mhz(clock.frequency_mhz), report.device, mhz(clock.limit_mhz),
        clock.limit_confidence, 100 * (1 - clock.limit_mhz / clock.frequency_mhz),
        clock.legal_mhz > 0 ? "; the nearest that its PLLs make is " + mhz(clock.legal_mhz) : ""));
  }
  return warnings;
}

std::string clock_text(const facts::ClockReport& report) {
  std::string text;
  for (const facts::ClockReport::Clock& clock : report.clocks) {
    if (!clock.used && !clock.within)
      text +=
          fmt::format("clock    {} runs at {}, above the {} of an {}: the design does not use it\n",
                      clock.name, mhz(clock.frequency_mhz), mhz(clock.limit_mhz), report.device);
    if (clock.is_made || !clock.used) continue;
    const bool made = report.mode == "made";
    std::string others;
    for (const double near : {clock.below_mhz, clock.above_mhz}) {
      if (near == 0 || (made && mhz(near) == mhz(clock.made_mhz))) continue;
      others += (others.empty() ? "" : " or ") + mhz(near);
    }
    text += made ? fmt::format("clock    {} is {}: no PLL gives {}{}\n", clock.name,
                               mhz(clock.made_mhz), mhz(clock.wish_mhz),
                               others.empty() ? "" : "; else " + others)
                 : fmt::format("clock    {} is {}, exactly; a chip makes {}\n", clock.name,
                               mhz(clock.wish_mhz), others);
  }
  return text;
}

std::string design_text(const std::optional<facts::PowerReport>& power,
                        const facts::ResourceReport& resources, const facts::TimingReport& timing) {
  return power_line(power, resources) + timing_line(timing) + resource_line(resources);
}

}  // namespace platform::result
