#include <cli/faults/campaign_report.h>

#include <algorithm>
#include <map>
#include <utility>

#include <host/process.h>
#include <result/console.h>
#include <result/members.h>
#include <result/page/report_page.h>
#include <result/table.h>
#include <vp/text.h>

namespace platform::cli {

namespace {

using Json = nlohmann::ordered_json;

/// How often each outcome came, of some shots.
struct Counts {
  std::map<Outcome, std::uint64_t> by_outcome;
  std::uint64_t all = 0;
  std::uint64_t silent_hangs = 0;  ///< no access failed, and no warning came

  void add(const Shot& shot) {
    ++by_outcome[shot.outcome];
    if (shot.outcome == Outcome::hang && shot.sign.empty()) ++silent_hangs;
    ++all;
  }
  std::uint64_t of(Outcome outcome) const {
    const auto found = by_outcome.find(outcome);
    return found == by_outcome.end() ? 0 : found->second;
  }
  /// What a user must fear.
  std::uint64_t feared() const { return of(Outcome::unnoticed) + of(Outcome::hang); }
};

using Groups = std::map<std::string, Counts>;

template <class Key>
Groups grouped(const std::vector<Shot>& shots, const Key& key) {
  Groups groups;
  for (const Shot& shot : shots) {
    const std::string name = key(shot);
    if (!name.empty()) groups[name].add(shot);
  }
  return groups;
}

Groups by_class(const Campaign& campaign) {
  return grouped(campaign.shots, [](const Shot& shot) { return shot.of_class; });
}

Groups by_module(const Campaign& campaign) {
  return grouped(campaign.shots, [](const Shot& shot) { return shot.module; });
}

/// Two digits, so that they are in order; faults without a bit are left out.
Groups by_bit(const Campaign& campaign) {
  return grouped(campaign.shots, [](const Shot& shot) {
    const std::string key = ", bit: ";
    const std::size_t found = shot.fault.find(key);
    if (found == std::string::npos) return std::string();
    const std::string bit = std::to_string(std::stoul(shot.fault.substr(found + key.size())));
    return bit.size() == 1 ? "0" + bit : bit;
  });
}

std::string percent(double share) {
  return vp::format_fixed(100 * share, 2);
}

/// "1.20 (0.95 to 1.51)": percent, with the 95 % interval.
std::string share_text(std::uint64_t hits, std::uint64_t count) {
  const Interval interval = wilson(hits, count);
  return percent(static_cast<double>(hits) /
                 static_cast<double>(std::max<std::uint64_t>(1, count))) +
         " (" + percent(interval.low) + " to " + percent(interval.high) + ")";
}

std::string table_of(const std::string& title, const Groups& groups) {
  std::vector<std::string> head{title, "faults"};
  for (const Outcome outcome : outcomes()) head.push_back(to_string(outcome));
  head.push_back("% unnoticed or hang");
  result::TextTable table(head);
  for (const auto& [name, counts] : groups) {
    std::vector<std::string> row{name, std::to_string(counts.all)};
    for (const Outcome outcome : outcomes()) row.push_back(std::to_string(counts.of(outcome)));
    row.push_back(share_text(counts.feared(), counts.all));
    table.add(row);
  }
  return table.text();
}

double us_of(std::uint64_t ps) {
  constexpr double ps_per_us = 1e6;
  return result::rounded(static_cast<double>(ps) / ps_per_us, 6);
}

Json counts_json(const Counts& counts) {
  Json json{{"faults", counts.all}};
  for (const Outcome outcome : outcomes()) json[to_string(outcome)] = counts.of(outcome);
  json["silent_hangs"] = counts.silent_hangs;
  for (const Outcome outcome : outcomes()) {
    const Interval interval = wilson(counts.of(outcome), counts.all);
    json["interval"][to_string(outcome)] = {result::rounded(interval.low, 6),
                                            result::rounded(interval.high, 6)};
  }
  return json;
}

Json groups_json(const Groups& groups) {
  Json json = Json::object();
  for (const auto& [name, counts] : groups) json[name] = counts_json(counts);
  return json;
}

std::uint64_t count_known(const std::vector<Shot>& shots, Known known) {
  return static_cast<std::uint64_t>(std::count_if(
      shots.begin(), shots.end(), [known](const Shot& shot) { return shot.known == known; }));
}

Json known_json(const std::vector<Shot>& shots) {
  Json json;
  for (const Known known : {Known::run, Known::record, Known::twin})
    json[to_string(known)] = count_known(shots, known);
  return json;
}

/// The run with one fault, as a user types it.
std::string again(const CampaignFile& file, const Shot& shot) {
  std::vector<std::string> words = file.inputs;
  words.insert(words.begin(), {"markervp", "run"});
  const auto add = [&words](const std::string& option, const std::string& value) {
    words.insert(words.end(), {option, value});
  };
  if (file.design) add("--design", *file.design);
  if (file.program) add("--program", *file.program);
  if (file.fidelity) add("--fidelity", *file.fidelity);
  if (file.repeat != 1) add("--repeat", std::to_string(file.repeat));
  for (const auto& [path, value] : file.settings) add("--set", path + "=" + value);
  add("--set", "inject=[" + shot.fault + "]");
  std::string text;
  for (const std::string& word : words) {
    const bool is_plain = word.find_first_of(" []{},='\"$&|<>;*?()\\") == std::string::npos;
    text += (text.empty() ? "" : " ") + (is_plain ? word : host::shell_quoted(word));
  }
  return text;
}

/// The most that a page has of single faults.
constexpr std::size_t most_page_shots = 2000;

/// Faults that did something, those first that a user must fear.
std::vector<std::size_t> page_shots(const std::vector<Shot>& shots) {
  std::vector<std::size_t> rows;
  const std::vector<Outcome> order = {Outcome::broken, Outcome::unnoticed, Outcome::hang,
                                      Outcome::reported, Outcome::recovered};
  for (const Outcome outcome : order) {
    for (std::size_t i = 0; i < shots.size() && rows.size() < most_page_shots; ++i)
      if (shots[i].outcome == outcome) rows.push_back(i);
  }
  return rows;
}

Json shot_json(const CampaignFile& file, const std::vector<Shot>& shots, std::size_t i) {
  const Shot& shot = shots[i];
  return {{"number", i + 1},           {"class", shot.of_class},
          {"module", shot.module},     {"at_us", us_of(shot.at_ps)},
          {"times", shot.times},       {"outcome", to_string(shot.outcome)},
          {"fault", shot.fault},       {"sign", shot.sign},
          {"again", again(file, shot)}};
}

}  // namespace

std::string fearful_examples(const CampaignFile& file, const std::vector<Shot>& shots) {
  std::string text;
  for (const Outcome outcome : {Outcome::unnoticed, Outcome::hang, Outcome::broken}) {
    const auto found = std::find_if(shots.begin(), shots.end(), [outcome](const Shot& shot) {
      return shot.outcome == outcome;
    });
    if (found == shots.end()) continue;
    text += std::string("\n") + to_string(outcome) + ", for example: " + found->fault +
            (found->sign.empty() ? "" : "\n  " + found->sign) + "\n  " + again(file, *found) + "\n";
  }
  return text;
}

std::string campaign_tables(const Campaign& campaign) {
  const auto known = [&campaign](Known how) {
    return result::counted(count_known(campaign.shots, how), "fault");
  };
  return table_of("class", by_class(campaign)) + "\n" + table_of("module", by_module(campaign)) +
         "\nsimulated: " + known(Known::run) +
         "; without effect by the record of a run: " + known(Known::record) +
         "; the same as one that was simulated: " + known(Known::twin) + "\n";
}

std::string shots_csv(const std::vector<Shot>& shots) {
  std::string text = "number,class,module,at_us,outcome,times,known,fault,sign\n";
  for (std::size_t i = 0; i < shots.size(); ++i) {
    const Shot& shot = shots[i];
    text += result::csv_line({std::to_string(i + 1), shot.of_class, shot.module,
                              vp::format_fixed(us_of(shot.at_ps), 6), to_string(shot.outcome),
                              std::to_string(shot.times), to_string(shot.known), shot.fault,
                              vp::visible(shot.sign)});
  }
  return text;
}

Json campaign_json(const CampaignFile& file, const Campaign& campaign) {
  Counts all;
  for (const Shot& shot : campaign.shots) all.add(shot);
  Json json;
  if (file.design) json["design"] = *file.design;
  json.update({{"inputs", file.inputs},
               {"seed", file.seed},
               {"known", known_json(campaign.shots)},
               {"units", campaign.right.units.size()},
               {"end_us", us_of(campaign.right.end_ps)},
               {"all", counts_json(all)},
               {"classes", groups_json(by_class(campaign))},
               {"modules", groups_json(by_module(campaign))},
               {"bits", groups_json(by_bit(campaign))}});
  return json;
}

bool write_campaign_page(const std::string& path, const CampaignFile& file,
                         const Campaign& campaign) {
  Json data = campaign_json(file, campaign);
  data["outcomes"] = Json::array();
  for (const Outcome outcome : outcomes()) data["outcomes"].push_back(to_string(outcome));
  data["shots"] = Json::array();
  for (const std::size_t i : page_shots(campaign.shots))
    data["shots"].push_back(shot_json(file, campaign.shots, i));
  return page::write_page(path,
                          {{"faults", data.dump(-1, ' ', false, Json::error_handler_t::replace)}});
}

}  // namespace platform::cli
