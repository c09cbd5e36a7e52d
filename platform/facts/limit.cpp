#include <facts/limit.h>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include <facts/summary.h>
#include <vp/text.h>

namespace platform::facts {

namespace {

using Stages = std::vector<const StageTime*>;

/// Its name among the stages.
constexpr const char* camera = "camera";
/// Shares above are not told: the rest of the run is its beginning.
constexpr double nearly_all_percent = 99.5;

/// The stages that do the work of a frame: none that only contains others, or waits for them.
Stages working_stages(const UnitReport& frame) {
  Stages list;
  for (const StageTime& stage : frame.times) {
    if (!stage.part_of.empty() && !stage.waits && !has_parts(frame.times, stage.name))
      list.push_back(&stage);
  }
  return list;
}

/// Takes those out of `stages` that began before the frame before had its result, at
/// `last_end_ps`. A design need not say when a stage began.
Stages take_ahead(Stages& stages, const UnitReport& frame, std::uint64_t last_end_ps) {
  const auto behind =
      std::stable_partition(stages.begin(), stages.end(), [&](const StageTime* stage) {
        return frame.start_ps <= stage->start_ps && stage->start_ps < last_end_ps;
      });
  Stages ahead(stages.begin(), behind);
  stages.erase(stages.begin(), behind);
  return ahead;
}

std::string names_text(const std::vector<std::string>& stages) {
  std::string text;
  for (std::size_t i = 0; i < stages.size(); ++i) {
    if (i > 0) text += i + 1 < stages.size() ? ", " : " and ";
    text += stages[i];
  }
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

}  // namespace

const char* to_string(Limit::Kind kind) {
  switch (kind) {
    case Limit::Kind::sequence:
      return "sequence";
    case Limit::Kind::ahead:
      return "ahead";
    case Limit::Kind::behind:
      return "behind";
    case Limit::Kind::camera:
      return "camera";
  }
  return "";
}

std::string Limit::text(const Work& work) const {
  const std::string one = kind == Kind::camera ? camera : stages.front();
  const auto share = std::find_if(percent.begin(), percent.end(),
                                  [&](const auto& entry) { return entry.first == one; });
  const std::string part = share != percent.end() && share->second < nearly_all_percent
                               ? fmt::format(" for {:.0f} % of the run", share->second)
                               : "";
  if (kind == Kind::camera) {
    const bool is_vowel = std::string("aeiou").find(work.given.front()) != std::string::npos;
    return fmt::format("the camera sets the {} rate{}: {} {} each {:.1f} us", work.unit, part,
                       is_vowel ? "an" : "a", work.given, period_us);
  }
  return fmt::format(
      "{} {} the {} rate{}: {:.1f} of {:.1f} us, {}", names_text(stages),
      stages.size() > 1 ? "set" : "sets", work.unit, part, stages_us, period_us,
      kind == Kind::sequence ? "one stage follows the other" : "other stages overlap");
}

std::string Limit::levers_text() const {
  std::vector<std::string> list = levers;
  if (!clock.empty()) list.push_back("a higher " + clock + ".frequency");
  return vp::join(list, ", or ");
}

void LimitFinder::Group::add(const Group& other) {
  period_ps += other.period_ps;
  stages_ps += other.stages_ps;
  frames += other.frames;
}

bool LimitFinder::Group::has_same_stages(const Group& other) const {
  return limit.kind == other.limit.kind && limit.stages == other.limit.stages;
}

std::optional<LimitFinder::Group> LimitFinder::judge(const UnitReport& frame,
                                                     std::uint64_t period_ps) const {
  Group group;
  group.period_ps = period_ps;
  group.frames = 1;
  if (frame.camera_missed == std::uint64_t{0}) {
    group.stages_ps = period_ps;
    group.limit.kind = Limit::Kind::camera;
    group.limit.levers = {"camera.rate=none"};
    return group;
  }
  Stages stages = working_stages(frame);
  if (stages.empty()) return std::nullopt;
  const auto is_shorter = [](const StageTime* a, const StageTime* b) { return a->ps < b->ps; };
  Stages ahead;
  if (last_end_ps_) ahead = take_ahead(stages, frame, *last_end_ps_);
  if (ahead.empty()) {
    stages = {*std::max_element(stages.begin(), stages.end(), is_shorter)};
  } else {
    const bool is_late = std::any_of(ahead.begin(), ahead.end(), [&](const StageTime* stage) {
      return stage->start_ps + stage->ps > *last_end_ps_;
    });
    group.limit.kind = is_late || stages.empty() ? Limit::Kind::ahead : Limit::Kind::behind;
    if (group.limit.kind == Limit::Kind::ahead) stages = std::move(ahead);
  }
  for (const StageTime* stage : stages) {
    group.limit.stages.push_back(stage->name);
    group.stages_ps += stage->ps;
  }
  const StageTime& longest = **std::max_element(stages.begin(), stages.end(), is_shorter);
  group.limit.clock = longest.clock;
  group.limit.why = longest.why;
  group.limit.levers = longest.levers;
  return group;
}

void LimitFinder::note_stages(const UnitReport& frame) {
  for (const StageTime* stage : working_stages(frame)) {
    if (std::find(names_.begin(), names_.end(), stage->name) == names_.end())
      names_.push_back(stage->name);
  }
}

void LimitFinder::keep(Group group) {
  const auto known = std::find_if(groups_.begin(), groups_.end(), [&](const Group& other) {
    return other.has_same_stages(group) && other.limit.levers == group.limit.levers;
  });
  if (known != groups_.end()) {
    known->add(group);
  } else {
    groups_.push_back(std::move(group));
  }
}

void LimitFinder::add(const UnitReport& frame, std::uint64_t period_ps) {
  if (frame.settling_showings > 0)
    last_end_ps_ = std::max(last_end_ps_.value_or(0), frame.settled_ps);
  std::optional<Group> group;
  if (frame.delivered()) {
    note_stages(frame);
    group = judge(frame, period_ps);
  }
  const bool is_cut = frame.camera_period && !frame.camera_missed;
  const bool is_complete = frame.camera_missed == std::uint64_t{0} || (last_end_ps_ && !is_cut);
  last_end_ps_ = frame.end_ps;
  if (!group) return;
  if (is_complete) {
    keep(std::move(*group));
  } else if (!incomplete_) {
    incomplete_ = std::move(group);
  }
}

// First the stages that set most of the time, then the levers that most of these frames have.
std::optional<Limit> LimitFinder::limit() const {
  if (groups_.empty() && !incomplete_) return std::nullopt;
  const std::vector<Group>& all = groups_.empty() ? std::vector<Group>{*incomplete_} : groups_;
  const auto is_shorter = [](const Group& a, const Group& b) { return a.period_ps < b.period_ps; };
  double whole_ps = 0;
  std::vector<Group> sums;
  for (const Group& group : all) {
    whole_ps += static_cast<double>(group.period_ps);
    const auto known = std::find_if(
        sums.begin(), sums.end(), [&](const Group& other) { return other.has_same_stages(group); });
    if (known == sums.end()) {
      sums.push_back(group);
    } else {
      known->add(group);
    }
  }
  const Group& most = *std::max_element(sums.begin(), sums.end(), is_shorter);
  const Group* usual = nullptr;
  for (const Group& group : all) {
    if (group.has_same_stages(most) && (!usual || is_shorter(*usual, group))) usual = &group;
  }
  Limit limit = usual->limit;
  const double ps = ps_per_us * static_cast<double>(most.frames);
  limit.stages_us = static_cast<double>(most.stages_ps) / ps;
  limit.period_us = static_cast<double>(most.period_ps) / ps;
  const auto add_share = [&](const std::string& name, const auto& is_of) {
    double sum = 0;
    for (const Group& group : all) {
      if (is_of(group.limit)) sum += static_cast<double>(group.period_ps);
    }
    limit.percent.emplace_back(name, whole_ps > 0 ? 100 * sum / whole_ps : 0);
  };
  for (const std::string& name : names_) {
    add_share(name, [&](const Limit& of) {
      return std::find(of.stages.begin(), of.stages.end(), name) != of.stages.end();
    });
  }
  add_share(camera, [](const Limit& of) { return of.kind == Limit::Kind::camera; });
  return limit;
}

}  // namespace platform::facts
