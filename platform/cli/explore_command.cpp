#include <chrono>

#include <cli/commands.h>
#include <cli/sweep_command.h>
#include <host/process.h>
#include <result/console.h>
#include <study/engine.h>
#include <study/explore/explore.h>
#include <study/named_point.h>
#include <study/report.h>
#include <study/results.h>
#include <study/sensitivity.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/progress.h>
#include <vp/text.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <ostream>
#include <utility>

namespace platform::cli {

namespace {

namespace fs = std::filesystem;
using HostClock = std::chrono::steady_clock;

/// Between two manifests on the disk, of a search that only this process computes for.
constexpr auto manifest_period = std::chrono::seconds(10);

study::Spec spec_of(const ExploreOptions& options) {
  study::Spec spec = study::read_spec(study::sweep_file(options.file));
  if (options.points) spec.search.points = *options.points;
  if (options.seed) spec.search.seed = *options.seed;
  if (options.time) spec.search.time = options.time;
  return spec;
}

std::string size_text(const study::Space& space) {
  const double size = space.size();
  if (std::isinf(size)) return "any number of points";
  if (size < 1e9) return vp::format_fixed(size, 0) + " points";
  return "about 10^" + vp::format_fixed(std::log10(size), 0) + " points";
}

/// Computes the points of a search, generation by generation, and keeps the user informed.
class Generations {
 public:
  Generations(const ExploreOptions& options, const explore::Budget& budget, study::Store& store,
              study::Space& space, std::ostream& err)
      : options_(options),
        budget_(budget),
        store_(store),
        shards_(store),
        space_(space),
        err_(err),
        bar_(space.manifest().name, budget.points()) {
    tell_damages(shards_, err);
  }

