#include <pl/blob_labelling/group_core.h>

#include <algorithm>
#include <utility>

namespace pl {

GroupLabellingCore::GroupLabellingCore(const Geometry& geometry, std::uint32_t labels,
                                       std::uint32_t minimum_side, std::uint32_t fifo_depth)
    : RunLabeller(geometry, labels, minimum_side),
      fifo_depth_(fifo_depth),
      places_(geometry.width) {}

void GroupLabellingCore::reset() {
  RunLabeller::reset();
  fifo_.clear();
  groups_ = {};
  dark_ = taken_ = false;
  rows_ = row_ = above_ = here_ = 0;
  label_ = 0;
}

// Everything looks at the registers as they stood before this clock, what is nearer to the output
// first. Room in the FIFO, too, is what there was before.
void GroupLabellingCore::clock(bool ena, std::uint32_t dark, std::uint32_t x, std::uint32_t y) {
  const Label returned = leave();
  const std::size_t room = fifo_depth_ - fifo_.size();
  const bool taken = busy_ && work();
  move_free_labels(taken, returned);
  if (groups_.back().valid) find_runs(groups_.back(), room);
  std::copy_backward(groups_.begin(), groups_.end() - 1, groups_.end());
  groups_.front() = {ena, dark, x, y};
  if (ena) busy_ = true;
}

// True if it took a new label.
bool GroupLabellingCore::work() {
  const bool runs = !fifo_.empty() && fifo_.front().y == row_;
  if (!runs && row_ >= rows_) return false;  // what comes next is not known
  if (!taken_ && above_ == 0 && !runs) return end_row();
  if (!taken_ && above_ != 0) {
    above_run_ = places_[next_above()];
    take_above();
    taken_ = true;
    --above_;
  }
  const Run run = runs ? fifo_.front() : Run{geometry_.width + 1, geometry_.width + 1, row_};
  const bool beyond = taken_ && above_run_.first > run.last + 1;
  const bool touches = taken_ && !beyond && above_run_.last + 1 >= run.first;
  if (touches) touch();
  if (taken_ && !beyond && above_run_.last <= run.last) {
    pass();
    taken_ = false;
    return false;
  }
  places_[next_here()] = run;
  ++here_;
  fifo_.pop_front();
  const bool is_new = finish_run(run);
  label_ = 0;
  return is_new;
}

// Behind the frame is one row more, without runs.
bool GroupLabellingCore::end_row() {
  above_ = std::exchange(here_, 0);
  if (row_++ == geometry_.height) {
    busy_ = false;
    rows_ = row_ = 0;
  }
  return false;
}

void GroupLabellingCore::find_runs(const Group& group, std::size_t room) {
  for (std::uint32_t lane = 0; lane < geometry_.pixels_per_clock; ++lane) {
    const bool dark = (group.dark >> lane & 1) != 0;
    const std::uint32_t x = group.x + lane;
    if (dark && !dark_) run_first_ = x;
    if (!dark && dark_) end_run(x - 1, group.y, room);
    dark_ = dark;
  }
  if (group.x + geometry_.pixels_per_clock != geometry_.width) return;
  if (dark_) end_run(geometry_.width - 1, group.y, room);
  dark_ = false;
  rows_ += group.y + 1 == geometry_.height ? 2 : 1;
}

void GroupLabellingCore::end_run(std::uint32_t last, std::uint32_t y, std::size_t& room) {
  if (room == 0) return lose(last - run_first_ + 1);
  fifo_.push_back({run_first_, last, y});
  --room;
}

}  // namespace pl
