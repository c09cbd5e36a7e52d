#include <chip/handoff/rtl_sources.h>

#include <chip/handoff/rtl_primitives.h>
#include <chip/handoff/xml.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>
#include <vp/unit.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string_view>

namespace platform::handoff {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_files = 50'000;
constexpr std::uint64_t largest_source = 1 << 24;

bool is_verilog(const fs::path& path) {
  const std::string ending = path.extension().string();
  return ending == ".v" || ending == ".sv";
}

bool is_vhdl(const fs::path& path) {
  const std::string ending = path.extension().string();
  return ending == ".vhd" || ending == ".vhdl";
}

/// The words of a source, comments of a line left out.
std::vector<std::string_view> words(std::string_view text, std::string_view comment) {
  std::vector<std::string_view> list;
  std::size_t at = 0;
  const auto in_word = [&](std::size_t i) {
    return std::isalnum(static_cast<unsigned char>(text[i])) || text[i] == '_' || text[i] == '$';
  };
  while (at < text.size()) {
    if (text.compare(at, comment.size(), comment) == 0) {
      at = std::min(text.find('\n', at), text.size());
    } else if (in_word(at)) {
      const std::size_t first = at;
      while (at < text.size() && in_word(at)) ++at;
      list.push_back(text.substr(first, at - first));
    } else {
      ++at;
    }
  }
  return list;
}

std::string text_of(const std::string& path) {
  return vp::read_text(path, "RTL", largest_source);
}

std::string child(const pugi::xml_node& node, const char* name) {
  return vp::visible(node.child((std::string("spirit:") + name).c_str()).text().get());
}

/// The revision that the vendor's tool counted or stamped: of all of the file's, the only one.
std::string revision_of(const pugi::xml_node& component) {
  const pugi::xml_node node = component.find_node([](const pugi::xml_node& one) {
    return std::string_view(one.name()) == "xilinx:coreRevision";
  });
  return vp::visible(node.text().get());
}

}  // namespace

RtlFinder::RtlFinder(const std::vector<std::string>& folders) : empty_(folders.empty()) {
  std::size_t count = 0;
  for (const std::string& folder : folders) {
    std::error_code ignored;
    if (!fs::is_directory(folder, ignored))
      throw vp::InputError("no folder '" + folder + "' of RTL");
    std::vector<std::string> files;
    const auto options = fs::directory_options::skip_permission_denied;
    for (const auto& entry : fs::recursive_directory_iterator(folder, options)) {
      if (++count > most_files) {
        throw vp::InputError("more than " + std::to_string(most_files) + " files in '" + folder +
                             "': name the folders of the RTL");
      }
      if (entry.is_regular_file(ignored)) files.push_back(fs::absolute(entry.path()).string());
    }
    std::sort(files.begin(), files.end());
    for (const std::string& file : files) add_file(file);
  }
}

void RtlFinder::add_file(const std::string& path) {
  if (fs::path(path).filename() == "component.xml") {
    const XmlDocument xml(text_of(path), path);
    const pugi::xml_node root = xml.root("spirit:component");
    const std::string name =
        child(root, "vendor") + ":" + child(root, "library") + ":" + child(root, "name");
    components_[name].push_back(path);
    return;
  }
  if (!is_vhdl(path)) by_filename_[fs::path(path).filename().string()].push_back(path);
  if (!is_verilog(path) && !is_vhdl(path)) return;
  const std::string text = text_of(path);
  const auto list = words(text, is_vhdl(path) ? "--" : "//");
  for (std::size_t i = 0; i + 1 < list.size(); ++i) {
    const bool declares = is_vhdl(path)
                              ? list[i] == "entity" && i + 2 < list.size() && list[i + 2] == "is"
                              : list[i] == "module" && (i == 0 || list[i - 1] != "end");
    if (!declares) continue;
    const auto [known, is_new] = modules_.emplace(list[i + 1], path);
    if (is_new || known->second == path) continue;
    std::vector<std::string>& files = declared_twice_[known->first];
    if (files.empty()) files.push_back(known->second);
    if (files.back() != path) files.push_back(path);
  }
}

