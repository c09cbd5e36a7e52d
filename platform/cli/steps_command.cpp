#include <algorithm>
#include <filesystem>
#include <memory>
#include <ostream>
#include <utility>

#include <cli/commands.h>
#include <cli/sweep_command.h>
#include <cli/sweep_platform.h>
#include <explore/steps.h>
#include <host/process.h>
#include <report/console.h>
#include <sweep/report.h>
#include <sweep/results.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/progress.h>

namespace platform::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* usual_figures[] = {"summary.fps.mean", "summary.latency_us.mean",
                                         "summary.energy_per_frame_mj", "resources.total.lut"};

/// The values that the folder's sweep or search gave the point.
sweep::Assignment point_in(const sweep::Manifest& manifest, const std::string& file) {
  const std::string key = fs::path(file).stem().string();
  const auto found = std::find_if(manifest.points.begin(), manifest.points.end(),
                                  [&](const auto& point) { return point.key == key; });
  if (found == manifest.points.end())
    throw vp::InputError("'" + file + "' is no point of the last sweep or search in its folder");
  return found->swept;
}

sweep::Spec spec_of(const sweep::Manifest& manifest) {
  sweep::Spec spec = sweep::parse_spec(manifest.source, manifest.name + ".yaml");
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
sweep::Results computed(sweep::Store& store, const std::shared_ptr<sweep::RunLogs>& logs,
                        const sweep::Manifest& manifest, const std::vector<vp::Expression>& figures,
                        std::ostream& err) {
  const host::InterruptGuard guard;
  const std::vector<std::size_t> pending = pending_points(store, *logs, manifest, 0, false, err);
  vp::Progress bar("steps", pending.size());
  compute(
      {}, store, manifest, pending, [&](std::uint64_t points) { bar.update(points); }, err);
  logs->complete(manifest);
  return sweep::read_results(logs, sweep::Manifest(manifest), figures);
}

}  // namespace

int find_step_effects(const SensitivityOptions& options, std::ostream& out, std::ostream& err) {
  const fs::path folder = fs::path(*options.at).parent_path().parent_path();
  sweep::read_point(*options.at);  // says what is wrong with the file
  sweep::Store store(folder.empty() ? "." : folder.string());
  store.lock();
  sweep::Manifest manifest = store.read_manifest();
  const sweep::Assignment at = point_in(manifest, *options.at);
  const sweep::Platform platform = sweep_platform();
  sweep::Space space(spec_of(manifest), platform);
  const std::vector<explore::Step> steps = explore::steps_from(space, at);
  space.manifest().points.push_back(space.point(at));
  for (const explore::Step& step : steps)
    space.manifest().points.push_back(space.point(step.point));
  const auto logs = std::make_shared<sweep::RunLogs>(store);
  const std::vector<vp::Expression> figures = figures_of(options);
  const sweep::Results results = computed(store, logs, space.manifest(), figures, err);
  if (results.missing != 0) {
    err << "markervp: interrupted: the same command goes on" << std::endl;
    return interrupted;
  }
  if (!options.figures.empty()) {
    for (const vp::Expression& figure : figures) sweep::check_names(results, figure);
  }
  const explore::StepEffects effects = explore::effects_of(steps, results, figures);
  out << explore::effects_table(effects) << "\n";
  const std::string csv = store.path("steps.csv");
  vp::write_file_durably(csv, explore::effects_csv(effects));
  const bool page =
      sweep::write_page(sweep::read_results(logs, std::move(manifest), sweep::page_figures()),
                        store.folder(), explore::effects_json(effects, results.rows.front().key));
  out << "wrote " << csv << (page ? ", report.html" : "") << std::endl;
  return done;
}

}  // namespace platform::cli
