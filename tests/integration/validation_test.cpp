// `markervp validate` as users run it: the verdict, the page of the documentation, and that it
// fails.
#include <boost/test/unit_test.hpp>
#include <fstream>
#include <functional>

#include "executable.h"

using namespace integration;

namespace {

const std::filesystem::path source = MARKERVP_SOURCE;

kit::Outcome validate(const Workplace& workplace, Arguments arguments) {
  arguments.insert(arguments.begin(), {"validate", "--output", "v"});
  return kit::run_process(MARKERVP_EXECUTABLE, arguments, workplace.path());
}

Json profile(const std::string& name) {
  return Json::parse(std::ifstream(source / "data/profiles" / (name + ".json")));
}

/// Writes the installed profiles into the folder, one of them changed.
void write_profiles(const Workplace& workplace, const std::string& changed,
                    const std::function<void(Json&)>& change) {
  for (const char* name : {"thesis", "a9-O0", "a9-O2"}) {
    Json content = profile(name);
    if (name == changed) change(content);
    std::ofstream(workplace / (std::string(name) + ".json")) << content.dump(1);
  }
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(validation)

BOOST_AUTO_TEST_CASE(chapter_5_is_reproduced_and_the_page_is_up_to_date) {
  const Workplace workplace;
  const kit::Outcome outcome = validate(workplace, {"--markdown", "docs/validation.md"});
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  BOOST_TEST(contains(outcome.out, "validation passed"));
  const Json json = Json::parse(kit::read_file(workplace / "v/validation.json"));
  BOOST_TEST(json.at("passed").get<bool>());
  BOOST_TEST(json.at("images").get<int>() == 316);
  BOOST_TEST(json.at("fitted").size() <= 8u);
  for (const Json& gate : json.at("gates")) {
    BOOST_TEST(gate.at("passed").get<bool>(), gate.at("name").get<std::string>());
  }
  BOOST_TEST(kit::read_file(workplace / "docs/validation.md") ==
                 kit::read_file(source / "docs/validation.md"),
             "docs/validation.md is old: markervp validate --markdown docs/validation.md");
}

BOOST_AUTO_TEST_CASE(a_doctored_profile_fails_the_gate) {
  const Workplace workplace;
  write_profiles(workplace, "thesis", [](Json& thesis) { thesis["fitted"][0]["scale"] = 2.0; });
  const kit::Outcome outcome = validate(workplace, {"--profile", "thesis.json"});
  BOOST_TEST(outcome.exit_code == 1, outcome.err);
  BOOST_TEST(contains(outcome.out, "validation FAILED"));
  BOOST_TEST(contains(outcome.out, "missed: "));
  BOOST_TEST(contains(outcome.out, "corner.delta"));
}

BOOST_AUTO_TEST_CASE(bad_cost_tables_are_refused_with_the_entry) {
  const struct {
    const char* file;
    const char* part;
    std::function<void(Json&)> change;
  } cases[] = {
      {"a9-O0", "'threshold'", [](Json& p) { p["kernels"].erase("threshold"); }},
      {"a9-O0", "'posit_iterations'",
       [](Json& p) { p["kernels"]["pose"]["units"]["posit_iterations"]["cycles"] = -1; }},
      {"a9-O0", "'poses'",
       [](Json& p) { p["kernels"]["pose"]["units"]["poses"]["cycles"] = 1e12; }},
      {"a9-O0", "version", [](Json& p) { p["version"] = 2; }},
      {"thesis", "fitted constant 1", [](Json& p) { p["fitted"][0]["scale"] = -3; }},
  };
  for (const auto& [file, part, change] : cases) {
    BOOST_TEST_CONTEXT(part) {
      const Workplace workplace;
      write_profiles(workplace, file, change);
      const kit::Outcome outcome = validate(workplace, {"--profile", "thesis.json"});
      BOOST_TEST(outcome.exit_code == 2);
      BOOST_TEST(contains(outcome.err, part), outcome.err);
      BOOST_TEST(contains(outcome.err, std::string(file) + ".json"), outcome.err);
      BOOST_TEST(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1, outcome.err);
      BOOST_TEST(!std::filesystem::exists(workplace / "v/validation.json"));
    }
  }
}

BOOST_AUTO_TEST_CASE(wrong_options_are_refused) {
  const Workplace workplace;
  BOOST_TEST(validate(workplace, {"--repetitions", "0"}).exit_code == 2);
  BOOST_TEST(validate(workplace, {"--jobs", "9"}).exit_code == 2);
  BOOST_TEST(validate(workplace, {"--profile", "thesiss"}).exit_code == 2);
  BOOST_TEST(validate(workplace, {"--set", "pl.nothing=1"}).exit_code == 2);
  BOOST_TEST(validate(workplace, {"demo"}).exit_code == 2);
}

BOOST_AUTO_TEST_SUITE_END()
