#include <chip/block_design/design_file.h>

#include <chip/block_design/shelf.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>
#include <vp/unit.h>
#include <vp/yaml.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>

namespace platform::block_design {

namespace {

constexpr std::size_t longest_name = 200;
constexpr std::uint64_t most_addresses = 1ull << 32;
constexpr unsigned widest_pin = 64;

/// Reads a design, section by section, then checks that all names that it uses exist.
class DesignReader : vp::YamlReader {
 public:
  DesignReader(const std::string& text, const std::string& origin)
      : YamlReader(origin), root_(vp::load_yaml(text, origin)) {
    design_.file = origin;
  }

  DesignFile read() {
    if (!root_.IsMap()) fail(root_, "a design is 'key: value' lines: name, parts, addresses …");
    for_each(root_,
             {{"name", [&](const auto& n) { design_.name = name(n, "name"); }},
              {"programs", [&](const auto& n) { design_.programs = scalars(n, "programs"); }},
              {"work", [&](const auto& n) { read_work(n); }},
              {"settings", [&](const auto& n) { read_settings(n, ""); }},
              {"parts", [&](const auto& n) { read_parts(n); }},
              {"addresses", [&](const auto& n) { read_addresses(n); }},
              {"external", [&](const auto& n) { read_external(n); }}},
             "a design");
    if (design_.name.empty()) fail(root_, "a design needs a 'name'");
    check_ends();
    check_processing_system();
    return std::move(design_);
  }

 private:
  /// A name that can be one of an object of the simulation.
  std::string name(const YAML::Node& node, const std::string& key) const {
    std::string text = scalar(node, key);
    const auto good = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
    if (text.empty() || text.size() > longest_name || !std::all_of(text.begin(), text.end(), good))
      fail(node, "'" + vp::excerpt(text) + "': a name has letters, digits and '_'");
    return text;
  }

  /// Calls `take(key, node)` for the entries of a map, none of them twice.
  template <class Take>
  void entries(const YAML::Node& map, const std::string& what, const Take& take) const {
    if (map.IsNull()) return;
    if (!map.IsMap()) fail(map, "'" + what + "' takes 'key: value' lines");
    std::set<std::string> seen;
    for (const auto& entry : map) {
      const std::string key = scalar(entry.first, what);
      if (!seen.insert(key).second) fail(entry.first, "'" + key + "' is listed twice");
      take(key, entry.first, entry.second);
    }
  }

  void read_settings(const YAML::Node& map, const std::string& prefix) {
    entries(map, "settings", [&](const std::string& key, const auto&, const auto& value) {
      const std::string path = prefix.empty() ? key : prefix + "." + key;
      if (value.IsMap()) return read_settings(value, path);
      design_.settings.emplace_back(path, scalar(value, path));
    });
  }

  void read_work(const YAML::Node& map) {
    UnitOfWork& unit = design_.unit;
    for_each(map,
             {{"unit", [&](const auto& n) { unit.name = name(n, "unit"); }},
              {"line", [&](const auto& n) { unit.line = scalar(n, "line"); }},
              {"ends", [&](const auto& n) { unit.end = end(n, scalar(n, "ends")); }}},
             "work");
    if (unit.name.empty()) fail(map, "'work' needs the 'unit' that the design delivers");
    if (!unit.line.empty() && !unit.end.part.empty())
      fail(map, "a unit of work ends with a 'line', or where a pin 'ends' it, not both");
  }

  /// "axi_dma_0.M_AXIS_MM2S".
  End end(const YAML::Node& node, const std::string& text) const {
    const std::size_t dot = text.find('.');
    if (dot == std::string::npos || dot == 0 || dot + 1 == text.size())
      fail(node, "'" + vp::excerpt(text) + "': write PART.PORT, or external.PIN");
    return {text.substr(0, dot), text.substr(dot + 1), where(node)};
  }

  std::map<std::string, End> ends(const YAML::Node& map, const std::string& what) const {
    std::map<std::string, End> result;
    entries(map, what, [&](const std::string& key, const auto&, const auto& value) {
      result[key] = end(value, scalar(value, key));
    });
    return result;
  }

