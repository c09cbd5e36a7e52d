#include <trace/transactions/record_fields.h>

#include <algorithm>
#include <array>

#include <trace/transactions/decoder.h>
#include <vp/error.h>
#include <vp/text.h>

namespace platform::trace {

namespace {

using Field = TransactionField;
using Type = Field::Type;
using Value = Field::Value;
using Found = std::optional<Value>;

Found text_of(const std::string& text) {
  return text.empty() ? Found() : Found(Value{0, text});
}

Found number_of(std::uint64_t number) {
  return Value{number, {}};
}

Found maybe(const std::optional<std::uint64_t>& number) {
  return number ? number_of(*number) : Found();
}

/// Clocks of waiting; none of a bus that has a clock which is not known.
Found waited(std::uint64_t clocks, const SurveyedInterface& surveyed) {
  const bool unknown = is_clocked(surveyed.bus.kind) && !counts_clocks(surveyed);
  return unknown ? Found() : number_of(clocks);
}

/// From one time to another, if both are there.
Found between(const std::optional<std::uint64_t>& from, const std::optional<std::uint64_t>& to) {
  return from && to && *to >= *from ? number_of(*to - *from) : Found();
}

std::string rules_of(const Transaction& one) {
  std::string text;
  for (const Violation& violation : one.violations) {
    text += (text.empty() ? "" : "; ") + violation.rule + " at " + std::to_string(violation.ps) +
            " ps: " + violation.detail;
  }
  return text;
}

/// How rules begin.
constexpr std::array<const char*, 8> rule_beginnings = {
    "AXI4_", "AXI4LITE_", "AXI4STREAM_", "APB_", "WISHBONE_", "UART_", "I2C_", "SPI_"};

bool is_rule(const std::string& name) {
  return std::any_of(rule_beginnings.begin(), rule_beginnings.end(),
                     [&](const char* begin) { return name.rfind(begin, 0) == 0; });
}

const Field& field_named(const std::string& name) {
  std::vector<std::string> names;
  for (const Field& field : transaction_fields()) {
    if (name == field.name) return field;
    names.emplace_back(field.name);
  }
  const std::string near = vp::nearest_match(name, names);
  throw vp::InputError(
      "'" + name + "' is no field of a transaction" +
      (near.empty() ? " (" + vp::join(names, ", ") + ")" : ": did you mean '" + near + "'?"));
}

vp::ExpressionValue as_value(const Field& field, const Found& found) {
  vp::ExpressionValue value;
  value.known = found.has_value();
  value.is_text = field.type == Type::text;
  if (field.type == Type::time) value.unit = vp::Unit::time;
  if (!found) return value;
  value.number = static_cast<long double>(found->number);
  value.text = found->text;
  return value;
}

}  // namespace

const std::vector<Field>& transaction_fields() {
  using T = const Transaction&;
  using S = const SurveyedInterface&;
  static const std::vector<Field> fields = {
      {"kind", Type::text, "of the bus", [](T, S s) { return text_of(bus_kind_name(s.bus.kind)); }},
      {"interface", Type::text, "its name", [](T, S s) { return text_of(s.bus.name); }},
      {"operation", Type::text, "read, write, packet, byte, transfer, interrupt",
       [](T t, S) { return text_of(t.operation); }},
      {"id", Type::number, "of AXI, TID, the bit of PSEL or of an interrupt vector",
       [](T t, S) { return maybe(t.id); }},
      {"address", Type::hexadecimal, "of the request; TDEST of a packet",
       [](T t, S) { return maybe(t.address); }},
      {"beats", Type::number, "asked for; of a packet those it has",
       [](T t, S) { return number_of(t.beats); }},
      {"beats_done", Type::number, "that passed", [](T t, S) { return number_of(t.beats_done); }},
      {"size", Type::number, "bytes a beat", [](T t, S) { return maybe(t.size); }},
      {"burst", Type::text, "FIXED, INCR, WRAP", [](T t, S) { return text_of(t.burst); }},
      {"bytes", Type::number, "that passed and were enabled",
       [](T t, S) { return number_of(t.bytes); }},
      {"data", Type::text, "of the first beats",
       [](T t, S) { return text_of(vp::join(t.data, " ")); }},
      {"data_hash", Type::hexadecimal, "of all beats (FNV-1a of their digits)",
       [](T t, S) { return t.beats_done == 0 ? Found() : number_of(t.data_hash); }},
      {"strobe", Type::text, "of all beats; mixed if they differ",
       [](T t, S) { return text_of(t.strobe); }},
      {"response", Type::text, "the worst of all beats",
       [](T t, S) { return text_of(t.response); }},
      {"begin", Type::time, "the request is valid", [](T t, S) { return number_of(t.begin_ps); }},
      {"accepted", Type::time, "the request is accepted",
       [](T t, S) { return maybe(t.accepted_ps); }},
      {"first_data", Type::time, "the first beat is accepted",
       [](T t, S) { return maybe(t.first_data_ps); }},
      {"last_data", Type::time, "the last beat is accepted",
       [](T t, S) { return maybe(t.last_data_ps); }},
      {"end", Type::time, "the last response is accepted", [](T t, S) { return maybe(t.end_ps); }},
      {"latency", Type::time, "from begin to end",
       [](T t, S) { return between(t.begin_ps, t.end_ps); }},
      {"first_latency", Type::time, "from begin to first_data",
       [](T t, S) { return between(t.begin_ps, t.first_data_ps); }},
      {"service", Type::time, "from accepted to end",
       [](T t, S) { return between(t.accepted_ps, t.end_ps); }},
      {"clocks", Type::number, "of latency",
       [](T t, S s) {
         return counts_clocks(s) && t.end_ps ? number_of(t.end_cycle - t.begin_cycle) : Found();
       }},
      {"request_wait", Type::number, "clocks until the request was accepted",
       [](T t, S s) { return waited(t.request_wait, s); }},
      {"data_wait", Type::number, "clocks that beats waited for READY",
       [](T t, S s) { return waited(t.data_wait, s); }},
      {"response_wait", Type::number, "clocks that the response waited, or the access",
       [](T t, S s) { return waited(t.response_wait, s); }},
      {"outstanding", Type::number, "earlier ones that were not over when it began",
       [](T t, S) { return number_of(t.outstanding); }},
      {"overtakes", Type::number, "of them those that were not over when it was",
       [](T t, S) { return number_of(t.overtakes); }},
      {"open", Type::number, "1: not over at the end of the trace",
       [](T t, S) { return number_of(t.end_ps ? 0 : 1); }},
      {"errors", Type::number, "rules that it broke",
       [](T t, S) { return number_of(t.violations.size()); }},
      {"rules", Type::text, "which, when and how", [](T t, S) { return text_of(rules_of(t)); }},
      {"note", Type::text, "what else is to be said", [](T t, S) { return text_of(t.note); }}};
  return fields;
}

std::string column_name(const TransactionField& field) {
  return std::string(field.name) + (field.type == Type::time ? "_ps" : "");
}

std::string field_text(const TransactionField& field, const Transaction& transaction,
                       const SurveyedInterface& surveyed) {
  const Found found = field.value(transaction, surveyed);
  if (!found) return "";
  if (field.type == Type::text) return found->text;
  return field.type == Type::hexadecimal ? hexadecimal(found->number)
                                         : std::to_string(found->number);
}

TransactionCondition::TransactionCondition(const std::string& text) : expression_(text, "--where") {
  // Names and units do not depend on the transaction.
  const auto lookup = [](const std::string& name) {
    if (is_rule(name)) return vp::ExpressionValue(0);
    return as_value(field_named(name), Value{1, "?"});
  };
  expression_.value(vp::Expression::Lookup(lookup));
}

bool TransactionCondition::holds(const Transaction& transaction,
                                 const SurveyedInterface& surveyed) const {
  const auto lookup = [&](const std::string& name) {
    if (!is_rule(name)) {
      const Field& field = field_named(name);
      return as_value(field, field.value(transaction, surveyed));
    }
    const auto& all = transaction.violations;
    const auto count = std::count_if(
        all.begin(), all.end(), [&](const Violation& violation) { return violation.rule == name; });
    return vp::ExpressionValue(static_cast<long double>(count));
  };
  return expression_.holds(vp::Expression::Lookup(lookup));
}

}  // namespace platform::trace