  std::map<std::size_t, study::Outcome> compute(const std::vector<std::size_t>& positions) {
    const study::Manifest& manifest = space_.manifest();
    if (positions.empty() || host::InterruptGuard::noted()) return {};
    const std::vector<std::size_t> pending =
        pending_points(options_, store_, shards_, manifest, positions.front(), err_);
    before_ += positions.size() - pending.size();
    keep_manifest();
    const auto progress = [&](std::uint64_t points) { bar_.update(positions.front() + points); };
    const study::Tally tally = cli::compute(options_, store_, manifest, pending, progress, err_,
                                            [&] { return budget_.time_is_over(); });
    computed_ += tally.computed;
    abandoned_ += tally.abandoned;
    shards_.refresh();
    std::map<std::size_t, study::Outcome> outcomes;
    for (const std::size_t position : positions) {
      if (auto outcome = shards_.outcome(manifest.points[position].key))
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
  std::uint64_t abandoned() const { return abandoned_; }

 private:
  /// Nodes of a cluster read it; here it says what is in the folder, if the process is killed.
  void keep_manifest() {
    const HostClock::time_point now = HostClock::now();
    if (options_.engine == "local" && now < next_manifest_) return;
    store_.write_manifest(space_.manifest());
    next_manifest_ = now + manifest_period;
  }

  const ExploreOptions& options_;
  const explore::Budget& budget_;
  study::Store& store_;
  study::Shards shards_;
  study::Space& space_;
  std::ostream& err_;
  vp::Progress bar_;
  std::uint64_t computed_ = 0, before_ = 0, abandoned_ = 0;
  HostClock::time_point next_manifest_{};
};

/// What the search did, as the text of its results.
std::string search_text(const explore::Explorer& explorer, const explore::Answer& answer,
                        std::uint64_t abandoned) {
  std::string text = "The search looked at " + std::to_string(explorer.results().rows.size()) +
                     " of " + size_text(explorer.space()) + " and ended: " + to_string(answer.end) +
                     ".";
  if (abandoned != 0)
    text += " " + result::counted(abandoned, "point") +
            (abandoned == 1 ? " was in progress then and is" : " were in progress then and are") +
            " abandoned.";
  const explore::Front& front = explorer.front();
  if (front.size() != 0 && !answer.relaxations) {
    text += " Its front has " + result::counted(front.size(), "point") +
            (explorer.goal().objectives.size() < 2
                 ? "."
                 : " and a hypervolume of " + vp::format_fixed(front.hypervolume(), 3) + ".");
  }
  text += "\n";
  if (answer.relaxations) text += text_of(explorer, *answer.relaxations);
  return text;
}

int dry_run(study::Space& space, const explore::Budget& budget, std::ostream& out) {
  const explore::Explorer checked(space, budget, {});
  out << size_text(space) << ", " << budget.points()
      << " of them at most; objectives: " << vp::join(space.manifest().objectives, ", ")
      << "\nnothing was run\n";
  return done;
}

}  // namespace

int explore_points(const ExploreOptions& options, std::ostream& out, std::ostream& err) {
  const study::Platform platform = sweep_platform();
  const study::Spec spec = spec_of(options);
  const explore::Budget budget(spec.search);
  study::Space space(spec, platform);
  if (options.dry_run) return dry_run(space, budget, out);
  study::Store store(options.output.value_or((fs::path("out") / spec.name).string()));
  store.lock();
  const host::InterruptGuard guard;
  std::optional<Generations> generations(std::in_place, options, budget, store, space, err);
  explore::Explorer explorer(
      space, budget,
      [&](const std::vector<std::size_t>& positions) { return generations->compute(positions); },
      [&](std::uint64_t points, const explore::Front& front) { generations->tell(points, front); });
  const explore::Answer answer =
      explore::answer(explorer, [] { return !host::InterruptGuard::noted(); });
  space.manifest().text = search_text(explorer, answer, generations->abandoned());
  store.write_manifest(space.manifest());
  const std::uint64_t computed = generations->computed(), before = generations->before();
  generations.reset();  // and its bar
  study::Results results = explorer.results();
  results.manifest = space.manifest();
  const study::Shards shards(store);
  write_results(options, store, shards, results, computed, before, out);
  if (host::InterruptGuard::noted()) {
    err << "markervp: interrupted: the same command continues" << std::endl;
    return interrupted;
  }
  return code_of_failures(options, results, err);
}

namespace {

namespace fs = std::filesystem;

constexpr const char* usual_figures[] = {"summary.fps.mean", "summary.latency_us.mean",
                                         "summary.energy_per_frame_mj", "resources.total.lut"};

/// The values that the folder's sweep or search gave the point.
study::Assignment point_in(const study::Manifest& manifest, const study::NamedPoint& point) {
  const auto found = std::find_if(manifest.points.begin(), manifest.points.end(),
                                  [&](const auto& planned) { return planned.key == point.key; });
  if (found == manifest.points.end())
    throw vp::InputError("'" + point.name +
                         "' is no point of the last sweep or search in its folder");
  return found->swept;
}

study::Spec spec_of(const study::Manifest& manifest) {
  study::Spec spec = study::parse_spec(manifest.source, manifest.name + ".yaml");
  spec.sampling = {};  // its points are not asked for
  return spec;
}

std::vector<vp::Expression> figures_of(const SensitivityOptions& options) {
  std::vector<vp::Expression> figures;
  for (const std::string& text : options.figures) figures.emplace_back(text, "--figure");
  if (options.figures.empty()) {
    for (const char* name : usual_figures) figures.emplace_back(name, name);
  }
  return figures;
}

/// The points of a manifest, computed where they are not there.
study::Results computed(study::Store& store, const std::shared_ptr<study::Shards>& shards,
                        const study::Manifest& manifest, const std::vector<vp::Expression>& figures,
                        std::ostream& err) {
  const host::InterruptGuard guard;
  const std::vector<std::size_t> pending = pending_points({}, store, *shards, manifest, 0, err);
  vp::Progress bar("steps", pending.size());
  compute(
      {}, store, manifest, pending, [&](std::uint64_t points) { bar.update(points); }, err);
  shards->refresh();
  return study::read_results(shards, study::Manifest(manifest), figures);
}

}  // namespace

int find_step_effects(const SensitivityOptions& options, std::ostream& out, std::ostream& err) {
  const study::NamedPoint named = study::named_point(*options.at);
  study::Store store(named.folder);
  store.lock();
  study::Manifest manifest = store.read_manifest();
  const study::Assignment at = point_in(manifest, named);
  const study::Platform platform = sweep_platform();
  study::Space space(spec_of(manifest), platform);
  const std::vector<study::Step> steps = study::steps_from(space, at);
  space.manifest().points.push_back(space.point(at));
  for (const study::Step& step : steps) space.manifest().points.push_back(space.point(step.point));
  const auto shards = std::make_shared<study::Shards>(store);
  const std::vector<vp::Expression> figures = figures_of(options);
  const study::Results results = computed(store, shards, space.manifest(), figures, err);
  if (results.missing != 0) {
    err << "markervp: interrupted: the same command continues" << std::endl;
    return interrupted;
  }
  if (!options.figures.empty()) {
    for (const vp::Expression& figure : figures) study::check_names(results, figure);
  }
  const study::StepEffects effects = study::effects_of(steps, results, figures);
  out << study::effects_table(effects) << "\n";
  const std::string csv = store.path("steps.csv");
  vp::write_file_durably(csv, study::effects_csv(effects));
  const study::Results whole =
      study::read_results(shards, std::move(manifest), study::page_figures());
  study::Json more = page_extras(whole);
  more["steps"] = study::effects_json(effects, results.rows.front().key);
  const bool page = study::write_page(whole, store.folder(), more);
  out << "wrote " << csv << (page ? ", report.html" : "") << std::endl;
  return done;
}

}  // namespace platform::cli
