// `markervp rtl`: RTL and its models.
#include <cli/commands.h>
#include <host/document.h>
#include <host/output_folder.h>
#include <result/console.h>
#include <trace/tools.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>
#include <vp/unit.h>

#include <filesystem>
#include <ostream>
#include <sstream>

namespace platform::cli {

namespace {

namespace fs = std::filesystem;

std::uint64_t frames_of(const fs::path& folder) {
  const std::string file = (folder / "result.json").string();
  const auto result = host::parse_json(vp::read_text(file, "result"), "result '" + file + "'");
  return result.at("summary").at("frames").get<std::uint64_t>();
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
  std::ostringstream summary;  // of a run that is only a means
  const int code = run(run_options, arguments, summary, err);
  if (code != done) return code;
  out << "wrote stimulus.hex, response.hex, bench.sv and bench.vhd of "
      << result::counted(frames_of(folder), "frame") << " into " << options.run.output
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
  for (const std::string& warning : found.warnings) err << "markervp: warning: " << warning << "\n";
  const std::string page = (fs::path(options.output) / "compare").string();
  std::error_code ignored;
  for (const char* ending : {".vcd", ".gtkw"}) fs::remove(page + ending, ignored);
  out << "aligned: " << place_text(found.theirs_begin, "theirs") << " is "
      << place_text(found.ours_begin, "ours") << "\n";
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
        << result::counted(found.clocks, "clock") << ": " << vp::join(found.never_compared, ", ")
        << "\n";
    return run_failed;
  }
  out << "equal: " << result::counted(map.ports.size(), "port") << " on "
      << result::counted(found.clocks, "clock") << "\n";
  if (!found.never_changed.empty())
    out << "never changed: " << vp::join(found.never_changed, ", ") << "\n";
  return done;
}

}  // namespace

int ask_rtl(const RtlOptions& options, const std::vector<std::string>& arguments, std::ostream& out,
            std::ostream& err) {
  if (options.command == "synth") return synthesise_rtl(options.synth, out);
  if (options.command == "prove") return prove_rtl(options.ip, options.prove, out, err);
  if (options.command == "vectors") return write_vectors(options, arguments, out, err);
  if (options.command == "compare") return compare_traces(options.compare, out, err);
  return check_rtl(options, out, err);
}

}  // namespace platform::cli
