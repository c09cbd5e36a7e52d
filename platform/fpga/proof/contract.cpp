#include <fpga/proof/contract.h>

#include <filesystem>
#include <map>

#include <host/process.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>
#include <vp/yaml.h>

namespace platform::proof {

namespace {

constexpr std::uint64_t largest_parameter = 1'000'000;

class ContractReader : private vp::YamlReader {
 public:
  explicit ContractReader(const std::string& file)
      : YamlReader(file), root_(vp::load_yaml(vp::read_text(file, "contracts"), file)) {}

  std::map<std::string, Contract> read() const {
    std::map<std::string, Contract> all;
    for (const auto& entry : root_) {
      const std::string ip = scalar(entry.first, "IP");
      all.emplace(ip, contract(ip, entry.second));
    }
    return all;
  }

 private:
  Contract contract(const std::string& ip, const YAML::Node& node) const {
    Contract c;
    c.ip = ip;
    const auto gates = [&](bool once) {
      return [this, &c, once](const YAML::Node& map) {
        for (const auto& [output, by] : pairs(map)) c.gates.push_back({output, by, once});
      };
    };
    for_each(
        node,
        {{"least",
          [&](const YAML::Node& map) {
            for (const auto& entry : map) {
              c.least[scalar(entry.first, "least")] =
                  static_cast<std::int64_t>(whole(entry.second, "least", 0, largest_parameter));
            }
          }},
         {"structural", [&](const YAML::Node& n) { insert(c.structural, n, "structural"); }},
         {"resets", [&](const YAML::Node& n) { c.resets = scalars(n, "resets"); }},
         {"valid", gates(false)},
         {"once", gates(true)},
         {"reports", [&](const YAML::Node& n) { insert(c.reports, n, "reports"); }},
         {"frames", [&](const YAML::Node& n) { c.frames = frames(n); }},
         {"toggles",
          [&](const YAML::Node& map) {
            for (const auto& [toggle, seen] : pairs(map)) c.toggles.push_back({toggle, seen});
          }},
         {"streams_in", [&](const YAML::Node& n) { c.streams_in = scalars(n, "streams_in"); }},
         {"streams_out", [&](const YAML::Node& n) { c.streams_out = scalars(n, "streams_out"); }}},
        "a contract");
    return c;
  }

  Contract::Frames frames(const YAML::Node& node) const {
    Contract::Frames f;
    const auto text = [this](std::string& target, const char* key) {
      return [this, &target, key](const YAML::Node& n) { target = scalar(n, key); };
    };
    for_each(node,
             {{"valid", text(f.valid, "valid")},
              {"x", text(f.x, "x")},
              {"y", text(f.y, "y")},
              {"whole",
               [&](const YAML::Node& n) {
                 f.whole = choice(n, "whole", {"true", "false"}) == "true";
               }},
              {"gap", text(f.gap, "gap")},
              {"begins", text(f.may_begin, "begins")}},
             "frames");
    return f;
  }

  std::vector<std::pair<std::string, std::string>> pairs(const YAML::Node& map) const {
    std::vector<std::pair<std::string, std::string>> all;
    for (const auto& entry : map)
      all.emplace_back(scalar(entry.first, "port"), scalar(entry.second, "port"));
    return all;
  }
  void insert(std::set<std::string>& set, const YAML::Node& node, const char* key) const {
    for (const std::string& name : scalars(node, key)) set.insert(name);
  }

  const YAML::Node root_;
};

std::map<std::string, Contract> installed() {
  for (const std::string& folder : host::library_folders()) {
    const std::filesystem::path file = std::filesystem::path(folder) / "rtl" / "contracts.yaml";
    if (std::filesystem::exists(file)) return ContractReader(file.string()).read();
  }
  throw vp::InputError("no rtl/contracts.yaml is installed in " + host::library_folders().front() +
                       "; install markervp completely");
}

}  // namespace

const Contract& contract_of(const std::string& ip) {
  static const std::map<std::string, Contract> all = installed();
  const auto found = all.find(ip);
  if (found != all.end()) return found->second;
  std::vector<std::string> names;
  names.reserve(all.size());
  for (const auto& [name, contract] : all) names.push_back(name);
  throw vp::InputError("nothing is known that could be proved of an IP '" + ip + "': name " +
                       vp::one_of(names) + "; a proof has one clock");
}

std::vector<std::string> assumptions(const Contract& contract) {
  std::vector<std::string> lines;
  const auto resets = vp::join(contract.resets, " and ");
  if (!contract.resets.empty())
    lines.push_back(resets + " high on the first clock, and free from then on");
  lines.emplace_back(
      "registers and memories without an initial value start at 0, as on the chip; x is 0");
  if (const auto& frames = contract.frames) {
    if (frames->x.empty()) {
      lines.push_back(frames->valid + " comes in frames of at most WIDTH x HEIGHT pixels");
    } else {
      lines.push_back(frames->x + " and " + frames->y + " in raster order from 0, 0 on while " +
                      frames->valid + " is high");
    }
    lines.push_back(frames->whole ? "only a reset cuts a frame; at least " + frames->gap +
                                        " clocks between two"
                                  : "frames end at any pixel");
    if (!frames->may_begin.empty())
      lines.push_back("a frame begins when " + frames->may_begin + " is high");
  }
  for (const Contract::Toggle& toggle : contract.toggles)
    lines.push_back(toggle.toggle + " changes when its last change was seen at " + toggle.seen +
                    ", and is low behind a reset");
  for (const std::string& stream : contract.streams_in)
    lines.push_back("the master of stream '" + stream + "' keeps what it offers until it is taken");
  lines.emplace_back("all other inputs are free");
  return lines;
}

}  // namespace platform::proof
