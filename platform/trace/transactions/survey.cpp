#include <trace/transactions/survey.h>

#include <algorithm>
#include <array>
#include <map>
#include <tuple>
#include <utility>

#include <trace/transactions/signal_name.h>
#include <vp/error.h>
#include <vp/text.h>
#include <vp/unit.h>

namespace platform::trace {

namespace {

constexpr std::uint64_t change_hash_start = 0xcbf29ce484222325, change_hash_prime = 0x100000001b3;

/// The signals whose changes tell the clock.
std::vector<std::string> controls_of(BusKind kind) {
  switch (kind) {
    case BusKind::axi4:
    case BusKind::axi4_lite:
      return {"awvalid", "awready", "wvalid",  "wready", "bvalid",
              "bready",  "arvalid", "arready", "rvalid", "rready"};
    case BusKind::axi_stream:
      return {"tvalid", "tready"};
    case BusKind::apb:
      return {"psel", "penable", "pready"};
    case BusKind::wishbone:
      return {"cyc", "stb", "ack", "stall"};
    case BusKind::spi:
      return {"sclk", "mosi", "miso"};
    case BusKind::i2c:
      return {"scl", "sda"};
    case BusKind::uart:
    case BusKind::irq:
      break;
  }
  return {"line"};
}

/// A role that every bus of its kind has.
std::string first_role(const BusInterface& bus) {
  for (const char* role : {"awvalid", "arvalid", "tvalid", "penable", "cyc", "scl", "sclk"}) {
    if (bus.role(role)) return role;
  }
  return "line";
}

/// How a reset is called, and whether it is active low.
std::optional<bool> reset_of(const std::string& path) {
  std::string leaf;
  for (const char c : vp::lower(leaf_of(path))) {
    if (c != '_') leaf += c;
  }
  for (const char* end : {"resetn", "rstn", "resetni", "rstni", "resetb", "rstb"}) {
    if (vp::ends_with(leaf, end)) return true;
  }
  if (leaf == "nreset" || leaf == "nrst") return true;
  for (const char* end : {"reset", "rst", "rsti"}) {
    if (vp::ends_with(leaf, end)) return false;
  }
  return std::nullopt;
}

/// Edges of a serial line: the shortest low time, and the first lengths.
struct LineTimes {
  std::optional<std::uint64_t> changed_ps;
  std::uint64_t shortest_low_ps = 0;
  std::vector<std::uint64_t> lengths;

  void note(std::uint64_t ps, bool was_high) {
    constexpr std::size_t enough = 4096;
    if (changed_ps) {
      const std::uint64_t length = ps - *changed_ps;
      if (!was_high && length != 0 && (shortest_low_ps == 0 || length < shortest_low_ps))
        shortest_low_ps = length;
      if (lengths.size() < enough) lengths.push_back(length);
    }
    changed_ps = ps;
  }
  /// One bit, refined by the lengths of up to ten bits.
  std::uint64_t bit_ps() const {
    if (shortest_low_ps == 0) return 0;
    constexpr std::uint64_t longest = 10;
    std::uint64_t sum = 0, bits = 0;
    for (const std::uint64_t length : lengths) {
      const std::uint64_t n = (length + shortest_low_ps / 2) / shortest_low_ps;
      if (n == 0 || n > longest) continue;
      sum += length;
      bits += n;
    }
    return bits == 0 ? shortest_low_ps : (sum + bits / 2) / bits;
  }
};

/// A bus during the first reading.
struct Candidate {
  std::map<std::string, Replay::Slot> slots;  ///< by role
  std::vector<Replay::Slot> controls;
  std::vector<std::size_t> clocks;
  std::vector<ClockFit> fits;
  std::uint64_t changes = 0;
  std::optional<Replay::Slot> reset;
  std::uint64_t in_reset = 0, out_of_reset = 0;  ///< controls that rise
  LineTimes line;
  std::uint64_t after_high = 0, after_low = 0;  ///< data of SPI, behind which level of its clock
};

class Surveyor final : public Replay::Listener {
 public:
  Surveyor(TraceFile& file, FoundInterfaces found, const StatisticsOptions& options,
           std::uint64_t to_ps)
      : file_(file), found_(std::move(found)), replay_(file), clocks_(replay_, file, options) {
    replay_.keep_texts();
    replay_.end_at(to_ps);
    find_resets();
    for (std::size_t i = 0; i < found_.interfaces.size(); ++i) follow(i);
  }

  Survey run() {
    replay_.run(*this);
    join_copies();
    Survey result;
    result.last_ps = replay_.last_ps();
    result.left_out = std::move(found_.left_out);
    for (std::size_t i = 0; i < found_.interfaces.size(); ++i) {
      if (!copy_[i]) conclude(i, result);
    }
    return result;
  }

