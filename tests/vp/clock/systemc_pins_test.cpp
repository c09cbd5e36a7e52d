#include <vp/systemc_pins.h>

#include <algorithm>
#include <array>
#include <deque>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include <simulation.h>
#include <vp/error.h>
#include <boost/test/unit_test.hpp>

#include "recorder.h"

BOOST_AUTO_TEST_SUITE(systemc_pins)

namespace {

/// A register of plain SystemC, which knows nothing of ours.
struct ForeignRegister : sc_core::sc_module {
  SC_HAS_PROCESS(ForeignRegister);
  explicit ForeignRegister(sc_core::sc_module_name name) : sc_module(name) {
    SC_METHOD(sample);
    sensitive << clk.pos();
    dont_initialize();
  }
  void sample() { q.write(d.read()); }

  sc_core::sc_in<bool> clk{"clk"};
  sc_core::sc_in<std::uint32_t> d{"d"};
  sc_core::sc_out<std::uint32_t> q{"q"};
};

/// Notes when the level of a clock's pin changes.
struct LevelRecorder : sc_core::sc_module {
  SC_HAS_PROCESS(LevelRecorder);
  explicit LevelRecorder(sc_core::sc_module_name name) : sc_module(name) {
    SC_METHOD(note);
    sensitive << clk;
    dont_initialize();
  }
  void note() { changes.emplace_back(kit::now_ps(), clk.read()); }

  sc_core::sc_in<bool> clk{"clk"};
  std::vector<std::pair<std::uint64_t, bool>> changes;
};

using Changes = std::vector<std::pair<std::uint64_t, bool>>;

struct Fixture : kit::Simulation {
  vp::ClockScheduler scheduler{"scheduler"};
};

/// What a register showed, and when.
struct Watch : vp::SignalListener {
  explicit Watch(vp::Signal<std::uint32_t>& signal) { signal.attach(*this); }
  void on_change(vp::SignalBase& signal, std::uint32_t) override {
    seen.emplace_back(kit::now_ps(), signal.bits());
  }
  std::vector<std::pair<std::uint64_t, std::uint64_t>> seen;
};

}  // namespace

