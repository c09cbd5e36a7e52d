// `markervp rtl prove`: RTL of the user's and that of the IP in whose place it is, on every clock.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <ostream>
#include <utility>

#include <axi/interfaces.h>
#include <cli/commands.h>
#include <fpga/proof/equivalence.h>
#include <fpga/proof/miter.h>
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

/// The interfaces of a module, found as those of a part of a design are.
proof::Pins pins_of(const std::vector<proof::Port>& ports, const std::string& top,
                    const std::vector<std::string>& interfaces) {
  std::vector<RtlPort> list;
  list.reserve(ports.size());
  for (const proof::Port& port : ports)
    list.push_back({port.name.c_str(), port.bits, port.output ? 1 : 0, port.place.c_str()});
  std::vector<std::pair<std::string, std::string>> said;
  for (const std::string& entry : interfaces) {
    const std::size_t colon = entry.find(':');
    if (colon == 0 || colon == std::string::npos)
      throw vp::InputError("--interface '" + entry + "' is not '<port or prefix>: <kind>'");
    said.emplace_back(entry.substr(0, colon), vp::trim(entry.substr(colon + 1)));
  }
  std::vector<RtlNote> notes;
  notes.reserve(said.size());
  for (const auto& [port, text] : said) notes.push_back({"interface", port.c_str(), text.c_str()});
  RtlDescriptor module{};
  module.ip = "";
  module.top = top.c_str();
  module.place = top.c_str();
  module.port_count = static_cast<std::uint32_t>(list.size());
  module.ports = list.data();
  module.note_count = static_cast<std::uint32_t>(notes.size());
  module.notes = notes.data();
  proof::Pins pins;
  for (const axi::Interface& one : axi::find_interfaces(module, "--interface")) {
    const auto port_of = [&](std::uint32_t number) { return std::string(list[number].name); };
    if (one.kind == axi::Kind::clock) {
      if (!pins.clock.empty())
        throw vp::InputError("'" + top + "' has the clocks '" + pins.clock + "' and '" + one.name +
                             "': a proof has one clock");
      pins.clock = one.name;
    } else if (one.kind == axi::Kind::reset) {
      pins.resets.push_back({one.name, one.active_low});
    }
    const bool stream = one.kind == axi::Kind::axi_stream, full = one.kind == axi::Kind::axi4;
    if (!stream && !full && one.kind != axi::Kind::axi_lite) continue;
    proof::Link& link = pins.links.emplace_back();
    link.kind = stream ? proof::Link::Kind::axi_stream
                : full ? proof::Link::Kind::axi4
                       : proof::Link::Kind::axi_lite;
    link.name = one.name.empty() ? (stream ? "axis" : "axi") : one.name;
    link.slave = one.slave;
    for (const auto& [signal, number] : one.ports) link.ports[signal] = port_of(number);
  }
  if (pins.links.empty())
    throw vp::InputError("'" + top +
                         "' has no AXI4, AXI4-Lite or AXI4-Stream link: there are no "
                         "rules to prove");
  if (pins.clock.empty())
    throw vp::InputError("'" + top +
                         "' has no clock that is known by its name: say which port it "
                         "is, --interface '<port>: clock'");
  return pins;
}

/// "mode=3", "base=0x1F00".
std::map<std::string, std::uint64_t> ties_of(const std::vector<std::string>& texts) {
  std::map<std::string, std::uint64_t> ties;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    const std::string name = text.substr(0, equals);
    const std::string digits = equals == std::string::npos ? "" : text.substr(equals + 1);
    char* end = nullptr;
    errno = 0;
    const std::uint64_t value = std::strtoull(digits.c_str(), &end, 0);
    const bool read = !digits.empty() && std::isdigit(static_cast<unsigned char>(digits[0])) != 0 &&
                      *end == '\0' && errno == 0;
    if (name.empty() || !read)
      throw vp::InputError("--tie '" + text + "': give PORT=NUMBER, as mode=3 or base=0x1F00");
    if (!ties.emplace(name, value).second)
      throw vp::InputError("--tie gives '" + name + "' two values: each input has one");
  }
  return ties;
}

proof::Claim claim_of(const std::string& ip, const RtlProveOptions& options) {
  proof::Claim claim;
  claim.ip = ip;
  claim.parameters = synthesis::parse_parameters(options.parameters);
  claim.seconds = options.seconds;
  claim.depth = options.depth;
  claim.folder = options.output;
  if (ip.empty() && !(options.rtl && options.top))
    throw vp::InputError(
        "name an IP; or give --rtl and --top, whose links are to keep their rules");
  if (!ip.empty() && !options.interfaces.empty())
    throw vp::InputError("--interface is for RTL without an IP: the ports of '" + ip +
                         "' are known");
  if (!ip.empty() && !options.ties.empty())
    throw vp::InputError("--tie is for RTL without an IP: what the inputs of '" + ip +
                         "' may be is known");
  if (!options.rtl) {
    if (options.top) throw vp::InputError("--top is a module of --rtl: give both");
    return claim;
  }
  if (fs::path(*options.rtl).extension() == ".so") {
    throw vp::InputError("--rtl '" + *options.rtl +
                         "' is built: 'rtl prove' reads sources; give their folder");
  }
  std::error_code ignored;
  const bool file = fs::is_regular_file(*options.rtl, ignored);
  claim.theirs = {ip,
                  options.top.value_or(ip),
                  file ? std::vector<fs::path>{*options.rtl} : synthesis::sources_in(*options.rtl),
                  {}};
  claim.theirs->includes.assign(options.includes.begin(), options.includes.end());
  claim.theirs->defines = options.defines;
  claim.theirs->ghdl_options = options.ghdl_options;
  if (ip.empty()) {
    claim.find_pins = [top = *options.top, &options](const std::vector<proof::Port>& ports) {
      proof::Pins pins = pins_of(ports, top, options.interfaces);
      pins.ties = ties_of(options.ties);
      return pins;
    };
  }
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

/// `equal`: of two; else one keeps its rules.
int tell(const RtlProveOptions& options, bool equal, const std::string& what,
         const proof::Answer& answer, std::ostream& out, std::ostream& err) {
  switch (answer.verdict) {
    case Verdict::proved:
      out << (equal ? "PROVED EQUAL: " : "PROVED: ") << what << ", on every clock\n";
      return done;
    case Verdict::bounded:
      out << (equal ? "EQUAL for " : "KEPT for ") << result::counted(answer.clocks, "clock") << ": "
          << what << "\n";
      if (options.depth != 0 && answer.clocks >= options.depth) return done;
      err << "markervp: that is no proof: give it more --time, smaller parameters, or say with "
             "--depth how many clocks are enough\n";
      return run_failed;
    case Verdict::different:
      err << "markervp: " << (equal ? "DIFFERENT" : "BROKEN") << " behind clock " << answer.clocks
          << ": " << text_of(answer.differences) << "\n";
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
  const bool equal = options.rtl && !ip.empty();
  const std::string what = equal ? ip + " of '" + *options.rtl + "' and ours"
                           : ip.empty()
                               ? "links of '" + *options.top + "' of '" + *options.rtl + "'"
                               : "streams of our " + ip;
  return tell(options, equal, what, answer, out, err);
}

}  // namespace platform::cli
