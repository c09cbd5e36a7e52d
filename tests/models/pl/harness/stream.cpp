#include "stream.h"

#include <vp/clock_scheduler.h>

#include <utility>

namespace harness {

StreamSink::StreamSink(sc_core::sc_module_name name, vp::Clock& clk) : Clocked(name, clk) {
  wake_on(s.tvalid);
}

void StreamSink::edge() {
  if (s.sample()) beats.push_back({clock().scheduler().now_ps(), s.tdata, s.tlast});
  if (!s.tvalid) sleep();
}

void StreamSource::send(std::vector<std::uint32_t> words, std::uint32_t packet) {
  words_ = std::move(words);
  packet_ = packet;
  offered_ = accepted_ = 0;
  wake();
}

void StreamSource::edge() {
  if (m.accepted()) ++accepted_;
  if (!m.free()) return;
  if (offered_ < words_.size()) {
    const std::uint32_t word = words_[offered_++];
    m.offer(word, offered_ % packet_ == 0);
  } else {
    m.withdraw();
    sleep();
  }
}

}  // namespace harness
