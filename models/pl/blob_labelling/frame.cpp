#include <pl/blob_labelling/frame.h>

#include <algorithm>
#include <utility>

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
  if (shown) next_shown_ = leaves + LabellingCore::clocks_per_blob;
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
  runs_ = 0;
  const std::uint32_t width = geometry_.width;
  for (y_ = 0, row_ = begin; y_ < geometry_.height; ++y_, row_ += width, words += width / 32) {
    dark_.load(words, width / 32);
    here_.clear();
    std::size_t above = 0;
    for (std::uint32_t first = dark_.next_set(0); first < width;) {
      const std::uint32_t end = std::min(width, dark_.next_clear(first));
      Run run{first, end - 1, 0, runs_++};
      label(run, above);
      first = dark_.next_set(end);
    }
    for (; above < above_.size(); ++above) pass(above_[above]);
    std::swap(above_, here_);
  }
  for (const Run& run : above_) pass(run);
}

// `above`: the first run above that has not passed yet.
void LabellingFrame::label(Run& run, std::size_t& above) {
  for (; above < above_.size() && above_[above].last + 1 < run.first; ++above) pass(above_[above]);
  bool labelled = false;
  for (std::size_t i = above; i < above_.size() && above_[i].first <= run.last + 1; ++i) {
    const Component touched = root(above_[i].component);
    if (labelled) {
      join(run.component, touched, step(above_[i].first));
    } else {
      run.component = touched;
      labelled = true;
    }
    latest_[run.component] = run.number;
  }
  if (labelled) {
    extremes_[run.component].join(Extremes(run.first, run.last, y_));
    here_.push_back(run);
  } else {
    create(run);
  }
}

// A run asks for a label one clock after it was seen to end.
void LabellingFrame::create(Run& run) {
  const bool at_edge = run.last + 1 == geometry_.width;
  const std::uint64_t clock = step(run.last + (at_edge ? 1 : 2));
  if (!queue_->take(clock)) {
    const std::uint32_t before = losses_->empty() ? 0 : losses_->back().lost;
    losses_->push_back({clock, before + run.last - run.first + 1});
    return;
  }
  run.component = static_cast<Component>(parents_.size());
  parents_.push_back(run.component);
  latest_.push_back(run.number);
  extremes_.emplace_back(run.first, run.last, y_);
  here_.push_back(run);
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
void LabellingFrame::pass(const Run& run) {
  const Component component = root(run.component);
  if (latest_[component] != run.number) return;
  const Extremes& extremes = extremes_[component];
  leave(step(run.last + 1), extremes.at_least(minimum_side_), extremes);
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
