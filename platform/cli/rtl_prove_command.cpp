// `markervp rtl prove`: RTL of the user's and that of the IP in whose place it is, on every clock.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <ostream>

#include <cli/commands.h>
#include <fpga/proof/equivalence.h>
#include <fpga/synthesis/vhdl.h>
#include <host/document.h>
#include <host/output_folder.h>
#include <result/console.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>

namespace platform::cli {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using proof::Verdict;

proof::Claim claim_of(const std::string& ip, const RtlProveOptions& options) {
  proof::Claim claim;
  claim.ip = ip;
  claim.parameters = synthesis::parse_parameters(options.parameters);
  claim.seconds = options.seconds;
  claim.depth = options.depth;
  claim.folder = options.output;
  if (!options.rtl) {
    if (options.top) throw vp::InputError("--top is a module of --rtl: give both");
    return claim;
  }
  if (fs::path(*options.rtl).extension() == ".so") {
    throw vp::InputError("--rtl '" + *options.rtl +
                         "' is built: 'rtl prove' reads sources; give their folder");
  }
  claim.theirs = {ip, options.top.value_or(ip), synthesis::sources_in(*options.rtl), {}};
  if (synthesis::is_of_vhdl(*claim.theirs)) {
    throw vp::InputError(
        "'" + claim.theirs->top +
        "' is VHDL, which is proved as the Verilog that GHDL makes of it: build it "
        "with markervp_add_rtl(), and give <name>.rtl of the build folder");
  }
  claim.theirs->includes.assign(options.includes.begin(), options.includes.end());
  claim.theirs->defines = options.defines;
  return claim;
}

const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::proved:
      return "proved";
    case Verdict::bounded:
      return "bounded";
    case Verdict::different:
      return "different";
    case Verdict::unknown:
      break;
  }
  return "unknown";
}

Json to_json(const std::string& ip, const proof::Answer& answer) {
  Json json{{"ip", ip},
            {"verdict", name_of(answer.verdict)},
            {"clocks", answer.clocks},
            {"parameters", answer.parameters},
            {"parameters_of_ours_alone", answer.ours_alone},
            {"assumptions", answer.assumptions},
            {"compared", answer.compared},
            {"not_compared", answer.not_compared},
            {"differences", Json::array()}};
  if (!answer.why.empty()) json["why"] = answer.why;
  for (const proof::Difference& difference : answer.differences) {
    json["differences"].push_back(
        {{"name", difference.name}, {"ours", difference.ours}, {"theirs", difference.theirs}});
  }
  return json;
}

void print_terms(const proof::Answer& answer, std::ostream& out) {
  const std::string parameters = synthesis::parameters_text(answer.parameters);
  out << "with" << (parameters.empty() ? " no parameters" : parameters);
  if (!answer.ours_alone.empty())
    out << "; the RTL has no parameter " << vp::join(answer.ours_alone, ", ");
  out << "\nassumed:\n";
  for (const std::string& line : answer.assumptions) out << "  " << line << "\n";
  out << "compared: " << vp::join(answer.compared, ", ") << "\n";
  if (!answer.not_compared.empty())
    out << "not compared: " << vp::join(answer.not_compared, ", ") << "\n";
}

/// "m_tlast is 1 in ours, 0 in the RTL; …", or the rules that are broken.
std::string text_of(const std::vector<proof::Difference>& differences) {
  std::string text;
  for (const proof::Difference& difference : differences) {
    text += (text.empty() ? "" : "; ") + difference.name;
    if (!difference.ours.empty())
      text += fmt::format(" is 0x{} in ours, 0x{} in the RTL", difference.ours, difference.theirs);
  }
  return text;
}

int tell(const RtlProveOptions& options, const std::string& what, const proof::Answer& answer,
         std::ostream& out, std::ostream& err) {
  switch (answer.verdict) {
    case Verdict::proved:
      out << (options.rtl ? "PROVED EQUAL: " : "PROVED: ") << what << ", on every clock\n";
      return done;
    case Verdict::bounded:
      out << (options.rtl ? "EQUAL for " : "KEPT for ") << result::counted(answer.clocks, "clock")
          << ": " << what << "\n";
      if (options.depth != 0 && answer.clocks >= options.depth) return done;
      err << "markervp: that is no proof: give it more --time, smaller parameters, or say with "
             "--depth how many clocks are enough\n";
      return run_failed;
    case Verdict::different:
      err << "markervp: " << (options.rtl ? "DIFFERENT" : "BROKEN") << " behind clock "
          << answer.clocks << ": " << text_of(answer.differences) << "\n";
      out << "look at it: gtkwave " << options.output << "/" << proof::trace_name << "\n";
      return run_failed;
    case Verdict::unknown:
      break;
  }
  err << "markervp: UNKNOWN: " << answer.why << "\n";
  return run_failed;
}

}  // namespace

int prove_rtl(const std::string& ip, const RtlProveOptions& options, std::ostream& out,
              std::ostream& err) {
  const proof::Claim claim = claim_of(ip, options);
  host::prepare_output_folder(options.output);
  const fs::path folder = options.output;
  for (const char* earlier : {proof::trace_name, proof::stimulus_name, "prove.json"})
    fs::remove(folder / earlier);
  const proof::Answer answer = proof::prove(claim);
  vp::write_file((folder / "prove.json").string(), to_json(ip, answer).dump(2) + "\n");
  print_terms(answer, out);
  out << std::flush;
  const std::string what =
      options.rtl ? ip + " of '" + *options.rtl + "' and ours" : "streams of our " + ip;
  return tell(options, what, answer, out, err);
}

}  // namespace platform::cli