BOOST_FIXTURE_TEST_CASE(a_pin_is_high_for_the_first_half_of_each_period, Fixture) {
  vp::Clock clock{"clock", scheduler, 300'000'000};
  LevelRecorder recorder{"recorder"};
  recorder.clk(clock.pin());
  run_to(10'000);
  const Changes expected{{3333, true}, {5000, false}, {6667, true}, {8333, false}, {10'000, true}};
  BOOST_TEST((recorder.changes == expected));
}

BOOST_FIXTURE_TEST_CASE(a_pin_follows_changes_of_the_frequency, Fixture) {
  vp::Clock clock{"clock", scheduler, 100'000'000};
  LevelRecorder recorder{"recorder"};
  recorder.clk(clock.pin());
  run_to(11'000);  // high since 10 000
  clock.set_frequency(50'000'000);
  run_to(50'000);
  clock.set_frequency(0);
  run_to(100'000);
  const Changes expected{{10'000, true}, {21'001, false}, {31'001, true}, {41'001, false}};
  BOOST_TEST((recorder.changes == expected));
}

BOOST_FIXTURE_TEST_CASE(a_clock_that_stops_leaves_its_pin_low, Fixture) {
  vp::Clock clock{"clock", scheduler, 100'000'000};
  LevelRecorder recorder{"recorder"};
  recorder.clk(clock.pin());
  run_to(10'999);
  clock.set_frequency(0);
  run_to(50'000);
  BOOST_TEST((recorder.changes == Changes{{10'000, true}, {11'000, false}}));
}

BOOST_FIXTURE_TEST_CASE(a_pin_that_nobody_asked_for_costs_nothing, Fixture) {
  vp::Clock clock{"clock", scheduler, 100'000'000};
  CountingModule source{"source", clock};
  scheduler.set_batch(true);
  const sc_dt::uint64 before = sc_core::sc_delta_count();
  run_to(1'000'000);
  BOOST_TEST(source.count >= 100u);
  BOOST_TEST(sc_core::sc_delta_count() - before <= 2u);
}

/// counter -> foreign register -> ours -> foreign register -> ours, as if all were ours.
BOOST_FIXTURE_TEST_CASE(a_foreign_register_among_ours_takes_one_clock, Fixture) {
  vp::Clock clock{"clock", scheduler, 100'000'000};
  scheduler.set_batch(true);
  CountingModule source{"source", clock};
  Register middle{"middle", clock}, end{"end", clock};
  ForeignRegister first{"first"}, second{"second"};
  sc_core::sc_signal<std::uint32_t> first_q{"first_q"}, second_q{"second_q"};
  for (ForeignRegister* foreign : {&first, &second}) foreign->clk(clock.pin());
  first.d(source.count);
  first.q(first_q);
  middle.d(first_q);
  second.d(middle.q);
  second.q(second_q);
  end.d(second_q);
  Watch watch(end.q);
  run_to(80'000);
  BOOST_REQUIRE(watch.seen.size() == 4u);
  for (std::uint32_t i = 0; i < 4; ++i) {
    BOOST_TEST(watch.seen[i].first == 50'000u + 10'000u * i);
    BOOST_TEST(watch.seen[i].second == i + 1);
  }
}

/// A process that would run ahead of SystemC, as the processor does, with a foreign module around.
BOOST_FIXTURE_TEST_CASE(nobody_runs_ahead_of_a_foreign_module, Fixture) {
  struct Process : sc_core::sc_module {
    SC_HAS_PROCESS(Process);
    Process(sc_core::sc_module_name name, vp::ClockScheduler& s) : sc_module(name), scheduler(s) {
      SC_THREAD(run);
    }
    void run() {
      scheduler.pass_until(95'000);
      left_at = kit::now_ps();
    }
    vp::ClockScheduler& scheduler;
    std::uint64_t left_at = 0;
  };
  vp::Clock clock{"clock", scheduler, 100'000'000};
  scheduler.set_lookahead(1'000'000);
  CountingModule source{"source", clock};
  ForeignRegister foreign{"foreign"};
  sc_core::sc_signal<std::uint32_t> wire{"wire"};
  Register end{"end", clock};
  foreign.clk(clock.pin());
  foreign.d(source.count);
  foreign.q(wire);
  end.d(wire);
  Process process{"process", scheduler};
  Watch watch(end.q);
  run_to(95'000);
  BOOST_TEST(process.left_at == 95'000u);
  BOOST_REQUIRE(watch.seen.size() == 7u);
  for (std::uint32_t i = 0; i < 7; ++i) {
    BOOST_TEST(watch.seen[i].first == 30'000u + 10'000u * i);
    BOOST_TEST(watch.seen[i].second == i + 1);
  }
}

namespace {

/// A network of registers on three clocks, each ours or foreign. An input of every register is the
/// sum of two outputs: rings and crossings included.
class Network {
 public:
  static constexpr std::size_t size = 8, clocks = 3;
  struct Plan {
    std::array<std::uint64_t, clocks> hertz;
    std::array<std::size_t, clocks> declared;  ///< in which order
    struct Node {
      std::size_t clock, left, right;
      bool foreign;
    };
    std::array<Node, size> nodes;
  };

  explicit Network(const Plan& plan) {
    for (const std::size_t i : plan.declared) {
      const std::string name = "clock_" + std::to_string(i);
      made_[i] = std::make_unique<vp::Clock>(name.c_str(), scheduler, plan.hertz[i]);
    }
    for (std::size_t i = 0; i < size; ++i) make(i, plan.nodes[i]);
    for (std::size_t i = 0; i < size; ++i) connect(i, plan.nodes[i]);
  }

  /// Every change of every register: time, number, value.
  std::vector<std::tuple<std::uint64_t, std::size_t, std::uint64_t>> run(std::uint64_t to_ps) {
    run_to(to_ps);
    std::vector<std::tuple<std::uint64_t, std::size_t, std::uint64_t>> all;
    for (std::size_t i = 0; i < size; ++i) {
      for (const auto& [ps, value] : watches_[i]->seen) all.emplace_back(ps, i, value);
    }
    return all;
  }

 private:
  struct Adder : vp::Clocked {
    Adder(sc_core::sc_module_name name, vp::Clock& clock) : Clocked(name, clock) {}
    void edge() override { q = left + right + 1; }
    vp::In<std::uint32_t> left{"left", this}, right{"right", this};
    vp::Signal<std::uint32_t> q{"q"};
  };
  struct ForeignAdder : sc_core::sc_module {
    SC_HAS_PROCESS(ForeignAdder);
    explicit ForeignAdder(sc_core::sc_module_name name) : sc_module(name) {
      SC_METHOD(sample);
      sensitive << clk.pos();
      dont_initialize();
      q(wire);
    }
    void sample() { q.write(left.read() + right.read() + 1); }
    sc_core::sc_in<bool> clk{"clk"};
    sc_core::sc_in<std::uint32_t> left{"left"}, right{"right"};
    sc_core::sc_out<std::uint32_t> q{"q"};
    sc_core::sc_signal<std::uint32_t> wire{"wire"};
  };

  void make(std::size_t i, const Plan::Node& node) {
    const std::string name = "node_" + std::to_string(i);
    vp::Clock& clock = *made_[node.clock];
    if (node.foreign) {
      foreign_[i] = std::make_unique<ForeignAdder>(name.c_str());
      foreign_[i]->clk(clock.pin());
      followers_[i] = std::make_unique<vp::Follower<std::uint32_t, std::uint32_t>>(
          (name + "_seen").c_str(), foreign_[i]->wire);
      watches_[i] = std::make_unique<Watch>(followers_[i]->signal);
    } else {
      ours_[i] = std::make_unique<Adder>(name.c_str(), clock);
      watches_[i] = std::make_unique<Watch>(ours_[i]->q);
    }
  }

  void connect(std::size_t i, const Plan::Node& node) {
    if (node.foreign) {
      join(foreign_[i]->left, node.left);
      join(foreign_[i]->right, node.right);
    } else {
      join(ours_[i]->left, node.left);
      join(ours_[i]->right, node.right);
    }
  }
  template <class Port>
  void join(Port& port, std::size_t source) {
    if (foreign_[source]) {
      port(foreign_[source]->wire);
    } else {
      port(ours_[source]->q);
    }
  }

  vp::ClockScheduler scheduler{"scheduler"};
  std::array<std::unique_ptr<vp::Clock>, clocks> made_;
  std::array<std::unique_ptr<Adder>, size> ours_;
  std::array<std::unique_ptr<ForeignAdder>, size> foreign_;
  std::array<std::unique_ptr<vp::Follower<std::uint32_t, std::uint32_t>>, size> followers_;
  std::array<std::unique_ptr<Watch>, size> watches_;
};

Network::Plan random_plan(std::mt19937& random) {
  constexpr std::uint64_t mhz = 1'000'000;
  const std::array<std::uint64_t, 5> hertz{25 * mhz, 50 * mhz, 100 * mhz, 75 * mhz, 333'333'333};
  Network::Plan plan{};
  for (auto& f : plan.hertz) f = hertz[random() % hertz.size()];
  plan.declared = {0, 1, 2};
  for (Network::Plan::Node& node : plan.nodes) {
    node = {random() % Network::clocks, random() % Network::size, random() % Network::size, false};
  }
  return plan;
}

auto run_network(const Network::Plan& plan) {
  const kit::Simulation fresh;
  return Network(plan).run(300'000);
}

}  // namespace

/// At coincident edges all modules sample the values from before, foreign or not, whichever clock
/// was declared first.
BOOST_AUTO_TEST_CASE(neither_foreign_modules_nor_the_order_of_clocks_change_a_random_network) {
  std::mt19937 random(20261122);
  for (int trial = 0; trial < 60; ++trial) {
    BOOST_TEST_CONTEXT("trial " << trial) {
      const Network::Plan ours = random_plan(random);
      const auto expected = run_network(ours);
      BOOST_TEST(!expected.empty());
      Network::Plan other = ours;
      std::shuffle(other.declared.begin(), other.declared.end(), random);
      BOOST_TEST((run_network(other) == expected), "another order of declaration");
      for (auto& node : other.nodes) node.foreign = random() % 2 == 0;
      BOOST_TEST((run_network(other) == expected), "some are foreign");
      for (auto& node : other.nodes) node.foreign = true;
      BOOST_TEST((run_network(other) == expected), "all are foreign");
    }
  }
}

BOOST_FIXTURE_TEST_CASE(clocks_run_in_the_order_that_is_stated, Fixture) {
  vp::Clock late{"late", scheduler, 100'000'000};
  vp::Clock soon{"soon", scheduler, 100'000'000};
  scheduler.run_before(soon, late);
  run_to(1);
  BOOST_TEST((scheduler.clocks() == std::vector<vp::Clock*>{&soon, &late}));
}

BOOST_FIXTURE_TEST_CASE(contradicting_orders_are_refused, Fixture) {
  vp::Clock a{"a", scheduler, 100'000'000};
  vp::Clock b{"b", scheduler, 100'000'000};
  scheduler.run_before(a, b);
  scheduler.run_before(b, a);
  BOOST_CHECK_EXCEPTION(run_to(1), std::logic_error, [](const std::logic_error& error) {
    return std::string(error.what()).find("coincident") != std::string::npos;
  });
}

namespace {

template <class U>
struct Source : sc_core::sc_module {
  SC_HAS_PROCESS(Source);
  Source(sc_core::sc_module_name name, const U& value) : sc_module(name), value_(value) {
    SC_METHOD(drive);
    sensitive << clk.pos();
    dont_initialize();
    q(wire);
  }
  void drive() { q.write(value_); }
  sc_core::sc_in<bool> clk{"clk"};
  sc_core::sc_out<U> q{"q"};
  sc_core::sc_signal<U> wire{"wire"};

 private:
  U value_;
};

template <class T>
struct Sink : vp::Clocked {
  Sink(sc_core::sc_module_name name, vp::Clock& clock) : Clocked(name, clock) {}
  void edge() override { seen = d; }
  vp::In<T> d{"d", this};
  vp::Signal<T> seen{"seen"};
};

/// What a port of ours sees of a foreign value, two clocks later.
template <class T, class U>
T seen_through(const U& value) {
  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clock{"clock", scheduler, 100'000'000};
  Source<U> source{"source", value};
  Sink<T> sink{"sink", clock};
  source.clk(clock.pin());
  sink.d(source.wire);
  run_to(20'000);
  return sink.seen;
}

}  // namespace

BOOST_FIXTURE_TEST_CASE(ports_of_ours_take_sc_uint, kit::Simulation) {
  BOOST_TEST((seen_through<std::uint16_t>(sc_dt::sc_uint<10>(1023)) == 1023u));
}
BOOST_FIXTURE_TEST_CASE(ports_of_ours_take_sc_bv, kit::Simulation) {
  BOOST_TEST((seen_through<std::uint32_t>(sc_dt::sc_bv<32>(0x80000001u)) == 0x80000001u));
}
BOOST_FIXTURE_TEST_CASE(ports_of_ours_take_sc_logic, kit::Simulation) {
  BOOST_TEST(seen_through<bool>(sc_dt::SC_LOGIC_1));
}
BOOST_FIXTURE_TEST_CASE(ports_of_ours_take_wider_types, kit::Simulation) {
  BOOST_TEST((seen_through<std::uint8_t>(std::uint32_t{255}) == 255u));
}

BOOST_FIXTURE_TEST_CASE(a_value_that_does_not_fit_is_refused, kit::Simulation) {
  BOOST_CHECK_EXCEPTION(
      seen_through<std::uint8_t>(std::uint32_t{256}), sc_core::sc_report,
      [](const sc_core::sc_report& report) {
        return report.get_msg() ==
               std::string(
                   "sink_d: the foreign module drives 256, which the 8 bits of the port "
                   "cannot show");
      });
}

BOOST_FIXTURE_TEST_CASE(a_signal_of_ours_can_be_seen_as_another_type, Fixture) {
  vp::Clock clock{"clock", scheduler, 100'000'000};
  CountingModule source{"source", clock};
  vp::View<sc_dt::sc_uint<10>> view{"view", source.count};
  run_to(30'000);
  BOOST_TEST(view.signal.read().to_uint() == 3u);
}

namespace {

/// Combinational: out = !in.
struct Inverter : sc_core::sc_module {
  SC_HAS_PROCESS(Inverter);
  explicit Inverter(sc_core::sc_module_name name) : sc_module(name) {
    SC_METHOD(drive);
    sensitive << in;
    out(wire);
  }
  void drive() { out.write(!in.read()); }
  sc_core::sc_in<bool> in{"in"};
  sc_core::sc_out<bool> out{"out"};
  sc_core::sc_signal<bool> wire{"wire"};
};

}  // namespace

BOOST_FIXTURE_TEST_CASE(a_combinational_ring_through_a_foreign_module_is_refused, Fixture) {
  Inverter inverter{"inverter"};
  vp::Follower<bool, bool> back{"back", inverter.wire};
  inverter.in(back.signal);
  BOOST_CHECK_EXCEPTION(run_to(1000), sc_core::sc_report, [](const sc_core::sc_report& report) {
    return std::string(report.get_msg()).find("back: changed 1000 times in one instant") == 0;
  });
}

/// `settle_foreign_modules` throws an error with all of `words` and none of `others`.
void check_ring(const std::vector<std::string>& words, const std::vector<std::string>& others) {
  BOOST_CHECK_EXCEPTION(
      vp::settle_foreign_modules(), vp::InputError, [&](const vp::InputError& error) {
        const std::string text = error.what();
        const auto has = [&](const std::string& word) { return text.find(word) != text.npos; };
        BOOST_TEST_INFO(text);
        return std::all_of(words.begin(), words.end(), has) &&
               std::none_of(others.begin(), others.end(), has);
      });
  BOOST_TEST(sc_core::sc_time_stamp() == sc_core::SC_ZERO_TIME);
}

BOOST_FIXTURE_TEST_CASE(a_ring_is_named_before_time_passes, Fixture) {
  Inverter inverter{"inverter"}, behind{"behind"}, apart{"apart"};
  vp::Follower<bool, bool> back{"back", inverter.wire};
  vp::Signal<bool> still{"still"};
  inverter.in(back.signal);
  behind.in(inverter.wire);
  apart.in(still);
  check_ring({"inverter.in", "inverter.out", "put a register"}, {"apart"});
}

// The kernel alone would go round it for ever.
BOOST_FIXTURE_TEST_CASE(a_ring_of_foreign_modules_only_is_named, Fixture) {
  Inverter a{"a"}, b{"b"}, c{"c"};
  a.in(c.wire);
  b.in(a.wire);
  c.in(b.wire);
  check_ring({"a.in", "a.out", "b.in", "b.out", "c.in", "c.out"}, {});
}

BOOST_FIXTURE_TEST_CASE(a_long_chain_comes_to_rest, Fixture) {
  std::deque<Inverter> chain;
  for (unsigned i = 0; i < 200; ++i) {
    chain.emplace_back(("inverter_" + std::to_string(i)).c_str());
    if (i > 0) chain[i].in(chain[i - 1].wire);
  }
  vp::Follower<bool, bool> back{"back", chain.back().wire};
  vp::Signal<bool> still{"still"};
  chain.front().in(still);
  BOOST_CHECK_NO_THROW(vp::settle_foreign_modules());
  BOOST_TEST(chain[199].wire.read() == false);
  BOOST_TEST(chain[198].wire.read() == true);
  run_to(1000);
}

BOOST_AUTO_TEST_SUITE_END()
