#include <fpga/synthesis/rtl_design.h>

#include <algorithm>
#include <charconv>
#include <regex>
#include <set>
#include <system_error>

#include <fpga/synthesis/vhdl.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>

namespace platform::synthesis {

namespace fs = std::filesystem;

std::vector<std::string> declared_in(const std::string& text, const char* what) {
  const std::regex declaration("(^|\\n)\\s*(?:" + std::string(what) + ")\\s+(\\w+)");
  std::vector<std::string> names;
  for (std::sregex_iterator m(text.begin(), text.end(), declaration), end; m != end; ++m)
    names.push_back((*m)[2]);
  return names;
}

Parameters parse_parameters(const std::vector<std::string>& given) {
  static const std::regex identifier("[A-Za-z_][A-Za-z0-9_]*");
  Parameters parameters;
  for (const std::string& text : given) {
    const std::size_t equals = text.find('=');
    std::int64_t value = 0;
    const char* const begin =
        text.data() + (equals == std::string::npos ? text.size() : equals + 1);
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(begin, end, value);
    const std::string_view word(begin, static_cast<std::size_t>(end - begin));
    if (word == "true") value = 1;
    const bool read = word == "true" || word == "false" || (error == std::errc{} && stop == end);
    const std::string name = text.substr(0, equals);
    if (!read || !std::regex_match(name, identifier)) {
      throw vp::InputError("--parameter '" + text +
                           "': give NAME=NUMBER, as LABELS=64, or true or false");
    }
    parameters[name] = value;
  }
  return parameters;
}

std::string parameters_text(const Parameters& parameters) {
  std::string text;
  for (const auto& [name, value] : parameters) text += " " + name + "=" + std::to_string(value);
  return text;
}

namespace {

/// Of a source, comments left out; VHDL in small letters.
std::string code_of(const fs::path& source) {
  static const std::regex of_verilog(R"(//[^\n]*|/\*[^]*?\*/)"), of_vhdl("--[^\n]*");
  const std::string text = vp::read_text(source, "source");
  if (is_vhdl(source)) return vp::lower(std::regex_replace(text, of_vhdl, " "));
  return std::regex_replace(text, of_verilog, " ");
}

std::vector<std::string> units_of(const fs::path& source, const std::string& code) {
  return declared_in(
      code, is_vhdl(source) ? R"(entity|package(?:\s+body)?)" : "module|package|interface");
}

}  // namespace

std::vector<std::string> units_in(const fs::path& source) {
  return units_of(source, code_of(source));
}

namespace {

/// Whether code of VHDL, in small letters, has an entity with that generic.
bool has_generic(const std::string& code, const std::string& entity, const std::string& name) {
  std::smatch found;
  if (!std::regex_search(code, found, std::regex("\\bentity\\s+" + entity + "\\s+is\\b")))
    return false;
  const std::string rest = found.suffix();
  static const std::regex over(R"(\b(port|end|begin)\b)");
  const std::string generics =
      std::regex_search(rest, found, over) ? std::string(found.prefix()) : rest;
  return std::regex_search(generics, std::regex("\\b" + name + R"(\s*(,[^:;]*)?:)"));
}

}  // namespace

bool has_parameter(const Design& design, const std::string& name) {
  const std::regex module("\\bmodule\\s+" + design.top + "\\b"),
      assigned("\\b" + name + R"(\s*=[^=])");
  static const std::regex kind(R"(\b(?:local)?param(?:eter)?\b)");
  for (const fs::path& source : design.sources) {
    const std::string text = code_of(source);
    if (is_vhdl(source)) {
      if (has_generic(text, vp::lower(design.top), vp::lower(name))) return true;
      continue;
    }
    std::smatch found;
    if (!std::regex_search(text, found, module)) continue;
    const std::string rest = found.suffix();
    const std::string body = rest.substr(0, rest.find("endmodule"));
    for (std::sregex_iterator m(body.begin(), body.end(), assigned), end; m != end; ++m) {
      const std::string before = body.substr(0, static_cast<std::size_t>(m->position()));
      std::string last;
      for (std::sregex_iterator k(before.begin(), before.end(), kind); k != end; ++k)
        last = k->str();
      if (last == "parameter") return true;
    }
  }
  return false;
}

std::vector<fs::path> needed_by(const std::string& top, const std::vector<fs::path>& sources) {
  static const std::regex word(R"([A-Za-z_]\w*)");
  std::multimap<std::string, std::size_t> declares;  // by name, the source
  std::vector<std::string> texts;
  for (const fs::path& source : sources) {
    texts.push_back(code_of(source));
    for (const std::string& name : units_of(source, texts.back()))
      declares.emplace(name, texts.size() - 1);
  }
  std::vector<std::string> open{top};
  if (std::any_of(sources.begin(), sources.end(), is_vhdl)) open.push_back(vp::lower(top));
  std::set<std::size_t> needed;
  while (!open.empty()) {
    const auto [first, last] = declares.equal_range(open.back());
    open.pop_back();
    for (auto found = first; found != last; ++found) {
      if (!needed.insert(found->second).second) continue;
      const std::string& text = texts[found->second];
      for (std::sregex_iterator m(text.begin(), text.end(), word), end; m != end; ++m)
        open.push_back(m->str());
    }
  }
  std::vector<fs::path> found;
  found.reserve(needed.size());
  for (const std::size_t i : needed) found.push_back(sources[i]);
  return found;
}

std::vector<fs::path> sources_in(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path& path = entry->path();
    if (path.extension() == ".v" || path.extension() == ".sv" || is_vhdl(path))
      found.push_back(path);
  }
  if (error) throw vp::InputError("'" + folder.string() + "': " + error.message());
  if (found.empty()) {
    throw vp::InputError("'" + folder.string() +
                         "' has no file of Verilog (.v, .sv) or VHDL (.vhd, .vhdl)");
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace platform::synthesis