namespace {

/// Generics of VHDL that are vectors, by name, and their values in the source: no numbers, so that
/// a build cannot set them.
std::map<std::string, std::uint64_t> vector_generics(const std::string& text) {
  static const std::regex declaration(
      R"re((\w+)\s*:\s*(?:std_u?logic|bit)_vector\s*(?:\([^:;)]*\))?\s*:=\s*([xXbB]?)"([0-9A-Fa-f_]+)")re",
      std::regex::icase);
  constexpr int hexadecimal = 16, binary = 2;
  std::map<std::string, std::uint64_t> list;
  for (std::sregex_iterator match(text.begin(), text.end(), declaration), end; match != end;
       ++match) {
    std::string digits = (*match)[3];
    digits.erase(std::remove(digits.begin(), digits.end(), '_'), digits.end());
    const bool is_hex = (*match)[2] == "x" || (*match)[2] == "X";
    list.emplace((*match)[1],
                 std::strtoull(digits.c_str(), nullptr, is_hex ? hexadecimal : binary));
  }
  return list;
}

/// The numbers among the parameters of the design that the module declares, in its header or behind
/// the word `parameter`; "NAME=number".
/// `why` says which one cannot be set.
std::vector<std::string> declared_parameters(const std::string& file, const Module& module,
                                             const std::string& top, std::string& why) {
  const std::string text = text_of(file);
  const auto list = words(text, is_vhdl(file) ? "--" : "//");
  std::set<std::string_view> declared;
  bool in_header = false;
  for (std::size_t i = 1; i < list.size(); ++i) {
    if (list[i] == top && (list[i - 1] == "module" || list[i - 1] == "entity")) in_header = true;
    if (list[i] == "input" || list[i] == "output" || list[i] == "port") in_header = false;
    const bool behind = list[i - 1] == "parameter" || (i > 1 && list[i - 2] == "parameter");
    if (in_header || behind) declared.insert(list[i]);
  }
  const auto vectors =
      is_vhdl(file) ? vector_generics(text) : std::map<std::string, std::uint64_t>();
  std::vector<std::string> result;
  for (const auto& [name, value] : module.parameters) {
    const auto number = vp::Decimal::parse(value);
    const vp::Decimal::Whole whole = number ? number->whole().value_or(-1) : -1;
    const auto vector = vectors.find(name);
    if (declared.count(name) != 0 && vector != vectors.end()) {
      if (whole != vp::Decimal::Whole{vector->second})
        why = "its generic " + name + " is a vector, and only the value in " + file +
              " can be built, not " + value;
      continue;
    }
    if (declared.count(name) != 0 && whole >= 0 && whole <= UINT32_MAX)
      result.push_back(name + "=" + std::to_string(static_cast<std::uint64_t>(whole)));
  }
  return result;
}

/// A port of the design that the source of a module does not speak of: it is another module, or
/// another revision of it; empty: none. A file that it includes may have ports, too.
std::string lacking_port(const std::string& file, const Module& module) {
  const std::string text = text_of(file);
  if (text.find("`include") != std::string::npos) return {};
  std::set<std::string> known;
  for (const std::string_view word : words(text, is_vhdl(file) ? "--" : "//"))
    known.insert(vp::lower(word));
  for (const Port& port : module.ports)
    if (!port.signal.empty() && known.count(vp::lower(port.name)) == 0) return port.name;
  return {};
}

/// The RTL that sets of files of a component.xml list, and the IP of the vendor's (.xci).
std::vector<fs::path> listed_files(const pugi::xml_node& root, const fs::path& folder,
                                   const std::set<std::string>& sets) {
  std::vector<fs::path> list;
  for (const auto& files : root.child("spirit:fileSets").children("spirit:fileSet")) {
    if (sets.count(child(files, "name")) == 0) continue;
    for (const auto& file : files.children("spirit:file")) {
      const fs::path path = (folder / child(file, "name")).lexically_normal();
      if (is_verilog(path) || is_vhdl(path) || path.extension() == ".xci") list.push_back(path);
    }
  }
  return list;
}

}  // namespace

