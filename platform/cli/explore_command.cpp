#include <chrono>
#include <cmath>
#include <filesystem>
#include <ostream>
#include <utility>

#include <cli/commands.h>
#include <cli/sweep_command.h>
#include <cli/sweep_platform.h>
#include <explore/explore.h>
#include <explore/relaxation.h>
#include <host/process.h>
#include <report/console.h>
#include <sweep/engine.h>
#include <sweep/report.h>
#include <vp/error.h>
#include <vp/progress.h>
#include <vp/text.h>

namespace platform::cli {

namespace {

namespace fs = std::filesystem;
using HostClock = std::chrono::steady_clock;

/// Between two manifests on the disk, of a search that only this process computes for.
constexpr auto manifest_period = std::chrono::seconds(10);

sweep::Spec spec_of(const ExploreOptions& options) {
  sweep::Spec spec = sweep::read_spec(sweep::sweep_file(options.file));
  if (options.points) spec.search.points = *options.points;
  if (options.seed) spec.search.seed = *options.seed;
  if (options.time) spec.search.time = options.time;
  return spec;
}

std::string size_text(const sweep::Space& space) {
  const double size = space.size();
  if (std::isinf(size)) return "any number of points";
  if (size < 1e9) return vp::format_fixed(size, 0) + " points";
  return "about 10^" + vp::format_fixed(std::log10(size), 0) + " points";
}

/// Brings the points of a search, generation by generation, and keeps the user informed.
class Generations {
 public:
  Generations(const ExploreOptions& options, sweep::Store& store, sweep::Space& space,
              std::ostream& err)
      : options_(options),
        store_(store),
        logs_(store),
        space_(space),
        err_(err),
        bar_(space.manifest().name, space.spec().search.points) {}

  std::map<std::size_t, sweep::Outcome> compute(const std::vector<std::size_t>& positions) {
    const sweep::Manifest& manifest = space_.manifest();
    if (positions.empty() || host::InterruptGuard::noted()) return {};
    const std::vector<std::size_t> pending =
        pending_points(store_, logs_, manifest, positions.front(), options_.retry_failed, err_);
    before_ += positions.size() - pending.size();
    keep_manifest();
    const auto progress = [&](std::uint64_t points) { bar_.update(positions.front() + points); };
    computed_ += cli::compute(options_, store_, manifest, pending, progress, err_).computed;
    logs_.refresh();
    std::map<std::size_t, sweep::Outcome> outcomes;
    for (const std::size_t position : positions) {
      if (auto outcome = logs_.outcome(manifest.points[position].key))
        outcomes.emplace(position, *std::move(outcome));
    }
    return outcomes;
  }

  void tell(std::uint64_t points, const explore::Front& front) {
    bar_.label(space_.manifest().name + ": front " + std::to_string(front.size()) +
               ", hypervolume " + vp::format_fixed(front.hypervolume(), 3));
    bar_.update(points);
  }

  std::uint64_t computed() const { return computed_; }
  std::uint64_t before() const { return before_; }

 private:
  /// Nodes of a cluster read it; here it says what stands in the folder, if the process is killed.
  void keep_manifest() {
    const HostClock::time_point now = HostClock::now();
    if (options_.engine == "local" && now < next_manifest_) return;
    store_.write_manifest(space_.manifest());
    next_manifest_ = now + manifest_period;
  }

  const ExploreOptions& options_;
  sweep::Store& store_;
  sweep::RunLogs logs_;
  sweep::Space& space_;
  std::ostream& err_;
  vp::Progress bar_;
  std::uint64_t computed_ = 0, before_ = 0;
  HostClock::time_point next_manifest_{};
};

/// What the search did, as the text of its results.
std::string search_text(const explore::Explorer& explorer, explore::End end) {
  const explore::Front& front = explorer.front();
  std::string text = "The search looked at " + std::to_string(explorer.results().rows.size()) +
                     " of " + size_text(explorer.space()) + " and ended: " + to_string(end) + ".";
  if (front.size() != 0) {
    text += " Its front has " + report::counted(front.size(), "point") +
            (explorer.goal().objectives.size() < 2
                 ? "."
                 : " and a hypervolume of " + vp::format_fixed(front.hypervolume(), 3) + ".");
  }
  return text + "\n";
}

int dry_run(sweep::Space& space, std::ostream& out) {
  const explore::Explorer checked(space, {});
  out << size_text(space) << ", " << space.spec().search.points
      << " of them at most; objectives: " << vp::join(space.manifest().objectives, ", ")
      << "\nnothing was run\n";
  return done;
}

}  // namespace

int explore_points(const ExploreOptions& options, std::ostream& out, std::ostream& err) {
  const sweep::Platform platform = sweep_platform();
  const sweep::Spec spec = spec_of(options);
  sweep::Space space(spec, platform);
  if (options.dry_run) return dry_run(space, out);
  sweep::Store store(options.output.value_or((fs::path("out") / spec.name).string()));
  store.lock();
  const host::InterruptGuard guard;
  std::optional<Generations> generations(std::in_place, options, store, space, err);
  explore::Explorer explorer(
      space,
      [&](const std::vector<std::size_t>& positions) { return generations->compute(positions); },
      [&](std::uint64_t points, const explore::Front& front) { generations->tell(points, front); });
  const explore::End end = explorer.explore();
  std::string text = search_text(explorer, end);
  const bool over = end == explore::End::interrupted || end == explore::End::failed;
  if (explorer.front().size() == 0 && !over)
    text += text_of(explorer,
                    explore::relaxations(explorer, [] { return !host::InterruptGuard::noted(); }));
  space.manifest().text = text;
  store.write_manifest(space.manifest());
  const std::uint64_t computed = generations->computed(), before = generations->before();
  generations.reset();  // and its bar
  sweep::Results results = explorer.results();
  results.manifest = space.manifest();
  sweep::RunLogs logs(store);
  logs.complete(space.manifest());
  write_results(options, store, logs, results, computed, before, out);
  if (host::InterruptGuard::noted()) {
    err << "markervp: interrupted: the same command goes on" << std::endl;
    return interrupted;
  }
  return code_of_failures(options, results, err);
}

}  // namespace platform::cli
