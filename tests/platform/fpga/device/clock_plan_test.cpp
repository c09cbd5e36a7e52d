// What the vendor's tool made of wishes, and what can be made at all.
#include <fpga/device/clock_plan.h>

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <fstream>
#include <sstream>

#include <vp/error.h>
#include <vp/text.h>

using namespace platform::device;

namespace {

constexpr double mhz = 1e6;

std::vector<std::vector<std::string>> rows_of(const std::string& name) {
  std::ifstream file(std::string(MARKERVP_TEST_DATA) + "/device/" + name);
  std::vector<std::vector<std::string>> rows;
  bool header = true;
  for (std::string line; std::getline(file, line);) {
    if (line.front() == '#') continue;
    if (!header) rows.push_back(vp::split(line, ','));
    header = false;
  }
  return rows;
}

const Device& of_grade(const std::string& grade) {
  return find_device("xc7z020-" + (grade.empty() ? "1" : grade));
}

/// "ENET0=125 FPGA0=100 …"
std::vector<IoClient> clients_of(const std::string& text) {
  std::vector<IoClient> clients;
  for (const std::string& word : vp::split(text, ' ')) {
    const bool ethernet = word.rfind("ENET", 0) == 0;
    const bool pair = ethernet || word.rfind("FPGA", 0) == 0;
    clients.push_back({std::stod(word.substr(word.find('=') + 1)) * mhz,
                       pair ? Divider::pair : Divider::single, ethernet});
  }
  return clients;
}

/// One clock of clock_pairs.csv.
struct Pair {
  explicit Pair(const std::vector<std::string>& row)
      : clock(row.at(0)),
        wish(std::stod(row.at(1)) * mhz),
        actual(std::stod(row.at(2)) * mhz),
        feedback(static_cast<unsigned>(std::stoul(row.at(4)))),
        divisor0(static_cast<unsigned>(std::stoul(row.at(5)))),
        divisor1(static_cast<unsigned>(std::stoul(row.at(6)))),
        crystal(std::stod(row.at(7)) * mhz),
        device(of_grade(row.at(8))),
        exception(row.at(9)),
        where(row.at(0) + " " + row.at(1) + " of " + row.at(10)) {}

  MadeClock made() const {
    const ClockPlanner planner(device, crystal);
    if (clock == "FPGA") return planner.nearest(feedback, wish, Divider::pair);
    return planner.own_pll(wish, clock == "APU" ? ClockKind::cpu_621 : ClockKind::ddr);
  }

