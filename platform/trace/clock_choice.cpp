#include <trace/clock_choice.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include <vp/frame_gate.h>
#include <vp/text.h>
#include <vp/unit.h>

// Which wire is a link's clock: found by names, scopes and edges, or named by the user.

namespace platform::trace {

namespace {

/// The most clocks that a link is counted on at a time, until their edges tell which is its own.
constexpr std::size_t most_clocks = 4;

}  // namespace

std::string_view leaf_of(std::string_view path) {
  return path.substr(path.rfind('.') + 1);
}

std::string_view scope_of(std::string_view path) {
  const std::size_t dot = path.rfind('.');
  return dot == std::string_view::npos ? std::string_view() : path.substr(0, dot);
}

std::pair<std::size_t, std::size_t> nearness(std::string_view link, std::string_view clock) {
  std::size_t levels = 0, same = 0;
  for (; same < std::min(link.size(), clock.size()) && link[same] == clock[same]; ++same)
    levels += link[same] == '.' ? 1 : 0;
  const std::string_view a = leaf_of(link), b = leaf_of(clock);
  std::size_t letters = 0;
  while (letters < std::min(a.size(), b.size()) && a[letters] == b[letters]) ++letters;
  return {levels, letters};
}

bool may_be_clock(std::string_view path, const vp::WaveVariable& variable) {
  const std::string leaf = vp::lower(leaf_of(path));
  const auto has = [&](const char* word) { return leaf.find(word) != std::string::npos; };
  return (has("clk") || has("clock")) && !has("rst") && !has("reset") && variable.width == 1 &&
         variable.kind == vp::WaveVariable::Kind::bits;
}

void ClockFit::note(const SampleClock& clock, std::uint64_t ps) {
  if (clock.falls_on(ps) || clock.goes_back()) {
    ++on_edge;
    return;
  }
  // A bench may drive some time after the edge.
  const std::optional<std::uint64_t> delay = clock.since_edge(ps);
  if (!delay) return;
  if (!delay_ps) delay_ps = delay;
  with_delay += delay == delay_ps ? 1 : 0;
}

ClockSet::ClockSet(Replay& replay, const TraceFile& file, const StatisticsOptions& options)
    : replay_(replay), file_(file), options_(options) {
  for (std::uint32_t i = 0; i < file.paths().size(); ++i) {
    if (may_be_clock(file.paths()[i], file.variable(i))) wires_.push_back(i);
  }
}

std::size_t ClockSet::of(std::uint32_t variable, bool falling) {
  const Replay::Slot slot = replay_.watch(variable);
  for (std::size_t i = 0; i < clocks_.size(); ++i) {
    if (clocks_[i].is_of(slot, falling)) return i;
  }
  clocks_.emplace_back(replay_, slot, falling);
  wire_of_.emplace_back(std::make_pair(variable, falling));
  return clocks_.size() - 1;
}

std::size_t ClockSet::assumed() {
  for (std::size_t i = 0; i < clocks_.size(); ++i) {
    if (!clocks_[i].has_wire()) return i;
  }
  clocks_.emplace_back(options_.system_hz);
  wire_of_.emplace_back();
  return clocks_.size() - 1;
}

std::optional<std::size_t> ClockSet::named(const std::vector<std::string>& names) {
  const ClockEdge* edge = options_.clock ? &*options_.clock : nullptr;
  for (const auto& [link, own] : options_.clock_of_link) {
    for (const std::string& name : names) {
      if (link == name || vp::ends_with(name, "." + link)) edge = &own;
    }
  }
  if (!edge) return std::nullopt;
  return of(vp::find_path(edge->signal, file_.paths(), "--clock: "), edge->falling);
}

std::vector<std::size_t> ClockSet::candidates(const std::vector<std::string>& names) {
  if (const auto own = named(names)) return {*own};
  const std::string usual = "ps.fclk_clk0.clk";
  std::vector<std::uint32_t> near = wires_;
  std::stable_sort(near.begin(), near.end(), [&](std::uint32_t a, std::uint32_t b) {
    const auto how_near = [&](std::uint32_t wire) {
      const auto [levels, letters] = nearness(names.front(), file_.paths()[wire]);
      return std::make_tuple(levels, letters, file_.paths()[wire] == usual);
    };
    return how_near(a) > how_near(b);
  });
  std::vector<std::size_t> places;
  for (const std::uint32_t wire : near) {
    const std::size_t place = of(wire, false);
    if (std::find(places.begin(), places.end(), place) == places.end()) places.push_back(place);
    if (places.size() == most_clocks) break;
  }
  places.push_back(assumed());
  return places;
}

std::size_t ClockSet::best(const std::vector<std::size_t>& candidates,
                           const std::vector<ClockFit>& fits,
                           const std::map<std::size_t, std::uint64_t>& weight,
                           std::uint64_t changes) const {
  const auto weight_of = [&](std::size_t candidate) { return weight.at(candidates[candidate]); };
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < candidates.size(); ++i) {
    if (clocks_[candidates[i]].has_wire() && weight_of(i) > weight_of(nearest)) nearest = i;
  }
  // The assumed one counts where no wire is its clock.
  const std::size_t last = candidates.size() - 1;
  if (fits[nearest].fits(changes) || clocks_[candidates[last]].has_wire()) return nearest;
  return fits[last].fits(changes) ? last : nearest;
}

std::string ClockSet::text(std::size_t place) const {
  if (const auto& wire = wire_of_[place])
    return file_.paths()[wire->first] + (wire->second ? " falling" : "");
  return vp::format_quantity(vp::Decimal(options_.system_hz, 0), vp::Unit::frequency);
}

}  // namespace platform::trace
