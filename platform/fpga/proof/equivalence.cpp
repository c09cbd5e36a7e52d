#include <fpga/proof/equivalence.h>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <regex>
#include <set>

#include <fpga/proof/counterexample.h>
#include <fpga/proof/engine.h>
#include <fpga/proof/miter.h>
#include <fpga/synthesis/synthesis.h>
#include <fpga/synthesis/vhdl.h>
#include <fpga/synthesis/yosys.h>
#include <vp/error.h>
#include <vp/file.h>

namespace platform::proof {

namespace {

namespace fs = std::filesystem;
using synthesis::Design;
using synthesis::Parameters;
using synthesis::YosysFolder;

constexpr const char* ports_file = "ports.json";

/// One side of a miter: a module without others in it, as a file. What it assumes of its inputs is
/// no condition of ours.
std::vector<Port> elaborate(const Design& design, const char* name, const fs::path& folder,
                            const Budget& budget, const std::string& clock = "clk") {
  YosysFolder yosys(design);
  const std::string file = std::string(name) + ".il";
  const host::CommandEnd end = yosys.run(
      [&](const std::string& reading) {
        return reading + "\n" + synthesis::elaboration_of(design) + "\nproc\nchformal -remove\n" +
               YosysFolder::check + "\nflatten\nopt_clean\nrename -top " + name +
               "\nhierarchy -top " + name + "\nwrite_rtlil " + file + "\nwrite_json " + ports_file +
               "\n";
      },
      budget.seconds_left());
  yosys.refuse_loops();
  if (end.exit_code != 0 && budget.is_over())
    synthesis::refuse(design, "Yosys does not come to an end: give it more --time");
  if (end.exit_code != 0) yosys.refuse(end);
  fs::copy_file(yosys / file, folder / file);
  fs::copy_file(yosys / ports_file, folder / (name + std::string(".json")));
  if (!clock.empty()) check_clock(yosys / ports_file, clock);
  return read_ports(yosys / ports_file);
}

/// What a parameter of a module of ours is where nothing sets it.
std::optional<std::int64_t> default_of(const Design& ours, const std::string& name) {
  const std::regex declaration(R"(\bparameter\b[^,;)]*\b)" + name + R"(\s*=\s*(\d+))");
  std::smatch m;
  for (const fs::path& source : ours.sources) {
    if (source.stem() != ours.top) continue;
    const std::string text = vp::read_text(source, "source");
    if (std::regex_search(text, m, declaration)) return std::stoll(m[1]);
  }
  return std::nullopt;
}

struct Sides {
  Design ours;
  std::optional<Design> theirs;
  std::vector<std::string> ours_alone;
};

/// Pictures that never end would make any claim about their ends true.
void check_legal(const Parameters& parameters) {
  constexpr std::int64_t most = 4096;  // counters of the miter have 16 bits, for several rows too
  const auto value = [&](const char* name) {
    const auto found = parameters.find(name);
    return found == parameters.end() ? std::int64_t{1} : static_cast<std::int64_t>(found->second);
  };
  for (const char* name : {"WIDTH", "HEIGHT", "PIXELS_PER_CLOCK", "RADIUS"}) {
    if (parameters.count(name) > 0 && (value(name) < 1 || value(name) > most))
      throw vp::InputError(std::string("--parameter ") + name + ": a proof takes 1 to " +
                           std::to_string(most));
  }
  if (value("WIDTH") % value("PIXELS_PER_CLOCK") != 0 && parameters.count("WIDTH") > 0)
    throw vp::InputError("--parameter: WIDTH must be a multiple of PIXELS_PER_CLOCK");
}

/// Both with the same parameters, as far as theirs has them: what theirs lacks it is built for, and
/// ours is taken as it is by default.
Sides sides_of(const Claim& claim, const Contract& contract) {
  Sides sides{synthesis::own_designs({claim.ip}).front(), claim.theirs, {}};
  Parameters& ours = sides.ours.parameters = contract.least;
  const auto has = [&](const std::string& name) {
    return !sides.theirs || synthesis::has_parameter(*sides.theirs, name);
  };
  for (auto& [name, value] : ours) {
    if (!has(name) && contract.structural.count(name) == 0)
      value = default_of(sides.ours, name).value_or(value);
  }
  for (const auto& [name, value] : claim.parameters) {
    const bool is_ours = synthesis::has_parameter(sides.ours, name);
    if (is_ours) ours[name] = value;
    if (sides.theirs && has(name)) sides.theirs->parameters[name] = value;
    if (!is_ours && !(sides.theirs && has(name)))
      throw vp::InputError("--parameter: neither side has the parameter '" + name + "'");
  }
  check_legal(ours);
  if (!sides.theirs) return sides;
  for (const auto& [name, value] : ours) {
    if (has(name))
      sides.theirs->parameters[name] = value;
    else
      sides.ours_alone.push_back(name);
  }
  return sides;
}

/// The miter as a circuit of gates, with `bad` as its only output. Nothing is optimised that ABC
/// does faster, and names of nets go soon: each pass looks at all of them.
std::string circuit_script() {
  return "read_rtlil ours.il\n"
         "read_verilog -sv miter.sv\n"
         "hierarchy -check -top miter\n"
         "proc\nflatten\nopt_clean -purge\n"
         "memory_dff\nmemory_collect\nmemory_map\nopt_clean -purge\n"
         "async2sync\nsetundef -zero -init -undriven\nsetundef -zero\n"
         // What simplemap knows it maps faster than techmap.
         "simplemap\nopt_clean -purge\ntechmap\nsimplemap\ndffunmap\nsetundef -zero\naigmap\n"
         "write_aiger -zinit -map miter.aim miter.aig\n";
}

/// Looks at the miter of what lies in the folder.
void look(const Miter& miter, const Claim& claim, const fs::path& folder, const Budget& budget,
          Answer& answer) {
  answer.compared = miter.compared();
  answer.not_compared = miter.not_compared();
  const std::string reading = fs::exists(folder / "theirs.il") ? "read_rtlil theirs.il\n" : "";
  vp::write_file((folder / "miter.sv").string(), miter.verilog());
  vp::write_file((folder / "circuit.ys").string(), reading + circuit_script());
  const host::CommandEnd made =
      synthesis::run_in(folder, {"yosys", "-q", "-s", "circuit.ys"}, budget.seconds_left());
  if (made.exit_code != 0 && budget.is_over()) {
    answer.why = "Yosys did not make gates of it in time";
    return;
  }
  if (made.exit_code != 0) throw vp::HostError("Yosys cannot make gates of it: " + made.out);
  const Search found = search(folder / "miter.aig", budget, claim.depth);
  answer.clocks = found.clocks;
  if (found.proved) {
    answer.verdict = Verdict::proved;
  } else if (found.inputs) {
    const Counterexample example(folder, miter, *found.inputs);
    answer.clocks = example.clock();
    answer.differences = example.differences();
    answer.verdict = answer.differences.empty() ? Verdict::unknown : Verdict::different;
    if (answer.differences.empty())
      answer.why = "ABC's counterexample shows nothing when Yosys simulates it";
    example.write(claim.folder);
  } else if (found.clocks > 1) {
    answer.verdict = Verdict::bounded;
  } else {
    answer.why = "no clock could be looked at in time";
  }
}

/// The Verilog of VHDL, its generics set.
Design readable(const Design& design, const fs::path& folder) {
  return synthesis::is_of_vhdl(design) ? synthesis::verilog_of(design, folder) : design;
}

/// RTL alone, whose links keep the rules of AXI.
Answer prove_links(const Claim& claim) {
  const Budget budget(claim.seconds);
  const host::ScratchFolder scratch("prove");
  Design design = *claim.theirs;
  design.parameters = claim.parameters;
  design = readable(design, scratch.path());
  const std::vector<Port> ports = elaborate(design, Miter::ours, scratch.path(), budget, "");
  const Pins pins = claim.find_pins(ports);
  check_clock(scratch / (std::string(Miter::ours) + ".json"), pins.clock);
  Answer answer;
  answer.parameters = claim.parameters;
  answer.assumptions = assumptions(pins);
  look(Miter(ports, pins), claim, scratch.path(), budget, answer);
  return answer;
}

}  // namespace

Answer prove(const Claim& claim) {
  if (claim.ip.empty()) return prove_links(claim);
  const Contract& contract = contract_of(claim.ip);
  if (!claim.theirs && contract.streams_out.empty())
    throw vp::InputError("'" + claim.ip +
                         "' has no stream whose rules could be proved: give RTL "
                         "to compare it with (--rtl)");
  const Budget budget(claim.seconds);
  const Sides sides = sides_of(claim, contract);
  const host::ScratchFolder scratch("prove");
  const std::vector<Port> ours = elaborate(sides.ours, Miter::ours, scratch.path(), budget);
  const Miter miter = sides.theirs ? Miter(contract, sides.ours.parameters, ours,
                                           elaborate(readable(*sides.theirs, scratch.path()),
                                                     Miter::theirs, scratch.path(), budget))
                                   : Miter(contract, sides.ours.parameters, ours);
  Answer answer;
  answer.parameters = sides.ours.parameters;
  answer.ours_alone = sides.ours_alone;
  answer.assumptions = assumptions(contract);
  look(miter, claim, scratch.path(), budget, answer);
  return answer;
}

}  // namespace platform::proof
