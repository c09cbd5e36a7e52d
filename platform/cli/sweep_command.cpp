#include <sched.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <memory>
#include <numeric>
#include <ostream>

#include <cli/commands.h>
#include <cli/interrupt.h>
#include <cli/program.h>
#include <cli/sweep_platform.h>
#include <page/report_page.h>
#include <report/words.h>
#include <sweep/database.h>
#include <sweep/durable_file.h>
#include <sweep/engine_slurm.h>
#include <sweep/results_csv.h>
#include <sweep/studies.h>
#include <sweep/summary.h>
#include <sweep/text_table.h>
#include <vp/error.h>
#include <vp/progress.h>

namespace platform::cli {

namespace {

namespace fs = std::filesystem;

/// Points that --dry-run shows.
constexpr std::size_t shown_points = 20;

std::uint32_t cores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (::sched_getaffinity(0, sizeof set, &set) != 0) return 1;
  return static_cast<std::uint32_t>(std::max(1, CPU_COUNT(&set)));
}

int list_studies(std::ostream& out) {
  sweep::TextTable table({"study", "question"});
  for (const sweep::Study& study : sweep::studies()) table.add({study.name, study.title});
  out << table.text() << "\n'markervp sweep NAME' runs one; 'markervp pareto out/NAME' shows its "
      << "best points.\n";
  return done;
}

int show_points(const sweep::Manifest& manifest, std::ostream& out) {
  std::vector<std::string> head = sweep::short_names(manifest.swept);
  head.emplace_back("key");
  sweep::TextTable table(head);
  for (std::size_t i = 0; i < std::min(shown_points, manifest.points.size()); ++i) {
    std::vector<std::string> row;
    for (const std::string& path : manifest.swept) {
      const auto& swept = manifest.points[i].swept;
      const auto found = std::find_if(swept.begin(), swept.end(),
                                      [&](const auto& value) { return value.first == path; });
      row.push_back(found == swept.end() ? "-" : found->second);
    }
    row.push_back(manifest.points[i].key);
    table.add(row);
  }
  out << table.text();
  if (manifest.points.size() > shown_points) out << "…\n";
  out << report::counted(manifest.points.size(), "point") << "; nothing was run\n";
  return done;
}

/// Says what else is in the folder.
void mention_others(const sweep::Store& store, const sweep::Manifest& manifest, std::ostream& err) {
  std::vector<std::string> foreign;
  std::vector<std::string> keys = store.keys(foreign);
  if (!foreign.empty()) {
    err << "markervp: warning: '" << store.path("points") << "' has '" << foreign.front() << "'"
        << (foreign.size() > 1 ? " and others" : "") << ", which no sweep wrote: left alone"
        << std::endl;
  }
  std::vector<std::string> planned;
  for (const sweep::PlannedPoint& point : manifest.points) planned.push_back(point.key);
  std::sort(planned.begin(), planned.end());
  std::uint64_t older = 0;
  std::string version;
  for (const std::string& key : keys) {
    if (std::binary_search(planned.begin(), planned.end(), key)) continue;
    try {
      const sweep::Json other = store.read(key).identity.at("markervp");
      if (other == manifest.program) continue;
      ++older;
      version = other.value("version", "") + " " + other.value("revision", "");
    } catch (const vp::InputError& error) {
      err << "markervp: warning: " << error.what() << std::endl;
    }
  }
  if (older != 0)
    err << "markervp: " << report::counted(older, "point") << " of another version of the program ("
        << version << ") stay as they are and count for nothing here" << std::endl;
}

/// Positions of the points that have no result. Throws vp::InputError for a damaged one.
std::vector<std::size_t> pending_points(const sweep::Store& store, const sweep::Manifest& manifest,
                                        bool retry_failed) {
  std::vector<std::size_t> pending;
  for (std::size_t i = 0; i < manifest.points.size(); ++i) {
    const std::string& key = manifest.points[i].key;
    bool wanted = !store.has(key);
    if (!wanted && store.read(key).failed() && retry_failed) {
      std::error_code ignored;
      fs::remove(store.point_path(key), ignored);
      wanted = true;
    }
    if (wanted) pending.push_back(i);
  }
  return pending;
}

sweep::Tally compute(const SweepOptions& options, const sweep::Store& store,
                     const sweep::Manifest& manifest, const std::vector<std::size_t>& pending,
                     const SimulationFactory& make_simulation, std::ostream& err) {
  if (pending.empty()) return {};
  const sweep::RunPoint run = point_runner(make_simulation);
  const InterruptGuard guard;
  vp::Progress bar(manifest.name, pending.size());
  const auto progress = [&](std::uint64_t points) { bar.update(points); };
  if (options.engine == "slurm") {
    warm_up(manifest, {pending.front()});
    const sweep::SlurmOptions slurm{options.chunk, options.at_once, options.sbatch, manifest.name};
    return run_slurm(store, manifest, pending, slurm, run, progress, err);
  }
  warm_up(manifest, pending);
  const sweep::LocalOptions local{options.jobs.value_or(cores()), "local"};
  return run_local(store, manifest, pending, local, run, progress);
}

/// What was done, and what stands in the folder for it.
void write_results(const SweepOptions& options, const sweep::Store& store,
                   const sweep::Results& results, const sweep::Tally& tally, std::size_t pending,
                   std::ostream& out) {
  sweep::write_durably(store.path("sweep.csv"), sweep::results_csv(results));
  sweep::write_database(store.path("sweep.sqlite"), results, sweep::read_runs(store));
  const bool page = !options.no_report && page::write_report(store.folder());
  out << sweep::sweep_text(results) << "\n"
      << report::counted(results.rows.size(), "point") << ": " << tally.computed
      << " computed now, " << results.manifest.points.size() - pending << " there before, "
      << results.failed() << " failed\n"
      << "wrote " << store.path("sweep.csv") << ", sweep.sqlite and points/ beside it";
  if (page) out << ", report.html to look at";
  out << std::endl;
}

int conclude(const SweepOptions& options, const sweep::Store& store,
             const sweep::Manifest& manifest, const sweep::Tally& tally, std::size_t pending,
             std::ostream& out, std::ostream& err) {
  const sweep::Results results = sweep::read_results(store, manifest, false);
  write_results(options, store, results, tally, pending, out);
  if (tally.interrupted) {
    err << "markervp: interrupted: " << results.missing << " of "
        << report::counted(manifest.points.size(), "point")
        << " are missing; the same command goes on" << std::endl;
    return interrupted;
  }
  if (results.failed() == results.rows.size() && results.failed() != 0) {
    err << "markervp: every point failed" << std::endl;
    return run_failed;
  }
  return done;
}

}  // namespace

