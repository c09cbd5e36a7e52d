#include <algorithm>
#include <filesystem>
#include <future>
#include <memory>
#include <numeric>
#include <ostream>
#include <string_view>
#include <utility>
#include <vector>

#include <chip/system/designs.h>
#include <cli/commands.h>
#include <cli/program.h>
#include <cli/sweep_command.h>
#include <host/process.h>
#include <result/console.h>
#include <result/metrics.h>
#include <result/table.h>
#include <study/engine.h>
#include <study/explore/progress.h>
#include <study/report.h>
#include <study/results.h>
#include <study/spec.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/progress.h>

namespace platform::cli {

namespace {

namespace fs = std::filesystem;

/// Points that --dry-run shows, and that it builds.
constexpr std::size_t shown_points = 20, most_built = 500;

/// What a sweep ends with if points failed, but `some` did not.
int points_failed_code(const SweepOptions& options, bool some) {
  return some && !options.require_all ? points_failed : run_failed;
}

int list_studies(std::ostream& out) {
  result::TextTable table({"study", "question"});
  for (const study::Study& study : study::studies()) table.add({study.name, study.title});
  out << table.text() << "\n'markervp sweep NAME' runs one; 'markervp pareto out/NAME' shows its "
      << "best points.\n";
  return done;
}

void show_points(const study::Manifest& manifest, std::ostream& out) {
  std::vector<std::string> head = result::short_names(manifest.swept);
  head.emplace_back("key");
  result::TextTable table(head);
  for (std::size_t i = 0; i < std::min(shown_points, manifest.points.size()); ++i) {
    std::vector<std::string> row;
    for (const std::string& path : manifest.swept) {
      const std::string* value = find(manifest.points[i].swept, path);
      row.push_back(value == nullptr ? "-" : *value);
    }
    row.push_back(manifest.points[i].key);
    table.add(row);
  }
  out << table.text();
  if (manifest.points.size() > shown_points) out << "…\n";
}

/// Shows the points, and which of them a run would refuse. Returns what it would end with.
int dry_run(const SweepOptions& options, const study::Manifest& manifest,
            const study::Platform& platform, std::ostream& out) {
  if (options.engine == "slurm") study::largest_array();
  show_points(manifest, out);
  host::check_written(out);  // before processes begin as copies of this one and of what it holds
  const study::Refusals refusals = study::try_points(manifest, platform, most_built);
  for (const auto& [reason, count] : refusals.reasons)
    out << result::counted(count, "point") << " will fail: " << reason << "\n";
  const std::size_t points = manifest.points.size();
  if (points > most_built) out << "built the first " << most_built << " of them to see\n";
  out << result::counted(points, "point") << "; nothing was run\n";
  return refusals.points() == 0 ? done : points_failed_code(options, refusals.built != 0);
}

void warn(const std::vector<std::string>& warnings, std::ostream& err) {
  for (const std::string& warning : warnings) err << "markervp: warning: " << warning << std::endl;
}

/// Whole results that no shard and no point of the sweep knows: an earlier version left them.
std::uint64_t left_over(const study::Store& store, const study::Shards& shards,
                        const study::Manifest& manifest, std::string& version, std::ostream& err) {
  std::vector<std::string> foreign;
  const std::vector<std::string> keys = store.kept_keys(foreign);
  if (!foreign.empty()) {
    err << "markervp: warning: '" << store.path("points") << "' has '" << foreign.front() << "'"
        << (foreign.size() > 1 ? " and others" : "") << ", which no sweep wrote: left alone"
        << std::endl;
  }
  std::vector<std::string_view> planned;
  planned.reserve(manifest.points.size());
  for (const study::Point& point : manifest.points) planned.push_back(point.key);
  std::sort(planned.begin(), planned.end());
  std::uint64_t count = 0;
  for (const std::string& key : keys) {
    if (shards.has(key) || std::binary_search(planned.begin(), planned.end(), key)) continue;
    if (count++ != 0) continue;
    try {
      const study::Json other = study::read_kept(store.kept_path(key)).identity_json();
      version = other.at("markervp").value("version", "") + " " +
                other.at("markervp").value("revision", "");
    } catch (const vp::InputError& error) {
      err << "markervp: warning: " << error.what() << std::endl;
    }
  }
  return count;
}

/// Says what else is in the folder.
void mention_others(const study::Store& store, const study::Shards& shards,
                    const study::Manifest& manifest, std::ostream& err) {
  std::string version;
  const std::uint64_t others = left_over(store, shards, manifest, version, err) +
                               shards.of_other_versions(manifest.program, version);
  if (others != 0)
    err << "markervp: " << result::counted(others, "point")
        << " of another version of the program (" << version
        << ") stay as they are and count for nothing here" << std::endl;
}

}  // namespace

void tell_damages(const study::Shards& shards, std::ostream& err) {
  warn(shards.damages(), err);
}

std::vector<std::size_t> pending_points(const SweepOptions& options, const study::Store& store,
                                        study::Shards& shards, const study::Manifest& manifest,
                                        std::size_t first, std::ostream& err) {
  study::adopt_kept(store, manifest, shards, first, [&](const std::string& file) {
    err << "markervp: warning: '" << file
        << "' is not whole, as a power failure leaves it: the point is computed again" << std::endl;
    std::error_code ignored;
    fs::remove(file, ignored);
  });
  study::Shards::Block block;
  std::vector<std::size_t> pending;
  for (std::size_t i = first; i < manifest.points.size(); ++i) {
    const std::string& key = manifest.points[i].key;
    std::error_code ignored;
    bool is_there = shards.has(key);
    if (is_there && options.retry_failed)
      is_there = !shards.outcome(key, study::Shards::Want::facts, block)->failed;
    if (is_there && options.keep_results) is_there = fs::exists(store.kept_path(key), ignored);
    if (!is_there) pending.push_back(i);
  }
  return pending;
}

namespace {

/// A PS program or a design of the user's own may leave anything behind in its process.
std::uint32_t points_a_process(const study::Manifest& manifest, bool isolate) {
  const bool own = std::any_of(manifest.families.begin(), manifest.families.end(),
                               [](const study::Family& family) {
                                 return runs_own_code(family.program, family.configuration);
                               });
  return own || isolate ? 1 : study::usual_points_a_process;
}

}  // namespace

study::Tally compute(const SweepOptions& options, const study::Store& store,
                     const study::Manifest& manifest, const std::vector<std::size_t>& pending,
                     const study::OnProgress& progress, std::ostream& err,
                     const study::IsOver& is_over) {
  if (pending.empty()) return {};
  if (options.engine == "slurm") {
    warm_up(manifest, {pending.front()});
    const study::SlurmOptions slurm{options.chunk,
                                    options.at_once,
                                    options.sbatch,
                                    manifest.name,
                                    points_a_process(manifest, options.isolate),
                                    is_over,
                                    options.keep_results};
    return run_slurm(store, manifest, pending, slurm, run_point, progress, err);
  }
  warm_up(manifest, pending);
  const study::LocalOptions local{options.jobs.value_or(host::usable_cores()),
                                  "local",
                                  points_a_process(manifest, options.isolate),
                                  [&](const std::string& text) { warn({text}, err); },
                                  is_over,
                                  options.keep_results};
  return run_local(store, manifest, pending, local, run_point, progress);
}

study::Json page_extras(const study::Results& results) {
  study::Json extras = study::Json::object();
  study::Json progress = explore::progress_json(results);
  if (!progress.is_null()) extras["progress"] = std::move(progress);
  return extras;
}

void write_results(const SweepOptions& options, const study::Store& store,
                   const study::Shards& shards, const study::Results& results,
                   std::uint64_t computed, std::uint64_t before, std::ostream& out) {
  // The database takes as long as all the rest, of a million points half a minute.
  std::future<void> database = std::async(std::launch::async, [&] {
    study::write_database(store.path("sweep.sqlite"), results, shards);
  });
  study::write_csv(store.path("sweep.csv"), results);
  const bool page =
      !options.no_report && study::write_page(results, store.folder(), page_extras(results));
  const std::string text = study::sweep_text(results);
  database.get();
  out << text << "\n"
      << result::counted(results.rows.size(), "point") << ": " << computed << " computed now, "
      << before << " there before, " << results.failed() << " failed\n"
      << "wrote " << store.path("sweep.csv") << ", sweep.sqlite and "
      << (options.keep_results ? "points/" : "runs/") << " beside it";
  if (page) out << ", report.html to look at";
  out << std::endl;
}

int code_of_failures(const SweepOptions& options, const study::Results& results,
                     std::ostream& err) {
  if (results.failed() == 0) return done;
  const bool all = results.failed() == results.rows.size();
  err << "markervp: "
      << (all ? "every point"
              : result::counted(results.failed(), "point") + " of " +
                    std::to_string(results.rows.size()))
      << " failed" << std::endl;
  return points_failed_code(options, !all);
}

namespace {

int conclude(const SweepOptions& options, const study::Store& store,
             const std::shared_ptr<study::Shards>& shards, study::Manifest&& manifest,
             const study::Tally& tally, std::uint64_t before, std::ostream& out,
             std::ostream& err) {
  const std::size_t points = manifest.points.size();
  shards->refresh();
  const study::Results results =
      study::read_results(shards, std::move(manifest), study::page_figures());
  write_results(options, store, *shards, results, tally.computed, before, out);
  if (results.failed() != results.rows.size())
    warn(study::missing_figures(results.manifest, results.metric_names()), err);
  if (tally.interrupted) {
    err << "markervp: interrupted: " << results.missing << " of "
        << result::counted(points, "point") << " are missing; the same command continues"
        << std::endl;
    return interrupted;
  }
  return code_of_failures(options, results, err);
}

/// All points of a sweep, with a bar.
study::Tally compute_all(const SweepOptions& options, const study::Store& store,
                         const study::Manifest& manifest, const std::vector<std::size_t>& pending,
                         std::ostream& err) {
  const host::InterruptGuard guard;
  vp::Progress bar(manifest.name, pending.size());
  return compute(
      options, store, manifest, pending, [&](std::uint64_t points) { bar.update(points); }, err);
}

}  // namespace

int sweep_points(const SweepOptions& options, std::ostream& out, std::ostream& err) {
  if (options.list) return list_studies(out);
  if (options.file.empty())
    throw vp::InputError("sweep: name a YAML file, or a study that 'markervp sweep --list' shows");
  const study::Spec spec = study::read_spec(study::sweep_file(options.file));
  const study::Platform platform = sweep_platform();
  study::Manifest manifest = study::plan(spec, {options.limit, options.yes}, platform);
  if (options.dry_run) return dry_run(options, manifest, platform, out);
  try {
    study::Store store(options.output.value_or((fs::path("out") / spec.name).string()));
    store.lock();
    const auto shards = std::make_shared<study::Shards>(store);
    tell_damages(*shards, err);
    const std::vector<std::size_t> pending =
        pending_points(options, store, *shards, manifest, 0, err);
    std::future<void> written =
        std::async(std::launch::async, [&] { store.write_manifest(manifest); });
    mention_others(store, *shards, manifest, err);
    written.get();
    const study::Tally tally = compute_all(options, store, manifest, pending, err);
    const std::size_t before = manifest.points.size() - pending.size();
    return conclude(options, store, shards, std::move(manifest), tally, before, out, err);
  } catch (const vp::HostError& error) {
    throw vp::HostError(std::string(error.what()) +
                        "; what was computed is kept: run the sweep again");
  }
}

int sweep_worker(const SweepWorkerOptions& options, std::ostream& err) {
  const study::Store store(options.folder);
  const host::InterruptGuard guard;
  return study::run_slurm_task(
      store, {options.submission, options.task, options.points_a_process, options.keep_results},
      warm_up, run_point, err);
}

}  // namespace platform::cli
