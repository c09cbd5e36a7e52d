// How long bits have which value, and how often they turn.
#include <vp/net_activity.h>

#include <boost/test/unit_test.hpp>

using vp::NetActivity;

BOOST_AUTO_TEST_SUITE(net_activity)

BOOST_AUTO_TEST_CASE(times_add_up_to_the_whole_and_only_turns_between_0_and_1_count) {
  NetActivity net(2);
  net.change("0h", 10);
  net.change("1", 30);  // 01
  net.change("zz", 40);
  net.change("11", 45);  // from z: no turn
  net.change("0l", 50);
  net.settle(60);
  const NetActivity::Bit &left = net.bits().at(0), &right = net.bits().at(1);
  BOOST_TEST((left.unknown == 10u && right.unknown == 10u));
  BOOST_TEST((left.low == 30u + 10u && left.high == 5u && left.floating == 5u));
  BOOST_TEST((right.low == 10u && right.high == 30u + 5u && right.floating == 5u));
  BOOST_TEST((left.toggles == 1u && right.toggles == 1u));
  BOOST_TEST(net.toggles() == 2u);
}

BOOST_AUTO_TEST_CASE(a_restart_keeps_the_values_and_forgets_the_rest) {
  NetActivity net(1);
  net.change("0", 0);
  net.change("1", 5);
  net.restart(7);
  net.settle(9);
  BOOST_TEST(net.toggles() == 0u);
  BOOST_TEST((net.bits().at(0).high == 2u && net.bits().at(0).low == 0u));
}

BOOST_AUTO_TEST_CASE(what_is_no_value_of_the_net_is_x) {
  NetActivity net(2);
  net.change("00", 0);
  net.change("111", 4);
  net.change("", 5);
  net.change("00", 6);
  net.settle(6);
  BOOST_TEST(net.toggles() == 0u);
  BOOST_TEST((net.bits().at(0).low == 4u && net.bits().at(0).unknown == 2u));
}

BOOST_AUTO_TEST_SUITE_END()
