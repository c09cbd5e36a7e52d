// A PS program that finds nothing and says of its first frame that every list was too short, and of
// its second that it gave it up. Of its fourth it says nothing.
#include <drivers/timers.h>
#include <hal/hal.h>
#include <marker/result.h>
#include <marker/work.h>

namespace {

marker::FrameResult result;

int run() {
  drivers::GlobalTimer timer{};
  timer.initialise();
  while (const hal_frame* frame = hal_frame_next()) {
    marker::clear(result);
    result.frame = frame->index;
    result.times.frame.start = timer.now();
    if (frame->index == 0) {
      result.lost_words = 1;
      result.features.lost_corners = 2;
      result.features.lost_blobs = 3;
      result.candidates.lost = 4;
      result.features.malformed = 5;
    } else if (frame->index == 1) {
      result.status = marker::Status::binary_timeout;
    }
    marker::work(marker::Work::corner_pixels, 100'000);
    if (frame->index == 3) continue;
    result.times.frame.end = timer.now();
    hal_publish(marker::frame_result_kind, &result, sizeof result);
  }
  return 0;
}

}  // namespace

extern "C" {
const hal_program hal_program_info = {HAL_ABI,
                                      "losses",
                                      run,
                                      marker::work_names,
                                      static_cast<std::uint32_t>(marker::Work::count),
                                      marker::function_names,
                                      static_cast<std::uint32_t>(marker::Function::count),
                                      nullptr,
                                      0};
}
