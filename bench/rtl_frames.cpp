// Verilated RTL: one frame after the other, as fast as it takes them. BENCH_RTL says which.
#include "frame_benchmark.h"
#include "images.h"
#include "rtl_pipeline.h"

int main(int argc, char** argv) {
  return bench::run_frames(
      argc, argv, "rtl", [](benchmark::State& state, const bench::Arguments& arguments) {
        bench::BENCH_RTL rtl;
        rtl.load(bench::make_image(arguments.image));
        for (int i = 0; i < bench::warm_up_frames; ++i) rtl.run_frame();
        for (auto _ : state) rtl.run_frame();
        state.counters["corners"] = static_cast<double>(harness::count(rtl.words(), 'C'));
        state.counters["blobs"] = static_cast<double>(harness::count(rtl.words(), 'B'));
        state.SetLabel(bench::hash_text(harness::hash(rtl.words())));
      });
}
