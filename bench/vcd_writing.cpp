// 130 signals that change as in the platform, for 10 000 clocks a round; what a trace of them
// costs.
//   --mode=untraced       no trace
//   --mode=own            vp::Tracer
//   --mode=sc_trace       SystemC's own
// with "-busy" behind it half of the signals change in every clock, as inside a detector; otherwise
// a few do, as on the ports of the whole platform.
#include <vp/clock.h>
#include <vp/clock_scheduler.h>
#include <vp/signal.h>
#include <vp/trace.h>

#include <deque>
#include <memory>
#include <stdexcept>
#include <string>

#include "folder_in_memory.h"
#include "frame_benchmark.h"
#include "simulation.h"

namespace {

constexpr std::uint64_t clocks_per_round = 10'000;
constexpr std::uint64_t clock_hz = 50'000'000;

/// The mixture of widths of the platform's ports.
constexpr unsigned flags = 55, bytes = 30, coordinates = 25, words = 20;
constexpr unsigned signals = flags + bytes + coordinates + words;
static_assert(signals == 130);

/// Signal i changes in every period(i)-th clock.
class Activity : public vp::Clocked {
 public:
  Activity(sc_core::sc_module_name name, vp::Clock& clock, unsigned changes_per_clock)
      : Clocked(name, clock), period_(signals / changes_per_clock) {
    const auto name_of = [](const char* kind, unsigned i) { return kind + std::to_string(i); };
    for (unsigned i = 0; i < flags; ++i) flags_.emplace_back(name_of("flag", i).c_str());
    for (unsigned i = 0; i < bytes; ++i) bytes_.emplace_back(name_of("byte", i).c_str());
    for (unsigned i = 0; i < coordinates; ++i) {
      coordinates_.emplace_back(name_of("coordinate", i).c_str(), 10);
    }
    for (unsigned i = 0; i < words; ++i) words_.emplace_back(name_of("word", i).c_str());
  }

  /// Calls visit(signal) for each.
  template <class Visit>
  void for_each(const Visit& visit) {
    for (auto& signal : flags_) visit(signal);
    for (auto& signal : bytes_) visit(signal);
    for (auto& signal : coordinates_) visit(signal);
    for (auto& signal : words_) visit(signal);
  }

 private:
  void edge() override {
    ++edges_;
    const unsigned phase = edges_ % period_;
    change(flags_, phase);
    change(bytes_, phase);
    change(coordinates_, phase);
    change(words_, phase);
  }

  template <class T>
  void change(std::deque<vp::Signal<T>>& group, unsigned phase) {
    for (std::size_t i = phase; i < group.size(); i += period_) {
      // Another pattern each time, with few bits and many: 10, 32 bits and so on hold all of them.
      group[i] =
          static_cast<T>(std::is_same_v<T, bool> ? !group[i].get() : group[i].get() + edges_);
    }
  }

  unsigned period_;
  std::uint32_t edges_ = 0;
  std::deque<vp::Signal<bool>> flags_;
  std::deque<vp::Signal<std::uint8_t>> bytes_;
  std::deque<vp::Signal<std::uint16_t>> coordinates_;
  std::deque<vp::Signal<std::uint32_t>> words_;
};

struct Mode {
  std::string tracer = "own";
  bool busy = false;
};

Mode parse(const std::string& text) {
  Mode mode;
  const auto dash = text.find('-');
  mode.busy = dash != std::string::npos;
  if (!text.empty()) mode.tracer = text.substr(0, dash);
  const bool known = mode.tracer == "untraced" || mode.tracer == "own" || mode.tracer == "sc_trace";
  if (!known || (mode.busy && text.substr(dash) != "-busy")) {
    throw std::invalid_argument("no mode '" + text + "'");
  }
  return mode;
}

/// sc_trace with the widths that the signals have.
template <class T>
void sc_trace_signal(sc_core::sc_trace_file* file, const vp::Signal<T>& signal) {
  if constexpr (std::is_same_v<T, bool>) {
    sc_core::sc_trace(file, signal.read(), signal.name());
  } else {
    sc_core::sc_trace(file, signal.read(), signal.name(), static_cast<int>(signal.width()));
  }
}

void measure(benchmark::State& state, const bench::Arguments& arguments) {
  const Mode mode = parse(arguments.mode);
  const kit::Simulation simulation;
  vp::ClockScheduler scheduler("scheduler");
  vp::Clock clock("clock", scheduler, clock_hz);
  Activity activity("activity", clock, mode.busy ? signals / 2 : signals / 26);
  const bench::FolderInMemory folder;
  std::unique_ptr<vp::Tracer> own;
  sc_core::sc_trace_file* standard = nullptr;
  if (mode.tracer == "own") {
    vp::TraceOptions options;
    options.file = folder / "own.vcd";
    own = std::make_unique<vp::Tracer>("tracer", scheduler, options);
  } else if (mode.tracer == "sc_trace") {
    standard = sc_core::sc_create_vcd_trace_file((folder / "standard").c_str());
    activity.for_each([&](const auto& signal) { sc_trace_signal(standard, signal); });
  }
  // One activation of the kernel per clock for all: sc_trace looks between activations.
  const sc_core::sc_time round = vp::from_ps(clock.duration_ps(clocks_per_round));
  sc_core::sc_start(round);
  for (auto _ : state) sc_core::sc_start(round);
  if (standard) sc_core::sc_close_vcd_trace_file(standard);
  if (own) own->close();
}

}  // namespace

int main(int argc, char** argv) {
  return bench::run_frames(argc, argv, "vcd", measure);
}
