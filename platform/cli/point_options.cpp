#include <cli/point_options.h>

#include <ostream>

#include <cli/provenance.h>
#include <sweep/identity.h>
#include <sweep/point.h>
#include <vp/error.h>

namespace platform::cli {

namespace {

bool is_fidelity(const std::string& path) {
  return path == "fidelity" || path.rfind("pl.fidelity.", 0) == 0;
}

void refuse_doubles(const RunOptions& options) {
  const auto refuse = [](const std::string& option) {
    throw vp::InputError("--point names the " + option);
  };
  if (!options.inputs.empty()) refuse("inputs already: leave out INPUT");
  if (options.program) refuse("PS program already: leave out --program");
  if (options.camera) refuse("camera already: leave out --camera");
}

RunOptions options_of(const sweep::PointRecord& record, const RunOptions& options,
                      std::ostream& err) {
  const sweep::Json identity = record.identity_json();
  if (identity.at("markervp") != sweep::program_identity(program_version(), source_revision()))
    err << "markervp: warning: '" << *options.point
        << "' was computed by another version of the program: results may differ" << std::endl;
  RunOptions result = options;
  result.inputs = record.run.at("inputs").get<std::vector<std::string>>();
  const auto program = record.run.at("program").get<std::string>();
  if (!program.empty()) result.program = program;
  if (record.run.contains("camera")) result.camera = record.run.at("camera").get<std::string>();
  if (!identity.at("fit").is_null() && !result.fit)
    result.fit = identity.at("fit").get<std::string>();
  if (!identity.at("frames").is_null() && !result.frames)
    result.frames = identity.at("frames").get<std::uint64_t>();
  if (result.repeat == 1) result.repeat = identity.at("repeat").get<std::uint64_t>();
  std::vector<std::string> assignments;
  for (const auto& [path, value] : record.run.at("settings").items()) {
    if (is_fidelity(path) && (options.trace || options.fidelity)) continue;
    assignments.push_back(path + "=" + value.get<std::string>());
  }
  const std::vector<std::string>& asked = options.configuration.assignments;
  assignments.insert(assignments.end(), asked.begin(), asked.end());
  result.configuration.assignments = assignments;
  return result;
}

}  // namespace

RunOptions with_point(const RunOptions& options, std::ostream& err) {
  if (!options.point) return options;
  refuse_doubles(options);
  const sweep::PointRecord record = sweep::read_point(*options.point);
  try {
    return options_of(record, options, err);
  } catch (const sweep::Json::exception&) {
    throw vp::InputError("'" + *options.point +
                         "' was changed: remove it, and the sweep computes it again");
  }
}

}  // namespace platform::cli
