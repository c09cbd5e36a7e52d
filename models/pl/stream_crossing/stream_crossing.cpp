#include <pl/stream_crossing/stream_crossing.h>

#include <string>

#include <pl/common/estimate.h>
#include <pl/common/rtl_model.h>
#include <vp/error.h>

namespace pl {

namespace {

class RtlStreamCrossing final : public StreamCrossing {
 public:
  RtlStreamCrossing(sc_core::sc_module_name name, const Site& site, const RtlFile& file)
      : StreamCrossing(name, site),
        entry_("entry", site.clk),
        exit_("exit", *site.m_clk),
        rtl_(file, models().ip(), this->name(), ports(), {&entry_, &exit_}) {
    entry_.play(rtl_, 0);
    exit_.play(rtl_, 1);
    set_foreign(rtl_.foreign());
  }

  CrossingEntry& entry() override { return entry_; }
  CrossingExit& exit() override { return exit_; }

 private:
  void end_of_simulation() override { rtl_.finish(); }
  IpPorts ports() {
    IpPorts ports(false, entry_.clock());
    connect(ports);
    return ports;
  }

  RtlSide<CrossingEntry> entry_;
  RtlSide<CrossingExit> exit_;
  RtlInPlace rtl_;
};

}  // namespace

Models<StreamCrossing>& StreamCrossing::models() {
  static Models<StreamCrossing> models{
      "stream_crossing",
      {model<StreamCrossing, StreamCrossingClocked>("clocked", no_image, no_image)},
      rtl_model<StreamCrossing, StreamCrossingClocked, RtlStreamCrossing>()};
  return models;
}

StreamCrossing::StreamCrossing(sc_core::sc_module_name name, const Site& site)
    : sc_module(name), Ip(site.m_clk) {
  if ((depth & (depth - 1)) == 0) return;
  throw vp::InputError(std::string(depth.name()) + " is " + std::to_string(depth) +
                       ": its counts cross in Gray code, so give 8, 16, 32, 64, 128 or 256");
}

void StreamCrossing::m(vp::AxiStream& link) {
  exit().m(link);
  entry().taker_ready(link.tready);
}

void StreamCrossing::connect(IpPorts& ports) {
  vp::AxiStreamSlave& s = entry().s;
  ports.input(entry().rst);
  ports.input(s.tdata);
  ports.input(s.tvalid);
  ports.input(s.tlast);
  ports.output<bool>(
      "s_tready", 1, [&s]() -> auto& { return s.link().tready; });
  if (!ports.watched) ports.before_edge = [&s] { s.sample(); };
  ports.clock("m_clk", exit().clock());
  add_stream(ports, exit().m);
  ports.parameter("DEPTH", depth.name(), depth);
}

vp::IpEstimate StreamCrossing::own_estimate() const {
  return synthesised_ip("stream_crossing", {{"DEPTH", depth}});
}

CrossingEntry::CrossingEntry(sc_core::sc_module_name name, vp::Clock& clk) : Clocked(name, clk) {
  wake_on(rst);
  wake_on(s.tvalid);
  wake_on(taker_ready);
}

CrossingExit::CrossingExit(sc_core::sc_module_name name, vp::Clock& clk) : Clocked(name, clk) {
  wake_on(m.tready);
}

CrossingEntryClocked::CrossingEntryClocked(sc_core::sc_module_name name, vp::Clock& clk,
                                           CrossingFifo& fifo)
    : CrossingEntry(name, clk), fifo_(fifo) {
  wake_on(read_count);
}

void CrossingEntryClocked::edge() {
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
  // Behind a beat the next one may wait already, and counts from its first edge on.
  if (rests && !passes && !(ready && s.tvalid)) sleep();
}

CrossingExitClocked::CrossingExitClocked(sc_core::sc_module_name name, vp::Clock& clk,
                                         CrossingFifo& fifo)
    : CrossingExit(name, clk), fifo_(fifo) {
  wake_on(write_count);
  wake_on(flush);
  m.reset_by(flush);
}

// A word is offered from the memory, and read when it has passed.
void CrossingExitClocked::edge() {
  if (flush_.seen()) {
    read_count = write_count_.seen();
  } else if (m.accepted()) {
    read_count = read_count.written() + 1;
  }
  write_count_.sample(write_count);
  flush_.sample(flush);
  const std::uint32_t next = read_count.written();
  const bool empty = next == write_count_.seen();
  if (flush_.seen() || empty) {
    if (flush_.seen()) m.excuse();
    m.withdraw();
  } else {
    m.offer(fifo_.at(next).data, fifo_.at(next).last);
  }
  const bool moves = flush_.seen() ? !empty : !empty && m.tready;
  if (!moves && write_count_.rests_at(write_count) && flush_.rests_at(flush)) sleep();
}

StreamCrossingClocked::StreamCrossingClocked(sc_core::sc_module_name name, const Site& site)
    : StreamCrossing(name, site),
      entry_("entry", site.clk, fifo_),
      exit_("exit", *site.m_clk, fifo_) {
  entry_.read_count(exit_.read_count);
  exit_.write_count(entry_.write_count);
  exit_.flush(entry_.flush);
}

}  // namespace pl
