// Accesses of two cores that nothing orders, and what orders them.

#include "cores_bench.h"

using namespace bench;
using namespace bench::two_cores;

BOOST_FIXTURE_TEST_SUITE(races, Fresh)

namespace {

std::uint32_t table[8];

void write_table(std::uint32_t first, std::uint32_t words) {
  hal_shared_write(&table[first], words * sizeof table[0]);
}
void read_table(std::uint32_t first, std::uint32_t words) {
  hal_shared_read(&table[first], words * sizeof table[0]);
}

std::size_t races_of(void (*second)(), void (*first)()) {
  TwoCores b;
  b.run([=] {
    write_table(0, 8);  // nothing else runs yet
    hal_cpu_start(1, second);
    first();
    hal_work(step, 10'000);
    return 0;
  });
  return b.reports.count("/markervp/cpu/race");
}

}  // namespace

BOOST_AUTO_TEST_CASE(accesses_that_nothing_orders) {
  TwoCores b;
  b.run([] {
    hal_cpu_start(1, [] {
      for (int i = 0; i < 3; ++i) write_table(2, 2);
    });
    hal_work(step, 1'000);
    hal_barrier();
    for (int i = 0; i < 3; ++i) read_table(0, 3);
    return 0;
  });
  BOOST_TEST(b.reports.count("/markervp/cpu/race") == 1u);
  const std::string& text = b.reports.warnings().front().message;
  BOOST_TEST(says(text, "cpu reads 12 bytes, some of which cpu1 wrote at 120 ns"));
}

BOOST_AUTO_TEST_CASE(two_writes_race_and_two_reads_do_not) {
  BOOST_TEST(races_of([] { write_table(0, 1); }, [] { write_table(0, 1); }) == 1u);
  BOOST_TEST(races_of([] { read_table(0, 8); }, [] { read_table(0, 8); }) == 0u);
  BOOST_TEST(races_of([] { read_table(0, 1); }, [] { write_table(0, 1); }) == 1u);
}

BOOST_AUTO_TEST_CASE(bytes_beside_each_other_are_no_race) {
  BOOST_TEST(races_of([] { write_table(0, 4); }, [] { write_table(4, 4); }) == 0u);
  BOOST_TEST(races_of([] { write_table(0, 5); }, [] { write_table(4, 4); }) == 1u);
}

BOOST_AUTO_TEST_CASE(a_lock_orders) {
  constexpr auto guarded = [] {
    hal_lock_acquire(&results);
    write_table(0, 8);
    hal_lock_release(&results);
  };
  BOOST_TEST(races_of(guarded, guarded) == 0u);
  // Another one does not.
  BOOST_TEST(races_of(guarded, [] {
               hal_lock_acquire(&other);
               write_table(0, 8);
               hal_lock_release(&other);
             }) == 1u);
}

BOOST_AUTO_TEST_CASE(a_word_orders_what_was_before_it) {
  constexpr auto await = [] {
    await_word();
    write_table(0, 8);
  };
  BOOST_TEST(races_of(await, [] {
               write_table(0, 8);
               set_word();
             }) == 0u);
  word = 0;
  BOOST_TEST(races_of(await, [] {
               set_word();
               write_table(0, 8);
             }) == 1u);
}

BOOST_AUTO_TEST_CASE(an_event_orders_what_was_before_it) {
  constexpr auto await = [] {
    hal_wait_for_event();
    write_table(0, 8);
  };
  BOOST_TEST(races_of(await, [] {
               hal_work(step, 500);
               write_table(0, 8);
               hal_send_event();
             }) == 0u);
}

BOOST_AUTO_TEST_CASE(an_exclusive_word_orders) {
  constexpr auto publish = [] {
    write_table(0, 8);
    hal_load_exclusive(&word);
    hal_store_exclusive(&word, 1);
  };
  constexpr auto consume = [] {
    hal_work(step, 1'000);
    if (hal_load_exclusive(&word) == 1) read_table(0, 8);
  };
  BOOST_TEST(races_of(publish, consume) == 0u);
}

BOOST_AUTO_TEST_SUITE_END()
