#include <fpga/synthesis/synthesis.h>

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <set>
#include <sstream>

#include <host/digest.h>
#include <host/document.h>
#include <host/guard.h>
#include <host/process.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>

namespace platform::synthesis {

namespace {

namespace fs = std::filesystem;

/// In a script of Yosys.
std::string quoted(const fs::path& path) {
  if (path.string().find_first_of("\"\n") != std::string::npos) {
    throw vp::InputError("'" + path.string() + "': give a path without quotes and line ends");
  }
  return "\"" + path.string() + "\"";
}

/// What Yosys wrote; "" if it did not come so far.
std::string log_of(const fs::path& file) {
  return fs::exists(file) && !fs::is_empty(file) ? vp::read_text(file, "log", host::largest_result)
                                                 : "";
}

/// Names go into a script, whose language has commands of the shell.
void check_name(const std::string& name, const char* what) {
  static const std::regex identifier("[A-Za-z_][A-Za-z0-9_]*");
  if (std::regex_match(name, identifier)) return;
  throw vp::InputError("'" + name + "' is no name of a " + what +
                       ": give one of letters, digits and _");
}

void check_definition(const std::string& definition) {
  static const std::regex form("[A-Za-z_][A-Za-z0-9_]*(=[A-Za-z0-9_'.+-]+)?");
  if (std::regex_match(definition, form)) return;
  throw vp::InputError("'" + definition + "' is no macro: give NAME or NAME=VALUE");
}

// In the scratch folder, where Yosys runs: `tee` takes no name with a space in it.
constexpr const char *check_log = "check.txt", *netlist_file = "netlist.json",
                     *instance_file = "instance.v";

bool has_negative(const Parameters& parameters) {
  return std::any_of(parameters.begin(), parameters.end(),
                     [](const auto& parameter) { return parameter.second < 0; });
}

/// A module with one instance of the design's top, with its parameters.
std::string instance_of(const Design& design) {
  std::string values;
  for (const auto& [name, value] : design.parameters)
    values += fmt::format("{}.{}({})", values.empty() ? "" : ", ", name, value);
  return fmt::format("module markervp_instance;\n  {} #({}) top();\nendmodule\n", design.top,
                     values);
}

/// Makes the top with its parameters. `-chparam` knows no sign, so one below zero comes from an
/// instance, which goes again.
std::string elaboration_of(const Design& design) {
  if (has_negative(design.parameters)) {
    return std::string("read_verilog ") + instance_file +
           "\nhierarchy -check -top markervp_instance\ndelete markervp_instance\n"
           "hierarchy -auto-top\nrename -top " +
           design.top;
  }
  std::string command = "hierarchy -check -top " + design.top;
  for (const auto& [name, value] : design.parameters)
    command += fmt::format(" -chparam {} {}", name, value);
  return command;
}

/// What maps logic into LUT. ABC9 knows delays, and crashes on memories with byte enables or with
/// two ports that write (yosys#3384, open since 0.17); ABC does not.
enum class Mapper { abc9, abc };

/// Folders in which sources find what they include.
std::vector<fs::path> include_folders(const Design& design) {
  std::vector<fs::path> folders = design.includes;
  for (const fs::path& source : design.sources) {
    const fs::path folder = fs::absolute(source).parent_path();
    if (std::find(folders.begin(), folders.end(), folder) == folders.end())
      folders.push_back(folder);
  }
  return folders;
}

/// A folder to include from, in the scratch folder: `-I` takes no name with a space in it.
std::string include_link(std::size_t number) {
  return "include_" + std::to_string(number);
}

/// What `read_verilog` gets; `sources` in place of the design's own.
std::string reading_of(const Design& design, const std::vector<fs::path>& sources) {
  std::string command = "read_verilog -sv -defer";
  for (std::size_t i = 0; i < include_folders(design).size(); ++i)
    command += " -I " + include_link(i);
  for (const std::string& definition : design.defines) command += " -D " + definition;
  for (const fs::path& source : sources) command += " " + quoted(fs::absolute(source));
  return command;
}

std::string script_of(const Design& design, const std::vector<fs::path>& sources, Mapper mapper) {
  // Deferred: only the modules that the top needs are elaborated. Yosys numbers what it makes, and
  // ties in the mapping fall by these numbers. The library is read here and not by synth_xilinx,
  // for there each pass goes through all of its 800 cells.
  std::string script =
      "read_verilog -lib -specify +/xilinx/cells_sim.v\n"
      "read_verilog -lib -defer +/xilinx/cells_xtra.v\n" +
      reading_of(design, sources);
  script += "\n" + elaboration_of(design) + "\nproc";
  script += std::string("\ntee -q -o ") + check_log + " check";
  script += std::string("\nsynth_xilinx -family xc7 -flatten") +
            (mapper == Mapper::abc9 ? " -abc9" : "") + " -run prepare: -top " + design.top;
  if (!design.dsp) script += " -nodsp";
  return script + "\nwrite_json " + netlist_file + "\n";
}

std::string parameters_of(const Design& design) {
  std::string text;
  for (const auto& [name, value] : design.parameters) text += fmt::format(" {}={}", name, value);
  return text;
}

[[noreturn]] void refuse(const Design& design, const std::string& why) {
  throw vp::InputError("'" + design.top + "'" + parameters_of(design) + ": " + why);
}

/// The modules that a text declares, or what else `what` says: an alternative of words.
std::vector<std::string> declared_in(const std::string& text, const char* what = "module") {
  const std::regex declaration("(^|\\n)\\s*(?:" + std::string(what) + ")\\s+(\\w+)");
  std::vector<std::string> names;
  for (std::sregex_iterator m(text.begin(), text.end(), declaration), end; m != end; ++m)
    names.push_back((*m)[2]);
  return names;
}

/// The modules that the sources declare.
std::vector<std::string> modules_in(const std::vector<fs::path>& sources) {
  std::vector<std::string> names;
  for (const fs::path& source : sources) {
    for (const std::string& name : declared_in(vp::read_text(source, "source")))
      names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// "file:line: " of the `include of a name.
std::string includer_of(const Design& design, const std::string& name) {
  for (const fs::path& source : design.sources) {
    std::istringstream lines(vp::read_text(source, "source"));
    std::size_t number = 0;
    for (std::string line; std::getline(lines, line);) {
      ++number;
      if (line.find("`include") != line.npos && line.find(name) != line.npos)
        return source.string() + ":" + std::to_string(number) + ": ";
    }
  }
  return {};
}

/// What Yosys says of an error, in our words where we know better.
[[noreturn]] void refuse_as_yosys_does(const Design& design, const std::string& out) {
  std::smatch found;
  static const std::regex error(R"(([^\n]*)ERROR: ([^\n]*))");
  if (!std::regex_search(out, found, error)) {
    const std::size_t end = out.find_last_not_of('\n');
    const std::size_t begin = end == std::string::npos ? end : out.rfind('\n', end);
    const std::string last = end == std::string::npos ? "" : out.substr(begin + 1, end - begin);
    refuse(design, "yosys itself failed" + (last.empty() ? "" : ": " + last) +
                       "; other parameters may work");
  }
  // Yosys knows no line of what it prints while it elaborates.
  const std::string where = std::regex_replace(found[1].str(), std::regex(":0: $"), ": ");
  const std::string what = found[2];
  static const std::regex missing("Can't open include file `([^']+)'");
  std::smatch file;
  if (std::regex_search(what, file, missing)) {
    refuse(design, includer_of(design, file[1]) + "no file '" + file[1].str() +
                       "' to include: name its folder with --include");
  }
  if (what.find("Module `" + design.top + "' not found") != std::string::npos) {
    const std::vector<std::string> modules = modules_in(design.sources);
    throw vp::InputError("no module '" + design.top + "' in the sources" +
                         (modules.empty() ? "" : ": name " + vp::one_of(modules)));
  }
  refuse(design, where + what);
}

void refuse_loops(const Design& design, const std::string& check) {
  const std::size_t loop = check.find("found logic loop");
  if (loop == std::string::npos) return;
  static const std::regex place(R"(([^\s$|]+:\d+))");
  std::smatch found;
  const std::string rest = check.substr(loop);
  const std::string where = std::regex_search(rest, found, place) ? found[1].str() + ": " : "";
  refuse(design, where + "a combinational loop: put a register into it");
}

fs::path rtl_folder() {
  for (const std::string& library : host::library_folders()) {
    for (const char* up : {"../..", "../../.."}) {
      const fs::path folder = fs::path(library) / up / "share/markervp/rtl";
      if (fs::exists(folder)) return fs::canonical(folder);
    }
  }
  throw vp::InputError("no RTL is installed in share/markervp/rtl; install markervp completely");
}

/// What figures are kept of: the defaults, and the parameters on which size or speed depend.
std::vector<std::pair<std::string, Parameters>> own_variants() {
  return {{"axi_image_store", {}},
          {"axi_threshold_bridge", {{"FIFO_DEPTH", 64}}},
          {"axi_threshold_bridge", {{"FIFO_DEPTH", 256}}},
          {"axi_threshold_bridge", {{"FIFO_DEPTH", 512}}},
          {"blob_detection", {{"LABELS", 16}}},
          {"blob_detection", {{"LABELS", 64}}},
          {"blob_detection", {{"LABELS", 128}}},
          {"blob_labelling", {{"LABELS", 128}, {"PIXELS_PER_CLOCK", 1}, {"WIDTH", 640}}},
          {"blob_labelling", {{"LABELS", 512}, {"PIXELS_PER_CLOCK", 1}, {"WIDTH", 640}}},
          {"blob_labelling", {{"LABELS", 512}, {"PIXELS_PER_CLOCK", 1}, {"WIDTH", 1280}}},
          {"blob_labelling", {{"LABELS", 512}, {"PIXELS_PER_CLOCK", 2}, {"WIDTH", 640}}},
          {"blob_labelling", {{"LABELS", 512}, {"PIXELS_PER_CLOCK", 2}, {"WIDTH", 1280}}},
          {"blob_labelling", {{"LABELS", 512}, {"PIXELS_PER_CLOCK", 4}, {"WIDTH", 640}}},
          {"blob_labelling", {{"LABELS", 512}, {"PIXELS_PER_CLOCK", 4}, {"WIDTH", 1280}}},
          {"blob_stream", {{"FIFO_DEPTH", 64}}},
          {"blob_stream", {{"FIFO_DEPTH", 512}}},
          {"camera", {{"PIXELS_PER_CLOCK", 1}}},
          {"camera", {{"PIXELS_PER_CLOCK", 2}}},
          {"camera", {{"PIXELS_PER_CLOCK", 4}}},
          {"clock_crossing", {}},
          {"control_block", {}},
          {"control_crossing", {}},
          {"corner_detection", {{"LEAN", 0}}},
          {"corner_detection", {{"LEAN", 1}}},
          {"feature_packaging", {{"BUFFER_DEPTH", 16}}},
          {"feature_packaging", {{"BUFFER_DEPTH", 100}}},
          {"feature_packaging", {{"BUFFER_DEPTH", 256}}},
          {"frame_status", {}},
          {"global_threshold", {{"PIXELS_PER_CLOCK", 1}}},
          {"global_threshold", {{"PIXELS_PER_CLOCK", 2}}},
          {"global_threshold", {{"PIXELS_PER_CLOCK", 4}}},
          {"local_threshold", {{"PIXELS_PER_CLOCK", 1}, {"RADIUS", 1}, {"RELATIVE", 0}}},
          {"local_threshold", {{"PIXELS_PER_CLOCK", 1}, {"RADIUS", 1}, {"RELATIVE", 3}}},
          {"local_threshold", {{"PIXELS_PER_CLOCK", 1}, {"RADIUS", 5}, {"RELATIVE", 0}}},
          {"local_threshold", {{"PIXELS_PER_CLOCK", 1}, {"RADIUS", 5}, {"RELATIVE", 3}}},
          {"local_threshold", {{"PIXELS_PER_CLOCK", 1}, {"RADIUS", 15}, {"RELATIVE", 0}}},
          {"local_threshold", {{"PIXELS_PER_CLOCK", 1}, {"RADIUS", 15}, {"RELATIVE", 3}}},
          {"local_threshold", {{"PIXELS_PER_CLOCK", 1}, {"RADIUS", 31}, {"RELATIVE", 0}}},
          {"local_threshold", {{"PIXELS_PER_CLOCK", 1}, {"RADIUS", 31}, {"RELATIVE", 3}}},
          {"local_threshold", {{"PIXELS_PER_CLOCK", 2}, {"RADIUS", 5}, {"RELATIVE", 0}}},
          {"local_threshold", {{"PIXELS_PER_CLOCK", 2}, {"RADIUS", 5}, {"RELATIVE", 3}}},
          {"local_threshold", {{"PIXELS_PER_CLOCK", 2}, {"RADIUS", 31}, {"RELATIVE", 0}}},
          {"local_threshold", {{"PIXELS_PER_CLOCK", 2}, {"RADIUS", 31}, {"RELATIVE", 3}}},
          {"local_threshold", {{"PIXELS_PER_CLOCK", 4}, {"RADIUS", 5}, {"RELATIVE", 0}}},
          {"local_threshold", {{"PIXELS_PER_CLOCK", 4}, {"RADIUS", 5}, {"RELATIVE", 3}}},
          {"local_threshold", {{"PIXELS_PER_CLOCK", 4}, {"RADIUS", 31}, {"RELATIVE", 0}}},
          {"local_threshold", {{"PIXELS_PER_CLOCK", 4}, {"RADIUS", 31}, {"RELATIVE", 3}}},
          {"otsu_threshold", {{"PIXELS_PER_CLOCK", 1}}},
          {"otsu_threshold", {{"PIXELS_PER_CLOCK", 2}}},
          {"otsu_threshold", {{"PIXELS_PER_CLOCK", 4}}},
          {"pixel_stream", {{"FIFO_DEPTH", 64}, {"PIXELS_PER_CLOCK", 1}}},
          {"pixel_stream", {{"FIFO_DEPTH", 512}, {"PIXELS_PER_CLOCK", 1}}},
          {"pixel_stream", {{"FIFO_DEPTH", 64}, {"PIXELS_PER_CLOCK", 2}}},
          {"pixel_stream", {{"FIFO_DEPTH", 64}, {"PIXELS_PER_CLOCK", 4}}},
          {"sensor_input", {}},
          {"stream_crossing", {{"DEPTH", 16}}},
          {"stream_crossing", {{"DEPTH", 64}}},
          {"stream_crossing", {{"DEPTH", 256}}}};
}

/// The sources that the top needs, and what those include.
std::map<std::string, std::string> hashes_of(const Design& design) {
  static const std::regex include(R"re(`include\s+"([^"]+)")re");
  std::vector<fs::path> open = needed_by(design.top, design.sources);
  std::map<std::string, std::string> hashes;
  while (!open.empty()) {
    const fs::path source = open.back();
    open.pop_back();
    const bool fresh =
        hashes.emplace(source.filename().string(), host::file_hash(source.string())).second;
    if (!fresh) continue;
    const std::string text = vp::read_text(source.string(), "source");
    for (std::sregex_iterator m(text.begin(), text.end(), include), end; m != end; ++m) {
      std::vector<fs::path> folders{source.parent_path()};
      folders.insert(folders.end(), design.includes.begin(), design.includes.end());
      for (const fs::path& folder : folders) {
        if (!fs::exists(folder / (*m)[1].str())) continue;
        open.push_back(folder / (*m)[1].str());
        break;
      }
    }
  }
  return hashes;
}

}  // namespace

std::string yosys_version() {
  const host::CommandEnd end = host::run_command({"yosys", "-V"});
  if (end.exit_code == host::no_such_command) {
    throw vp::InputError("yosys is not installed: apt-get install yosys, or scripts/setup --rtl");
  }
  std::istringstream words(end.out);
  std::string name, version;
  words >> name >> version;
  return name + " " + version;
}

std::vector<fs::path> needed_by(const std::string& top, const std::vector<fs::path>& sources) {
  static const std::regex comment(R"(//[^\n]*|/\*[^]*?\*/)"), word(R"([A-Za-z_]\w*)");
  std::map<std::string, std::size_t> declares;  // by name, the source
  std::vector<std::string> texts;
  for (const fs::path& source : sources) {
    texts.push_back(std::regex_replace(vp::read_text(source, "source"), comment, " "));
    for (const std::string& name : declared_in(texts.back(), "module|package|interface"))
      declares.emplace(name, texts.size() - 1);
  }
  std::vector<std::string> open{top};
  std::set<std::size_t> needed;
  while (!open.empty()) {
    const auto found = declares.find(open.back());
    open.pop_back();
    if (found == declares.end() || !needed.insert(found->second).second) continue;
    const std::string& text = texts[found->second];
    for (std::sregex_iterator m(text.begin(), text.end(), word), end; m != end; ++m)
      open.push_back(m->str());
  }
  std::vector<fs::path> found;
  found.reserve(needed.size());
  for (const std::size_t i : needed) found.push_back(sources[i]);
  return found;
}

std::vector<Design> own_designs(const std::vector<std::string>& only) {
  const std::vector<fs::path> sources = sources_in(rtl_folder());
  std::vector<std::string> names;
  std::vector<Design> designs;
  for (const auto& [ip, parameters] : own_variants()) {
    if (std::find(names.begin(), names.end(), ip) == names.end()) names.push_back(ip);
    if (only.empty() || std::find(only.begin(), only.end(), ip) != only.end()) {
      designs.push_back({ip, ip, needed_by(ip, sources), parameters, true, true});
    }
  }
  for (const std::string& name : only) {
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      throw vp::InputError("no RTL of an IP '" + name + "': name " + vp::one_of(names) +
                           ", or give your own with --rtl and --top");
    }
  }
  return designs;
}

std::vector<fs::path> sources_in(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path& path = entry->path();
    if (path.extension() == ".v" || path.extension() == ".sv") found.push_back(path);
  }
  if (error) throw vp::InputError("'" + folder.string() + "': " + error.message());
  if (found.empty()) {
    throw vp::InputError("'" + folder.string() +
                         "' has no .v or .sv file; VHDL becomes one with "
                         "ghdl --synth --out=verilog");
  }
  std::sort(found.begin(), found.end());
  return found;
}

namespace {

/// That Yosys and its ABC have open at once, besides the standard ones.
constexpr int yosys_descriptors = 9;

/// Yosys stopped without a word about an error.
bool crashed(const host::CommandEnd& end) {
  return end.exit_code != 0 && end.exit_code != host::no_such_command &&
         end.out.find("ERROR: ") == std::string::npos;
}

/// Yosys prints what a $display says while it elaborates, and knows no widths in its formats:
/// "%2d".
bool stumbled_over_a_format(const host::CommandEnd& end) {
  return end.exit_code != 0 &&
         end.out.find("called with invalid/unsupported format specifier") != std::string::npos;
}

/// Copies of the sources, of the same lines, without widths in formats.
std::vector<fs::path> without_format_widths(const Design& design, const fs::path& folder) {
  static const std::regex width(R"((%)[0-9]+([a-zA-Z]))");
  std::vector<fs::path> copies;
  for (const fs::path& source : design.sources) {
    std::istringstream lines(vp::read_text(source, "source"));
    std::string text;
    for (std::string line; std::getline(lines, line); text += line + "\n") {
      if (line.find("$") != line.npos) line = std::regex_replace(line, width, "$1$2");
    }
    const std::string number = std::to_string(copies.size()) + "_";
    copies.push_back(folder / (number + source.filename().string()));
    vp::write_file(copies.back().string(), text);
  }
  return copies;
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != text.npos; at += to.size())
    text.replace(at, from.size(), to);
}

/// With the design's own files in messages, in place of copies and links.
void name_originals(std::string& text, const Design& design, const std::vector<fs::path>& sources) {
  for (std::size_t i = 0; i < sources.size(); ++i)
    replace_all(text, sources[i].string(), design.sources[i].string());
  const std::vector<fs::path> folders = include_folders(design);
  for (std::size_t i = 0; i < folders.size(); ++i)
    replace_all(text, include_link(i) + "/", folders[i].string() + "/");
}

host::CommandEnd run_yosys(const Design& design, const std::vector<fs::path>& sources,
                           Mapper mapper, const fs::path& folder) {
  constexpr const char* script = "synthesise.ys";
  vp::write_file((folder / script).string(), script_of(design, sources, mapper));
  vp::write_file((folder / instance_file).string(), instance_of(design));
  // Yosys gives names to a shell unquoted: in its own folder they have no spaces.
  return host::run_command({"env", "--chdir=" + folder.string(), "yosys", "-q", "-s", script}, ".");
}

}  // namespace

Figures synthesise(const Design& design, const PathTiming& timing) {
  check_name(design.top, "module");
  for (const auto& [name, value] : design.parameters) check_name(name, "parameter");
  for (const std::string& definition : design.defines) check_definition(definition);
  const host::ScratchFolder scratch("synth");
  host::require_descriptors(yosys_descriptors, "yosys");
  const std::vector<fs::path> folders = include_folders(design);
  for (std::size_t i = 0; i < folders.size(); ++i)
    fs::create_directory_symlink(fs::absolute(folders[i]), scratch / include_link(i));
  std::vector<fs::path> sources = design.sources;
  host::CommandEnd end = run_yosys(design, sources, Mapper::abc9, scratch.path());
  if (stumbled_over_a_format(end)) {
    sources = without_format_widths(design, scratch.path());
    end = run_yosys(design, sources, Mapper::abc9, scratch.path());
  }
  const bool fell_back = crashed(end);
  if (fell_back) end = run_yosys(design, sources, Mapper::abc, scratch.path());
  name_originals(end.out, design, sources);
  refuse_loops(design, log_of(scratch / check_log));
  if (end.exit_code == host::no_such_command) yosys_version();
  if (end.exit_code != 0) refuse_as_yosys_does(design, end.out);
  try {
    Figures figures{design.ip, design.parameters, hashes_of(design),
                    read_netlist(scratch / netlist_file, design.top, timing), design.own};
    if (fell_back) {
      figures.netlist.not_covered.push_back(
          "ABC9 fails on a memory of this RTL (yosys#3384), so ABC mapped the logic, without "
          "delays: "
          "what the other would make shorter");
    }
    return figures;
  } catch (const vp::InputError& error) {
    refuse(design, error.what());
  }
}

}  // namespace platform::synthesis
