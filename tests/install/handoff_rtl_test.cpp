// The thesis' block design as Vivado hands it off, with the RTL that is installed as its own IP.
#include <boost/test/unit_test.hpp>

#include <cmath>

#include "installation.h"
#include "thesis_handoff.h"

using namespace install_test;

namespace {

using Json = nlohmann::ordered_json;

/// What a result says without power: the thesis measured that of its blob detection, and the RTL
/// has the activity that the vendor's tools assume of any logic.
Json without_power(Json result) {
  for (Json& frame : result["frames"]) frame.erase("energy_mj");
  for (const char* figure : {"power_w", "energy_per_frame_mj"}) result["summary"].erase(figure);
  return result;
}

struct HandedOff {
  HandedOff() {
    kit::write_file(installed.beside("thesis.hwh"), kit::thesis_handoff().text());
    const kit::Outcome imported = installed.markervp(
        {"import", "thesis.hwh", "--rtl", installed / "share/markervp/rtl", "-o", "thesis_mine"});
    BOOST_TEST_REQUIRE(imported.exit_code == 0, imported.err);
    BOOST_TEST(contains(imported.out, "10 parts, 0 stubs"), imported.out);
    const std::string folder = installed.beside("thesis_mine");
    const kit::Outcome configured = installed.configure(folder, "thesis_mine/build");
    BOOST_TEST_REQUIRE(configured.exit_code == 0, configured.err);
    const kit::Outcome built = installed.build_target("thesis_mine/build", "all");
    BOOST_TEST_REQUIRE(built.exit_code == 0, built.out + built.err);
  }
  /// Warnings are no failure: one says that timing is not known.
  Json run(const std::string& name, const Words& more = {}) const {
    Words all{"run", "demo", "z1.0", "--output", name, "--no-pictures", "--no-report"};
    all.insert(all.end(), more.begin(), more.end());
    const kit::Outcome outcome = installed.markervp(all);
    BOOST_TEST_REQUIRE(outcome.exit_code == 0, outcome.out + outcome.err);
    return Json::parse(kit::read_file(installed.beside(name + "/result.json")));
  }
  Json run_imported(const std::string& name, const Words& more = {}) const {
    Words all{"--design", "thesis_mine/design.yaml", "--program", "hybrid"};
    all.insert(all.end(), more.begin(), more.end());
    return run(name, all);
  }

  const Installation& installed = Installation::get();
};

double lut(const Json& result) {
  return result["resources"]["total"]["lut"].get<double>();
}

}  // namespace

BOOST_AUTO_TEST_SUITE(handoff_rtl)

BOOST_FIXTURE_TEST_CASE(its_rtl_gives_words_times_and_verdict_of_the_built_in_design, HandedOff) {
  const Json built_in = without_power(run("thesis_built_in"));
  const Json own = without_power(run_imported("thesis_rtl"));
  BOOST_TEST(built_in["frames"].size() == 2u);
  for (const char* part : {"frames", "summary"}) BOOST_TEST(own[part] == built_in[part], part);
  BOOST_TEST(!own["resources"].contains("unknown"));
  BOOST_TEST(std::abs(lut(own) / lut(built_in) - 1) < 0.1, lut(own));
  BOOST_TEST(own["verdict"]["fits"]["holds"] == "yes");

  // Synthesis alone leaves open whether it works at 50 MHz. The thesis says so: 55 MHz.
  BOOST_TEST(own["verdict"]["timing"]["holds"] == "unknown");
  BOOST_TEST(own["verdict"]["timing"]["by"] == "pl.feature_extraction_0");
  const Json limited =
      run_imported("thesis_rtl_55", {"--set", "timing.feature_extraction_0.fmax=55 MHz"});
  BOOST_TEST(limited["verdict"]["feasible"] == built_in["verdict"]["feasible"]);
  for (const char* part : {"fits", "clocks", "timing"})
    BOOST_TEST(limited["verdict"][part]["holds"] == built_in["verdict"][part]["holds"], part);
  BOOST_TEST(limited["verdict"]["timing"]["margin_percent"] ==
             built_in["verdict"]["timing"]["margin_percent"]);
}

BOOST_AUTO_TEST_SUITE_END()
