#include <algorithm>
#include <cmath>
#include <future>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <unordered_map>
#include <vector>

#include <result/figures.h>
#include <study/axis_check.h>
#include <study/contents.h>
#include <study/expansion.h>
#include <study/inputs.h>
#include <study/manifest.h>
#include <study/pareto.h>
#include <study/plan.h>
#include <vp/error.h>
#include <vp/expression.h>
#include <vp/text.h>

namespace platform::study {

namespace {

/// Gives points of the manifest's families their keys. Of many points that is most of the planning,
/// so each processor takes its share.
void find_keys(const Manifest& manifest, std::vector<Point>& points) {
  constexpr std::size_t share_worth_a_thread = 1000;
  const std::size_t shares =
      std::max<std::size_t>(1, std::min<std::size_t>(std::thread::hardware_concurrency(),
                                                     points.size() / share_worth_a_thread));
  std::vector<std::future<void>> running;
  for (std::size_t share = 0; share < shares; ++share) {
    const auto find = [&, from = points.size() * share / shares,
                       to = points.size() * (share + 1) / shares] {
      Identities identities(manifest);
      for (std::size_t i = from; i < to; ++i) points[i].key = key_of(identities.of(points[i]));
    };
    running.push_back(
        std::async(share + 1 == shares ? std::launch::deferred : std::launch::async, find));
  }
  for (std::future<void>& found : running) found.get();
}

bool is_program(const std::string& path) {
  return path == "system" || path == "program";
}

/// Points whose families are built together: of each, all parameters are in memory.
constexpr std::size_t most_ahead = 256;

/// Not a parameter of the platform, but of the run.
bool is_special(const std::string& path) {
  return is_program(path) || path == "inputs";
}

}  // namespace

class Planner {
 public:
  Planner(const Spec& spec, const PlanOptions& options, const Platform& platform)
      : spec_(spec), options_(options), platform_(platform) {}

  Manifest plan() {
    const double count = prepare();
    Expansion expansion = expand(
        spec_, groups_, [this](const Assignment& point) { return allowed(point); },
        options_.limit.value_or(static_cast<std::uint64_t>(most_points)));
    describe(static_cast<double>(expansion.points.size()) < count);
    add_points(std::move(expansion));
    return std::move(manifest_);
  }

 private:
  friend class Space;

  /// Everything but the points; returns how many there may be.
  double prepare() {
    if (spec_.dimensions.empty())
      throw vp::InputError(spec_.origin +
                           ": the sweep varies nothing: say what under 'parameters' (also 'inputs' "
                           "and 'system', to compare them) or under 'zip'");
    find_programs();
    check_metrics();
    make_axes();
    const double count = point_count(spec_, groups_);
    ask_about(count);
    for (const AxisGroup& group : groups_) {
      for (const AxisValues& axis : group) check(axis);
    }
    sort_constraints();
    return count;
  }

  void check_metrics() const {
    if (spec_.job) check_names(vp::Expression(spec_.job->text, spec_.job->where));
    for (const std::string& metric : spec_.metrics) {
      try {
        result::check_metric(metric, parameters());
      } catch (const vp::InputError& error) {
        throw vp::InputError(spec_.origin + ": metrics: " + error.what());
      }
    }
    for (const std::string& text : spec_.objectives)
      check_figure(Objective(text, spec_.origin + ": objectives").figure());
  }

  void check_figure(const vp::Expression& figure) const {
    check_names(figure);
    const vp::ExpressionValue value =
        figure.value([&](const std::string& name) -> vp::ExpressionValue {
          const bool known = is_special(name) || bases_.front().table.has(name);
          return known ? value_of({}, name) : vp::ExpressionValue(1.0L);
        });
    if (value.is_text)
      figure.refuse(figure.names().front(),
                    "this is a text: an objective is a number; 'markervp metrics' lists those");
  }

  void check_names(const vp::Expression& expression) const {
    for (const std::string& name : expression.names()) {
      try {
        result::check_metric(name, parameters());
      } catch (const vp::InputError& error) {
        expression.refuse(name, error.what());
      }
    }
  }

  /// Of all designs and programs, and what else a point is named by.
  std::vector<std::string> parameters() const {
    std::vector<std::string> names{"system", "program", "inputs"};
    for (const Base& base : bases_) {
      for (std::string& path : base.table.paths()) names.push_back(std::move(path));
    }
    return names;
  }

