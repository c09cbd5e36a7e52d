#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <host/process.h>
#include <study/inputs.h>
#include <study/spec.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>
#include <vp/unit.h>
#include <vp/yaml.h>

namespace platform::study {

namespace {

constexpr const char* inputs_axis = "inputs";

/// "summary.fps.mean >= 200", in parts.
struct Bound {
  std::string name, comparison;
  double number;
};

std::optional<Bound> bound_of(const std::string& text) {
  static const std::regex form(R"(\s*`?([\w.]+)`?\s*(<=|>=|<|>|==)\s*([-+.\deE]+)\s*)");
  std::smatch parts;
  if (!std::regex_match(text, parts, form)) return std::nullopt;
  return Bound{parts[1], parts[2], std::strtod(parts[3].str().c_str(), nullptr)};
}

/// Whether no number is within both.
bool contradict(const Bound& a, const Bound& b) {
  if (a.comparison[0] == '>' && b.comparison[0] != '>') return contradict(b, a);
  if (a.comparison == "==" && b.comparison == "==") return a.number != b.number;
  const bool both = a.comparison.size() == 2 && b.comparison.size() == 2;  // ends included
  const auto is_above = [&](double most, double least) {
    return both ? least > most : least >= most;
  };
  if (a.comparison[0] == '<' && b.comparison[0] != '<') return is_above(a.number, b.number);
  if (a.comparison == "==")
    return b.comparison[0] == '<' ? is_above(b.number, a.number) : is_above(a.number, b.number);
  return b.comparison == "==" && is_above(a.number, b.number);
}

/// Throws vp::InputError for two constraints that no point can meet.
void check_bounds(const std::vector<Condition>& constraints) {
  std::map<std::string, std::vector<std::pair<Bound, std::string>>> bounds;
  for (const Condition& constraint : constraints) {
    const std::optional<Bound> bound = bound_of(constraint.text);
    if (!bound) continue;
    for (const auto& [other, text] : bounds[bound->name]) {
      if (contradict(*bound, other))
        throw vp::InputError(constraint.where + ": '" + text + "' and '" + constraint.text +
                             "' contradict each other: no point can do both; leave out one");
    }
    bounds[bound->name].emplace_back(*bound, constraint.text);
  }
}

class Reader : private vp::YamlReader {
 public:
  Reader(Spec& spec, const std::string& origin) : YamlReader(origin), spec_(spec) {}

  void read(const YAML::Node& root) {
    if (!root.IsMap()) fail(root, "expected 'key: value' lines");
    Keys keys{
        {"title", [&](const YAML::Node& n) { spec_.title = scalar(n, "title"); }},
        {"text", [&](const YAML::Node& n) { spec_.text = scalar(n, "text"); }},
        {"inputs",
         [&](const YAML::Node& n) {
           for (std::string& input : scalars(n, "inputs")) spec_.inputs.push_back(std::move(input));
         }},
        {"system", [&](const YAML::Node& n) { read_program(n, "system"); }},
        {"program", [&](const YAML::Node& n) { read_program(n, "program"); }},
        {"frames", [&](const YAML::Node& n) { spec_.frames = whole(n, "frames", 1, most_frames); }},
        {"repeat", [&](const YAML::Node& n) { spec_.repeat = whole(n, "repeat", 1, most_frames); }},
        {"design", [&](const YAML::Node& n) { set("design", scalar(n, "design"), n); }},
        {"device", [&](const YAML::Node& n) { set("device", scalar(n, "device"), n); }},
        {"fidelity", [&](const YAML::Node& n) { set("fidelity", scalar(n, "fidelity"), n); }},
        {"set", [&](const YAML::Node& n) { read_set(n, ""); }},
        {"parameters", [&](const YAML::Node& n) { read_parameters(n); }},
        {"zip", [&](const YAML::Node& n) { read_zip(n); }},
        {"sample", [&](const YAML::Node& n) { read_sampling(n); }},
        {"search", [&](const YAML::Node& n) { read_search(n); }},
        {"constraints", [&](const YAML::Node& n) { read_constraints(n); }},
        {"job",
         [&](const YAML::Node& n) {
           spec_.job = {scalar(n, "job"), where(n)};
         }},
        {"target_rate", [&](const YAML::Node& n) { read_rate(n); }},
        {"metrics", [&](const YAML::Node& n) { spec_.metrics = scalars(n, "metrics"); }},
        {"objectives", [&](const YAML::Node& n) { spec_.objectives = scalars(n, "objectives"); }}};
    for (const InputKind* kind : input_kinds()) add_keys(*kind, keys);
    refuse_controls(root, "");
    for (const auto& entry : root) refuse_parameter(entry.first);
    for_each(root, keys, "a sweep");
    check_bounds(spec_.constraints);
  }

