// Cost profiles: what is installed, and what is refused.
#include <chip/run/cost_profile.h>
#include <marker/work.h>
#include <vp/error.h>

#include <boost/test/unit_test.hpp>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "temporary_files.h"

using namespace platform::profiles;
using Json = nlohmann::json;

namespace {

Json installed(const std::string& name) {
  return Json::parse(std::ifstream(std::string(MARKERVP_DATA) + "/profiles/" + name + ".json"));
}

/// A folder with the installed tables, some of them changed.
struct Tables {
  Tables() {
    for (const char* name : {"a9-O0", "a9-O2", "thesis"}) write(name, installed(name));
  }
  void write(const std::string& name, const Json& content) const {
    std::ofstream(folder / (name + ".json")) << content.dump(1);
  }
  CostProfile load(const std::string& name, std::optional<Optimisation> o = std::nullopt) const {
    return load_cost_profile(folder / (name + ".json"), o);
  }

  kit::TemporaryFolder folder;
};

std::string message(const std::function<void()>& action) {
  try {
    action();
  } catch (const vp::InputError& error) {
    return error.what();
  }
  return "nothing was refused";
}

/// That the profile is refused after `change`, in one line with its file and all of `parts`.
void check_refused(const std::string& name, const std::function<void(Json&)>& change,
                   const std::vector<std::string>& parts) {
  Tables tables;
  Json content = installed(name);
  change(content);
  tables.write(name, content);
  const std::string text = message([&] { tables.load(name); });
  BOOST_TEST(text.find(name + ".json") != std::string::npos, text);
  BOOST_TEST(text.find('\n') == std::string::npos, text);
  for (const std::string& part : parts) {
    BOOST_TEST(text.find(part) != std::string::npos, "'" << part << "' is not in: " << text);
  }
}

}  // namespace

BOOST_AUTO_TEST_SUITE(cost_profiles)

BOOST_AUTO_TEST_CASE(every_unit_of_work_belongs_to_one_kernel) {
  std::multiset<std::string> units;
  for (const Kernel& kernel : kernels()) units.insert(kernel.units.begin(), kernel.units.end());
  for (const char* name : marker::work_names) BOOST_TEST(units.count(name) == 1u, name);
  BOOST_TEST(units.size() == static_cast<std::size_t>(marker::Work::count));
}

BOOST_AUTO_TEST_CASE(installed_profiles_have_every_unit) {
  for (const char* name : {"thesis", "a9-O0", "a9-O2"}) {
    const CostProfile profile = load_cost_profile(name, std::nullopt);
    BOOST_TEST(profile.costs.profile() == name);
    for (const char* unit : marker::work_names) {
      BOOST_CHECK_NO_THROW(profile.costs.at(unit, "test"));
    }
    BOOST_TEST(!profile.origin.empty());
    BOOST_TEST(profile.date.size() == 10u);
  }
}

BOOST_AUTO_TEST_CASE(only_the_thesis_profile_is_fitted_and_to_few_published_values) {
  BOOST_TEST(load_cost_profile("a9-O0", std::nullopt).fitted.empty());
  BOOST_TEST(load_cost_profile("a9-O2", std::nullopt).fitted.empty());
  const CostProfile thesis = load_cost_profile("thesis", std::nullopt);
  BOOST_TEST(!thesis.fitted.empty());
  BOOST_TEST(thesis.fitted.size() <= max_fitted);
  std::stringstream published;
  published << std::ifstream(std::string(MARKERVP_DATA) + "/published.csv").rdbuf();
  for (const FittedConstant& constant : thesis.fitted) {
    for (const std::string& id : constant.published) {
      BOOST_TEST(published.str().find("\n" + id + ",") != std::string::npos, id);
    }
  }
}

BOOST_AUTO_TEST_CASE(optimised_code_is_faster_and_named) {
  const CostProfile slow = load_cost_profile("thesis", Optimisation::o0);
  const CostProfile fast = load_cost_profile("thesis", Optimisation::o2);
  BOOST_TEST(slow.costs.profile() == "thesis");
  BOOST_TEST(fast.costs.profile() == "thesis-O2");
  for (const char* unit : {"corner_pixels", "threshold_pixels", "blob_pixels", "grid_samples"}) {
    BOOST_TEST(fast.costs.at(unit, "").cycles < slow.costs.at(unit, "").cycles, unit);
  }
}

