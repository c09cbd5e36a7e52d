#include <apps/improved/both_cores.h>

#include <algorithm>

#include <blob_stream.h>

namespace improved {
namespace {

/// So that no core waits long for the other's last one, and locks cost little (decision).
constexpr std::uint32_t pieces_of_a_frame = 32;

BothCores* started;

void add(marker::BlobCounts& sum, const marker::BlobCounts& more) {
  sum.received += more.received;
  sum.malformed += more.malformed;
  sum.small += more.small;
  for (std::uint32_t i = 0; i < sum.refused.size(); ++i) sum.refused[i] += more.refused[i];
  sum.lost += more.lost;
  sum.background += more.background;
}

}  // namespace

void BothCores::start(const marker::Dictionary& dictionary,
                      const marker::DetectorOptions& options) {
  for (Part& part : parts_) part.detector.open(dictionary, options);
  poses_ = options.board.kind == marker::Board::Kind::none;
  lock_ = {0, "blobs"};
  asked_ = answered_ = 0;
  started = this;
  hal_cpu_start(1, &BothCores::run_second);
}

void BothCores::run_second() {
  BothCores& self = *started;
  for (std::uint32_t frame = 1;; ++frame) {
    while (hal_load_acquire(&self.asked_) != frame) hal_wait_for_event();
    self.work(self.parts_[1]);
    hal_store_release(&self.answered_, frame);
    hal_send_event();
  }
}

void BothCores::find(const marker::CameraFrame& frame, const marker::BlobList& blobs,
                     marker::Detections& found) {
  frame_ = &frame;
  blobs_ = blobs;
  blobs_each_ = blobs.count / pieces_of_a_frame + 1;
  next_ = 0;
  hal_shared_write(&next_, sizeof next_);
  const std::uint32_t number = asked_ + 1;
  hal_store_release(&asked_, number);
  hal_send_event();
  work(parts_[0]);
  while (hal_load_acquire(&answered_) != number) hal_wait_for_event();
  merge(found);
}

/// Takes the next free piece. False: no piece is left.
bool BothCores::take(std::uint32_t& piece) {
  hal_lock_acquire(&lock_);
  hal_shared_write(&next_, sizeof next_);
  piece = next_;
  const bool is_one = piece * blobs_each_ < blobs_.count;
  if (is_one) ++next_;
  hal_lock_release(&lock_);
  return is_one;
}

void BothCores::work(Part& part) {
  hal_shared_write(&part, sizeof part);
  part.blobs = {};
  part.count = 0;
  for (std::uint32_t piece = 0; take(piece);) {
    const std::uint32_t first = piece * blobs_each_;
    const marker::BlobList blobs{blobs_.words + first * blob_stream::words_per_blob,
                                 std::min(blobs_each_, blobs_.count - first)};
    part.detector.find_markers(*frame_, blobs, part.piece);
    if (poses_) part.detector.find_poses(frame_->lens.camera, part.piece);
    keep(part, piece);
  }
}

void BothCores::keep(Part& part, std::uint32_t piece) const {
  add(part.blobs, part.piece.blobs);
  for (std::uint32_t i = 0; i < part.piece.count; ++i) {
    if (part.count == marker::max_detections) {
      ++part.blobs.lost;
      continue;
    }
    part.pieces[part.count] = piece;
    part.markers[part.count++] = part.piece.markers[i];
  }
}

/// In the order of the blobs, and as many as one core would have kept.
void BothCores::merge(marker::Detections& found) const {
  hal_shared_read(parts_.data(), sizeof parts_);
  marker::clear(found);
  std::array<std::uint32_t, 2> at{};
  const auto left = [&](unsigned core) { return at[core] < parts_[core].count; };
  for (const Part& part : parts_) add(found.blobs, part.blobs);
  while (left(0) || left(1)) {
    const bool second = !left(0) || (left(1) && parts_[1].pieces[at[1]] < parts_[0].pieces[at[0]]);
    marker::add_marker(parts_[second].markers[at[second]++], found);
  }
}

}  // namespace improved
