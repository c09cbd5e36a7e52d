#include <cli/faults/campaign_file.h>

#include <chip/fault/fault_space.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/unit.h>
#include <vp/yaml.h>

namespace platform::cli {

namespace {

class CampaignReader : private vp::YamlReader {
 public:
  explicit CampaignReader(const std::string& path) : YamlReader(path), path_(path) {}

  CampaignFile read() {
    const YAML::Node file = vp::load_yaml(vp::read_text(path_, "campaign"), path_);
    if (file.IsNull()) throw vp::InputError(path_ + ": it is empty: write 'design: thesis'");
    CampaignFile campaign;
    constexpr std::uint64_t most = 10'000'000;
    constexpr std::uint64_t most_patience_ps = 1'000'000'000'000'000;
    for_each(
        file,
        {{"design", [&](const YAML::Node& node) { campaign.design = scalar(node, "design"); }},
         {"program", [&](const YAML::Node& node) { campaign.program = scalar(node, "program"); }},
         {"fidelity",
          [&](const YAML::Node& node) {
            campaign.fidelity = choice(node, "fidelity", {"tlm", "clocked"});
          }},
         {"inputs", [&](const YAML::Node& node) { campaign.inputs = scalars(node, "inputs"); }},
         {"set", [&](const YAML::Node& node) { campaign.settings = settings(node); }},
         {"count", [&](const YAML::Node& node) { campaign.count = whole(node, "count", 1, most); }},
         {"seed",
          [&](const YAML::Node& node) { campaign.seed = whole(node, "seed", 0, UINT64_MAX); }},
         {"repeat",
          [&](const YAML::Node& node) { campaign.repeat = whole(node, "repeat", 1, 1000); }},
         {"classes", [&](const YAML::Node& node) { campaign.classes = classes(node); }},
         {"below", [&](const YAML::Node& node) { campaign.below = scalars(node, "below"); }},
         {"noticed", [&](const YAML::Node& node) { campaign.noticed = scalars(node, "noticed"); }},
         {"patience",
          [&](const YAML::Node& node) {
            campaign.patience_ps = quantity(node, "patience", vp::Unit::time, most_patience_ps);
          }},
         {"simulate",
          [&](const YAML::Node& node) {
            campaign.simulates_all = choice(node, "simulate", {"needed", "all"}) == "all";
          }}},
        "a campaign");
    return campaign;
  }

 private:
  std::vector<std::string> classes(const YAML::Node& node) const {
    if (node.IsScalar()) return {choice(node, "classes", FaultSpace::classes())};
    std::vector<std::string> names = scalars(node, "classes");
    for (const YAML::Node& item : node) choice(item, "classes", FaultSpace::classes());
    return names;
  }

  std::vector<std::pair<std::string, std::string>> settings(const YAML::Node& node) const {
    if (!node.IsMap()) fail(node, "'set' is a map of parameters: {ps.cores: 1}");
    std::vector<std::pair<std::string, std::string>> list;
    for (const auto& entry : node)
      list.emplace_back(scalar(entry.first, "set"), scalar(entry.second, "set"));
    return list;
  }

  const std::string path_;
};

}  // namespace

CampaignFile read_campaign(const std::string& path) {
  return CampaignReader(path).read();
}

}  // namespace platform::cli
