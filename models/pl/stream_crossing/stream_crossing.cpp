#include <pl/stream_crossing/stream_crossing.h>

#include <string>

#include <marker_logic.h>
#include <pl/common/estimate.h>
#include <vp/error.h>

namespace pl {

CrossingEntry::CrossingEntry(sc_core::sc_module_name name, vp::Clock& clk, CrossingFifo& fifo)
    : Clocked(name, clk), fifo_(fifo) {
  wake_on(rst);
  wake_on(s.tvalid);
  wake_on(read_count);
  wake_on(taker_ready);
}

void CrossingEntry::edge() {
  read_count_.sample(read_count);
  taker_ready_.sample(taker_ready);
  const bool passes = s.sample();
  flush = rst;
  if (rst) {
    in_packet_ = false;
  } else if (passes) {
    fifo_.at(write_count.written()) = {s.tdata, s.tlast};
    write_count = write_count.written() + 1;
    in_packet_ = !s.tlast;
  }
  const std::uint32_t under_way = write_count.written() - read_count_.seen();
  const bool ready =
      !rst && (in_packet_ ? under_way < fifo_.depth() : under_way == 0 && taker_ready_.seen());
  s.tready = ready;
  const bool rests = read_count_.rests_at(read_count) && taker_ready_.rests_at(taker_ready);
  if (rests && !(ready && s.tvalid)) sleep();
}

CrossingExit::CrossingExit(sc_core::sc_module_name name, vp::Clock& clk, CrossingFifo& fifo)
    : Clocked(name, clk), fifo_(fifo) {
  wake_on(write_count);
  wake_on(flush);
  wake_on(m.tready);
}

void CrossingExit::edge() {
  write_count_.sample(write_count);
  flush_.sample(flush);
  const std::uint32_t next = read_count.written();
  if (flush_.seen()) {
    m.withdraw();
    read_count = write_count_.seen();
  } else if (m.free()) {
    if (next == write_count_.seen()) {
      m.withdraw();
    } else {
      m.offer(fifo_.at(next).data, fifo_.at(next).last);
      read_count = next + 1;
    }
  }
  const bool waits = m.tvalid.written() && !m.tready;
  const bool moves = !waits && (m.tvalid.written() || read_count.written() != write_count_.seen());
  if (!moves && write_count_.rests_at(write_count) && flush_.rests_at(flush)) sleep();
}

StreamCrossing::StreamCrossing(sc_core::sc_module_name name, vp::Clock& pixel_clk, vp::Clock& clk)
    : sc_module(name), Ip(&clk), entry("entry", pixel_clk, fifo_), exit("exit", clk, fifo_) {
  entry.read_count(exit.read_count);
  exit.write_count(entry.write_count);
  exit.flush(entry.flush);
  if ((depth & (depth - 1)) == 0) return;
  throw vp::InputError(std::string(depth.name()) + " is " + std::to_string(depth) +
                       ": its counts cross in Gray code, so give 8, 16, 32, 64, 128 or 256");
}

void StreamCrossing::m(vp::AxiStream& link) {
  exit.m(link);
  entry.taker_ready(link.tready);
}

// Distributed memory of 33 bits; two counts, each once more in Gray code and twice on the other
// side; the output register; TREADY and the reset on their way.
vp::IpEstimate StreamCrossing::own_estimate() const {
  constexpr std::uint32_t word_bits = 33, deepest_memory = 32, bits_of_memory = 6, luts = 4;
  const std::uint32_t count_bits = marker_logic::bits_for(depth, 1) + 1;
  const std::uint32_t memories = (depth + deepest_memory - 1) / deepest_memory *
                                 ((word_bits + bits_of_memory - 1) / bits_of_memory);
  vp::IpEstimate e = small_ip("stream_crossing", luts * memories + 12 * count_bits,
                              word_bits + 8 * count_bits + 8, 250 * mhz);
  e.source = "derived from the model's registers; memory as RAM32M (UG474)";
  e.fmax_origin = vp::FmaxOrigin::estimated;
  e.fmax_documentation =
      "counts of a few bits and distributed memory, as in the FIFO generator's (PG057), which is "
      "faster";
  return e;
}

}  // namespace pl
