#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <chip/block_design/place_ports.h>
#include <vp/unit.h>
#include <xilinx/clk_wiz/clk_wiz.h>
#include <xilinx/fabric_clock/fabric_clock.h>

// MMCM and PLL of the fabric, as the Clocking Wizard builds them (PG065).
namespace platform::block_design {

namespace {

unsigned speed_grade(const Placement& at) {
  const std::string& grade = at.ports.ps.clock_planner().device().grade;
  return grade.empty() || grade.front() < '1' || grade.front() > '3'
             ? 1
             : static_cast<unsigned>(grade.front() - '0');
}

/// Names and dividers of the outputs; the design uses those whose pins it names. Vivado leaves the
/// name of an unused output as it was, even if another one has it.
std::vector<std::pair<std::string, std::string>> outputs(const Placement& at) {
  std::vector<std::pair<std::string, std::string>> list;
  std::set<std::string> names;
  for (unsigned i = 0; i < 7; ++i) {
    const std::string divider =
        "MMCM_CLKOUT" + std::to_string(i) + (i == 0 ? "_DIVIDE_F" : "_DIVIDE");
    const std::string name = at.text("CLK_OUT" + std::to_string(i + 1) + "_PORT");
    if (names.insert(name).second) list.emplace_back(name, at.text(divider));
  }
  return list;
}

Placed place_fixed(const Placement& at) {
  xilinx::FabricClockBuild build;
  build.pll = at.text("PRIMITIVE") == "PLL";
  build.input_divider = at.text("MMCM_DIVCLK_DIVIDE");
  build.multiplier = at.text("MMCM_CLKFBOUT_MULT_F");
  build.outputs = outputs(at);
  auto clocks = std::make_unique<xilinx::FabricClock>(at.part.name.c_str(), at.clock({"clk_in1"}),
                                                      speed_grade(at), build);
  Placed placed;
  for (const auto& [name, divider] : build.outputs) placed.clocks[name] = clocks->output(name);
  placed.outputs = {{"locked", &clocks->locked}};
  placed.unused_inputs = {"clk_in1", "reset", "resetn"};
  placed.object = std::move(clocks);
  return placed;
}

/// A factor of the vendor's, "9.125", in thousandths.
std::uint32_t thousandths(const Placement& at, const std::string& name, const std::string& text) {
  const auto value = vp::Decimal::parse(text);
  const auto whole = value ? value->scaled(1, 3).whole() : std::nullopt;
  if (!whole || *whole < 0 || *whole > 1'000'000)
    at.refuse(name + " = '" + text + "' is no factor of an MMCM");
  return static_cast<std::uint32_t>(*whole);
}

Placed place_reconfigurable(const Placement& at) {
  xilinx::ClkWizBuild build;
  build.pll = at.text("PRIMITIVE") == "PLL";
  build.grade = speed_grade(at);
  build.divclk = static_cast<std::uint32_t>(at.number("MMCM_DIVCLK_DIVIDE"));
  build.multiply = thousandths(at, "MMCM_CLKFBOUT_MULT_F", at.text("MMCM_CLKFBOUT_MULT_F"));
  build.divide.clear();
  const auto list = outputs(at);
  for (const auto& [name, divider] : list)
    build.divide.push_back(thousandths(at, "the divider of " + name, divider));
  auto wizard = std::make_unique<xilinx::ClkWiz>(at.part.name.c_str(), at.clock({"clk_in1"}), build,
                                                 &at.clock({"s_axi_aclk"}));
  Placed placed;
  placed.slaves = {{"s_axi_lite", registers(wizard->s_axi_lite)}};
  for (unsigned n = 0; n < list.size(); ++n) placed.clocks[list[n].first] = &wizard->clk_out(n);
  placed.outputs = {{"locked", &wizard->locked}};
  placed.unused_inputs = {"clk_in1", "reset", "resetn", "s_axi_aclk", "s_axi_aresetn"};
  placed.object = std::move(wizard);
  return placed;
}

}  // namespace

Placed place_clock_manager(const Placement& at) {
  const std::string reconfigures = at.text("USE_DYN_RECONFIG");
  return reconfigures == "true" || reconfigures == "1" ? place_reconfigurable(at) : place_fixed(at);
}

}  // namespace platform::block_design