 private:
  static constexpr std::uint64_t most_frames = 1'000'000;
  static constexpr std::uint64_t most_points = 10'000'000;
  static constexpr double most_rate = 1e6;
  static constexpr std::uint64_t most_seed = 1'000'000'000'000;

  /// A text of the study reaches terminals and files: none of it may command them.
  void refuse_controls(const YAML::Node& node, const std::string& key) {
    if (node.IsScalar()) {
      const std::string text(vp::trim(node.Scalar()));
      const std::string shown = key == "title" ? vp::visible(text) : vp::visible_lines(text);
      if (shown != text)
        fail(node, "'" + vp::excerpt(shown) + "' for '" + key +
                       "' has a control character: write it without");
    }
    for (const auto& entry : node) {
      if (node.IsSequence()) {
        refuse_controls(entry, key);
      } else if (node.IsMap() && entry.first.IsScalar()) {
        refuse_controls(entry.first, key.empty() ? "key" : key);
        refuse_controls(entry.second, entry.first.Scalar());
      }
    }
  }

  /// A key with a dot is a path of the configuration.
  void refuse_parameter(const YAML::Node& key) {
    if (key.IsScalar() && key.Scalar().find('.') != std::string::npos)
      fail(key, "'" + key.Scalar() +
                    "' is a parameter: write it under 'set', or with its values under "
                    "'parameters'");
  }

  void read_program(const YAML::Node& node, const std::string& key) {
    if (!spec_.program.empty()) fail(node, "'system' and 'program' both name the PS program");
    spec_.program = scalar(node, key);
  }

  void set(const std::string& path, const std::string& value, const YAML::Node& node) {
    if (spec_.set_where.empty()) spec_.set_where = where(node);
    if (!spec_.set.emplace(path, value).second) fail(node, "'" + path + "' is set twice");
  }

  void read_set(const YAML::Node& node, const std::string& prefix) {
    if (!node.IsMap()) fail(node, "'set' is 'path: value' lines");
    for (const auto& entry : node) {
      const std::string path = prefix + scalar(entry.first, "set");
      if (entry.second.IsMap()) {
        read_set(entry.second, path + ".");
      } else {
        set(path, scalar(entry.second, path), entry.first);
      }
    }
  }

  void check_new(const std::string& path, const YAML::Node& node) {
    if (!swept_.insert(path).second) fail(node, "'" + path + "' is swept twice");
  }

  void read_parameters(const YAML::Node& node) {
    if (!node.IsMap()) fail(node, "'parameters' is 'path: values' lines");
    for (const auto& entry : node) {
      spec_.dimensions.push_back({{axis(entry.first, entry.second)}});
    }
  }

  void read_zip(const YAML::Node& node) {
    if (!node.IsSequence()) fail(node, "'zip' is a list of groups of 'path: values' lines");
    for (const YAML::Node& group : node) {
      if (!group.IsMap() || group.size() == 0)
        fail(group, "a group of 'zip' is 'path: values' lines");
      Dimension dimension;
      for (const auto& entry : group) dimension.axes.push_back(axis(entry.first, entry.second));
      spec_.dimensions.push_back(std::move(dimension));
    }
  }

  Axis axis(const YAML::Node& key, const YAML::Node& node) {
    Axis result;
    result.path = scalar(key, "parameters");
    result.where = where(key);
    check_new(result.path, key);
    if (result.path == inputs_axis) {
      read_input_sets(node, result);
    } else if (node.IsMap()) {
      result.range = range(node, result.path);
    } else if (node.IsSequence() && node.size() == 0) {
      fail(key, "'" + result.path + "' has no values");
    } else {
      result.values = scalars(node, result.path);
    }
    return result;
  }

  void add_inputs(Axis& axis, const std::string& label, const std::vector<std::string>& inputs) {
    axis.values.push_back(label);
    spec_.input_sets[label] = inputs;
  }

