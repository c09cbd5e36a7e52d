// The thesis' design as Vivado hands it off is the one that comes with the program.
#include <boost/test/unit_test.hpp>
#include <string>

#include "executable.h"
#include "thesis_handoff.h"

using namespace integration;

namespace {

/// The thesis' hand-off, imported into `mine`.
struct HandedOff : Workplace {
  explicit HandedOff(const std::string& text = kit::thesis_handoff().text()) {
    kit::write_file(*this / "thesis.hwh", text);
    imported = markervp({"import", "thesis.hwh", "-o", "mine"});
  }
  kit::Outcome markervp(const Arguments& arguments) const {
    return kit::run_process(MARKERVP_EXECUTABLE, arguments, path());
  }
  kit::Outcome run_imported(Arguments more = {}) const {
    Arguments all{"demo",      "z1.0",   "--design",   "mine/design.yaml",
                  "--program", "hybrid", "--no-report"};
    all.insert(all.end(), more.begin(), more.end());
    return run(all);
  }

  kit::Outcome imported;
};

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  BOOST_TEST_REQUIRE(at != std::string::npos, what);
  return text.replace(at, what.size(), by);
}

/// The same with objects of the logic named as in the built-in design.
Json with_names_of_built_in(const Json& part) {
  std::string text = part.dump();
  const std::string instance = "feature_extraction_0.";
  for (std::size_t at; (at = text.find(instance)) != std::string::npos;)
    text.erase(at, instance.size());
  return Json::parse(text);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(thesis_handoff)

BOOST_FIXTURE_TEST_CASE(its_models_give_words_times_and_verdict_of_the_built_in_design, HandedOff) {
  BOOST_TEST(imported.exit_code == 0, imported.err);
  BOOST_TEST(imported.out.find("10 parts, 0 stubs") != std::string::npos, imported.out);
  const kit::Outcome here = run_imported();
  BOOST_TEST_REQUIRE(here.exit_code == 0, here.out + here.err);
  const Json own = with_names_of_built_in(result());
  const kit::Outcome there = run({"demo", "z1.0", "--no-report"});
  BOOST_TEST_REQUIRE(there.exit_code == 0, there.out + there.err);
  const Json built_in = result();
  BOOST_TEST(built_in.at("frames").size() == 2u);
  for (const char* part : {"frames", "summary", "verdict", "resources", "power"})
    BOOST_TEST(own.at(part) == built_in.at(part), part);
}

BOOST_AUTO_TEST_CASE(its_parameters_are_those_of_the_models) {
  const HandedOff other(
      replaced(kit::thesis_handoff().text(), kit::parameter("BURST_WORDS", "32"),
               kit::parameter("BURST_WORDS", "16") + kit::parameter("LABELS", "64")));
  const kit::Outcome shown = other.markervp({"config", "--design", "mine/design.yaml"});
  BOOST_TEST(shown.out.find("label_count: 64") != std::string::npos, shown.out + shown.err);
  BOOST_TEST(shown.out.find("burst_words: 16") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(what_its_programs_need_around_it_is_named_where_it_is_missing) {
  const HandedOff other(
      replaced(kit::thesis_handoff().text(), kit::pin("I", "gpio_in", "control", 32), ""));
  const kit::Outcome outcome = other.run_imported();
  BOOST_TEST(outcome.exit_code == 2);
  BOOST_TEST(outcome.err.find("feature_extraction_0: its programs need an axi_gpio at its pin "
                              "gpio_in") != std::string::npos,
             outcome.err);
}

BOOST_AUTO_TEST_SUITE_END()
