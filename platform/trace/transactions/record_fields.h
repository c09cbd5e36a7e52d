#pragma once

#include <trace/statistics.h>
#include <trace/transactions/survey.h>
#include <vp/expression.h>

#include <optional>
#include <string>
#include <vector>

namespace platform::trace {

/// A field of a transaction: a column, a key of JSON, and a name in conditions.
struct TransactionField {
  enum class Type : std::uint8_t { text, number, hexadecimal, time };
  struct Value {
    std::uint64_t number = 0;  ///< a time in ps
    std::string text;
  };
  const char* name;
  Type type;
  const char* meaning;
  /// None: the transaction has no such thing.
  std::optional<Value> (*value)(const Transaction&, const SurveyedInterface&);
};

/// All of them, in the order of the columns.
const std::vector<TransactionField>& transaction_fields();
/// A name for a column: times get "_ps".
std::string column_name(const TransactionField& field);
/// A value for programs: times in ps, addresses in hexadecimal; empty: none.
std::string field_text(const TransactionField& field, const Transaction& transaction,
                       const SurveyedInterface& surveyed);

/// A condition over the fields of a transaction: "operation == 'read' and latency > 2 us". The
/// name of a rule counts how often it was broken in the transaction.
class TransactionCondition {
 public:
  /// Throws vp::InputError for names that are no fields, and units that do not go together.
  explicit TransactionCondition(const std::string& text);
  bool holds(const Transaction& transaction, const SurveyedInterface& surveyed) const;

 private:
  vp::Expression expression_;
};

}  // namespace platform::trace