  /// What speaks of parameters alone chooses the points; the rest judges their results.
  void sort_constraints() {
    for (const Condition& condition : spec_.constraints) {
      vp::Expression expression(condition.text, condition.where);
      check_names(expression);
      const auto& names = expression.names();
      const bool known = std::all_of(names.begin(), names.end(), [&](const std::string& name) {
        return is_special(name) || bases_.front().table.has(name);
      });
      if (known) {
        constraints_.push_back(std::move(expression));
      } else {
        manifest_.constraints.push_back(expression.text());
      }
    }
  }

  // Each program has its own options; what is swept must exist in all.
  void find_programs() {
    programs_ = {spec_.program};
    for (const Dimension& dimension : spec_.dimensions) {
      for (const Axis& axis : dimension.axes) {
        if (!is_program(axis.path)) continue;
        if (!spec_.program.empty())
          throw vp::InputError(axis.where + ": the PS program is swept and fixed: leave out one");
        if (axis.range) throw vp::InputError(axis.where + ": " + axis.path + " takes no range");
        if (programs_ != std::vector<std::string>{""})
          throw vp::InputError(axis.where + ": 'system' and 'program' both name the PS program");
        programs_ = axis.values;
      }
    }
    find_bases();
  }

  // A design has parameters of its own, and others follow from them.
  void find_bases() {
    std::vector<std::string> designs;
    for (const Dimension& dimension : spec_.dimensions) {
      for (const Axis& axis : dimension.axes) {
        if (axis.path == "design") designs = axis.values;
      }
    }
    for (const std::string& program : programs_) {
      const Setup build{program, spec_.set};
      if (designs.empty()) bases_.push_back({build, base_of(build)});
      for (const std::string& design : designs) {
        Setup with_design = build;
        with_design.settings["design"] = design;
        ParameterTable table = base_of(with_design);
        bases_.push_back({std::move(with_design), std::move(table)});
      }
    }
  }

  ParameterTable base_of(const Setup& build) {
    const Elaborated elaborated = platform_.elaborate(build, spec_.set_where);
    result::declare(elaborated.figures);
    for (const Json& figure : elaborated.figures) {
      auto& known = manifest_.figures;
      if (std::find(known.begin(), known.end(), figure) == known.end()) known.push_back(figure);
    }
    return ParameterTable(elaborated);
  }

  void make_axes() {
    for (const Dimension& dimension : spec_.dimensions) {
      AxisGroup group;
      for (const Axis& axis : dimension.axes) {
        manifest_.swept.push_back(axis.path);
        ParameterKind kind;
        if (!is_special(axis.path)) {
          for (const Base& base : bases_) base.table.find(axis.path, axis.where);
          if (spec_.set.count(axis.path) != 0)
            throw vp::InputError(axis.where + ": '" + axis.path + "' is swept, and fixed by 'set'");
          kind = bases_.front().table.kind(axis.path);
        }
        group.emplace_back(axis, kind);
      }
      if (group.size() > 1) {
        std::vector<std::string>& paths = manifest_.zipped.emplace_back();
        for (const AxisValues& axis : group) paths.push_back(axis.path());
      }
      groups_.push_back(std::move(group));
    }
  }

  void ask_about(double count) const {
    if (options_.limit) return;
    const std::string number = count < 1e15 ? vp::format_fixed(count, 0)
                                            : "about 10^" + vp::format_fixed(std::log10(count), 0);
    const std::string start = spec_.origin + ": the sweep has " + number + " points: ";
    if (count > most_points)
      throw vp::InputError(start +
                           "no machine gets through them; take some with --limit N, or draw "
                           "a sample ('sample: {method: sobol, points: 1000}')");
    if (count > most_points_unasked && !options_.yes)
      throw vp::InputError(start + "run them all with --yes, or some with --limit N");
  }

  void check(const AxisValues& axis) {
    if (is_special(axis.path())) return;
    if (check_values(axis, bases_, platform_)) influential_.insert(axis.path());
  }

  bool allowed(const Assignment& point) const {
    const auto lookup = [&](const std::string& name) { return value_of(point, name); };
    return std::all_of(constraints_.begin(), constraints_.end(),
                       [&](const vp::Expression& condition) { return condition.holds(lookup); });
  }

  vp::ExpressionValue value_of(const Assignment& point, const std::string& name) const {
    const std::string* swept = find(point, name);
    if (is_special(name))
      return study::value_of(ParameterKind(), swept != nullptr ? *swept : spec_.program);
    const ParameterTable& table = bases_.front().table;
    return study::value_of(table.kind(name), swept != nullptr ? *swept : table.find(name).value);
  }

