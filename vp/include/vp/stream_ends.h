#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <vector>

#include <vp/axi_stream.h>
#include <vp/clock.h>

namespace vp {

/// The master of a stream in a test bench: sends the beats it is given, one a clock.
class StreamSource : public Clocked {
 public:
  StreamSource(sc_core::sc_module_name name, Clock& clock) : Clocked(name, clock) {}

  AxiStreamMaster m_axis{"m_axis", *this};
  unsigned sent = 0;  ///< beats that passed

  /// Queues a beat.
  void send(std::uint32_t data, bool last, std::uint8_t keep = 0xF) {
    queue_.push_back({data, last, keep});
    if (!awake()) wake();
  }
  /// Forgets those that were not offered yet.
  void drop() { queue_.clear(); }

 private:
  struct Beat {
    std::uint32_t data;
    bool last;
    std::uint8_t keep;
  };
  void edge() override {
    if (m_axis.accepted()) ++sent;
    if (!m_axis.free()) return;
    if (queue_.empty()) {
      m_axis.withdraw();
      sleep();
      return;
    }
    const Beat beat = queue_.front();
    queue_.pop_front();
    m_axis.offer(beat.data, beat.last, beat.keep);
  }
  std::deque<Beat> queue_;
};

/// The slave of a stream in a test bench: takes beats, and keeps them with the cycle on which each
/// passed.
class StreamSink : public Clocked {
 public:
  StreamSink(sc_core::sc_module_name name, Clock& clock) : Clocked(name, clock) {
    wake_on(s_axis.tvalid);
  }

  struct Beat {
    std::uint64_t cycle;
    std::uint32_t data;
    bool last;
    std::uint8_t keep;
  };

  AxiStreamSlave s_axis{"s_axis", *this};
  std::vector<Beat> beats;
  /// What tready becomes on an edge.
  std::function<bool(std::uint64_t)> ready_on = [](std::uint64_t) { return true; };
  /// tready stays low, and the module asleep as long as it can, until this edge.
  std::uint64_t sleep_until = 0;

 private:
  void edge() override {
    const std::uint64_t cycle = clock().cycle();
    if (s_axis.sample()) {
      beats.push_back({cycle, s_axis.tdata, s_axis.tlast, s_axis.tkeep});
    }
    if (cycle < sleep_until) {
      s_axis.tready = false;
      sleep();
      wake_at(sleep_until);
      return;
    }
    wake();
    s_axis.tready = ready_on(cycle);
  }
};

}  // namespace vp
