// The file of figures that `markervp rtl synth` writes and KnownFigures reads.
#include <fpga/synthesis/synthesis.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace platform::synthesis {

namespace {

double rounded(double value, double scale) {
  return std::round(value * scale) / scale;
}

}  // namespace

std::string to_json(const std::vector<Figures>& figures, const std::string& tool,
                    const PathTiming& timing) {
  using Json = nlohmann::ordered_json;
  Json entries = Json::array();
  for (const Figures& f : figures) {
    const Cells& cells = f.netlist.cells;
    Json entry{{"ip", f.ip},
               {"parameters", f.parameters},
               {"lut", cells.lut},
               {"lut_pairs", cells.lut_pairs},
               {"lut_memory", cells.lut_memory},
               {"lut_through", cells.lut_through},
               {"ff", cells.ff},
               {"carry4", cells.carry4},
               {"ramb18", cells.ramb18},
               {"ramb36", cells.ramb36},
               {"dsp", cells.dsp}};
    if (const std::optional<Fmax> fmax = f.netlist.fmax(timing)) {
      const Path& path = *f.netlist.longest;
      entry["longest_path"] = {{"from", path.from},
                               {"to", path.to},
                               {"levels", path.cells.size()},
                               {"cells_ns", rounded(path.cells_ns, 1e3)},
                               {"nets", path.nets},
                               {"fan_out", path.fan_out},
                               {"setup_ns", rounded(path.setup_ns, 1e3)}};
      entry["fmax_mhz"] = {{"low", rounded(fmax->mhz.low, 10)},
                           {"nominal", rounded(fmax->mhz.nominal, 10)},
                           {"high", rounded(fmax->mhz.high, 10)}};
      if (!fmax->limited_by.empty()) entry["limited_by"] = fmax->limited_by;
    }
    if (!f.own) {  // for `pl.<ip>.figures`
      entry["built_with"] = f.netlist.parameters;
      entry["sources"] = f.sources;
      if (!f.netlist.not_covered.empty()) entry["not_covered"] = f.netlist.not_covered;
    }
    entries.push_back(entry);
  }
  return Json{{"version", 1}, {"tool", tool}, {"entries", entries}}.dump(2) + "\n";
}

}  // namespace platform::synthesis
