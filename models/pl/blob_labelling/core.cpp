#include <pl/blob_labelling/core.h>

#include <algorithm>
#include <utility>

namespace pl {

std::uint32_t Extremes::point(std::size_t extreme) const {
  using namespace blob_stream;
  const std::uint32_t distance = keys_[extreme] >> 16, then = keys_[extreme] & 0xFFFF;
  switch (extreme) {
    case least_y:
      return blob_stream::point(then, distance);
    case greatest_x_minus_y:
      return blob_stream::point(far + then - distance, then);
    case greatest_x:
      return blob_stream::point(far - distance, then);
    case greatest_x_plus_y:
      return blob_stream::point(far - distance - then, then);
    case greatest_y:
      return blob_stream::point(then, far - distance);
    case least_x_minus_y:
      return blob_stream::point(distance + then - far, then);
    case least_x:
      return blob_stream::point(distance, then);
    default:
      return blob_stream::point(distance - then, then);
  }
}

void FreeLabels::reset() {
  free_.clear();
  for (std::uint32_t label = 2; label < labels_; ++label)
    free_.push_back(static_cast<Label>(label));
  next_ = 1;
}

void FreeLabels::clock(bool taken, Label returned) {
  if (taken || next_ == 0) {
    next_ = free_.empty() ? Label{0} : free_.front();
    if (next_ != 0) free_.pop_front();
  }
  if (returned != 0) free_.push_back(returned);
}

LabellingCore::LabellingCore(const Geometry& geometry, std::uint32_t labels,
                             std::uint32_t minimum_side)
    : width_(geometry.width),
      height_(geometry.height),
      minimum_side_(minimum_side),
      free_(labels),
      extremes_(labels),
      first_(labels),
      last_(labels),
      line_(geometry.width),
      runs_(geometry.width),
      has_left_(geometry.width),
      has_right_(geometry.width) {}

void LabellingCore::reset() {
  free_.reset();
  read_ = write_ = 0;
  pixel_ = decided_ = {};
  flush_ = 0;
  busy_ = dark_ = dark_above_ = run_ended_ = false;
  open_.clear();
  leaving_.clear();
  done_ = {};
  stages_ = {};
  spacing_ = 0;
  shows_ = false;
  overflow_ = 0;
}

bool LabellingCore::idle() const {
  const bool leaving =
      done_.label != 0 || !leaving_.empty() ||
      std::any_of(stages_.begin(), stages_.end(), [](const Leaving& l) { return l.label != 0; });
  return !busy_ && !leaving && !shows_;
}

// Everything looks at the registers as they stood before this clock, what is nearer to the output
// first.
void LabellingCore::clock(bool ena, bool dark, std::uint32_t x, std::uint32_t y) {
  const Label returned = leave();
  bool taken = false;
  const bool ends_frame = decided_.valid && decided_.y > height_;
  if (decided_.valid) {
    if (run_ended_) taken = finish_run();
    step();
  }
  free_.clock(taken, returned);
  decided_ = pixel_;
  capture(ena, dark, x, y);
  if (ends_frame && !decided_.valid && !pixel_.valid) busy_ = false;
}

// A frame is followed by one bright row and a pixel more: its last runs pass.
void LabellingCore::capture(bool ena, bool dark, std::uint32_t x, std::uint32_t y) {
  if (flush_ != 0) {
    --flush_;
    const bool next_row = ++pixel_.x == width_;
    pixel_ = {true, false, next_row ? 0 : pixel_.x, pixel_.y + next_row};
    return;
  }
  pixel_.valid = ena;
  if (!ena) return;
  busy_ = true;
  pixel_ = {true, dark, x, y};
  if (x + 1 == width_ && y + 1 == height_) flush_ = width_ + 1;
}

// A stage takes the next label when it was empty before this clock.
LabellingCore::Label LabellingCore::leave() {
  const auto before = stages_;
  auto& output = stages_.back();
  const bool shows = output.blob && extremes_[output.label].at_least(minimum_side_);
  shows_ = shows && spacing_ == 0;
  if (shows_) shown_ = extremes_[output.label];
  const bool leaves = shows_ || !shows;
  spacing_ = shows_ ? clocks_per_blob - 1 : spacing_ - (spacing_ != 0);
  const Label returned = leaves ? output.label : Label{0};
  if (leaves) output = {};
  for (std::size_t i = 1; i < before.size(); ++i) {
    if (before[i].label != 0 || before[i - 1].label == 0) continue;
    stages_[i] = before[i - 1];
    stages_[i - 1] = {};
  }
  if (before[0].label == 0 && !leaving_.empty()) {
    stages_[0] = leaving_.front();
    leaving_.pop_front();
  }
  if (done_.label != 0) leaving_.push_back(std::exchange(done_, {}));
  return returned;
}

void LabellingCore::step() {
  const auto [valid, dark, x, y] = decided_;
  const bool first_column = x == 0;
  if (first_column && dark_above_) pass();  // the last run of the row before
  const bool dark_before = !first_column && dark_, above_before = !first_column && dark_above_;
  const bool above = y > 0 && y <= height_ && line_[x];
  const bool starts = dark && !dark_before, above_starts = above && !above_before;
  if (starts) {
    run_first_ = x;
    label_ = 0;
  }
  if (above_starts) take_above();
  if (starts ? above || above_before : dark_before && above_starts) touch();
  if (above_before && !above) pass();
  if (dark) run_last_ = x, run_y_ = y;
  run_ended_ = (dark_before && !dark) || (dark && x + 1 == width_);
  line_[x] = dark;
  dark_ = dark;
  dark_above_ = above;
}

void LabellingCore::take_above() {
  const bool left = has_left_[read_];
  above_ = left ? open_.back() : Above{runs_[read_]};
  above_.left = left;
  above_.place = read_;
  read_ = read_ + 1 == width_ ? 0 : read_ + 1;
}

void LabellingCore::touch() {
  if (above_.label == 0 || above_.label == label_) return;
  if (label_ != 0) return join();
  label_ = above_.label;
  linked_ = above_.seen;
  above_.seen = true;
}

// Two components turn out to be one. If that of the run above has runs in this row already, it lies
// around the present one, whose label will not be met again in the row above: the outer label
// stays, and what this row has of the inner one is linked to it. Otherwise it has none to be
// linked, and takes the label of the present run.
void LabellingCore::join() {
  if (above_.seen) {
    const Label outer = above_.label;
    if (linked_) {
      has_left_[first_[label_]] = true;
      has_right_[last_[outer]] = true;
      last_[outer] = last_[label_];
    }
    extremes_[outer].join(extremes_[label_]);
    done_ = {label_, false};
    label_ = outer;
    linked_ = true;
  } else {
    extremes_[label_].join(extremes_[above_.label]);
    done_ = {above_.label, false};
    above_.label = label_;
    above_.seen = true;
  }
}

void LabellingCore::pass() {
  if (above_.label == 0) return;
  if (above_.left) open_.pop_back();
  if (has_right_[above_.place]) {
    open_.push_back(above_);
  } else if (!above_.seen) {
    done_ = {above_.label, true};
  }
}

// True if it took a new label.
bool LabellingCore::finish_run() {
  const Extremes run(run_first_, run_last_, run_y_);
  bool taken = false;
  if (label_ != 0) {
    extremes_[label_].join(run);
  } else {
    label_ = free_.next();
    linked_ = false;
    taken = true;
    if (label_ != 0) {
      extremes_[label_] = run;
    } else {
      overflow_ += run_last_ - run_first_ + 1;
    }
  }
  write_run();
  return taken;
}

void LabellingCore::write_run() {
  runs_[write_] = label_;
  has_left_[write_] = linked_;
  has_right_[write_] = false;
  if (linked_) {
    has_right_[last_[label_]] = true;
  } else {
    first_[label_] = write_;
  }
  last_[label_] = write_;
  write_ = write_ + 1 == width_ ? 0 : write_ + 1;
}

}  // namespace pl
