#include <cli/trace_options.h>

#include <cctype>
#include <optional>
#include <ostream>
#include <utility>

#include <vp/error.h>
#include <vp/text.h>
#include <vp/unit.h>

// What the commands of `trace` have in common.

namespace platform::cli {

namespace {

trace::NameMap name_map(const TraceCommandOptions& options) {
  return options.map ? trace::read_name_map(*options.map) : trace::NameMap{};
}

/// "55MHz", "top.clk falling" or "m_axis=top.clk".
void read_clock(const std::string& text, trace::StatisticsOptions& asked) {
  const auto sign = text.find('=');
  if (sign != std::string::npos) {
    asked.clock_of_link.emplace_back(vp::trim(text.substr(0, sign)),
                                     trace::parse_clock_edge(text.substr(sign + 1)));
    return;
  }
  const std::string trimmed(vp::trim(text));
  const bool is_number =
      !trimmed.empty() && (std::isdigit(static_cast<unsigned char>(trimmed[0])) != 0 ||
                           trimmed[0] == '-' || trimmed[0] == '.');
  if (!is_number) {
    asked.clock = trace::parse_clock_edge(text);
    return;
  }
  std::optional<vp::Decimal::Whole> hertz;
  try {
    hertz = vp::parse_quantity(text, vp::Unit::frequency).whole();
  } catch (const vp::InputError& error) {
    throw vp::InputError("--clock '" + text + "' " + error.what());
  }
  constexpr vp::Decimal::Whole most = 1'000'000'000'000;
  if (!hertz || *hertz <= 0 || *hertz > most)
    throw vp::InputError("--clock '" + text + "' is no frequency of a clock");
  asked.system_hz = static_cast<std::uint64_t>(*hertz);
}

}  // namespace

vp::WaveOptions reading(const TraceCommandOptions& options) {
  vp::WaveOptions reading;
  reading.lenient = options.lenient;
  reading.strict = options.strict;
  if (!options.timescale) return reading;
  constexpr int ps_to_fs = 3;
  constexpr vp::Decimal::Whole most = 1'000'000'000'000'000'000;
  std::optional<vp::Decimal::Whole> fs;
  try {
    fs = vp::parse_quantity(*options.timescale, vp::Unit::time).scaled(1, ps_to_fs).whole();
  } catch (const vp::InputError& error) {
    throw vp::InputError("--timescale '" + *options.timescale + "' " + error.what());
  }
  if (!fs || *fs <= 0 || *fs > most)
    throw vp::InputError("--timescale '" + *options.timescale + "' is not a whole number of fs");
  reading.timescale_fs = static_cast<std::uint64_t>(*fs);
  return reading;
}

trace::TraceFile opened(const TraceCommandOptions& options) {
  return trace::TraceFile(options.file, name_map(options), reading(options));
}

/// Says what is odd about a file that was read.
void warn_of(const trace::TraceFile& file, std::ostream& err) {
  for (const std::string& warning : trace::warnings_of(file))
    err << "markervp: warning: " << warning << std::endl;
}

TimeWindow window(const TraceCommandOptions& options) {
  return options.window ? parse_trace_window(*options.window, "--window") : TimeWindow{};
}

trace::StatisticsOptions clocks_of(const TraceCommandOptions& options) {
  trace::StatisticsOptions asked;
  for (const std::string& clock : options.clocks) read_clock(clock, asked);
  return asked;
}

Lines::Lines(const TraceCommandOptions& options, std::ostream& out,
             std::vector<std::string> columns)
    : options_(options), out_(out), columns_(std::move(columns)) {
  if (options_.json) out_ << "[";
  if (options_.csv) add_words(columns_, ",");
  if (!options_.csv && !options_.json) add_words(columns_, "  ");
}

Lines::~Lines() {
  if (options_.json) out_ << (count_ == 0 ? "]" : "\n]") << "\n";
}

bool Lines::add(const std::vector<std::string>& cells) {
  if (options_.json) {
    out_ << (count_ == 0 ? "\n  {" : ",\n  {");
    for (std::size_t i = 0; i < cells.size(); ++i) {
      out_ << (i == 0 ? "" : ", ") << trace::json_text(columns_[i]) << ": "
           << trace::json_text(cells[i]);
    }
    out_ << "}";
  } else {
    add_words(cells, options_.csv ? "," : "  ");
  }
  return ++count_ != options_.most.value_or(0);
}

void Lines::add_words(const std::vector<std::string>& words, const char* separator) {
  const char* before = "";
  for (const std::string& word : words) {
    const bool plain = !options_.csv || word.find_first_of(",\"\n") == std::string::npos;
    out_ << before << (plain ? word : trace::quoted_cell(word));
    before = separator;
  }
  out_ << "\n";
}

}  // namespace platform::cli
