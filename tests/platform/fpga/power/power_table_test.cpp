// The power table: what is installed, and what is refused.
#include <fpga/power/power_table.h>

#include <boost/test/unit_test.hpp>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <vector>

#include <vp/error.h>

#include "temporary_files.h"

using namespace platform::power;
using Json = nlohmann::ordered_json;

namespace {

const std::string installed_file = std::string(MARKERVP_DATA) + "/power/zynq7020.json";

Json installed() {
  return Json::parse(std::ifstream(installed_file));
}

/// What is said of `text` as a table; "" if it is one.
std::string refusal(const std::string& text) {
  const kit::TemporaryFolder folder;
  kit::write_file(folder / "my.json", text);
  try {
    PowerTable::load(folder / "my.json");
  } catch (const vp::InputError& error) {
    return error.what();
  }
  return "";
}

/// That the table is refused after `change`, in one line with its file and all of `parts`.
void check_refused(const std::function<void(Json&)>& change,
                   const std::vector<std::string>& parts) {
  Json table = installed();
  change(table);
  const std::string text = refusal(table.dump());
  BOOST_TEST(text.find("my.json") != std::string::npos, text);
  BOOST_TEST(text.find('\n') == std::string::npos, text);
  for (const std::string& part : parts) {
    BOOST_TEST(text.find(part) != std::string::npos, "'" << part << "' is not in: " << text);
  }
}

Json& entry(Json& table, const std::string& name) {
  for (Json& candidate : table["entries"]) {
    if (candidate["name"] == name) return candidate;
  }
  throw std::out_of_range(name);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(power_table)

BOOST_AUTO_TEST_CASE(the_installed_table_has_every_coefficient_with_its_source) {
  const PowerTable table = PowerTable::load(installed_file);
  BOOST_TEST(table.name() == "zynq7020");
  BOOST_TEST(table.entries().size() == known_coefficients().size());
  for (const Coefficient& c : table.entries()) {
    BOOST_TEST(c.value.low <= c.value.nominal, c.name);
    BOOST_TEST(c.value.nominal <= c.value.high, c.name);
    BOOST_TEST(c.source.size() > 10u, c.name);
  }
  BOOST_TEST(PowerTable::load("zynq7020").hash() == table.hash());
}

BOOST_AUTO_TEST_CASE(an_own_table_is_read) {
  Json table = installed();
  table["name"] = "mine";
  entry(table, "ps.pll")["high"] = 0.5;
  const kit::TemporaryFolder folder;
  kit::write_file(folder / "my.json", table.dump());
  const PowerTable mine = PowerTable::load(folder / "my.json");
  BOOST_TEST(mine.name() == "mine");
  BOOST_TEST(mine.value("ps.pll").high == 0.5);
  BOOST_TEST(mine.hash() != PowerTable::load(installed_file).hash());
  BOOST_CHECK_THROW(mine.at("ps.plll"), std::logic_error);
}

BOOST_AUTO_TEST_CASE(bad_values_are_refused_by_name) {
  check_refused([](Json& t) { entry(t, "ps.pll")["low"] = -0.1; }, {"'low'", "'ps.pll'", "-0.1"});
  check_refused([](Json& t) { entry(t, "ps.uncore_32")["high"] = 441; }, {"'ps.uncore_32'", "441"});
  check_refused([](Json& t) { entry(t, "pl.logic")["nominal"] = 0.5; }, {"'pl.logic'", "in order"});
  check_refused([](Json& t) { entry(t, "pl.dsp")["nominal"] = "ten"; },
                {"'pl.dsp'", "not a number"});
  check_refused([](Json& t) { entry(t, "pl.dsp")["unit"] = "mW"; }, {"'pl.dsp'", "uW/MHz"});
  check_refused([](Json& t) { entry(t, "pl.dsp")["status"] = "guessed"; },
                {"'pl.dsp'", "guessed", "measured"});
  check_refused([](Json& t) { entry(t, "pl.dsp")["source"] = ""; }, {"'pl.dsp'", "source"});
}

BOOST_AUTO_TEST_CASE(names_are_checked) {
  check_refused([](Json& t) { entry(t, "pl.bram")["name"] = "pl.brem"; },
                {"'pl.brem'", "unknown", "pl.bram"});
  check_refused([](Json& t) { t["entries"].erase(3); }, {"missing", "ps.uncore_32"});
  check_refused([](Json& t) { t["entries"].push_back(t["entries"][0]); },
                {"ps.core_cycle", "twice"});
  check_refused([](Json& t) { entry(t, "pl.dsp").erase("low"); }, {"'low'", "pl.dsp", "missing"});
  check_refused([](Json& t) { entry(t, "pl.dsp")["nominl"] = 3; }, {"nominl", "unknown"});
  check_refused([](Json& t) { t["entires"] = 3; }, {"entires", "unknown"});
}

BOOST_AUTO_TEST_CASE(what_is_no_such_table_is_refused) {
  check_refused([](Json& t) { t["version"] = 2; }, {"version is 2", "reads version 1"});
  check_refused([](Json& t) { t.erase("version"); }, {"version", "missing"});
  check_refused([](Json& t) { t["device"] = "xc7z045"; }, {"xc7z045", "xc7z020"});
  check_refused([](Json& t) { t["entries"] = 3; }, {"entries", "list"});
  check_refused([](Json& t) { t["entries"][0] = 3; }, {"entry 1", "object"});
  BOOST_TEST(refusal("no json").find("this is not JSON") != std::string::npos);
  BOOST_TEST(refusal("[]").find("not a JSON object") != std::string::npos);
  BOOST_CHECK_THROW(PowerTable::load("/no/such/file.json"), vp::InputError);
  BOOST_CHECK_THROW(PowerTable::load("no_such_name"), vp::InputError);
}

BOOST_AUTO_TEST_CASE(the_table_in_markdown_has_a_row_each) {
  const PowerTable table = PowerTable::load(installed_file);
  const std::string text = as_markdown(table);
  for (const Coefficient& c : table.entries()) {
    BOOST_TEST(text.find("| `" + c.name + "` |") != std::string::npos, c.name);
  }
}

BOOST_AUTO_TEST_CASE(the_documentation_has_the_table) {
  const std::string page = kit::read_file(std::string(MARKERVP_DATA) + "/../docs/power.md");
  const std::string text = as_markdown(PowerTable::load(installed_file));
  BOOST_TEST((page.find("\n" + text + "\n") != std::string::npos),
             "docs/power.md is old: put what 'markervp power --markdown' prints into it");
}

BOOST_AUTO_TEST_SUITE_END()
