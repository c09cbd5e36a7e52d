#include <apps/algorithms/self_test.h>
#include <hal/hal.h>
#include <marker/work.h>

extern "C" {
#define GOLDEN(name)                         \
  extern const char golden_##name##_begin[]; \
  extern const char golden_##name##_end[];
GOLDEN(demo)
GOLDEN(roll30)
GOLDEN(squares15)
#undef GOLDEN
}

namespace {

const algorithms::GoldenText texts[] = {
    {"demo", golden_demo_begin, golden_demo_end},
    {"roll30", golden_roll30_begin, golden_roll30_end},
    {"squares15", golden_squares15_begin, golden_squares15_end},
};

algorithms::SelfTest self_test;

int run() {
  int failures = 0;
  for (const algorithms::GoldenText& text : texts) {
    if (!self_test.run(text)) failures = 1;
  }
  return failures;
}

}  // namespace

const hal_program hal_program_info = {HAL_ABI,
                                      "algorithms",
                                      &run,
                                      marker::work_names,
                                      static_cast<std::uint32_t>(marker::Work::count),
                                      marker::function_names,
                                      static_cast<std::uint32_t>(marker::Function::count),
                                      nullptr,
                                      0};
