// `markervp rtl`: RTL and its models.
#include <cli/commands.h>
#include <host/document.h>
#include <host/output_folder.h>
#include <report/console.h>
#include <trace/replay.h>
#include <trace/tools.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>
#include <vp/unit.h>

#include <algorithm>
#include <filesystem>
#include <ostream>
#include <sstream>

namespace platform::cli {

namespace {

namespace fs = std::filesystem;

/// The shared object that `rtl` names, or that lies in this folder or its `build`.
std::string object_of(const std::string& rtl, const std::string& ip) {
  std::error_code ignored;
  if (!fs::is_directory(rtl, ignored)) return fs::absolute(rtl).string();
  for (const char* place : {"", "build"}) {
    const fs::path file = fs::path(rtl) / place / (ip + ".so");
    if (fs::exists(file, ignored)) return fs::absolute(file).string();
  }
  throw vp::InputError("--rtl '" + rtl + "': there is no " + ip +
                       ".so in it, nor in its build: build it with markervp_add_rtl(" + ip +
                       " IP … TOP …), or name the .so itself");
}

/// Finds when a signal is first high, and when its trace ends.
class FirstHigh final : public trace::Replay::Listener {
 public:
  FirstHigh(trace::TraceFile& file, const std::string& signal)
      : replay_(file), slot_(replay_.watch(signal)) {
    replay_.run(*this);
  }
  /// 0: never.
  std::uint64_t ps() const { return ps_; }
  std::uint64_t last_ps() const { return replay_.last_ps(); }

 private:
  bool instant(std::uint64_t ps) override {
    if (ps_ == 0 && replay_.known(slot_) && replay_.bits(slot_) != 0) ps_ = ps;
    return true;
  }

