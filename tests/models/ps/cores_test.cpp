// Two cores: when each does what, how they wait for each other, and mistakes between them.
#include <boost/test/unit_test.hpp>

#include <sstream>
#include <stdexcept>

#include <ps/cpu/cores.h>
#include <vp/report.h>

#include "bench.h"

using namespace bench;

namespace {

using Times = std::vector<std::uint64_t>;
using Log = std::vector<Device::Access>;

/// The word of the boot code answers at once. A start takes a barrier of 20 ns, and the second core
/// runs 100 ns later.
struct TwoCores : Bench {
  explicit TwoCores(const Settings& settings = {}) : Bench(settings) {
    reports.redirect(messages);
    bus.map("boot", 0xFFFF'F000, 0x1000).bind(boot.socket);
    cpu1.n_irq(n_irq1);
    cpu1.m_axi.socket.bind(bus.socket);
  }
  vp::ReportRouter reports;
  std::ostringstream messages;
  Device boot{"boot", scheduler};
  vp::Signal<bool> n_irq1{"n_irq1", 1, true};
  ps::Cpu cpu1{"cpu1", cpu_clock, cpu};

  std::string failure_of(std::function<int()> body) {
    run(std::move(body), false);
    return failure();
  }
};

constexpr std::uint64_t started_ps = 120'000;

hal_lock results = {0, "results"}, other = {0, "other"}, nameless = {0, nullptr};
volatile std::uint32_t word;
volatile bool flag;
std::uint32_t count, count1;

/// Locks and words as a program finds them.
struct Fresh {
  Fresh() {
    for (hal_lock* lock : {&results, &other, &nameless}) lock->taken = 0;
    word = count = count1 = 0;
    flag = false;
  }
};

void nothing() {}
void write_1() {
  hal_write32(device_address, 1);
}
/// 20 ns a look, between events.
void await_word() {
  while (hal_load_acquire(&word) == 0) hal_wait_for_event();
}
/// 20 ns for the store, 20 ns for the event.
void set_word() {
  hal_store_release(&word, 1);
  hal_send_event();
}

/// Throws and lets time pass while the exception is being handled.
void handle(const char* text) {
  for (int i = 0; i < 3; ++i) {
    try {
      throw std::runtime_error(text);
    } catch (const std::exception& error) {
      hal_work(step, 70);
      hal_barrier();
      if (std::string(error.what()) == text) ++count;
    }
  }
}

bool says(const std::string& text, const std::string& part) {
  const bool found = text.find(part) != std::string::npos;
  if (!found) BOOST_TEST_MESSAGE("'" + text + "' says nothing of '" + part + "'");
  return found;
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(cores, Fresh)

BOOST_AUTO_TEST_CASE(the_second_core_starts_at_its_boot_code) {
  TwoCores b;
  BOOST_TEST(b.cpu1.asleep.get());
  Changes asleep(b.cpu1.asleep, b.scheduler);
  b.run([] {
    hal_work(step, 7);
    hal_cpu_start(1, [] {
      hal_work(step, 5);
      hal_write32(device_address, hal_cpu_number());
    });
    hal_work(step, 1000);
    hal_barrier();
    return static_cast<int>(hal_cpu_number());
  });
  BOOST_TEST(b.boot.log.size() == 1u);
  BOOST_TEST(b.boot.log[0].address == 0xFF0u);
  BOOST_TEST(b.boot.log[0].ps == 7'000u);
  const Log expected{{true, 0, 1, 7'000 + started_ps + 5'000}};
  BOOST_TEST(b.device.log == expected, boost::test_tools::per_element());
  const Times wakes_and_ends{7'000 + 20'000, 7'000 + started_ps + 5'000};
  BOOST_TEST(asleep.times == wakes_and_ends, boost::test_tools::per_element());
  BOOST_TEST((b.cpu1.state() == ps::Cpu::State::finished));
  BOOST_TEST(b.cpu1.activity().busy_ps() == 105'000u);
  BOOST_TEST(b.cpu.activity().busy_ps() == 7'000u + 20'000u + 1'000'000u + 20'000u);
}

// Whatever may run ahead: the log of both is one.
BOOST_AUTO_TEST_CASE(at_one_time_the_first_core_comes_first) {
  for (const char* quantum : {"cpu.quantum=0 s", "cpu.quantum=1 us", "cpu.quantum=1 s"}) {
    TwoCores b({quantum});
    b.run([] {
      hal_cpu_start(1, [] {
        for (std::uint32_t i = 0; i < 20; ++i) {
          hal_write32(device_address, 100 + i);
          hal_work(step, 50);
        }
      });
      hal_work(step, 100);
      for (std::uint32_t i = 0; i < 20; ++i) {
        hal_write32(device_address, i);
        hal_work(step, 50);
      }
      return 0;
    });
    Log expected;
    for (std::uint32_t i = 0; i < 20; ++i) {
      expected.push_back({true, 0, i, started_ps + 50'000 * i});
      expected.push_back({true, 0, 100 + i, started_ps + 50'000 * i});
    }
    BOOST_TEST(b.device.log == expected, boost::test_tools::per_element());
  }
}

BOOST_AUTO_TEST_CASE(an_edge_that_wakes_both_wakes_the_first_one_first) {
  for (const char* quantum : {"cpu.quantum=0 s", "cpu.quantum=1 s"}) {
    TwoCores b({quantum});
    sc_core::sc_spawn([&b] {
      sc_core::wait(vp::from_ps(500'000));
      b.n_irq1 = false;
      b.n_irq = false;
    });
    b.run([] {
      hal_cpu_start(1, [] {
        hal_wait_for_interrupt();
        write_1();
      });
      hal_wait_for_interrupt();
      hal_write32(device_address, 0);
      hal_work(step, 1000);
      return 0;
    });
    const Log expected{{true, 0, 0, 500'000}, {true, 0, 1, 500'000}};
    BOOST_TEST(b.device.log == expected, boost::test_tools::per_element());
  }
}

BOOST_AUTO_TEST_CASE(an_event_wakes_a_core_when_it_is_sent) {
  TwoCores b;
  b.run([] {
    hal_cpu_start(1, [] {
      await_word();
      write_1();
    });
    hal_work(step, 460);
    set_word();
    hal_work(step, 1000);
    return 0;
  });
  // Sent at 520.
  BOOST_TEST(b.device.times() == Times{540'000}, boost::test_tools::per_element());
  BOOST_TEST(b.cpu1.activity().idle_ps() == 520'000u - 140'000u + 20'000u);
}

BOOST_AUTO_TEST_CASE(an_event_before_the_wait_is_kept) {
  TwoCores b;
  b.run([] {
    hal_send_event();
    hal_wait_for_event();
    write_1();
    return 0;
  });
  BOOST_TEST(b.device.times() == Times{20'000}, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(an_interrupt_ends_the_wait_for_an_event) {
  TwoCores b;
  b.device.written = [&b](std::uint32_t) { b.n_irq1 = true; };
  sc_core::sc_spawn([&b] {
    sc_core::wait(vp::from_ps(300'000));
    b.n_irq1 = false;
  });
  b.run([] {
    hal_cpu_start(1, [] {
      hal_interrupt_connect([](void*) { write_1(); }, nullptr);
      hal_interrupt_enable(true);
      hal_wait_for_event();
      hal_write32(device_address, 2);
    });
    hal_work(step, 1000);
    return 0;
  });
  // 100 cycles of entry, 60 of exit.
  const Log expected{{true, 0, 1, 400'000}, {true, 0, 2, 460'000}};
  BOOST_TEST(b.device.log == expected, boost::test_tools::per_element());
  BOOST_TEST(b.cpu1.interrupts == 1u);
  BOOST_TEST(b.cpu.interrupts == 0u);
}

BOOST_AUTO_TEST_CASE(a_lock_lets_one_core_in) {
  TwoCores b;
  b.run([] {
    hal_lock_acquire(&results);  // 40 ns
    hal_cpu_start(1, [] {
      hal_lock_acquire(&results);
      write_1();
      hal_lock_release(&results);
    });
    hal_work(step, 440);
    hal_write32(device_address, 0);
    hal_lock_release(&results);  // 20 ns, then the event 20 ns later
    hal_work(step, 1000);
    return 0;
  });
  // Woken at 540, the second one loads and stores.
  const Log expected{{true, 0, 0, 500'000}, {true, 0, 1, 580'000}};
  BOOST_TEST(b.device.log == expected, boost::test_tools::per_element());
  BOOST_TEST(results.taken == 0u);
}

BOOST_AUTO_TEST_CASE(a_counter_under_a_lock_loses_nothing) {
  TwoCores b;
  b.run([] {
    constexpr auto add = [] {
      for (int i = 0; i < 200; ++i) {
        hal_lock_acquire(&nameless);
        const std::uint32_t seen = count;
        hal_work(step, 13);
        hal_barrier();
        count = seen + 1;
        hal_lock_release(&nameless);
      }
      ++word;
      hal_send_event();
    };
    hal_cpu_start(1, add);
    add();
    while (word != 2) hal_wait_for_event();
    return 0;
  });
  BOOST_TEST(count == 400u);
}

BOOST_AUTO_TEST_CASE(without_a_lock_it_does) {
  TwoCores b;
  b.run([] {
    constexpr auto add = [] {
      for (int i = 0; i < 200; ++i) {
        const std::uint32_t seen = count;
        hal_work(step, 13);
        hal_barrier();
        count = seen + 1;
      }
    };
    hal_cpu_start(1, add);
    add();
    hal_work(step, 10'000);
    return 0;
  });
  BOOST_TEST(count < 400u);
}

BOOST_AUTO_TEST_CASE(an_exclusive_store_fails_behind_one_of_the_other_core) {
  TwoCores b;
  b.run([] {
    count = hal_load_exclusive(&word);  // 20 ns
    hal_cpu_start(1, [] {
      count1 = hal_load_exclusive(&word);
      count1 += hal_store_exclusive(&word, 5) ? 100 : 0;
    });
    hal_work(step, 1000);
    return hal_store_exclusive(&word, 7) ? 1 : 0;
  });
  BOOST_TEST(b.cpu.exit_code() == 0);
  BOOST_TEST(count1 == 100u);
  BOOST_TEST(word == 5u);
}

BOOST_AUTO_TEST_CASE(an_exclusive_store_needs_a_load_of_its_own) {
  TwoCores b;
  b.run([] {
    static volatile std::uint32_t far[32];
    int stored = 0;
    stored += hal_store_exclusive(&word, 1) ? 1 : 0;  // none
    hal_load_exclusive(&word);
    stored += hal_store_exclusive(&far[16], 1) ? 2 : 0;  // of another word
    hal_load_exclusive(&word);
    word = 3;
    stored += hal_store_exclusive(&word, 1) ? 4 : 0;  // a plain store came between
    hal_load_exclusive(&word);
    stored += hal_store_exclusive(&word, 1) ? 8 : 0;
    stored += hal_store_exclusive(&word, 2) ? 16 : 0;  // used up
    return stored;
  });
  BOOST_TEST(b.cpu.exit_code() == 8);
  BOOST_TEST(word == 1u);
}

// Both cores run 10 us ahead at most, whatever the quantum: the second one looks at 10 us, 20 us …
// from its start.
BOOST_AUTO_TEST_CASE(plain_memory_shows_when_the_quantum_does_not_matter) {
  for (const char* quantum : {"cpu.quantum=0 s", "cpu.quantum=3 us", "cpu.quantum=1 s"}) {
    const Fresh fresh;
    TwoCores b({quantum});
    b.run([] {
      hal_cpu_start(1, [] {
        while (!flag) hal_work(step, 1000);
        write_1();
      });
      hal_work(step, 50'000);
      flag = true;
      hal_work(step, 50'000);
      return 0;
    });
    BOOST_TEST(b.device.times() == Times{50'120'000}, boost::test_tools::per_element());
  }
}

BOOST_AUTO_TEST_CASE(the_run_ends_with_the_first_core) {
  TwoCores b;
  b.run([] {
    hal_cpu_start(1, [] {
      while (true) {
        hal_work(step, 100);
        write_1();
      }
    });
    hal_work(step, 1'000);
    return 0;
  });
  BOOST_TEST(b.cpu.end_ps() == 1'020'000u);
  BOOST_TEST(b.device.log.size() == 8u);
  BOOST_TEST((b.cpu1.state() == ps::Cpu::State::running));
}

BOOST_AUTO_TEST_CASE(exceptions_of_both_cores_do_not_mix) {
  TwoCores b;
  b.run([] {
    hal_cpu_start(1, [] { handle("second"); });
    hal_work(step, 130);
    handle("first");
    hal_work(step, 1000);
    return 0;
  });
  BOOST_TEST(count == 6u);
}

BOOST_AUTO_TEST_SUITE_END()

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

BOOST_FIXTURE_TEST_SUITE(cores_errors, Fresh)

BOOST_AUTO_TEST_CASE(a_core_is_started_twice) {
  TwoCores b;
  const std::string error = b.failure_of([] {
    hal_cpu_start(1, nothing);
    hal_work(step, 1'000);
    hal_cpu_start(1, nothing);
    return 0;
  });
  BOOST_TEST(error ==
             "hal_cpu_start(1): the core was started already: cpu1 ended at 120 ns, at 1.02 us of "
             "program 'bench'");
}

BOOST_AUTO_TEST_CASE(a_start_without_entry_or_of_a_core_that_is_none) {
  {
    TwoCores b;
    const std::string error = b.failure_of([] {
      hal_cpu_start(1, nullptr);
      return 0;
    });
    BOOST_TEST(says(error, "hal_cpu_start(1): the entry is null"));
  }
  for (const unsigned number : {0u, 2u}) {
    TwoCores b;
    const std::string error = b.failure_of([number] {
      hal_cpu_start(number, nothing);
      return 0;
    });
    BOOST_TEST(says(error, "there is no such core to start"));
  }
  Bench one;
  one.run(
      [] {
        hal_cpu_start(1, nothing);
        return 0;
      },
      false);
  BOOST_TEST(says(one.failure(), "the platform has one core: set ps.cores to 2"));
}

BOOST_AUTO_TEST_CASE(each_waits_for_the_lock_of_the_other) {
  TwoCores b;
  const std::string error = b.failure_of([] {
    hal_cpu_start(1, [] {
      hal_lock_acquire(&other);
      hal_work(step, 1'000);
      hal_lock_acquire(&results);
    });
    hal_lock_acquire(&results);
    hal_work(step, 1'000);
    hal_lock_acquire(&other);
    return 0;
  });
  BOOST_TEST(says(error,
                  "deadlock: cpu waits for lock 'other', which cpu1 has held since 160 ns, "
                  "cpu1 waits for lock 'results', which cpu has held since 60 ns"));
}

BOOST_AUTO_TEST_CASE(a_core_waits_for_its_own_lock) {
  TwoCores b;
  const std::string error = b.failure_of([] {
    hal_lock_acquire(&results);
    hal_lock_acquire(&results);
    return 0;
  });
  BOOST_TEST(says(error, "deadlock: cpu waits for lock 'results', which cpu has held since 40 ns"));
}

BOOST_AUTO_TEST_CASE(a_lock_is_never_given_back) {
  {
    TwoCores b;  // by a core that ends while the other one waits
    const std::string error = b.failure_of([] {
      hal_cpu_start(1, [] {
        hal_lock_acquire(&results);
        hal_work(step, 1'000);
      });
      hal_work(step, 500);
      hal_lock_acquire(&results);
      return 0;
    });
    BOOST_TEST(says(
        error,
        "deadlock: cpu waits for lock 'results', which cpu1 has held since 160 ns, cpu1 ended"));
  }
  const Fresh fresh;
  TwoCores b;  // by a core that waits for something else
  const std::string error = b.failure_of([] {
    hal_cpu_start(1, [] {
      hal_lock_acquire(&results);
      while (true) hal_wait_for_event();
    });
    hal_work(step, 500);
    hal_lock_acquire(&results);
    return 0;
  });
  BOOST_TEST(says(error, "cpu waits for lock 'results', which cpu1 has held since 160 ns"));
  BOOST_TEST(says(error, "cpu1 waits for an event with IRQ masked"));
}

BOOST_AUTO_TEST_CASE(nobody_sends_the_event) {
  Bench one({"cpu.timeout=1 ms"});
  one.run(
      [] {
        hal_wait_for_event();
        return 0;
      },
      false);
  BOOST_TEST(says(one.failure(), "deadlock: cpu waits for an event with IRQ masked"));
  TwoCores b({"cpu.timeout=1 ms"});
  const std::string error = b.failure_of([] {
    hal_cpu_start(1, [] { hal_wait_for_interrupt(); });
    hal_wait_for_event();
    hal_wait_for_event();
    return 0;
  });
  BOOST_TEST(says(error, "it waits for an event within 1 ms"));
  BOOST_TEST(says(error, "; cpu1 waits for an interrupt"));
}

BOOST_AUTO_TEST_CASE(locks_that_are_not_held_or_not_words) {
  {
    TwoCores b;
    const std::string error = b.failure_of([] {
      hal_lock_release(&results);
      return 0;
    });
    BOOST_TEST(says(error, "hal_lock_release(): lock 'results' is not cpu's"));
  }
  {
    TwoCores b;
    const std::string error = b.failure_of([] {
      hal_cpu_start(1, [] { hal_lock_acquire(&results); });
      hal_work(step, 500);
      hal_lock_release(&results);
      return 0;
    });
    BOOST_TEST(says(error, "lock 'results' is not cpu's, but cpu1's"));
  }
  const Fresh fresh;
  TwoCores b;
  nameless.taken = 9;
  const std::string error = b.failure_of([] {
    hal_lock_acquire(&nameless);
    return 0;
  });
  BOOST_TEST(says(error, "is taken, but no core took it"));
}

BOOST_AUTO_TEST_CASE(a_word_at_an_odd_or_null_address) {
  {
    TwoCores b;
    const std::string error = b.failure_of([] {
      const auto odd = reinterpret_cast<std::uintptr_t>(&word) + 1;
      hal_load_exclusive(reinterpret_cast<volatile std::uint32_t*>(odd));
      return 0;
    });
    BOOST_TEST(says(error, "hal_load_exclusive(): the address of the word is not a multiple of 4"));
  }
  TwoCores b;
  const std::string error = b.failure_of([] {
    hal_store_exclusive(nullptr, 1);
    return 0;
  });
  BOOST_TEST(says(error, "segmentation fault: read of 0x00000000 (a null pointer)"));
}

BOOST_AUTO_TEST_CASE(what_the_second_core_does_wrong_ends_the_run) {
  struct Mistake {
    void (*entry)();
    const char* text;
  };
  const Mistake mistakes[] = {
      {[] { hal_frame_next(); }, "hal_frame_next(): inputs go to the first core"},
      {[] { hal_publish(0, nullptr, 0); }, "hal_publish(): results come from the first core"},
      {[] { throw std::runtime_error("no luck"); }, "the program threw an exception: no luck"},
      {[] { *reinterpret_cast<volatile int*>(16) = 1; }, "segmentation fault: write to 0x00000010"},
      {[] { hal_read32(0x4123'0000); }, "data abort: read of 0x41230000"},
  };
  for (const Mistake& mistake : mistakes) {
    TwoCores b;
    const std::string error = b.failure_of([entry = mistake.entry] {
      hal_cpu_start(1, entry);
      hal_work(step, 1'000);
      return 0;
    });
    BOOST_TEST(says(error, mistake.text));
    BOOST_TEST(says(error, " on cpu1 of program 'bench'"));
    BOOST_TEST((b.cpu1.state() == ps::Cpu::State::failed));
  }
}

BOOST_AUTO_TEST_CASE(a_fault_of_the_first_core_beside_the_second) {
  TwoCores b;
  const std::string error = b.failure_of([] {
    hal_cpu_start(1, [] {
      while (true) hal_work(step, 100);
    });
    hal_work(step, 1'000);
    hal_barrier();
    *reinterpret_cast<volatile int*>(16) = 1;
    return 0;
  });
  BOOST_TEST(says(error, "segmentation fault: write to 0x00000010"));
  BOOST_TEST(!says(error, "on cpu1"));
}

BOOST_AUTO_TEST_SUITE_END()
