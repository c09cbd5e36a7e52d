// What RTL on AXI costs as a part of a design, against the same RTL alone in Verilator on the same
// pins: bench_rtl_part FILE.so [CLOCKS] [ADDRESS=VALUE…]. Its streams get words, its masters
// memory, and its slaves bursts without pause, or the words of these registers, once. Others load
// the machine, so each run is followed by its peers; printed are the best of all, and of the
// ratios the median.
#include <bus_master.h>
#include <memory_target.h>
#include <simulation.h>

#include <dlfcn.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <axi/rtl_part.h>
#include <vp/axi_stream.h>
#include <vp/clock_scheduler.h>
#include <vp/configuration.h>
#include <vp/router.h>
#include <vp/rule_reports.h>

#include "rtl/recorder.h"

namespace {

constexpr unsigned rounds = 9;

/// What software writes once, in this order.
using Registers = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// Of the processor: others may work beside.
template <class Action>
double seconds(Action action) {
  const std::clock_t start = std::clock();
  action();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// The times of one thing, a round each.
class Series {
 public:
  void add(double time) { times_.push_back(time); }
  double best() const { return *std::min_element(times_.begin(), times_.end()); }
  Series less(const Series& other) const {
    Series rest;
    for (std::size_t i = 0; i < times_.size(); ++i) rest.add(times_[i] - other.times_[i]);
    return rest;
  }
  /// The median of the ratios of each round.
  double ratio(const Series& other) const {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < times_.size(); ++i) ratios.push_back(times_[i] / other.times_[i]);
    std::sort(ratios.begin(), ratios.end());
    return ratios[ratios.size() / 2];
  }

 private:
  std::vector<double> times_;
};

/// Sends words without pause, in packets of 64; TUSER, where the receiver has it, marks the first.
class Source final : public vp::Clocked {
 public:
  Source(sc_core::sc_module_name name, vp::Clock& clock, unsigned user_bits)
      : Clocked(name, clock) {
    m.set_shape({this->name(), 0, 0, user_bits});
  }
  vp::AxiStreamMaster m{"m", *this};

 private:
  void end_of_elaboration() override {
    Clocked::end_of_elaboration();
    for (auto& part : m.link().parts())
      if (part.part.field == vp::StreamField::user && part.part.low == 0) user_ = &part.wire;
  }
  void edge() override {
    if (!m.free()) return;
    if (user_) *user_ = word_ % 64 == 0;
    const bool last = ++word_ % 64 == 0;
    if (m.link().bytes() <= sizeof word_)
      return m.offer(word_, last, static_cast<std::uint8_t>((1u << m.link().bytes()) - 1));
    vp::StreamBytes beat;
    std::memcpy(beat.data.data(), &word_, sizeof word_);
    for (unsigned i = 0; i < m.link().bytes(); ++i) beat.keep.set(i);
    m.offer(beat, last);
  }
  std::uint32_t word_ = 0;
  vp::Signal<std::uint32_t>* user_ = nullptr;
};

class Sink final : public vp::Clocked {
 public:
  Sink(sc_core::sc_module_name name, vp::Clock& clock) : Clocked(name, clock) {
    s.set_shape({this->name(), 0});
  }
  vp::AxiStreamSlave s{"s", *this};

 private:
  void edge() override {
    s.sample();
    s.tready = true;
  }
};

/// The part with something at each of its interfaces.
struct System : kit::Simulation {
  /// Of the checkers of links, which one switch turns off.
  struct Switch {
    explicit Switch(bool watch) { configuration.set("checks.watch", watch ? "true" : "false"); }
    vp::Configuration configuration;
    vp::Configuration::Scope scope{configuration};
  };

