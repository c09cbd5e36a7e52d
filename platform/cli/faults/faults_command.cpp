#include <algorithm>
#include <filesystem>
#include <map>
#include <ostream>
#include <string>
#include <vector>

#include <cli/commands.h>
#include <cli/faults/campaign.h>
#include <cli/program.h>
#include <host/output_folder.h>
#include <host/process.h>
#include <result/console.h>
#include <result/table.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/progress.h>
#include <vp/text.h>
#include <vp/unit.h>

namespace platform::cli {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// How often each outcome came, of some shots.
struct Counts {
  std::map<Outcome, std::uint64_t> by_outcome;
  std::uint64_t all = 0;

  void add(const Shot& shot) {
    ++by_outcome[shot.outcome];
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

Groups grouped(const std::vector<Shot>& shots, std::string Shot::*by) {
  Groups groups;
  for (const Shot& shot : shots) groups[shot.*by].add(shot);
  return groups;
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

Json counts_json(const Counts& counts) {
  Json json{{"faults", counts.all}};
  for (const Outcome outcome : outcomes()) json[to_string(outcome)] = counts.of(outcome);
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

std::string csv_field(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : vp::visible(text)) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

/// A line a fault; `fault` is what `--set inject=` takes in brackets.
std::string shots_csv(const std::vector<Shot>& shots) {
  std::string text = "number,class,module,at_us,outcome,times,fault,sign\n";
  for (std::size_t i = 0; i < shots.size(); ++i) {
    const Shot& shot = shots[i];
    constexpr double ps_per_us = 1e6;
    text += std::to_string(i + 1) + "," + shot.of_class + "," + shot.module + "," +
            vp::format_fixed(static_cast<double>(shot.at_ps) / ps_per_us, 6) + "," +
            to_string(shot.outcome) + "," + std::to_string(shot.times) + "," +
            csv_field(shot.fault) + "," + csv_field(shot.sign) + "\n";
  }
  return text;
}

void write_file(const std::string& path, const std::string& text) {
  vp::OutputFile file(path);
  file.write(text);
  file.commit();
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

/// The first fault of each outcome that a user wants to look into.
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

}  // namespace

int run_faults(const FaultsOptions& options, std::ostream& out, std::ostream& err) {
  CampaignFile file = read_campaign(options.file);
  if (options.count) file.count = *options.count;
  if (options.seed) file.seed = *options.seed;
  host::OutputFolder folder(options.output);
  std::unique_ptr<vp::Progress> bar;
  if (!options.quiet) bar = std::make_unique<vp::Progress>("faults", file.count);
  const host::InterruptGuard guard;
  const Campaign campaign =
      run_campaign(file, options.jobs.value_or(host::usable_cores()), [&bar](std::uint64_t done) {
        if (bar) bar->update(done);
      });
  bar.reset();
  const Groups classes = grouped(campaign.shots, &Shot::of_class);
  const Groups modules = grouped(campaign.shots, &Shot::module);
  Counts all;
  for (const Shot& shot : campaign.shots) all.add(shot);
  const Json json{{"seed", file.seed},
                  {"units", campaign.right.units.size()},
                  {"end_us", result::rounded(static_cast<double>(campaign.right.end_ps) / 1e6, 6)},
                  {"all", counts_json(all)},
                  {"classes", groups_json(classes)},
                  {"modules", groups_json(modules)}};
  write_file(folder.add("faults.csv"), shots_csv(campaign.shots));
  write_file(folder.add("faults.json"), json.dump(2) + "\n");
  out << table_of("class", classes) << "\n"
      << table_of("module", modules) << fearful_examples(file, campaign.shots) << "\nwrote "
      << (fs::path(options.output) / "faults.json").string()
      << ", faults.csv beside it: a line a fault\n";
  if (host::InterruptGuard::noted()) {
    err << "markervp: interrupted; " << result::counted(campaign.shots.size(), "fault") << " of "
        << file.count << " are kept" << std::endl;
    return interrupted;
  }
  return all.of(Outcome::broken) > 0
             ? host::fail(err,
                          result::counted(all.of(Outcome::broken), "fault") +
                              " ended the simulator: this is a bug of it",
                          run_failed)
             : done;
}

}  // namespace platform::cli
