// Polls with and without the reads that cannot see anything new: no difference anywhere.
#include <ps/interconnect/interconnect.h>
#include <vp/report.h>
#include <xilinx/axi_gpio/axi_gpio.h>
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <sstream>

#include "bench.h"

using namespace bench;

namespace {

constexpr std::uint32_t gpio_address = 0x8000'0000;

/// A clock that takes another frequency.
struct ClockChange {
  std::uint64_t when;  ///< an edge of the governor's clock, or ps
  bool cpu;            ///< the processor's clock; otherwise the PL's
  std::uint64_t hertz;
};

struct Case {
  std::uint64_t cpu_hertz = 666'666'667;
  std::uint64_t pl_hertz = 100'000'000;
  std::uint32_t cycles = 8;
  std::uint32_t limit = 1'000;
  unsigned calls = 8;
  bool masked = false;
  bool observed = false;
  std::vector<std::uint64_t> words;       ///< edges of the PL's clock that bring the next word
  std::vector<std::uint64_t> interrupts;  ///< edges of the PL's clock on which nIRQ falls
  std::vector<ClockChange> on_edges;      ///< made by a clocked module
  std::vector<ClockChange> by_process;    ///< made by a SystemC process
  std::uint64_t reset_edge = 0;           ///< edge of the PL's clock on which the GPIO is reset
  Settings settings;                      ///< of the processor
  Settings bus_settings;                  ///< of the way to the GPIO
};

/// Does something on given edges, and sleeps between.
class Events : public vp::Clocked {
 public:
  Events(sc_core::sc_module_name name, vp::Clock& clock) : Clocked(name, clock) {}
  void at(std::uint64_t edge, std::function<void()> what) {
    events_.emplace_back(edge, std::move(what));
  }

