#include <ps/cpu/cpu_settings.h>

namespace ps {

using namespace vp::literals;

namespace {

constexpr vp::Range<std::uint32_t> cycles_range{0, 1'000'000};

}  // namespace

CpuSettings::CpuSettings()
    : stack_size("stack_size", 8_MiB, vp::Unit::bytes, {64_KiB, 1_GiB}, vp::Source::decision,
                 "stack of the program"),
      quantum("quantum", 100_us, vp::Unit::time, {0, 1000_s}, vp::Source::decision,
              "how far the program may run ahead of the simulation; no result depends on it"),
      timeout("timeout", 10_s, vp::Unit::time, {1_us, 1'000'000_s}, vp::Source::decision,
              "the run ends if the program neither ends nor asks for an input for so long"),
      after_main("after_main", 100_ms, vp::Unit::time, {0, 1'000'000_s}, vp::Source::decision,
                 "how long interrupts that a plain program left enabled are served behind its "
                 "main(), at most"),
      host_timeout("host_timeout", 10_s, vp::Unit::time, {100_ms, 1'000'000_s},
                   vp::Source::decision,
                   "the run ends if the program takes so much of the host's processor time, or "
                   "waits so long, while no simulated time passes"),
      loop_blocks("loop_blocks", 100'000, vp::Unit::none, {1'000, 1'000'000'000},
                  vp::Source::decision,
                  "basic blocks without HAL call or annotation after which time jumps to what "
                  "happens next"),
      interrupt_entry("interrupt_entry", 100, vp::Unit::cycles, cycles_range, vp::Source::published,
                      "from nIRQ to the handler, warm caches: below 100 (jblopen.com, Zynq-7000)"),
      interrupt_exit("interrupt_exit", 60, vp::Unit::cycles, cycles_range, vp::Source::assumed,
                     "from the handler back to the program"),
      barrier_cycles("barrier_cycles", 20, vp::Unit::cycles, cycles_range, vp::Source::assumed,
                     "a data synchronisation barrier"),
      cache_call_cycles("cache_call_cycles", 60, vp::Unit::cycles, cycles_range,
                        vp::Source::assumed, "a cache operation before its first line"),
      cache_line_cycles("cache_line_cycles", 20, vp::Unit::cycles, cycles_range,
                        vp::Source::assumed, "a line of 32 bytes in both cache levels"),
      cache_all_cycles("cache_all_cycles", 100'000, vp::Unit::cycles, cycles_range,
                       vp::Source::assumed,
                       "an operation on both cache levels as a whole: 17408 lines, by set and way"),
      uncached_scale("uncached_scale", 10, vp::Unit::none, {1, 1'000}, vp::Source::assumed,
                     "how much longer code takes while the data caches are off"),
      block_cycles("block_cycles", 0, vp::Unit::cycles, {0, 1'000}, vp::Source::decision,
                   "what each basic block of the program's own code takes, beside the work that it "
                   "counts; 0: by its instructions, or nothing where the program counts its work"),
      code_scale("code_scale", 1, vp::Unit::none, {0, 1'000}, vp::Source::decision,
                 "how long the code of a program takes that does not count its work, as a multiple "
                 "of what the profile says; 0: no time") {}

}  // namespace ps
