// A PS program that reports its first frame and then makes a mistake.
#include <hal/hal.h>
#include <marker/result.h>

namespace {

// No device of the PL is there; UG585 table 4-1 gives the range to GP0.
constexpr std::uint32_t unmapped = 0x5000'0000;
constexpr std::uint32_t features = 0x4121'0000;
constexpr std::uint32_t control = 0x4120'0000;

enum class Mistake {
  reads_unmapped,
  writes_unmapped,
  reads_between,
  polls_forever,
  sleeps_forever,
  publishes_rubbish,
  transfers_unflushed,
  transfers_flushed
};

// An image for the PL, through DMA 0.
void transfer(bool flushed) {
  constexpr std::uint32_t dma = 0x4040'0000, bytes = 128;
  const hal_dma_buffer buffer = hal_dma_allocate(bytes, 32);
  if (flushed) hal_cache_flush(buffer.data, buffer.size);
  hal_write32(dma, 1);
  hal_write32(dma + 0x18, buffer.bus_address);
  hal_write32(dma + 0x28, bytes);
  for (int i = 0; i < 100; ++i) hal_read32(dma + 4);
}

void make(Mistake mistake) {
  switch (mistake) {
    case Mistake::reads_unmapped:
      hal_read32(unmapped);
      break;
    case Mistake::writes_unmapped:
      hal_write32(unmapped + 4, 1);
      break;
    case Mistake::reads_between:
      hal_read32(control + 2);
      break;
    case Mistake::polls_forever:
      while (!hal_poll_until_changed(features, hal_read32(features), 10, 1000).changed) {
      }
      break;
    case Mistake::sleeps_forever:
      hal_wait_for_interrupt();
      break;
    case Mistake::publishes_rubbish:
      hal_publish(HAL_KIND('R', 'U', 'B', '!'), &mistake, sizeof mistake);
      break;
    case Mistake::transfers_unflushed:
      transfer(false);
      break;
    case Mistake::transfers_flushed:
      transfer(true);
      break;
  }
}

const hal_option_info options[] = {
    {"mistake", "", 0, 0, 7, "what the program does wrong after its first frame"}};

int entry() {
  static marker::FrameResult result;
  while (const hal_frame* frame = hal_frame_next()) {
    hal_read32(control);
    if (frame->index == 1) make(static_cast<Mistake>(static_cast<int>(hal_option(0))));
    marker::clear(result);
    result.frame = frame->index;
    hal_publish(marker::frame_result_kind, &result, sizeof result);
  }
  return 0;
}

}  // namespace

extern "C" {
const hal_program hal_program_info = {HAL_ABI, "faulty", entry, nullptr, 0, nullptr, 0, options, 1};
}
