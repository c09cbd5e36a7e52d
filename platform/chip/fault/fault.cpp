#include <chip/fault/fault.h>

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <set>

#include <vp/error.h>
#include <vp/text.h>
#include <vp/unit.h>
#include <vp/yaml.h>

namespace platform {

namespace {

using What = Fault::What;

/// What a kind of fault must have, and may have beside `what`.
struct Kind {
  const char* name;
  What what;
  std::set<std::string> needs;
  std::set<std::string> takes;
};

const std::vector<Kind>& kinds() {
  static const std::set<std::string> of_access = {"at", "access", "count", "of", "address"};
  static const std::set<std::string> of_beat = {"at", "beat", "count"};
  static const std::vector<Kind> list = {
      {"slverr", What::slverr, {"where"}, of_access},
      {"decerr", What::decerr, {"where"}, of_access},
      {"corrupt",
       What::corrupt,
       {"where", "bit"},
       {"at", "access", "beat", "count", "of", "address"}},
      {"dropped", What::dropped, {"where"}, of_beat},
      {"repeated", What::repeated, {"where"}, of_beat},
      {"tlast", What::tlast, {"where"}, of_beat},
      {"flip", What::flip, {"at", "bit"}, {"where", "address"}},
      {"stuck", What::stuck, {"where", "value", "at"}, {"for"}},
      {"lost", What::lost, {"where"}, {"at", "edge", "count"}},
      {"late", What::late, {"where", "by"}, {"at", "edge", "count"}},
      {"spurious", What::spurious, {"where", "at", "for"}, {}},
      {"clock", What::clock, {"where", "frequency", "at"}, {}},
      {"input", What::input, {"value"}, {"unit", "count", "from", "bytes"}},
      {"torn", What::torn, {"from"}, {"unit", "count", "bytes"}},
  };
  return list;
}

class FaultReader : private vp::YamlReader {
 public:
  explicit FaultReader(const std::string& origin) : YamlReader(origin), origin_(origin) {}

  std::vector<Fault> read(const std::string& text) {
    const YAML::Node list = vp::load_yaml(text, origin_);
    if (list.IsNull()) return {};
    if (!list.IsSequence())
      fail(list,
           "'inject' is a list of faults: [{what: flip, address: 0x100000, bit: 0, at: 1 ms}]");
    std::vector<Fault> faults;
    for (const YAML::Node& entry : list) faults.push_back(read_fault(entry));
    return faults;
  }

 private:
  Fault read_fault(const YAML::Node& entry) {
    fault_ = {};
    given_.clear();
    for_each(entry, keys(), "a fault");
    if (given_.count("what") == 0) fail(entry, "a fault says 'what' goes wrong: " + one_of_kinds());
    const Kind& kind = *kind_;
    for (const std::string& key : kind.needs) {
      if (given_.count(key) == 0)
        fail(entry, std::string("'") + kind.name + "' needs '" + key + "'");
    }
    for (const std::string& key : given_) {
      if (key != "what" && kind.needs.count(key) == 0 && kind.takes.count(key) == 0)
        fail(entry, std::string("'") + kind.name + "' takes no '" + key + "': it takes " +
                        vp::join(all_keys(kind), ", "));
    }
    if (fault_.what == What::flip && given_.count("where") + given_.count("address") == 0)
      fail(entry, "'flip' needs an 'address' of the processor, or 'where': a memory or a register");
    if (fault_.what == What::input && fault_.value > 255)
      fail(entry, "'value' of an input is that of a byte: write 0 to 255");
    fault_.text = text_of(entry);
    return fault_;
  }

  static std::vector<std::string> all_keys(const Kind& kind) {
    std::vector<std::string> keys(kind.needs.begin(), kind.needs.end());
    keys.insert(keys.end(), kind.takes.begin(), kind.takes.end());
    return keys;
  }

