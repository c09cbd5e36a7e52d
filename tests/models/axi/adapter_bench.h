#pragma once

#include <bus_master.h>
#include <simulation.h>

#include <cstdint>
#include <deque>
#include <functional>
#include <vector>

#include <axi/pins_to_tlm.h>
#include <axi/tlm_to_pins.h>
#include <vp/clock_scheduler.h>
#include <vp/mm_link.h>
#include <vp/random.h>
#include <vp/router.h>

namespace kit {

/// Both adapters of a link, on one clock: on the same wires, or with a register slice of two places
/// on each channel between them, which stalls at random.
class AdapterPair : public vp::Clocked {
 public:
  AdapterPair(sc_core::sc_module_name name, vp::Clock& clock, const axi::Shape& shape, bool stalls)
      : Clocked(name, clock),
        shape(shape),
        stalls_(stalls),
        manager("manager", clock, shape, near,
                [this](bool behind_edge) {
                  if (behind_edge) manager.drive();
                  wake();
                }),
        subordinate("subordinate", clock, shape, stalls ? far : near) {
    subordinate.drive();
  }

  const axi::Shape shape;

 private:
  const bool stalls_;

 public:
  axi::Wires near, far;
  axi::TlmToPins manager;
  axi::PinsToTlm subordinate;
  /// Called with the wires before each edge.
  std::function<void(const axi::Wires&)> watch;
  vp::RandomBits random{1};

 private:
  template <class Beat>
  struct Slice {
    std::deque<Beat> beats;
    /// What passes from one side to the other, before the edge and behind it.
    void move(Beat& from, Beat& to, vp::RandomBits& random) {
      if (to.passes()) beats.pop_front();
      if (from.passes()) beats.push_back(from);
      const bool held = to.valid && !to.ready;
      const bool ready = to.ready;
      if (!beats.empty()) to = beats.front();
      to.ready = ready;
      to.valid = !beats.empty() && (held || random.next() % 3 != 0);
      from.ready = beats.size() < 2 && random.next() % 3 != 0;
    }
  };

  void edge() override {
    if (watch) watch(near);
    manager.sample();
    subordinate.sample();
    if (stalls_) move();
    manager.drive();
    subordinate.drive();
    if (manager.idle() && subordinate.idle() && near.quiet() && far.quiet() && !stalls_) sleep();
  }
  /// READY of the two adapters is theirs: the slices set that of the other ends.
  void move() {
    aw_.move(near.aw, far.aw, random);
    w_.move(near.w, far.w, random);
    ar_.move(near.ar, far.ar, random);
    b_.move(far.b, near.b, random);
    r_.move(far.r, near.r, random);
  }

  Slice<axi::AddressChannel> aw_, ar_;
  Slice<axi::WriteChannel> w_;
  Slice<axi::ResponseChannel> b_;
  Slice<axi::ReadChannel> r_;
};

/// A memory that notes its transactions, with or without direct access.
class NotingMemory : public vp::MemoryTarget {
 public:
  NotingMemory(sc_core::sc_module_name name, std::uint64_t size) : MemoryTarget(name), bytes(size) {
    show(bytes.data(), 0, size);
  }
  std::vector<unsigned char> bytes;
  bool direct = false;
  sc_core::sc_time delay_of_all;
  tlm::tlm_response_status answer = tlm::TLM_OK_RESPONSE;
  struct Access {
    std::uint64_t address;
    unsigned length, width;
  };
  std::vector<Access> accesses;

 private:
  tlm::tlm_response_status check(const tlm::tlm_generic_payload&) const override { return answer; }
  void answered(const tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) override {
    accesses.push_back(
        {payload.get_address(), payload.get_data_length(), payload.get_streaming_width()});
    delay += delay_of_all;
  }
  bool get_direct_mem_ptr(tlm::tlm_generic_payload& payload, tlm::tlm_dmi& dmi) override {
    return direct && MemoryTarget::get_direct_mem_ptr(payload, dmi);
  }
};

/// Software, the two adapters, and a memory of 64 KiB behind them; above it nothing answers.
struct AdapterBench : Simulation {
  static constexpr std::uint64_t period = 10'000;  // ps
  static constexpr std::uint64_t memory_size = 0x1'0000;

  explicit AdapterBench(const axi::Shape& shape = {}, bool stalls = false)
      : pair("pair", clock, shape, stalls) {
    software.socket.bind(pair.manager.socket);
    pair.subordinate.read.link.socket.bind(router.socket);
    pair.subordinate.write.link.socket.bind(router.socket);
    router.map("memory", 0, memory_size).bind(memory.socket);
  }

  /// Accesses `length` bytes; returns the clocks that it took.
  std::uint64_t access(tlm::tlm_command command, std::uint64_t address, void* data, unsigned length,
                       unsigned width = ~0u) {
    software.prepare(command, address, data, length);
    software.payload.set_streaming_width(std::min(width, length));
    const std::uint64_t from = now_ps();
    software.send();
    return (now_ps() - from) / period;
  }

  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clock{"clock", scheduler, 100'000'000};
  BusMaster software{"software"};
  vp::Router router{"router"};
  NotingMemory memory{"memory", memory_size};
  AdapterPair pair;
};

}  // namespace kit