  void describe(bool is_part) {
    manifest_.name = spec_.name;
    manifest_.title = spec_.title;
    // It speaks of all points.
    if (!is_part || !options_.limit) manifest_.text = spec_.text;
    manifest_.source = spec_.source;
    manifest_.program = program_identity(platform_.version, platform_.revision);
    manifest_.tables = table_contents();
    manifest_.input = {spec_.input_settings, spec_.frames, spec_.repeat};
    manifest_.sampling = to_string(spec_.sampling.method);
    if (spec_.job) manifest_.job = spec_.job->text;
    manifest_.metrics = spec_.metrics;
    manifest_.objectives = spec_.objectives;
  }

  void add_points(Expansion&& expansion) {
    std::vector<Point> points;
    points.reserve(expansion.points.size());
    for (Assignment& assignment : expansion.points) {
      if (points.size() % most_ahead == 0) build_ahead(expansion.points, points.size());
      points.push_back(placed(std::move(assignment)));
    }
    std::vector<Assignment>().swap(expansion.points);  // and its room
    find_keys(manifest_, points);
    std::vector<std::size_t> positions;  // of the expansion's points
    std::unordered_map<std::string, std::size_t> seen;
    manifest_.points.reserve(points.size());
    for (Point& point : points) {
      const auto [known, is_new] = seen.emplace(point.key, manifest_.points.size());
      positions.push_back(known->second);
      if (is_new) manifest_.points.push_back(std::move(point));
    }
    const auto key = [&](std::size_t i) { return manifest_.points[positions[i]].key; };
    for (const Effect& effect : expansion.effects)
      manifest_.effects.push_back({key(effect.from), key(effect.to), effect.path, effect.delta});
  }

  Point planned(Assignment assignment) {
    Point point = placed(std::move(assignment));
    point.key = key_of(identities_.of(point));
    return point;
  }

  /// What decides the family of a point; `rest` gets its other values.
  Setup build_of(const Assignment& assignment, Assignment* rest) const {
    Setup build{spec_.program, spec_.set};
    for (const auto& [path, value] : assignment) {
      if (is_program(path)) build.program = value;
      if (is_special(path)) continue;
      if (influential_.count(path) != 0) {
        build.settings[path.text()] = value;
      } else if (rest) {
        rest->emplace_back(path, value);
      }
    }
    return build;
  }

  /// Builds families of the next points together: one by one each has a process of its own.
  void build_ahead(const std::vector<Assignment>& points, std::size_t first) {
    ahead_.clear();
    if (!platform_.elaborate_many || influential_.empty()) return;
    std::vector<Setup> builds;
    std::set<FamilyName> seen;
    for (std::size_t i = first; i < std::min(points.size(), first + most_ahead); ++i) {
      Setup build = build_of(points[i], nullptr);
      const FamilyName name{build.program, build.settings};
      if (families_.count(name) == 0 && seen.insert(name).second)
        builds.push_back(std::move(build));
    }
    if (builds.size() < 2) return;
    std::vector<std::optional<Elaborated>> built = platform_.elaborate_many(builds, spec_.origin);
    for (std::size_t i = 0; i < builds.size(); ++i) {
      if (built[i])
        ahead_.emplace(FamilyName{builds[i].program, builds[i].settings}, std::move(*built[i]));
    }
  }

  /// All but its key.
  Point placed(Assignment assignment) {
    Point point;
    point.swept = std::move(assignment);
    const BuiltFamily& family = family_of(build_of(point.swept, &point.changes));
    point.family = family.index;
    const std::string* label = find(point.swept, "inputs");
    point.input_set = input_set_of(label != nullptr ? *label : "", family.input);
    const auto& configuration = manifest_.families[point.family].configuration;
    const auto is_none = [&](const auto& change) {
      const auto found = configuration.find(change.first);
      return found != configuration.end() && change.second == found->second;
    };
    Assignment& changes = point.changes;
    changes.erase(std::remove_if(changes.begin(), changes.end(), is_none), changes.end());
    changes.shrink_to_fit();
    std::sort(changes.begin(), changes.end(),
              [](const auto& a, const auto& b) { return a.first.text() < b.first.text(); });
    return point;
  }

  /// Program and settings.
  using FamilyName = std::pair<std::string, std::map<std::string, std::string>>;
  struct BuiltFamily {
    std::size_t index;
    facts::InputNeed input;
  };