BOOST_AUTO_TEST_CASE(a_scale_takes_the_whole_kernel) {
  Tables tables;
  Json thesis = installed("thesis");
  thesis["fitted"] = {
      {{"kernel", "pose"}, {"scale", 2.5}, {"published", {"pose.duration"}}},
      {{"unit", "grid_samples_dma"}, {"stall_ns", 42}, {"published", {"identification.speedup"}}}};
  tables.write("thesis", thesis);
  const CostProfile profile = tables.load("thesis");
  const CostProfile base = tables.load("a9-O0");
  for (const char* unit : {"poses", "posit_iterations"}) {
    BOOST_TEST(profile.costs.at(unit, "").cycles == 2.5 * base.costs.at(unit, "").cycles);
    BOOST_TEST(profile.costs.at(unit, "").stall_ns == 2.5 * base.costs.at(unit, "").stall_ns);
  }
  BOOST_TEST(profile.costs.at("cells", "").cycles == base.costs.at("cells", "").cycles);
  BOOST_TEST(profile.costs.at("grid_samples_dma", "").stall_ns == 42);
  BOOST_TEST(profile.fitted.size() == 2u);
  BOOST_TEST(profile.fitted[0].name == "scale of pose");
  BOOST_TEST(profile.fitted[1].value == 42);
}

BOOST_AUTO_TEST_CASE(a_constant_may_hold_for_one_optimisation) {
  Tables tables;
  Json thesis = installed("thesis");
  thesis["fitted"] = {{{"kernel", "pose"},
                       {"optimisation", "O0"},
                       {"scale", 2.5},
                       {"published", {"pose.duration"}}}};
  tables.write("thesis", thesis);
  const auto cycles = [&](Optimisation optimisation) {
    const std::string table = optimisation == Optimisation::o0 ? "a9-O0" : "a9-O2";
    return tables.load("thesis", optimisation).costs.at("poses", "").cycles /
           tables.load(table, optimisation).costs.at("poses", "").cycles;
  };
  BOOST_TEST(cycles(Optimisation::o0) == 2.5);
  BOOST_TEST(cycles(Optimisation::o2) == 1);
}

BOOST_AUTO_TEST_CASE(programs_may_bring_units_of_their_own) {
  Tables tables;
  Json table = installed("a9-O0");
  table["other_units"] = {{"blinks", {{"cycles", 12}, {"stall_ns", 3}}}};
  tables.write("a9-O0", table);
  const CostProfile profile = tables.load("a9-O0");
  BOOST_TEST(profile.costs.at("blinks", "blink").cycles == 12);
  check_refused("a9-O0",
                [](Json& t) {
                  t["other_units"] = {{"poses", {{"cycles", 1}, {"stall_ns", 0}}}};
                },
                {"'poses'", "kernel 'pose'"});
}

BOOST_AUTO_TEST_CASE(missing_entries_are_refused) {
  check_refused("a9-O0", [](Json& t) { t["kernels"].erase("pose"); }, {"'pose'", "missing"});
  check_refused("a9-O0", [](Json& t) { t["kernels"]["pose"]["units"].erase("poses"); },
                {"'poses'", "kernel 'pose'", "missing"});
  check_refused(
      "a9-O2",
      [](Json& t) { t["kernels"]["decode"]["units"]["packets_decoded"].erase("stall_ns"); },
      {"'stall_ns'", "'packets_decoded'", "missing"});
  check_refused("a9-O0", [](Json& t) { t.erase("origin"); }, {"'origin'", "missing"});
}

BOOST_AUTO_TEST_CASE(negative_and_absurd_numbers_are_refused) {
  const auto set = [](const char* key, const Json& value) {
    return [=](Json& t) { t["kernels"]["blob_detection"]["units"]["blob_dark"][key] = value; };
  };
  check_refused("a9-O0", set("cycles", -0.5), {"'cycles'", "'blob_dark'", "-0.5"});
  check_refused("a9-O0", set("stall_ns", -1), {"'stall_ns'", "'blob_dark'"});
  check_refused("a9-O0", set("cycles", 1e9), {"'cycles'", "'blob_dark'"});
  check_refused("a9-O0", set("cycles", "many"), {"'cycles'", "'blob_dark'", "not a number"});
  check_refused("a9-O0", set("cycles", nullptr), {"'cycles'", "'blob_dark'", "not a number"});
}

