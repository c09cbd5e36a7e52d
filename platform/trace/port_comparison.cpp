// A simulation made elsewhere against a trace of ours: the same ports, clock by clock.
#include <trace/tools.h>

#include <algorithm>
#include <deque>
#include <filesystem>
#include <tuple>

#include <trace/replay.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>
#include <vp/wave_writer.h>
#include <vp/yaml.h>

namespace platform::trace {

namespace {

class PortMapReader : private vp::YamlReader {
 public:
  explicit PortMapReader(const std::string& file) : YamlReader(file), file_(file) {}

  PortMap read() {
    const YAML::Node root = vp::load_yaml(vp::read_text(file_, "map of ports"), file_);
    for_each(root,
             {{"clock", [&](const YAML::Node& n) { read_clock(n); }},
              {"inputs", [&](const YAML::Node& n) { read_ports(n, "inputs", true); }},
              {"outputs", [&](const YAML::Node& n) { read_ports(n, "outputs", false); }}},
             "a map of ports");
    for (const char* key : {"clock", "inputs", "outputs"}) {
      if (!root[key]) fail(root, std::string("'") + key + "' is missing: docs/rtl.md has a map");
    }
    return map_;
  }

 private:
  void read_clock(const YAML::Node& node) {
    map_.clock.place = where(node);
    for_each(node,
             {{"ours", [&](const YAML::Node& n) { map_.clock.ours = scalar(n, "ours"); }},
              {"theirs", [&](const YAML::Node& n) { map_.clock.theirs = scalar(n, "theirs"); }}},
             "'clock'");
    if (map_.clock.ours.empty() || map_.clock.theirs.empty())
      fail(node, "'clock' is '{ours: ps.fclk_clk1.clk, theirs: bench.clk}'");
  }

  void read_ports(const YAML::Node& node, const std::string& key, bool input) {
    if (!node.IsMap() || node.size() == 0)
      fail(node, "'" + key + "' is 'ours: theirs' lines, one for each port");
    for (const auto& entry : node) {
      PortMap::Port port;
      port.ours = scalar(entry.first, key);
      port.input = input;
      port.place = where(entry.first);
      for (const PortMap::Port& other : map_.ports) {
        if (other.ours == port.ours) fail(entry.first, "'" + port.ours + "' is listed twice");
      }
      if (entry.second.IsMap()) {
        for_each(entry.second,
                 {{"theirs", [&](const YAML::Node& n) { port.theirs = scalar(n, "theirs"); }},
                  {"valid", [&](const YAML::Node& n) { port.valid = scalar(n, "valid"); }}},
                 "port '" + port.ours + "'");
      } else {
        port.theirs = scalar(entry.second, port.ours);
      }
      if (port.theirs.empty()) fail(entry.first, "'" + port.ours + "' has no name of theirs");
      map_.ports.push_back(std::move(port));
    }
  }

  const std::string& file_;
  PortMap map_;
};

using Net = std::uint32_t;

/// The nine states of VHDL as the four of Verilog: a simulator of VHDL says u where one of Verilog
/// says x.
std::string four_states(const std::string& written, unsigned width) {
  std::string digits = vp::full_digits(written, width);
  for (char& c : digits) {
    if (c == 'u' || c == 'w' || c == '-') c = 'x';
    if (c == 'l' || c == 'h') c = c == 'h' ? '1' : '0';
  }
  return std::string(shortest_digits(digits));
}

/// The values of one trace as the edges of its clock sample them.
class Sampler {
 public:
  using Place = PortComparison::Place;

  Sampler(const std::string& file, const PortMap& map, bool ours)
      : file_(file), stepper_(file_), clock_name_(ours ? map.clock.ours : map.clock.theirs) {
    clock_ = net(clock_name_, map.clock.place);
    values_.resize(file_.reader().nets(), "x");
    net_widths_.resize(file_.reader().nets());
    for (const vp::WaveVariable& variable : file_.reader().variables())
      net_widths_[variable.net] = variable.width;
    for (const PortMap::Port& port : map.ports) {
      ports_.push_back(net(ours ? port.ours : port.theirs, port.place));
      widths_.push_back(variable_->width);
      if (ours) valids_.push_back(port.valid.empty() ? none : net(port.valid, port.place));
    }
  }

  /// To the next edge; false: the trace is over.
  bool next() {
    apply();
    while (stepper_.next()) {
      if (rises()) {
        behind_ = edge_;
        edge_ = {edge_.clock + 1, stepper_.now_ps()};
        return true;
      }
      apply();
    }
    return false;
  }
  /// The edge behind which the values stand.
  const Place& behind() const { return behind_; }
  /// The edge that samples them.
  const Place& edge() const { return edge_; }
  const std::string& port(std::size_t i) const { return values_[ports_[i]]; }
  /// Of ours: the port means something.
  bool valid(std::size_t i) const { return valids_[i] == none || values_[valids_[i]] == "1"; }

