#include <cli/sweep_command.h>

#include <algorithm>
#include <deque>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <sstream>
#include <thread>

#include <chip/run/simulation.h>
#include <chip/system/designs.h>
#include <cli/commands.h>
#include <cli/program.h>
#include <host/process.h>
#include <pl/common/known_frames.h>
#include <ps/cpu/program.h>
#include <ps/memory/memory.h>
#include <result/figures.h>
#include <study/axes.h>
#include <study/inputs.h>
#include <vp/error.h>
#include <vp/ip.h>
#include <vp/text.h>

namespace platform::cli {

namespace {

using Json = nlohmann::ordered_json;

/// Memory for inputs that were made before: 200 of 640×480 bytes.
constexpr std::size_t most_input_bytes = std::size_t{64} << 20;
/// The same for frames whose words are known.
constexpr std::size_t most_known_bytes = std::size_t{32} << 20;

std::optional<std::string> if_named(const std::string& text) {
  if (text.empty()) return std::nullopt;
  return text;
}

std::string last_line(const std::string& text) {
  return text.substr(text.rfind('\n') + 1);
}

Json to_json(const std::vector<vp::ParameterDescription>& parameters, const facts::InputNeed& input,
             const facts::Work& work) {
  Json json;
  json["figures"] = result::own_figures_json(work);
  json["input"] = {input.kind, input.bytes, input.shape};
  json["parameters"] = Json::array();
  for (const vp::ParameterDescription& p : parameters)
    json["parameters"].push_back({p.path, p.value, p.default_value, p.allowed});
  return json;
}

study::Elaborated elaborated_from(const Json& json) {
  study::Elaborated result;
  result.figures = json.at("figures");
  const Json& input = json.at("input");
  result.input = {input.at(0).get<std::string>(), input.at(1).get<std::size_t>(),
                  input.at(2).get<std::string>()};
  for (const Json& p : json.at("parameters")) {
    vp::ParameterDescription description;
    description.path = p.at(0).get<std::string>();
    description.value = p.at(1).get<std::string>();
    description.default_value = p.at(2).get<std::string>();
    description.allowed = p.at(3).get<std::string>();
    result.parameters.push_back(description);
  }
  return result;
}

Json built(vp::Configuration& configuration, const std::optional<std::string>& program) {
  SimulationOptions options;
  options.program = program;
  const auto simulation = cli::build(configuration, options);
  return to_json(configuration.parameters(), simulation->input(), simulation->work());
}

/// What another platform in this process may use again.
void keep_for_the_next() {
  ps::Program::keep_loaded();
  ps::PlatformMapping::keep(true);
}

/// Builds these one after another in a process of its own, which ends at the first that it cannot
/// build: a document a line.
host::Child builder_of(const std::vector<study::Setup>& builds,
                       const std::vector<std::size_t>& places, const std::string& origin) {
  return host::Child([&](std::ostream& out, std::ostream&) {
    keep_for_the_next();
    for (const std::size_t place : places) {
      vp::begin_fresh_context();
      vp::Configuration configuration;
      for (const auto& [path, value] : builds[place].settings)
        configuration.set(path, value, origin);
      out << built(configuration, if_named(builds[place].program))
                 .dump(-1, ' ', false, Json::error_handler_t::replace)
          << '\n';
    }
    return done;
  });
}

/// A study::Platform::elaborate_many.
std::vector<std::optional<study::Elaborated>> elaborate_many(
    const std::vector<study::Setup>& builds, const std::string& origin) {
  constexpr std::size_t worth_a_process = 8;
  std::vector<std::optional<study::Elaborated>> found(builds.size());
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < builds.size(); ++i) {
    if (!runs_own_code(builds[i].program, builds[i].settings)) left.push_back(i);
  }
  while (!left.empty()) {
    const std::size_t most = std::max(1U, std::thread::hardware_concurrency());
    const std::size_t count = std::clamp(left.size() / worth_a_process, std::size_t{1}, most);
    std::vector<std::vector<std::size_t>> shares(count);
    for (std::size_t i = 0; i < left.size(); ++i) shares[i % count].push_back(left[i]);
    std::deque<host::Child> running;
    for (const auto& share : shares) running.push_back(builder_of(builds, share, origin));
    left.clear();
    for (std::size_t i = 0; i < count; ++i) {
      std::istringstream lines(running[i].wait().out);
      std::size_t built_here = 0;
      for (std::string line; built_here < shares[i].size() && std::getline(lines, line);) {
        const Json document = Json::parse(line, nullptr, false);
        if (!document.is_object()) break;
        found[shares[i][built_here++]] = elaborated_from(document);
      }
      // One that failed has no answer; those behind it have another try.
      for (std::size_t next = built_here + 1; next < shares[i].size(); ++next)
        left.push_back(shares[i][next]);
    }
  }
  return found;
}

}  // namespace

