#include <trace/transactions/summary.h>

#include <algorithm>

#include <trace/transactions/record_fields.h>
#include <vp/text.h>

namespace platform::trace {

namespace {

constexpr double ps_per_ns = 1e3;
constexpr double bytes_in_megabyte = 1e6;

double in_ns(std::uint64_t ps) {
  return static_cast<double>(ps) / ps_per_ns;
}

bool is_failure(const std::string& response) {
  return response == "SLVERR" || response == "DECERR" || response == "NACK" || response == "ERR";
}

/// Ranges that double: 0, 1, 2 to 3, 4 to 7, …
void add_ranges(Table& table, const std::string& interface, const std::string& operation,
                const std::string& unit, const Histogram& lengths) {
  constexpr std::uint64_t longest_bar = 40;
  std::map<std::uint64_t, std::uint64_t> ranges;  ///< by first length
  for (const auto& [length, count] : lengths.all()) {
    std::uint64_t first = length == 0 ? 0 : 1;
    while (first != 0 && first <= length / 2) first *= 2;
    ranges[first] += count;
  }
  std::uint64_t most = 1;
  for (const auto& [first, count] : ranges) most = std::max(most, count);
  for (const auto& [first, count] : ranges) {
    const std::uint64_t last = first == 0 ? 0 : std::min(first * 2 - 1, lengths.most());
    const auto bar = static_cast<std::size_t>(
        (static_cast<unsigned __int128>(count) * longest_bar + most - 1) / most);
    table.rows.push_back({interface, operation, unit, std::max(first, lengths.least()), last, count,
                          std::string(bar, '#')});
  }
}

}  // namespace

std::uint64_t Histogram::rounded(std::uint64_t length) {
  constexpr std::uint64_t kept = 1U << 10U;
  unsigned shift = 0;
  while (length >> shift >= kept) ++shift;
  return length >> shift << shift;
}

void Histogram::add(std::uint64_t length) {
  constexpr std::size_t most_exact = 4096;
  least_ = count_ == 0 ? length : std::min(least_, length);
  most_ = std::max(most_, length);
  sum_ += static_cast<double>(length);
  ++count_;
  ++lengths_[exact_ ? length : rounded(length)];
  if (!exact_ || lengths_.size() <= most_exact) return;
  exact_ = false;
  std::map<std::uint64_t, std::uint64_t> coarse;
  for (const auto& [each, count] : lengths_) coarse[rounded(each)] += count;
  lengths_ = std::move(coarse);
}

std::uint64_t Histogram::percentile(unsigned percent) const {
  constexpr unsigned all = 100;
  const std::uint64_t wanted = (count_ * percent + all - 1) / all;
  std::uint64_t seen = 0;
  for (const auto& [length, count] : lengths_) {
    seen += count;
    if (seen >= wanted) return length;
  }
  return most_;
}

void TransactionSummary::add(const Transaction& one) {
  ++count_;
  Group& group = groups_[{one.interface, one.operation}];
  if (group.count++ == 0) group.first_ps = one.begin_ps;
  group.bytes += one.bytes;
  group.beats += one.beats_done;
  group.failed += is_failure(one.response) ? 1 : 0;
  group.broken += one.violations.empty() ? 0 : 1;
  group.most_outstanding = std::max(group.most_outstanding, one.outstanding + 1);
  group.first_ps = std::min(group.first_ps, one.begin_ps);
  if (!one.end_ps) {
    ++group.open;
    return;
  }
  group.last_ps = std::max(group.last_ps, *one.end_ps);
  const std::uint64_t ps = *one.end_ps - std::min(one.begin_ps, *one.end_ps);
  group.latency.add(ps);
  const bool clocked = counts_clocks(survey_.interfaces[one.interface]);
  group.lengths.add(clocked ? one.end_cycle - one.begin_cycle
                            : ps / static_cast<std::uint64_t>(ps_per_ns));
}

std::vector<Table> TransactionSummary::tables() const {
  Table summary{
      "summary",
      "Summary (latencies in ns, from the request to the last response)",
      {"interface", "operation", "transactions", "open", "failed", "with_errors", "beats", "bytes",
       "mb_per_s", "outstanding", "least_ns", "median_ns", "mean_ns", "p99_ns", "most_ns"},
      {},
      false};
  Table latency{"latency",
                "Latencies",
                {"interface", "operation", "unit", "from", "to", "transactions", "share"},
                {},
                false};
  constexpr unsigned half = 50, nearly_all = 99;
  for (const auto& [key, group] : groups_) {
    const SurveyedInterface& surveyed = survey_.interfaces[key.first];
    const double seconds =
        static_cast<double>(group.last_ps - std::min(group.first_ps, group.last_ps)) / ps_per_s;
    const double rate =
        seconds > 0 ? static_cast<double>(group.bytes) / seconds / bytes_in_megabyte : 0;
    const Histogram& all = group.latency;
    summary.rows.push_back({surveyed.bus.name, key.second, group.count, group.open, group.failed,
                            group.broken, group.beats, group.bytes, rate, group.most_outstanding,
                            in_ns(all.least()), in_ns(all.percentile(half)), all.mean() / ps_per_ns,
                            in_ns(all.percentile(nearly_all)), in_ns(all.most())});
    add_ranges(latency, surveyed.bus.name, key.second, counts_clocks(surveyed) ? "clocks" : "ns",
               group.lengths);
  }
  return {summary, latency};
}

std::vector<Table> interface_tables(const Survey& survey) {
  Table found{
      "interfaces", "Buses", {"interface", "kind", "clock", "reset", "also_called"}, {}, false};
  for (const SurveyedInterface& one : survey.interfaces) {
    std::vector<std::string> copies;
    for (const auto& copy : one.bus.copies) copies.push_back(copy.name);
    std::string clock = one.clock_text;
    if (one.bus.kind == BusKind::uart && one.bit_ps != 0) {
      constexpr std::uint64_t second = 1'000'000'000'000;
      clock = std::to_string((second + one.bit_ps / 2) / one.bit_ps) + " baud measured";
    }
    const char* reset = !one.bus.reset ? "" : one.bus.reset_low ? "low" : "high";
    found.rows.push_back({one.bus.name, std::string(bus_kind_name(one.bus.kind)), clock,
                          std::string(reset), vp::join(copies, " ")});
  }
  Table left_out{"left_out", "Left out", {"interface", "reason"}, {}, false};
  for (const LeftOut& one : survey.left_out) left_out.rows.push_back({one.name, one.reason});
  return {found, left_out};
}

std::vector<Table> end_tables(const Survey& survey, const TransactionsEnd& end) {
  Table errors{"errors",
               "Rules that were broken",
               {"interface", "rule", "times", "first_at_us", "cycle", "detail"},
               {},
               false};
  for (const BrokenRule& one : end.broken) {
    errors.rows.push_back({survey.interfaces[one.interface].bus.name, one.rule, one.count,
                           static_cast<double>(one.first.ps) / ps_per_us, one.first.cycle,
                           one.first.detail});
  }
  Table waiting{
      "waiting",
      "Waiting at the end",
      {"interface", "channel", "state", "waits_for", "since_us", "clocks", "ready_low_since_cycle"},
      {},
      false};
  for (const Wait& one : end.waits) {
    waiting.rows.push_back(
        {survey.interfaces[one.interface].bus.name, one.channel,
         std::string(one.state == Wait::State::wants ? "wants" : "starved"), one.what,
         static_cast<double>(one.since_ps) / ps_per_us, one.clocks,
         one.idle_since_cycle ? std::to_string(*one.idle_since_cycle) : std::string()});
  }
  return {errors, waiting};
}

}  // namespace platform::trace
