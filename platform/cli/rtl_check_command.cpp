// `markervp rtl check`: RTL in lock-step with its model, on pictures of the user's and on stimuli
// that are hard; and what of it was exercised.
#include <chip/system/designs.h>
#include <cli/commands.h>
#include <cli/rtl_bench.h>
#include <cli/rtl_coverage.h>
#include <cli/rtl_stimuli.h>
#include <cli/sweep_command.h>
#include <fmt/format.h>
#include <host/document.h>
#include <host/output_folder.h>
#include <pl/common/rtl_use.h>
#include <result/console.h>
#include <trace/replay.h>
#include <trace/tools.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <ostream>
#include <sstream>

namespace platform::cli {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

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

/// A run in lock-step, or one on the pins of the IP alone.
struct Play {
  std::string
      name;  ///< of its folder, too; empty: that of the user's pictures, in the folder itself
  RunOptions options;
  std::optional<PinPlay> pins = {};
};

/// In the folder of each play, if the RTL counts its lines.
constexpr const char* coverage_file = "coverage.dat";

Json to_json(const pl::LockstepUse& use) {
  Json json{{"clocks", use.clocks}};
  for (const auto& port : use.ports) {
    json["ports"].push_back({{"name", port.name},
                             {"bits", port.bits},
                             {"output", port.output},
                             {"fixed", port.fixed},
                             {"clocks", port.clocks},
                             {"changes", port.changes},
                             {"rises", port.rises},
                             {"high", port.high},
                             {"low", port.low}});
  }
  json["streams"] = Json::array();
  for (const auto& stream : use.streams)
    json["streams"].push_back(
        {{"name", stream.name}, {"beats", stream.beats}, {"stalls", stream.stalls}});
  return json;
}

/// In a process of its own: the last line that it prints is what was exercised.
int play(const Play& play, const RtlOptions& options, std::ostream& out, std::ostream& err) {
  const fs::path folder = play.options.output;
  const std::string trace_file = (folder / "lockstep.vcd").string();
  const std::string page_file = (folder / "lockstep.gtkw").string();
  std::error_code ignored;
  pl::lockstep_coverage() = (folder / coverage_file).string();
  for (const std::string& earlier : {trace_file, page_file, pl::lockstep_coverage()})
    fs::remove(earlier, ignored);
  std::ostringstream summary;  // of a run that the user did not ask for
  try {
    if (play.pins) {
      play_pins(*play.pins, err);
    } else if (const int code = run(play.options, {}, summary, err); code != done) {
      return code;
    }
  } catch (const vp::ProtocolError& error) {
    if (!fs::exists(trace_file, ignored)) throw;
    write_page(trace_file, options.ip, page_file);
    err << "markervp: " << error.what() << "\n";
    out << "look at it: gtkwave " << trace_file << " " << page_file << "\n";
    return run_failed;
  }
  const auto& use = pl::lockstep_use();
  out << (use ? to_json(*use) : Json::object()).dump() << "\n";
  return done;
}

RunOptions lockstep_options(const RtlOptions& options, const std::string& folder) {
  const std::string part = "pl." + options.ip;
  RunOptions run = options.run;
  run.output = folder;
  run.configuration.assignments.push_back("pl.fidelity." + options.ip +
                                          "=lockstep:" + object_of(options.rtl, options.ip));
  run.trace = (fs::path(folder) / "lockstep.vcd").string();
  run.trace_filter = {part + ".**"};
  run.trace_level = "everything";
  run.trace_trigger = part + ".rtl.differs rises";
  run.no_pictures = run.no_report = run.quiet = true;
  run.trace_trigger_expected = false;
  return run;
}

/// Whether `exercise` knows the logic of the design.
bool can_be_exercised(const DesignInfo& design) {
  const auto& programs = design.programs;
  return std::any_of(programs.begin(), programs.end(), [](const std::string& program) {
    return program == "hybrid" || program == "improved" || program == "ps-only";
  });
}

std::string value_of(const study::Elaborated& platform, const std::string& path) {
  for (const auto& parameter : platform.parameters) {
    if (parameter.path == path) return parameter.value;
  }
  return "";
}

struct FrameSize {
  int width = 0, height = 0;
};

/// Of the frames that the design takes. Throws vp::InputError if it takes none.
FrameSize frame_size(const study::Elaborated& platform) {
  FrameSize size;
  if (std::sscanf(platform.input.shape.c_str(), "%dx%d", &size.width, &size.height) != 2)
    throw vp::InputError("this design takes no frames: 'rtl check' plays frames to it");
  return size;
}

PinPlay pins_of(const RtlOptions& options, const study::Elaborated& platform,
                const RunOptions& run) {
  const auto number = [&](const std::string& path, std::uint32_t otherwise) {
    const std::string text = value_of(platform, path);
    return text.empty() ? otherwise : static_cast<std::uint32_t>(std::stoul(text));
  };
  const FrameSize size = frame_size(platform);
  PinPlay play;
  play.instance = options.ip;
  play.object = object_of(options.rtl, options.ip);
  play.seed = number("pl.fidelity." + options.ip + "_seed", 0);
  play.geometry = {static_cast<std::uint32_t>(size.width), static_cast<std::uint32_t>(size.height),
                   number("pl.burst_words", marker_logic::usual_burst_words),
                   number("pl.pixels_per_clock", 1)};
  play.parameters = platform.parameters;
  for (StimulusPicture& picture : stimulus_pictures(size.width, size.height)) {
    // Where there is most to see, more often.
    const int times = picture.name == "noise" || picture.name == "few_levels" ? 8 : 1;
    for (int i = 0; i < times; ++i) play.pictures.push_back(picture.pixels);
  }
  play.trace_file = *run.trace;
  if (options.stimulus) play.recorded = read_recorded(*options.stimulus);
  return play;
}

/// Of pictures with many pixels.
constexpr std::size_t most_large = 12;

std::vector<Play> plays_of(const RtlOptions& options) {
  const std::string& folder = options.run.output;
  std::vector<Play> plays;
  const bool own = !options.run.inputs.empty();
  if (own) plays.push_back({"", lockstep_options(options, folder)});
  if (options.no_stimuli) {
    if (!own) throw vp::InputError("--no-stimuli leaves nothing to play: name pictures or scenes");
    return plays;
  }
  ConfigurationOptions watched = lockstep_options(options, folder).configuration;
  watched.assignments.push_back("fidelity=clocked");  // as a run with a trace has it
  const study::Elaborated platform = elaborate(watched, options.run.program);
  const FrameSize size = frame_size(platform);
  const auto value = [&](const std::string& path) { return value_of(platform, path); };
  if (options.stimulus) {
    if (own || !has_bench(options.ip))
      throw vp::InputError(own ? "--stimulus is played without pictures: leave them out"
                               : "--stimulus: '" + options.ip +
                                     "' has no pins of its own to play at");
    RunOptions run = lockstep_options(options, (fs::path(folder) / "stimulus").string());
    fs::create_directories(run.output);
    plays.push_back({"stimulus", run, pins_of(options, platform, run)});
    return plays;
  }
  const std::string pictures = (fs::path(folder) / "stimuli").string();
  fs::create_directories(pictures);
  auto files = write_stimuli(pictures, size.width, size.height);
  const bool is_large = size.width * size.height > 1 << 16;
  if (is_large) files.resize(most_large);  // that a check takes a minute
  const auto add = [&](const std::string& name) -> RunOptions& {
    RunOptions play = lockstep_options(options, (fs::path(folder) / name).string());
    play.inputs = files;
    play.input_settings.erase("camera");
    return plays.emplace_back(Play{name, play}).options;
  };
  const std::string design = value("design");
  if (!can_be_exercised(design_named(design))) {
    add("pictures");
    return plays;
  }
  const auto exercise = [&](const std::string& name) -> RunOptions& {
    RunOptions& play = add(name);
    play.configuration.design = design;
    play.program = "exercise";
    return play;
  };
  // First: where it finds a difference, it does so soon.
  if (has_bench(options.ip)) {
    RunOptions& run = add("pins");
    fs::create_directories(run.output);
    plays.back().pins = pins_of(options, platform, run);
  }
  exercise("exercise");
  // Other conditions for a few of the pictures: lines apart from each other where there is a
  // camera, else words that wait between two clocks.
  const char* const blanking = "pl.camera.line_blanking";
  const bool has_camera = !value(blanking).empty();
  RunOptions& other = exercise(has_camera ? "blanked_lines" : "slow_bus");
  other.inputs.resize(is_large ? 2 : 4);
  if (!has_camera)
    other.configuration.assignments.push_back("ps.fclk_clk0.frequency=12.5 MHz");
  else if (value(blanking) == "0 cycles")
    other.configuration.assignments.push_back(std::string(blanking) + "=13 cycles");
  return plays;
}

/// Adds what another play has shown of the same ports.
void merge(Json& all, const Json& use) {
  if (all.empty()) {
    all = use;
    return;
  }
  const auto sum = [](Json& to, const Json& from, const char* key) {
    to[key] = to[key].get<std::uint64_t>() + from[key].get<std::uint64_t>();
  };
  sum(all, use, "clocks");
  for (std::size_t i = 0; i < all["ports"].size(); ++i) {
    Json& port = all["ports"][i];
    const Json& more = use["ports"][i];
    for (const char* key : {"clocks", "changes", "rises"}) sum(port, more, key);
    for (const char* key : {"high", "low"})
      port[key] = port[key].get<std::uint64_t>() | more[key].get<std::uint64_t>();
  }
  for (std::size_t i = 0; i < all["streams"].size(); ++i) {
    for (const char* key : {"beats", "stalls"}) sum(all["streams"][i], use["streams"][i], key);
  }
}

/// A stimulus is no picture of a camera, and its program makes mistakes.
std::string without_warnings(const std::string& text) {
  std::istringstream lines(text);
  std::string kept;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("warning: ") == std::string::npos) kept += line + "\n";
  }
  return kept;
}

