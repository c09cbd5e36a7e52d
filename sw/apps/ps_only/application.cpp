#include <apps/ps_only/application.h>

#include <apps/common/message.h>
#include <apps/common/search.h>
#include <marker/work.h>

namespace ps_only {

namespace {

enum class Option : std::uint32_t {
#define PS_ONLY_ENUMERATOR(name, ...) name,
  PS_ONLY_OPTIONS(PS_ONLY_ENUMERATOR)
#undef PS_ONLY_ENUMERATOR
      count
};

double value(Option option) {
  return hal_option(static_cast<std::uint32_t>(option));
}

std::uint32_t whole(Option option) {
  return static_cast<std::uint32_t>(value(option));
}

}  // namespace

const hal_option_info option_table[] = {
#define PS_ONLY_ROW(name, unit, default_value, minimum, maximum, documentation) \
  {#name, unit, default_value, minimum, maximum, documentation},
    PS_ONLY_OPTIONS(PS_ONLY_ROW)
#undef PS_ONLY_ROW
};

const std::uint32_t option_count = static_cast<std::uint32_t>(Option::count);

Options read_options() {
  Options options{};
  static_cast<apps::SearchOptions&>(options) = apps::read_search_options();
  options.pixel_clock = value(Option::pixel_clock);
  options.cpu_clock = value(Option::cpu_clock);
  options.corner_threshold = whole(Option::corner_threshold);
  options.label_count = whole(Option::label_count);
  options.minimum_side = whole(Option::minimum_side);
  return options;
}

namespace {

using marker::Status;

/// The least that has a corner's neighbourhood.
constexpr std::uint32_t min_side = 9;

constexpr bool is_supported(std::uint32_t width, std::uint32_t height) {
  return width >= min_side && height >= min_side && width <= marker::max_image_width &&
         height <= marker::max_image_height && width % marker::pixels_per_word == 0;
}

}  // namespace

int Application::run() {
  initialise();
  int failures = 0;
  while (const hal_frame* frame = hal_frame_next()) {
    process(*frame);
    hal_publish(marker::frame_result_kind, &result_, sizeof result_);
    if (result_.status != Status::ok) failures = 1;
  }
  hal_interrupt_enable(false);
  hal_interrupt_connect(nullptr, nullptr);
  return failures;
}

void Application::initialise() {
  options_ = read_options();
  threshold_.reset();
  hal_interrupt_enable(false);
  gic_.initialise();
  timer_.initialise();
  gic_.connect(gic::global_timer_id, drivers::Trigger::rising_edge, &Application::on_alarm, this);
  hal_interrupt_enable(true);
}

void Application::on_alarm(void* self) {
  Application& application = *static_cast<Application*>(self);
  application.timer_.clear_alarm();
  application.alarm_ = true;
}

void Application::process(const hal_frame& frame) {
  apps::begin(frame, result_);
  if (!is_supported(frame.width, frame.height)) {
    result_.status = Status::unsupported_size;
    apps::Message()
        .text("ps-only: frame ")
        .number(frame.index)
        .text(": ")
        .text(marker::status_name(result_.status))
        .text(", ")
        .number(frame.width)
        .text(" x ")
        .number(frame.height)
        .text(" px")
        .write();
    return;
  }
  marker::StageTimes& times = result_.times;
  times.frame.start = times.feature_extraction.start = times.capture.start = timer_.now();
  capture(frame);
  find_features(frame);
  find_marker(frame);
}

/// The image is in memory already; what passes is the time that a camera takes to bring it there.
void Application::capture(const hal_frame& frame) {
  const marker::FunctionScope scope(marker::Function::capture);
  // One count every 2 CPU cycles, one pixel a clock of the camera.
  const double counts = static_cast<double>(frame.width) * frame.height * options_.cpu_clock /
                        (2 * options_.pixel_clock);
  const std::uint64_t end = result_.times.capture.start + static_cast<std::uint64_t>(counts + 0.5);
  alarm_ = false;
  timer_.set_alarm(end);
  for (;;) {
    // Masked, so that the interrupt does not slip in between the test and the sleep.
    hal_interrupt_enable(false);
    if (!alarm_) hal_wait_for_interrupt();
    hal_interrupt_enable(true);
    hal_barrier();
    if (alarm_) break;
  }
  result_.times.capture.end = timer_.now();
}

void Application::find_features(const hal_frame& frame) {
  marker::StageTimes& times = result_.times;
  const marker::GreyImage image{frame.pixels, frame.width, frame.height};
  times.corner_detection.start = times.capture.end;
  corners_.detect(image, options_.corner_threshold, result_.features);
  times.corner_detection.end = times.threshold.start = timer_.now();

  result_.has_threshold = true;
  result_.threshold = threshold_.value();
  threshold_.binarise(image, binary_.data());
  times.threshold.end = times.blob_detection.start = timer_.now();

  const marker::BinaryImage binary{binary_.data(), frame.width, frame.height, false};
  blobs_.detect(binary, {options_.label_count, options_.minimum_side}, result_.features);
  result_.label_overflow = blobs_.label_overflow();
  times.blob_detection.end = times.feature_extraction.end = timer_.now();
}

void Application::find_marker(const hal_frame& frame) {
  const marker::BinaryImage binary{binary_.data(), frame.width, frame.height, false};
  apps::find_marker(frame, binary, options_, result_.times.feature_extraction.end, result_);
}

}  // namespace ps_only