  unsigned width(std::size_t i) const { return widths_[i]; }
  const TraceFile& file() const { return file_; }
  const std::string& name() const { return file_.name(); }
  const std::string& clock_name() const { return clock_name_; }

 private:
  static constexpr Net none = ~Net{0};

  Net net(const std::string& signal, const std::string& place) {
    const std::string where = place + ": in '" + file_.name() + "' ";
    variable_ = &file_.variable(vp::find_path(signal, file_.paths(), where));
    if (variable_->kind != vp::WaveVariable::Kind::bits)
      throw vp::InputError(where + "'" + signal + "' is no vector of bits: name a port");
    file_.reader().select(variable_->net);
    return variable_->net;
  }
  bool rises() const {
    const std::string* last = nullptr;
    for (const Stepper::Change& change : stepper_.changes()) {
      if (change.net == clock_) last = &change.text;
    }
    return last && four_states(*last, 1) == "1" && values_[clock_] == "0";
  }
  void apply() {
    for (const Stepper::Change& change : stepper_.changes())
      values_[change.net] = four_states(change.text, net_widths_[change.net]);
  }

  TraceFile file_;
  Stepper stepper_;
  std::string clock_name_;
  Net clock_ = 0;
  const vp::WaveVariable* variable_ = nullptr;  ///< that net() looked up last
  std::vector<Net> ports_, valids_;
  std::vector<unsigned> widths_;
  std::vector<std::string> values_;   ///< by net
  std::vector<unsigned> net_widths_;  ///< likewise
  Place behind_, edge_;
};

/// An edge that samples other inputs than the one before it.
struct InputChange {
  std::uint64_t signature;  ///< of the inputs before and after
  std::uint64_t clock;
};

/// Of a trace without end no more is looked at.
constexpr std::size_t most_changes = std::size_t{1} << 23;

std::uint64_t add_to_hash(std::uint64_t hash, std::string_view text) {
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return (hash ^ ',') * 0x100000001b3u;
}

std::vector<InputChange> input_changes(Sampler& trace, const PortMap& map) {
  std::vector<InputChange> changes;
  std::uint64_t before = 0;
  while (changes.size() < most_changes && trace.next()) {
    std::uint64_t now = 0xcbf29ce484222325u;
    for (std::size_t i = 0; i < map.ports.size(); ++i) {
      if (map.ports[i].input) now = add_to_hash(now, trace.port(i));
    }
    if (trace.edge().clock > 1 && now != before)
      changes.push_back({before * 31 + now, trace.edge().clock});
    before = now;
  }
  if (trace.edge().clock == 0) {
    throw vp::InputError("clock '" + trace.clock_name() + "' never rises in '" + trace.name() +
                         "': name the clock of these ports; a trace of ours has clocks with "
                         "--trace-clocks");
  }
  return changes;
}

/// Some of the changes, by signature; the same ones of both traces.
std::vector<InputChange> sample_of(const std::vector<InputChange>& changes, std::uint64_t step) {
  std::vector<InputChange> sample;
  for (const InputChange& change : changes) {
    if (change.signature % step == 0) sample.push_back(change);
  }
  std::sort(sample.begin(), sample.end(), [](const InputChange& a, const InputChange& b) {
    return std::tie(a.signature, a.clock) < std::tie(b.signature, b.clock);
  });
  return sample;
}

/// Clocks that theirs may be behind ours: what brings the same changes together, most often first.
std::vector<std::int64_t> likely_shifts(const std::vector<InputChange>& theirs,
                                        const std::vector<InputChange>& ours) {
  constexpr std::size_t enough = 1 << 16, most_equal = 16, most_shifts = 16;
  const std::uint64_t step = 1 + std::min(theirs.size(), ours.size()) / enough;
  const auto a = sample_of(theirs, step), b = sample_of(ours, step);
  std::vector<std::int64_t> votes;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    const std::uint64_t signature = std::max(a[i].signature, b[j].signature);
    while (i < a.size() && a[i].signature < signature) ++i;
    while (j < b.size() && b[j].signature < signature) ++j;
    const auto same = [signature](const auto& all, std::size_t at) {
      return at < all.size() && all[at].signature == signature;
    };
    for (std::size_t k = i; k < i + most_equal && same(a, k) && same(b, j); ++k) {
      for (std::size_t l = j; l < j + most_equal && same(b, l); ++l)
        votes.push_back(static_cast<std::int64_t>(a[k].clock - b[l].clock));
    }
    if (!same(a, i) || !same(b, j)) continue;
    while (same(a, i)) ++i;
    while (same(b, j)) ++j;
  }
  std::sort(votes.begin(), votes.end());
  std::vector<std::pair<std::size_t, std::int64_t>> counted;
  for (auto vote = votes.begin(); vote != votes.end();) {
    const auto end = std::upper_bound(vote, votes.end(), *vote);
    counted.emplace_back(end - vote, *vote);
    vote = end;
  }
  std::stable_sort(counted.begin(), counted.end(),
                   [](const auto& x, const auto& y) { return x.first > y.first; });
  if (counted.size() > most_shifts) counted.resize(most_shifts);
  std::vector<std::int64_t> shifts;
  shifts.reserve(counted.size());
  for (const auto& [count, shift] : counted) shifts.push_back(shift);
  return shifts;
}

/// How their clocks lie beside ours.
struct Alignment {
  std::int64_t shift = 0;          ///< their clock less ours
  std::uint64_t theirs_clock = 0;  ///< of the first change of the inputs that both have
  std::size_t changes = 0;         ///< that both have
};

Alignment alignment_at(std::int64_t shift, const std::vector<InputChange>& theirs,
                       const std::vector<InputChange>& ours) {
  Alignment result;
  result.shift = shift;
  auto our = ours.begin();
  for (const InputChange& their : theirs) {
    const auto wanted = static_cast<std::int64_t>(their.clock) - shift;
    while (our != ours.end() && static_cast<std::int64_t>(our->clock) < wanted) ++our;
    if (our == ours.end()) break;
    if (static_cast<std::int64_t>(our->clock) != wanted || our->signature != their.signature)
      continue;
    if (result.changes++ == 0) result.theirs_clock = their.clock;
  }
  return result;
}

Alignment align(const std::string& theirs_file, const std::string& ours_file, PortMap& map) {
  Sampler theirs(theirs_file, map, false), ours(ours_file, map, true);
  for (std::size_t i = 0; i < map.ports.size(); ++i) {
    map.ports[i].width = ours.width(i);
    if (theirs.width(i) == ours.width(i)) continue;
    throw vp::InputError(map.ports[i].place + ": '" + map.ports[i].ours + "' has " +
                         std::to_string(ours.width(i)) + " bits, '" + map.ports[i].theirs +
                         "' has " + std::to_string(theirs.width(i)) +
                         ": name signals of the same width");
  }
  const auto their_changes = input_changes(theirs, map), our_changes = input_changes(ours, map);
  Alignment best;
  for (const std::int64_t shift : likely_shifts(their_changes, our_changes)) {
    const Alignment found = alignment_at(shift, their_changes, our_changes);
    if (found.changes > best.changes) best = found;
  }
  if (best.changes != 0) return best;
  throw vp::InputError(
      "the inputs of '" + theirs_file + "' (" + std::to_string(their_changes.size()) +
      " changes on " + std::to_string(theirs.edge().clock) + " clocks) and of '" + ours_file +
      "' (" + std::to_string(our_changes.size()) + " on " + std::to_string(ours.edge().clock) +
      ") have no change in common, so nothing can be compared: give both the same stimulus");
}

/// Goes through both traces side by side.
class Comparison {
 public:
  Comparison(const std::string& theirs, const std::string& ours, const PortMap& map)
      : map_(map), theirs_(theirs, map, false), ours_(ours, map, true) {
    looked_at_.resize(map_.ports.size());
    first_.resize(map_.ports.size());
  }