 private:
  void edge() override {
    std::uint64_t next = vp::Clock::never;
    for (std::size_t i = 0; i < events_.size(); ++i) {
      if (events_[i].first == clock().cycle()) events_[i].second();
      if (events_[i].first > clock().cycle()) next = std::min(next, events_[i].first);
    }
    sleep();
    wake_at(next);
  }
  std::vector<std::pair<std::uint64_t, std::function<void()>>> events_;
};

struct Observer : vp::MmObserver {
  void after(vp::MmLink&, tlm::tlm_generic_payload&, sc_core::sc_time&) override { ++accesses; }
  std::uint64_t accesses = 0;
};

xilinx::AxiGpioBuild inputs() {
  xilinx::AxiGpioBuild build;
  build.gpio.direction = xilinx::GpioDirection::all_inputs;
  return build;
}

struct PollBench : Bench {
  PollBench(const Case& c, bool elide)
      : Bench(c.settings, c.cpu_hertz), bus_scope_(with(c.bus_settings)) {
    cpu.set_poll_elision(elide);
    bus_configuration_.check_unused();
    pl_clock.set_frequency(c.pl_hertz);
    bus.map("m_axi_gp0", gpio_address, 0x1000'0000, vp::Router::Addresses::absolute)
        .bind(port.socket);
    port.link.socket.bind(pl_bus.socket);
    pl_bus.map("gpio", gpio_address, 0x1'0000).bind(gpio.s_axi.socket);
    gpio.gpio.io_i(pins);
    gpio.s_axi_aresetn(aresetn);
    device.written = [this](std::uint32_t) { n_irq = true; };
    for (const std::uint64_t edge : c.words) events.at(edge, [this] { pins = pins.get() + 1; });
    for (const std::uint64_t edge : c.interrupts) events.at(edge, [this] { n_irq = false; });
    for (const ClockChange& change : c.on_edges) {
      governor.at(change.when, [this, change] { make(change); });
    }
    for (const ClockChange& change : c.by_process) {
      sc_core::sc_spawn([this, change] {
        sc_core::wait(vp::from_ps(change.when));
        make(change);
      });
    }
    if (c.reset_edge != 0) events.at(c.reset_edge, [this] { aresetn = false; });
    if (c.observed) pl_bus.find(gpio_address)->link->add_observer(observer);
  }
  void make(const ClockChange& change) {
    (change.cpu ? cpu_clock : pl_clock).set_frequency(change.hertz);
  }
  void program(const Case& c);
  void describe();

  vp::Configuration& with(const Settings& settings) {
    for (const std::string& setting : settings) bus_configuration_.set(setting);
    return bus_configuration_;
  }

  vp::Configuration bus_configuration_;
  vp::Configuration::Scope bus_scope_;
  vp::Clock governor_clock{"governor_clock", scheduler, 77'000'000};
  ps::GpPort port{"port", pl_clock};
  vp::Router pl_bus{"pl_bus", &pl_clock};
  xilinx::AxiGpio gpio{"gpio", pl_clock, inputs()};
  Events events{"events", pl_clock};
  Events governor{"governor", governor_clock};
  vp::Signal<std::uint32_t> pins{"pins"};
  vp::Signal<bool> aresetn{"aresetn", 1, true};
  Observer observer;
  std::vector<std::string> lines;  ///< all that anybody can see
};

PollBench* running;

template <class... Parts>
void note(const Parts&... parts) {
  std::ostringstream line;
  ((line << parts << ' '), ...);
  running->lines.push_back(line.str());
}

void handle(void*) {
  hal_function_enter(dispatch);
  note("handler", now_ps());
  hal_work(step, 30);
  hal_write32(device_address, 1);
  hal_function_leave();
}

void PollBench::program(const Case& c) {
  running = this;
  vp::ReportRouter reports;
  std::ostringstream text;
  reports.redirect(text);
  run(
      [&] {
        hal_interrupt_connect(handle, nullptr);
        hal_interrupt_enable(!c.masked);
        hal_function_enter(inner);
        std::uint32_t last = 0;
        for (unsigned call = 0; call < c.calls; ++call) {
          const hal_poll_result r = hal_poll_until_changed(gpio_address, last, c.cycles, c.limit);
          note("poll", r.value, r.polls, r.changed, now_ps());
          last = r.value;
          hal_work(load, 3);
        }
        hal_interrupt_enable(true);
        hal_function_leave();
        return 0;
      },
      false);
  describe();
}

void PollBench::describe() {
  note("end", cpu.end_ps(), now_ps(), failure());
  for (const vp::Counter* counter : vp::all_counters()) note(counter->name(), counter->get());
  for (const vp::Register& r : gpio.s_axi.registers()) {
    note(r.info().name, r.use().reads, r.use().read_ones, r.use().read_zeros);
  }
  const ps::Activity& activity = cpu.activity();
  note("activity", activity.busy_ps(), activity.idle_ps(), activity.handler_ps());
  for (const ps::FunctionTime& f : activity.functions()) note(f.name, f.self_ps, f.total_ps);
  note("observed", observer.accesses);
}

/// Runs both ways and compares. Returns how many reads were skipped.
std::uint64_t compare(const Case& c) {
  PollBench naive(c, false);
  naive.program(c);
  PollBench elided(c, true);
  elided.program(c);
  BOOST_TEST(elided.lines == naive.lines, boost::test_tools::per_element());
  BOOST_TEST(naive.cpu.skipped_polls() == 0u);
  return elided.cpu.skipped_polls();
}

/// Numbers that look like chance, the same on every host.
class Chance {
 public:
  explicit Chance(std::uint64_t seed) : state_(seed) {}
  std::uint64_t below(std::uint64_t end) {
    state_ = state_ * 6'364'136'223'846'793'005u + 1'442'695'040'888'963'407u;
    return (state_ >> 33) % end;
  }
  template <class T>
  T one_of(std::initializer_list<T> values) {
    return values.begin()[below(values.size())];
  }
  std::vector<std::uint64_t> edges(std::size_t most, std::uint64_t last) {
    std::vector<std::uint64_t> edges(below(most + 1));
    for (std::uint64_t& edge : edges) edge = 1 + below(last);
    return edges;
  }

 private:
  std::uint64_t state_;
};

Case usual() {
  Case c;
  c.words = {300, 1'200, 1'201, 5'000, 9'000, 20'000, 21'000, 30'000};
  return c;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(poll)

BOOST_AUTO_TEST_CASE(words_come_at_the_same_times) {
  BOOST_TEST(compare(usual()) > 1'000u, "of some 1500 polls");
}

BOOST_AUTO_TEST_CASE(for_many_pairs_of_clocks) {
  for (const std::uint64_t cpu : {666'666'667u, 666'666'687u, 1'000'000'000u, 333'333'333u, 999u}) {
    for (const std::uint64_t pl :
         {100'000'000u, 148'500'000u, 27'000'000u, 250'000'000u, 33'333'333u, 1'000'003u}) {
      BOOST_TEST_CONTEXT("CPU " << cpu << " Hz, PL " << pl << " Hz") {
        Case c = usual();
        c.cpu_hertz = cpu;
        c.pl_hertz = pl;
        if (cpu > 1'000) BOOST_TEST(compare(c) > 100u);
        c.limit = 3;
        compare(c);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(up_to_any_limit) {
  for (std::uint32_t limit = 0; limit < 12; ++limit) {
    Case c = usual();
    c.limit = limit;
    c.words = {40 + limit, 100, 101, 102, 150};
    compare(c);
  }
  Case c = usual();
  c.words = {};
  c.limit = 65'536;
  c.calls = 1;
  BOOST_TEST(compare(c) > 65'000u, "one is made whenever SystemC has its turn");
}

BOOST_AUTO_TEST_CASE(interrupts_come_in_between) {
  for (std::uint64_t first = 100; first < 140; ++first) {
    Case c = usual();
    c.interrupts = {first, 1'195, 3'000, 3'001, 20'001};
    BOOST_TEST(compare(c) > 1'000u);
    c.masked = true;
    compare(c);
  }
}

BOOST_AUTO_TEST_CASE(a_clock_changes_by_a_process) {
  for (std::uint64_t ps = 10'000'000; ps < 10'300'000; ps += 7'001) {
    Case c = usual();
    c.by_process = {{ps, false, 66'666'667},
                    {ps + 40'000'000, true, 333'333'333},
                    {ps + 40'100'000, true, 666'666'667}};
    BOOST_TEST(compare(c) > 500u);
  }
}

BOOST_AUTO_TEST_CASE(a_clock_changes_on_an_edge_of_another) {
  for (std::uint64_t edge = 1'000; edge < 1'030; ++edge) {
    for (const bool cpu : {false, true}) {
      Case c = usual();
      c.on_edges = {{edge, cpu, 66'666'667},
                    {edge + 1'000, cpu, 90'000'000},
                    {edge + 1'001, !cpu, 700'000'000}};
      BOOST_TEST(compare(c) > 200u);
    }
  }
}

BOOST_AUTO_TEST_CASE(the_clock_of_the_pl_stops) {
  for (std::uint64_t edge = 1'000; edge < 1'030; ++edge) {
    Case c = usual();
    c.on_edges = {{edge, false, 0}};
    compare(c);
    c.on_edges.push_back({edge + 1, false, 50'000'000});
    compare(c);
  }
  Case c = usual();
  c.on_edges = {{1'000, false, 0}};
  PollBench b(c, true);
  b.program(c);
  BOOST_TEST(b.failure().find("bus hang") == 0u, b.failure());
}

BOOST_AUTO_TEST_CASE(the_clock_of_the_cpu_stops) {
  Case c = usual();
  c.on_edges = {{1'000, true, 0}};
  compare(c);
}

BOOST_AUTO_TEST_CASE(the_time_out_comes_in_the_middle) {
  for (unsigned ns = 30'000; ns < 30'200; ns += 9) {
    Case c;
    c.limit = 100'000;
    c.settings = {"cpu.timeout=" + std::to_string(ns) + " ns"};
    BOOST_TEST(compare(c) > 100u);
  }
}

BOOST_AUTO_TEST_CASE(the_gpio_is_reset) {
  for (std::uint64_t edge = 400; edge < 420; ++edge) {
    Case c = usual();
    c.reset_edge = edge;
    compare(c);
  }
}

BOOST_AUTO_TEST_CASE(an_observer_sees_every_read) {
  Case c = usual();
  c.observed = true;
  BOOST_TEST(compare(c) == 0u);
}

BOOST_AUTO_TEST_CASE(no_cost_of_the_bus_matters) {
  const std::vector<Settings> all{
      {"port.read_time=0 ps", "port.read_clocks=0 cycles", "port.request_clocks=0 cycles"},
      {"port.read_time=0 ps", "port.read_clocks=1 cycles"},
      {"port.read_clocks=0 cycles", "port.request_clocks=9 cycles"},
      {"pl_bus.read_latency=3 cycles"},
      {"pl_bus.read_latency=100 cycles"}};
  for (const Settings& settings : all) {
    Case c = usual();
    c.bus_settings = settings;
    c.cycles = 0;
    compare(c);
    c.cycles = 8;
    c.interrupts = {100, 3'000, 4'000};
    compare(c);
  }
  Case c = usual();
  c.bus_settings = {"pl_bus.read_latency=3 cycles"};
  BOOST_TEST(compare(c) > 1'000u, "a latency is no obstacle");
}

BOOST_AUTO_TEST_CASE(no_quantum_matters) {
  for (const char* quantum : {"0 ps", "1 ns", "1 us", "100 us", "10 ms"}) {
    Case c = usual();
    c.interrupts = {100, 3'000};
    c.settings = {std::string("cpu.quantum=") + quantum};
    compare(c);
  }
}

BOOST_AUTO_TEST_CASE(whatever_comes_together) {
  Chance chance(2);
  std::uint64_t skipped = 0;
  for (unsigned i = 0; i < 300; ++i) {
    Case c;
    c.cpu_hertz = chance.one_of<std::uint64_t>({666'666'667, 1'000'000'000, 433'217'981});
    c.pl_hertz = chance.one_of<std::uint64_t>({100'000'000, 50'000'000, 133'333'333, 71'234'567});
    c.cycles = static_cast<std::uint32_t>(chance.below(60));
    c.limit = static_cast<std::uint32_t>(1 + chance.below(400));
    c.masked = chance.below(4) == 0;
    c.words = chance.edges(12, 6'000);
    c.interrupts = chance.edges(12, 6'000);
    c.settings = {"cpu.quantum=" + std::to_string(chance.below(40'000)) + " ns"};
    for (const std::uint64_t edge : chance.edges(3, 4'000)) {
      c.on_edges.push_back({edge, chance.below(2) == 0, 40'000'000 + chance.below(500'000'000)});
    }
    for (const std::uint64_t ns : chance.edges(2, 50'000)) {
      c.by_process.push_back(
          {1'000 * ns, chance.below(2) == 0, 40'000'000 + chance.below(500'000'000)});
    }
    BOOST_TEST_CONTEXT("case " << i) {
      skipped += compare(c);
    }
  }
  BOOST_TEST(skipped > 100'000u);
}

BOOST_AUTO_TEST_SUITE_END()
