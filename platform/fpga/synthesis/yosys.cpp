#include <fpga/synthesis/yosys.h>

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <sstream>

#include <fpga/synthesis/data_files.h>
#include <fpga/synthesis/simulation_text.h>
#include <fpga/synthesis/vhdl.h>
#include <host/document.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>

namespace platform::synthesis {

namespace {

namespace fs = std::filesystem;

constexpr const char *script_file = "script.ys", *instance_file = "instance.v",
                     *check_log = "check.txt", *elaboration_log = "elaboration.txt";

/// What a copy of a source prints where the source ends a simulation, before source and line.
constexpr const char* ends_here = "markervp: ends at ";

/// The commands behind it are looked at for what they print. (`tee` takes no name with a space in
/// it: the file lies where Yosys runs.)
constexpr const char* note_elaboration = "tee -q -o elaboration.txt ";

/// That Yosys and its ABC have open at once, besides the standard ones.
constexpr int yosys_descriptors = 9;

/// What Yosys wrote; "" if it did not come so far.
std::string log_of(const fs::path& file) {
  return fs::exists(file) && !fs::is_empty(file) ? vp::read_text(file, "log", host::largest_result)
                                                 : "";
}

/// In a script of Yosys.
std::string quoted(const fs::path& path) {
  if (path.string().find_first_of("\"\n") != std::string::npos) {
    throw vp::InputError("'" + path.string() + "': give a path without quotes and line ends");
  }
  return "\"" + path.string() + "\"";
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

std::vector<fs::path> without_vhdl(std::vector<fs::path> sources) {
  sources.erase(std::remove_if(sources.begin(), sources.end(), is_vhdl), sources.end());
  return sources;
}

/// A folder to include from, in the scratch folder: `-I` takes no name with a space in it.
std::string include_link(std::size_t number) {
  return "include_" + std::to_string(number);
}

/// The modules and entities that the sources declare.
std::vector<std::string> modules_in(const std::vector<fs::path>& sources) {
  std::vector<std::string> names;
  for (const fs::path& source : sources) {
    for (const std::string& name :
         declared_in(vp::read_text(source, "source"),
                     is_vhdl(source) ? "[Ee][Nn][Tt][Ii][Tt][Yy]" : "module"))
      names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

[[noreturn]] void refuse_name(const Design& design) {
  const std::vector<std::string> modules = modules_in(design.sources);
  const bool has_vhdl = std::any_of(design.sources.begin(), design.sources.end(), is_vhdl);
  throw vp::InputError("no module " + std::string(has_vhdl ? "or entity " : "") + "'" + design.top +
                       "' in the sources" +
                       (modules.empty() ? "" : ": name " + vp::one_of(modules)));
}

/// With a word about an error.
bool failed(const host::CommandEnd& end) {
  return end.exit_code != 0 && end.out.find("ERROR: ") != std::string::npos;
}

/// What is legal and Yosys 0.23 takes for an error: a format like "%2d" in what it prints while it
/// elaborates, calls that print or end a simulation, assertions with an action.
bool stumbled_over_simulation(const host::CommandEnd& end) {
  const auto says = [&](const char* what) { return end.out.find(what) != std::string::npos; };
  return failed(end) && (says("called with invalid/unsupported format specifier") ||
                         says("Can't resolve task name `$") || says("System task `$") ||
                         says("ERROR: syntax error"));
}

/// What a line has that SystemVerilog knows and Yosys 0.23 does not; "" for anything else.
std::string unread_construct(const std::string& line) {
  struct Construct {
    std::regex form;
    const char* name;
  };
  static const Construct constructs[] = {
      {std::regex(R"(\bparameter\s+type\b)"), "a parameter that is a type"},
      {std::regex(R"(\bimport\s+\w+\s*::)"), "an import of a package"},
      {std::regex(R"(\b(modport|interface|virtual)\b|\b\w+\s*\.\s*\w+\s+\w+\s*[,)])"),
       "an interface"},
      {std::regex(R"(\b\w+\s*::\s*\w+\s+\w+)"), "a type of a package"},
      {std::regex(R"('\{)"), "an assignment pattern"},
      {std::regex(R"(\b(input|output)\b[^,;]*\b\w+\s*\[)"), "an array as a port"},
      {std::regex(R"(\b(class|covergroup|bind|clocking|program)\b)"), "a part of test benches"}};
  for (const Construct& construct : constructs) {
    if (std::regex_search(line, construct.form)) return construct.name;
  }
  return {};
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != text.npos; at += to.size())
    text.replace(at, from.size(), to);
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

void refuse(const Design& design, const std::string& why) {
  throw vp::InputError("'" + design.top + "'" + parameters_text(design.parameters) + ": " + why);
}

std::string elaboration_of(const Design& design) {
  // `-chparam` knows no sign, so one below zero comes from an instance, which goes again.
  if (has_negative(design.parameters)) {
    return std::string("read_verilog ") + instance_file + "\n" + note_elaboration +
           "hierarchy -check -top markervp_instance\ndelete markervp_instance\n"
           "hierarchy -auto-top\nrename -top " +
           design.top;
  }
  std::string command = note_elaboration + ("hierarchy -check -top " + design.top);
  for (const auto& [name, value] : design.parameters)
    command += fmt::format(" -chparam {} {}", name, value);
  return command;
}

namespace {

/// A tool without room for its files ends as if it had written them.
void require_room(const fs::path& folder, const std::string& tool) {
  constexpr std::uintmax_t least = 4096;
  std::error_code error;
  const fs::space_info room = fs::space(folder, error);
  if (error || room.available >= least) return;
  throw vp::HostError("no room is left in '" + folder.parent_path().string() + "' for what " +
                      tool + " writes: make room, or let TMPDIR name another folder");
}

}  // namespace

host::CommandEnd run_in(const fs::path& folder, const std::vector<std::string>& command,
                        unsigned seconds) {
  std::vector<std::string> words{"env", "--chdir=" + folder.string()};
  if (seconds > 0) words.insert(words.end(), {"prlimit", "--cpu=" + std::to_string(seconds)});
  words.insert(words.end(), command.begin(), command.end());
  host::CommandEnd end = host::run_command(words, ".");
  require_room(folder, command.front());
  return end;
}

YosysFolder::YosysFolder(const Design& design)
    : design_(design),
      includes_(include_folders(design)),
      originals_(without_vhdl(design.sources)),
      sources_(originals_) {
  check_name(design.top, "module");
  if (sources_.empty()) refuse_name(design);
  for (const auto& [name, value] : design.parameters) check_name(name, "parameter");
  for (const std::string& definition : design.defines) check_definition(definition);
  for (std::size_t i = 0; i < includes_.size(); ++i)
    fs::create_directory_symlink(fs::absolute(includes_[i]), scratch_ / include_link(i));
  vp::write_file((scratch_ / instance_file).string(), instance_of(design));
  link_data();
}

/// Yosys looks for what memories are read from where it runs, then beside the source. A name that
/// leads up is found from the source on.
void YosysFolder::link_data() const {
  for (const auto& [name, file] : data_files_of(design_)) {
    const fs::path relative = fs::path(name).lexically_normal();
    if (relative.is_absolute() || *relative.begin() == "..") continue;
    fs::create_directories((scratch_ / relative.string()).parent_path());
    fs::create_symlink(file, scratch_ / relative.string());
  }
}

host::CommandEnd YosysFolder::run(const Script& script, unsigned seconds) {
  host::require_descriptors(yosys_descriptors, "yosys");
  host::CommandEnd end = run_script(script, seconds);
  if (failed(end) && read_only_what_is_needed()) end = run_script(script, seconds);
  if (stumbled_over_simulation(end)) {
    copy_without_simulation();
    end = run_script(script, seconds);
    refuse_endings();
  }
  name_originals(end.out);
  return end;
}

host::CommandEnd YosysFolder::run_script(const Script& script, unsigned seconds) const {
  vp::write_file((scratch_ / script_file).string(), script(reading()));
  return run_in(scratch_.path(), {"yosys", "-q", "-s", script_file}, seconds);
}

std::string YosysFolder::reading() const {
  std::string command = "read_verilog -sv -defer";
  for (std::size_t i = 0; i < includes_.size(); ++i) command += " -I " + include_link(i);
  for (const std::string& definition : design_.defines) command += " -D " + definition;
  for (const fs::path& source : sources_) command += " " + quoted(fs::absolute(source));
  return command;
}

/// A folder may have test benches, fragments to include and other designs beside what the top is
/// made of. False: it is made of all of them.
bool YosysFolder::read_only_what_is_needed() {
  const std::vector<fs::path> needed = needed_by(design_.top, sources_);
  if (needed.empty() || needed.size() == sources_.size()) return false;
  sources_ = originals_ = needed;
  return true;
}

/// Copies of the same lines.
void YosysFolder::copy_without_simulation() {
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    const std::string text = vp::read_text(sources_[i], "source");
    sources_[i] = scratch_ / (std::to_string(i) + "_" + sources_[i].filename().string());
    vp::write_file(sources_[i].string(),
                   without_simulation(text, ends_here + std::to_string(i) + ":"));
  }
}

/// Elaboration has come to a call that ends a simulation.
void YosysFolder::refuse_endings() const {
  const std::string log = log_of(scratch_ / elaboration_log);
  const std::size_t found = log.find(ends_here);
  if (found == std::string::npos) return;
  std::size_t source = 0, number = 0;
  char colon = 0;
  std::istringstream(log.substr(found + std::string(ends_here).size())) >> source >> colon >>
      number;
  std::istringstream lines(vp::read_text(originals_.at(source), "source"));
  std::string line;
  for (std::size_t i = 0; i < number; ++i) std::getline(lines, line);
  synthesis::refuse(design_,
                    originals_[source].string() + ":" + std::to_string(number) +
                        ": the RTL refuses its parameters: " + std::string(vp::trim(line)));
}

void YosysFolder::name_originals(std::string& text) const {
  for (std::size_t i = 0; i < sources_.size(); ++i)
    replace_all(text, sources_[i].string(), originals_[i].string());
  for (std::size_t i = 0; i < includes_.size(); ++i)
    replace_all(text, include_link(i) + "/", includes_[i].string() + "/");
}

std::string YosysFolder::place_of(const std::string& word, const std::string& name,
                                  const std::string& module) const {
  std::vector<fs::path> sources = originals_;
  std::stable_partition(sources.begin(), sources.end(), [&](const fs::path& source) {
    const std::vector<std::string> names = declared_in(vp::read_text(source, "source"));
    return std::find(names.begin(), names.end(), module) != names.end();
  });
  for (const fs::path& source : sources) {
    std::istringstream lines(vp::read_text(source, "source"));
    std::size_t number = 0;
    for (std::string line; std::getline(lines, line);) {
      ++number;
      if (line.find(word) != line.npos && line.find(name) != line.npos)
        return source.string() + ":" + std::to_string(number) + ": ";
    }
  }
  return {};
}

void YosysFolder::refuse_loops() const {
  std::string check = log_of(scratch_ / check_log);
  name_originals(check);
  const std::size_t loop = check.find("found logic loop");
  if (loop == std::string::npos) return;
  static const std::regex place(R"(([^\s$|]+:\d+))");
  std::smatch found;
  const std::string rest = check.substr(loop);
  const std::string where = std::regex_search(rest, found, place) ? found[1].str() + ": " : "";
  synthesis::refuse(design_, where + "a combinational loop: put a register into it");
}

void YosysFolder::refuse(const host::CommandEnd& end) const {
  if (end.exit_code == host::no_such_command) yosys_version();
  const std::string& out = end.out;
  std::smatch found;
  static const std::regex error(R"(([^\n]*)ERROR: ([^\n]*))");
  if (!std::regex_search(out, found, error)) {
    const std::size_t last_end = out.find_last_not_of('\n');
    const std::size_t begin = last_end == std::string::npos ? last_end : out.rfind('\n', last_end);
    const std::string last =
        last_end == std::string::npos ? "" : out.substr(begin + 1, last_end - begin);
    synthesis::refuse(design_, "yosys itself failed" + (last.empty() ? "" : ": " + last) +
                                   "; other parameters may work");
  }
  // Yosys knows no line of what it prints while it elaborates.
  const std::string where = std::regex_replace(found[1].str(), std::regex(":0: $"), ": ");
  const std::string what = found[2];
  static const std::regex missing("Can't open include file `([^']+)'");
  std::smatch file;
  if (std::regex_search(what, file, missing)) {
    synthesis::refuse(design_, place_of("`include", file[1], design_.top) + "no file '" +
                                   file[1].str() + "' to include: name its folder with --include");
  }
  static const std::regex data(R"(Can not open file `([^`']*)[`'] for \\?([$]\w+))");
  if (std::regex_search(what, file, data)) {
    const std::string call = place_of(file[2], file[1], design_.top);
    synthesis::refuse(design_, (call.empty() ? where : call) + "no file '" + file[1].str() +
                                   "' for " + file[2].str() +
                                   " beside the source, nor below the folders of the sources and "
                                   "of --include: its memory would have no words");
  }
  static const std::regex part(
      R"(Module `\\?([^']+)' referenced in module `(\$paramod[^\\]*\\)?\\?([^\\']+))");
  if (std::regex_search(what, file, part)) {
    synthesis::refuse(design_, place_of(file[1], file[1], file[3]) + "no module '" + file[1].str() +
                                   "' in the sources: add the file that declares it");
  }
  if (what.find("Module `" + design_.top + "' not found") != std::string::npos)
    refuse_name(design_);
  const std::string construct =
      what.find("syntax error") == std::string::npos ? "" : unread_construct(line_at(where));
  if (!construct.empty()) {
    synthesis::refuse(design_, where + "Yosys does not read " + construct +
                                   ": write it in another way, or give what sv2v makes of it "
                                   "(Verilator and markervp_add_rtl() read it)");
  }
  synthesis::refuse(design_, where + what);
}

/// Of a source, as messages name it: "file:line: ". Without one, "".
std::string YosysFolder::line_at(const std::string& place) const {
  static const std::regex form(R"(^(.+):(\d+): $)");
  std::smatch found;
  std::error_code ignored;
  if (!std::regex_match(place, found, form) || !fs::is_regular_file(found[1].str(), ignored))
    return {};
  std::istringstream lines(vp::read_text(found[1].str(), "source"));
  std::string line;
  for (unsigned long i = std::stoul(found[2]); i > 0 && std::getline(lines, line); --i) continue;
  return line;
}

}  // namespace platform::synthesis
