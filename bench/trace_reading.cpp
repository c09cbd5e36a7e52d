// A VCD of 130 signals, 60 MB, read with all its values handed over; a round reads it once.
//   --mode=quiet   few signals change in a clock, as on the ports of the whole platform
//   --mode=busy    half of them do
#include <vp/wave_reader.h>
#include <vp/wave_writer.h>

#include <stdexcept>

#include "folder_in_memory.h"
#include "frame_benchmark.h"

namespace {

constexpr std::uintmax_t bytes = 60'000'000;
constexpr double bytes_per_mb = 1e6;
constexpr std::uint64_t clock_ps = 20'000;

/// The mixture of widths of the platform's ports.
unsigned width_of(unsigned i) {
  return i < 55 ? 1 : i < 85 ? 8 : i < 110 ? 10 : 32;
}
constexpr unsigned signals = 130;

void write_clocks(const std::filesystem::path& file, unsigned changes_per_clock,
                  std::uint64_t clocks) {
  const auto writer = vp::open_wave_writer(file);
  for (unsigned i = 0; i < signals; ++i) {
    writer->add("top.signal" + std::to_string(i), vp::WaveWriter::Kind::wire, width_of(i));
  }
  writer->begin(0, std::vector<std::uint64_t>(signals));
  const unsigned period = signals / changes_per_clock;
  for (std::uint64_t clock = 1; clock < clocks; ++clock) {
    writer->set_time(clock * clock_ps);
    for (unsigned i = clock % period; i < signals; i += period) {
      const std::uint64_t pattern = (clock / period + i) * 2654435761u;
      writer->change(i, width_of(i) == 1 ? clock / period & 1
                                         : pattern & ((std::uint64_t{1} << width_of(i)) - 1));
    }
  }
  writer->close(clocks * clock_ps);
}

/// So many clocks that the file has `bytes`, as the first ones tell.
void write_trace(const std::filesystem::path& file, unsigned changes_per_clock) {
  constexpr std::uint64_t first = 4096;
  write_clocks(file, changes_per_clock, first);
  write_clocks(file, changes_per_clock, first * (bytes / std::filesystem::file_size(file) + 1));
}

struct Sum : vp::WaveHandler {
  bool at(std::uint64_t ps) override {
    sum += ps;
    return true;
  }
  void change(std::uint32_t net, const vp::WaveValue& value) override { sum += net ^ value.bits; }
  std::uint64_t sum = 0;
};

void measure(benchmark::State& state, const bench::Arguments& arguments) {
  if (arguments.mode != "quiet" && arguments.mode != "busy") {
    throw std::invalid_argument("no mode '" + arguments.mode + "'");
  }
  const bench::FolderInMemory folder;
  write_trace(folder / "t.vcd", arguments.mode == "busy" ? signals / 2 : signals / 26);
  Sum sum;
  for (auto _ : state) {
    vp::WaveReader reader(folder / "t.vcd");
    reader.select_all();
    reader.read(sum);
  }
  benchmark::DoNotOptimize(sum.sum);
  state.counters["read_mb"] =
      static_cast<double>(std::filesystem::file_size(folder / "t.vcd")) / bytes_per_mb;
}

}  // namespace

int main(int argc, char** argv) {
  return bench::run_frames(argc, argv, "trace_reading", measure);
}
