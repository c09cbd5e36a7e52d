// Two cores: when each does what, and how they wait for each other.

#include "cores_bench.h"

using namespace bench;
using namespace bench::two_cores;

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
