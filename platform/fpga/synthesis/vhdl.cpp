#include <fpga/synthesis/vhdl.h>

#include <algorithm>
#include <iostream>
#include <regex>
#include <set>
#include <sstream>

#include <fpga/synthesis/vhdl_script.h>
#include <fpga/synthesis/yosys.h>
#include <host/process.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>

namespace platform::synthesis {

namespace fs = std::filesystem;

namespace {

/// What CMake's lists are made of.
std::string list_of(const std::vector<std::string>& items) {
  for (const std::string& item : items) {
    if (item.find_first_of(";\\") != std::string::npos)
      throw vp::InputError("'" + item + "': ';' and '\\' cannot be in a name of VHDL's sources");
  }
  return vp::join(items, ";");
}

/// What GHDL says, three errors at most, and what to do, which is the last line. Lines of the
/// source are left out.
std::string message_of(const std::string& printed) {
  static const std::regex placed(R"(^\S+:\d+:\d+:(?!(warning|note)))"),
      itself("^\\S*ghdl[^ :]*: (?!importation)");
  constexpr std::size_t most = 3;
  std::vector<std::string> said;
  std::string advice;
  std::istringstream lines(printed);
  for (std::string line; std::getline(lines, line); advice = line) {
    if (said.size() < most && (std::regex_search(line, placed) || std::regex_search(line, itself)))
      said.push_back(std::regex_replace(line, itself, ""));
  }
  said.push_back(advice);
  return vp::join(said, "; ");
}

/// Generics that take no number, in small letters.
std::set<std::string> boolean_generics(const Design& design) {
  static const std::regex declaration(R"(([\w\s,]+):\s*boolean\b)"), word(R"(\w+)");
  std::set<std::string> names;
  for (const fs::path& source : design.sources) {
    if (!is_vhdl(source)) continue;
    const std::vector<std::string> units = units_in(source);
    if (std::find(units.begin(), units.end(), vp::lower(design.top)) == units.end()) continue;
    const std::string text = vp::lower(vp::read_text(source, "source"));
    for (std::sregex_iterator m(text.begin(), text.end(), declaration), end; m != end; ++m) {
      const std::string list = (*m)[1];
      for (std::sregex_iterator n(list.begin(), list.end(), word), none; n != none; ++n)
        names.insert(n->str());
    }
  }
  return names;
}

}  // namespace

bool is_vhdl(const fs::path& source) {
  return source.extension() == ".vhd" || source.extension() == ".vhdl";
}

bool is_of_vhdl(const Design& design) {
  const fs::path *entity = nullptr, *module = nullptr;
  for (const fs::path& source : design.sources) {
    const std::vector<std::string> names = units_in(source);
    const std::string top = is_vhdl(source) ? vp::lower(design.top) : design.top;
    if (std::find(names.begin(), names.end(), top) == names.end()) continue;
    (is_vhdl(source) ? entity : module) = &source;
  }
  if (entity && module) {
    throw vp::InputError("'" + design.top + "' is an entity of " + entity->string() +
                         " and a module of " + module->string() +
                         ": give a folder that has one of them");
  }
  return entity;
}

Design verilog_of(const Design& design, const fs::path& folder) {
  const fs::path script = folder / "MarkervpVhdl.cmake", verilog = folder / (design.top + ".v");
  vp::write_file(script.string(), vhdl_script);
  std::vector<std::string> sources, generics;
  for (const fs::path& source : needed_by(design.top, design.sources)) {
    if (is_vhdl(source)) sources.push_back(fs::absolute(source).string());
  }
  std::vector<std::string> folders;
  for (const fs::path& include : design.includes) folders.push_back(fs::absolute(include).string());
  const std::set<std::string> booleans = boolean_generics(design);
  for (const auto& [name, value] : design.parameters) {
    const bool is_word = booleans.count(vp::lower(name)) != 0 && (value == 0 || value == 1);
    generics.push_back(name + "=" +
                       (is_word ? (value == 1 ? "true" : "false") : std::to_string(value)));
  }
  const host::CommandEnd end = host::run_command(
      {"cmake", "-DNAME=markervp", "-DTOP=" + design.top, "-DFILE=" + verilog.string(),
       "-DGENERICS=" + list_of(generics), "-DOPTIONS=" + list_of(design.ghdl_options),
       "-DSOURCES=" + list_of(sources), "-DRTL_INCLUDE_DIRS=" + list_of(folders), "-P",
       script.string()});
  if (end.exit_code == host::no_such_command)
    throw vp::InputError("VHDL needs CMake and GHDL: apt-get install cmake ghdl");
  if (end.exit_code != 0) {
    const fs::path refused = verilog.string() + ".refused";
    refuse(design, message_of(fs::exists(refused) ? vp::read_text(refused, "message") : end.out));
  }
  if (const fs::path warned = verilog.string() + ".warned"; fs::exists(warned))
    std::cerr << "markervp: warning: " << design.top << ": " << vp::read_text(warned, "warning")
              << std::endl;
  Design made = design;
  made.sources = {verilog};
  made.parameters.clear();
  for (const std::string& name : declared_in(vp::read_text(verilog, "Verilog of GHDL"))) {
    if (vp::lower(name) == vp::lower(design.top)) made.top = name;  // names of VHDL have no case
  }
  return made;
}

}  // namespace platform::synthesis