unsigned bits_moved(const Json& port) {
  std::uint64_t both = port["high"].get<std::uint64_t>() & port["low"].get<std::uint64_t>();
  unsigned count = 0;
  for (; both != 0; both &= both - 1) ++count;
  return count;
}

/// Starts of frames or resets: rising inputs of these names.
std::uint64_t rises(const Json& use, const std::vector<std::string>& names) {
  std::uint64_t sum = 0;
  for (const Json& port : use["ports"]) {
    const bool counts = !port["output"].get<bool>() &&
                        std::find(names.begin(), names.end(), port["name"]) != names.end();
    if (counts) sum += port["rises"].get<std::uint64_t>();
  }
  return sum;
}

std::vector<std::string> never_moved(const Json& use) {
  std::vector<std::string> names;
  for (const Json& port : use["ports"]) {
    if (port["output"].get<bool>() && !port["fixed"].get<bool>() && port["changes"] == 0)
      names.push_back(port["name"]);
  }
  return names;
}

void print_use(const Json& use, std::ostream& out) {
  out << fmt::format("exercised on {}: {}, {}\n",
                     result::counted(use["clocks"].get<std::uint64_t>(), "clock"),
                     result::counted(rises(use, {"ena", "frame_ena"}), "start"),
                     result::counted(rises(use, {"rst", "por"}), "reset"));
  for (const Json& stream : use["streams"]) {
    out << fmt::format("  stream {}: {}, {}\n", stream["name"].get<std::string>(),
                       result::counted(stream["beats"].get<std::uint64_t>(), "beat"),
                       result::counted(stream["stalls"].get<std::uint64_t>(), "stall"));
  }
  constexpr const char* row = "  {:<20} {:>6} {:>12} {:>12} {:>12}\n";
  out << fmt::format(row, "port", "", "valid clocks", "changes", "bits moved");
  for (const Json& port : use["ports"]) {
    out << fmt::format(row, port["name"].get<std::string>(), port["output"] ? "out" : "in",
                       port["clocks"].get<std::uint64_t>(), port["changes"].get<std::uint64_t>(),
                       fmt::format("{} of {}", bits_moved(port), port["bits"].get<unsigned>()));
  }
}

