// The model against public power reports of Vivado for the same family.
#include <fpga/power/design_estimate.h>
#include <fpga/power/power_table.h>
#include <vp/power_meter.h>
#include <vp/text.h>

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "temporary_files.h"

using namespace platform;
using namespace platform::power;

namespace {

struct Report {
  std::map<std::string, std::string> cell;
  const std::string& text(const std::string& column) const { return cell.at(column); }
  double operator[](const std::string& column) const {
    return text(column).empty() ? 0 : std::stod(text(column));
  }
};

/// Those of an XC7Z010 or XC7Z020.
const std::vector<Report>& reports() {
  static const std::vector<Report> read = [] {
    std::ifstream file(std::string(MARKERVP_TEST_DATA) + "/power/reports.csv");
    std::vector<Report> found;
    std::vector<std::string> header;
    for (std::string line; std::getline(file, line);) {
      if (line[0] == '#') continue;
      const std::vector<std::string> cells = vp::split(line, ',');
      if (header.empty()) {
        header = cells;
        continue;
      }
      Report report;
      for (std::size_t i = 0; i < header.size(); ++i) report.cell[header[i]] = cells.at(i);
      if (report.text("set") != "fabric") found.push_back(std::move(report));
    }
    return found;
  }();
  return read;
}

std::vector<Report> reports_of(const std::string& set) {
  std::vector<Report> chosen;
  for (const Report& report : reports()) {
    if (report.text("set") == set) chosen.push_back(report);
  }
  return chosen;
}

const std::string table_file = std::string(MARKERVP_DATA) + "/power/zynq7020.json";

const PowerTable& table() {
  static const PowerTable read = PowerTable::load(table_file);
  return read;
}

std::vector<double> numbers(const std::string& text) {
  std::vector<double> found;
  for (const std::string& word : vp::split(text, ' ')) {
    if (!word.empty()) found.push_back(std::stod(word));
  }
  return found;
}

/// As a user who has the report would write it down. PS and pins as reported.
DesignFigures figures_of(const Report& r) {
  DesignFigures design;
  design.device = device::find_device(r.text("device"));
  const std::vector<std::string> version = vp::split(r.text("vivado"), '.');
  design.older_tool = std::pair(std::stoi(version[0]), std::stoi(version[1])) <= std::pair(2017, 2);
  for (const double mhz : numbers(r.text("mmcm_mhz")))
    design.mmcm.push_back({mhz / 1e3, false, true});
  for (const double mhz : numbers(r.text("mmcm_fractional_mhz")))
    design.mmcm.push_back({mhz / 1e3, true, true});
  design.mmcm.resize(static_cast<std::size_t>(r["mmcms"]));
  design.pll.resize(static_cast<std::size_t>(r["plls"]));
  design.io.known_w = r["io_w"] + r["xadc_w"];
  design.ps = PsSettings{};
  design.ps->known_w = r["ps_w"];
  ClockDomain clock{"main", r["clock_mhz"], r["lut"], r["ff"], r["bram36"], r["dsp"]};
  double others_mhz = -clock.mhz;
  for (const double mhz : numbers(r.text("clocks_mhz"))) others_mhz += mhz;
  design.clocks.push_back(clock);
  if (others_mhz > 0) design.clocks.push_back({"others", others_mhz});
  return design;
}

double mean_error(const std::vector<Report>& chosen, const PowerTable& of = table()) {
  double sum = 0;
  for (const Report& r : chosen) {
    const double said = estimate_power(figures_of(r), of).ledger.total().nominal;
    const double error = std::abs(said / r["total_w"] - 1);
    BOOST_TEST_MESSAGE(r.text("repository") << ": " << 100 * error << " %");
    sum += error;
  }
  return sum / static_cast<double>(chosen.size());
}

/// The table with one value changed.
PowerTable with(const std::string& name, double nominal) {
  auto json = nlohmann::ordered_json::parse(std::ifstream(table_file));
  for (auto& entry : json["entries"]) {
    if (entry["name"] == name) entry["low"] = entry["nominal"] = entry["high"] = nominal;
  }
  const kit::TemporaryFolder folder;
  kit::write_file(folder / "changed.json", json.dump());
  return PowerTable::load(folder / "changed.json");
}

constexpr double most_mean_error = 0.015, most_mean_error_alone = 0.03;

/// Those whose design is in the PL alone: no watts of a processing system hide an error.
std::vector<Report> alone() {
  std::vector<Report> chosen;
  for (const Report& report : reports()) {
    if (report["ps_w"] == 0) chosen.push_back(report);
  }
  return chosen;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(vendor_reports)

BOOST_AUTO_TEST_CASE(totals_are_right_within_one_and_a_half_per_cent_on_average) {
  BOOST_TEST(reports().size() == 74u);
  BOOST_TEST(mean_error(reports()) < most_mean_error);
}

// The form and the coefficients of logic, memories and multipliers were found before these came.
BOOST_AUTO_TEST_CASE(so_are_those_of_reports_that_came_later) {
  BOOST_TEST(reports_of("later").size() == 39u);
  BOOST_TEST(mean_error(reports_of("later")) < most_mean_error);
}

BOOST_AUTO_TEST_CASE(so_are_those_without_a_processing_system) {
  BOOST_TEST(alone().size() == 8u);
  BOOST_TEST(mean_error(alone()) < most_mean_error_alone);
}

BOOST_AUTO_TEST_CASE(nine_of_ten_lie_within_their_bands) {
  int inside = 0;
  double width = 0;
  for (const Report& r : reports()) {
    const vp::Band total = estimate_power(figures_of(r), table()).ledger.total();
    inside += total.low <= r["total_w"] && r["total_w"] <= total.high;
    width += (total.high - total.low) / 2 / total.nominal;
  }
  BOOST_TEST(inside >= 67);
  BOOST_TEST(width / 74 < 0.05);
}

BOOST_AUTO_TEST_CASE(a_wrong_model_is_noticed) {
  BOOST_TEST(mean_error(reports(), with("static.leakage", 0)) > most_mean_error);
  BOOST_TEST(mean_error(reports(), with("pl.logic", 0.3)) > most_mean_error);
  BOOST_TEST(mean_error(reports(), with("pl.clock_root", 0.1)) > most_mean_error);
  BOOST_TEST(mean_error(reports(), with("pl.clock_branch", 0.2)) > most_mean_error);
  BOOST_TEST(mean_error(alone(), with("pl.mmcm_oscillator", 0.1)) > most_mean_error_alone);
}

BOOST_AUTO_TEST_CASE(temperatures_are_those_of_the_reports) {
  for (const Report& r : reports()) {
    DesignFigures same = figures_of(r);
    same.clocks = {{"memories", 0, 0, 0, r["bram36"]}};
    same.mmcm = same.pll = {};
    same.io.known_w = 0.0;
    same.ps->known_w = r["total_w"] - r["static_w"];
    const double junction = estimate_power(same, table()).junction_c;
    BOOST_TEST(std::abs(junction - r["junction_c"]) < 1.0, r.text("repository") << junction);
  }
}

BOOST_AUTO_TEST_CASE(no_owner_is_in_two_sets_of_the_first_reports) {
  for (const Report& fit : reports_of("fit")) {
    for (const Report& aside : reports_of("aside"))
      BOOST_TEST(fit.text("family") != aside.text("family"));
  }
}

BOOST_AUTO_TEST_SUITE_END()
