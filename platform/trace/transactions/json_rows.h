#pragma once

#include <trace/transactions/record_fields.h>

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace platform::trace {

/// Transactions as one object of JSON, written as they come: numbers as numbers, what is missing is
/// left out; beside them tables.
class TransactionsJson {
 public:
  using Write = std::function<void(std::string_view)>;
  explicit TransactionsJson(Write write);
  void add(const Transaction& one, const SurveyedInterface& surveyed);
  /// With the tables, which are keys of their own, and who waits for whom; empty: something moves.
  void close(const std::vector<Table>& tables, const std::string& hang);

 private:
  Write write_;
  std::uint64_t count_ = 0;
};

}  // namespace platform::trace