/// What Verilator counted, for people and in `use`.
void print_coverage(const std::vector<Play>& plays, Json& use, std::ostream& out) {
  constexpr std::size_t most_lines = 8;
  RtlCoverage coverage;
  for (const Play& each : plays)
    coverage.add((fs::path(each.options.output) / coverage_file).string());
  if (coverage.empty()) {
    out << "lines and toggles inside the RTL: not counted; markervp_add_rtl(… COVERAGE) does\n";
    return;
  }
  const auto lines = coverage.reached("v_line"), toggles = coverage.reached("v_toggle");
  std::vector<std::string> missed = coverage.missed_lines();
  use["coverage"] = {{"lines", {lines.first, lines.second}},
                     {"toggles", {toggles.first, toggles.second}},
                     {"missed_lines", missed}};
  out << fmt::format("inside the RTL: {} of {} lines and branches, {} of {} toggles\n", lines.first,
                     lines.second, toggles.first, toggles.second);
  if (missed.empty()) return;
  const std::size_t more = missed.size() - std::min(missed.size(), most_lines);
  missed.resize(missed.size() - more);
  out << "never reached: " << vp::join(missed, ", ")
      << (more > 0 ? fmt::format(" and {} more", more) : "") << "\n";
}

/// "demo, z2.0 and stimuli in out/stimuli"
std::string played(const std::vector<Play>& plays, const RtlOptions& options) {
  std::vector<std::string> names;
  names.reserve(plays.size());
  for (const Play& play : plays) {
    names.push_back(play.name.empty() ? vp::join(options.run.inputs, ", ")
                    : play.pins
                        ? "'" + play.name + "'"
                        : fmt::format("'{}' ({})", play.name,
                                      result::counted(play.options.inputs.size(), "picture")));
  }
  return vp::join(names, ", ");
}

}  // namespace

