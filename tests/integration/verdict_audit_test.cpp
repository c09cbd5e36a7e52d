// The verdicts of 500 random points, derived once more from the figures in their results and from
// data/devices, without the code that made them.
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <map>
#include <set>
#include <string>

#include "sweeps.h"

using namespace sweep_test;

namespace {

constexpr const char* space = R"(
sample: {method: random, points: 500, seed: 15}
parameters:
  inputs: [demo, z4.5, roll30, squares5]
  device: [xc7z007s-1, xc7z010-2, xc7z020-1]
  design: [thesis, ps-only]
  camera.rate: [none, 5 fps, 60 fps, 100 fps]
  clocks: [made, exact]
  ps.ethernet: [true, false]
  ps.slcr.ps_clk: [33.333333333333332 MHz, 50 MHz]
  ps.cpu_clk.frequency: {start: 100 MHz, stop: 900 MHz}
  ps.fclk_clk0.frequency: {start: 5 MHz, stop: 260 MHz}
  ps.fclk_clk1.frequency: {start: 5 MHz, stop: 120 MHz}
  ps.m_axi_gp0.read_clocks: [4 cycles, 8 cycles, 16 cycles]
  pl.corner_detection.threshold: {start: 5, stop: 80}
  pl.blob_detection.label_count: {start: 4, stop: 200}
  pl.blob_detection.minimum_side: {start: 4 px, stop: 60 px}
  pl.feature_packaging.buffer_depth: {start: 2, stop: 300}
  pl.axi_threshold_bridge.fifo_depth: {start: 1, stop: 128}
  pl.axi_dma_1.s2mm_burst_beats: [2, 8, 16, 32]
  pl.burst_words: [16, 32]
  profile: [thesis, a9-O0, a9-O2]
  sw.margin: {start: 0 px, stop: 12 px}
  sw.canonical_width: [24 px, 60 px, 120 px]
  power.mode: [vivado-default, activity]
  power.ddr.frequency: {start: 300 MHz, stop: 533 MHz}
  timing.blob_detection.fmax: [40 MHz, 55 MHz, 90 MHz, 130 MHz]
  timing.corner_detection.fmax: [100 MHz, 110 MHz]
zip:
  - pl.width: [640 px, 640 px, 320 px, 480 px]
    pl.height: [480 px, 480 px, 240 px, 320 px]
metrics: [verdict.feasible, summary.fps.mean]
)";

/// A part of a verdict as it should be.
struct Part {
  std::string holds = "yes";
  bool has_margin = false;
  double margin = 0;

  void narrow(double percent) {
    margin = has_margin ? std::min(margin, percent) : percent;
    has_margin = true;
  }
};

class Auditor {
 public:
  Auditor()
      : chips_(Json::parse(kit::read_file(MARKERVP_SOURCE "/data/devices/zynq7000-artix7.json"))) {}

  /// Each part of the verdict on a result of the device, with the crystal in MHz.
  std::map<std::string, Part> parts(const Json& result, const std::string& device,
                                    double crystal) const {
    const std::string part = device.substr(0, device.rfind('-'));
    const Json& grade = chips_["grades"][device.substr(device.rfind('-') + 1)];
    return {{"ran", ran(result)},
            {"job", job(result)},
            {"fits", fits(result["resources"], chips_["parts"][part])},
            {"clocks", clocks(result["clocks"], grade, crystal)},
            {"timing", timing(result["timing"])}};
  }

 private:
  static double figure(const Json& json, const char* name) { return json.at(name).at("value"); }

  static Part ran(const Json& result) {
    const bool good = !result.contains("incomplete") && result.contains("program_end") &&
                      result["program_end"]["exit_code"] == 0;
    return {good ? "yes" : "no"};
  }