  void read_parts(const YAML::Node& map) {
    entries(map, "parts", [&](const std::string&, const auto& key, const auto& value) {
      PlacedPart part;
      part.name = name(key, "parts");
      part.place = where(key);
      if (part.name == "external") fail(key, "'external' is the name of the chip's pins");
      for_each(value,
               {{"ip", [&](const auto& n) { part.vlnv = vlnv(n); }},
                {"as",
                 [&](const auto& n) {
                   part.as = choice(n, "as", {"model", "stub"});
                 }},
                {"rtl", [&](const auto& n) { part.rtl = scalar(n, "rtl"); }},
                {"parameters", [&](const auto& n) { read_parameters(n, part); }},
                {"clocks", [&](const auto& n) { read_clocks(n, part); }},
                {"pins", [&](const auto& n) { part.pins = ends(n, "pins"); }},
                {"buses", [&](const auto& n) { part.buses = ends(n, "buses"); }}},
               "a part");
      if (part.vlnv.empty())
        fail(key, "part '" + part.name + "' needs its 'ip', vendor:library:name:version");
      if (value["parameters"]) check_parameters(value["parameters"], part);
      design_.part_index[part.name] = design_.parts.size();
      design_.parts.push_back(std::move(part));
    });
  }

  std::string vlnv(const YAML::Node& node) const {
    std::string text = scalar(node, "ip");
    if (vp::split(text, ':').size() != 4) {
      fail(node, "'" + vp::excerpt(text) +
                     "': write vendor:library:name:version, as xilinx.com:ip:axi_dma:7.1");
    }
    return text;
  }

  void read_parameters(const YAML::Node& map, PlacedPart& part) const {
    entries(map, "parameters", [&](const std::string& key, const auto&, const auto& value) {
      part.parameters[key] = scalar(value, key);
    });
  }

  void read_clocks(const YAML::Node& map, PlacedPart& part) const {
    entries(map, "clocks", [&](const std::string& key, const auto&, const auto& value) {
      part.clocks[key] = quantity(value, key, vp::Unit::frequency);
    });
  }

  /// Of an IP on the shelf each parameter must be known, and its value modelled.
  void check_parameters(const YAML::Node& map, const PlacedPart& part) const {
    const IpRule* rule = part.rule();
    if (!rule || !map.IsMap()) return;
    for (const auto& entry : map) {
      const std::string key = entry.first.Scalar(), value = entry.second.Scalar();
      const ParameterRule* known = find_parameter(*rule, key);
      if (!known) {
        std::vector<std::string> names;
        for (const ParameterRule& one : rule->parameters) names.push_back(one.name);
        const std::string nearest = vp::nearest_match(key, names);
        fail(entry.first, rule->ip + " has no parameter '" + vp::excerpt(key) + "' that matters" +
                              (nearest.empty() ? "" : ": did you mean '" + nearest + "'?"));
      }
      if (!is_allowed(*known, value)) {
        fail(entry.second, part.name + ": " + known->name + " = " + vp::excerpt(value) +
                               " is not modelled, but " + allowed_values(*known) +
                               "; 'as: stub' leaves the part out");
      }
    }
  }

  std::uint64_t quantity(const YAML::Node& node, const std::string& what, vp::Unit unit) const {
    try {
      const auto whole = vp::parse_quantity(scalar(node, what), unit).whole();
      if (whole && *whole >= 0 && *whole <= static_cast<vp::Decimal::Whole>(1'000'000'000'000))
        return static_cast<std::uint64_t>(*whole);
    } catch (const vp::InputError& error) {
      fail(node, "'" + vp::excerpt(node.Scalar()) + "' for " + what + " " + error.what());
    }
    fail(node, "'" + vp::excerpt(node.Scalar()) + "' for " + what + ": out of range");
  }

  void read_addresses(const YAML::Node& map) {
    entries(map, "addresses", [&](const std::string& master, const auto& key, const auto& slaves) {
      entries(slaves, master, [&](const std::string& slave, const auto& place, const auto& range) {
        const bool several = range.IsSequence() && range.size() > 0 && range[0].IsSequence();
        for (std::size_t i = 0; i < (several ? range.size() : 1); ++i)
          read_segment(end(key, master), end(place, slave), several ? range[i] : range);
      });
    });
  }

  void read_segment(const End& master, const End& slave, const YAML::Node& range) {
    if (!range.IsSequence() || range.size() != 2) {
      fail(range, "where '" + slave.text() +
                      "' is: write [base, size], as [0x40400000, 64 KiB], or a list of such");
    }
    AddressSegment segment{master, slave, quantity(range[0], "the base", vp::Unit::none),
                           quantity(range[1], "the size", vp::Unit::bytes)};
    if (segment.size == 0 || segment.base + segment.size > most_addresses)
      fail(range, "the segment of '" + slave.text() + "' does not lie within 32 bits of address");
    design_.addresses.push_back(std::move(segment));
  }