  void read_input_sets(const YAML::Node& node, Axis& axis) {
    if (node.IsMap()) {
      for (const auto& entry : node) {
        const std::string label = scalar(entry.first, inputs_axis);
        add_inputs(axis, label, scalars(entry.second, label));
      }
      return;
    }
    if (!node.IsSequence() || node.size() == 0) {
      fail(node, "'inputs' under parameters is a list of inputs, or 'name: [inputs]' lines");
    }
    for (const YAML::Node& item : node) {
      const std::vector<std::string> inputs = scalars(item, inputs_axis);
      add_inputs(axis, vp::join(inputs, "+"), inputs);
    }
  }

  ValueRange range(const YAML::Node& node, const std::string& path) {
    ValueRange range;
    const Keys keys{{"start", [&](const YAML::Node& n) { range.start = scalar(n, "start"); }},
                    {"stop", [&](const YAML::Node& n) { range.stop = scalar(n, "stop"); }},
                    {"step", [&](const YAML::Node& n) { range.step = scalar(n, "step"); }},
                    {"count",
                     [&](const YAML::Node& n) {
                       range.count = static_cast<std::uint32_t>(whole(n, "count", 1, most_points));
                     }},
                    {"scale", [&](const YAML::Node& n) {
                       range.logarithmic = choice(n, "scale", {"linear", "log"}) == "log";
                     }}};
    for_each(node, keys, "the range of '" + path + "'");
    if (range.start.empty() || range.stop.empty())
      fail(node, "the range of '" + path + "' needs 'start' and 'stop'");
    if (range.step && range.count)
      fail(node, "the range of '" + path + "' has 'step' and 'count': leave out one");
    if (range.step && range.logarithmic)
      fail(node, "the range of '" + path + "' is logarithmic: give 'count' instead of 'step'");
    return range;
  }

