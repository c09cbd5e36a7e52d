// The model against public power reports of Vivado for the same device.
#include <fpga/power/design_estimate.h>
#include <fpga/power/power_table.h>
#include <vp/power_meter.h>
#include <vp/text.h>

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <fstream>
#include <map>
#include <string>
#include <vector>

using namespace platform::power;

namespace {

/// What the reports assume: 25 °C, medium board, 250 LFM.
constexpr vp::ThermalPath path{25, 11.5};
constexpr double most_mean_error = 0.04;

struct Report {
  bool aside;
  std::string repository;
  std::map<std::string, double> value;
  double operator[](const std::string& column) const { return value.at(column); }
};

std::vector<Report> read_reports() {
  std::ifstream file(std::string(MARKERVP_TEST_DATA) + "/power/reports.csv");
  std::vector<Report> reports;
  std::vector<std::string> header;
  for (std::string line; std::getline(file, line);) {
    if (line[0] == '#') continue;
    const std::vector<std::string> cells = vp::split(line, ',');
    if (header.empty()) {
      header = cells;
      continue;
    }
    if (cells.at(0) == "other") continue;
    Report report{cells.at(0) == "aside", cells.at(1), {}};
    for (std::size_t i = 6; i < cells.size(); ++i) {
      if (!cells[i].empty()) report.value[header[i]] = std::stod(cells[i]);
    }
    reports.push_back(std::move(report));
  }
  return reports;
}

std::vector<Report> reports_of(bool aside) {
  std::vector<Report> chosen;
  for (const Report& report : read_reports()) {
    if (report.aside == aside) chosen.push_back(report);
  }
  return chosen;
}

const PowerTable& table() {
  static const PowerTable read =
      PowerTable::load(std::string(MARKERVP_DATA) + "/power/zynq7020.json");
  return read;
}

/// Clocks, logic, memories and multipliers.
double fabric_w(const Report& r) {
  const double per_clock =
      clock_energy(table(), r["ff"]).nominal + clock_root_energy(table()).nominal +
      logic_energy(table(), r["lut"], r["ff"]).nominal +
      block_memory_energy(table(), r["bram36"]).nominal + dsp_energy(table(), r["dsp"]).nominal;
  return per_clock * r["clock_mhz"] * 1e6;
}

/// What the model of the fabric does not cover: the PS and the pins as reported, clock managers.
double others_w(const Report& r) {
  return r["ps_w"] + r["io_w"] + r["mmcms"] * table().value("pl.mmcm").nominal;
}

/// The two things that are fitted.
struct Fit {
  vp::LeakageCurve leakage;
  double fabric = 1;  ///< times what the table says
};

Fit as_in_table() {
  return {leakage(table()), 1};
}

/// Least squares.
Fit fitted_to(const std::vector<Report>& reports) {
  Fit fit = as_in_table();
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, model = 0, both = 0;
  for (const Report& r : reports) {
    const double e = std::exp(fit.leakage.slope * (r["junction_c"] - 25));
    n += 1;
    x += e;
    y += r["static_w"];
    xx += e * e;
    xy += e * r["static_w"];
    model += fabric_w(r) * fabric_w(r);
    both += fabric_w(r) * (r["total_w"] - r["static_w"] - others_w(r));
  }
  fit.leakage.leakage_w = (n * xy - x * y) / (n * xx - x * x);
  fit.leakage.base_w = (y - fit.leakage.leakage_w * x) / n;
  fit.fabric = both / model;
  return fit;
}

double total_w(const Report& r, const Fit& fit) {
  const double dynamic = others_w(r) + fit.fabric * fabric_w(r);
  return dynamic + vp::find_static_point(fit.leakage, path, dynamic).static_w;
}

double mean_error(const std::vector<Report>& reports, const Fit& fit) {
  double sum = 0;
  for (const Report& r : reports) {
    const double error = std::abs(total_w(r, fit) / r["total_w"] - 1);
    BOOST_TEST_MESSAGE(r.repository << ": " << 100 * error << " %");
    sum += error;
  }
  return sum / static_cast<double>(reports.size());
}

}  // namespace

BOOST_AUTO_TEST_SUITE(vendor_reports)

BOOST_AUTO_TEST_CASE(total_power_is_right_within_4_percent_on_average) {
  BOOST_TEST(read_reports().size() == 22u);
  BOOST_TEST(mean_error(read_reports(), as_in_table()) < most_mean_error);
  BOOST_TEST(mean_error(reports_of(false), as_in_table()) < most_mean_error);
  BOOST_TEST(mean_error(reports_of(true), as_in_table()) < most_mean_error);
}

BOOST_AUTO_TEST_CASE(fitted_to_some_it_is_right_for_those_kept_aside) {
  const Fit fit = fitted_to(reports_of(false));
  BOOST_TEST(mean_error(reports_of(true), fit) < most_mean_error);
  // And says what the table says.
  BOOST_TEST(fit.leakage.watts(45) == leakage(table()).watts(45),
             boost::test_tools::tolerance(0.03));
  BOOST_TEST(fit.fabric == 1.0, boost::test_tools::tolerance(0.3));
}

BOOST_AUTO_TEST_CASE(no_owner_is_in_both_sets) {
  for (const Report& fit : reports_of(false)) {
    for (const Report& aside : reports_of(true)) {
      BOOST_TEST(vp::split(fit.repository, '/')[0] != vp::split(aside.repository, '/')[0]);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_wrong_model_is_noticed) {
  Fit no_leakage = as_in_table();
  no_leakage.leakage = {0, 0, 0.0342};
  BOOST_TEST(mean_error(read_reports(), no_leakage) > most_mean_error);
  Fit busy = as_in_table();
  busy.fabric = 4;
  BOOST_TEST(mean_error(read_reports(), busy) > most_mean_error);
}

BOOST_AUTO_TEST_CASE(temperatures_are_those_of_the_reports) {
  for (const Report& r : read_reports()) {
    const double dynamic = r["total_w"] - r["static_w"];
    const double junction = vp::find_static_point(leakage(table()), path, dynamic).junction_c;
    BOOST_TEST(std::abs(junction - r["junction_c"]) < 1.0, r.repository << ": " << junction);
  }
}

BOOST_AUTO_TEST_SUITE_END()
