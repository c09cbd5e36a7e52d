#include <pl/blob_labelling/run_labeller.h>

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

RunLabeller::RunLabeller(const Geometry& geometry, std::uint32_t labels, std::uint32_t minimum_side)
    : geometry_(geometry),
      minimum_side_(minimum_side),
      free_(labels),
      extremes_(labels),
      first_(labels),
      last_(labels),
      runs_(geometry.width),
      has_left_(geometry.width),
      has_right_(geometry.width) {}

void RunLabeller::reset() {
  free_.reset();
  read_ = write_ = 0;
  busy_ = false;
  open_.clear();
  leaving_.clear();
  done_ = {};
  stages_ = {};
  spacing_ = 0;
  shows_ = false;
  overflow_ = 0;
}

bool RunLabeller::idle() const {
  const bool leaving =
      done_.label != 0 || !leaving_.empty() ||
      std::any_of(stages_.begin(), stages_.end(), [](const Leaving& l) { return l.label != 0; });
  return !busy_ && !leaving && !shows_;
}

// A stage takes the next label when it was empty before this clock.
RunLabeller::Label RunLabeller::leave() {
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

void RunLabeller::take_above() {
  const bool left = has_left_[read_];
  above_ = left ? open_.back() : Above{runs_[read_]};
  above_.left = left;
  above_.place = read_;
  read_ = behind(read_);
}

void RunLabeller::touch() {
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
void RunLabeller::join() {
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

void RunLabeller::pass() {
  if (above_.label == 0) return;
  if (above_.left) open_.pop_back();
  if (has_right_[above_.place]) {
    open_.push_back(above_);
  } else if (!above_.seen) {
    done_ = {above_.label, true};
  }
}

bool RunLabeller::finish_run(const Run& ended) {
  const Extremes run(ended.first, ended.last, ended.y);
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
      lose(ended.last - ended.first + 1);
    }
  }
  write_run();
  return taken;
}

void RunLabeller::write_run() {
  runs_[write_] = label_;
  has_left_[write_] = linked_;
  has_right_[write_] = false;
  if (linked_) {
    has_right_[last_[label_]] = true;
  } else {
    first_[label_] = write_;
  }
  last_[label_] = write_;
  write_ = behind(write_);
}

}  // namespace pl
