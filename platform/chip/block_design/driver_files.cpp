#include <chip/block_design/import_design.h>
#include <chip/handoff/device_tree.h>

#include <vp/text.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

namespace platform::block_design {

namespace {

using handoff::Handoff;
using handoff::Module;
using handoff::OwnDriver;

/// The name in xparameters.h of a parameter of an IP: C_S00_AXI_BASEADDR is S00_AXI_BASEADDR.
std::string plain(const std::string& parameter) {
  return parameter.rfind("C_", 0) == 0 ? parameter.substr(2) : parameter;
}

/// Writes what the driver's script asks for (UG1043, "xdefine_…"): names by instance, by the driver
/// and a number, and the table of its instances.
class Tables {
 public:
  Tables(const OwnDriver& driver, const Handoff& handoff, const std::string& known)
      : driver_(driver), known_(known) {
    // What a processor in the PL alone sees has no names here, as in the vendor's tools.
    const auto& segments = handoff.ps().segments;
    for (const Module& module : handoff.modules) {
      const bool is_seen = std::any_of(
          segments.begin(), segments.end(),
          [&](const handoff::Segment& segment) { return segment.instance == module.instance; });
      if (is_seen && driver.drives(module.ip())) instances_.push_back(&module);
    }
  }

  bool empty() const { return instances_.empty(); }

  std::string names() {
    std::string text;
    const auto include = driver_.scripts.find("xdefine_include_file");
    if (include != driver_.scripts.end()) {
      define(text, vp::upper(word(include->second, 1)) + "_NUM_INSTANCES",
             std::to_string(instances_.size()));
      each(text, include->second, 2, false);
    }
    const auto canonical = driver_.scripts.find("xdefine_canonical_xpars");
    if (canonical != driver_.scripts.end()) {
      each(text, canonical->second, 2, true);
      if (knows_device_tree()) device_tree_names(text, canonical->second);
    }
    return text;
  }

  /// "xfilter_g.c" and its text; "" if the driver has no table.
  std::pair<std::string, std::string> table() const {
    const auto config = driver_.scripts.find("xdefine_config_file");
    if (config == driver_.scripts.end() || config->second.size() < 3) return {};
    const std::string& file = config->second[0];
    const std::string& name = config->second[1];
    const std::size_t end = file.rfind("_g.c");
    if (end == std::string::npos || file.find('/') != std::string::npos) return {};
    const std::string start = name + "_Config " + name + "_ConfigTable[] = {\n";
    const std::string text =
        "#include \"xparameters.h\"\n#include \"" + file.substr(0, end) + ".h\"\n\n";
    const std::string classic = start + rows(config->second, false) + "};\n";
    if (!knows_device_tree()) return {file, text + classic};
    return {file, text + "#ifndef SDT\n" + classic + "#else\n" + start +
                      rows(config->second, true) + "  {NULL}};\n#endif\n"};
  }

 private:
  /// Drivers of HLS do from 2023.2 on; others have one kind of row in both flows.
  bool knows_device_tree() const {
    return std::any_of(driver_.sources.begin(), driver_.sources.end(), [](const auto& source) {
      return source.second.find("#ifdef SDT") != std::string::npos;
    });
  }

  static std::string kind_of(const Module& module) {
    return device_tree::compatible(module.ip(), vp::split(module.vlnv, ':').back());
  }
  /// With a system device tree an instance has the name of its kind in the place of a number.
  std::string rows(const std::vector<std::string>& words, bool is_sdt) const {
    std::string text;
    for (const Module* module : instances_) {
      const char* before = "  {";
      for (std::size_t i = 2; i < words.size(); ++i) {
        const bool is_kind = is_sdt && words[i] == "DEVICE_ID";
        text += before + (is_kind ? '"' + kind_of(*module) + '"'
                                  : "XPAR_" + vp::upper(module->instance) + "_" + plain(words[i]));
        before = ", ";
      }
      text += "},\n";
    }
    return text;
  }

  static std::string word(const std::vector<std::string>& words, std::size_t n) {
    return n < words.size() ? words[n] : std::string();
  }

  void define(std::string& text, const std::string& name, const std::string& value) {
    const std::string line = "#define XPAR_" + name + " ";
    if (value.empty() || known_.find(line) != std::string::npos || !written_.insert(name).second)
      return;
    text += line + value + "\n";
  }

  void each(std::string& text, const std::vector<std::string>& words, std::size_t first,
            bool by_driver) {
    for (std::size_t n = 0; n < instances_.size(); ++n) {
      const std::string number = std::to_string(n);
      const std::string start =
          by_driver ? vp::upper(word(words, 1)) + "_" + number : vp::upper(instances_[n]->instance);
      for (std::size_t i = first; i < words.size(); ++i) {
        if (words[i] == "NUM_INSTANCES") continue;
        const std::string value = words[i] == "DEVICE_ID"
                                      ? number
                                      : handoff::parameter(instances_[n]->parameters, words[i]);
        define(text, start + "_" + plain(words[i]), value);
      }
    }
  }

