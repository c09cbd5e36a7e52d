#pragma once

#include <cstdint>

#include <vp/parameter.h>

namespace xilinx {

/// Latencies of an AXI DMA and of the memory behind it, in cycles of its clock.
///
/// They give 10 000 bytes at 100 MHz and 32 bits the published throughput: memory to stream 399.0
/// MB/s from the first data on, stream to memory 298.6 MB/s with latency (PG021).
struct DmaTiming {
  using Cycles = vp::Parameter<std::uint32_t>;
  static constexpr vp::Range<std::uint32_t> range{0, 10'000};

  Cycles run_latency{"run_latency",         2,
                     vp::Unit::cycles,      range,
                     vp::Source::published, "RS written to Halted changed (HDL of v7.1)"};
  Cycles address_latency{
      "address_latency",     2,
      vp::Unit::cycles,      range,
      vp::Source::published, "LENGTH written to the address register sampled (HDL of v7.1)"};
  Cycles start_latency{
      "start_latency",
      11,
      vp::Unit::cycles,
      range,
      vp::Source::published,
      "LENGTH written to first address or TREADY: state machine 3, DataMover 8 (PG022)"};
  Cycles read_latency{
      "read_latency",        6,
      vp::Unit::cycles,      range,
      vp::Source::published, "read address to first TVALID without the memory (PG021)"};
  Cycles memory_read_latency{
      "memory_read_latency",
      20,
      vp::Unit::cycles,
      range,
      vp::Source::measured,
      "read address to first data from DDR through a high performance port, 100 MHz "
      "(pynqz2-ram-tester: about 21 for bursts of 16)"};
  Cycles write_latency{
      "write_latency",
      23,
      vp::Unit::cycles,
      range,
      vp::Source::derived,
      "last beat of a burst to its write address: 39 after the first of 16 (PG021)"};
  Cycles write_gap{
      "write_gap",         10,
      vp::Unit::cycles,    range,
      vp::Source::derived, "between two write bursts: from 298.6 MB/s for 10 000 bytes (PG021)"};
  Cycles memory_write_latency{
      "memory_write_latency", 20,
      vp::Unit::cycles,       range,
      vp::Source::assumed,    "last write data to write response; as for reads"};
  Cycles completion_latency{
      "completion_latency", 5,
      vp::Unit::cycles,     range,
      vp::Source::assumed,  "last beat or write response to the status register"};
  Cycles reset_cycles{
      "reset_cycles",        8,
      vp::Unit::cycles,      range,
      vp::Source::published, "soft reset, once outstanding bursts are over (HDL of v7.1)"};
};

}  // namespace xilinx
