#include <memory>
#include <ostream>

#include <cli/commands.h>
#include <cli/options.h>
#include <cli/trace_options.h>
#include <trace/transactions/json_rows.h>
#include <trace/transactions/lanes.h>
#include <trace/transactions/record_fields.h>
#include <trace/transactions/summary.h>
#include <trace/transactions/transactions.h>
#include <vp/error.h>
#include <vp/text.h>
#include <vp/unit.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace platform::cli {

namespace {

using trace::Transaction;
using trace::TransactionField;

trace::TransactionsOptions asked_of(const TraceCommandOptions& options) {
  trace::TransactionsOptions asked;
  for (const std::string& kind : options.kinds) asked.kinds.push_back(trace::bus_kind_named(kind));
  asked.filter = vp::TraceFilter(options.filter);
  asked.described = options.described;
  asked.clocks = clocks_of(options);
  asked.decode.data_beats = options.data_beats;
  asked.decode.max_wait = options.max_wait;
  return asked;
}

/// Those that overlap the window and fulfil the condition.
class Wanted {
 public:
  explicit Wanted(const TraceCommandOptions& options) : times_(window(options)) {
    if (options.where) condition_.emplace(*options.where);
  }
  bool operator()(const Transaction& one, const trace::SurveyedInterface& surveyed) const {
    if (one.begin_ps >= times_.to_ps || (one.end_ps && *one.end_ps < times_.from_ps)) return false;
    return !condition_ || condition_->holds(one, surveyed);
  }

 private:
  TimeWindow times_;
  std::optional<trace::TransactionCondition> condition_;
};

/// A field for people: long data end in "...".
std::string shown(const TransactionField& field, const Transaction& one,
                  const trace::SurveyedInterface& surveyed) {
  const auto value = field.value(one, surveyed);
  if (value && field.type == TransactionField::Type::time) return vp::format_time(value->number);
  constexpr std::size_t most = 40;
  std::string text = trace::field_text(field, one, surveyed);
  const bool is_long = std::string(field.name) == "data" && text.size() > most;
  return is_long ? text.substr(0, most - 3) + "..." : text;
}

/// What a terminal has room for, lined up.
class TextRows {
 public:
  explicit TextRows(std::uint64_t most) : most_(most) {
    for (const char* column : {"begin", "interface", "operation", "id", "address", "beats", "bytes",
                               "data", "latency", "clocks", "response", "errors", "note"}) {
      for (const TransactionField& field : trace::transaction_fields()) {
        if (std::string(field.name) == column) fields_.push_back(&field);
      }
      table_.columns.emplace_back(column);
    }
    table_.name = "transactions";
  }
  void add(const Transaction& one, const trace::SurveyedInterface& surveyed) {
    if (++count_ > most_) return;
    table_.rows.emplace_back();
    for (const TransactionField* field : fields_)
      table_.rows.back().emplace_back(shown(*field, one, surveyed));
  }
  trace::Table table() {
    table_.title = "Transactions";
    if (count_ > most_) {
      table_.title += " (the first " + std::to_string(most_) + " of " + std::to_string(count_) +
                      "; --most prints more, --csv and --json all)";
    }
    drop_empty_columns();
    return std::move(table_);
  }

 private:
  void drop_empty_columns() {
    for (std::size_t column = table_.columns.size(); column-- > 0;) {
      bool any = false;
      for (const auto& row : table_.rows) {
        const std::string& text = std::get<std::string>(row[column]);
        any = any || (!text.empty() && !(table_.columns[column] == "errors" && text == "0"));
      }
      if (any || table_.rows.empty()) continue;
      const auto place = static_cast<std::ptrdiff_t>(column);
      table_.columns.erase(table_.columns.begin() + place);
      for (auto& row : table_.rows) row.erase(row.begin() + place);
    }
  }

