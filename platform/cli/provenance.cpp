#include <cli/provenance.h>
#include <host/process.h>

namespace platform::cli {

std::string program_version() {
  return MARKERVP_VERSION;
}

std::string source_revision() {
  return MARKERVP_REVISION;
}

std::string version_text() {
  const std::string revision = source_revision();
  return "markervp " + program_version() + (revision.empty() ? "" : " (" + revision + ")");
}

report::Provenance provenance(const RunOptions& options, const std::vector<std::string>& arguments,
                              const vp::Configuration& configuration) {
  report::Provenance result;
  result.program = "markervp";
  result.version = program_version();
  result.revision = source_revision();
  result.configuration_hash = configuration.hash();
  result.command_line = arguments;
  result.host = host::host_name();
  result.date = host::utc_now();
  result.details.emplace_back("output", options.output);
  if (options.camera) result.details.emplace_back("camera", *options.camera);
  if (options.program) result.details.emplace_back("program_file", *options.program);
  if (options.trace) result.details.emplace_back("trace", *options.trace);
  return result;
}

}  // namespace platform::cli