BOOST_AUTO_TEST_CASE(unknown_entries_are_refused_with_the_nearest) {
  check_refused("a9-O0", [](Json& t) { t["kernels"]["poze"] = t["kernels"]["pose"]; },
                {"'poze'", "unknown", "'pose'"});
  check_refused("a9-O0",
                [](Json& t) {
                  t["kernels"]["pose"]["units"]["pozes"] = t["kernels"]["pose"]["units"]["poses"];
                },
                {"'pozes'", "kernel 'pose'", "'poses'"});
  check_refused("a9-O0", [](Json& t) { t["colour"] = "red"; }, {"'colour'", "unknown"});
}

BOOST_AUTO_TEST_CASE(another_version_is_refused) {
  check_refused("a9-O0", [](Json& t) { t["version"] = 2; }, {"version is 2", "version 1"});
  check_refused("thesis", [](Json& t) { t["version"] = "1"; }, {"version"});
  check_refused("a9-O0", [](Json& t) { t.erase("version"); }, {"'version'", "missing"});
}

BOOST_AUTO_TEST_CASE(fits_are_few_named_and_sensible) {
  const Json pose = {{"kernel", "pose"}, {"scale", 2}, {"published", {"pose.duration"}}};
  check_refused("thesis",
                [&](Json& t) {
                  t["fitted"] = Json::array();
                  for (int i = 0; i < 9; ++i) t["fitted"].push_back(pose);
                },
                {"9 constants", "8"});
  check_refused("thesis", [&](Json& t) { t["fitted"] = {pose, pose}; }, {"pose", "twice"});
  const auto with = [&](const char* key, const Json& value) {
    return [=](Json& t) {
      Json constant = pose;
      constant[key] = value;
      t["fitted"] = {constant};
    };
  };
  check_refused("thesis", with("scale", -2), {"'scale'", "constant 1"});
  check_refused("thesis", with("scale", 1000), {"'scale'"});
  check_refused("thesis", with("published", Json::array()), {"'published'"});
  check_refused("thesis", with("kernel", "nose"), {"'nose'", "unknown"});
  check_refused("thesis", with("unit", "poses"), {"'unit'", "unknown"});
  check_refused("thesis", with("optimisation", "O1"), {"'O1'", "O0 or O2"});
}

BOOST_AUTO_TEST_CASE(a_scaled_profile_needs_its_tables) {
  check_refused("thesis", [](Json& t) { t["tables"].erase("O0"); }, {"'O0'", "missing"});
  Tables tables;
  Json table = installed("a9-O0");
  table["kernels"].erase("threshold");
  tables.write("a9-O0", table);
  const std::string text = message([&] { tables.load("thesis"); });
  BOOST_TEST(text.find("a9-O0.json") != std::string::npos, text);
  BOOST_TEST(text.find("'threshold'") != std::string::npos, text);
}

BOOST_AUTO_TEST_CASE(a_table_is_for_one_optimisation) {
  const std::string text = message([] { load_cost_profile("a9-O0", Optimisation::o2); });
  BOOST_TEST(text.find("a9-O0.json") != std::string::npos, text);
  BOOST_TEST(text.find("-O0") != std::string::npos, text);
  BOOST_TEST(text.find("sw.opt") != std::string::npos, text);
}

BOOST_AUTO_TEST_CASE(unknown_and_broken_files_are_refused) {
  std::string text = message([] { load_cost_profile("tesis", std::nullopt); });
  BOOST_TEST(text.find("'thesis'") != std::string::npos, text);
  text = message([] { load_cost_profile("/nowhere/at/all.json", std::nullopt); });
  BOOST_TEST(text.find("cannot read profile") != std::string::npos, text);
  Tables tables;
  std::ofstream(tables.folder / "a9-O0.json") << "{\"version\": 1,";
  text = message([&] { tables.load("a9-O0"); });
  BOOST_TEST(text.find("this is not JSON") != std::string::npos, text);
}

BOOST_AUTO_TEST_SUITE_END()