  static bool did_its_job(const Json& frame) {
    if (frame.contains("gave_up")) return false;
    for (const char* loss : {"feature_overflow", "label_overflow", "bridge_overflow",
                             "crossing_overflow", "software_overflow", "malformed"}) {
      if (frame["counts"][loss] != 0) return false;
    }
    if (!frame.contains("scene_marker")) return true;
    for (const Json& marker : frame["markers"]) {
      if (marker["id"] == frame["scene_marker"]) return true;
    }
    return false;
  }

  static Part job(const Json& result) {
    double good = 0, all = result["summary"].value("unpublished", 0.0);
    if (result.contains("camera")) all += result["camera"]["dropped"].get<double>();
    for (const Json& frame : result["frames"]) {
      good += did_its_job(frame) ? 1 : 0;
      ++all;
    }
    if (all == 0) return {"no"};
    const double margin = 100 * good / all - 100;
    return {margin < 0 ? "no" : "yes", true, margin};
  }

  static Part fits(const Json& resources, const Json& chip) {
    Part part;
    for (const char* kind : {"lut", "ff", "bram36", "dsp"}) {
      double used = 0;
      for (const Json& module : resources["modules"]) used += module[kind].get<double>();
      if (used == 0) continue;
      const double margin = 100 * (figure(chip, kind) / used - 1);
      part.narrow(margin);
      if (margin < 0) part.holds = "no";
    }
    return part;
  }

  /// Whether crystal x feedback / divisor comes within 50 ppm, by trying all.
  bool is_made(double mhz, const std::string& kind, const Json& grade, double crystal) const {
    const Json& family = chips_["family"];
    const auto most = static_cast<int>(figure(family, "divisor_max"));
    for (int feedback = static_cast<int>(figure(family, "pll_feedback_min"));
         feedback <= figure(family, "pll_feedback_max"); ++feedback) {
      const double vco = crystal * feedback;
      if (vco < figure(family, "vco_min_mhz") * 0.99995 ||
          vco > figure(grade, "vco_max_mhz") * 1.00005)
        continue;
      for (int a = 1; a <= most; ++a) {
        for (int b = 1; b <= (kind == "fclk_mhz" ? most : 1); ++b) {
          if (kind == "cpu_621_mhz" && (a == 1 || a == 3)) continue;
          if (kind == "ddr_mhz" && a % 2 != 0) continue;
          if (std::abs(vco / (a * b) - mhz) <= 50e-6 * mhz) return true;
        }
      }
    }
    return false;
  }

  Part clocks(const Json& clocks, const Json& grade, double crystal) const {
    Part part;
    for (const Json& clock : clocks["list"]) {
      if (!clock["used"]) continue;  // check_used() audits that
      const std::string name = clock["name"];
      const char* kind = name == "ps.cpu_clk"  ? "cpu_621_mhz"
                         : name == "power.ddr" ? "ddr_mhz"
                                               : "fclk_mhz";
      const double mhz = clock["frequency_mhz"], limit = figure(grade, kind);
      part.narrow(100 * (limit / mhz - 1));
      if (mhz > limit * 1.00005 || !is_made(mhz, kind, grade, crystal)) part.holds = "no";
    }
    return part;
  }

  static Part timing(const Json& timing) {
    Part missed, unknown, met;
    for (const Json& module : timing["modules"]) {
      const double clock = module["frequency_mhz"], low = module["fmax_mhz"],
                   high = module["fmax_high_mhz"];
      Part& part = clock > high ? missed : clock > low ? unknown : met;
      part.narrow(100 * (low / clock - 1));
    }
    missed.holds = "no";
    unknown.holds = "unknown";
    for (const Part& worst : {missed, unknown}) {
      if (worst.has_margin) return worst;
    }
    return met;
  }

  Json chips_;
};