  std::uint64_t most_, count_ = 0;
  std::vector<const TransactionField*> fields_;
  trace::Table table_;
};

std::vector<std::string> csv_columns() {
  std::vector<std::string> columns;
  for (const TransactionField& field : trace::transaction_fields())
    columns.push_back(trace::column_name(field));
  return columns;
}

std::vector<std::string> csv_cells(const Transaction& one,
                                   const trace::SurveyedInterface& surveyed) {
  std::vector<std::string> cells;
  for (const TransactionField& field : trace::transaction_fields())
    cells.push_back(trace::field_text(field, one, surveyed));
  return cells;
}

/// The first reading, whose file is closed when it is over.
trace::Survey surveyed(const TraceCommandOptions& options,
                       const trace::TransactionsOptions& asked) {
  std::error_code ignored;
  if (std::filesystem::exists(options.file, ignored) &&
      !std::filesystem::is_regular_file(options.file, ignored)) {
    throw vp::InputError("trace '" + options.file +
                         "' is read twice, so it may not be a pipe: write it into a file first");
  }
  trace::TraceFile file = opened(options);
  return trace::survey_transactions(file, asked);
}

/// Reads once more: how many lanes a file of signals has is known only behind a first reading.
void write_lanes(const TraceCommandOptions& options, const trace::Survey& survey,
                 const trace::TransactionsOptions& asked, const trace::Lanes& lanes) {
  trace::TraceFile again = opened(options);
  const Wanted wanted(options);
  trace::WaveLanes writer(*options.lanes, survey, lanes.counts());
  trace::read_transactions(again, survey, asked, options.hang_clocks, [&](const Transaction& one) {
    if (wanted(one, survey.interfaces[one.interface])) writer.add(one);
  });
  writer.close();
}

}  // namespace

int list_transactions(const TraceCommandOptions& options, std::ostream& out, std::ostream& err) {
  const trace::TransactionsOptions asked = asked_of(options);
  const Wanted wanted(options);
  constexpr std::uint64_t usual_most = 50;
  const trace::Survey survey = surveyed(options, asked);
  trace::TraceFile file = opened(options);
  trace::TransactionSummary summary(survey);
  trace::Lanes lanes(survey);
  std::optional<trace::PerfettoLanes> perfetto;
  if (options.perfetto) perfetto.emplace(*options.perfetto, survey);
  TextRows text(options.most.value_or(usual_most));
  std::optional<trace::TransactionsJson> json;
  if (options.json) json.emplace([&](std::string_view text) { out << text; });
  std::optional<Lines> csv;
  if (options.csv) csv.emplace(options, out, csv_columns());
  std::uint64_t printed = 0;
  const trace::TransactionsEnd end = trace::read_transactions(
      file, survey, asked, options.hang_clocks, [&](const Transaction& one) {
        const trace::SurveyedInterface& surveyed = survey.interfaces[one.interface];
        if (!wanted(one, surveyed)) return;
        summary.add(one);
        if (options.lanes) lanes.add(one);
        if (perfetto) perfetto->add(one);
        text.add(one, surveyed);
        if (options.most && printed++ >= *options.most) return;
        if (json) json->add(one, surveyed);
        if (csv) csv->add(csv_cells(one, surveyed));
      });
  std::vector<trace::Table> tables = trace::interface_tables(survey);
  const auto append = [&](std::vector<trace::Table> more) {
    for (trace::Table& table : more) tables.push_back(std::move(table));
  };
  if (!json && !csv) append({text.table()});
  append(summary.tables());
  append(trace::end_tables(survey, end));
  if (json) json->close(tables, end.hang);
  if (!json && !csv) {
    out << trace::tables_as_text(tables);
    if (!end.hang.empty()) out << "\nNothing moves at the end: " << end.hang << "\n";
  }
  if (perfetto) perfetto->close();
  if (options.lanes) write_lanes(options, survey, asked, lanes);
  warn_of(file, err);
  return done;
}

}  // namespace platform::cli
