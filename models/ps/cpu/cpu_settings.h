#pragma once

#include <cstdint>

#include <vp/parameter.h>

namespace ps {

/// What can be set of a processor; all its cores share it.
struct CpuSettings {
  CpuSettings();

  vp::Parameter<std::uint64_t> stack_size;
  vp::Parameter<std::uint64_t> quantum;
  vp::Parameter<std::uint64_t> timeout;
  vp::Parameter<std::uint64_t> after_main;
  vp::Parameter<std::uint64_t> host_timeout;
  vp::Parameter<std::uint64_t> loop_blocks;
  vp::Parameter<std::uint32_t> interrupt_entry;
  vp::Parameter<std::uint32_t> interrupt_exit;
  vp::Parameter<std::uint32_t> barrier_cycles;
  vp::Parameter<std::uint32_t> cache_call_cycles;
  vp::Parameter<std::uint32_t> cache_line_cycles;
  vp::Parameter<std::uint32_t> cache_all_cycles;
  vp::Parameter<double> uncached_scale;
  vp::Parameter<std::uint32_t> block_cycles;
  vp::Parameter<double> code_scale;
};

}  // namespace ps
