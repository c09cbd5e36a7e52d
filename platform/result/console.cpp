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

std::string counted(std::uint64_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string counts_text(const facts::UnitReport& frame) {
  std::string text;
  for (const facts::Counts::Count& count : frame.counts.list()) {
    if (count.lost) continue;
    std::string noun = count.name.substr(0, count.name.find_last_not_of('s') + 1);
    std::replace(noun.begin(), noun.end(), '_', ' ');
    text += counted(count.value, noun) + "   ";
  }
  if (frame.extra) text += frame.extra->counts_text();
  return text.substr(0, text.find_last_not_of(' ') + 1);
}

namespace {

constexpr double us_per_ms = 1e3;
constexpr const char* label_format = "  {:<11}{}\n";
constexpr std::size_t label_width = 13;
constexpr int bar_width = 30;

std::string line(const char* label, const std::string& text) {
  return fmt::format(label_format, label, text);
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

std::string heading(const facts::UnitReport& frame, std::optional<std::uint64_t> total) {
  const std::string number = fmt::format("{}", frame.index + 1);
  std::string text =
      total ? fmt::format("[{:>{}}/{}]", number, fmt::formatted_size("{}", *total), *total)
            : fmt::format("[{}]", number);
  text += (frame.input.empty() ? "" : " " + frame.input) + ": ";
  if (!frame.delivered()) return text + "no result, the software gave up: " + frame.gave_up + "\n";
  if (frame.extra) return text + frame.extra->heading() + "\n";
  return text + (frame.failures.empty() ? "done" : vp::join(frame.failures, ", ")) + "\n";
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

std::string stage_table(const facts::Summary& summary, const facts::Work& work) {
  return fmt::format("{:<22}{:>12}{:>12}{:>12}   share of {}\n", "stage", "mean us", "min us",
                     "max us", work.unit) +
         stage_lines(summary, "", 0, 0);
}

/// The rate at which inputs came, and how much time there was between them.
std::string camera_text(const facts::CameraReport& camera, const facts::Work& work) {
  constexpr double ps_per_ms = 1e9;
  return fmt::format(
      "camera   {:.6g} fps: {} of {} dropped   busy {:.1f} %   slack {:.3f} ms, least {:.3f} ms\n",
      camera.rate_fps, camera.dropped, work.counted(camera.offered), camera.utilisation_percent(),
      (camera.period_ps() - camera.busy_ps) / ps_per_ms,
      (camera.period_ps() - camera.most_busy_ps) / ps_per_ms);
}

/// A line for each fault that was asked for.
std::string injected_text(const std::vector<facts::Injected>& faults) {
  std::string text;
  for (const facts::Injected& injected : faults) {
    text += "fault    " + injected.fault + ": ";
    text += injected.times == 0   ? std::string("never happened in this run")
            : injected.times == 1 ? "at " + vp::format_time(injected.first_ps)
                                  : counted(injected.times, "time") + ", first at " +
                                        vp::format_time(injected.first_ps);
    text += "\n";
  }
  return text;
}

std::string fps_text(const facts::Summary& summary, const facts::RunFacts& facts) {
  const facts::Work& work = facts.work;
  if (summary.delivered() == 0)
    return fmt::format("no result: there is no {} rate and no latency\n", work.unit);
  const facts::Statistic& fps = summary.fps();
  const facts::Statistic& latency = summary.latency_us();
  return fmt::format(
      "{:<8} mean {:.1f}   min {:.1f}   max {:.1f}   ({})\n"
      "latency  mean {:.3f} ms   max {:.3f} ms\n",
      work.unit == "frame" ? "FPS" : work.many() + "/s", summary.mean_fps(), fps.min(), fps.max(),
      facts.camera ? "delivered" : work.given + " upload excluded", latency.mean() / us_per_ms,
      latency.max() / us_per_ms);
}

/// What sets the rate, and below it what raises the rate.
std::string limit_text(const facts::Limit& limit, const facts::Work& work) {
  const std::string levers = limit.levers_text();
  return "limit    " + limit.text(work) + "\n" +
         (levers.empty() ? "" : "         faster with " + levers + "\n");
}

/// Units of 1 are left out.
std::string figure_value(double value, const std::string& unit) {
  return fmt::format("{:.6g}{}", value, unit == "1" ? "" : " " + unit);
}

std::string figures_text(const std::vector<facts::UnitFigure>& figures) {
  std::string text;
  for (const facts::UnitFigure& figure : figures) {
    text +=
        (text.empty() ? "" : "   ") + figure.name + " " + figure_value(figure.value, figure.unit);
  }
  return text;
}

std::string figure_text(const facts::Summary::Figure& figure) {
  const auto value = [&](double number) { return figure_value(number, figure.unit); };
  return fmt::format("{:<8} mean {}   min {}   max {}\n", figure.name, value(figure.values.mean()),
                     value(figure.values.min()), value(figure.values.max()));
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
  const std::string none = facts.work.unit.empty() ? "" : "no " + facts.work.many() + ": ";
  if (!facts.end) return none + "the program was stopped";
  const std::string end = vp::format_time(facts.end->ps);
  if (facts.end->main_ps) {
    return fmt::format(
        "{}main() returned at {} with exit code {}; interrupts were still on, or the other core, "
        "{}",
        none, vp::format_time(*facts.end->main_ps), facts.end->exit_code,
        facts.end->reached_limit ? "until the time limit, " + end + " (ps.cpu.after_main)"
                                 : "and did their last work at " + end);
  }
  if (facts.end->reached_limit) {
    return fmt::format(
        "{}the program reached its time limit, {}, in an endless loop (ps.cpu.timeout)", none, end);
  }
  return fmt::format("{}the program ended at {} with exit code {}", none, end,
                     facts.end->exit_code);
}

/// design_text() with the energy of a `unit`.
std::string cost_text(const std::optional<facts::PowerReport>& power,
                      const facts::ResourceReport& resources, const facts::TimingReport& timing,
                      const std::string& unit);

}  // namespace

std::string frame_text(const facts::UnitReport& frame, std::optional<std::uint64_t> total) {
  std::string text = heading(frame, total);
  if (frame.extra) {
    for (const auto& [label, said] : frame.extra->lines()) text += line(label.c_str(), said);
  }
  if (const std::string counts = counts_text(frame); !counts.empty())
    text += line("counts", counts);
  if (!frame.figures.empty()) text += line("figures", figures_text(frame.figures));
  for (const std::string& warning : frame.warnings) text += line("warning", warning);
  return text + times_text(frame.times);
}

namespace {

/// Whether the design is good, and what it costs.
std::string design_lines(const facts::Summary& summary, const facts::RunFacts& facts) {
  std::string text = verdict_text(verdict_of(facts, summary));
  if (facts.resources && facts.timing && (facts.power || !facts.resources->unknown.empty()))
    text += cost_text(facts.power, *facts.resources, *facts.timing, facts.work.unit);
  if (facts.clocks) text += clock_text(*facts.clocks);
  return text;
}

}  // namespace

std::string summary_text(const facts::Summary& summary, const facts::RunFacts& facts,
                         const std::vector<std::string>& own) {
  const std::string point = fmt::format("   ({}, design {}, {}, profile {})\n", facts.system,
                                        facts.design, facts.fidelity, facts.profile);
  if (summary.frames() == 0) {
    const bool delivers = !facts.work.unit.empty();
    return end_text(facts) + point + (delivers ? "" : design_lines(summary, facts)) +
           injected_text(facts.injected);
  }
  std::string text = facts.work.counted(summary.frames());
  for (const facts::Tally& tally : facts.work.tallies) {
    const std::uint64_t units = summary.tally(tally.name);
    if (tally.is_figure || units > 0) text += fmt::format(", {} {}", units, tally.with);
  }
  if (const std::uint64_t without = summary.frames() - summary.delivered()) {
    text += fmt::format(", {} without a result", without);
  }
  if (facts.unpublished > 0) text += fmt::format(", {} never published", facts.unpublished);
  text += point;
  text += fps_text(summary, facts);
  if (facts.camera) text += camera_text(*facts.camera, facts.work);
  if (const std::optional<facts::Limit> limit = summary.limit())
    text += limit_text(*limit, facts.work);
  for (const facts::Summary::Figure& figure : summary.figures()) text += figure_text(figure);
  for (const std::string& added : own) text += added + "\n";
  text += design_lines(summary, facts);
  if (summary.settled() > 0) {
    text +=
        fmt::format("settled  the {}s of {} {}; that is in no time or energy\n", facts.work.given,
                    facts.work.counted(summary.settled()), facts.work.settled);
  }
  for (const std::string& note : facts.notes) text += "note     " + note + "\n";
  text += injected_text(facts.injected);
  if (summary.warned() > 0) {
    text += fmt::format("warnings in {}, listed in result.json\n",
                        facts.work.counted(summary.warned()));
  }
  if (!summary.stages().empty()) text += "\n" + stage_table(summary, facts.work);
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

/// With one place, or three digits if that were 0.
std::string short_figure(double value) {
  return value < 0.05 ? fmt::format("{:.3g}", value) : vp::format_fixed(value, 1);
}

std::string power_line(const std::optional<facts::PowerReport>& known,
                       const facts::ResourceReport& resources, const std::string& unit) {
  if (!known)
    return "power    unknown, as the figures of " + vp::join(resources.unknown, ", ") + " are\n";
  const facts::PowerReport& power = *known;
  std::string text =
      fmt::format("power    {:.2f} W ({:.2f} to {:.2f})", power.total_w, power.low_w, power.high_w);
  if (power.per_frame)
    text += fmt::format("   {} mJ per {}", short_figure(power.energy_per_frame_mj), unit);
  return text + fmt::format("   junction {:.0f} C   ({})\n", power.junction_c, power.mode);
}

/// The busiest RTL, as much as a line holds, if any was counted.
std::string activity_line(const std::optional<facts::PowerReport>& power) {
  if (!power || power->activity.empty()) return "";
  std::vector<facts::PowerReport::Activity> list = power->activity;
  std::stable_sort(list.begin(), list.end(),
                   [](const auto& a, const auto& b) { return a.toggle_rate > b.toggle_rate; });
  const std::string what = "   changes a bit and clock (usual 0.125)";
  std::string text = "activity";
  std::size_t shown = 0;
  for (const auto& [name, rate, bits] : list) {
    const std::string more = fmt::format("{} {} {:.3f}", shown == 0 ? "" : ",", name, rate);
    const std::string others = ", 99 others";
    if (shown > 0 && text.size() + more.size() + others.size() + what.size() > console_width) break;
    text += more;
    ++shown;
  }
  if (shown < list.size()) text += fmt::format(", {} others", list.size() - shown);
  return text + what + "\n";
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

/// "LUT 120 of 53200   FF …   (xc7z020)".
std::string amounts_text(const facts::ResourceReport& resources) {
  std::string text;
  for (const facts::Primitive& p : facts::primitives) {
    text += fmt::format("{}{} {:.0f} of {:.0f}", text.empty() ? "" : "   ", p.text,
                        resources.total.*p.amount, resources.available.*p.amount);
  }
  return text + fmt::format("   ({})", resources.device);
}

std::string resource_line(const facts::ResourceReport& resources) {
  if (resources.modules.empty()) return "";
  if (!resources.unknown.empty() && resources.over.empty()) {
    std::string text = "fits     unknown: at least " + amounts_text(resources) + "\n";
    for (const facts::ResourceReport::Module& module : resources.modules) {
      if (!module.known) text += fmt::format("         {}: {}\n", module.name, module.source);
    }
    return text;
  }
  return (resources.over.empty() ? "fits     " : "TOO BIG  ") + amounts_text(resources) + "\n";
}

std::string cost_text(const std::optional<facts::PowerReport>& power,
                      const facts::ResourceReport& resources, const facts::TimingReport& timing,
                      const std::string& unit) {
  return power_line(power, resources, unit) + activity_line(power) + timing_line(timing) +
         resource_line(resources);
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
  return cost_text(power, resources, timing, "frame");
}

}  // namespace platform::result
