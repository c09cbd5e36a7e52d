#include <pl/global_threshold/core.h>

namespace pl {

void ThresholdCore::end_frame() {
  threshold_ = static_cast<std::uint8_t>((dark_peak_ + bright_peak_) / 2);
  clear_histogram();
}

void ThresholdCore::clear_histogram() {
  histogram_.fill(0);
  dark_count_ = bright_count_ = 0;
  dark_peak_ = 0;
  bright_peak_ = 255;
}

}  // namespace pl