  trace::Replay replay_;
  trace::Replay::Slot slot_;
  std::uint64_t ps_ = 0;
};

/// A page for GTKWave with all signals of `ip` and its RTL, around the clock of the difference.
void write_page(const std::string& trace_file, const std::string& ip,
                const std::string& page_file) {
  std::uint64_t seen_ps = 0, last_ps = 0;
  {
    trace::TraceFile file(trace_file);
    const FirstHigh differs(file, "pl." + ip + ".rtl.differs");
    seen_ps = differs.ps();
    last_ps = differs.last_ps();
  }
  trace::TraceFile file(trace_file);
  std::vector<std::string> model, rtl;
  for (const std::string& path : file.paths()) {
    if (path.find(".rtl.") != std::string::npos && path.find(".rtl.model.") == std::string::npos) {
      rtl.push_back(path);
    } else if (path.find("pl." + ip + ".") == 0) {
      model.push_back(path);
    }
  }
  // 50 pixel clocks of the thesis, and some behind them. A window that ends behind the trace would
  // begin where that begins: it is a little wider than was asked for.
  constexpr std::uint64_t around_ps = 1'000'000, shown_ps = around_ps / 4 * 5,
                          wide_ps = shown_ps / 20 * 21;
  trace::SaveFile page;
  page.comment = ip + ": the model, and the RTL beside it";
  for (const auto& [title, paths] : {std::pair("model", model), std::pair("RTL", rtl)}) {
    page.lines.emplace_back().path = title;
    page.lines.back().title = true;
    const auto lines = trace::save_lines(file, paths);
    page.lines.insert(page.lines.end(), lines.begin(), lines.end());
  }
  page.marker_ps = seen_ps;
  page.start_ps =
      std::min(seen_ps - std::min(seen_ps, around_ps), last_ps - std::min(last_ps, wide_ps));
  page.end_ps = page.start_ps + shown_ps;
  page.timescale_fs = file.reader().timescale_fs();
  vp::write_file(page_file, trace::save_file_text(page));
}

std::uint64_t frames_of(const fs::path& folder) {
  const std::string file = (folder / "result.json").string();
  const auto result = host::parse_json(vp::read_text(file, "result"), "result '" + file + "'");
  return result.at("summary").at("frames").get<std::uint64_t>();
}

int check(const RtlOptions& options, const std::vector<std::string>& arguments, std::ostream& out,
          std::ostream& err) {
  const fs::path folder = options.run.output;
  const std::string trace_file = (folder / "lockstep.vcd").string();
  const std::string page_file = (folder / "lockstep.gtkw").string();
  const std::string part = "pl." + options.ip;
  RunOptions run_options = options.run;
  run_options.configuration.assignments.push_back(
      "pl.fidelity." + options.ip + "=lockstep:" + object_of(options.rtl, options.ip));
  run_options.trace = trace_file;
  run_options.trace_filter = {part + ".**"};
  run_options.trace_level = "everything";
  run_options.trace_trigger = part + ".rtl.differs rises";
  run_options.no_pictures = run_options.no_report = run_options.quiet = true;
  run_options.trace_trigger_expected = false;
  std::ostringstream summary;  // of a run that nobody asked for
  std::error_code ignored;
  for (const std::string& earlier : {trace_file, page_file}) fs::remove(earlier, ignored);
  try {
    const int code = run(run_options, arguments, summary, err);
    if (code != done) return code;
  } catch (const vp::ProtocolError& error) {
    if (!fs::exists(trace_file, ignored)) throw;
    write_page(trace_file, options.ip, page_file);
    err << "markervp: " << error.what() << "\n";
    out << "look at it: gtkwave " << trace_file << " " << page_file << "\n";
    return run_failed;
  }
  out << "equal: " << options.ip << " of '" << options.rtl << "' and its model, on every clock of "
      << report::counted(frames_of(folder), "frame") << "\n";
  return done;
}

int write_vectors(const RtlOptions& options, const std::vector<std::string>& arguments,
                  std::ostream& out, std::ostream& err) {
  host::prepare_output_folder(options.run.output);
  const fs::path folder = fs::absolute(options.run.output);
  RunOptions run_options = options.run;
  run_options.fidelity = "clocked";
  run_options.configuration.assignments.push_back("pl.fidelity." + options.ip +
                                                  "=vectors:" + folder.string());
  run_options.no_pictures = run_options.no_report = run_options.quiet = true;
  std::ostringstream summary;  // of a run that nobody asked for
  const int code = run(run_options, arguments, summary, err);
  if (code != done) return code;
  out << "wrote stimulus.hex, response.hex, bench.sv and bench.vhd of "
      << report::counted(frames_of(folder), "frame") << " into " << options.run.output
      << "\nplay them: the first lines of a bench say how\n";
  return done;
}

std::string place_text(const trace::PortComparison::Place& place, const std::string& whose) {
  return "clock " + std::to_string(place.clock) + " of " + whose + " (" +
         vp::format_time(place.ps) + ")";
}

int compare_traces(const RtlCompareOptions& options, std::ostream& out, std::ostream& err) {
  trace::PortMap map = trace::read_port_map(options.map);
  const trace::PortComparison found = trace::compare_ports(options.theirs, options.ours, map);
  const std::string page = (fs::path(options.output) / "compare").string();
  std::error_code ignored;
  for (const char* ending : {".vcd", ".gtkw"}) fs::remove(page + ending, ignored);
  out << "aligned: behind " << place_text(found.theirs_begin, "theirs")
      << " stands what stands behind " << place_text(found.ours_begin, "ours") << "\n";
  if (!found.values.empty()) {
    err << "markervp: " << (found.values.front().input ? "the stimulus differs" : "they differ")
        << " behind " << place_text(found.theirs, "theirs") << ", "
        << place_text(found.ours, "ours") << ":";
    const char* separator = " ";
    for (const auto& value : found.values) {
      err << separator << value.port << " is " << value.theirs << " in theirs, " << value.ours
          << " in ours";
      separator = "; ";
    }
    err << "\n";
    host::prepare_output_folder(options.output);
    trace::write_comparison(found, map, page);
    out << "look at it: gtkwave " << page << ".vcd " << page << ".gtkw\n";
    return run_failed;
  }
  if (!found.never_compared.empty()) {
    err << "markervp: not compared, as nothing was valid on "
        << report::counted(found.clocks, "clock") << ": " << vp::join(found.never_compared, ", ")
        << "\n";
    return run_failed;
  }
  out << "equal: " << report::counted(map.ports.size(), "port") << " on "
      << report::counted(found.clocks, "clock") << "\n";
  if (!found.never_changed.empty())
    out << "never changed: " << vp::join(found.never_changed, ", ") << "\n";
  return done;
}

}  // namespace

int ask_rtl(const RtlOptions& options, const std::vector<std::string>& arguments, std::ostream& out,
            std::ostream& err) {
  if (options.command == "synth") return synthesise_rtl(options.synth, out);
  if (options.command == "vectors") return write_vectors(options, arguments, out, err);
  if (options.command == "compare") return compare_traces(options.compare, out, err);
  return check(options, arguments, out, err);
}

}  // namespace platform::cli
