// A PS program that sets the pixel clock between its frames, tells of it on UART 1, and measures
// with the private timer how long that takes. The feature extraction of each frame is timed as
// `hybrid` does it.
#include <apps/hybrid/pl_link.h>
#include <drivers/slcr.h>
#include <drivers/timers.h>
#include <drivers/uart.h>
#include <hal/hal.h>
#include <marker/result.h>
#include <marker/work.h>
#include <marker_logic.h>
#include <uart_registers.h>

namespace {

/// Pixel clock of each frame, Hz; 0 leaves it. The last one changes in the midst of the frame.
constexpr std::uint32_t pixel_clocks[] = {0, 25'000'000, 100'000'000, 50'000'000, 100'000'000};
constexpr std::uint32_t changed_in_the_midst = 4;

constexpr std::uint64_t timeout = 100'000'000;  // counts: 0.3 s

hybrid::PlLink link;
drivers::Slcr clocks;
drivers::Uart console;
drivers::PrivateTimer stopwatch;
marker::WordStore words;
marker::FrameResult result;

void set_pixel_clock(std::uint32_t frame) {
  if (frame >= sizeof pixel_clocks / sizeof *pixel_clocks || pixel_clocks[frame] == 0) return;
  const std::uint32_t given = clocks.set_pl_clock(1, pixel_clocks[frame]);
  if (given != pixel_clocks[frame] || clocks.pl_clock(1) != given) result.lost_words = 1;
}

/// Sends a line and returns the counts until its last bit has left.
std::uint32_t tell(std::uint32_t frame) {
  char line[] = "frame 0\n";
  line[6] = static_cast<char>('0' + frame);
  constexpr std::uint32_t start = 0xFFFF'FFFF;
  stopwatch.start(start);
  console.write(line, sizeof line - 1);
  while (!console.is_idle()) {
  }
  return start - stopwatch.remaining();
}

void process(const hal_frame& frame, const hal_dma_buffer& binary) {
  marker::clear(result);
  result.frame = frame.index;
  result.width = frame.width;
  result.height = frame.height;
  if (frame.index < changed_in_the_midst) set_pixel_clock(frame.index);
  result.times.upload.end = tell(frame.index);  // its start is 0: a duration

  link.upload(frame.bus_address, frame.width * frame.height, timeout);
  link.prepare_frame(binary.bus_address, frame.width * frame.height / 8);
  result.times.frame.start = result.times.feature_extraction.start = link.now();
  link.start_frame();
  if (frame.index == changed_in_the_midst) set_pixel_clock(frame.index);
  result.status = link.receive_features(words, timeout);
  result.times.feature_extraction.end = result.times.frame.end = link.now();
  link.await_binary_image(timeout);
  hal_cache_invalidate(binary.data, binary.size);
  result.feature_words = words.count;
}

int run() {
  clocks.initialise({});
  stopwatch.initialise({1, false, false});
  if (!console.initialise({uart::uart1_base})) return 1;
  if (!link.initialise(marker_logic::usual_burst_words * marker_logic::bytes_per_word)) return 1;
  const hal_dma_buffer binary = hal_dma_allocate(640 * 480 / 8, 4096);
  while (const hal_frame* frame = hal_frame_next()) {
    process(*frame, binary);
    hal_publish(marker::frame_result_kind, &result, sizeof result);
  }
  link.shut_down();
  return 0;
}

}  // namespace

extern "C" {
const hal_program hal_program_info = {HAL_ABI,
                                      "ps_devices",
                                      run,
                                      marker::work_names,
                                      static_cast<std::uint32_t>(marker::Work::count),
                                      marker::function_names,
                                      static_cast<std::uint32_t>(marker::Function::count),
                                      nullptr,
                                      0};
}
