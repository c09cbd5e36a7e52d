#include "mistaken_fir.h"

#include <memory>

using platform::facts::UnitReport;
using platform::facts::Work;

MistakenFir::MistakenFir(sc_core::sc_module_name name, platform::PlPorts& ports)
    : FirDesign(name, ports, false),
      mistake_("mistake", "none",
               {"none", "no_job", "no_unit", "declared_twice", "declared_by_the_platform",
                "figure_twice", "unknown_figure", "unknown_tally"},
               vp::Source::decision, "what the design does wrong, for a test") {}

Work MistakenFir::work() const {
  Work work = FirDesign::work();
  const std::string mistake = mistake_.get();
  if (mistake == "no_job") work.job.clear();
  if (mistake == "no_unit") work.figures.front().unit.clear();
  if (mistake == "declared_twice")
    work.figures.push_back({"peak", "mV", "largest word of a block"});
  if (mistake == "declared_by_the_platform")
    work.tallies.push_back({"frames", "counted again", ""});
  return work;
}

bool MistakenFir::report(const platform::Publication& publication, UnitReport& block) {
  if (!FirDesign::report(publication, block)) return false;
  const std::string mistake = mistake_.get();
  if (mistake == "figure_twice") block.figures.push_back(block.figures.front());
  if (mistake == "unknown_figure") block.figures.front().name = "depth";
  if (mistake == "unknown_tally") block.tallies.emplace_back("silent");
  return true;
}

const platform::DesignInfo& ramp_design() {
  static const platform::DesignInfo ramp{
      "ramp",
      "a filter of four taps on a ramp that its program makes",
      {"filtering"},
      true,
      platform::no_words,
      [](const char* name, platform::PlPorts& ports) -> std::unique_ptr<platform::Design> {
        return std::make_unique<MistakenFir>(name, ports);
      }};
  return ramp;
}
