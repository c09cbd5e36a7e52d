#include <trace/tools.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <deque>
#include <map>
#include <tuple>
#include <utility>

#include <trace/replay.h>
#include <vp/error.h>
#include <vp/frame_gate.h>

namespace platform::trace {

namespace {

/// One of both traces, on its way.
struct Side {
  Side(TraceFile& trace_file, const DifferenceOptions& options)
      : file(trace_file), stepper(trace_file), options_(options) {}

  void compare(const std::map<std::string, std::size_t>& common) {
    signals_of_net.resize(file.reader().nets());
    for (std::size_t i = 0; i < file.paths().size(); ++i) {
      const auto found = common.find(file.paths()[i]);
      if (found == common.end()) continue;
      const vp::WaveVariable& variable = file.variable(static_cast<std::uint32_t>(i));
      if (variable.width == 0) continue;
      signals_of_net[variable.net].push_back(found->second);
      variables[found->second] = &variable;
      if (variable.is_event) values[found->second] = "0";
      file.reader().select(variable.net);
    }
    if (options_.by_frame) {
      const auto place = vp::find_path(options_.frame, file.paths(), "'" + file.name() + "': ");
      frame_net = file.variable(place).net;
      file.reader().select(frame_net);
    }
  }

  /// To the next instant.
  void step() {
    // An event is over when its instant is.
    for (const std::size_t signal : std::exchange(occurred, {})) values[signal] = "0";
    over = !stepper.next();
    if (over) return;
    if (options_.by_frame) {
      for (const auto& change : stepper.changes()) {
        if (change.net != frame_net || change.text == frame_value) continue;
        frame += !frame_value.empty();
        frame_value = change.text;
        frame_ps = stepper.now_ps();
      }
    }
  }
  std::tuple<std::uint64_t, std::uint64_t, unsigned> place() const {
    return {frame, stepper.now_ps() - frame_ps, stepper.below_ps()};
  }
  /// Takes over the instant's values; the signals that were written go to `touched`.
  void apply(std::vector<std::size_t>& touched) {
    for (const auto& change : stepper.changes()) {
      for (const std::size_t signal : signals_of_net[change.net]) {
        if (values[signal] != change.text) note(signal, change.text);
        values[signal] = change.text;
        touched.push_back(signal);
        if (variables[signal]->is_event) occurred.push_back(signal);
      }
    }
  }
  void note(std::size_t signal, const std::string& text) {
    const auto place = static_cast<std::size_t>(variables[signal] - &file.variable(0));
    recent.push_back({stepper.now_ps(), file.reader().paths()[place], shown(signal, text)});
    if (recent.size() > options_.neighbourhood) recent.pop_front();
  }
  std::string shown(std::size_t signal, const std::string& text) const {
    return readable(text, variables[signal]->kind, variables[signal]->width);
  }

  TraceFile& file;
  Stepper stepper;
  std::vector<std::vector<std::size_t>> signals_of_net;
  std::vector<const vp::WaveVariable*> variables;
  std::vector<std::string> values;
  std::vector<std::size_t> occurred;  ///< events in this instant
  std::deque<Difference::Event> recent;
  std::uint32_t frame_net = 0;
  std::string frame_value;
  std::uint64_t frame = 0, frame_ps = 0;
  bool over = false;

 private:
  const DifferenceOptions& options_;
};

/// Reals of both formats come with all their digits; another tool may write the same number
/// otherwise, as 1.0.
bool same(const std::string& a, const std::string& b, vp::WaveVariable::Kind kind) {
  if (a == b) return true;
  if (kind != vp::WaveVariable::Kind::real) return false;
  double in_a = 0, in_b = 0;
  const bool numbers = std::from_chars(a.data(), a.data() + a.size(), in_a).ec == std::errc() &&
                       std::from_chars(b.data(), b.data() + b.size(), in_b).ec == std::errc();
  return numbers && in_a == in_b;
}

std::vector<std::string> missing(const TraceFile& from, const TraceFile& in,
                                 const vp::TraceFilter& filter) {
  std::vector<std::string> others = in.paths().all(), result;
  std::sort(others.begin(), others.end());
  for (const std::string& path : from.paths()) {
    if (filter.selects(path) && !std::binary_search(others.begin(), others.end(), path)) {
      result.push_back(path);
    }
  }
  return result;
}

/// Reads on for some more changes.
std::vector<Difference::Event> events_after(Side& side, unsigned count) {
  std::vector<Difference::Event> events;
  side.recent.clear();
  std::vector<std::size_t> touched;
  while (events.size() < count) {
    side.step();
    if (side.over) break;
    side.recent.clear();
    side.apply(touched);
    events.insert(events.end(), side.recent.begin(), side.recent.end());
  }
  if (events.size() > count) events.resize(count);
  return events;
}

}  // namespace

Difference difference(TraceFile& a, TraceFile& b, const DifferenceOptions& options) {
  Difference result;
  result.only_in_a = missing(a, b, options.filter);
  result.only_in_b = missing(b, a, options.filter);
  std::map<std::string, std::size_t> common;
  for (const std::string& path : a.paths()) {
    if (options.filter.selects(path) && b.find(path) >= 0) common.emplace(path, common.size());
  }
  result.compared = common.size();
  if (common.empty()) {
    throw vp::InputError("traces '" + a.name() + "' and '" + b.name() +
                         "' have no signal in common; name them with --map");
  }
  Side left(a, options), right(b, options);
  for (Side* side : {&left, &right}) {
    side->variables.resize(common.size());
    side->values.resize(common.size());
    side->compare(common);
    side->step();
  }
  std::vector<std::string> paths(common.size());
  for (const auto& [path, signal] : common) paths[signal] = path;
  std::vector<std::size_t> touched;
  while (!left.over && !right.over) {
    const auto a_place = left.place(), b_place = right.place();
    const auto place = std::min(a_place, b_place);
    touched.clear();
    const bool a_now = a_place == place, b_now = b_place == place;
    if (a_now) left.apply(touched);
    if (b_now) right.apply(touched);
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    for (const std::size_t signal : touched) {
      if (same(left.values[signal], right.values[signal], left.variables[signal]->kind)) continue;
      result.values.push_back({paths[signal], left.shown(signal, left.values[signal]),
                               right.shown(signal, right.values[signal])});
    }
    if (!result.values.empty()) {
      result.differ = true;
      result.frame = std::get<0>(place);
      result.in_frame_ps = std::get<1>(place);
      result.a_ps =
          left.frame == result.frame ? left.frame_ps + result.in_frame_ps : left.stepper.now_ps();
      result.b_ps = right.frame == result.frame ? right.frame_ps + result.in_frame_ps
                                                : right.stepper.now_ps();
      result.a_before.assign(left.recent.begin(), left.recent.end());
      result.b_before.assign(right.recent.begin(), right.recent.end());
      result.a_after = events_after(left, options.neighbourhood);
      result.b_after = events_after(right, options.neighbourhood);
      return result;
    }
    if (a_now) left.step();
    if (b_now) right.step();
  }
  return result;
}

}  // namespace platform::trace