  std::string clock;
  double wish, actual;
  unsigned feedback, divisor0, divisor1;
  double crystal;
  const Device& device;
  std::string exception, where;
};

bool gives(const MadeClock& made, const Pair& pair) {
  return std::abs(made.hz - pair.actual) <= 100;  // four digits are printed
}

/// Of a ZedBoard with the clocks of the thesis.
ClockPlan zedboard(const ClockPlanner& planner, bool ethernet = true) {
  ClockWishes wishes;
  wishes.fclk_hz = {100 * mhz, 50 * mhz};
  wishes.ethernet = ethernet;
  return planner.plan(wishes);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(clock_plan)

BOOST_AUTO_TEST_CASE(every_pair_of_public_designs_is_reproduced_but_the_exceptions) {
  std::size_t reproduced = 0, exceptions = 0;
  for (const auto& row : rows_of("clock_pairs.csv")) {
    const Pair pair(row);
    const MadeClock made = pair.made();
    const bool same = gives(made, pair) && made.feedback == pair.feedback &&
                      made.divisor0 == pair.divisor0 && made.divisor1 == pair.divisor1;
    BOOST_TEST(same == pair.exception.empty(), pair.where << ": " << made.hz << " Hz, x"
                                                          << made.feedback << " / " << made.divisor0
                                                          << " / " << made.divisor1);
    ++(pair.exception.empty() ? reproduced : exceptions);
  }
  BOOST_TEST(reproduced == 57u);
  BOOST_TEST(exceptions == 9u);
}

BOOST_AUTO_TEST_CASE(how_a_divisor_is_split_never_changes_the_frequency) {
  std::size_t seen = 0;
  for (const auto& row : rows_of("clock_pairs.csv")) {
    const Pair pair(row);
    if (pair.exception.find("the frequency is the same") == std::string::npos) continue;
    BOOST_TEST(gives(pair.made(), pair), pair.where);
    ++seen;
  }
  BOOST_TEST(seen == 5u);
}

BOOST_AUTO_TEST_CASE(an_arm_pll_that_feeds_ethernet_too_gives_500_mhz) {
  const ClockPlanner planner(find_device("xc7z020-1"), 33.333333 * mhz);
  const MadeClock cpu =
      planner.own_pll(666.666666 * mhz, ClockKind::cpu_621, {{125 * mhz, Divider::pair, true}});
  BOOST_TEST(cpu.feedback == 30u);  // 1500 MHz / 2 would be nearer, and above the grade's limit
  BOOST_TEST(cpu.divisor0 == 2u);
}

BOOST_AUTO_TEST_CASE(the_io_pll_of_every_public_design_is_reproduced_but_the_exceptions) {
  std::size_t reproduced = 0, exceptions = 0;
  for (const auto& row : rows_of("io_pll.csv")) {
    const ClockPlanner planner(of_grade(row.at(1)), std::stod(row.at(0)) * mhz);
    const bool same = planner.io_feedback(clients_of(row.at(3))) == std::stoul(row.at(2));
    const bool exception = !row.at(4).empty();
    BOOST_TEST(same != exception, row.at(3) << " of " << row.at(5));
    ++(exception ? exceptions : reproduced);
  }
  BOOST_TEST(reproduced == 81u);
  BOOST_TEST(exceptions == 3u);
}

BOOST_AUTO_TEST_CASE(of_55_mhz_comes_55_556_or_55_172) {
  const ClockPlanner planner(find_device("xc7z020-1"), zedboard_crystal_hz);
  const MadeClock with_ethernet = planner.nearest(30, 55 * mhz, Divider::pair);
  BOOST_TEST(std::llround(with_ethernet.hz) == 55'555'556);
  BOOST_TEST(with_ethernet.divisor0 == 18u);
  BOOST_TEST(with_ethernet.divisor1 == 1u);
  BOOST_TEST(std::llround(planner.nearest(48, 55 * mhz, Divider::pair).hz) == 55'172'414);
  BOOST_TEST(std::llround(planner.nearest(30, 160 * mhz, Divider::pair).hz) == 166'666'667);
}

BOOST_AUTO_TEST_CASE(the_thesis_clocks_are_made_exactly) {
  for (const std::string grade : {"1", "2", "3"}) {
    const ClockPlanner planner(of_grade(grade), zedboard_crystal_hz);
    const ClockPlan plan = zedboard(planner);
    BOOST_TEST(plan.io_feedback == (grade == "3" ? 60u : 30u));
    BOOST_TEST(std::llround(plan.fclk.at(0).hz) == 100'000'000);
    BOOST_TEST(std::llround(plan.fclk.at(1).hz) == 50'000'000);
    BOOST_TEST(std::llround(plan.cpu.hz) == 666'666'667);
    BOOST_TEST(plan.cpu.feedback == 40u);
    BOOST_TEST(std::llround(plan.ddr.hz) == 533'333'333);
    BOOST_TEST(plan.ddr.feedback == 32u);
    BOOST_TEST(std::llround(plan.uart.hz) == 50'000'000);
  }
}

BOOST_AUTO_TEST_CASE(a_cpu_clock_stays_within_the_grade_unless_the_wish_does_not) {
  const ClockPlanner planner(find_device("xc7z020-1"), 50 * mhz);
  // 675 MHz is nearer, and made for -2 (ZynqStereoSystem).
  BOOST_TEST(planner.own_pll(666.666666 * mhz, ClockKind::cpu_621).hz == 650 * mhz);
  BOOST_TEST(planner.own_pll(700 * mhz, ClockKind::cpu_621).hz == 700 * mhz);
  // No PLL of this grade gives more.
  BOOST_TEST(planner.own_pll(1000 * mhz, ClockKind::cpu_621).hz == 800 * mhz);
  // UG585: the divisor 3 is not allowed, so 1600 MHz / 3 is none.
  const ClockPlanner third(find_device("xc7z020-1"), zedboard_crystal_hz);
  BOOST_TEST(std::llround(third.own_pll(533'333'333, ClockKind::cpu_421).hz) == 533'333'333);
  BOOST_TEST(third.own_pll(533'333'333, ClockKind::cpu_421).divisor0 == 2u);
}

BOOST_AUTO_TEST_CASE(neighbours_lie_on_both_sides) {
  const ClockPlanner planner(find_device("xc7z020-1"), zedboard_crystal_hz);
  const ClockPlan plan = zedboard(planner);
  const auto around = [&](double wish, ClockKind kind) {
    const auto found = planner.neighbours(wish, kind, plan);
    return std::pair(found.below ? std::llround(found.below->hz) : 0,
                     found.above ? std::llround(found.above->hz) : 0);
  };
  BOOST_TEST((around(55 * mhz, ClockKind::fclk) == std::pair(52'631'579LL, 55'555'556LL)));
  BOOST_TEST((around(50 * mhz, ClockKind::fclk) == std::pair(50'000'000LL, 52'631'579LL)));
  BOOST_TEST((around(250 * mhz, ClockKind::fclk) == std::pair(250'000'000LL, 0LL)), "the limit");
  BOOST_TEST((around(260 * mhz, ClockKind::fclk) == std::pair(250'000'000LL, 333'333'333LL)));
  BOOST_TEST((around(2000 * mhz, ClockKind::fclk) == std::pair(1'000'000'000LL, 0LL)));
  BOOST_TEST(around(1000, ClockKind::fclk).first == 0);
  BOOST_TEST((around(610 * mhz, ClockKind::cpu_621) == std::pair(600'000'000LL, 616'666'667LL)));
  BOOST_TEST((around(530 * mhz, ClockKind::ddr) == std::pair(516'666'667LL, 533'333'333LL)));
  BOOST_TEST(planner.nearest(30, 1000, Divider::pair).divisor0 == 63u);
  BOOST_TEST(planner.nearest(30, 2000 * mhz, Divider::pair).hz == 1000 * mhz);
}

BOOST_AUTO_TEST_CASE(what_can_be_made_is_listed_best_first) {
  const ClockPlanner planner(find_device("xc7z020-1"), zedboard_crystal_hz);
  const ClockPlan plan = zedboard(planner);
  const auto list = planner.near(55 * mhz, ClockKind::fclk, plan, true, 200);
  BOOST_TEST(list.size() == 200u);
  double last = 0;
  for (const NearClock& n : list) {
    const double off = std::abs(n.clock.hz - 55 * mhz);
    BOOST_TEST(off >= last - 1);
    last = off;
    BOOST_TEST(planner.makes(n.clock.hz, ClockKind::fclk));
    const double product = n.clock.divisor0 * n.clock.divisor1;
    BOOST_TEST(std::abs(zedboard_crystal_hz * n.clock.feedback / product - n.clock.hz) < 1e-3);
    BOOST_TEST(n.clock.vco_hz >= 780 * mhz);
    BOOST_TEST(n.clock.vco_hz <= 1600 * mhz * (1 + 1e-9));
  }
  // 1100 MHz / 20; Ethernet would have 122 or 137 MHz.
  BOOST_TEST(list.front().clock.feedback == 33u);
  BOOST_TEST((list.front().effort == Effort::no_ethernet));
  for (const NearClock& n : planner.near(249 * mhz, ClockKind::fclk, plan, true, 50)) {
    BOOST_TEST(n.clock.hz <= 250.02 * mhz, "above the limit");
  }
  for (const NearClock& n : planner.near(600 * mhz, ClockKind::cpu_621, plan, true, 50)) {
    BOOST_TEST((n.clock.pll == Pll::arm));
    BOOST_TEST((n.effort == Effort::planned));
    BOOST_TEST(n.clock.hz <= 667.1 * mhz, "above the limit");
  }
}

BOOST_AUTO_TEST_CASE(each_frequency_is_made_with_the_least_effort) {
  const ClockPlanner planner(find_device("xc7z020-1"), zedboard_crystal_hz);
  const auto first = [&](double wish, bool ethernet = true) {
    return planner.near(wish, ClockKind::fclk, zedboard(planner, ethernet), ethernet, 1).front();
  };
  BOOST_TEST((first(50 * mhz).effort == Effort::planned));
  BOOST_TEST(first(50 * mhz).clock.feedback == 30u);
  BOOST_TEST((first(83'333'333).effort == Effort::planned));  // 1000 / 12, and 1333.33 / 16
  const NearClock from_arm = first(1333.333333 * mhz / 27);
  BOOST_TEST((from_arm.effort == Effort::other_source));
  BOOST_TEST((from_arm.clock.pll == Pll::arm));
  const NearClock from_ddr = first(1066.666667 * mhz / 19);
  BOOST_TEST((from_ddr.effort == Effort::other_source));
  BOOST_TEST((from_ddr.clock.pll == Pll::ddr));
  BOOST_TEST((first(1500 * mhz / 29).effort == Effort::other_feedback));
  BOOST_TEST((first(55 * mhz).effort == Effort::no_ethernet));
  BOOST_TEST((first(55 * mhz, false).effort == Effort::other_feedback));
}

BOOST_AUTO_TEST_CASE(clocks_are_judged_with_their_margin) {
  const ClockPlanner slow(find_device("xc7z020-1"), zedboard_crystal_hz);
  const auto check = [&](ClockKind kind, double hz, bool within, bool makeable, double margin) {
    BOOST_TEST_CONTEXT(hz) {
      const ClockVerdict verdict = judge(slow, kind, hz);
      BOOST_TEST(verdict.within == within);
      BOOST_TEST(verdict.makeable == makeable);
      BOOST_TEST(verdict.legal() == (within && makeable));
      BOOST_TEST(std::abs(verdict.margin_percent - margin) < 0.001, verdict.margin_percent);
    }
  };
  check(ClockKind::fclk, 50 * mhz, true, true, 400);
  check(ClockKind::fclk, 55 * mhz, true, true, 354.5454);  // by another plan than the board's
  check(ClockKind::fclk, 57.123456 * mhz, true, false, 337.6486);
  check(ClockKind::fclk, 333'333'333, false, true, -25);
  check(ClockKind::external, 57.123456 * mhz, true, true, 712.2757);
  check(ClockKind::external, 464 * mhz, true, true, 0);
  check(ClockKind::external, 500 * mhz, false, true, -7.2);
  check(ClockKind::cpu_621, 666'666'667, true, true, 0.05);
  check(ClockKind::cpu_421, 666'666'667, false, true, -19.9999);
  check(ClockKind::cpu_621, 1000 * mhz, false, false, -33.3);
  check(ClockKind::ddr, 533'333'333, true, true, 0.00013);
  check(ClockKind::fclk, 0, true, true, 0);
  BOOST_TEST((judge(slow, ClockKind::fclk, mhz).confidence == Confidence::assumed));
  BOOST_TEST((judge(slow, ClockKind::cpu_621, mhz).confidence == Confidence::published));
  // What the faster grades print as 766 and 866 MHz.
  for (const auto& [name, hz] :
       {std::pair{"xc7z020-2", 766'666'667.0}, std::pair{"xc7z020-3", 866'666'667.0}}) {
    const ClockPlanner fast(find_device(name), zedboard_crystal_hz);
    BOOST_TEST(judge(fast, ClockKind::cpu_621, hz).legal(), name);
  }
}

BOOST_AUTO_TEST_CASE(a_crystal_that_the_chip_does_not_take_is_refused) {
  const Device& device = find_device("xc7z020-1");
  for (const double bad : {0.0, -1.0, 29 * mhz, 61 * mhz, std::nan("")}) {
    BOOST_CHECK_THROW(ClockPlanner(device, bad), vp::InputError);
  }
  BOOST_CHECK_NO_THROW(ClockPlanner(device, 30 * mhz));
  BOOST_CHECK_NO_THROW(ClockPlanner(device, 60 * mhz));
  try {
    ClockPlanner(device, 5 * mhz);
  } catch (const vp::InputError& error) {
    BOOST_TEST(std::string(error.what()).find("xc7z020-1 takes 30 to 60 MHz") != std::string::npos,
               error.what());
  }
}

BOOST_AUTO_TEST_CASE(where_ethernet_cannot_be_met_the_rest_is_planned) {
  // 37 MHz x n / d is never 125 MHz within the PLL's range.
  const ClockPlanner planner(find_device("xc7z020-1"), 37 * mhz);
  const unsigned feedback = planner.io_feedback(board_clients(true));
  const unsigned without = planner.io_feedback(board_clients(false));
  BOOST_TEST(feedback >= 22u);
  BOOST_TEST(feedback <= 43u);
  BOOST_TEST(without >= 22u);
}

BOOST_AUTO_TEST_SUITE_END()