/// Of one frame: the next one that is not dropped comes when the program is ready for it.
void check_camera(const Json& result, bool delivered) {
  const Json& camera = result["camera"];
  const double rate = camera["rate_fps"], busy = camera["utilisation_percent"].get<double>() / 100;
  BOOST_TEST(camera["offered"].get<double>() == std::max(1.0, std::ceil(busy)));
  BOOST_TEST(camera["dropped"].get<double>() == camera["offered"].get<double>() - 1);
  const double slack_us = (1 - busy) * 1e6 / rate;
  BOOST_TEST(std::abs(camera["slack_us"]["mean"].get<double>() - slack_us) < 10e6 / rate / 1e5);
  BOOST_TEST(camera["slack_us"]["mean"] == camera["slack_us"]["min"]);
  const double fps = delivered ? rate / camera["offered"].get<double>() : 0;
  BOOST_TEST(std::abs(camera["delivered_fps"].get<double>() - fps) < 1e-6);
  if (!delivered) return;
  const Json& summary = result["summary"];
  BOOST_TEST(summary["fps"]["mean"] == camera["delivered_fps"]);
  BOOST_TEST(summary["energy_per_frame_mj"].get<double>() * fps / 1e3 ==
                 summary["power_w"]["total"].get<double>(),
             boost::test_tools::tolerance(1e-6));
  BOOST_TEST(busy * 1e6 / rate >= result["frames"][0]["time_us"]["frame"].get<double>() * 0.999);
}

/// Of one frame: a rate is that of a result, or there is none.
void check_rate(const Json& result) {
  const bool delivered = !result["frames"].empty() && !result["frames"][0].contains("gave_up");
  BOOST_TEST(result["summary"].contains("fps") == delivered);
  if (result.contains("camera")) check_camera(result, delivered);
  if (!delivered || result.contains("camera")) return;
  const double us = result["frames"][0]["time_us"]["frame"];
  BOOST_TEST(result["summary"]["fps"]["mean"].get<double>() == 1e6 / us,
             boost::test_tools::tolerance(1e-6));
}

/// Up to which clock a part of -1 works that has no synthesised RTL: at the system clock of the
/// thesis, the vendor's at the clock of AXI4-Lite in its guides; the control block has no register.
double known_mhz(const std::string& module) {
  if (module == "pl.control_block") return 464;
  for (const char* part : {"axi_dma", "axi_gpio", "interconnect", "proc_sys_reset"}) {
    if (module.find(part) != std::string::npos) return 120;
  }
  return 100;
}

/// Times the factor of the grade.
void check_fmax(const Json& timing, const std::string& device) {
  const std::map<char, double> factor{{'1', 1.0}, {'2', 1.18}};
  for (const Json& module : timing["modules"]) {
    if (module["name"] == "pl.blob_detection" || module["name"] == "pl.corner_detection") continue;
    if (module["origin"] == "synthesised") continue;
    BOOST_TEST(
        module["fmax_mhz"].get<double>() == known_mhz(module["name"]) * factor.at(device.back()),
        boost::test_tools::tolerance(1e-9));
  }
}

/// What points were like: of each part, how often it holds.
struct Seen {
  std::map<std::string, std::map<std::string, int>> parts;
  std::set<std::string> devices;
  std::size_t kept_up = 0, dropped = 0;  ///< of points with a rate of the camera
  std::size_t judged = 0;
  Json feasible, device;  ///< a result with a PL, and of which device
};

/// A clock that a module of the PL runs on is used, as are those of the PS.
void check_used(const Json& result) {
  std::set<std::string> used{"ps.cpu_clk", "power.ddr"};
  for (const Json& module : result["timing"]["modules"]) used.insert(module["clock"]);
  for (const Json& clock : result["clocks"]["list"]) {
    const std::string name = clock["name"];
    BOOST_TEST((clock["used"] || used.count(name) == 0), name << " is used");
  }
}

