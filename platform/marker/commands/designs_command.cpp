#include <chip/system/designs.h>
#include <cli/commands.h>
#include <cli/sweep_command.h>
#include <facts/summary.h>
#include <fmt/format.h>
#include <marker/commands/commands.h>
#include <result/result_json.h>
#include <vp/error.h>
#include <vp/text.h>
#include <CLI/CLI.hpp>

#include <memory>
#include <optional>
#include <ostream>

namespace platform::commands {

using namespace cli;

namespace {

using result::Json;

/// `markervp designs --figures`.
struct FigureOptions {
  std::vector<std::string> inputs;  ///< none: the 41 poses of the thesis
  bool figures = false;             ///< what each one reaches and takes
  bool changes = false;             ///< the same for each step from thesis to improved
  bool json = false;
};

/// A design, or what is left of one where a change is taken back.
struct Variant {
  std::string name, what, design;
  std::vector<std::string> settings;
};

/// The way from the thesis' design to `improved`: each line has all changes of those before it.
std::vector<Variant> changes() {
  const std::string clock = "ps.fclk_clk0.frequency=50 MHz", peaks = "pl.threshold_rule=global",
                    serial = "sw.overlap=0";
  return {{"thesis", "", "thesis", {}},
          {"+ logic and program",
           "blobs that merge, DMA, corners of lines in grey, IPPE; 50 MHz",
           "improved",
           {clock, peaks, serial}},
          {"+ 100 MHz", "one pixel a clock of the faster logic", "improved", {peaks, serial}},
          {"+ overlap", "the logic is one frame ahead", "improved", {peaks}},
          {"+ Otsu: improved", "threshold by least variance", "improved", {}}};
}

std::vector<Variant> all_designs() {
  std::vector<Variant> variants;
  for (const DesignInfo* design : builtin_designs())
    variants.push_back({design->name, design->description, design->name, {}});
  return variants;
}

/// Mean over the markers whose truth is known.
std::optional<double> mean_error(const Json& result, const char* name) {
  facts::Statistic errors;
  for (const Json& frame : result.at("frames")) {
    for (const Json& marker : frame.at("markers")) {
      if (marker.contains("error") && marker.at("error").contains(name))
        errors.add(marker.at("error").at(name).get<double>());
    }
  }
  if (errors.count() == 0) return std::nullopt;
  return errors.mean();
}

/// In another unit: times `factor`.
std::optional<double> number_at(const Json& json, const char* pointer, double factor = 1) {
  const Json::json_pointer place(pointer);
  if (!json.contains(place)) return std::nullopt;
  return factor * json.at(place).get<double>();
}

struct DesignFigure {
  const char *title, *key;
  int decimals;
  std::optional<double> (*value)(const Json& result);
};

constexpr DesignFigure design_figures[] = {
    {"found", "found", 0, [](const Json& r) { return number_at(r, "/summary/detected"); }},
    {"px", "corner_px", 4, [](const Json& r) { return mean_error(r, "corner_px"); }},
    {"mm", "translation_mm", 2, [](const Json& r) { return mean_error(r, "translation_mm"); }},
    {"deg", "rotation_deg", 3, [](const Json& r) { return mean_error(r, "rotation_deg"); }},
    {"FPS", "fps", 1, [](const Json& r) { return number_at(r, "/summary/fps/mean"); }},
    {"ms", "latency_ms", 2,
     [](const Json& r) { return number_at(r, "/summary/latency_us/mean", 1e-3); }},
    {"LUT", "lut", 0, [](const Json& r) { return number_at(r, "/resources/total/lut"); }},
    {"FF", "ff", 0, [](const Json& r) { return number_at(r, "/resources/total/ff"); }},
    {"BRAM36", "bram36", 1, [](const Json& r) { return number_at(r, "/resources/total/bram36"); }},
    {"mW", "power_mw", 0,
     [](const Json& r) { return number_at(r, "/power/total_w/nominal", 1e3); }},
    {"mJ", "energy_mj", 2,
     [](const Json& r) { return number_at(r, "/summary/energy_per_frame_mj"); }}};

/// Runs it apart on the inputs.
Json result_of(const Variant& variant, const std::vector<std::string>& inputs) {
  RunOptions run;
  run.inputs = inputs;
  run.configuration.assignments = {"profile=a9-O2", "power.mode=activity"};
  run.configuration.assignments.insert(run.configuration.assignments.end(),
                                       variant.settings.begin(), variant.settings.end());
  run.configuration.design = variant.design;
  return made_apart([&](std::ostream& err) {
    MemoryRun result;
    return run_in_memory(run, result, err) == done ? result.result.take() : Json();
  });
}

void show_figures(const FigureOptions& options, std::ostream& out) {
  const std::vector<std::string> inputs =
      options.inputs.empty() ? std::vector<std::string>{"x", "y", "z", "pitch", "yaw", "roll"}
                             : options.inputs;
  Json list = Json::array();
  std::string text = fmt::format("{:<20}", "");
  for (const DesignFigure& figure : design_figures) text += fmt::format("{:>8}", figure.title);
  std::size_t frames = 0;
  for (const Variant& variant : options.changes ? changes() : all_designs()) {
    const Json result = result_of(variant, inputs);
    frames = result.at("frames").size();
    Json entry{{"name", variant.name}, {"design", variant.design}, {"settings", variant.settings}};
    text += fmt::format("\n{:<20}", variant.name);
    for (const DesignFigure& figure : design_figures) {
      const std::optional<double> value = figure.value(result);
      text += fmt::format("{:>8}", value ? vp::format_fixed(*value, figure.decimals) : "");
      if (value) entry[figure.key] = *value;
    }
    list.push_back(entry);
  }
  if (options.json) {
    out << list.dump(2) << "\n";
    return;
  }
  out << text << "\n\n";
  if (options.changes) {
    for (const Variant& variant : changes()) {
      if (!variant.what.empty()) out << fmt::format("{:<20}  {}\n", variant.name, variant.what);
    }
  }
  out << "Means over " << frames
      << " images, errors over the markers found; software of -O2 (profile a9-O2), power by "
         "activity.\n";
}

}  // namespace

cli::Command add_design_figures(CLI::App& parser) {
  const auto options = std::make_shared<FigureOptions>();
  FigureOptions& target = *options;
  CLI::App* command = parser.get_subcommand("designs");
  command
      ->add_option("INPUT", target.inputs,
                   "what figures are measured with (default: the 41 poses of chapter 5)")
      ->type_name("");
  command->add_flag("--figures", target.figures, "run each, show rate, errors, resources, power");
  command->add_flag("--changes", target.changes,
                    "the same for each change from thesis to improved");
  const CLI::Option* json = command->get_option("--json");
  return {"designs",
          [options, json](const std::vector<std::string>&, std::ostream& out, std::ostream&) {
            options->json = json->count() > 0;
            if (!options->figures && !options->changes) {
              if (!options->inputs.empty())
                throw vp::InputError("designs: inputs are for --figures and --changes");
              return list_designs({options->json}, out);
            }
            show_figures(*options, out);
            return int{done};
          }};
}

}  // namespace platform::commands
