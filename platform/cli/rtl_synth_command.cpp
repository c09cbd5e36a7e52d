#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <future>
#include <ostream>
#include <thread>
#include <utility>

#include <cli/commands.h>
#include <fpga/synthesis/synthesis.h>
#include <fpga/synthesis/yosys.h>
#include <vp/error.h>
#include <vp/file.h>

namespace platform::cli {

namespace {

using synthesis::Design;
using synthesis::Figures;

std::vector<Design> designs_of(const RtlSynthOptions& options) {
  if (options.rtl.empty() == options.top.has_value()) {
    throw vp::InputError("--rtl and --top belong together: a folder, and the module in it");
  }
  if (options.rtl.empty()) {
    std::vector<Design> designs = synthesis::own_designs(options.ips);
    if (options.parameters.empty()) return designs;
    if (options.ips.size() != 1) throw vp::InputError("--parameter is for one IP: name it");
    designs.resize(1);
    designs.front().parameters = synthesis::parse_parameters(options.parameters);
    return designs;
  }
  if (!options.ips.empty()) {
    throw vp::InputError("give '" + options.ips.front() + "' or --rtl, not both");
  }
  Design design{*options.top, *options.top, {}, synthesis::parse_parameters(options.parameters)};
  for (const std::string& place : options.rtl) {
    std::error_code ignored;
    if (std::filesystem::is_regular_file(place, ignored)) {
      design.sources.emplace_back(place);
    } else {
      const auto sources = synthesis::sources_in(place);
      design.sources.insert(design.sources.end(), sources.begin(), sources.end());
    }
  }
  return {std::move(design)};
}

std::string name_of(const Figures& figures) {
  std::string name = figures.ip;
  for (const auto& [parameter, value] : figures.parameters) {
    name += fmt::format(" {}={}", parameter, value);
  }
  return name;
}

constexpr const char* row = "{:<34} {:>6} {:>6} {:>6} {:>7} {:>6} {:>6} {:>6} {:>6} {:>4}  {}\n";

/// "97 to 176 MHz"; at the limit of the chip "464 MHz, the limit of the global clock buffer
/// (BUFG)".
std::string mhz_text(const synthesis::Fmax& fmax) {
  const std::string high = fmt::format("{:.0f} MHz", fmax.mhz.high);
  const std::string range =
      fmax.mhz.low < fmax.mhz.high ? fmt::format("{:.0f} to {}", fmax.mhz.low, high) : high;
  return range + (fmax.limited_by.empty() ? "" : ", the limit of the " + fmax.limited_by);
}

void print_row(const Figures& figures, const synthesis::PathTiming& timing, std::ostream& out) {
  const synthesis::Cells& c = figures.netlist.cells;
  std::string fmax = "no path";
  if (const std::optional<synthesis::Fmax> range = figures.netlist.fmax(timing)) {
    const synthesis::Path& path = *figures.netlist.longest;
    fmax = fmt::format("{}, cells {:.2f} ns, {} nets, fan-out {}, {} to {}", mhz_text(*range),
                       path.cells_ns, path.nets, path.fan_out, path.from, path.to);
  }
  out << fmt::format(fmt::runtime(row), name_of(figures), c.lut, c.lut_pairs, c.lut_memory,
                     c.lut_through, c.ff, c.carry4, c.ramb18, c.ramb36, c.dsp, fmax);
  const synthesis::Netlist& netlist = figures.netlist;
  if (2 * netlist.constant_bits > netlist.output_bits) {
    out << fmt::format(
        "  {} of {} bits of its outputs are constant: its parameters may leave out what drives "
        "them\n",
        netlist.constant_bits, netlist.output_bits);
  }
  for (const std::string& what : figures.netlist.not_covered)
    out << "  not covered by Fmax: " << what << '\n';
  out << std::flush;
}

/// As many at a time as there are processors, for Yosys uses one. A row is printed as soon as those
/// before it are.
std::vector<Figures> synthesise_all(const std::vector<Design>& designs,
                                    const synthesis::PathTiming& timing, std::ostream& out) {
  std::vector<std::promise<Figures>> made(designs.size());
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < designs.size(); i = next++) {
      try {
        made[i].set_value(synthesis::synthesise(designs[i], timing));
      } catch (...) {
        next = designs.size();
        made[i].set_exception(std::current_exception());
      }
    }
  };
  std::vector<std::future<void>> workers;  // wait for their work in the end
  const std::size_t processors = std::max(1u, std::thread::hardware_concurrency());
  while (workers.size() < std::min(processors, designs.size()))
    workers.push_back(std::async(std::launch::async, work));
  std::vector<Figures> figures;
  for (std::promise<Figures>& one : made) {
    figures.push_back(one.get_future().get());
    print_row(figures.back(), timing, out);
  }
  return figures;
}

}  // namespace

int synthesise_rtl(const RtlSynthOptions& options, std::ostream& out) {
  const std::string tool = synthesis::yosys_version();
  const synthesis::PathTiming timing = synthesis::PathTiming::installed();
  std::vector<Design> designs = designs_of(options);
  for (Design& design : designs) {
    design.dsp = !options.no_dsp;
    design.includes.assign(options.includes.begin(), options.includes.end());
    design.defines = options.defines;
    design.ghdl_options = options.ghdl_options;
  }
  std::optional<vp::OutputFile> file;
  if (options.output) file.emplace(*options.output);
  out << tool << ", 7 series, speed grade -1, not routed\n"
      << fmt::format(fmt::runtime(row), "module", "LUT", "pairs", "LUTRAM", "through", "FF",
                     "CARRY4", "RAMB18", "RAMB36", "DSP", "Fmax, longest path");
  const std::vector<Figures> figures = synthesise_all(designs, timing, out);
  out << "LUT is logic, LUTRAM memory and shift registers, through what only leads to a carry "
         "chain. "
         "Vivado's Slice LUTs are\ntheir sum, less the pairs that it joins.\n";
  if (file) {
    file->write(synthesis::to_json(figures, tool, timing));
    file->commit();
    out << "wrote " << *options.output << '\n';
  }
  return done;
}

}  // namespace platform::cli
