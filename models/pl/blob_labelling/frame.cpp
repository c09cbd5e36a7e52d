#include <pl/blob_labelling/frame.h>

#include <algorithm>
#include <utility>

#include <pl/blob_labelling/group_core.h>

namespace pl {

bool LabelQueue::take(std::uint64_t now) {
  // One that left may be taken two clocks later.
  for (; !returns_.empty() && returns_.front() + 2 <= now; --taken_) returns_.pop_front();
  if (taken_ >= usable_) return false;
  ++taken_;
  return true;
}

std::uint64_t LabelQueue::leave(std::uint64_t now, bool shown) {
  constexpr std::uint64_t stages = 6;  // register, queue, address, memory, keys, output
  std::uint64_t leaves = std::max(now + stages, next_leave_);
  if (shown) leaves = std::max(leaves, next_shown_);
  next_leave_ = leaves + 2;  // a stage takes one in two clocks
  if (shown) next_shown_ = leaves + RunLabeller::clocks_per_blob;
  returns_.push_back(leaves);
  empty_from_ = leaves + shown;
  return leaves;
}

void LabellingFrame::find(const std::uint32_t* words, std::uint64_t begin, LabelQueue& queue,
                          std::vector<StampedExtremes>& blobs, std::vector<StampedLoss>& losses) {
  queue_ = &queue;
  blobs_ = &blobs;
  losses_ = &losses;
  parents_.clear();
  latest_.clear();
  extremes_.clear();
  above_.clear();
  queued_.clear();
  const std::size_t losses_before = losses.size();
  runs_ = 0;
  worked_ = 0;
  const std::uint32_t width = geometry_.width;
  for (y_ = 0, row_ = begin; y_ < geometry_.height; ++y_, words += width / 32) {
    dark_.load(words, width / 32);
    here_.clear();
    if (groups()) {
      find_row_of_groups();
    } else {
      find_row();
    }
    std::swap(above_, here_);
    row_ += geometry_.clocks_per_row();
  }
  for (const Run& run : above_) pass(run, groups() ? work() : step(run.last + 1));
  done_from_ = groups() ? work() : row_ + width + 2;
  add_up_losses(losses_before);
}

void LabellingFrame::find_row() {
  std::size_t above = 0;
  for (std::uint32_t first = dark_.next_set(0); first < geometry_.width;) {
    const std::uint32_t end = std::min(geometry_.width, dark_.next_clear(first));
    Run run{first, end - 1, 0, runs_++};
    label(run, above);
    first = dark_.next_set(end);
  }
  for (; above < above_.size(); ++above) pass(above_[above], step(above_[above].last + 1));
}

// `above`: the first run above that has not passed yet. A run asks for a label one clock after it
// was seen to end.
void LabellingFrame::label(Run& run, std::size_t& above) {
  for (; above < above_.size() && above_[above].last + 1 < run.first; ++above)
    pass(above_[above], step(above_[above].last + 1));
  bool labelled = false;
  for (std::size_t i = above; i < above_.size() && above_[i].first <= run.last + 1; ++i)
    touch(run, labelled, above_[i], step(above_[i].first));
  const bool at_edge = run.last + 1 == geometry_.width;
  finish(run, labelled, step(run.last + (at_edge ? 1 : 2)));
}

void LabellingFrame::find_row_of_groups() {
  std::size_t above = 0;
  for (std::uint32_t first = dark_.next_set(0); first < geometry_.width;) {
    const std::uint32_t end = std::min(geometry_.width, dark_.next_clear(first));
    Run run{first, end - 1, 0, runs_++};
    known_ = known_at(std::min(end, geometry_.width - 1));
    if (queue_up(run)) label_in_group(run, above);
    first = dark_.next_set(end);
  }
  known_ = known_at(geometry_.width - 1);
  for (; above < above_.size(); ++above) pass(above_[above], work());
  work();
}

void LabellingFrame::label_in_group(Run& run, std::size_t& above) {
  bool labelled = false;
  for (; above < above_.size() && above_[above].last <= run.last; ++above) {
    const std::uint64_t clock = work();
    if (above_[above].last + 1 < run.first) {
      pass(above_[above], clock);
    } else {
      touch(run, labelled, above_[above], clock);
    }
  }
  const std::uint64_t clock = work();
  if (above < above_.size() && above_[above].first <= run.last + 1)
    touch(run, labelled, above_[above], clock);
  queued_.push_back(clock);
  finish(run, labelled, clock);
}

// What the pixel in column `x` ends is in the FIFO, and worked on a clock later.
std::uint64_t LabellingFrame::known_at(std::uint32_t x) const {
  return row_ + x / geometry_.pixels_per_clock + GroupLabellingCore::clocks_to_fifo + 1;
}

// Room is what there was before the clock in which the run ended.
bool LabellingFrame::queue_up(const Run& run) {
  const std::uint64_t clock = known_ - 1;
  while (!queued_.empty() && queued_.front() < clock) queued_.pop_front();
  if (queued_.size() < fifo_depth_) return true;
  lose(run, clock);
  return false;
}

std::uint64_t LabellingFrame::work() {
  return worked_ = std::max(worked_ + 1, known_);
}

void LabellingFrame::touch(Run& run, bool& labelled, const Run& above, std::uint64_t clock) {
  if (above.component == none) return;
  const Component touched = root(above.component);
  if (labelled) {
    join(run.component, touched, clock);
  } else {
    run.component = touched;
    labelled = true;
  }
  latest_[run.component] = run.number;
}

void LabellingFrame::finish(Run& run, bool labelled, std::uint64_t clock) {
  if (labelled) {
    extremes_[run.component].join(Extremes(run.first, run.last, y_));
  } else {
    create(run, clock);
  }
  here_.push_back(run);
}

void LabellingFrame::create(Run& run, std::uint64_t clock) {
  if (!queue_->take(clock)) {
    run.component = none;
    return lose(run, clock);
  }
  run.component = static_cast<Component>(parents_.size());
  parents_.push_back(run.component);
  latest_.push_back(run.number);
  extremes_.emplace_back(run.first, run.last, y_);
}

void LabellingFrame::lose(const Run& run, std::uint64_t clock) {
  losses_->push_back({clock, run.last - run.first + 1});
}

// The FIFO may lose a run before the one that came before it finds no label.
void LabellingFrame::add_up_losses(std::size_t from) {
  std::vector<StampedLoss>& losses = *losses_;
  std::sort(losses.begin() + static_cast<std::ptrdiff_t>(from), losses.end(),
            [](const auto& a, const auto& b) { return a.clock < b.clock; });
  std::size_t kept = from;
  std::uint32_t lost = from == 0 ? 0 : losses[from - 1].lost;
  for (std::size_t i = from; i < losses.size(); ++i) {
    lost += losses[i].lost;
    if (kept == from || losses[kept - 1].clock != losses[i].clock) ++kept;
    losses[kept - 1] = {losses[i].clock, lost};
  }
  losses.resize(kept);
}

void LabellingFrame::join(Component& mine, Component other, std::uint64_t clock) {
  if (other == mine) return;
  leave(clock, false, {});
  // The older one stays: no path gets long.
  const Component stays = std::min(mine, other), goes = std::max(mine, other);
  parents_[goes] = stays;
  extremes_[stays].join(extremes_[goes]);
  mine = stays;
}

// A component is complete if its last run passed untouched.
void LabellingFrame::pass(const Run& run, std::uint64_t clock) {
  if (run.component == none) return;
  const Component component = root(run.component);
  if (latest_[component] != run.number) return;
  const Extremes& extremes = extremes_[component];
  leave(clock, extremes.at_least(minimum_side_), extremes);
}

void LabellingFrame::leave(std::uint64_t clock, bool shown, const Extremes& extremes) {
  const std::uint64_t leaves = queue_->leave(clock, shown);
  if (shown) blobs_->push_back({leaves, extremes});
}

LabellingFrame::Component LabellingFrame::root(Component component) {
  while (parents_[component] != component) {
    parents_[component] = parents_[parents_[component]];
    component = parents_[component];
  }
  return component;
}

}  // namespace pl
