// What two cores do wrong, alone and between them.

#include "cores_bench.h"

using namespace bench;
using namespace bench::two_cores;

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

// What CPU 0 of a pair of programs does: the other one's address, and SEV.
BOOST_AUTO_TEST_CASE(a_core_is_started_where_the_program_has_no_code) {
  for (const std::uint32_t entry : {0x0020'0000u, 0u}) {
    Bench b;
    vp::ReportRouter reports;
    std::ostringstream messages;
    reports.redirect(messages);
    ps::Ocm ocm("ocm", b.cpu_clock);
    b.bus.map("ocm", ps::Ocm::base, ps::Ocm::size).bind(ocm.socket);
    b.run([entry] {
      hal_write32(0xFFFF'FFF0, entry);
      hal_send_event();
      hal_send_event();
      return 0;
    });
    b.cpu.check();
    const std::string text = messages.str();
    if (entry == 0) {
      BOOST_TEST(text.empty(), text);
      continue;
    }
    BOOST_TEST(says(text, "starts core 1 at 0x00200000, where it has no code"), text);
    BOOST_TEST(text.find("second_program") == text.rfind("second_program"), text);
  }
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

BOOST_AUTO_TEST_CASE(no_core_sends_the_event) {
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