  /// XPAR_FILTER_0_BASEADDR and XPAR_XFILTER_0_BASEADDR, whatever the IP calls its bus: the first
  /// one's.
  void device_tree_names(std::string& text, const std::vector<std::string>& words) {
    const auto is_base = [](const std::string& one) {
      return one.find("BASEADDR") != std::string::npos;
    };
    const auto base = std::find_if(words.begin(), words.end(), is_base);
    if (base == words.end()) return;
    std::string lines;
    for (std::size_t n = 0; n < instances_.size(); ++n) {
      const std::string value = handoff::parameter(instances_[n]->parameters, *base);
      define(lines, vp::upper(instances_[n]->instance) + "_BASEADDR", value);
      define(lines, vp::upper(word(words, 1)) + "_" + std::to_string(n) + "_BASEADDR", value);
    }
    if (!lines.empty()) text += "#ifdef SDT\n" + lines + "#endif\n";
  }

  const OwnDriver& driver_;
  const std::string& known_;
  std::vector<const Module*> instances_;
  std::set<std::string> written_;
};

/// Without a device tree a device without a driver has the names of its parameters: of C_BASEADDR
/// XPAR_MATH_0_BASEADDR, of C_S00_AXI_BASEADDR XPAR_MATH_0_S00_AXI_BASEADDR.
std::string parameter_names(const Handoff& handoff, const std::string& known) {
  std::string text;
  const auto define = [&](const handoff::Segment& segment, const std::string& parameter,
                          std::uint64_t address) {
    const std::string line =
        "#define XPAR_" + vp::upper(segment.instance) + "_" + vp::upper(plain(parameter)) + " ";
    if (parameter.empty() || (known + text).find(line) != std::string::npos) return;
    text += line + vp::hex(address) + "U\n";
  };
  for (const handoff::Segment& segment : handoff.ps().segments) {
    if (segment.instance == handoff.ps().instance) continue;
    define(segment, segment.base_name, segment.base);
    define(segment, segment.last_name, segment.last);
  }
  return text.empty() ? text : "#ifndef SDT\n" + text + "#endif\n";
}

/// With a system device tree a device without a driver has the names of its label and of its kind,
/// whatever its bus is called: the first one's.
std::string label_names(const Handoff& handoff, const std::string& known) {
  std::string text;
  std::set<std::string> seen, labels;
  std::map<std::string, unsigned> numbers;
  const auto& segments = handoff.ps().segments;
  for (const handoff::Segment& segment : segments) labels.insert(vp::upper(segment.instance));
  for (const handoff::Segment& segment : segments) {
    const Module* module = handoff.module(segment.instance);
    if (!module || module == &handoff.ps() || !seen.insert(segment.instance).second) continue;
    const std::string label = vp::upper(segment.instance);
    if (known.find("#define XPAR_" + label + "_BASEADDR ") != std::string::npos) continue;
    const std::string kind = vp::upper(module->ip());
    const std::string number = std::to_string(numbers[kind]++);
    std::vector<std::string> names{label};
    if (labels.count(kind + "_" + number) == 0) names.push_back(kind + "_" + number);
    for (const std::string& name : names) {
      text += "#define XPAR_" + name + "_BASEADDR " + vp::hex(segment.base) + "U\n";
      text += "#define XPAR_" + name + "_HIGHADDR " + vp::hex(segment.last) + "U\n";
    }
  }
  return text.empty() ? text : "#ifdef SDT\n" + text + "#endif\n";
}

}  // namespace

DriverFiles driver_files(const Handoff& handoff, const std::vector<OwnDriver>& drivers,
                         const std::string& xparameters) {
  DriverFiles result;
  std::set<std::string> seen;
  for (const OwnDriver& driver : drivers) {
    Tables tables(driver, handoff, xparameters);
    if (tables.empty() || !seen.insert(driver.name).second) continue;
    for (const auto& [name, text] : driver.sources)
      result.files.emplace_back(driver.name + "/" + name, text);
    result.names += tables.names();
    const auto [file, text] = tables.table();
    if (!file.empty()) result.files.emplace_back(driver.name + "/" + file, text);
  }
  const std::string by_parameter = parameter_names(handoff, xparameters + result.names);
  result.names += label_names(handoff, xparameters + result.names) + by_parameter;
  if (!result.names.empty())
    result.names = "\n/* Drivers of the design's own IP */\n" + result.names;
  return result;
}

}  // namespace platform::block_design