  void read_sampling(const YAML::Node& node) {
    Sampling& sampling = spec_.sampling;
    sampling.where = where(node);
    bool has_points = false;
    using Method = Sampling::Method;
    const std::map<std::string, Method> methods{{"random", Method::random},
                                                {"sobol", Method::sobol},
                                                {"morris", Method::morris},
                                                {"one-at-a-time", Method::one_at_a_time}};
    const Keys keys{
        {"method",
         [&](const YAML::Node& n) {
           sampling.method =
               methods.at(choice(n, "method", {"random", "sobol", "morris", "one-at-a-time"}));
         }},
        {"points",
         [&](const YAML::Node& n) {
           sampling.points = whole(n, "points", 1, most_points);
           has_points = true;
         }},
        {"seed", [&](const YAML::Node& n) { sampling.seed = whole(n, "seed", 0, most_seed); }},
        {"trajectories",
         [&](const YAML::Node& n) {
           sampling.trajectories = static_cast<std::uint32_t>(whole(n, "trajectories", 2, 10'000));
         }},
        {"levels", [&](const YAML::Node& n) {
           sampling.levels = static_cast<std::uint32_t>(whole(n, "levels", 2, 1000));
           if (sampling.levels % 2 != 0) fail(n, "'levels' of Morris' method is an even number");
         }}};
    for_each(node, keys, "'sample'");
    if (sampling.method == Method::grid) fail(node, "'sample' needs 'method'");
    const bool counted = sampling.method == Method::random || sampling.method == Method::sobol;
    if (counted != has_points)
      fail(node, counted ? "'sample' needs 'points'" : "this method takes no 'points'");
  }

  /// What a kind of input may be asked for in a file.
  void add_keys(const InputKind& kind, Keys& keys) {
    for (const InputSetting& setting : kind.settings) {
      const std::string name = setting.name;
      const std::vector<std::string> choices = vp::split(setting.value, '|');
      keys.emplace(name, [this, name, choices](const YAML::Node& n) {
        spec_.input_settings[name] =
            choices.size() > 1 ? choice(n, name, choices) : scalar(n, name);
      });
    }
    if (kind.key) keys.emplace(kind.key, [&](const YAML::Node& n) { read_lists(n, kind); });
  }

  void read_lists(const YAML::Node& node, const InputKind& kind) {
    const std::string key = kind.key;
    if (!node.IsMap() || node.size() == 0)
      fail(node, "'" + key + "' is 'condition: values' lines: 'noise: [0.01, 0.03]'");
    InputKind::Lists lists;
    for (const auto& entry : node) {
      const std::string name = scalar(entry.first, key);
      lists.emplace_back(name, scalars(entry.second, name));
    }
    try {
      for (std::string& input : kind.expand(lists)) spec_.inputs.push_back(std::move(input));
    } catch (const vp::InputError& error) {
      fail(node, error.what());
    }
  }

  void read_search(const YAML::Node& node) {
    SearchChoice& search = spec_.search;
    search.where = where(node);
    const auto number = [&](const YAML::Node& n, const char* name, std::uint64_t most) {
      return static_cast<std::uint32_t>(whole(n, name, 2, most));
    };
    const Keys keys{
        {"points",
         [&](const YAML::Node& n) { search.points = whole(n, "points", 2, most_points); }},
        {"generation",
         [&](const YAML::Node& n) { search.generation = number(n, "generation", 10'000); }},
        {"patience", [&](const YAML::Node& n) { search.patience = number(n, "patience", 10'000); }},
        {"seed", [&](const YAML::Node& n) { search.seed = whole(n, "seed", 0, most_seed); }},
        {"time", [&](const YAML::Node& n) { search.time = scalar(n, "time"); }}};
    for_each(node, keys, "'search'");
  }

  void read_constraints(const YAML::Node& node) {
    if (node.IsScalar()) {
      spec_.constraints.push_back({node.Scalar(), where(node)});
      return;
    }
    if (!node.IsSequence()) fail(node, "'constraints' is a list of conditions");
    for (const YAML::Node& item : node) {
      spec_.constraints.push_back({scalar(item, "constraints"), where(item)});
    }
  }

  /// "60 fps": what a point must reach.
  void read_rate(const YAML::Node& node) {
    const std::string text = scalar(node, "target_rate");
    const std::size_t unit = text.find("fps");
    const std::string number(vp::trim(text.substr(0, unit)));
    double rate = 0;
    try {
      rate = vp::parse_quantity(number, vp::Unit::none).to_double();
    } catch (const vp::InputError&) {  // told below, with what else is wrong
    }
    if (unit == std::string::npos || unit + 3 != text.size() || !(rate > 0) || rate > most_rate)
      fail(node,
           "'" + text +
               "' for 'target_rate': write frames a second from above 0 to 1000000, as '60 fps'");
    spec_.constraints.push_back({"summary.fps.mean >= " + number, where(node)});
  }

  Spec& spec_;
  std::set<std::string> swept_;
};

}  // namespace

Spec parse_spec(const std::string& text, const std::string& origin) {
  Spec spec;
  spec.origin = origin;
  spec.source = text;
  spec.name = std::filesystem::path(origin).stem().string();
  Reader(spec, origin).read(vp::load_yaml(text, origin));
  return spec;
}

Spec read_spec(const std::string& file) {
  return parse_spec(vp::read_text(file, "sweep"), file);
}

namespace fs = std::filesystem;

std::vector<Study> studies() {
  std::vector<Study> found;
  std::error_code ignored;
  for (const std::string& folder : host::library_folders()) {
    for (const auto& entry : fs::directory_iterator(fs::path(folder) / "studies", ignored)) {
      if (entry.path().extension() != ".yaml") continue;
      const Spec spec = read_spec(entry.path().string());
      found.push_back({spec.name, spec.title, entry.path().string()});
    }
    if (!found.empty()) break;
  }
  std::sort(found.begin(), found.end(),
            [](const Study& a, const Study& b) { return a.name < b.name; });
  return found;
}

std::string sweep_file(const std::string& name) {
  std::error_code ignored;
  if (fs::exists(name, ignored)) return name;
  std::vector<std::string> names;
  for (const Study& study : studies()) {
    if (study.name == name) return study.file;
    names.push_back(study.name);
  }
  const std::string nearest = vp::nearest_match(name, names);
  throw vp::InputError("no sweep '" + name +
                       "': " + (nearest.empty() ? "" : "did you mean '" + nearest + "'? ") +
                       "name a YAML file, or a study that 'markervp sweep --list' shows");
}

const char* to_string(Sampling::Method method) {
  switch (method) {
    case Sampling::Method::grid:
      return "grid";
    case Sampling::Method::random:
      return "random";
    case Sampling::Method::sobol:
      return "sobol";
    case Sampling::Method::morris:
      return "morris";
    case Sampling::Method::one_at_a_time:
      return "one-at-a-time";
  }
  return "";
}

}  // namespace platform::study
