#include <fpga/proof/engine.h>

#include <algorithm>
#include <regex>
#include <sstream>

#include <sys/resource.h>

#include <fpga/synthesis/yosys.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>

namespace platform::proof {

namespace {

namespace fs = std::filesystem;

constexpr const char *abc = "berkeley-abc", *witness_file = "witness.txt";

/// Parts of the budget that is left for each way to look. What makes the circuit smaller knows no
/// limit of its own, and gets half of it.
constexpr unsigned glance_part = 30, quick_part = 8, proof_part = 4, rest_part = 1,
                   reduction_part = 2;

double seconds_of_children() {
  rusage used{};
  ::getrusage(RUSAGE_CHILDREN, &used);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

/// A file of ABC's write_cex: states of registers, then a line of inputs a clock. Behind the last
/// one is "# DONE", on the same line.
std::vector<std::string> witness_in(const fs::path& file) {
  std::istringstream lines(vp::read_text(file, "witness"));
  std::vector<std::string> inputs;
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    line.resize(std::min(line.size(), line.find_first_not_of("01")));
    if (!line.empty()) inputs.push_back(line);
  }
  return inputs;
}

/// Of what ABC found, `print_status` tells: 0 is a counterexample, 1 a proof.
Search ask(const fs::path& folder, const std::string& commands, unsigned seconds) {
  const fs::path witness = folder / witness_file;
  fs::remove(witness);
  // A command looks at its clock now and then, which is the processor's time: what does not, is
  // ended a little later.
  const host::CommandEnd end = synthesis::run_in(
      folder, {abc, "-q", commands + "; print_status; write_cex -a " + witness_file}, seconds + 2);
  if (end.exit_code == host::no_such_command)
    throw vp::InputError(
        "berkeley-abc is not installed: apt-get install berkeley-abc, or "
        "scripts/setup --rtl");
  Search found;
  static const std::regex status(R"(Status = (-?\d+))"),
      bound(R"(No output asserted in (\d+) frames)");
  std::smatch m;
  if (std::regex_search(end.out, m, bound)) found.clocks = std::stoull(m[1]);
  if (!std::regex_search(end.out, m, status)) {
    if (end.exit_code > 0)
      throw vp::InputError("berkeley-abc failed: " + std::string(vp::trim(end.out)));
    return found;  // a signal: its time was up
  }
  found.proved = m[1] == "1";
  if (m[1] == "0" && fs::exists(witness)) found.inputs = witness_in(witness);
  return found;
}

}  // namespace

Budget::Budget(unsigned seconds) : end_(seconds_of_children() + seconds) {}

unsigned Budget::seconds_left() const {
  return static_cast<unsigned>(std::max(1.0, end_ - seconds_of_children()));
}

bool Budget::is_over() const {
  return seconds_of_children() >= end_ - 1;
}

Search search(const fs::path& file, const Budget& budget, std::uint64_t depth) {
  const fs::path folder = file.parent_path();
  const std::string bmc = depth > 0 ? "bmc3 -F " + std::to_string(depth) : "bmc3";
  /// What makes less of the circuit, and what then looks for an end.
  struct Step {
    std::string reduce, look;
    unsigned part;
  };
  const Step steps[] = {{"scleanup; lcorr", "pdr", glance_part},
                        {"scleanup", bmc, quick_part},
                        {"dc2; scorr -C 100; dc2", "pdr", proof_part},
                        {"scleanup", bmc, rest_part}};
  std::string circuit = file.filename().string();
  Search best;
  for (const Step& step : steps) {
    const unsigned left = budget.seconds_left(), seconds = std::max(1u, left / step.part);
    const std::string smaller = "smaller_" + circuit;
    Search found = ask(folder,
                       "read_aiger " + circuit + "; strash; " + step.reduce + "; write_aiger " +
                           smaller + "; " + step.look + " -T " + std::to_string(seconds),
                       seconds + left / reduction_part);
    if (fs::exists(folder / smaller)) circuit = smaller;
    found.clocks = std::max(found.clocks, best.clocks);
    best = std::move(found);
    if (best.proved || best.inputs || budget.is_over()) break;
  }
  return best;
}

}  // namespace platform::proof
