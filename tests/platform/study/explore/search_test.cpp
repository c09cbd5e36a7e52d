#include <study/explore/search.h>

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <set>

using namespace platform::explore;

namespace {

/// Genomes of a search in the unit square, generation by generation.
struct Hunt {
  using Judge = Judgement (*)(const Genome&);

  Hunt(std::vector<Coordinate> coordinates, std::uint64_t seed, Judge judge, int generations)
      : search(std::move(coordinates), 20, seed) {
    for (int i = 0; i < generations; ++i) {
      std::vector<Genome> batch;
      search.breed(20, [&](const Genome& genome) {
        if (!all.insert(genome).second) return false;
        batch.push_back(genome);
        return true;
      });
      for (const Genome& genome : batch) {
        const Judgement found = judge(genome);
        front.add(found);
        search.judge(genome, found);
      }
      search.select();
    }
  }

  Search search;
  Front front;
  std::set<Genome> all;
};

/// Zitzler's first function in two dimensions: the front is the edge where the second is 0.
Judgement zdt1(const Genome& x) {
  const double g = 1 + 9 * x[1];
  return {{x[0], g * (1 - std::sqrt(x[0] / g))}, 0};
}

/// The nearer to the corner (1, 1) the better, and only within a small circle around it.
Judgement circle(const Genome& x) {
  const double distance = std::hypot(1 - x[0], 1 - x[1]);
  return {{distance}, std::max(0.0, distance - 0.05)};
}

/// The third of five choices, and the middle of the line.
Judgement third(const Genome& x) {
  return {{std::fabs(x[0] - 2) + std::fabs(x[1] - 0.5)}, 0};
}

}  // namespace

BOOST_AUTO_TEST_SUITE(search)

BOOST_AUTO_TEST_CASE(a_front_is_found) {
  const Hunt hunt({{}, {}}, 1, zdt1, 40);
  BOOST_TEST(hunt.front.size() > 20u);
  // The distance of the front's points from the true one.
  double worst = 0;
  for (const auto& costs : hunt.front.costs())
    worst = std::max(worst, costs[1] - (1 - std::sqrt(costs[0])));
  BOOST_TEST(worst < 0.05);
}

BOOST_AUTO_TEST_CASE(the_seed_decides) {
  const Hunt first({{}, {}}, 3, zdt1, 5), again({{}, {}}, 3, zdt1, 5), other({{}, {}}, 4, zdt1, 5);
  BOOST_TEST((first.all == again.all));
  BOOST_TEST((first.all != other.all));
}

BOOST_AUTO_TEST_CASE(what_violates_less_leads_to_what_is_feasible) {
  const Hunt hunt({{}, {}}, 1, circle, 25);
  BOOST_REQUIRE(hunt.front.size() == 1u);
  BOOST_TEST(hunt.front.violation() == 0);
  BOOST_TEST(hunt.front.costs().front().front() < 0.02);
}

BOOST_AUTO_TEST_CASE(a_feasible_genome_beats_any_other) {
  Search search({{}}, 1, 1);
  search.judge({0.1}, {{}, 1e-9});
  search.judge({0.9}, {{1e12}, 0});
  search.select();
  // Both parents are the survivor: what they have in common, most children have.
  int near = 0;
  search.breed(40, [&](const Genome& genome) {
    near += std::fabs(genome[0] - 0.9) < 0.3 ? 1 : 0;
    return true;
  });
  BOOST_TEST(near > 30);
}

BOOST_AUTO_TEST_CASE(choices_are_whole_numbers_wherever_they_stand) {
  const Hunt hunt({{5}, {}}, 1, third, 20);
  for (const Genome& genome : hunt.all) {
    BOOST_TEST(genome[0] == std::floor(genome[0]));
    BOOST_TEST(genome[0] >= 0);
    BOOST_TEST(genome[0] <= 4);
    BOOST_TEST(genome[1] >= 0);
    BOOST_TEST(genome[1] <= 1);
  }
  BOOST_TEST(hunt.front.costs().front().front() < 0.01);
}

BOOST_AUTO_TEST_CASE(a_space_without_more_points_ends_the_search) {
  Search search({{3}, {2}}, 4, 1);
  std::set<Genome> seen;
  const auto take = [&](const Genome& genome) { return seen.insert(genome).second; };
  BOOST_TEST(search.breed(100, take) == 6u);
  for (const Genome& genome : seen) search.judge(genome, {{genome[0], genome[1]}, 0});
  search.select();
  BOOST_TEST(search.breed(1, take) == 0u);
}

BOOST_AUTO_TEST_CASE(of_equal_costs_one_is_on_the_front) {
  Front front;
  front.add({{1, 2}, 0});
  front.add({{1, 2}, 0});
  front.add({{2, 1}, 0});
  front.add({{2, 2}, 0});
  front.add({{0, 0}, 0.5});
  BOOST_TEST(front.size() == 2u);
}

BOOST_AUTO_TEST_CASE(the_hypervolume_is_a_part_of_the_box) {
  Front front;
  BOOST_TEST(front.hypervolume() == 0);
  BOOST_TEST(front.violation() > 1e9);
  front.add({{}, 0.25});
  BOOST_TEST(front.hypervolume() == 0);
  BOOST_TEST(front.violation() == 0.25);
  front.add({{10, 200}, 0});
  front.add({{20, 100}, 0});
  // Two rectangles of 1.1 by 0.1, which share 0.1 by 0.1.
  BOOST_TEST(front.hypervolume() == 0.21 / 1.21, boost::test_tools::tolerance(1e-12));
  const double alone = front.hypervolume_of({{10, 200}});
  BOOST_TEST(alone == 0.11 / 1.21, boost::test_tools::tolerance(1e-12));
  Front line;
  line.add({{3}, 0});
  line.add({{5}, 0});
  BOOST_TEST(line.hypervolume() == 1);
}

BOOST_AUTO_TEST_SUITE_END()