  static std::string one_of_kinds() {
    std::vector<std::string> names;
    for (const Kind& kind : kinds()) names.push_back(kind.name);
    return vp::one_of(names);
  }

  /// "{what: flip, address: 0x43000000, bit: 5, at: 1.2 ms}"
  std::string text_of(const YAML::Node& entry) const {
    std::vector<std::string> parts;
    for (const auto& pair : entry)
      parts.push_back(pair.first.Scalar() + ": " + pair.second.Scalar());
    return "{" + vp::join(parts, ", ") + "}";
  }

  Keys keys() {
    Keys keys;
    const auto add = [this, &keys](const char* name, std::function<void(const YAML::Node&)> take) {
      keys[name] = [this, name, take = std::move(take)](const YAML::Node& node) {
        given_.insert(name);
        take(node);
      };
    };
    add("what", [this](const YAML::Node& node) { take_kind(node); });
    add("where", [this](const YAML::Node& node) { fault_.where = scalar(node, "where"); });
    add("at", [this](const YAML::Node& node) { fault_.at_ps = time(node, "at"); });
    add("for", [this](const YAML::Node& node) { fault_.for_ps = time(node, "for"); });
    add("by", [this](const YAML::Node& node) { fault_.by_ps = time(node, "by"); });
    for (const char* name : {"access", "beat", "edge", "unit"}) {
      add(name, [this, name](const YAML::Node& node) { fault_.nth = number(node, name, 1, most); });
    }
    add("count", [this](const YAML::Node& node) {
      fault_.count =
          scalar(node, "count") == "all" ? Fault::for_ever : number(node, "count", 1, most);
    });
    add("of", [this](const YAML::Node& node) {
      const std::string of = choice(node, "of", {"accesses", "reads", "writes"});
      fault_.of = of == "reads"    ? Fault::Of::reads
                  : of == "writes" ? Fault::Of::writes
                                   : Fault::Of::accesses;
    });
    for (const char* name : {"address", "from"}) {
      add(name, [this, name](const YAML::Node& node) {
        fault_.has_address = true;
        fault_.address = number(node, name, 0, most);
      });
    }
    add("bytes", [this](const YAML::Node& node) {
      fault_.has_bytes = true;
      fault_.bytes = number(node, "bytes", 1, most);
    });
    add("bit", [this](const YAML::Node& node) {
      fault_.bit = static_cast<unsigned>(number(node, "bit", 0, 1023));
    });
    add("value", [this](const YAML::Node& node) { fault_.value = number(node, "value", 0, most); });
    add("frequency", [this](const YAML::Node& node) {
      fault_.value = quantity(node, "frequency", vp::Unit::frequency, 1'000'000'000'000);
    });
    return keys;
  }

  void take_kind(const YAML::Node& node) {
    std::vector<std::string> names;
    for (const Kind& kind : kinds()) names.push_back(kind.name);
    const std::string name = choice(node, "what", names);
    const auto same = [&name](const Kind& kind) { return kind.name == name; };
    kind_ = &*std::find_if(kinds().begin(), kinds().end(), same);
    fault_.what = kind_->what;
  }

  std::uint64_t time(const YAML::Node& node, const std::string& key) const {
    return quantity(node, key, vp::Unit::time, most);
  }
  std::uint64_t number(const YAML::Node& node, const std::string& key, std::uint64_t min,
                       std::uint64_t max) const {
    const std::uint64_t value = quantity(node, key, vp::Unit::none, max);
    if (value < min) fail(node, "'" + key + "' is at least " + std::to_string(min));
    return value;
  }

  static constexpr std::uint64_t most = std::uint64_t{1} << 62;

  const std::string& origin_;
  Fault fault_;
  const Kind* kind_ = nullptr;
  std::set<std::string> given_;
};

}  // namespace

std::vector<Fault> parse_faults(const std::string& text, const std::string& origin) {
  return FaultReader(origin).read(text);
}

}  // namespace platform
