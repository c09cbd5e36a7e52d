// Other people's programs understand our files.
#include <boost/test/unit_test.hpp>
#include <cstdlib>

#include "counter_platform.h"

namespace {

bool gtkwave_is_installed(boost::unit_test::test_unit_id) {
  return std::system("command -v vcd2fst >/dev/null && command -v fst2vcd >/dev/null") == 0;
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(trace_tools, TraceFixture)

BOOST_AUTO_TEST_CASE(gtkwave_converts_a_trace_and_gives_it_back,
                     *boost::unit_test::precondition(gtkwave_is_installed)) {
  options.level = vp::TraceLevel::registers;
  options.clocks = true;
  const VcdCheck ours(run(300'000));
  const std::string vcd = options.file.string();
  const std::string back = folder / "back.vcd";
  BOOST_TEST_REQUIRE(
      std::system(("vcd2fst " + vcd + " " + vcd + ".fst >" + vcd + ".log 2>&1 && fst2vcd -f " +
                   vcd + ".fst -o " + back + " >>" + vcd + ".log 2>&1")
                      .c_str()) == 0);
  const VcdCheck theirs(VcdCheck::text_of(back), false);
  BOOST_TEST(theirs.variables().size() == ours.variables().size());
  for (const auto& [path, variable] : ours.variables()) {
    BOOST_TEST(theirs.variable(path).type == variable.type);
    BOOST_TEST(theirs.variable(path).width == variable.width);
    BOOST_TEST((theirs.variable(path).changes == variable.changes), path);
  }
  BOOST_TEST(theirs.end_ps() == ours.end_ps());
}

BOOST_AUTO_TEST_SUITE_END()