 private:
  void find_resets();
  void follow(std::size_t place);
  bool instant(std::uint64_t ps) override;
  void note(Candidate& one, const BusInterface& bus, Replay::Slot slot, std::uint64_t ps);
  void note_spi(Candidate& one, Replay::Slot slot);
  void join_copies();
  bool same(std::size_t a, std::size_t b) const;
  void conclude(std::size_t place, Survey& result);
  std::map<std::size_t, std::uint64_t> weights(const Candidate& one) const {
    std::map<std::size_t, std::uint64_t> weight;
    for (std::size_t i = 0; i < one.clocks.size(); ++i)
      weight[one.clocks[i]] += one.fits[i].weight();
    return weight;
  }

  TraceFile& file_;
  FoundInterfaces found_;
  Replay replay_;
  ClockSet clocks_;
  std::vector<std::pair<std::uint32_t, bool>> resets_;  ///< variable, active low
  std::vector<Candidate> candidates_;                   ///< by interface
  std::vector<std::vector<std::uint32_t>> users_;       ///< interfaces by slot of a control
  std::vector<std::uint64_t> hash_;                     ///< by slot, of all changes
  std::vector<bool> copy_;
};

void Surveyor::find_resets() {
  for (std::uint32_t i = 0; i < file_.paths().size(); ++i) {
    if (file_.variable(i).width != 1) continue;
    if (const auto low = reset_of(file_.paths()[i])) resets_.emplace_back(i, *low);
  }
}

void Surveyor::follow(std::size_t place) {
  BusInterface& bus = found_.interfaces[place];
  candidates_.emplace_back();
  Candidate& one = candidates_.back();
  const std::vector<std::string> controls = controls_of(bus.kind);
  for (const auto& [role, variable] : bus.roles) {
    const Replay::Slot slot = replay_.watch(variable);
    one.slots[role] = slot;
    if (std::find(controls.begin(), controls.end(), role) == controls.end()) continue;
    one.controls.push_back(slot);
    if (users_.size() <= slot) users_.resize(slot + 1);
    users_[slot].push_back(static_cast<std::uint32_t>(place));
  }
  if (!is_clocked(bus.kind)) return;
  one.clocks = clocks_.candidates({bus.name});
  one.fits.resize(one.clocks.size());
  // The reset nearest above it, of the same prefix if there are several.
  std::size_t best = 0;
  for (const auto& [variable, low] : resets_) {
    const std::string& path = file_.paths()[variable];
    const std::string_view scope = scope_of(path);
    const bool above =
        bus.scope.compare(0, scope.size(), scope) == 0 &&
        (scope.empty() || bus.scope.size() == scope.size() || bus.scope[scope.size()] == '.');
    if (!above) continue;
    const auto same = std::mismatch(path.begin(), path.end(), bus.name.begin(), bus.name.end());
    const auto near = static_cast<std::size_t>(same.first - path.begin()) + 1;
    if (near <= best) continue;
    best = near;
    bus.reset = variable;
    bus.reset_low = low;
  }
  if (bus.reset) one.reset = replay_.watch(*bus.reset);
}

bool Surveyor::instant(std::uint64_t ps) {
  clocks_.instant(ps);
  for (const Replay::Slot slot : replay_.changed()) {
    const std::string_view now = shortest_digits(replay_.text(slot));
    if (now == shortest_digits(replay_.text_before(slot))) continue;
    if (hash_.size() <= slot) hash_.resize(slot + 1, change_hash_start);
    std::uint64_t& hash = hash_[slot];
    hash = (hash ^ ps) * change_hash_prime;
    for (const char c : now) hash = (hash ^ static_cast<unsigned char>(c)) * change_hash_prime;
    if (slot >= users_.size()) continue;
    for (const std::uint32_t user : users_[slot])
      note(candidates_[user], found_.interfaces[user], slot, ps);
  }
  return true;
}

void Surveyor::note(Candidate& one, const BusInterface& bus, Replay::Slot slot, std::uint64_t ps) {
  if (bus.kind == BusKind::uart)
    one.line.note(ps, replay_.was_known(slot) && replay_.bits_before(slot) != 0);
  if (bus.kind == BusKind::spi) note_spi(one, slot);
  if (!replay_.known(slot) || !replay_.was_known(slot)) return;
  ++one.changes;
  for (std::size_t i = 0; i < one.clocks.size(); ++i) one.fits[i].note(clocks_[one.clocks[i]], ps);
  if (!one.reset || replay_.bits(slot) == 0 || !replay_.was_known(*one.reset)) return;
  const bool active = (replay_.bits_before(*one.reset) == 0) == bus.reset_low;
  ++(active ? one.in_reset : one.out_of_reset);
}

/// Which level of the clock data change behind tells on which they are sampled.
void Surveyor::note_spi(Candidate& one, Replay::Slot slot) {
  const Replay::Slot clock = one.slots.at("sclk");
  if (slot == clock) return;
  ++(replay_.bits(clock) != 0 ? one.after_high : one.after_low);
}

/// All that both have is the same net, or changes alike.
bool Surveyor::same(std::size_t a, std::size_t b) const {
  const auto hash = [&](Replay::Slot slot) {
    return slot < hash_.size() ? hash_[slot] : change_hash_start;
  };
  for (const auto& [role, slot] : candidates_[a].slots) {
    const auto other = candidates_[b].slots.find(role);
    if (other == candidates_[b].slots.end() || other->second == slot) continue;
    if (hash(slot) != hash(other->second)) return false;
  }
  return true;
}

void Surveyor::join_copies() {
  auto& all = found_.interfaces;
  copy_.assign(all.size(), false);
  std::vector<std::size_t> order(all.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  // What lacks READY is a part of a bus that has it.
  const auto rank = [&](std::size_t i) {
    const bool half = all[i].role("tvalid") && !all[i].role("tready");
    const auto dots = std::count(all[i].name.begin(), all[i].name.end(), '.');
    return std::make_tuple(half, dots, -static_cast<std::ptrdiff_t>(all[i].roles.size()));
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  std::map<std::pair<BusKind, std::uint64_t>, std::vector<std::size_t>> kept;
  for (const std::size_t i : order) {
    // Of two that never change only the net tells that they are one.
    const Replay::Slot first = candidates_[i].slots.at(first_role(all[i]));
    const bool moves = candidates_[i].changes != 0 && first < hash_.size();
    const std::uint64_t key = moves ? hash_[first] : first;
    auto& like = kept[{all[i].kind, key}];
    const auto original =
        std::find_if(like.begin(), like.end(), [&](std::size_t other) { return same(other, i); });
    if (original == like.end()) {
      like.push_back(i);
      continue;
    }
    copy_[i] = true;
    all[*original].copies.push_back({all[i].name, all[i].scope, all[i].side});
  }
}

void Surveyor::conclude(std::size_t place, Survey& result) {
  const Candidate& one = candidates_[place];
  SurveyedInterface surveyed;
  surveyed.bus = std::move(found_.interfaces[place]);
  BusInterface& bus = surveyed.bus;
  if (one.in_reset > one.out_of_reset) bus.reset.reset();  // it is no reset, or the other way round
  surveyed.bit_ps = one.line.bit_ps();
  if (one.after_high != one.after_low) surveyed.data_after_high = one.after_high > one.after_low;
  if (!is_clocked(bus.kind)) {
    result.interfaces.push_back(std::move(surveyed));
    return;
  }
  const bool named = one.clocks.size() == 1;
  const std::size_t best = clocks_.best(one.clocks, one.fits, weights(one), one.changes);
  surveyed.clock_text = clocks_.text(one.clocks[best]);
  if (!named && !one.fits[best].fits(one.changes)) {
    result.left_out.push_back({bus.name, std::to_string(one.changes - one.fits[best].explained()) +
                                             " of " + std::to_string(one.changes) +
                                             " changes do not follow the clock " +
                                             surveyed.clock_text + ": name it with --clock " +
                                             std::string(leaf_of(bus.name)) + "=SIGNAL"});
    return;
  }
  surveyed.clock_ps = static_cast<std::uint64_t>(clocks_[one.clocks[best]].period_s() * ps_per_s);
  if (const auto wire = clocks_.wire(one.clocks[best])) {
    surveyed.clock = wire->first;
    surveyed.falling = wire->second;
  }
  result.interfaces.push_back(std::move(surveyed));
}

}  // namespace

bool counts_clocks(const SurveyedInterface& surveyed) {
  return is_clocked(surveyed.bus.kind) && !surveyed.clock_text.empty();
}

bool is_clocked(BusKind kind) {
  return kind != BusKind::uart && kind != BusKind::i2c && kind != BusKind::spi &&
         kind != BusKind::irq;
}

Survey survey(TraceFile& file, FoundInterfaces found, const StatisticsOptions& clocks,
              std::uint64_t to_ps) {
  return Surveyor(file, std::move(found), clocks, to_ps).run();
}

}  // namespace platform::trace
