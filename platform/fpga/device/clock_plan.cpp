#include <fpga/device/clock_plan.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <vp/error.h>
#include <vp/text.h>

namespace platform::device {

namespace {

/// Deviations that differ by less are equal: a crystal written as 33.3333 MHz is no other one.
constexpr double equal_hz = 1;

double with_tolerance(double hz) {
  return hz * (1 + crystal_tolerance);
}

double deviation(const MadeClock& clock, double wish_hz) {
  return std::abs(clock.hz - wish_hz);
}

/// Finds the least of values that come one after the other; of equal ones the last.
class Least {
 public:
  /// Whether `value` is the best so far.
  bool takes(double value) {
    if (!empty_ && value > least_ + equal_hz) return false;
    least_ = empty_ ? value : std::min(least_, value);
    empty_ = false;
    return true;
  }

 private:
  double least_ = 0;
  bool empty_ = true;
};

/// Of two numbers up to `largest`, ascending. Found once: each point of a sweep plans its clocks.
const std::vector<unsigned>& products(unsigned largest) {
  static std::map<unsigned, std::vector<unsigned>> known;
  std::vector<unsigned>& found = known[largest];
  if (!found.empty()) return found;
  std::vector<bool> is_product(largest * largest + 1);
  for (unsigned a = 1; a <= largest; ++a) {
    for (unsigned b = 1; b <= a; ++b) is_product[a * b] = true;
  }
  for (unsigned n = 1; n < is_product.size(); ++n) {
    if (is_product[n]) found.push_back(n);
  }
  return found;
}

Pll usual_pll(Divider divider) {
  if (divider == Divider::cpu) return Pll::arm;
  return divider == Divider::ddr ? Pll::ddr : Pll::io;
}

}  // namespace

bool same_frequency(double hz, double wish_hz) {
  return std::abs(hz - wish_hz) <= crystal_tolerance * wish_hz;
}

const char* to_string(Pll pll) {
  switch (pll) {
    case Pll::arm:
      return "ARM";
    case Pll::ddr:
      return "DDR";
    case Pll::io:
      return "I/O";
  }
  return "";
}

const char* to_string(Effort effort) {
  switch (effort) {
    case Effort::planned:
      return "by the vendor's tool";
    case Effort::other_source:
      return "with that PLL as its source";
    case Effort::other_feedback:
      return "PLL set by hand, other I/O clocks move";
    case Effort::no_ethernet:
      return "PLL set by hand, no Ethernet";
  }
  return "";
}

std::vector<IoClient> board_clients(bool ethernet) {
  constexpr double pcap = 200e6, qspi = 200e6, sd_card = 50e6, ethernet_hz = 125e6;
  std::vector<IoClient> clients{{pcap}, {qspi}, {sd_card}, {uart_wish_hz}};
  if (ethernet) clients.push_back({ethernet_hz, Divider::pair, true});
  return clients;
}

ClockPlanner::ClockPlanner(const Device& device, double crystal_hz)
    : device_(device),
      crystal_hz_(crystal_hz),
      largest_divisor_(static_cast<unsigned>(device.divisor_max.value)) {
  const double mhz = crystal_hz / hz_per_mhz;
  if (!(mhz >= device.crystal_min_mhz.value && mhz <= device.crystal_max_mhz.value)) {
    throw vp::InputError("a crystal of " + vp::format_fixed(mhz, 3) + " MHz: " + device.name() +
                         " takes " + vp::format_fixed(device.crystal_min_mhz.value, 0) + " to " +
                         vp::format_fixed(device.crystal_max_mhz.value, 0) + " MHz");
  }
  const auto feedback = [](double value) { return static_cast<unsigned>(value); };
  const double lowest = device.vco_min_mhz.value / mhz * (1 - crystal_tolerance);
  const double highest = device.vco_max_mhz.value / mhz * (1 + crystal_tolerance);
  least_feedback_ = std::max(feedback(device.pll_feedback_min.value), feedback(std::ceil(lowest)));
  most_feedback_ = std::min(feedback(device.pll_feedback_max.value), feedback(std::floor(highest)));
  for (unsigned d = 1; d <= largest_divisor_; ++d) {
    single_.push_back(d);
    if (d != 1 && d != 3) cpu_.push_back(d);
    if (d % 2 == 0) ddr_.push_back(d);
  }
  pair_ = products(largest_divisor_);
}

const std::vector<unsigned>& ClockPlanner::divisors(Divider divider) const {
  switch (divider) {
    case Divider::cpu:
      return cpu_;
    case Divider::ddr:
      return ddr_;
    case Divider::single:
      return single_;
    case Divider::pair:
      break;
  }
  return pair_;
}

// How the tool splits a divisor: where it meets the wish into two factors that are most alike, the
// larger first; else into the first divider alone, if that is large enough.
MadeClock ClockPlanner::made(unsigned feedback, double wish_hz, Divider divider,
                             unsigned divisor) const {
  MadeClock clock;
  clock.pll = usual_pll(divider);
  clock.feedback = feedback;
  clock.vco_hz = crystal_hz_ * feedback;
  clock.hz = clock.vco_hz / divisor;
  clock.divisor0 = divisor;
  const bool alone = divisor <= largest_divisor_;
  if (divider != Divider::pair || (alone && !same_frequency(clock.hz, wish_hz))) return clock;
  for (unsigned small = 1; small * small <= divisor; ++small) {
    if (divisor % small != 0 || divisor / small > largest_divisor_) continue;
    clock.divisor0 = divisor / small;
    clock.divisor1 = small;
  }
  return clock;
}

MadeClock ClockPlanner::nearest(unsigned feedback, double wish_hz, Divider divider,
                                std::optional<double> most_hz) const {
  const std::vector<unsigned>& all = divisors(divider);
  const double vco_hz = crystal_hz_ * feedback;
  const auto at_least = [&](double divisor) {
    return std::lower_bound(all.begin(), all.end(), divisor);
  };
  // The divisors on both sides of the one that would be exact.
  auto above = at_least(vco_hz / wish_hz);
  auto below = above == all.begin() ? above : std::prev(above);
  if (above == all.end()) above = below;
  if (most_hz) {
    const auto allowed = at_least(vco_hz / with_tolerance(*most_hz));
    if (allowed != all.end()) {
      below = std::max(below, allowed);
      above = std::max(above, allowed);
    }
  }
  const bool take_below =
      std::abs(vco_hz / *below - wish_hz) <= std::abs(vco_hz / *above - wish_hz);
  return made(feedback, wish_hz, divider, take_below ? *below : *above);
}

bool ClockPlanner::meets(unsigned feedback, const std::vector<IoClient>& clients) const {
  return std::all_of(clients.begin(), clients.end(), [&](const IoClient& client) {
    return !client.exact ||
           same_frequency(nearest(feedback, client.wish_hz, client.divider).hz, client.wish_hz);
  });
}

unsigned ClockPlanner::io_feedback(const std::vector<IoClient>& clients) const {
  unsigned best = most_feedback_;
  for (const bool only_exact : {true, false}) {
    Least least;
    bool found = false;
    for (unsigned feedback = least_feedback_; feedback <= most_feedback_; ++feedback) {
      if (only_exact && !meets(feedback, clients)) continue;
      double sum = 0;
      for (const IoClient& client : clients) {
        sum += deviation(nearest(feedback, client.wish_hz, client.divider), client.wish_hz);
      }
      if (least.takes(sum)) best = feedback;
      found = true;
    }
    if (found) break;
  }
  return best;
}

/// The limit, for a wish that respects it.
std::optional<double> ClockPlanner::most(double wish_hz, ClockKind kind) const {
  const double limit_hz = limit_of(device_, kind).value * hz_per_mhz;
  return wish_hz > with_tolerance(limit_hz) ? std::nullopt : std::optional<double>(limit_hz);
}

MadeClock ClockPlanner::own_pll(double wish_hz, ClockKind kind,
                                const std::vector<IoClient>& beside) const {
  const auto at = [&](unsigned feedback) {
    return nearest(feedback, wish_hz, divider_of(kind), most(wish_hz, kind));
  };
  MadeClock best = at(most_feedback_);
  Least least;
  for (unsigned feedback = least_feedback_; feedback <= most_feedback_; ++feedback) {
    if (!meets(feedback, beside)) continue;
    const MadeClock clock = at(feedback);
    if (least.takes(deviation(clock, wish_hz))) best = clock;
  }
  return best;
}

ClockPlan ClockPlanner::plan(const ClockWishes& wishes) const {
  ClockPlan plan;
  plan.cpu = own_pll(wishes.cpu_hz, wishes.ratio_621 ? ClockKind::cpu_621 : ClockKind::cpu_421);
  plan.ddr = own_pll(wishes.ddr_hz, ClockKind::ddr);
  std::vector<IoClient> clients = board_clients(wishes.ethernet);
  for (const double wish_hz : wishes.fclk_hz) clients.push_back({wish_hz, Divider::pair});
  plan.io_feedback = io_feedback(clients);
  for (const double wish_hz : wishes.fclk_hz) {
    plan.fclk.push_back(nearest(plan.io_feedback, wish_hz, Divider::pair));
  }
  plan.uart = nearest(plan.io_feedback, uart_wish_hz, Divider::single);
  return plan;
}

ClockPlanner::Neighbours ClockPlanner::neighbours(double wish_hz, ClockKind kind,
                                                  const ClockPlan& plan) const {
  const Divider divider = divider_of(kind);
  const std::vector<unsigned>& all = divisors(divider);
  const std::optional<double> most_hz = most(wish_hz, kind);
  const bool fixed = kind == ClockKind::fclk;
  const unsigned first = fixed ? plan.io_feedback : least_feedback_;
  const unsigned last = fixed ? plan.io_feedback : most_feedback_;
  Neighbours found;
  for (unsigned feedback = first; feedback <= last; ++feedback) {
    const double vco_hz = crystal_hz_ * feedback;
    const auto below = std::lower_bound(all.begin(), all.end(), vco_hz / (wish_hz + equal_hz / 2));
    if (below != all.end() && (!found.below || vco_hz / *below >= found.below->hz)) {
      found.below = made(feedback, wish_hz, divider, *below);
    }
    if (below == all.begin()) continue;
    const double above_hz = vco_hz / *std::prev(below);
    const bool allowed = !most_hz || above_hz <= with_tolerance(*most_hz);
    if (allowed && (!found.above || above_hz <= found.above->hz)) {
      found.above = made(feedback, wish_hz, divider, *std::prev(below));
    }
  }
  return found;
}

NearClock ClockPlanner::with_effort(MadeClock clock, const ClockPlan& plan, bool ethernet) const {
  if (clock.pll != Pll::io || clock.feedback == plan.io_feedback) return {clock, Effort::planned};
  for (const MadeClock& other : {plan.cpu, plan.ddr}) {
    if (clock.feedback != other.feedback) continue;
    clock.pll = other.pll;
    return {clock, Effort::other_source};
  }
  const bool keeps = meets(clock.feedback, board_clients(ethernet));
  return {clock, keeps ? Effort::other_feedback : Effort::no_ethernet};
}

std::vector<NearClock> ClockPlanner::near(double wish_hz, ClockKind kind, const ClockPlan& plan,
                                          bool ethernet, std::size_t count) const {
  const Divider divider = divider_of(kind);
  const std::vector<unsigned>& all = divisors(divider);
  const std::optional<double> most_hz = most(wish_hz, kind);
  std::vector<NearClock> found;
  for (unsigned feedback = most_feedback_; feedback >= least_feedback_; --feedback) {
    const auto middle = std::lower_bound(all.begin(), all.end(), crystal_hz_ * feedback / wish_hz);
    const auto before = static_cast<std::size_t>(middle - all.begin());
    const auto after = static_cast<std::size_t>(all.end() - middle);
    const auto end = middle + static_cast<std::ptrdiff_t>(std::min(after, count));
    for (auto d = middle - static_cast<std::ptrdiff_t>(std::min(before, count)); d != end; ++d) {
      const MadeClock clock = made(feedback, wish_hz, divider, *d);
      if (most_hz && clock.hz > with_tolerance(*most_hz)) continue;
      found.push_back(with_effort(clock, plan, ethernet));
    }
  }
  // Stable: of equal ones the highest PLL stays first.
  const auto rounded = [&](const NearClock& near) {
    return std::llround(deviation(near.clock, wish_hz) / equal_hz);
  };
  std::stable_sort(found.begin(), found.end(), [&](const NearClock& a, const NearClock& b) {
    return rounded(a) != rounded(b) ? rounded(a) < rounded(b) : a.effort < b.effort;
  });
  std::set<long long> listed;
  std::vector<NearClock> list;
  for (const NearClock& near : found) {
    if (list.size() == count) break;
    if (listed.insert(std::llround(near.clock.hz / equal_hz)).second) list.push_back(near);
  }
  return list;
}

bool ClockPlanner::makes(double hz, ClockKind kind) const {
  for (unsigned feedback = least_feedback_; feedback <= most_feedback_; ++feedback) {
    if (same_frequency(nearest(feedback, hz, divider_of(kind)).hz, hz)) return true;
  }
  return false;
}

const Figure& limit_of(const Device& device, ClockKind kind) {
  switch (kind) {
    case ClockKind::cpu_621:
      return device.cpu_621_mhz;
    case ClockKind::cpu_421:
      return device.cpu_421_mhz;
    case ClockKind::ddr:
      return device.ddr_mhz;
    case ClockKind::external:
      return device.clock_buffer_mhz;
    case ClockKind::fclk:
      break;
  }
  return device.fclk_mhz;
}

Divider divider_of(ClockKind kind) {
  if (kind == ClockKind::fclk) return Divider::pair;
  return kind == ClockKind::ddr ? Divider::ddr : Divider::cpu;
}

ClockVerdict judge(const ClockPlanner& planner, ClockKind kind, double hz) {
  const Figure& limit = limit_of(planner.device(), kind);
  ClockVerdict verdict;
  verdict.limit_hz = limit.value * hz_per_mhz;
  verdict.confidence = limit.confidence;
  if (hz > 0) {
    verdict.margin_percent = 100 * (verdict.limit_hz / hz - 1);
    verdict.within = hz <= with_tolerance(verdict.limit_hz);
    verdict.makeable = kind == ClockKind::external || planner.makes(hz, kind);
  }
  return verdict;
}

}  // namespace platform::device
