#include <algorithm>

#include <chip/run/simulation.h>
#include <cli/commands.h>
#include <cli/program.h>
#include <cli/sweep_command.h>
#include <result/console.h>
#include <result/figures.h>
#include <result/metrics.h>
#include <result/page/report_page.h>
#include <result/table.h>
#include <study/compare.h>
#include <study/named_point.h>
#include <study/pareto.h>
#include <study/report.h>
#include <study/results.h>
#include <study/sensitivity.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>

#include <filesystem>
#include <map>
#include <memory>
#include <ostream>

namespace platform::cli {

namespace {

/// All results in the folder of a sweep. Those of an earlier version are taken over.
std::shared_ptr<study::Shards> shards_of(const study::Store& store, const study::Manifest& manifest,
                                         std::ostream& err) {
  auto shards = std::make_shared<study::Shards>(store);
  tell_damages(*shards, err);
  study::adopt_kept(store, manifest, *shards, 0, [&](const std::string& file) {
    err << "markervp: warning: '" << file
        << "' is not whole, as a power failure leaves it: sweep again" << std::endl;
  });
  return shards;
}

/// The results of a sweep's folder, which must exist, with the figures that are asked for.
study::Results results_of(const std::string& folder, const std::vector<vp::Expression>& figures,
                          std::ostream& err) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored))
    throw vp::InputError("there is no folder '" + folder + "': run a sweep first");
  if (!std::filesystem::exists(std::filesystem::path(folder) / "manifest.json", ignored))
    throw vp::InputError("'" + folder + "' is no folder of a sweep: it has no manifest.json");
  const study::Store store(folder);
  study::Manifest manifest = store.read_manifest();
  const auto shards = shards_of(store, manifest, err);
  study::Results results = study::read_results(shards, std::move(manifest), figures);
  if (results.missing != 0)
    err << "markervp: warning: " << result::counted(results.missing, "point") << " not computed yet"
        << std::endl;
  return results;
}

/// The study's objectives that some point has a value of.
std::vector<study::Objective> known_objectives(const study::Results& results) {
  std::vector<study::Objective> objectives = study::objectives_of(results);
  if (objectives.empty() && results.failed() != results.rows.size())
    throw vp::InputError(
        "no point has a value of the study's objectives (" +
        vp::join(results.manifest.objectives, ", ") +
        "): give --objective 'max summary.fps.mean' or another; sweep.csv shows what there is");
  return objectives;
}

/// The values of a run: {name: value}, or a table of those whose names have `part` in them.
std::string values_text(const MetricsOptions& options) {
  const result::Metrics metrics = study::read_comparable(*options.run).metrics;
  study::Json json = study::Json::object();
  result::TextTable table({"metric", "value", "unit"});
  for (std::size_t i = 0; i < metrics.names().size(); ++i) {
    const std::string& name = metrics.names()[i];
    if (name.find(options.part) == std::string::npos) continue;
    json[name] = metrics.values()[i];
    table.add({name, result::readable(metrics.values()[i]), result::unit_of_metric(name)});
  }
  if (json.empty()) {
    result::check_metric(options.part, {});
    throw vp::InputError("'" + *options.run + "' has no metric '" + options.part + "'");
  }
  return options.json ? json.dump() + "\n" : table.text();
}

/// The table of figures, or those that have `part` in their paths.
std::string table_json(const std::string& part) {
  study::Json chosen = study::Json::array();
  for (const study::Json& figure : result::figures_json()) {
    if (figure["path"].get_ref<const std::string&>().find(part) != std::string::npos)
      chosen.push_back(figure);
  }
  if (chosen.empty()) result::check_metric(part, {});
  return chosen.dump() + "\n";
}

}  // namespace

int list_metrics(const MetricsOptions& options, std::ostream& out) {
  if (options.run) {
    out << values_text(options);
    return done;
  }
  if (options.design) {
    vp::Configuration configuration;
    configuration.set("design", *options.design, "--design");
    SimulationOptions shown;
    shown.is_only_shown = true;
    build(configuration, shown);
  }
  if (options.json || options.markdown) {
    out << (options.json ? table_json(options.part) : result::metric_markdown());
    return done;
  }
  out << result::metric_table(options.part);
  if (options.part.empty())
    out << "\n* is any name; sweep.csv has them all. Constraints, objectives and figures may "
           "calculate with metrics and\nparameters (docs/expressions.md).\n";
  return done;
}

