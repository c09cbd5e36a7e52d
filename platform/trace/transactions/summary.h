#pragma once

#include <trace/statistics.h>
#include <trace/transactions/transactions.h>

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace platform::trace {

/// How often each of many lengths occurred, in bounded memory. Exact as long as there are at most
/// 4096 different ones; beyond that, lengths are kept to 10 bits (less than 0.2 % too small).
class Histogram {
 public:
  void add(std::uint64_t length);
  std::uint64_t count() const { return count_; }
  std::uint64_t least() const { return least_; }
  std::uint64_t most() const { return most_; }
  double mean() const { return count_ == 0 ? 0 : sum_ / static_cast<double>(count_); }
  /// The length that `percent` of all do not exceed.
  std::uint64_t percentile(unsigned percent) const;
  /// Lengths and how often, ascending.
  const std::map<std::uint64_t, std::uint64_t>& all() const { return lengths_; }

 private:
  static std::uint64_t rounded(std::uint64_t length);

  std::map<std::uint64_t, std::uint64_t> lengths_;
  bool exact_ = true;
  std::uint64_t count_ = 0, least_ = 0, most_ = 0;
  double sum_ = 0;
};

/// Counts and latencies of transactions, by bus and operation.
class TransactionSummary {
 public:
  explicit TransactionSummary(const Survey& survey) : survey_(survey) {}

  void add(const Transaction& transaction);
  std::uint64_t count() const { return count_; }
  /// "summary" and "latency".
  std::vector<Table> tables() const;

 private:
  struct Group {
    std::uint64_t count = 0, open = 0, failed = 0, broken = 0, bytes = 0, beats = 0;
    std::uint64_t most_outstanding = 0, first_ps = 0, last_ps = 0;
    Histogram latency;  ///< ps
    Histogram lengths;  ///< clocks, or ns of a bus without a clock
  };
  const Survey& survey_;
  std::uint64_t count_ = 0;
  std::map<std::pair<std::uint32_t, std::string>, Group> groups_;
};

/// "interfaces" and "left_out".
std::vector<Table> interface_tables(const Survey& survey);
/// "errors" and "waiting".
std::vector<Table> end_tables(const Survey& survey, const TransactionsEnd& end);

}  // namespace platform::trace