RtlSources RtlFinder::find(const Module& module) const {
  RtlSources sources = look(module);
  add_primitives(sources);
  add_includes(sources);
  add_data(sources);
  for (const Port& port : module.ports) {
    if (port.kind == "rst" && port.direction == 'I' && port.active_high)
      sources.interfaces.push_back(port.name + ": reset high");
  }
  std::string refused;
  const auto file = modules_.find(sources.top);
  if (!sources.files.empty() && file != modules_.end()) {
    const std::string top = file_of(sources.top, sources.files.front(), sources.files);
    const std::string port = lacking_port(top, module);
    if (port.empty())
      sources.parameters = declared_parameters(top, module, sources.top, refused);
    else
      refused = top + " has no port '" + port + "' for its module '" + sources.top +
                "': it is another one, or of another revision than the design";
  }
  if (refused.empty()) return sources;
  sources.why = refused;
  sources.files.clear();
  return sources;
}

std::string RtlFinder::data_file(const std::string& path) const {
  const auto known = by_filename_.find(fs::path(path).filename().string());
  if (known == by_filename_.end()) return {};
  const std::size_t up = path.rfind("../");
  const std::string ending = "/" + (up == std::string::npos ? path : path.substr(up + 3));
  for (const std::string& file : known->second) {
    if (file.size() > ending.size() &&
        file.compare(file.size() - ending.size(), ending.size(), ending) == 0)
      return file;
  }
  return known->second.size() == 1 ? known->second.front() : std::string();
}

// Their models are the vendor's, and may be in a folder, too; of simple ones the build has some.
void RtlFinder::add_primitives(RtlSources& sources) const {
  for (std::size_t i = 0; i < sources.files.size(); ++i) {
    const std::string file = sources.files[i];
    for (const std::string& primitive : primitives_in(text_of(file), is_vhdl(file))) {
      const auto model = modules_.find(primitive);
      if (model == modules_.end()) {
        if (has_model(primitive, is_vhdl(file))) continue;
        sources.why = file + " instantiates " + primitive +
                      ", a primitive of the chip (UG953): name a folder that has a model of it";
        sources.files.clear();
        return;
      }
      if (std::find(sources.files.begin(), sources.files.end(), model->second) ==
          sources.files.end())
        sources.files.push_back(model->second);
    }
  }
}

/// The file that one includes by this name: beside it, else in any folder. Empty: it is missing.
std::string RtlFinder::included(const std::string& name, const std::string& by) const {
  std::string beside = (fs::path(by).parent_path() / name).lexically_normal().string();
  std::error_code ignored;
  if (fs::is_regular_file(beside, ignored)) return beside;
  const auto known = by_filename_.find(fs::path(name).filename().string());
  if (known == by_filename_.end()) return {};
  const std::string ending = "/" + name;
  for (const std::string& path : known->second) {
    if (path.size() > ending.size() &&
        path.compare(path.size() - ending.size(), ending.size(), ending) == 0)
      return path;
  }
  return {};
}

