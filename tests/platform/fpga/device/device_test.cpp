// The devices that are installed, and files that are refused.
#include <fpga/device/device.h>

#include <boost/test/unit_test.hpp>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>

#include <vp/error.h>

#include "temporary_files.h"

using namespace platform::device;
using Json = nlohmann::ordered_json;

namespace {

const std::string installed_file = std::string(MARKERVP_DATA) + "/devices/zynq7000-artix7.json";

/// What is said of `text` as a file of devices; "" if it is one.
std::string refusal(const std::string& text) {
  const kit::TemporaryFolder folder;
  kit::write_file(folder / "my.json", text);
  try {
    read_devices(folder / "my.json");
  } catch (const vp::InputError& error) {
    return error.what();
  }
  return "";
}

/// That the file is refused after `change`, in one line with its name and all of `parts`.
void check_refused(const std::function<void(Json&)>& change,
                   const std::vector<std::string>& parts) {
  Json file = Json::parse(std::ifstream(installed_file));
  change(file);
  const std::string text = refusal(file.dump());
  BOOST_TEST(text.find("my.json") != std::string::npos, text);
  BOOST_TEST(text.find('\n') == std::string::npos, text);
  for (const std::string& part : parts) {
    BOOST_TEST(text.find(part) != std::string::npos, "'" << part << "' is not in: " << text);
  }
}

std::string refused_name(const std::string& name) {
  try {
    find_device(name);
  } catch (const vp::InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

BOOST_AUTO_TEST_SUITE(device)

BOOST_AUTO_TEST_CASE(every_figure_of_every_device_says_where_it_comes_from) {
  std::set<std::string> names;
  for (const Device& device : devices()) {
    BOOST_TEST(names.insert(device.name()).second, device.name() << " is there twice");
    for (const FigureInfo& info : figures()) {
      BOOST_TEST((device.*info.figure).source.size() > 10u, device.name() << " " << info.name);
    }
  }
  const std::set<std::string> expected = {"xc7z007s-1", "xc7z007s-2", "xc7z010-1", "xc7z010-2",
                                          "xc7z010-3",  "xc7z020-1",  "xc7z020-2", "xc7z020-3"};
  BOOST_TEST(names == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(figures_are_those_of_the_data_sheets) {
  const Device& big = find_device("xc7z020-1");
  BOOST_TEST(big.lut.value == 53'200);
  BOOST_TEST(big.ff.value == 106'400);
  BOOST_TEST(big.bram36.value == 140);
  BOOST_TEST(big.dsp.value == 220);
  BOOST_TEST(big.idcode() == 0x0372'7093u);
  BOOST_TEST(big.fmax_factor.value == 1);
  const Device& small = find_device("xc7z010-3");
  BOOST_TEST(small.lut.value == 17'600);
  BOOST_TEST(small.ff.value == 35'200);
  BOOST_TEST(small.bram36.value == 60);
  BOOST_TEST(small.dsp.value == 80);
  BOOST_TEST(small.idcode() == 0x0372'2093u);
  BOOST_TEST(small.cpu_621_mhz.value == 866.667);
  BOOST_TEST(small.vco_max_mhz.value == 2000);
  const Device& single = find_device("xc7z007s-2");
  BOOST_TEST(single.lut.value == 14'400);
  BOOST_TEST(single.ff.value == 28'800);
  BOOST_TEST(single.bram36.value == 50);
  BOOST_TEST(single.dsp.value == 66);
  BOOST_TEST(single.idcode() == 0x0372'3093u);
  BOOST_TEST(single.cores.value == 1);
  BOOST_TEST(single.cpu_421_mhz.value == 600);
}

BOOST_AUTO_TEST_CASE(faster_grades_are_faster_and_larger_parts_leak_more) {
  for (const std::string part : {"xc7z010", "xc7z020"}) {
    const Device *slow = nullptr, *fast = nullptr;
    for (const std::string grade : {"-1", "-2", "-3"}) {
      fast = &find_device(part + grade);
      if (slow) {
        BOOST_TEST(slow->cpu_621_mhz.value < fast->cpu_621_mhz.value);
        BOOST_TEST(slow->cpu_421_mhz.value < fast->cpu_421_mhz.value);
        BOOST_TEST(slow->vco_max_mhz.value < fast->vco_max_mhz.value);
        BOOST_TEST(slow->fmax_factor.value < fast->fmax_factor.value);
      }
      BOOST_TEST(fast->cpu_421_mhz.value < fast->cpu_621_mhz.value);
      slow = fast;
    }
  }
  BOOST_TEST(find_device("xc7z010").static_w.value < find_device("xc7z020").static_w.value);
}

BOOST_AUTO_TEST_CASE(a_name_without_grade_is_the_slowest_and_case_does_not_matter) {
  BOOST_TEST(find_device("xc7z010").name() == "xc7z010-1");
  BOOST_TEST(find_device("XC7Z020-3").name() == "xc7z020-3");
}

BOOST_AUTO_TEST_CASE(unknown_names_are_refused_with_the_nearest) {
  BOOST_TEST(refused_name("xc7z02-1").find("did you mean 'xc7z020-1'?") != std::string::npos);
  BOOST_TEST(refused_name("xc7z007s-3").find("did you mean 'xc7z007s-1'?") != std::string::npos);
  BOOST_TEST(refused_name("stratix").find("there are xc7z007s-1,") != std::string::npos);
  BOOST_TEST(refused_name("").find("unknown device ''") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(bad_figures_are_refused_by_name) {
  const auto lut = [](Json& f) -> Json& { return f["parts"]["xc7z020"]["lut"]; };
  check_refused([&](Json& f) { lut(f)["value"] = -1; }, {"'lut' of part 'xc7z020'", "-1"});
  check_refused([&](Json& f) { lut(f)["value"] = 0.5; }, {"'lut' of part 'xc7z020'", "0.5"});
  check_refused([&](Json& f) { lut(f)["value"] = 53'200.5; }, {"'lut'", "whole number"});
  check_refused([&](Json& f) { lut(f)["value"] = "many"; }, {"'lut'", "not a number"});
  check_refused([&](Json& f) { lut(f)["confidence"] = "sure"; },
                {"'sure'", "published", "assumed"});
  check_refused([&](Json& f) { lut(f)["source"] = ""; }, {"'source'", "'lut'"});
  check_refused([&](Json& f) { lut(f).erase("source"); }, {"'source'", "'lut'", "missing"});
  check_refused([&](Json& f) { lut(f)["valeu"] = 3; }, {"'valeu'", "did you mean 'value'?"});
  check_refused([&](Json& f) { lut(f) = 53'200; }, {"'lut'", "not an object"});
  check_refused([](Json& f) { f["grades"]["2"]["vco_max_mhz"]["value"] = 700; },
                {"PLL outputs of xc7z007s-2", "780", "700"});
  check_refused([](Json& f) { f["family"]["pll_feedback_min"]["value"] = 67; },
                {"feedback dividers", "67"});
}

BOOST_AUTO_TEST_CASE(names_are_checked) {
  check_refused([](Json& f) { f["parts"]["xc7z010"].erase("dsp"); },
                {"'dsp' of part 'xc7z010' is missing"});
  check_refused([](Json& f) { f["grades"]["1"]["fclk_mzh"] = 3; },
                {"'fclk_mzh' of grade '1'", "did you mean 'fclk_mhz'?"});
  check_refused([](Json& f) { f["grades"].erase("3"); }, {"'3' of 'grades' is missing"});
  check_refused([](Json& f) { f["parts"]["xc7z010"]["grades"] = Json::array(); },
                {"'grades' of part 'xc7z010'"});
  check_refused([](Json& f) { f["parts"]["xc7z010"]["grades"] = {1}; }, {"grade", "not a text"});
  check_refused([](Json& f) { f["famliy"] = 3; }, {"'famliy'", "did you mean 'family'?"});
}

BOOST_AUTO_TEST_CASE(what_is_no_such_file_is_refused) {
  check_refused([](Json& f) { f["version"] = 2; }, {"version is 2", "reads version 1"});
  check_refused([](Json& f) { f.erase("version"); }, {"version", "missing"});
  check_refused([](Json& f) { f["parts"] = 3; }, {"'parts'", "not an object"});
  BOOST_TEST(refusal("no json").find("line 1, column 2") != std::string::npos, refusal("no json"));
  BOOST_TEST(refusal(std::string(1000, '[')).find("device file") == 0u);
  BOOST_TEST(refusal("[]").find("not a JSON object") != std::string::npos);
  BOOST_CHECK_THROW(read_devices("/no/such/file.json"), vp::InputError);
}

BOOST_AUTO_TEST_SUITE_END()