int check_rtl(const RtlOptions& options, std::ostream& out, std::ostream& err) {
  host::prepare_output_folder(options.run.output);
  std::vector<Play> plays = plays_of(options);
  std::vector<host::Child> children;
  children.reserve(plays.size());
  for (const Play& each : plays)
    children.emplace_back(
        [&](std::ostream& told, std::ostream& wrong) { return play(each, options, told, wrong); });
  Json all = Json::object();
  for (std::size_t i = 0; i < plays.size(); ++i) {
    const host::ChildEnd end = children[i].wait();
    if (end.exit_code != done) {
      if (!plays[i].name.empty()) err << "in the play '" << plays[i].name << "':\n";
      err << (plays[i].name.empty() ? end.err : without_warnings(end.err));
      out << end.out;
      if (end.signal == 0) return end.exit_code;
      return host::fail(err,
                        std::string("the process that played it was ended by the signal '") +
                            ::strsignal(end.signal) + "', before it could say where",
                        protocol_broken);
    }
    if (plays[i].name.empty()) err << end.err;
    merge(all, Json::parse(end.out.substr(end.out.rfind('\n', end.out.size() - 2) + 1)));
  }
  out << "played " << played(plays, options) << "\n";
  print_use(all, out);
  print_coverage(plays, all, out);
  const std::vector<std::string> still = never_moved(all);
  all["not_exercised"] = still;
  vp::write_file((fs::path(options.run.output) / "check.json").string(), all.dump(2) + "\n");
  const std::string which = options.ip + " of '" + options.rtl + "' and its model, on each clock";
  if (!still.empty()) {
    out << "NOT EXERCISED: " << vp::join(still, ", ") << "\n";
    err << "markervp: no difference seen between " << which << ", but " << vp::join(still, ", ")
        << " never changed: what was not exercised was not checked; play other pictures\n";
    return run_failed;
  }
  out << "equal: " << which << "\n";
  return done;
}

}  // namespace platform::cli
