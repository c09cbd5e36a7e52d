// The earliest of numbered times, against a multimap that keeps all of them in order.
#include <vp/clock_scheduler.h>

#include <boost/test/unit_test.hpp>
#include <map>
#include <random>
#include <vector>

namespace {

constexpr std::uint64_t never = vp::Earliest::never;

/// The times in order, each with its place.
class Model {
 public:
  explicit Model(const std::vector<std::uint64_t>& times) {
    for (std::size_t i = 0; i < times.size(); ++i) at_.push_back(order_.emplace(times[i], i));
  }
  void set(std::size_t place, std::uint64_t time) {
    order_.erase(at_[place]);
    at_[place] = order_.emplace(time, place);
  }
  std::uint64_t time(std::size_t place) const { return at_[place]->first; }
  std::uint64_t earliest() const { return order_.empty() ? never : order_.begin()->first; }
  std::size_t count_until(std::uint64_t time) const {
    return static_cast<std::size_t>(std::distance(order_.begin(), order_.upper_bound(time)));
  }

 private:
  std::multimap<std::uint64_t, std::size_t> order_;
  std::vector<std::multimap<std::uint64_t, std::size_t>::iterator> at_;
};

vp::Earliest made_of(const std::vector<std::uint64_t>& times) {
  vp::Earliest earliest;
  for (const std::uint64_t time : times) earliest.push(time);
  return earliest;
}

/// What an owner may rely on at any time, also between set() and time().
void check_bounds(const vp::Earliest& earliest, const Model& model) {
  BOOST_TEST(earliest.bound() <= model.earliest());
  const std::uint64_t first = model.time(earliest.place());
  for (const std::uint64_t time : {model.earliest(), first, first + 3}) {
    if (!earliest.others_are_after(time)) continue;
    BOOST_TEST(model.count_until(time) <= (first <= time ? 1u : 0u), "at " << time);
  }
}

void check_found(vp::Earliest& earliest, const Model& model) {
  BOOST_TEST(earliest.time() == model.earliest());
  BOOST_TEST(model.time(earliest.place()) == model.earliest());
}

}  // namespace

BOOST_AUTO_TEST_SUITE(earliest)

BOOST_AUTO_TEST_CASE(without_places_there_is_no_time) {
  vp::Earliest none;
  BOOST_TEST(none.time() == never);
  none.push(3);
  none.erase(0);
  BOOST_TEST(none.time() == never);
}

BOOST_AUTO_TEST_CASE(it_is_found_after_any_moves) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    BOOST_TEST_CONTEXT("seed " << seed) {
      std::mt19937 random(seed);
      const std::size_t places = 1 + random() % 9;
      const unsigned spread = seed % 3 == 0 ? 3 : 1000;  // few times: many coincide
      const auto draw = [&] { return random() % 11 == 0 ? never : random() % spread; };
      std::vector<std::uint64_t> times;
      for (std::size_t i = 0; i < places; ++i) times.push_back(draw());
      Model model(times);
      vp::Earliest earliest = made_of(times);
      for (int step = 0; step < 2000; ++step) {
        const bool first = random() % 2 == 0;
        const std::size_t place = first ? earliest.place() : random() % places;
        const std::uint64_t time = draw();
        earliest.set(place, time);
        model.set(place, time);
        check_bounds(earliest, model);
        if (random() % 3 == 0) check_found(earliest, model);
      }
      for (std::size_t i = 0; i < places; ++i) BOOST_TEST(earliest[i] == model.time(i));
    }
  }
}

// As clocks do it: the first one moves on, others are moved now and then.
BOOST_AUTO_TEST_CASE(times_that_only_advance_are_visited_in_order) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    std::vector<std::uint64_t> times;
    for (std::size_t i = 0; i < 4; ++i) times.push_back(random() % 20);
    Model model(times);
    vp::Earliest earliest = made_of(times);
    std::uint64_t now = 0;
    for (int step = 0; step < 3000; ++step) {
      check_found(earliest, model);
      BOOST_TEST(earliest.time() >= now);
      now = earliest.time();
      const std::size_t place = random() % 8 == 0 ? random() % 4 : earliest.place();
      const std::uint64_t next = now + random() % 20;
      earliest.set(place, next);
      model.set(place, next);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
