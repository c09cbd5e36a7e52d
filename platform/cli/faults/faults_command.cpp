#include <algorithm>
#include <filesystem>
#include <memory>
#include <ostream>
#include <string>

#include <cli/commands.h>
#include <cli/faults/campaign_report.h>
#include <cli/program.h>
#include <host/output_folder.h>
#include <host/process.h>
#include <result/console.h>
#include <result/page/report_page.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/progress.h>

namespace platform::cli {

namespace {

namespace fs = std::filesystem;

void write_file(const std::string& path, const std::string& text) {
  vp::OutputFile file(path);
  file.write(text);
  file.commit();
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
  write_file(folder.add("faults.csv"), shots_csv(campaign.shots));
  write_file(folder.add("faults.json"), campaign_json(file, campaign).dump(2) + "\n");
  const bool page = write_campaign_page(folder.add(page::report_name), file, campaign);
  out << campaign_tables(campaign) << fearful_examples(file, campaign.shots) << "\nwrote "
      << (fs::path(options.output) / (page ? page::report_name : "faults.json")).string()
      << (page ? " to look at, faults.json and" : ",") << " faults.csv beside it: a line a fault\n";
  if (host::InterruptGuard::noted()) {
    err << "markervp: interrupted; " << result::counted(campaign.shots.size(), "fault") << " of "
        << file.count << " are kept" << std::endl;
    return interrupted;
  }
  const auto broken = static_cast<std::size_t>(
      std::count_if(campaign.shots.begin(), campaign.shots.end(),
                    [](const Shot& shot) { return shot.outcome == Outcome::broken; }));
  if (broken == 0) return done;
  return host::fail(err,
                    result::counted(broken, "fault") + " ended the simulator: this is a bug of it",
                    run_failed);
}

}  // namespace platform::cli