void audit(const Auditor& auditor, const Json& point, Seen& seen) {
  const Json& outcome = point["outcome"];
  if (!outcome.contains("result")) {
    ++seen.parts["ran"]["no"];
    return;
  }
  const Json& result = outcome["result"];
  const Json& configuration = point["identity"]["configuration"];
  const std::string device = configuration["device"];
  BOOST_TEST(result["clocks"]["device"] == device);
  const double crystal = std::stod(configuration["ps.slcr.ps_clk"].get<std::string>());
  const Json& verdict = result["verdict"];
  std::string worst = "yes";
  for (const auto& [name, part] : auditor.parts(result, device, crystal)) {
    const Json& found = verdict[name];
    BOOST_TEST(found["holds"] == part.holds, name << ": " << found);
    BOOST_TEST(found.contains("margin_percent") == part.has_margin, name << ": " << found);
    if (part.has_margin) {
      BOOST_TEST(std::abs(found["margin_percent"].get<double>() - part.margin) < 0.002,
                 name << ": " << found << ", should be " << part.margin);
    }
    if (part.holds == "no" || worst == "yes") worst = part.holds;
    ++seen.parts[name][part.holds];
  }
  BOOST_TEST(verdict["feasible"] == worst);
  check_used(result);
  check_rate(result);
  if (result.contains("camera")) ++(result["camera"]["dropped"] == 0 ? seen.kept_up : seen.dropped);
  check_fmax(result["timing"], device);
  ++seen.parts["feasible"][worst];
  seen.devices.insert(device);
  if (worst == "yes" && !result["timing"]["modules"].empty()) {
    seen.feasible = result;
    seen.device = device;
  }
  ++seen.judged;
}

/// The audit would notice: each of these turns a part of a feasible result into a "no".
void check_that_faults_are_found(const Auditor& auditor, const Seen& seen) {
  const std::pair<const char*, std::pair<const char*, Json>> faults[] = {
      {"ran", {"/program_end/exit_code", 1}},
      {"ran", {"/incomplete", "interrupted"}},
      {"job", {"/frames/0/gave_up", "too late"}},
      {"job", {"/frames/0/counts/malformed", 1}},
      {"job", {"/frames/0/markers", Json::array()}},
      {"job", {"/frames", Json::array()}},
      {"job", {"/summary/unpublished", 1}},
      {"job", {"/camera/dropped", 1}},
      {"fits", {"/resources/modules/0/lut", 1'000'000}},
      {"clocks", {"/clocks/list/0/frequency_mhz", 900.0}},
      {"clocks", {"/clocks/list/1/frequency_mhz", 57.123456}},
      {"timing", {"/timing/modules/2/frequency_mhz", 500.0}}};
  for (const auto& [part, fault] : faults) {
    Json changed = seen.feasible;
    changed[Json::json_pointer(fault.first)] = fault.second;
    BOOST_TEST(auditor.parts(changed, seen.device, 100.0 / 3).at(part).holds == "no", fault.first);
  }
}

}  // namespace

BOOST_FIXTURE_TEST_CASE(no_verdict_of_500_random_points_is_wrong, Sweeps) {
  const Auditor auditor;
  Seen seen;
  write("audit.yaml", space);
  const kit::Outcome outcome = run({"sweep", "audit.yaml", "--no-report", "--keep-results"});
  BOOST_TEST((outcome.exit_code == 0 || outcome.exit_code == 4), outcome.err);
  for (const auto& [file, text] : kept("out/audit")) {
    BOOST_TEST_CONTEXT(file) {
      audit(auditor, Json::parse(text), seen);
    }
  }
  BOOST_TEST(seen.devices.size() == 3u);
  BOOST_TEST(seen.judged >= 450u);
  BOOST_TEST(seen.kept_up > 30u);
  BOOST_TEST(seen.dropped > 30u);
  // The space holds all that a verdict can be.
  for (const char* part : {"job", "fits", "clocks", "timing", "feasible"}) {
    BOOST_TEST(seen.parts[part]["yes"] > 10, part);
    BOOST_TEST(seen.parts[part]["no"] > 10, part);
  }
  BOOST_TEST(seen.parts["timing"]["unknown"] > 0);
  BOOST_TEST_REQUIRE(!seen.feasible.is_null());
  check_that_faults_are_found(auditor, seen);
}