// Vivado looks in the folder of the file that includes another one, too, and in all of a project.
void RtlFinder::add_includes(RtlSources& sources) const {
  static const std::regex directive("`include\\s*\"([^\"]+)\"");
  std::vector<std::string> files = sources.files;
  std::set<std::string> seen(files.begin(), files.end()), folders;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const std::string by = files[i];
    if (is_vhdl(by)) continue;
    const std::string text = text_of(by), always = unconditional(text, false);
    for (std::sregex_iterator at(text.begin(), text.end(), directive), end; at != end; ++at) {
      const std::string name = (*at)[1], path = included(name, by);
      if (!path.empty()) {
        if (seen.insert(path).second) files.push_back(path);
        if (folders.insert(path.substr(0, path.size() - name.size())).second)
          sources.include_dirs.push_back(path.substr(0, path.size() - name.size()));
        // Its text is in the file that includes it.
        sources.files.erase(std::remove(sources.files.begin(), sources.files.end(), path),
                            sources.files.end());
      } else if (always.find(at->str()) != std::string::npos) {
        sources.why = by + " includes '" + name + "', which is missing: name its folder";
        sources.files.clear();
        return;
      }
    }
  }
}

// What $readmemh, $readmemb and textio read is a file of the project, wherever that has it. The
// build looks below these folders.
void RtlFinder::add_data(RtlSources& sources) const {
  static const std::regex call(R"(\$readmem|\$fopen|textio)", std::regex::icase),
      named(R"re("([A-Za-z0-9_./: +-]+\.[A-Za-z0-9_]+)")re");
  std::string all;
  for (const std::string& file : sources.files) all += text_of(file) + "\n";
  if (!std::regex_search(all, call)) return;
  std::vector<std::string>& folders = sources.include_dirs;
  for (std::sregex_iterator at(all.begin(), all.end(), named), end; at != end; ++at) {
    const fs::path name((*at)[1].str());
    const auto known = by_filename_.find(name.filename().string());
    if (known == by_filename_.end() || is_verilog(name)) continue;
    for (const std::string& file : known->second) {
      const std::string folder = file.substr(0, file.rfind('/') + 1);
      const bool is_below = std::any_of(sources.files.begin(), sources.files.end(),
                                        [&folder](const std::string& source) {
                                          const std::size_t size = source.rfind('/') + 1;
                                          return folder.compare(0, size, source, 0, size) == 0;
                                        });
      if (!is_below && std::find(folders.begin(), folders.end(), folder) == folders.end())
        folders.push_back(folder);
    }
  }
}

const std::vector<std::string>& RtlFinder::components_of(const Module& module) const {
  static const std::vector<std::string> none;
  const auto vlnv = vp::split(module.vlnv, ':');
  const auto packaged_as = components_.find(vlnv[0] + ":" + vlnv[1] + ":" + vlnv[2]);
  return packaged_as == components_.end() ? none : packaged_as->second;
}

std::vector<OwnDriver> RtlFinder::drivers(const Handoff& handoff) const {
  std::set<std::string> seen;
  std::vector<OwnDriver> result;
  for (const Module& module : handoff.modules) {
    for (const std::string& component : components_of(module)) {
      const fs::path folder = fs::path(component).parent_path();
      std::error_code ignored;
      if (!seen.insert(component).second || !fs::is_directory(folder / "drivers", ignored))
        continue;
      std::vector<PathAndText> files;
      for (const auto& entry : fs::recursive_directory_iterator(
               folder / "drivers", fs::directory_options::skip_permission_denied, ignored)) {
        const std::string name = entry.path().lexically_relative(folder).generic_string();
        if (entry.is_regular_file(ignored) && is_of_driver(name))
          files.emplace_back(name, vp::read_text(entry.path().string(), "driver", largest_source));
      }
      std::sort(files.begin(), files.end());
      for (OwnDriver& driver : own_drivers(files)) result.push_back(std::move(driver));
    }
  }
  return result;
}

RtlSources RtlFinder::look(const Module& module) const {
  const std::vector<std::string>& components = components_of(module);
  if (components.empty()) return by_name(module);
  RtlSources last;
  for (const std::string& component : components) {
    last = packaged(module, component);
    if (!last.files.empty()) return last;
  }
  // Of a module reference Vivado writes a description without its sources.
  const bool is_reference = vp::split(module.vlnv, ':').at(1) == "module_ref";
  return is_reference ? by_name(module) : last;
}

