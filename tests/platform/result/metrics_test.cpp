#include <result/figures.h>

#include <boost/test/unit_test.hpp>

#include "input_error.h"

namespace result = platform::result;

BOOST_AUTO_TEST_SUITE(metric_catalogue)

BOOST_AUTO_TEST_CASE(a_metric_has_unit_and_meaning) {
  BOOST_TEST(result::unit_of_metric("summary.fps.mean") == "1/s");
  BOOST_TEST(result::unit_of_metric("power.modules.pl.blob_detection.w") == "W");
  BOOST_TEST(result::unit_of_metric("frames.time_us.pose.max") == "µs");
  BOOST_TEST(result::unit_of_metric("timing.met") == "");
  BOOST_TEST(result::unit_of_metric("power.total_w.nominal / summary.fps.mean") == "");
  BOOST_TEST(result::figures().of("frames.time_us.pose.mean")->meaning == "time of a stage");
}

BOOST_AUTO_TEST_CASE(what_is_no_metric_is_refused_with_the_nearest) {
  for (const char* wrong : {"summary.fps.men", "frames.markers", "power.modules..w", "clock"})
    BOOST_TEST(result::figures().of(wrong) == nullptr, wrong);
  BOOST_TEST(input_error([] { result::check_metric("summary.fps.men", {}); }) ==
             "unknown metric 'summary.fps.men'; did you mean 'summary.fps.mean'?");
  BOOST_TEST(input_error([] { result::check_metric("pl.widht", {"pl.width"}); }) ==
             "unknown metric 'pl.widht'; did you mean 'pl.width'?");
  result::check_metric("pl.width", {"pl.width"});
}

BOOST_AUTO_TEST_CASE(the_table_shows_what_is_asked_for) {
  const std::string table = result::metric_table("fps");
  BOOST_TEST(table.find("summary.fps.min") != std::string::npos, table);
  BOOST_TEST(table.find("power") == std::string::npos, table);
  BOOST_TEST(result::metric_table("frames.time_us.pose.mean").find("time of a stage") !=
             std::string::npos);
  BOOST_TEST(input_error([] {
               result::metric_table("sumary.fps.mean");
             }).find("summary.fps.mean") != std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