  PortComparison run(const Alignment& alignment) {
    // The change itself, and what stood before it.
    go_to(theirs_, alignment.theirs_clock - 1);
    go_to(ours_, alignment.theirs_clock - 1 - static_cast<std::uint64_t>(alignment.shift));
    result_.theirs_begin = theirs_.behind();
    result_.ours_begin = ours_.behind();
    unsigned clocks_left = clocks_behind;
    do {
      if (result_.values.empty()) compare();
      note();
    } while ((result_.values.empty() || clocks_left-- != 0) && theirs_.next() && ours_.next());
    for (std::size_t i = 0; i < map_.ports.size(); ++i) {
      if (looked_at_[i] == 0) result_.never_compared.push_back(map_.ports[i].ours);
      if (looked_at_[i] == 1 && !map_.ports[i].input) {
        result_.never_changed.push_back(map_.ports[i].ours);
      }
    }
    if (!result_.values.empty()) result_.around.assign(clocks_.begin(), clocks_.end());
    for (const Sampler* trace : {&theirs_, &ours_}) {
      for (const std::string& warning : warnings_of(trace->file()))
        result_.warnings.push_back(warning);
    }
    return result_;
  }

 private:
  static constexpr unsigned clocks_before = 32, clocks_behind = 8;

  static bool is_known(const std::string& bits) {
    return bits.find_first_not_of("01") == std::string::npos;
  }
  static void go_to(Sampler& trace, std::uint64_t clock) {
    while (trace.edge().clock < clock && trace.next()) continue;
  }