  explicit System(const std::string& file, bool watch = true)
      : watching(watch), part("part", file, clocks(file)) {
    scheduler.set_batch(true);  // both as the platform does
    scheduler.set_lookahead(10'000'000);
    memory_bus.map("memory", 0, 0x10'0000).bind(memory.socket);
    other.socket.bind(memory_bus.socket);
    for (const axi::Interface& one : part.interfaces()) connect(one);
  }
  axi::RtlPart::ClockPins clocks(const std::string& file) {
    axi::RtlPart::ClockPins pins;
    for (const axi::Interface& one : axi::find_interfaces(pl::open_rtl(file)))
      if (one.kind == axi::Kind::clock) pins.emplace_back(one.name, &clock);
    return pins;
  }
  unsigned user_bits(const axi::Interface& stream) const {
    const auto found = stream.ports.find("tuser");
    return found == stream.ports.end() ? 0 : pl::open_rtl(part.file()).ports[found->second].bits;
  }
  void connect(const axi::Interface& one) {
    const bool bus = one.kind == axi::Kind::axi4 || one.kind == axi::Kind::axi_lite;
    if (bus && one.slave && !has_slave) {
      software.socket.bind(part.slave(one.name).socket);
      burst_bytes = one.kind == axi::Kind::axi4 ? 64 : 4;
      has_slave = true;
    } else if (bus && one.slave) {
      part.leave_open(one.name);
    } else if (bus) {
      part.master(one.name).read.link.socket.bind(memory_bus.socket);
      part.master(one.name).write.link.socket.bind(memory_bus.socket);
    } else if (one.kind == axi::Kind::axi_stream) {
      auto& link =
          *links.emplace_back(std::make_unique<vp::AxiStream>((one.name + "_link").c_str()));
      if (one.slave) {
        sources.push_back(
            std::make_unique<Source>((one.name + "_source").c_str(), clock, user_bits(one)));
        sources.back()->m(link);
        part.stream_in(one.name)(link);
      } else {
        sinks.push_back(std::make_unique<Sink>((one.name + "_sink").c_str(), clock));
        sinks.back()->s(link);
        part.stream_out(one.name, 0)(link);
      }
    } else if (one.kind == axi::Kind::wire && one.slave) {
      part.tie(one.name, 0);
    }
  }
  void run(std::uint64_t clock_count, const Registers& registers) {
    const std::uint64_t end = clock_count * 10'000;
    if (!has_slave) {
      software.socket.bind(memory_bus.socket);
      return sc_core::sc_start(sc_core::sc_time::from_value(end));
    }
    software.simulate([&] {
      for (const auto& [address, value] : registers) software.write(address, value);
      if (!registers.empty()) return scheduler.pass_until(end);
      unsigned char bytes[64] = {};
      for (unsigned i = 0; scheduler.now_ps() < end; ++i) {
        const bool read = i % 2 != 0;
        bytes[0] = static_cast<unsigned char>(i);
        software.prepare(read ? tlm::TLM_READ_COMMAND : tlm::TLM_WRITE_COMMAND, i * 64 % 4096,
                         bytes, burst_bytes);
        software.send();
      }
    });
  }

  Switch watching;
  vp::ProtocolChecks checks{"checks"};
  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clock{"clock", scheduler, 100'000'000};
  vp::Router memory_bus{"memory_bus"};
  kit::MemoryTarget memory{"memory", 0x10'0000};
  kit::BusMaster software{"software"}, other{"other"};
  bool has_slave = false;
  unsigned burst_bytes = 4;
  std::vector<std::unique_ptr<vp::AxiStream>> links;
  std::vector<std::unique_ptr<Source>> sources;
  std::vector<std::unique_ptr<Sink>> sinks;
  axi::RtlPart part;
};

/// The sources and sinks of a part's streams without it, each pair on one link.
struct Streams : kit::Simulation {
  explicit Streams(const std::string& file) {
    scheduler.set_batch(true);
    for (const axi::Interface& one : axi::find_interfaces(pl::open_rtl(file))) {
      if (one.kind != axi::Kind::axi_stream || !one.slave) continue;
      links.push_back(std::make_unique<vp::AxiStream>((one.name + "_link").c_str()));
      sources.push_back(std::make_unique<Source>((one.name + "_source").c_str(), clock, 0));
      sinks.push_back(std::make_unique<Sink>((one.name + "_sink").c_str(), clock));
      sources.back()->m(*links.back());
      sinks.back()->s(*links.back());
    }
  }
  void run(std::uint64_t clock_count) {
    sc_core::sc_start(sc_core::sc_time::from_value(clock_count * 10'000));
  }

  vp::ProtocolChecks checks{"checks"};
  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clock{"clock", scheduler, 100'000'000};
  std::vector<std::unique_ptr<vp::AxiStream>> links;
  std::vector<std::unique_ptr<Source>> sources;
  std::vector<std::unique_ptr<Sink>> sinks;
};

/// Evaluates the RTL on what was recorded; of the pins those are written that change.
double alone(const bench::Recording& recording) {
  struct Change {
    void* place;
    const unsigned char* from;
    std::size_t bytes;
  };
  void* model = recording.rtl->create("alone", 1000);
  std::vector<Change> changes;
  std::vector<std::size_t> ends;  // of the changes of each evaluation
  std::vector<const unsigned char*> before(recording.inputs.size());
  const unsigned char* from = recording.stimulus.data();
  for (std::size_t i = 0; i < recording.evaluations; ++i) {
    for (std::size_t k = 0; k < before.size(); ++k) {
      const auto& input = recording.inputs[k];
      if (!before[k] || std::memcmp(before[k], from, input.bytes) != 0)
        changes.push_back({recording.rtl->pin(model, input.port), from, input.bytes});
      before[k] = from;
      from += input.bytes;
    }
    ends.push_back(changes.size());
  }
  const double time = seconds([&] {
    std::size_t at = 0;
    for (const std::size_t end : ends) {
      for (; at < end; ++at)
        axi::copy_bytes(changes[at].place, changes[at].from, changes[at].bytes);
      recording.rtl->eval(model);
    }
  });
  recording.rtl->destroy(model);
  return time;
}

/// Of a new T, made of `arguments`.
template <class T, class Run, class... Arguments>
double seconds_of(Run run, Arguments... arguments) {
  T made(arguments...);
  return seconds([&] { run(made); });
}

}  // namespace

/// libsystemc refers to it.
extern "C" int sc_main(int, char**) {
  return 1;
}

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "bench_rtl_part FILE.so [CLOCKS] [ADDRESS=VALUE...]\n");
    return 2;
  }
  const std::uint64_t clocks = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 200'000;
  Registers registers;
  for (int i = 3; i < argc; ++i) {
    char* value = nullptr;
    const unsigned long address = std::strtoul(argv[i], &value, 0);
    if (*value == '=') registers.emplace_back(address, std::strtoul(value + 1, nullptr, 0));
  }
  sc_core::sc_report_handler::set_actions(sc_core::SC_WARNING, sc_core::SC_DO_NOTHING);
  sc_core::sc_report_handler::set_actions(sc_core::SC_INFO, sc_core::SC_DO_NOTHING);
  ::setenv("BENCH_RTL", argv[1], 1);
  {
    System system(BENCH_RECORDER);
    system.run(clocks, registers);
  }
  void* recorder = ::dlopen(BENCH_RECORDER, RTLD_NOW | RTLD_LOCAL);
  const auto recording =
      reinterpret_cast<bench::Recording* (*)()>(::dlsym(recorder, "bench_recording"))();
  const double nanoseconds = 1e9 / static_cast<double>(clocks);
  Series in_system, by_itself, streams, unwatched, counting;
  std::uint64_t edges = 0;
  for (unsigned i = 0; i < rounds; ++i) {
    in_system.add(seconds_of<System>([&](System& s) { s.run(clocks, registers); }, argv[1]));
    by_itself.add(alone(*recording));
    unwatched.add(seconds_of<System>([&](System& s) { s.run(clocks, registers); }, argv[1], false));
    streams.add(seconds_of<Streams>([&](Streams& s) { s.run(clocks); }, argv[1]));
    System system(argv[1]);
    if (const auto toggles = system.part.estimate().foreign.toggles; toggles.begin) toggles.begin();
    counting.add(seconds([&] { system.run(clocks, registers); }));
    edges = system.clock.edges_run();
  }
  std::printf(
      "%s: %.1f ns a clock, %.1f ns alone, %.2f x; without its sources and sinks, %.1f ns, %.2f x; "
      "checkers take %.1f %%, counted changes %.1f %%; %llu of %llu edges, %.2f evaluations each\n",
      argv[1], in_system.best() * nanoseconds, by_itself.best() * nanoseconds,
      in_system.ratio(by_itself), streams.best() * nanoseconds,
      in_system.less(streams).ratio(by_itself), (in_system.ratio(unwatched) - 1) * 100,
      (counting.ratio(in_system) - 1) * 100, static_cast<unsigned long long>(edges),
      static_cast<unsigned long long>(clocks),
      static_cast<double>(recording->evaluations) / static_cast<double>(clocks));
  return 0;
}
