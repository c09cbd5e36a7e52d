#include <fpga/proof/counterexample.h>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <sstream>

#include <fpga/synthesis/yosys.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/wave_reader.h>

namespace platform::proof {

namespace {

namespace fs = std::filesystem;

/// An input of the circuit: a bit of a port.
struct InputBit {
  std::size_t place;
  unsigned bit;
  std::string port;
};

/// The lines "input PLACE BIT PORT" of a map that write_aiger made.
std::vector<InputBit> input_bits(const fs::path& map) {
  std::istringstream lines(vp::read_text(map, "map"));
  std::vector<InputBit> bits;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string kind;
    InputBit bit{};
    if (words >> kind >> bit.place >> bit.bit >> bit.port && kind == "input") bits.push_back(bit);
  }
  return bits;
}

/// Keeps the values of nets until `bad` was high for an instant, or else to the end. There x is
/// high, too: gates have 0 where RTL reads outside of a memory, and its simulation has x.
class UntilBad final : public vp::WaveHandler {
 public:
  explicit UntilBad(std::uint32_t bad) : bad_(bad) {}
  bool is_high(std::uint32_t net) const {
    const auto found = values_.find(net);
    return found != values_.end() && found->second != "0";
  }
  std::string value(std::uint32_t net) const {
    const auto found = values_.find(net);
    return found == values_.end() ? "0" : found->second;
  }

 private:
  bool at(std::uint64_t) override { return value(bad_) != "1"; }
  void change(std::uint32_t net, const vp::WaveValue& value) override {
    values_[net] = value.known ? fmt::format("{:x}", value.bits) : "x";
  }

  const std::uint32_t bad_;
  std::map<std::uint32_t, std::string> values_;
};

}  // namespace

Counterexample::Counterexample(const fs::path& folder, const Miter& miter,
                               const std::vector<std::string>& inputs)
    : folder_(folder) {
  for (const Port& input : miter.inputs()) names_.push_back(input.name);
  read_rows(inputs);
  simulate(inputs);
  read_trace(miter);
}

void Counterexample::read_rows(const std::vector<std::string>& inputs) {
  const std::vector<InputBit> bits = input_bits(folder_ / "miter.aim");
  for (const std::string& digits : inputs) {
    std::vector<std::uint64_t>& row = rows_.emplace_back(names_.size());
    for (const InputBit& bit : bits) {
      const auto name = std::find(names_.begin(), names_.end(), bit.port);
      if (name != names_.end() && digits.at(bit.place) == '1')
        row[static_cast<std::size_t>(name - names_.begin())] |= std::uint64_t{1} << bit.bit;
    }
  }
}

/// A witness in the form of AIGER 1.9. Registers begin at what Yosys gives them, so the map names
/// inputs only.
void Counterexample::simulate(const std::vector<std::string>& inputs) const {
  std::string witness = "1\nb0\n0\n", map;
  for (const std::string& digits : inputs) witness += digits + "\n";
  for (const InputBit& bit : input_bits(folder_ / "miter.aim"))
    map += fmt::format("input {} {} {}\n", bit.place, bit.bit, bit.port);
  vp::write_file((folder_ / "witness.aiw").string(), witness + ".\n");
  vp::write_file((folder_ / "inputs.aim").string(), map);
  const bool both = fs::exists(folder_ / "theirs.il");
  vp::write_file((folder_ / "simulate.ys").string(),
                 std::string("read_rtlil ours.il\n") + (both ? "read_rtlil theirs.il\n" : "") +
                     "read_verilog -sv miter.sv\nhierarchy -check -top miter\nproc\n"
                     "memory_collect\nopt_clean\nasync2sync\n"
                     "setundef -zero -init -undriven\nsetundef -zero\n"
                     "sim -clock clk -zinit -timescale 1ns -r witness.aiw -map inputs.aim -vcd " +
                     trace_name + "\n");
  const host::CommandEnd end = synthesis::run_in(folder_, {"yosys", "-q", "-s", "simulate.ys"});
  if (end.exit_code != 0)
    throw vp::HostError("Yosys cannot simulate the counterexample: " + end.out);
}

void Counterexample::read_trace(const Miter& miter) {
  vp::WaveReader reader(folder_ / trace_name);
  const auto net = [&](const std::string& name) -> std::optional<std::uint32_t> {
    const vp::WaveVariable* const variable = reader.find("miter." + name);
    if (variable == nullptr) return std::nullopt;
    reader.select(variable->net);
    return variable->net;
  };
  const auto bad = net("bad");
  if (!bad) throw vp::HostError("Yosys' trace of the counterexample lacks the miter");
  struct Nets {
    std::optional<std::uint32_t> differs, ours, theirs;
  };
  std::vector<Nets> nets;
  for (const std::string& name : miter.compared())
    nets.push_back({net("differs_" + name), net("ours_" + name), net("theirs_" + name)});
  UntilBad values(*bad);
  reader.read(values);
  if (!values.is_high(*bad)) return;
  for (std::size_t i = 0; i < nets.size(); ++i) {
    if (!nets[i].differs || !values.is_high(*nets[i].differs)) continue;
    Difference& difference = differences_.emplace_back();
    difference.name = miter.compared()[i];
    if (!nets[i].theirs) continue;
    difference.ours = values.value(*nets[i].ours);
    difference.theirs = values.value(*nets[i].theirs);
  }
}

void Counterexample::write(const fs::path& folder) const {
  fs::copy_file(folder_ / trace_name, folder / trace_name, fs::copy_options::overwrite_existing);
  std::string text;
  for (const std::string& name : names_) text += (text.empty() ? "" : " ") + name;
  for (const auto& row : rows_) {
    std::string line;
    for (const std::uint64_t value : row)
      line += fmt::format("{}{:x}", line.empty() ? "" : " ", value);
    text += "\n" + line;
  }
  vp::write_file((folder / stimulus_name).string(), text + "\n");
}

}  // namespace platform::proof
