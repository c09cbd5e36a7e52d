// The clocked models of the feature extraction, both clock domains, driven like the RTL.
//   --mode=ports      every port is observable, none is observed (the usual one)
//   --mode=registers  and a tracer follows all registers of the detectors
//   --mode=vcd        and a tracer writes the detectors' ports into a VCD in memory
#include <vp/trace.h>

#include <filesystem>
#include <memory>
#include <stdexcept>

#include "folder_in_memory.h"
#include "frame_benchmark.h"
#include "images.h"
#include "pipeline.h"

namespace {

const std::vector<std::string> detectors{"pl.sensor_input", "pl.corner_detection",
                                         "pl.global_threshold", "pl.blob_detection"};

vp::TraceOptions trace_options(const std::string& mode, const std::filesystem::path& file) {
  vp::TraceOptions options;
  options.filter = vp::TraceFilter(detectors);
  if (mode == "registers") {
    options.level = vp::TraceLevel::registers;
    options.file = "/dev/null";
  } else if (mode == "vcd") {
    options.file = file;
  } else {
    throw std::invalid_argument("no mode '" + mode + "'");
  }
  return options;
}

void run_frame(harness::Pipeline& pipeline) {
  pipeline.driver.start_frame();
  sc_core::sc_start();
}

void measure(benchmark::State& state, const bench::Arguments& arguments) {
  harness::Pipeline pipeline({}, arguments.settings);
  pipeline.load(bench::make_image(arguments.image));
  const bench::FolderInMemory folder;
  const std::filesystem::path file = folder / "frames.vcd";
  std::unique_ptr<vp::Tracer> tracer;
  if (!arguments.mode.empty() && arguments.mode != "ports") {
    tracer = std::make_unique<vp::Tracer>("tracer", pipeline.scheduler,
                                          trace_options(arguments.mode, file));
  }
  pipeline.scheduler.set_batch(true);
  for (int i = 0; i < bench::warm_up_frames; ++i) run_frame(pipeline);
  for (auto _ : state) run_frame(pipeline);
  state.SetLabel(bench::hash_text(harness::hash(pipeline.words())));
  if (!tracer) return;
  state.counters["traced"] = static_cast<double>(tracer->size());
  tracer->close();
  if (arguments.mode == "vcd") {
    state.counters["vcd_mb_per_frame"] = static_cast<double>(std::filesystem::file_size(file)) /
                                         1e6 / (arguments.frames + bench::warm_up_frames);
  }
}

}  // namespace

int main(int argc, char** argv) {
  return bench::run_frames(argc, argv, "clocked", measure);
}
