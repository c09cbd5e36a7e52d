#include <trace/transactions/json_rows.h>

#include <utility>

namespace platform::trace {

TransactionsJson::TransactionsJson(Write write) : write_(std::move(write)) {
  write_("{\n  \"transactions\": [");
}

void TransactionsJson::add(const Transaction& one, const SurveyedInterface& surveyed) {
  std::string row = count_++ == 0 ? "\n    {" : ",\n    {";
  const char* separator = "";
  for (const TransactionField& field : transaction_fields()) {
    const std::string text = field_text(field, one, surveyed);
    if (text.empty()) continue;
    const bool number =
        field.type == TransactionField::Type::number || field.type == TransactionField::Type::time;
    row += separator + json_text(column_name(field)) + ": " + (number ? text : json_text(text));
    separator = ", ";
  }
  write_(row + "}");
}

void TransactionsJson::close(const std::vector<Table>& tables, const std::string& hang) {
  write_(count_ == 0 ? "],\n" : "\n  ],\n");
  write_("  \"hang\": " + json_text(hang) + ",");
  // The object of the tables without its first bracket.
  write_(tables_as_json(tables).substr(1));
}

}  // namespace platform::trace
