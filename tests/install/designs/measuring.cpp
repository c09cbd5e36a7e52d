// Counts the bright pixels of an image, in a counter that ends at 1000.
#include "brightness.h"

#include <slcr_registers.h>

namespace {

int run() {
  constexpr std::uint8_t bright = 200;
  constexpr std::uint32_t most = 1000;
  while (const hal_frame* frame = hal_frame_next()) {
    brightness::Result result{frame->index, 0, 0};
    for (std::uint32_t y = 0; y < frame->height; ++y) {
      hal_read32(slcr::base);  // takes time
      for (std::uint32_t x = 0; x < frame->width; ++x) {
        if (frame->pixels[y * frame->width + x] < bright) continue;
        ++(result.bright < most ? result.bright : result.lost);
      }
    }
    hal_publish(brightness::kind, &result, sizeof result);
  }
  return 0;
}

}  // namespace

const hal_program hal_program_info = {HAL_ABI, "measuring", &run,    nullptr, 0,
                                      nullptr, 0,           nullptr, 0};
