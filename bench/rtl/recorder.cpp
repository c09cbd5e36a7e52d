// RTL in place of an IP that records the values at its pins on each evaluation. An object of
// markervp_add_rtl(), named by the variable BENCH_RTL, does the work.
#include "recorder.h"

#include <dlfcn.h>

#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

bench::Recording recording;

void* pin(void* model, uint32_t port) {
  if (recording.inputs.empty()) {
    for (uint32_t i = 0; i < recording.rtl->port_count; ++i) {
      const RtlPort& p = recording.rtl->ports[i];
      if (!p.output)
        recording.inputs.push_back({i, recording.rtl->pin(model, i), bench::bytes_of(p)});
    }
  }
  return recording.rtl->pin(model, port);
}

const RtlEnd* eval(void* model) {
  for (const bench::Recording::Input& input : recording.inputs) {
    const auto* bytes = static_cast<const unsigned char*>(input.place);
    recording.stimulus.insert(recording.stimulus.end(), bytes, bytes + input.bytes);
  }
  if (!recording.inputs.empty()) ++recording.evaluations;
  return recording.rtl->eval(model);
}

const RtlDescriptor* load() {
  const char* file = std::getenv("BENCH_RTL");
  void* library = file ? ::dlopen(file, RTLD_NOW | RTLD_LOCAL) : nullptr;
  void* symbol = library ? ::dlsym(library, RTL_SYMBOL) : nullptr;
  if (!symbol) {
    std::fprintf(stderr, "BENCH_RTL names no RTL: %s\n", file ? ::dlerror() : "it is not set");
    std::exit(2);
  }
  recording.rtl = reinterpret_cast<const RtlDescriptor* (*)()>(symbol)();
  static RtlDescriptor noting;
  noting = *recording.rtl;
  noting.eval = eval;
  noting.lower = nullptr;  // alone in Verilator each edge is evaluated
  noting.pin = pin;
  noting.state_bytes = 0;  // it never rests: alone in Verilator it does not either
  return &noting;
}

}  // namespace

extern "C" const RtlDescriptor* markervp_rtl() {
  static const RtlDescriptor* const descriptor = load();
  return descriptor;
}

extern "C" bench::Recording* bench_recording() {
  return &recording;
}
