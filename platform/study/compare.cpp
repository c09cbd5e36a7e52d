#include <study/compare.h>

#include <cmath>
#include <filesystem>
#include <set>

#include <host/document.h>
#include <result/figures.h>
#include <result/table.h>
#include <study/kept_result.h>
#include <study/report.h>
#include <vp/error.h>
#include <vp/text.h>

namespace platform::study {

namespace {

namespace fs = std::filesystem;

void add_facts(const Json& result, Comparable& run) {
  for (const char* fact : {"system", "design", "profile"}) {
    if (result.contains(fact) && result[fact].is_string())
      run.configuration[fact] = result[fact].get<std::string>();
  }
  std::set<std::string> inputs;
  for (const Json& frame : result.value("frames", Json::array()))
    inputs.insert(frame.value("input", ""));
  std::string text;
  for (const std::string& input : inputs) text += (text.empty() ? "" : " ") + input;
  run.configuration["inputs"] = text;
  result::declare(result.value("figures", Json::array()));
  run.metrics = result::metrics_of(result);
}

std::string change(double a, double b) {
  if (a == 0) return "";
  const double percent = 100 * (b - a) / std::fabs(a);
  return (percent > 0 ? "+" : "") + vp::format_fixed(percent, 2) + " %";
}

/// Whether B is better, as the figure is declared.
std::string judged(const std::string& metric, double a, double b) {
  const facts::Figure* figure = result::figures().of(metric);
  if (!figure || figure->better == facts::Better::neither) return "";
  return (b > a) == (figure->better == facts::Better::more) ? "better" : "worse";
}

using Values = std::map<std::string, std::string>;

std::set<std::string> keys(const Values& a, const Values& b) {
  std::set<std::string> result;
  for (const auto& [key, value] : a) result.insert(key);
  for (const auto& [key, value] : b) result.insert(key);
  return result;
}

std::set<std::string> names(const result::Metrics& a, const result::Metrics& b) {
  std::set<std::string> result(a.names().begin(), a.names().end());
  result.insert(b.names().begin(), b.names().end());
  return result;
}

}  // namespace

Comparable read_comparable(const std::string& path) {
  std::error_code ignored;
  const std::string file =
      fs::is_directory(path, ignored) ? (fs::path(path) / "result.json").string() : path;
  const Json json = host::read_json<Json>(file, "result", host::largest_result);
  Comparable run;
  run.name = path;
  try {
    if (json.is_object() && json.contains("markervp_point")) {
      const KeptResult kept = read_kept(file);
      if (kept.outcome.failed)
        throw vp::InputError("'" + file +
                             "' is a point that failed: " + kept.outcome.failure.message);
      run.configuration =
          kept.identity_json().at("configuration").get<std::map<std::string, std::string>>();
      add_facts(kept.result, run);
      return run;
    }
    if (!json.is_object() || !json.contains("summary") || !json.contains("configuration"))
      throw vp::InputError(
          "'" + file +
          "' is neither a result.json nor a point of a sweep: name one of them, or "
          "the folder of a run");
    run.configuration = json["configuration"].get<std::map<std::string, std::string>>();
    add_facts(json, run);
  } catch (const Json::exception&) {
    throw vp::InputError("'" + file + "' was changed or is damaged: run it again");
  }
  return run;
}

Comparable comparable(const std::string& name, const Json& result,
                      std::map<std::string, std::string> configuration) {
  Comparable run;
  run.name = name;
  run.configuration = std::move(configuration);
  add_facts(result, run);
  return run;
}

std::string compare(const Comparable& a, const Comparable& b) {
  result::TextTable configuration({"configuration", "A", "B"});
  std::size_t settings = 0;
  for (const std::string& path : keys(a.configuration, b.configuration)) {
    const auto left = a.configuration.find(path);
    const auto right = b.configuration.find(path);
    const std::string x = left == a.configuration.end() ? "-" : left->second;
    const std::string y = right == b.configuration.end() ? "-" : right->second;
    if (x == y) continue;
    configuration.add({path, x, y});
    ++settings;
  }
  result::TextTable metrics({"metric", "unit", "A", "B", "change", ""});
  std::size_t figures = 0;
  for (const std::string& name : names(a.metrics, b.metrics)) {
    const double* left = a.metrics.find(name);
    const double* right = b.metrics.find(name);
    const bool both = left && right;
    if (both && *left == *right) continue;
    metrics.add({name, result::unit_of_metric(name), left ? result::readable(*left) : "-",
                 right ? result::readable(*right) : "-", both ? change(*left, *right) : "",
                 both ? judged(name, *left, *right) : ""});
    ++figures;
  }
  std::string text = "A  " + a.name + "\nB  " + b.name + "\n\n";
  text += settings == 0 ? "configuration: the same\n" : configuration.text();
  text += "\n" + (figures == 0 ? std::string("metrics: the same\n") : metrics.text());
  return text;
}

}  // namespace platform::study
