#include <report/console.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <report/error_measure.h>
#include <report/verdict.h>
#include <report/words.h>
#include <vp/text.h>
#include <vp/unit.h>

namespace platform::report {

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

std::string pose_text(const FoundMarker& found) {
  const auto metres = [&](std::size_t axis) {
    return vp::format_fixed(found.pose.translation[axis], 3);
  };
  return fmt::format("t ({}, {}, {}) m   {}   {} to {:.2f} px", metres(0), metres(1), metres(2),
                     angles_text(found.pose.rotation), counted(found.iterations, "iteration"),
                     found.reprojection_px);
}

std::string marker_text(const FrameReport& frame, const FoundMarker& found) {
  std::string text = line("corners px", corners_text(found.corners_px));
  text += line("pose", found.has_pose ? pose_text(found) : "none: the corners admit no pose");
  if (const GroundTruth* truth = truth_of(frame, found)) {
    text += line("error", error_text(found, *truth));
  } else if (frame.truth) {
    text += line("error", fmt::format("another marker: the scene has {}", frame.truth->marker_id));
  }
  return text;
}

std::string counts_text(const FrameReport& frame) {
  const Counts& counts = frame.counts;
  return fmt::format("{}   {}   {}   {}   threshold {}", counted(counts.corners, "corner"),
                     counted(counts.blobs, "blob"), counted(counts.candidates, "candidate"),
                     counted(counts.feature_words, "word"), frame.threshold);
}

/// Stage names over their times; as many lines as the width demands.
std::string times_text(const std::vector<StageTime>& times) {
  std::string text;
  std::string names;
  std::string values;
  const auto flush = [&] {
    if (!names.empty()) text += line("stage", names) + line("us", values);
    names.clear();
    values.clear();
  };
  for (const StageTime& time : times) {
    const std::string value = fmt::format("{:.1f}", static_cast<double>(time.ps) / ps_per_us);
    const std::size_t width = std::max(time.name.size(), value.size()) + (names.empty() ? 0 : 2);
    if (label_width + names.size() + width > console_width) flush();
    names += fmt::format("{:>{}}", time.name, width);
    values += fmt::format("{:>{}}", value, width);
  }
  flush();
  return text;
}

std::string heading(const FrameReport& frame, std::optional<std::uint64_t> total) {
  const std::string number = fmt::format("{}", frame.index + 1);
  std::string text =
      total ? fmt::format("[{:>{}}/{}]", number, fmt::formatted_size("{}", *total), *total)
            : fmt::format("[{}]", number);
  text += " " + frame.input + ": ";
  if (!frame.delivered()) return text + "no result, the software gave up: " + frame.gave_up + "\n";
  if (frame.markers.empty()) return text + "no marker\n";
  std::vector<std::string> markers;
  for (const FoundMarker& found : frame.markers) {
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
std::string stage_lines(const Summary& summary, const std::string& of, int depth, double whole) {
  std::string text;
  for (const Summary::Stage& stage : summary.stages()) {
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

std::string stage_table(const Summary& summary) {
  return fmt::format("{:<22}{:>12}{:>12}{:>12}   share of frame\n", "stage", "mean us", "min us",
                     "max us") +
         stage_lines(summary, "", 0, 0);
}

std::string fps_text(const Summary& summary) {
  if (summary.delivered() == 0) return "no result: there is no frame rate and no latency\n";
  const Statistic& fps = summary.fps();
  const Statistic& latency = summary.latency_us();
  return fmt::format(
      "FPS      mean {:.1f}   min {:.1f}   max {:.1f}   (image upload excluded)\n"
      "latency  mean {:.3f} ms   max {:.3f} ms\n",
      summary.mean_fps(), fps.min(), fps.max(), latency.mean() / us_per_ms,
      latency.max() / us_per_ms);
}

std::string mean_error_text(const Summary& summary) {
  const std::string over = counted(summary.corner_px().count(), "marker");
  return fmt::format(
      "error    corner {:.2f} px   translation {:.1f} mm   rotation {:.2f} deg   "
      "(mean over {})\n",
      summary.corner_px().mean(), summary.translation_mm().mean(), summary.rotation_deg().mean(),
      over);
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

std::string end_text(const RunFacts& facts) {
  if (!facts.end) return "no frames: the program was stopped";
  return fmt::format("no frames: the program ended at {} with exit code {}",
                     vp::format_time(facts.end->ps), facts.end->exit_code);
}

}  // namespace

std::string frame_text(const FrameReport& frame, std::optional<std::uint64_t> total) {
  std::string text = heading(frame, total);
  for (const FoundMarker& found : frame.markers) text += marker_text(frame, found);
  text += line("counts", counts_text(frame));
  for (const std::string& warning : frame.warnings) text += line("warning", warning);
  return text + times_text(frame.times);
}

std::string summary_text(const Summary& summary, const RunFacts& facts) {
  const std::string point = fmt::format("   ({}, design {}, {}, profile {})\n", facts.system,
                                        facts.design, facts.fidelity, facts.profile);
  if (summary.frames() == 0) return end_text(facts) + point;
  std::string text =
      fmt::format("{}, {} with a marker", counted(summary.frames(), "frame"), summary.detected());
  if (summary.mistaken() > 0) text += fmt::format(", {} of them a wrong one", summary.mistaken());
  if (const std::uint64_t without = summary.frames() - summary.delivered()) {
    text += fmt::format(", {} without a result", without);
  }
  text += point;
  text += fps_text(summary);
  if (summary.corner_px().count() > 0) text += mean_error_text(summary);
  text += verdict_text(verdict_of(facts, summary));
  if (facts.power && facts.resources && facts.timing) {
    text += design_text(*facts.power, *facts.resources, *facts.timing);
  }
  if (facts.clocks) text += clock_text(*facts.clocks);
  if (summary.warned() > 0) {
    text +=
        fmt::format("warnings in {}, listed in result.json\n", counted(summary.warned(), "frame"));
  }
  if (!summary.stages().empty()) text += "\n" + stage_table(summary);
  return text;
}

}  // namespace platform::report
