#include <vp/progress.h>

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(progress)

BOOST_AUTO_TEST_CASE(shows_share_and_time_left) {
  BOOST_TEST(vp::progress_line("scenes", 5, 10, 12.0) ==
             "scenes  [###############...............]  50 %  5/10  12 s left");
  BOOST_TEST(vp::progress_line("scenes", 1, 11, 12.5) ==
             "scenes  [##............................]  9 %  1/11  2 min 5 s left");
  BOOST_TEST(vp::progress_line("scenes", 1, 2, 7260.0) ==
             "scenes  [###############...............]  50 %  1/2  2 h 1 min left");
}

BOOST_AUTO_TEST_CASE(knows_no_time_left_before_the_first_and_after_the_last) {
  BOOST_TEST(vp::progress_line("a", 0, 4, 3.0) == "a  [..............................]  0 %  0/4");
  BOOST_TEST(vp::progress_line("a", 4, 4, 3.0) ==
             "a  [##############################]  100 %  4/4");
}

BOOST_AUTO_TEST_CASE(nothing_to_do_and_too_much_done_are_complete) {
  BOOST_TEST(vp::progress_line("a", 0, 0, 3.0) ==
             "a  [##############################]  100 %  0/0");
  BOOST_TEST(vp::progress_line("a", 9, 4, 3.0) ==
             "a  [##############################]  100 %  4/4");
}

BOOST_AUTO_TEST_CASE(a_label_commands_no_terminal) {
  const std::string line = vp::progress_line("a\x1b[2J\nb", 1, 2, 1);
  BOOST_TEST(line.find("a\\x1b[2J\\nb  [") == 0u, line);
}

BOOST_AUTO_TEST_SUITE_END()