  void read_external(const YAML::Node& map) {
    entries(map, "external", [&](const std::string&, const auto& key, const auto& value) {
      ExternalPin pin;
      pin.name = name(key, "external");
      pin.place = where(key);
      for_each(
          value,
          {{"width",
            [&](const auto& n) {
              pin.width = static_cast<unsigned>(whole(n, "width", 1, widest_pin));
            }},
           {"level", [&](const auto& n) { pin.level = quantity(n, "level", vp::Unit::none); }},
           {"clock", [&](const auto& n) { pin.hz = quantity(n, "clock", vp::Unit::frequency); }}},
          "a pin");
      if (pin.width < widest_pin && pin.level >> pin.width != 0)
        fail(value, "the level of '" + pin.name + "' has more bits than the pin");
      design_.external.push_back(std::move(pin));
    });
  }

  [[noreturn]] void fail_at(const End& end, const std::string& problem) const {
    throw vp::InputError(end.place + ": " + problem);
  }

  void check_end(const End& end, const std::string& what) const {
    if (end.part == "external") {
      if (design_.pin(end.port)) return;
      std::vector<std::string> names;
      for (const ExternalPin& pin : design_.external) names.push_back(pin.name);
      fail_at(end, what + " '" + vp::excerpt(end.text()) + "': no such pin under 'external'" +
                       nearest(end.port, names));
    }
    if (design_.part(end.part)) return;
    std::vector<std::string> names;
    for (const PlacedPart& part : design_.parts) names.push_back(part.name);
    fail_at(end,
            what + " '" + vp::excerpt(end.text()) + "': no such part" + nearest(end.part, names));
  }

  static std::string nearest(const std::string& word, const std::vector<std::string>& names) {
    const std::string match = vp::nearest_match(word, names);
    return match.empty() ? "" : ", did you mean '" + match + "'?";
  }

  void check_ends() const {
    for (const PlacedPart& part : design_.parts) {
      for (const auto& [pin, source] : part.pins)
        check_end(source, part.name + "." + pin + " is driven by");
      for (const auto& [bus, master] : part.buses)
        check_end(master, part.name + "." + bus + " is joined to");
    }
    if (!design_.unit.end.part.empty()) check_end(design_.unit.end, "the unit of work ends with");
    for (const AddressSegment& segment : design_.addresses) {
      check_end(segment.master, "the master");
      check_end(segment.slave, "the slave");
    }
  }

  void check_processing_system() const {
    const auto count =
        std::count_if(design_.parts.begin(), design_.parts.end(), [](const PlacedPart& part) {
          return vp::split(part.vlnv, ':').at(2) == "processing_system7";
        });
    if (count != 1) {
      fail(root_, "a design has one processing_system7 among its parts, this one has " +
                      std::to_string(count));
    }
  }

  YAML::Node root_;
  DesignFile design_;
};

}  // namespace

const IpRule* PlacedPart::rule() const {
  return as == "stub" || !rtl.empty() ? nullptr : rule_for(vlnv);
}

const PlacedPart* DesignFile::part(const std::string& wanted) const {
  const auto found = part_index.find(wanted);
  return found == part_index.end() ? nullptr : &parts[found->second];
}

const ExternalPin* DesignFile::pin(const std::string& wanted) const {
  const auto found = std::find_if(external.begin(), external.end(),
                                  [&](const ExternalPin& one) { return one.name == wanted; });
  return found == external.end() ? nullptr : &*found;
}

DesignFile parse_design(const std::string& text, const std::string& origin) {
  return DesignReader(text, origin).read();
}

namespace {

/// CMake leaves the reason in the place of an object that cannot be built.
void find_refused_rtl(DesignFile& design) {
  namespace fs = std::filesystem;
  for (PlacedPart& part : design.parts) {
    if (part.rtl.empty() || part.is_stub()) continue;
    const fs::path object = fs::path(design.file).parent_path() / part.rtl;
    const fs::path reason = fs::path(object).replace_extension(".refused");
    std::error_code ignored;
    if (fs::exists(object, ignored) || !fs::exists(reason, ignored)) continue;
    part.refused = vp::visible(vp::split(vp::read_text(reason.string(), "reason"), '\n').front());
    part.as = "stub";
  }
}

}  // namespace

DesignFile read_design_file(const std::string& file) {
  DesignFile design = parse_design(vp::read_text(file, "design"), file);
  find_refused_rtl(design);
  return design;
}

bool is_design_yaml(const std::string& file) {
  const std::string ending = std::filesystem::path(file).extension().string();
  return ending == ".yaml" || ending == ".yml";
}

}  // namespace platform::block_design
