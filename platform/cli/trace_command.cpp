#include <ostream>

#include <chip/system/designs.h>
#include <cli/commands.h>
#include <cli/options.h>
#include <cli/program.h>
#include <cli/trace_options.h>
#include <cli/wave_page.h>
#include <host/output_folder.h>
#include <result/page/report_page.h>
#include <trace/listing.h>
#include <trace/questions.h>
#include <trace/statistics.h>
#include <trace/tools.h>
#include <trace/viewer_control.h>
#include <trace/wavedrom.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/frame_gate.h>
#include <vp/text.h>
#include <vp/unit.h>

#include <filesystem>
#include <optional>

namespace platform::cli {

namespace {

/// What the user wrote, and where.
struct Written {
  std::string text, option;
  const char* example = "6ms:7ms";
};

[[noreturn]] void refuse(const Written& written, const std::string& problem) {
  throw vp::InputError(written.option + " '" + written.text + "' " + problem + ": write it like " +
                       written.example);
}

std::optional<std::uint64_t> parse_time(const std::string& part, const Written& written) {
  const std::string trimmed(vp::trim(part));
  if (trimmed.empty()) return std::nullopt;
  std::optional<vp::Decimal::Whole> ps;
  try {
    ps = vp::parse_quantity(trimmed, vp::Unit::time).whole();
  } catch (const vp::InputError& error) {
    refuse(written, error.what());
  }
  constexpr vp::Decimal::Whole largest = UINT64_MAX;
  if (!ps || *ps < 0 || *ps > largest) refuse(written, "is no time in whole picoseconds");
  return static_cast<std::uint64_t>(*ps);
}

}  // namespace

TimeWindow parse_trace_window(const std::string& text, const std::string& option) {
  const Written written{text, option};
  const std::vector<std::string> parts = vp::split(text, ':');
  if (parts.size() != 2) refuse(written, "is no span of time");
  TimeWindow window;
  window.from_ps = parse_time(parts[0], written).value_or(window.from_ps);
  window.to_ps = parse_time(parts[1], written).value_or(window.to_ps);
  if (window.to_ps <= window.from_ps) refuse(written, "ends before it begins");
  return window;
}

std::uint64_t parse_moment(const std::string& text, const std::string& option) {
  const Written written{text, option, "15.2ms"};
  const std::optional<std::uint64_t> ps = parse_time(text, written);
  if (!ps) refuse(written, "is no time");
  return *ps;
}

namespace {

using trace::TraceFile;

const trace::Vocabulary& words_of(const TraceCommandOptions& options) {
  return (options.design ? design_named(*options.design) : *builtin_designs().front()).words();
}

int list(const TraceCommandOptions& options, std::ostream& out, std::ostream& err) {
  TraceFile file = opened(options);
  const trace::Listing listing(file, vp::TraceFilter(options.filter));
  if (options.json) {
    out << trace::tables_as_json(listing.tables());
  } else {
    listing.write(out);
  }
  warn_of(file, err);
  return done;
}

std::optional<trace::ClockEdge> every(const TraceCommandOptions& options) {
  if (!options.every) return std::nullopt;
  return trace::parse_clock_edge(*options.every);
}

int find(const TraceCommandOptions& options, std::ostream& out, std::ostream& err) {
  TraceFile file = opened(options);
  trace::FindOptions asked;
  asked.condition = options.condition;
  asked.every = every(options);
  const TimeWindow times = window(options);
  asked.from_ps = times.from_ps;
  asked.to_ps = times.to_ps;
  const bool for_people = !options.csv && !options.json;
  trace::FindSummary summary;
  {
    std::vector<std::string> columns =
        for_people ? std::vector<std::string>{"from", "for"}
                   : std::vector<std::string>{"from_ps", "until_ps", "open"};
    if (asked.every) columns.emplace_back("clocks");
    Lines lines(options, out, columns);
    summary = trace::find(file, asked, [&](const trace::Occurrence& one) {
      const std::uint64_t length = one.until_ps - one.from_ps;
      std::vector<std::string> cells =
          for_people
              ? std::vector<std::string>{vp::format_time(one.from_ps),
                                         vp::format_time(length) + (one.open ? " to the end" : "")}
              : std::vector<std::string>{std::to_string(one.from_ps), std::to_string(one.until_ps),
                                         one.open ? "1" : "0"};
      if (asked.every) cells.push_back(std::to_string(one.clocks));
      return lines.add(cells);
    });
  }
  if (for_people) {
    out << summary.times << (summary.times == 1 ? " time, " : " times, ")
        << vp::format_time(summary.held_ps) << " together";
    if (asked.every) out << ", " << summary.clocks << (summary.clocks == 1 ? " clock" : " clocks");
    if (summary.times > 1) {
      out << "; the longest " << vp::format_time(summary.longest_ps) << " at "
          << vp::format_time(summary.longest_at_ps);
    }
    out << "\n";
  }
  if (!summary.evaluated) err << "markervp: the condition was never known\n";
  warn_of(file, err);
  return done;
}

int values(const TraceCommandOptions& options, std::ostream& out, std::ostream& err) {
  TraceFile file = opened(options);
  trace::ValuesOptions asked;
  asked.signals = options.signals;
  for (const std::string& time : options.at) asked.at_ps.push_back(parse_moment(time, "--at"));
  asked.when = options.when.value_or("");
  asked.every = every(options);
  const TimeWindow times = window(options);
  asked.from_ps = times.from_ps;
  asked.to_ps = times.to_ps;
  const bool for_people = !options.csv && !options.json;
  {
    std::vector<std::string> columns = trace::value_columns(file, asked);
    columns.insert(columns.begin(), for_people ? "time" : "time_ps");
    Lines lines(options, out, columns);
    trace::values(file, asked, [&](const trace::ValueRow& row) {
      std::vector<std::string> cells = row.values;
      cells.insert(cells.begin(), for_people ? vp::format_time(row.ps) : std::to_string(row.ps));
      return lines.add(cells);
    });
  }
  warn_of(file, err);
  return done;
}

int stats(const TraceCommandOptions& options, std::ostream& out, std::ostream& err) {
  TraceFile file = opened(options);
  const trace::StatisticsOptions asked = clocks_of(options);
  const auto tables = trace::statistics(file, words_of(options), asked);
  out << (options.json  ? trace::tables_as_json(tables)
          : options.csv ? trace::tables_as_csv(tables)
                        : trace::tables_as_text(tables));
  warn_of(file, err);
  return done;
}

void print_events(std::ostream& out, const std::string& title,
                  const std::vector<trace::Difference::Event>& before,
                  const std::vector<trace::Difference::Event>& after) {
  out << title << "\n";
  const auto print = [&](const auto& events, const char* sign) {
    for (const auto& event : events) {
      out << sign << vp::format_time(event.ps) << "  " << event.path << " = " << event.value
          << "\n";
    }
  };
  print(before, "    ");
  print(after, "  > ");
}

int diff(const TraceCommandOptions& options, std::ostream& out, std::ostream& err) {
  TraceFile a = opened(options), b(options.other, {}, reading(options));
  trace::DifferenceOptions asked;
  asked.by_frame = options.align == "frame";
  if (options.frame) asked.frame = *options.frame;
  asked.filter = vp::TraceFilter(options.filter);
  const trace::Difference result = trace::difference(a, b, asked);
  warn_of(a, err);
  warn_of(b, err);
  const auto note = [&](const std::vector<std::string>& names, const std::string& file) {
    if (names.empty()) return;
    out << names.size() << (names.size() == 1 ? " signal" : " signals") << " in " << file
        << " only, for example " << names.front() << "\n";
  };
  note(result.only_in_a, options.file);
  note(result.only_in_b, options.other);
  if (!result.differ) {
    out << "no difference in " << result.compared << " signals\n";
    return done;
  }
  out << "first difference at " << vp::format_time(result.a_ps) << " in " << options.file << ", "
      << vp::format_time(result.b_ps) << " in " << options.other;
  if (asked.by_frame) {
    out << ": frame " << result.frame << ", " << vp::format_time(result.in_frame_ps) << " into it";
  }
  out << "\n";
  constexpr std::size_t most = 10;
  for (std::size_t i = 0; i < result.values.size() && i < most; ++i) {
    const auto& value = result.values[i];
    out << "  " << value.path << ": " << (value.in_a.empty() ? "-" : value.in_a) << " against "
        << (value.in_b.empty() ? "-" : value.in_b) << "\n";
  }
  if (result.values.size() > most) out << "  and " << result.values.size() - most << " more\n";
  print_events(out, options.file + ":", result.a_before, result.a_after);
  print_events(out, options.other + ":", result.b_before, result.b_after);
  return run_failed;
}

trace::CutOptions part(const TraceCommandOptions& options) {
  trace::CutOptions asked;
  const TimeWindow times = window(options);
  asked.from_ps = times.from_ps;
  asked.to_ps = times.to_ps;
  asked.filter = vp::TraceFilter(options.filter);
  return asked;
}

int cut(const TraceCommandOptions& options, std::ostream& out, std::ostream& err) {
  trace::CutOptions asked = part(options);
  std::string name;
  const auto write = [&] {
    TraceFile file = opened(options);
    name = file.name();
    trace::cut(file, options.other, asked);
    out << "wrote " << options.other << "\n";
    warn_of(file, err);
    return done;
  };
  try {
    return write();
  } catch (const trace::MixedTypes& mixed) {
    std::error_code ignored;  // a pipe is read once
    if (!std::filesystem::is_regular_file(name, ignored)) throw;
    asked.as_texts = mixed.nets;
  }
  return write();
}

int saif(const TraceCommandOptions& options, std::ostream& out, std::ostream& err) {
  TraceFile file = opened(options);
  const std::uint64_t bits = trace::write_saif(file, options.other, part(options));
  out << "wrote " << options.other << ": " << bits << (bits == 1 ? " bit" : " bits") << "\n";
  warn_of(file, err);
  return done;
}

/// A timing diagram in place of a plot.
int diagram(const TraceCommandOptions& options, TraceFile& file, const trace::PlotOptions& plot,
            std::ostream& out, std::ostream& err) {
  trace::WaveDromOptions asked;
  asked.signals = plot.signals;
  asked.every = *every(options);
  asked.from_ps = plot.from_ps;
  asked.to_ps = plot.to_ps;
  const std::string name = options.output.value_or("diagram.json");
  vp::write_file(name, trace::wavedrom_json(file, asked));
  out << "wrote " << name << "\n";
  warn_of(file, err);
  return done;
}

/// A page with a viewer in place of a picture.
int viewer(const TraceCommandOptions& options, const std::string& name, std::ostream& out,
           std::ostream& err) {
  if (options.every) {
    throw vp::InputError("plot: '" + name +
                         "' is a page, and --every makes a timing diagram: -o diagram.json");
  }
  if (!page::write_page(name, {{"waves", waves_json(options, err)}}))
    throw vp::InputError("this program was built without its page: draw an SVG");
  out << "wrote " << name << "\n";
  return done;
}

int plot(const TraceCommandOptions& options, std::ostream& out, std::ostream& err) {
  const std::string name = options.output.value_or("plot.svg");
  if (std::filesystem::path(name).extension() == ".html") return viewer(options, name, out, err);
  if (options.signals.empty())
    throw vp::InputError("plot: name the signals; all of them are in a page only: -o waves.html");
  TraceFile file = opened(options);
  trace::PlotOptions asked;
  asked.signals = options.signals;
  const TimeWindow times = window(options);
  asked.from_ps = times.from_ps;
  asked.to_ps = times.to_ps;
  if (times.to_ps == TimeWindow{}.to_ps) {
    struct Nothing : vp::WaveHandler {
      bool at(std::uint64_t) override { return true; }
      void change(std::uint32_t, const vp::WaveValue&) override {}
    } nothing;
    TraceFile first_look = opened(options);
    first_look.reader().read(nothing);
    asked.to_ps = first_look.reader().now_ps() + 1;
  }
  if (asked.to_ps <= asked.from_ps) throw vp::InputError("the trace ends before --window begins");
  if (options.every) return diagram(options, file, asked, out, err);
  if (options.marker) asked.marker_ps = parse_moment(*options.marker, "--marker");
  const std::string picture = trace::plot_as_svg(file, asked);
  vp::write_file(name, picture);
  out << "wrote " << name << "\n";
  warn_of(file, err);
  return done;
}

/// A moment in a viewer that runs.
int view(const TraceCommandOptions& options, std::ostream& out, std::ostream& err) {
  const TraceFile file = opened(options);
  trace::Viewing asked;
  asked.file = std::filesystem::absolute(options.file).lexically_normal().string();
  for (const std::string& name : options.signals)
    asked.signals.push_back(file.reader().paths()[vp::find_path(name, file.paths(), "view: ")]);
  if (options.marker) {
    asked.steps =
        trace::steps_of(parse_moment(*options.marker, "--at"), file.reader().timescale_fs());
  }
  for (const std::string& undone : trace::show_in_viewer(asked, options.port))
    err << "markervp: warning: " << undone << std::endl;
  out << "the viewer shows " << options.file
      << (options.marker ? " at " + *options.marker : std::string()) << "\n";
  warn_of(file, err);
  return done;
}

int gtkw(const TraceCommandOptions& options, std::ostream& out, std::ostream& err) {
  TraceFile file = opened(options);
  const std::string folder = options.output.value_or(options.file + ".gtkwave");
  host::prepare_output_folder(folder);
  for (const std::string& name : trace::write_save_files(file, words_of(options), folder)) {
    out << "wrote " << name << "\n";
  }
  warn_of(file, err);
  return done;
}

int answer(const TraceCommandOptions& options, std::ostream& out, std::ostream& err) {
  if (options.command == "list") return list(options, out, err);
  if (options.command == "find") return find(options, out, err);
  if (options.command == "transactions") return list_transactions(options, out, err);
  if (options.command == "values") return values(options, out, err);
  if (options.command == "stats") return stats(options, out, err);
  if (options.command == "check") return check_trace(options, out, err);
  if (options.command == "diff") return diff(options, out, err);
  if (options.command == "plot") return plot(options, out, err);
  if (options.command == "saif") return saif(options, out, err);
  if (options.command == "view") return view(options, out, err);
  if (options.command == "gtkw") return gtkw(options, out, err);
  return cut(options, out, err);  // and convert, which takes no part
}

}  // namespace

int ask_trace(const TraceCommandOptions& options, std::ostream& out, std::ostream& err) {
  return answer(options, out, err);
}

}  // namespace platform::cli
