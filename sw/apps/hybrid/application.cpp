#include <apps/common/message.h>

#include <apps/common/search.h>
#include <apps/hybrid/application.h>
#include <marker/work.h>
#include <marker_logic.h>

namespace hybrid {

namespace {

enum class Option : std::uint32_t {
#define HYBRID_ENUMERATOR(name, ...) name,
  HYBRID_OPTIONS(HYBRID_ENUMERATOR)
#undef HYBRID_ENUMERATOR
      count
};

double value(Option option) {
  return hal_option(static_cast<std::uint32_t>(option));
}

}  // namespace

const hal_option_info option_table[] = {
#define HYBRID_ROW(name, unit, default_value, minimum, maximum, documentation) \
  {#name, unit, default_value, minimum, maximum, documentation},
    HYBRID_OPTIONS(HYBRID_ROW)
#undef HYBRID_ROW
};

const std::uint32_t option_count = static_cast<std::uint32_t>(Option::count);

Options read_options() {
  Options options{};
  static_cast<apps::SearchOptions&>(options) = apps::read_search_options();
  options.upload = value(Option::upload) >= 0.5;
  options.burst_words = static_cast<std::uint32_t>(value(Option::burst_words));
  options.timeout = value(Option::timeout);
  options.binary_timeout = value(Option::binary_timeout);
  return options;
}

namespace {

using marker::Status;

/// Of the memory for binary images that is taken before the first frame: what the thesis' feature
/// words can address.
constexpr std::uint32_t usual_pixels = 1024 * 512;
/// No burst crosses a boundary of its own size.
constexpr std::uint32_t most_burst_bytes =
    marker_logic::max_burst_words * marker_logic::bytes_per_word;

constexpr std::uint32_t binary_bytes(const hal_frame& frame) {
  return frame.width * frame.height / 8;
}

}  // namespace

int Application::run() {
  if (!initialise()) {
    link_.shut_down();
    return 1;
  }
  int failures = 0;
  while (const hal_frame* frame = hal_frame_next()) {
    process(*frame);
    hal_publish(marker::frame_result_kind, &result_, sizeof result_);
    if (result_.status != Status::ok) failures = 1;
  }
  link_.shut_down();
  return failures;
}

bool Application::initialise() {
  options_ = read_options();
  recovery_due_ = false;
  binary_ = {};
  reserve(usual_pixels / 8);
  if (link_.initialise(options_.burst_words * marker_logic::bytes_per_word)) return true;
  apps::Message().text("hybrid: a DMA engine does not leave reset").write();
  return false;
}

std::uint64_t Application::counts(double milliseconds) const {
  return static_cast<std::uint64_t>(milliseconds *
                                    (drivers::GlobalTimer::counts_per_second / 1000.0));
}

/// Makes room for a binary image; what is too small is given up.
void Application::reserve(std::uint32_t bytes) {
  if (binary_.size >= bytes) return;
  binary_ = hal_dma_allocate(bytes, most_burst_bytes);
  if (binary_.data != nullptr) hal_cache_flush(binary_.data, binary_.size);
}

Status Application::admit(const hal_frame& frame) {
  if (!marker_logic::is_legal_size(frame.width, frame.height, options_.burst_words)) {
    return Status::unsupported_size;
  }
  reserve(binary_bytes(frame));
  if (binary_.data == nullptr) return Status::no_memory;
  return Status::ok;
}

void Application::process(const hal_frame& frame) {
  apps::begin(frame, result_);
  result_.status = admit(frame);
  if (result_.status == Status::ok) result_.status = receive(frame);
  if (result_.status == Status::ok) {
    find_marker(frame);
  } else {
    report(result_.status);
  }
}

/// Upload, feature extraction and the rest of the binary image; decoding whatever came.
Status Application::receive(const hal_frame& frame) {
  marker::StageTimes& times = result_.times;
  if (recovery_due_) link_.recover();
  recovery_due_ = true;  // until the frame proves otherwise

  times.upload.start = link_.now();
  Status status = Status::ok;
  if (options_.upload) {
    status = link_.upload(frame.bus_address, frame.width * frame.height, counts(options_.timeout));
  }
  times.upload.end = link_.now();
  if (status != Status::ok) return status;

  link_.prepare_frame(binary_.bus_address, binary_bytes(frame));
  times.frame.start = times.feature_extraction.start = link_.now();
  link_.start_frame();
  status = link_.receive_features(words_, counts(options_.timeout));
  times.feature_extraction.end = times.receive.start = link_.now();

  if (status == Status::ok) status = link_.await_binary_image(counts(options_.binary_timeout));
  hal_cache_invalidate(binary_.data, binary_bytes(frame));
  marker::decode(words_.words.data(), words_.stored(), {frame.width, frame.height},
                 result_.features);
  times.receive.end = times.frame.end = link_.now();
  result_.feature_words = words_.count;
  result_.lost_words = words_.lost();
  result_.binary_packets = link_.binary_packets();
  recovery_due_ = status != Status::ok;
  return status;
}

void Application::find_marker(const hal_frame& frame) {
  const marker::BinaryImage image{static_cast<const std::uint32_t*>(binary_.data), frame.width,
                                  frame.height, true};
  apps::find_marker(frame, image, options_, result_.times.receive.end, result_);
}

void Application::report(Status status) const {
  apps::Message message;
  message.text("hybrid: frame ")
      .number(result_.frame)
      .text(": ")
      .text(marker::status_name(status))
      .text(", ")
      .number(result_.width)
      .text(" x ")
      .number(result_.height)
      .text(" px");
  if (status != Status::unsupported_size && status != Status::no_memory) {
    message.text(", ")
        .number(result_.feature_words)
        .text(" words, ")
        .number(result_.binary_packets)
        .text(" packets, DMASR ")
        .hexadecimal(link_.image_dma_status())
        .text(" ")
        .hexadecimal(link_.binary_dma_status());
  }
  message.write();
}

}  // namespace hybrid
