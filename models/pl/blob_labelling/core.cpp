#include <pl/blob_labelling/core.h>

namespace pl {

LabellingCore::LabellingCore(const Geometry& geometry, std::uint32_t labels,
                             std::uint32_t minimum_side)
    : RunLabeller(geometry, labels, minimum_side), line_(geometry.width) {}

void LabellingCore::reset() {
  RunLabeller::reset();
  pixel_ = decided_ = {};
  flush_ = 0;
  dark_ = dark_above_ = run_ended_ = false;
}

// Everything looks at the registers as they stood before this clock, what is nearer to the output
// first.
void LabellingCore::clock(bool ena, std::uint32_t dark, std::uint32_t x, std::uint32_t y) {
  const Label returned = leave();
  bool taken = false;
  const bool ends_frame = decided_.valid && decided_.y > geometry_.height;
  if (decided_.valid) {
    if (run_ended_) taken = finish_run(run_);
    step();
  }
  move_free_labels(taken, returned);
  decided_ = pixel_;
  capture(ena, (dark & 1) != 0, x, y);
  if (ends_frame && !decided_.valid && !pixel_.valid) busy_ = false;
}

// A frame is followed by one bright row and a pixel more: its last runs pass.
void LabellingCore::capture(bool ena, bool dark, std::uint32_t x, std::uint32_t y) {
  if (flush_ != 0) {
    --flush_;
    const bool next_row = ++pixel_.x == geometry_.width;
    pixel_ = {true, false, next_row ? 0 : pixel_.x, pixel_.y + next_row};
    return;
  }
  pixel_.valid = ena;
  if (!ena) return;
  busy_ = true;
  pixel_ = {true, dark, x, y};
  if (x + 1 == geometry_.width && y + 1 == geometry_.height) flush_ = geometry_.width + 1;
}

void LabellingCore::step() {
  const auto [valid, dark, x, y] = decided_;
  const bool first_column = x == 0;
  if (first_column && dark_above_) pass();  // the last run of the row before
  const bool dark_before = !first_column && dark_, above_before = !first_column && dark_above_;
  const bool above = y > 0 && y <= geometry_.height && line_[x];
  const bool starts = dark && !dark_before, above_starts = above && !above_before;
  if (starts) {
    run_.first = x;
    label_ = 0;
  }
  if (above_starts) take_above();
  if (starts ? above || above_before : dark_before && above_starts) touch();
  if (above_before && !above) pass();
  if (dark) run_.last = x, run_.y = y;
  run_ended_ = (dark_before && !dark) || (dark && x + 1 == geometry_.width);
  line_[x] = dark;
  dark_ = dark;
  dark_above_ = above;
}

}  // namespace pl
