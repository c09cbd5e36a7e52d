#include <chip/block_design/import_design.h>

#include <vp/text.h>

#include <cctype>
#include <set>

namespace platform::block_design {

namespace {

/// Names that xparameters.h defines, by the flow that alone has them.
struct FlowNames {
  std::set<std::string> classic, device_tree;
};

FlowNames names_of(const std::string& xparameters) {
  FlowNames names;
  std::set<std::string> common;
  std::set<std::string>* of = &common;
  for (const std::string& line : vp::split(xparameters, '\n')) {
    const std::vector<std::string> words = vp::split(line, ' ');
    if (line == "#ifndef SDT") {
      of = &names.classic;
    } else if (line == "#ifdef SDT" || line.rfind("#if defined SDT", 0) == 0) {
      of = &names.device_tree;
    } else if (line == "#endif") {
      of = &common;
    } else if (words.size() > 1 && words[0] == "#define") {
      of->insert(words[1]);
    }
  }
  const auto drop = [](std::set<std::string>& from, const std::set<std::string>& list) {
    for (const std::string& name : list) from.erase(name);
  };
  const std::set<std::string> classic = names.classic;
  for (const auto& known : {common, names.device_tree}) drop(names.classic, known);
  for (const auto& known : {common, classic}) drop(names.device_tree, known);
  return names;
}

/// The words XPAR_… of a source.
std::set<std::string> used_names(const std::string& text) {
  std::set<std::string> names;
  const auto in_word = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
  for (std::size_t at = text.find("XPAR_"); at != std::string::npos; at = text.find("XPAR_", at)) {
    std::size_t end = at;
    while (end < text.size() && in_word(static_cast<unsigned char>(text[end]))) ++end;
    names.insert(text.substr(at, end - at));
    at = end;
  }
  return names;
}

}  // namespace

bool is_for_device_tree(const std::vector<std::string>& programs, const std::string& xparameters) {
  const FlowNames known = names_of(xparameters);
  bool uses_device_tree = false, uses_classic = false;
  for (const std::string& program : programs) {
    for (const std::string& name : used_names(program)) {
      uses_device_tree = uses_device_tree || known.device_tree.count(name) != 0;
      uses_classic = uses_classic || known.classic.count(name) != 0;
    }
  }
  return uses_device_tree && !uses_classic;
}

}  // namespace platform::block_design