  Elaborated elaborated(const Setup& build) {
    const auto built = ahead_.find({build.program, build.settings});
    return built != ahead_.end() ? built->second : platform_.elaborate(build, spec_.origin);
  }

  const BuiltFamily& family_of(const Setup& build) {
    const auto known = families_.find({build.program, build.settings});
    if (known != families_.end()) return known->second;
    Family family{build.program, {}, {}, {}, {}};
    facts::InputNeed input;
    try {
      const ParameterTable table(elaborated(build));
      family.configuration = table.values();
      family.defaults = table.defaults();
      // What the design sets holds where the point says nothing.
      for (auto& [path, value] : family.defaults)
        if (build.settings.count(path) == 0) value = family.configuration.at(path);
      input = table.input();
    } catch (const vp::InputError& error) {
      family.problem = error.what();
      // These values do not go together: the points run, fail and say why.
      const ParameterTable& table =
          std::find_if(bases_.begin(), bases_.end(), [&](const Base& base) {
            return base.build.program == build.program;
          })->table;
      family.configuration = table.values();
      family.defaults = table.defaults();
      input = table.input();
      for (const auto& [path, value] : build.settings) family.configuration[path] = value;
    }
    family.contents =
        file_contents(platform_.program_file(build.program, family.configuration["design"]),
                      family.configuration);
    manifest_.families.push_back(std::move(family));
    const BuiltFamily built{manifest_.families.size() - 1, input};
    return families_.emplace(std::pair(build.program, build.settings), built).first->second;
  }

  std::size_t input_set_of(const std::string& label, const facts::InputNeed& need) {
    const auto id = std::make_pair(label, need);
    const auto known = input_sets_.find(id);
    if (known != input_sets_.end()) return known->second;
    const std::vector<std::string>& inputs =
        label.empty() ? spec_.inputs : spec_.input_sets.at(label);
    const InputRequest request{inputs, manifest_.input.settings, need};
    manifest_.input_sets.push_back({inputs, contents_of(request), need});
    return input_sets_[id] = manifest_.input_sets.size() - 1;
  }

  const Spec& spec_;
  const PlanOptions& options_;
  const Platform& platform_;
  std::vector<std::string> programs_;
  std::vector<Base> bases_;  ///< of each program and design
  std::vector<AxisGroup> groups_;
  std::vector<vp::Expression> constraints_;
  std::set<std::string> influential_;  ///< parameters from which others follow
  std::map<FamilyName, BuiltFamily> families_;
  std::map<FamilyName, Elaborated> ahead_;  ///< built, for the next points
  std::map<std::pair<std::string, facts::InputNeed>, std::size_t> input_sets_;
  Manifest manifest_;
  Identities identities_{manifest_};
};

struct Space::Impl {
  Impl(const Spec& asked, const Platform& platform)
      : spec(asked), planner(spec, options, platform) {}

  Spec spec;
  PlanOptions options{1, true};
  Planner planner;
};

Space::Space(const Spec& spec, const Platform& platform) : impl_(new Impl(spec, platform)) {
  if (spec.sampling.method != Sampling::Method::grid)
    throw vp::InputError(spec.sampling.where +
                         ": a search chooses the points itself: leave out 'sample'");
  // As of a sample, ranges need no step.
  impl_->spec.sampling.method = Sampling::Method::random;
  impl_->spec.text.clear();  // it speaks of all points
  impl_->planner.prepare();
  impl_->planner.describe(true);
  manifest().sampling = "search";
}

Space::~Space() = default;

const Spec& Space::spec() const {
  return impl_->spec;
}

const std::vector<AxisGroup>& Space::groups() const {
  return impl_->planner.groups_;
}

double Space::size() const {
  double size = 1;
  for (const AxisGroup& group : groups())
    size *= group.front().continuous() ? std::numeric_limits<double>::infinity()
                                       : static_cast<double>(group.front().values().size());
  return size;
}

const std::vector<vp::Expression>& Space::conditions() const {
  return impl_->planner.constraints_;
}

vp::ExpressionValue Space::value(const Assignment& point, const std::string& name) const {
  return impl_->planner.value_of(point, name);
}

Point Space::point(const Assignment& assignment) {
  return impl_->planner.planned(assignment);
}

Manifest& Space::manifest() {
  return impl_->planner.manifest_;
}

Manifest plan(const Spec& spec, const PlanOptions& options, const Platform& platform) {
  return Planner(spec, options, platform).plan();
}

}  // namespace platform::study