Json made_apart(const std::function<Json(std::ostream& err)>& work) {
  host::Child child([&](std::ostream& out, std::ostream& err) {
    const auto hand_over = [&](const Json& json) {
      out << "\n" << json.dump(-1, ' ', false, Json::error_handler_t::replace);
    };
    try {
      hand_over(work(err));
      return done;
    } catch (const vp::ParameterError& error) {
      hand_over({{"parameter", error.path()}, {"message", error.what()}});
      return wrong_input;
    }
  });
  const host::ChildEnd end = child.wait();
  Json document = Json::parse(last_line(end.out), nullptr, false);
  if (end.exit_code == done && document.is_object()) return document;
  if (end.exit_code == wrong_input && document.is_object())
    throw vp::ParameterError(document.at("parameter"), document.at("message"));
  const std::string name = "markervp: ";
  std::string message(vp::trim(end.err));
  message = last_line(message);
  if (message.rfind(name, 0) == 0) message.erase(0, name.size());
  if (message.empty()) message = "the platform's process was ended";
  if (end.exit_code == protocol_broken) throw vp::ProtocolError(message);
  throw vp::InputError(message);
}

study::Elaborated elaborate(const ConfigurationOptions& options,
                            const std::optional<std::string>& program) {
  return elaborated_from(made_apart([&](std::ostream&) {
    vp::Configuration configuration;
    load_configuration(options, configuration);
    return built(configuration, program);
  }));
}

study::Platform sweep_platform() {
  study::Platform platform;
  platform.elaborate = [](const study::Setup& build, const std::string& origin) {
    return elaborated_from(made_apart([&](std::ostream&) {
      vp::Configuration configuration;
      for (const auto& [path, value] : build.settings) configuration.set(path, value, origin);
      return built(configuration, if_named(build.program));
    }));
  };
  platform.elaborate_many = elaborate_many;
  platform.program_file = [](const std::string& program, const std::string& design) {
    return program.empty() ? usual_program(design_named(design)) : program_file(program);
  };
  platform.version = program_version();
  platform.revision = source_revision();
  return platform;
}

RunOptions options_of(const study::Setup& setup) {
  RunOptions options;
  options.inputs = setup.inputs;
  options.program = if_named(setup.program);
  options.input_settings = setup.input.settings;
  options.frames = setup.input.frames;
  options.repeat = setup.input.repeat;
  options.configuration.settings = setup.settings;
  return options;
}

bool runs_own_code(const std::string& program,
                   const std::map<std::string, std::string>& configuration) {
  const auto design = configuration.find("design");
  return is_own_program(program) ||
         (design != configuration.end() && is_design_file(design->second));
}

int run_point(const study::Setup& setup, study::RunResult& result, std::ostream& err) {
  vp::begin_fresh_context();
  pl::known_frame_bytes = most_known_bytes;
  if (!runs_own_code(setup.program, setup.settings)) keep_for_the_next();
  MemoryRun found;
  const auto hand_over = [&] {
    result.result = found.result.take();
    result.configuration = std::move(found.configuration);
  };
  try {
    const int code = run_in_memory(options_of(setup), found, err);
    hand_over();
    return code;
  } catch (...) {
    hand_over();
    throw;
  }
}

void warm_up(const study::Manifest& manifest, const std::vector<std::size_t>& positions) {
  std::set<std::size_t> seen;
  for (const std::size_t position : positions) {
    const std::size_t index = manifest.points[position].input_set;
    if (!seen.insert(index).second) continue;
    const study::InputSet& set = manifest.input_sets[index];
    try {
      const study::InputKind& kind = study::input_kind(set.need.kind);
      if (kind.warm_up)
        kind.warm_up({set.inputs, manifest.input.settings, set.need}, most_input_bytes);
    } catch (const vp::InputError&) {
      // The points fail then, and say why.
    }
  }
}

}  // namespace platform::cli