  void compare() {
    ++result_.clocks;
    for (std::size_t i = 0; i < map_.ports.size(); ++i) {
      const PortMap::Port& port = map_.ports[i];
      if (!ours_.valid(i)) continue;
      const std::string &their = theirs_.port(i), &our = ours_.port(i);
      if (first_[i].empty()) first_[i] = our;
      // A register that no reset has reached yet.
      if (looked_at_[i] == 0 && !is_known(their) && our == first_[i]) continue;
      if (looked_at_[i] < 2) looked_at_[i] = our == first_[i] ? 1 : 2;
      if (their == our) continue;
      const auto shown = [&](const std::string& text) {
        return (port.width > 1 ? "0x" : "") +
               readable(text, vp::WaveVariable::Kind::bits, port.width);
      };
      result_.values.push_back({port.ours, shown(their), shown(our), port.input});
    }
    if (result_.values.empty()) return;
    result_.theirs = theirs_.behind();
    result_.ours = ours_.behind();
  }

  void note() {
    PortComparison::Clock clock{
        theirs_.behind(), ours_.behind(), ours_.edge().ps, {}, !result_.values.empty()};
    for (std::size_t i = 0; i < map_.ports.size(); ++i) {
      clock.values.push_back(theirs_.port(i));
      clock.values.push_back(ours_.port(i));
    }
    clocks_.push_back(std::move(clock));
    if (result_.values.empty() && clocks_.size() > clocks_before) clocks_.pop_front();
  }

  const PortMap& map_;
  Sampler theirs_, ours_;
  std::vector<unsigned> looked_at_;  ///< by port: 0 never, 1 with one value, 2 with several
  std::vector<std::string> first_;
  std::deque<PortComparison::Clock> clocks_;
  PortComparison result_;
};

/// The first four of `paths` are clk, differs, and both numbers of the clock; ports follow.
void write_clocks(const PortComparison& comparison, const std::vector<std::string>& paths,
                  const std::vector<unsigned>& widths, const std::string& file) {
  const auto writer = vp::open_wave_writer(file);
  for (std::size_t i = 0; i < paths.size(); ++i)
    writer->add(paths[i], vp::WaveWriter::Kind::wire, widths[i]);
  vp::WaveWriter::WrittenValues none(paths.size());
  std::fill_n(none.begin(), 4, "0");
  writer->begin_written(comparison.around.front().ours.ps, none);
  for (const PortComparison::Clock& clock : comparison.around) {
    writer->set_time(clock.ours.ps);
    writer->change(0, 1);
    writer->change(1, clock.differs);
    writer->change(2, clock.theirs.clock);
    writer->change(3, clock.ours.clock);
    for (std::size_t i = 0; i < clock.values.size(); ++i)
      writer->change_digits(static_cast<vp::WaveWriter::Id>(4 + i), clock.values[i]);
    writer->set_time(clock.ours.ps + (clock.until_ps - clock.ours.ps) / 2);
    writer->change(0, 0);
  }
  writer->close(comparison.around.back().until_ps);
}

}  // namespace

PortMap read_port_map(const std::string& file) {
  return PortMapReader(file).read();
}

PortComparison compare_ports(const std::string& theirs, const std::string& ours, PortMap& map) {
  for (const std::string& file : {theirs, ours}) {
    std::error_code ignored;
    if (std::filesystem::is_fifo(file, ignored))
      throw vp::InputError("trace '" + file + "' is a pipe, and is read twice: make it a file");
  }
  const Alignment alignment = align(theirs, ours, map);
  return Comparison(theirs, ours, map).run(alignment);
}

void write_comparison(const PortComparison& comparison, const PortMap& map,
                      const std::string& page) {
  std::vector<std::string> paths{"clk", "differs", "theirs.clock_count", "ours.clock_count"};
  std::vector<unsigned> widths{1, 1, 64, 64};
  for (const PortMap::Port& port : map.ports) {
    for (const char* side : {"theirs.", "ours."}) {
      paths.push_back(side + port.ours);
      widths.push_back(port.width);
    }
  }
  const std::string trace = page + ".vcd";
  write_clocks(comparison, paths, widths, trace);
  const TraceFile file(trace);
  SaveFile save;
  save.comment = "theirs and ours, in the time of ours";
  save.lines = save_lines(file, paths);
  save.marker_ps = comparison.ours.ps;
  save.start_ps = comparison.around.front().ours.ps;
  save.end_ps = comparison.around.back().until_ps;
  vp::write_file(page + ".gtkw", save_file_text(save));
}

}  // namespace platform::trace