RtlSources RtlFinder::packaged(const Module& module, const std::string& component) const {
  const XmlDocument xml(text_of(component), component);
  const pugi::xml_node root = xml.root("spirit:component");
  RtlSources sources;
  const std::string revision = revision_of(root);
  if (!revision.empty() && !module.revision.empty() && revision != module.revision) {
    sources.why =
        component + " is revision " + revision + " of it, the design has " + module.revision;
    return sources;
  }
  std::set<std::string> sets;
  for (const auto& view :
       root.child("spirit:model").child("spirit:views").children("spirit:view")) {
    const std::string name = child(view, "name");
    const bool synthesis = name.find("synthesis") != std::string::npos;
    const bool first_choice = name.find("verilogsynthesis") != std::string::npos;
    if (!synthesis || (!sets.empty() && !first_choice)) continue;
    sources.top = child(view, "modelName");
    sets.clear();  // one of the IP's own and one for each IP of the vendor's in it
    for (const auto& set : view.children("spirit:fileSetRef")) sets.insert(child(set, "localName"));
  }
  std::string core;
  for (const fs::path& path : listed_files(root, fs::path(component).parent_path(), sets)) {
    const bool is_core = path.extension() == ".xci";
    const auto model = is_core ? modules_.find(path.stem().string()) : modules_.end();
    if (is_core && model == modules_.end()) {
      core = path.string();
    } else {
      sources.files.push_back(is_core ? model->second : path.string());
    }
  }
  std::error_code ignored;
  for (const std::string& file : sources.files) {
    if (fs::exists(file, ignored)) continue;
    sources.why = component + " lists '" + file + "', which is missing";
    sources.files.clear();
    break;
  }
  if (!core.empty() && sources.why.empty()) {
    sources.why = component + " has an IP of the vendor's in it, " + core +
                  ", of which there are no sources: name a folder that has a module of its name";
    sources.files.clear();
  }
  if (sources.files.empty() && sources.why.empty())
    sources.why = component + " lists no Verilog or VHDL for synthesis";
  return sources;
}

/// Where a module is that `user` names, empty if nowhere. Projects keep copies of a module: of
/// several files the one that is taken already, else the one nearest to it.
std::string RtlFinder::file_of(const std::string& name, const std::string& user,
                               const std::vector<std::string>& taken) const {
  const auto only = modules_.find(name);
  if (only == modules_.end()) return {};
  const auto several = declared_twice_.find(name);
  if (several == declared_twice_.end()) return only->second;
  const auto shared = [&user](const std::string& path) {
    return std::mismatch(path.begin(), path.end(), user.begin(), user.end()).first - path.begin();
  };
  const std::string* best = &several->second.front();
  for (const std::string& path : several->second) {
    if (std::find(taken.begin(), taken.end(), path) != taken.end()) return path;
    if (shared(path) > shared(*best)) best = &path;
  }
  return *best;
}

// A file that names a module of another one needs it.
RtlSources RtlFinder::by_name(const Module& module) const {
  RtlSources sources;
  sources.top = module.type;
  const auto top = modules_.find(module.type);
  if (top == modules_.end()) {
    sources.why = "no module '" + module.type + "' and no component.xml of " + module.vlnv +
                  " in the folders of RTL";
    return sources;
  }
  std::set<std::string> seen{top->second};
  sources.files = {top->second};
  for (std::size_t i = 0; i < sources.files.size(); ++i) {
    const std::string file = sources.files[i], text = text_of(file);
    for (const std::string_view word : words(text, is_vhdl(file) ? "--" : "//")) {
      const std::string used = file_of(std::string(word), file, sources.files);
      if (!used.empty() && seen.insert(used).second) sources.files.push_back(used);
    }
  }
  return sources;
}

}  // namespace platform::handoff
