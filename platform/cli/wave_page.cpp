#include <cli/wave_page.h>

#include <cli/trace_options.h>
#include <result/page/report_page.h>
#include <trace/recording.h>
#include <trace/tools.h>
#include <trace/transactions/interfaces.h>
#include <trace/transactions/lanes.h>
#include <trace/transactions/transactions.h>
#include <vp/error.h>
#include <vp/varint.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

namespace platform::cli {

namespace {

using trace::Recording;

const char* name_of(Recording::Form form) {
  return form == Recording::Form::bit ? "bit" : form == Recording::Form::real ? "real" : "words";
}

std::string json_list(const std::vector<std::string>& words) {
  std::string text = "[";
  for (const std::string& word : words)
    text += (text.size() > 1 ? "," : "") + trace::json_text(word);
  return text + "]";
}

std::string signal_json(const Recording::Signal& signal) {
  std::string text = "{\"name\":" + trace::json_text(signal.path) + ",\"form\":\"" +
                     name_of(signal.form) + "\",\"bits\":" + std::to_string(signal.width);
  if (signal.same_as >= 0) return text + ",\"sameAs\":" + std::to_string(signal.same_as) + "}";
  text += ",\"count\":" + std::to_string(signal.count) + ",\"changes\":\"" +
          page::base64(signal.changes) + "\"";
  if (signal.form != Recording::Form::bit) text += ",\"words\":" + json_list(signal.words.words());
  return text + "}";
}

/// A lane of transactions: for each the ps from the begin of the one before, its length, and its
/// text · 2 + whether a rule is broken.
struct LaneColumn {
  std::string bytes;
  trace::WordTable words;
  std::uint64_t count = 0, last_ps = 0;
};

/// The lanes of all buses, in the order of their names.
class LaneColumns {
 public:
  LaneColumns(const trace::Survey& survey, const Recording& window)
      : lanes_(survey), window_(window) {}

  void add(const trace::Transaction& one) {
    constexpr std::uint64_t most = 200'000;
    const trace::Lanes::Place place = lanes_.add(one);
    if (place.from_ps >= window_.to_ps || place.to_ps < window_.from_ps) return;
    if (count_ == most) {
      ++left_out_;
      return;
    }
    ++count_;
    const std::string name = lanes_.name({one.interface, one.operation}, place.lane);
    LaneColumn& lane = columns_.try_emplace(name).first->second;
    lane.last_ps = std::max(lane.last_ps, window_.from_ps);
    const std::uint64_t begin = std::max(place.from_ps, lane.last_ps);
    vp::put_varint(lane.bytes, begin - lane.last_ps);
    vp::put_varint(lane.bytes, std::max(place.to_ps, begin) - begin);
    // Without anything to say it is the operation.
    std::string text = trace::lane_text(one);
    if (text != one.operation) text = one.operation + (" " + text);
    vp::put_varint(lane.bytes, lane.words.place(text) * 2 + (one.violations.empty() ? 0 : 1));
    lane.last_ps = begin;
    ++lane.count;
  }
  std::uint64_t left_out() const { return left_out_; }
  std::string json() const {
    std::string text = "[";
    for (const auto& [name, lane] : columns_) {
      text += std::string(text.size() > 1 ? "," : "") + "{\"name\":" + trace::json_text(name) +
              ",\"count\":" + std::to_string(lane.count) + ",\"spans\":\"" +
              page::base64(lane.bytes) + "\",\"words\":" + json_list(lane.words.words()) + "}";
    }
    return text + "]";
  }

 private:
  trace::Lanes lanes_;
  const Recording& window_;
  std::map<std::string, LaneColumn> columns_;
  std::uint64_t count_ = 0, left_out_ = 0;
};

/// The transactions of the buses, if the trace has any, and how many there is no room for.
std::string lanes_json(const TraceCommandOptions& options, const Recording& window,
                       std::ostream& err) {
  trace::TransactionsOptions asked;
  asked.to_ps = window.to_ps;
  std::optional<trace::Survey> survey;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(options.file, ignored))
    return "[]";  // it is read twice more
  try {
    trace::TraceFile file = opened(options);
    if (trace::find_interfaces(file).interfaces.empty()) return "[]";  // signals are all there is
    survey = trace::survey_transactions(file, asked);
  } catch (const vp::InputError& error) {
    err << "markervp: warning: the page has no transactions: " << error.what() << std::endl;
    return "[]";
  }
  trace::TraceFile file = opened(options);
  LaneColumns columns(*survey, window);
  constexpr std::uint64_t usual_hang_clocks = 10;
  trace::read_transactions(file, *survey, asked, usual_hang_clocks,
                           [&](const trace::Transaction& one) { columns.add(one); });
  return columns.json() + ",\"transactionsLeftOut\":" + std::to_string(columns.left_out());
}

}  // namespace

std::string waves_json(const TraceCommandOptions& options, std::ostream& err) {
  trace::TraceFile file = opened(options);
  trace::RecordingOptions asked;
  asked.signals = options.signals;
  const TimeWindow times = window(options);
  asked.from_ps = times.from_ps;
  asked.to_ps = times.to_ps;
  const Recording found = trace::recording(file, asked);
  std::string text =
      "{\"file\":" + trace::json_text(std::filesystem::path(options.file).filename().string()) +
      ",\"path\":" + trace::json_text(options.file) + ",\"from\":" + std::to_string(found.from_ps) +
      ",\"to\":" + std::to_string(found.to_ps) + ",\"dropped\":" + std::to_string(found.dropped) +
      ",\"leftOut\":" + std::to_string(found.left_out);
  if (options.marker)
    text += ",\"cursor\":" + std::to_string(parse_moment(*options.marker, "--marker"));
  text += ",\"signals\":[";
  for (std::size_t i = 0; i < found.signals.size(); ++i)
    text += (i == 0 ? "" : ",") + signal_json(found.signals[i]);
  text += "],\"lanes\":" + (options.signals.empty() ? lanes_json(options, found, err) : "[]") + "}";
  warn_of(file, err);
  return text;
}

std::string waves_of_run(const std::string& file) {
  // In bytes, a second of reading; what is packed is 4 to 30 times smaller.
  constexpr std::uint64_t largest_vcd = 256 << 20, largest_packed = 16 << 20;
  const bool is_plain = std::filesystem::path(file).extension() == ".vcd";
  std::error_code failed;
  const auto size = std::filesystem::file_size(file, failed);
  if (failed) return "{}";  // a pipe: its reader has the trace
  if (size > (is_plain ? largest_vcd : largest_packed))
    return "{\"tooLarge\":" + trace::json_text(file) + "}";
  TraceCommandOptions options;
  options.file = file;
  std::ostringstream ignored;
  try {
    return waves_json(options, ignored);
  } catch (const vp::InputError& error) {
    return "{\"problem\":" + trace::json_text(error.what()) + "}";
  }
}

}  // namespace platform::cli
