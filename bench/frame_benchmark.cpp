#include "frame_benchmark.h"

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <exception>
#include <iostream>

#include "images.h"

/// libsystemc refers to it.
extern "C" int sc_main(int, char**) {
  return 1;
}

namespace bench {

namespace {

int benchmark_one(int argc, char** argv, const char* name,
                  const std::function<void(benchmark::State&, const Arguments&)>& measure) {
  benchmark::Initialize(&argc, argv);
  Arguments arguments;
  CLI::App app{"Measures whole frames."};
  app.add_option("--image", arguments.image)->check(CLI::IsMember(image_names()));
  app.add_option("--frames", arguments.frames)->check(CLI::Range(1, 1'000'000));
  app.add_option("--mode", arguments.mode);
  app.add_option("--set", arguments.settings);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  }
  benchmark::RegisterBenchmark(name, [&](benchmark::State& state) { measure(state, arguments); })
      ->Iterations(arguments.frames)
      ->Unit(benchmark::kMillisecond)
      ->MeasureProcessCPUTime();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

}  // namespace

int run_frames(int argc, char** argv, const char* name,
               const std::function<void(benchmark::State&, const Arguments&)>& measure) {
  ::setenv("SYSTEMC_DISABLE_COPYRIGHT_MESSAGE", "1", 1);
  try {
    return benchmark_one(argc, argv, name, measure);
  } catch (const std::exception& error) {
    std::cerr << name << ": " << error.what() << '\n';
    return 1;
  }
}

std::string hash_text(std::uint64_t hash) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

}  // namespace bench