int sweep_points(const SweepOptions& options, const SimulationFactory& make_simulation,
                 std::ostream& out, std::ostream& err) {
  if (options.list) return list_studies(out);
  if (options.file.empty())
    throw vp::InputError("sweep: name a YAML file, or a study that 'markervp sweep --list' shows");
  // A limit on the size of files is then an error that can be reported.
  std::signal(SIGXFSZ, SIG_IGN);
  const sweep::Spec spec = sweep::read_spec(sweep::sweep_file(options.file));
  const sweep::Platform platform = sweep_platform(make_simulation);
  const sweep::Manifest manifest = sweep::plan(spec, {options.limit, options.yes}, platform);
  if (options.dry_run) return show_points(manifest, out);
  try {
    sweep::Store store(options.output.value_or((fs::path("out") / spec.name).string()));
    store.lock();
    const std::vector<std::size_t> pending = pending_points(store, manifest, options.retry_failed);
    mention_others(store, manifest, err);
    store.write_manifest(manifest);
    const sweep::Tally tally = compute(options, store, manifest, pending, make_simulation, err);
    return conclude(options, store, manifest, tally, pending.size(), out, err);
  } catch (const sweep::StorageError& error) {
    throw vp::InputError(error.what());
  }
}

int sweep_worker(const SweepWorkerOptions& options, const SimulationFactory& make_simulation) {
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    const sweep::Store store(options.folder);
    const InterruptGuard guard;
    return sweep::run_slurm_task(store, options.submission, options.task, warm_up,
                                 point_runner(make_simulation));
  } catch (const sweep::StorageError& error) {
    throw vp::InputError(error.what());
  }
}

}  // namespace platform::cli