int find_pareto(const ParetoOptions& options, std::ostream& out, std::ostream& err) {
  std::vector<study::Objective> objectives;
  std::vector<vp::Expression> constraints, figures;
  for (const std::string& text : options.constraints)
    constraints.emplace_back(text, "--constraint");
  figures = constraints;
  for (const std::string& text : options.objectives) {
    objectives.emplace_back(text, "--objective");
    figures.push_back(objectives.back().figure());
  }
  study::Results results = results_of(options.folder, figures, err);
  for (vp::Expression& constraint : constraints)
    results.constraints.push_back(std::move(constraint));
  if (objectives.empty()) objectives = known_objectives(results);
  for (const study::Objective& objective : objectives)
    study::check_names(results, objective.figure());
  for (const vp::Expression& constraint : results.constraints)
    study::check_names(results, constraint);
  study::Pareto pareto = study::rank(results, objectives);
  study::judge_by_bands(pareto, objectives);
  study::find_better(pareto, objectives);
  const auto is_best = [](const study::RankedPoint& point) { return point.front == 1; };
  if (std::none_of(pareto.points.begin(), pareto.points.end(), is_best))
    throw vp::InputError(study::why_no_point(results));
  const std::string csv = (std::filesystem::path(options.folder) / "pareto.csv").string();
  study::write_pareto_csv(csv, results, objectives, pareto);
  out << study::pareto_table(results, objectives, pareto);
  out << "\n" << study::verdicts_text(results) << "\n";
  const std::string doubt = study::doubt_text(pareto);
  if (!doubt.empty()) out << doubt << "\n";
  for (const auto& [metric, count] : pareto.lacking)
    out << "\nleft out: " << result::counted(count, "point") << " without '" << metric << "'\n";
  out << "\nwrote " << csv << std::endl;
  return done;
}

int find_sensitivity(const SensitivityOptions& options, std::ostream& out, std::ostream& err) {
  if (options.folder.empty() != options.at.has_value())
    throw vp::InputError(
        "sensitivity: name the folder of a sweep, or one of its points with --at out/NAME:KEY");
  if (options.at) return find_step_effects(options, out, err);
  std::vector<vp::Expression> figures;
  for (const std::string& text : options.figures) figures.emplace_back(text, "--figure");
  const study::Results results = results_of(options.folder, figures, err);
  if (figures.empty()) {
    for (const study::Objective& objective : known_objectives(results))
      figures.push_back(objective.figure());
  }
  std::string csv;
  for (const vp::Expression& figure : figures) {
    const study::SensitivityReport report = study::sensitivity(results, figure, options.all);
    out << vp::visible(figure.text()) << "   (" << report.basis << ")\n\n"
        << study::sensitivity_table(report) << "\n";
    if (!report.not_compared.empty())
      err << "markervp: warning: " << vp::visible(study::not_compared_text(report)) << std::endl;
    if (report.skipped != 0)
      err << "markervp: warning: "
          << result::counted(report.skipped, report.method == "all else equal" ? "point" : "effect")
          << " left out of '" << vp::visible(figure.text()) << "': a point failed, is missing, "
          << (options.all ? "" : "is not feasible (--all takes those) ") << "or has no value of it"
          << std::endl;
    const std::string lines = study::sensitivity_csv(figure.text(), report);
    csv += csv.empty() ? lines : lines.substr(lines.find('\n') + 1);
  }
  const std::string file = (std::filesystem::path(options.folder) / "sensitivity.csv").string();
  vp::write_file_durably(file, csv);
  out << "wrote " << file << std::endl;
  return done;
}

namespace {

/// A point of a sweep is run again for that, apart, if its whole result is not kept.
study::Comparable comparable_of(const std::string& name, std::ostream& err) {
  std::error_code ignored;
  if (std::filesystem::exists(name, ignored) || !study::names_point(name))
    return study::read_comparable(name);
  const study::NamedPoint point = study::named_point(name);
  if (point.failed) throw vp::InputError("'" + name + "' is a point that failed: " + point.message);
  if (!point.kept.is_null()) return study::comparable(name, point.kept, point.configuration);
  warn_of_version(point, err);
  const study::Json made = made_apart([&](std::ostream& said) {
    study::RunResult result;
    if (run_point(point.asked.setup, result, said) != done)
      throw vp::InputError("'" + name + "' fails when it is run again");
    return study::Json{{"result", std::move(result.result)},
                       {"configuration", result.configuration}};
  });
  return study::comparable(name, made.at("result"),
                           made.at("configuration").get<std::map<std::string, std::string>>());
}

}  // namespace

int compare_runs(const CompareOptions& options, std::ostream& out, std::ostream& err) {
  const study::Comparable first = comparable_of(options.first, err);
  out << study::compare(first, comparable_of(options.second, err));
  return done;
}

int make_report(const ReportOptions& options, std::ostream& out, std::ostream& err) {
  if (page::page_template().empty()) {
    throw vp::InputError(
        "this markervp was built without report.html: build it again with Node.js and npm "
        "(Debian: nodejs npm)");
  }
  std::string file;
  if (options.folders.size() == 1) {
    if (options.output) {
      throw vp::InputError("--output is for a comparison: the page of one folder is in it");
    }
    const std::string& folder = options.folders[0];
    std::error_code ignored;
    if (std::filesystem::exists(std::filesystem::path(folder) / "manifest.json", ignored)) {
      const study::Store store(folder);
      study::Manifest manifest = store.read_manifest();
      const auto shards = shards_of(store, manifest, err);
      const study::Results results =
          study::read_results(shards, std::move(manifest), study::page_figures());
      study::write_page(results, folder, page_extras(results));
    } else {
      page::write_report(folder);
    }
    file = (std::filesystem::path(options.folders[0]) / "report.html").string();
  } else {
    file = options.output.value_or("compare.html");
    page::write_comparison(options.folders[0], options.folders[1], file);
  }
  out << "wrote " << file << std::endl;
  return done;
}

}  // namespace platform::cli
