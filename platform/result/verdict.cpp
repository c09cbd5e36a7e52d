#include <result/verdict.h>

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <tuple>

#include <result/console.h>
#include <vp/text.h>

namespace platform::result {

namespace {

using Part = Verdict::Part;

Part not_known(const char* name) {
  return {name, Holds::unknown, std::nullopt, "", fmt::format("{} not known", name)};
}

/// The least margin so far, and whose it is.
void narrow(Part& part, double margin_percent, const std::string& by) {
  if (part.margin_percent && *part.margin_percent <= margin_percent) return;
  part.margin_percent = margin_percent;
  part.by = by;
}

Part ran(const facts::RunFacts& facts) {
  const auto no = [](std::string why) {
    return Part{"ran", Holds::no, std::nullopt, "", std::move(why)};
  };
  if (facts.incomplete) return no(*facts.incomplete);
  if (!facts.end) return no("the program did not end");
  if (facts.end->exit_code != 0)
    return no(fmt::format("the program ended with exit code {}", facts.end->exit_code));
  return {"ran"};
}

Part counted_job(const facts::RunFacts& facts, const facts::Summary& summary) {
  Part part{"job"};
  const facts::Work& work = facts.work;
  const std::uint64_t dropped = facts.camera ? facts.camera->dropped : 0;
  if (work.unit.empty() && summary.frames() == 0) return part;  // "ran" says whether it is done
  const std::uint64_t all = summary.frames() + facts.unpublished + dropped;
  if (all == 0) {
    part.holds = Holds::no;
    part.why = "no " + work.many();
    return part;
  }
  part.margin_percent =
      100 * (static_cast<double>(summary.fulfilled()) / static_cast<double>(all) - 1);
  if (summary.fulfilled() == all) return part;
  part.holds = Holds::no;
  std::vector<std::string> reasons;
  const auto add = [&](std::uint64_t units, const std::string& what) {
    if (units != 0) reasons.push_back(fmt::format("{} of {} {}", units, work.counted(all), what));
  };
  add(dropped, "of the camera dropped");
  add(facts.unpublished, "taken and never published");
  add(summary.frames() - summary.delivered(), "without a result");
  add(summary.lossy(), "with losses");
  for (const auto& [reason, units] : summary.failures()) add(units, reason);
  part.why = vp::join(reasons, ", ");
  return part;
}

/// What stubs had a part in is not known to be done.
Part job(const facts::RunFacts& facts, const facts::Summary& summary) {
  Part part = counted_job(facts, summary);
  if (part.holds != Holds::yes || facts.stubs.empty()) return part;
  part.holds = Holds::unknown;
  part.why = fmt::format("job not known: {} answered in the place of {}",
                         facts.stubs.size() == 1 ? "a stub" : "stubs", vp::join(facts.stubs, ", "));
  return part;
}

Part fits(const std::optional<facts::ResourceReport>& resources) {
  if (!resources) return not_known("fits");
  Part part{"fits"};
  for (const facts::Primitive& primitive : facts::primitives) {
    const double used = resources->total.*primitive.amount;
    if (used > 0)
      narrow(part, 100 * (resources->available.*primitive.amount / used - 1), primitive.key);
  }
  if (resources->over.empty() && resources->unknown.empty()) return part;
  if (resources->over.empty()) {
    part.margin_percent.reset();
    part.by.clear();
    part.holds = Holds::unknown;
    part.why = fmt::format("what {} takes is not known", vp::join(resources->unknown, ", "));
    return part;
  }
  part.holds = Holds::no;
  part.why =
      fmt::format("too big for an {} ({})", resources->device, vp::join(resources->over, ", "));
  return part;
}

Part clocks(const std::optional<facts::ClockReport>& report) {
  if (!report) return not_known("clocks");
  Part part{"clocks"};
  std::vector<std::string> fast, impossible;
  for (const facts::ClockReport::Clock& clock : report->clocks) {
    if (!clock.used) continue;
    narrow(part, clock.margin_percent, clock.name);
    if (!clock.within) fast.push_back(clock.name);
    if (clock.within && !clock.makeable) impossible.push_back(clock.name);
  }
  if (report->legal) return part;
  part.holds = Holds::no;
  if (!fast.empty())
    part.why = fmt::format("{} too fast for an {}", vp::join(fast, ", "), report->device);
  if (!impossible.empty())
    part.why +=
        fmt::format("{}no PLL makes {}", fast.empty() ? "" : ", ", vp::join(impossible, ", "));
  return part;
}

Part timing(const std::optional<facts::TimingReport>& report) {
  if (!report) return not_known("timing");
  Part part{"timing"};
  if (report->modules.empty()) return part;
  const facts::TimingReport::Module& critical = critical_module(*report);
  if (critical.known) part.margin_percent = critical.margin_percent;
  part.by = critical.name;
  if (critical.met) return part;
  const bool unknown = critical.unknown();
  part.holds = unknown ? Holds::unknown : Holds::no;
  const auto alike = std::count_if(
      report->modules.begin(), report->modules.end(),
      [&](const facts::TimingReport::Module& m) { return unknown ? m.unknown() : m.missed(); });
  part.why = fmt::format("timing {} {}{}", unknown ? "unknown for" : "missed by", critical.name,
                         alike > 1 ? fmt::format(" and {} more", alike - 1) : "");
  return part;
}

}  // namespace

const char* to_string(Holds holds) {
  switch (holds) {
    case Holds::no:
      return "no";
    case Holds::unknown:
      return "unknown";
    case Holds::yes:
      break;
  }
  return "yes";
}

Verdict::Part job_of(const facts::RunFacts& facts, const facts::Summary& summary) {
  return job(facts, summary);
}

const facts::TimingReport::Module& critical_module(const facts::TimingReport& timing) {
  const auto rank = [](const facts::TimingReport::Module& m) {
    const Holds holds = m.met ? Holds::yes : m.unknown() ? Holds::unknown : Holds::no;
    return std::tuple(holds, m.margin_percent);
  };
  return *std::min_element(timing.modules.begin(), timing.modules.end(),
                           [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
}

Verdict verdict_of(const facts::RunFacts& facts, const facts::Summary& summary) {
  return {{ran(facts), job(facts, summary), fits(facts.resources), clocks(facts.clocks),
           timing(facts.timing)}};
}

Holds Verdict::feasible() const {
  Holds worst = Holds::yes;
  for (const Part& part : parts) worst = std::min(worst, part.holds);
  return worst;
}

std::vector<std::string> Verdict::reasons() const {
  std::vector<std::string> reasons;
  for (const Part& part : parts) {
    if (part.holds != Holds::yes) reasons.push_back(part.why);
  }
  return reasons;
}

}  // namespace platform::result
