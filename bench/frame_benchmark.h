#pragma once

#include <benchmark/benchmark.h>

#include <functional>
#include <string>
#include <vector>

#include "frames.h"

namespace bench {

/// Options of the whole-frame benchmark programs, in addition to Google Benchmark's own.
struct Arguments {
  std::string image = "demo";         ///< --image=NAME
  int frames = 10;                    ///< --frames=N, timed
  std::string mode;                   ///< --mode=NAME; empty: the program's usual one
  std::vector<std::string> settings;  ///< --set=path=value
};

/// Frames before the timed ones: the threshold adapts to the picture, memory becomes warm.
constexpr int warm_up_frames = 2;

/// Runs `measure` once; the loop over its state has one frame per round. SystemC can elaborate
/// once in a process, so a process measures one variant. Returns the exit code.
int run_frames(int argc, char** argv, const char* name,
               const std::function<void(benchmark::State&, const Arguments&)>& measure);

/// The hash of a frame's words as text, for the label: equal if two programs found the same words
/// at the same clocks.
std::string hash_text(std::uint64_t hash);

}  // namespace bench
