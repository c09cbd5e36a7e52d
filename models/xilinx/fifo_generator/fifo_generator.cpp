#include <xilinx/fifo_generator/fifo_generator.h>

#include <string>

#include <vp/error.h>
#include <vp/report.h>
#include <xilinx/bram/bram.h>
#include <xilinx/common/axi_lite_ip.h>

namespace xilinx {

FifoGenerator::FifoGenerator(sc_core::sc_module_name name, vp::Clock& wr_clk, vp::Clock& rd_clk,
                             const FifoGeneratorBuild& build)
    : Clocked(name, wr_clk),
      Ip(&wr_clk),
      depth("depth", build.depth, vp::Unit::none, {16, 1u << 17}, vp::Source::published,
            "words that it is built for (PG057)"),
      build_(build),
      fifo_(wr_clk, rd_clk, build.common_clock ? 1 : build.synchroniser_stages + 1) {
  constexpr unsigned most_bits = 64;
  if (build.width < 1 || build.width > most_bits)
    throw vp::InputError(std::string(this->name()) + ": words of " + std::to_string(build.width) +
                         " bits are not modelled, those of 1 to 64 are");
  reader_ = std::make_unique<Reader>("read", rd_clk, *this, build.width);
}

std::uint32_t FifoGenerator::capacity() const {
  constexpr std::uint32_t fall_through_words = 2;
  return depth - (build_.common_clock ? 0 : 1) +
         (build_.first_word_fall_through ? fall_through_words : 0);
}

void FifoGenerator::before_end_of_elaboration() {
  Clocked::before_end_of_elaboration();
  for (vp::In<bool>* pin : {&reset, &wr_en})
    if (pin->bound()) pin->signal()->attach(*this);
}

void FifoGenerator::edge() {
  wr_ack = false;
  overflow = false;
  if (in_reset()) {
    fifo_.clear();
  } else if (wr_en.bound() && wr_en) {
    if (fifo_.writer_level() < capacity()) {
      fifo_.push(din.bound() ? din.read() : 0);
      ++writes;
      wr_ack = true;
    } else {
      overflow = true;
      ++lost;
      if (lost.get() == 1)
        vp::warn(*this, "/markervp/fifo_generator/overflow",
                 "a word was written while it was full, and is lost: look at 'full' before");
    }
    reader_->wake();
  }
  const std::size_t level = fifo_.writer_level();
  full = level >= capacity();
  almost_full = level + 1 >= capacity();
  const bool busy = (wr_en.bound() && wr_en) || wr_ack.written() || overflow.written();
  if (busy) return wake();
  sleep_until(fifo_.next_free());
}

vp::IpEstimate FifoGenerator::own_estimate() const {
  const bool two = !build_.common_clock;
  vp::IpEstimate e = axi_estimate("fifo_generator", two ? 80 : 40, two ? 150 : 45,
                                  block_ram_36(depth, build_.width));
  e.source = "assumed: counters and flags, and block memory for the words";
  e.active_clocks = [this] { return writes.get(); };
  return e;
}

FifoGenerator::Reader::Reader(sc_core::sc_module_name name, vp::Clock& clock, FifoGenerator& fifo,
                              unsigned width)
    : Clocked(name, clock), dout("dout", width), owner_(fifo) {}

void FifoGenerator::Reader::before_end_of_elaboration() {
  Clocked::before_end_of_elaboration();
  if (rd_en.bound()) rd_en.signal()->attach(*this);
  if (owner_.reset.bound()) owner_.reset.signal()->attach(*this);
}

void FifoGenerator::Reader::edge() {
  Fifo& fifo = owner_.fifo_;
  const bool falls_through = owner_.build_.first_word_fall_through;
  const bool asks = rd_en.bound() && rd_en && !owner_.in_reset();
  valid = false;
  underflow = false;
  if (asks && empty.get()) underflow = true;
  if (asks && !empty.get()) {
    if (!falls_through) {
      dout = fifo.front();
      valid = true;
    }
    fifo.pop();
    owner_.wake();
  }
  const std::size_t level = owner_.in_reset() ? 0 : fifo.reader_level();
  empty = level == 0;
  almost_empty = level <= 1;
  if (falls_through && level != 0) {
    dout = fifo.front();
    valid = true;
  }
  if ((rd_en.bound() && rd_en) || valid.written() || underflow.written()) return wake();
  sleep_until(fifo.next_visible());
}

}  // namespace xilinx
