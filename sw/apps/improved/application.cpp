#include <apps/common/message.h>
#include <apps/improved/application.h>
#include <drivers/slcr.h>
#include <marker/work.h>

#include <blob_stream.h>
#include <marker_logic.h>

#include <cstdlib>

namespace improved {
namespace {

constexpr std::uint32_t picture_bytes(const hal_frame& frame) {
  return frame.width * frame.height;
}

std::uint64_t counts(double milliseconds) {
  return static_cast<std::uint64_t>(milliseconds *
                                    (drivers::GlobalTimer::counts_per_second / 1000.0));
}

/// The logic sends whole words.
constexpr bool is_legal_size(const hal_frame& frame) {
  return marker_logic::min_width <= frame.width && frame.width <= marker_logic::max_width &&
         marker_logic::min_height <= frame.height && frame.height <= marker_logic::max_height &&
         picture_bytes(frame) % blob_stream::bytes_per_word == 0;
}

/// True if the logic has a blob with the same box, but for a few pixels: it was looked at.
bool has_blob_at(const marker::BlobList& logic, const std::uint32_t* blob) {
  constexpr std::int32_t most_off = 3;  // px: less than a corner may be off its guess (decision)
  const auto is_near = [](std::uint32_t one, std::uint32_t other) {
    return std::abs(static_cast<std::int32_t>(one) - static_cast<std::int32_t>(other)) <= most_off;
  };
  for (std::uint32_t i = 0; i < logic.count; ++i) {
    const std::uint32_t* const own = logic.words + i * blob_stream::words_per_blob;
    const auto has_same = [&](blob_stream::Extreme which,
                              std::uint32_t (*coordinate)(std::uint32_t)) {
      return is_near(coordinate(own[which]), coordinate(blob[which]));
    };
    if (has_same(blob_stream::least_x, blob_stream::x) &&
        has_same(blob_stream::greatest_x, blob_stream::x) &&
        has_same(blob_stream::least_y, blob_stream::y) &&
        has_same(blob_stream::greatest_y, blob_stream::y)) {
      return true;
    }
  }
  return false;
}

}  // namespace

int Application::run() {
  int failures = 0;
  if (initialise()) {
    for (bool more = begin_next(); more;) {
      Slot& slot = slots_[next_slot_ ^ 1];
      finish(slot);
      if (options_.overlap) more = begin_next();
      process(slot);
      if (slot.status != Status::ok) failures = 1;
      if (!options_.overlap) more = begin_next();
    }
  } else {
    failures = 1;
  }
  capture_.shut_down();
  return failures;
}

bool Application::initialise() {
  options_ = read_options();
  if (!dictionary_.open(*options_.dictionary, options_.own_dictionary, options_.border)) {
    apps::Message().text("improved: the markers' border is too wide for their codes").write();
    return false;
  }
  detector_.open(dictionary_.get(), options_.detector);
  optics_.open(options_.optics);
  if (options_.second_core) both_cores_.start(dictionary_.get(), options_.detector);
  if (options_.pose_filter) open_filter();
  next_slot_ = 0;
  knows_camera_frame_ = false;
  if (capture_.initialise()) return true;
  apps::Message().text("improved: a DMA engine does not leave reset").write();
  return false;
}

/// The filter's seconds follow from the processors' actual clock, whatever code set it.
void Application::open_filter() {
  drivers::Slcr slcr;
  slcr.initialise({});
  seconds_per_count_ =
      drivers::GlobalTimer::cycles_per_count / static_cast<double>(slcr.cpu_clock());
  pose_filter_.open(options_.filter);
}

/// Takes the next image, if there is one, and lets the logic have it.
bool Application::begin_next() {
  const hal_frame* const frame = hal_frame_next();
  if (frame == nullptr) return false;
  marker::work(marker::Work::frames, 1);
  Slot& slot = slots_[next_slot_];
  next_slot_ ^= 1;
  slot.frame = *frame;
  slot.status = admit(slot);
  if (slot.status == Status::ok && !capture_.start(slot.buffers, picture_bytes(slot.frame))) {
    slot.status = Status::picture_error;
  }
  slot.started = capture_.started();
  return true;
}

Status Application::admit(const Slot& slot) {
  if (!is_legal_size(slot.frame) || picture_bytes(slot.frame) > capture_.max_picture_bytes()) {
    return Status::unsupported_size;
  }
  // The next frame's as well: no room can be made while a frame waits to be processed.
  for (Slot& each : slots_) {
    if (!each.buffers.reserve(picture_bytes(slot.frame))) return Status::no_memory;
  }
  return Status::ok;
}

/// Waits until the frame is in memory, and looks whether it is whole.
void Application::finish(Slot& slot) {
  if (slot.status == Status::ok) slot.status = capture_.await(counts(options_.timeout));
  if (slot.status == Status::ok) slot.status = read_packet(slot);
  if (slot.status != Status::ok) {
    knows_camera_frame_ = false;
    slot.dma = capture_.dma_status();
  }
  slot.captured = capture_.now();
}

Status Application::read_packet(Slot& slot) {
  const std::uint32_t bytes = capture_.packet_bytes();
  const std::uint32_t count = blob_stream::blobs_in(bytes);
  if (count == blob_stream::no_packet) return capture_.distrust(Status::malformed_packet);
  hal_cache_invalidate(slot.buffers.packet.data, bytes);
  const Status status =
      slot.packet.read(static_cast<const std::uint32_t*>(slot.buffers.packet.data), count);
  if (status != Status::ok) return capture_.distrust(status);
  if (knows_camera_frame_ && slot.packet.camera_frame != camera_frame_ + 1) {
    return capture_.distrust(Status::wrong_frame);
  }
  knows_camera_frame_ = true;
  camera_frame_ = slot.packet.camera_frame;
  return Status::ok;
}

void Application::process(Slot& slot) {
  result_.frame = slot.frame.index;
  result_.status = slot.status;
  result_.width = slot.frame.width;
  result_.height = slot.frame.height;
  result_.camera_frame = result_.lost_in_logic = result_.threshold = 0;
  result_.times = {};
  result_.times.capture = {slot.started, slot.captured};
  result_.times.frame = result_.times.capture;
  marker::clear(result_.found);
  if (slot.status == Status::ok) {
    find_markers(slot);
  } else {
    report(slot);
  }
  hal_publish(marker::detection_result_kind, &result_, marker::published_bytes(result_));
}

void Application::find_markers(const Slot& slot) {
  const hal_frame& frame = slot.frame;
  marker::CameraFrame picture{
      {static_cast<const std::uint8_t*>(slot.buffers.picture.data), frame.width, frame.height},
      lens_of(frame),
      true};
  picture.optics = optics_.begin(frame);
  result_.camera_frame = slot.packet.camera_frame;
  result_.lost_in_logic = slot.packet.lost;
  result_.threshold = slot.packet.threshold;
  marker::DetectionTimes& times = result_.times;
  times.detection.start = capture_.now();
  if (options_.second_core) {
    both_cores_.find(picture, slot.packet.blobs, result_.found);
  } else {
    detector_.find_markers(picture, slot.packet.blobs, result_.found);
  }
  // Both cores found the poses of single markers.
  bool needs_poses =
      !options_.second_core || options_.detector.board.kind != marker::Board::Kind::none;
  if (look_behind(picture, slot.packet.blobs)) needs_poses = true;
  while (optics_.learn(result_.found)) {
    detector_.measure_again(picture, result_.found);
    needs_poses = true;
  }
  times.detection.end = times.pose.start = capture_.now();
  if (needs_poses) detector_.find_poses(picture.lens.camera, result_.found);
  if (options_.pose_filter) {
    pose_filter_.follow(result_.found, static_cast<double>(slot.started) * seconds_per_count_);
  }
  times.pose.end = times.frame.end = capture_.now();
}

/// Where the background is so dark that the logic takes it and the markers for one blob, the
/// software parts them by a threshold of each pixel's own. True if it did.
bool Application::look_behind(const marker::CameraFrame& picture, const marker::BlobList& logic) {
  if (result_.found.blobs.background == 0) return false;
  if (picture.optics == nullptr || !picture.optics->reads_outlines) return false;
  const marker::GreyImage& image = picture.image;
  hal_cache_invalidate(const_cast<std::uint8_t*>(image.pixels),
                       std::size_t{image.width} * image.height);
  const marker::BlobList blobs = local_blobs_.find(image, options_.detector.minimum_side);
  for (std::uint32_t i = 0; i < blobs.count; ++i) {
    const std::uint32_t* const blob = blobs.words + i * blob_stream::words_per_blob;
    if (!has_blob_at(logic, blob)) detector_.add_markers(picture, {blob, 1}, result_.found);
  }
  result_.found.blobs.lost += local_blobs_.lost();
  return true;
}

void Application::report(const Slot& slot) const {
  apps::Message message;
  message.text("improved: frame ")
      .number(slot.frame.index)
      .text(": ")
      .text(marker::status_name(slot.status))
      .text(", ")
      .number(slot.frame.width)
      .text(" x ")
      .number(slot.frame.height)
      .text(" px");
  if (slot.status != Status::unsupported_size && slot.status != Status::no_memory) {
    message.text(", DMASR ").hexadecimal(slot.dma.picture).text(" ").hexadecimal(slot.dma.packet);
  }
  message.write();
}

}  // namespace improved
