#include <algorithm>
#include <numeric>

#include <facts/summary.h>

namespace platform::facts {

std::uint64_t& Counts::entry(const std::string& name, bool lost) {
  const auto known = std::find_if(list_.begin(), list_.end(),
                                  [&](const Count& count) { return count.name == name; });
  if (known != list_.end()) return known->value;
  return list_.emplace_back(Count{name, 0, lost}).value;
}

std::uint64_t Counts::operator[](const std::string& name) const {
  const auto known = std::find_if(list_.begin(), list_.end(),
                                  [&](const Count& count) { return count.name == name; });
  return known == list_.end() ? 0 : known->value;
}

std::uint64_t Counts::lost() const {
  return std::accumulate(
      list_.begin(), list_.end(), std::uint64_t{0},
      [](std::uint64_t sum, const Count& count) { return sum + (count.lost ? count.value : 0); });
}

std::vector<vp::Interval> FramePeriods::next(const UnitReport& frame) {
  if (frame.camera_period) {
    end_ps_ = frame.camera_period->to_ps;
    return {*frame.camera_period};
  }
  std::vector<vp::Interval> period;
  if (end_ps_) end_ps_ = std::max(*end_ps_, frame.settled_ps);
  if (end_ps_) {
    const std::uint64_t upload = frame.start_ps - std::min(frame.start_ps, frame.upload_ps);
    period.push_back({*end_ps_, std::max(*end_ps_, upload)});
    period.push_back({std::max(*end_ps_, frame.start_ps), frame.end_ps});
  } else {
    period.push_back({frame.start_ps, frame.end_ps});
  }
  end_ps_ = frame.end_ps;
  return period;
}

bool has_parts(const std::vector<StageTime>& stages, const std::string& stage) {
  return std::any_of(stages.begin(), stages.end(),
                     [&](const StageTime& other) { return other.part_of == stage; });
}

void Statistic::add(double value) {
  min_ = count_ == 0 ? value : std::min(min_, value);
  max_ = count_ == 0 ? value : std::max(max_, value);
  sum_ += value;
  ++count_;
}

void Summary::add(const UnitReport& frame) {
  ++frames_;
  if (!frame.warnings.empty()) ++warned_;
  if (frame.settling_showings > 0) ++settled_;
  if (frame.counts.lost() != 0) ++lossy_;
  std::uint64_t period_ps = 0;
  for (const vp::Interval& part : periods_.next(frame)) period_ps += part.to_ps - part.from_ps;
  open_ps_ += period_ps;
  limit_.add(frame, period_ps);
  if (!frame.delivered()) return;
  if (open_ps_ > 0) fps_.add(ps_per_s / static_cast<double>(open_ps_));
  busy_ps_ += open_ps_;
  open_ps_ = 0;
  latency_us_.add(static_cast<double>(frame.end_ps - frame.start_ps) / ps_per_us);
  add_stages(frame);
  add_job(frame);
  add_figures(frame);
}

double Summary::mean_fps() const {
  if (busy_ps_ == 0) return 0;
  return static_cast<double>(delivered()) * ps_per_s / static_cast<double>(busy_ps_);
}

void Summary::add_stages(const UnitReport& frame) {
  for (const StageTime& time : frame.times) {
    auto stage = std::find_if(stages_.begin(), stages_.end(),
                              [&](const Stage& known) { return known.name == time.name; });
    if (stage == stages_.end())
      stage =
          stages_.insert(stages_.end(), Stage{time.name, time.part_of, time.clock, time.why, {}});
    stage->us.add(static_cast<double>(time.ps) / ps_per_us);
  }
}

void Summary::add_job(const UnitReport& frame) {
  if (frame.fulfilled()) ++fulfilled_;
  for (const std::string& tally : frame.tallies) ++tallies_[tally];
  for (const std::string& reason : frame.failures) {
    const auto known = std::find_if(failures_.begin(), failures_.end(),
                                    [&](const auto& failure) { return failure.first == reason; });
    ++(known == failures_.end() ? failures_.emplace_back(reason, 0) : *known).second;
  }
}

void Summary::add_figures(const UnitReport& frame) {
  for (const UnitFigure& figure : frame.figures) {
    auto known = std::find_if(figures_.begin(), figures_.end(),
                              [&](const Figure& other) { return other.name == figure.name; });
    if (known == figures_.end())
      known = figures_.insert(figures_.end(), Figure{figure.name, figure.unit, {}});
    known->values.add(figure.value);
  }
  if (frame.extra) {
    frame.extra->add_samples(
        [this](const std::string& name, double value) { samples_[name].add(value); });
  }
}

std::uint64_t Summary::tally(const std::string& name) const {
  const auto known = tallies_.find(name);
  return known == tallies_.end() ? 0 : known->second;
}

const Statistic& Summary::samples(const std::string& name) const {
  static const Statistic none;
  const auto known = samples_.find(name);
  return known == samples_.end() ? none : known->second;
}

}  // namespace platform::facts
