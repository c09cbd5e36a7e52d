#include <apps/common/wait.h>
#include <apps/hybrid/pl_link.h>
#include <drivers/platform_addresses.h>
#include <marker/work.h>
#include <marker_logic.h>

namespace hybrid {
namespace {

namespace control = marker_logic::control;
using marker::Status;

/// CPU cycles of a polling round besides the read: compare, count, branch (assumed).
constexpr std::uint32_t poll_cycles = 8;
/// Polls between two looks at the clock, some 10 ms (decision).
constexpr std::uint32_t polls_per_look = 65'536;

}  // namespace

bool PlLink::initialise(std::uint32_t burst_bytes) {
  burst_bytes_ = burst_bytes;
  hal_interrupt_enable(false);
  gic_.initialise();
  timer_.initialise();
  control_gpio_.initialise({drivers::addresses::gpio_control(), 0});
  feature_gpio_.initialise({drivers::addresses::gpio_features(), 0xFFFF'FFFFu});
  control(0);
  const bool ready = initialise_dma();
  gic_.connect(drivers::addresses::dma_image_interrupt(), drivers::Trigger::level_high,
               &BurstChain::on_interrupt, &image_);
  gic_.connect(drivers::addresses::dma_binary_interrupt(), drivers::Trigger::level_high,
               &BurstChain::on_interrupt, &binary_);
  gic_.connect(gic::global_timer_id, drivers::Trigger::rising_edge, &PlLink::on_alarm, this);
  hal_interrupt_enable(true);
  return ready;
}

void PlLink::shut_down() {
  hal_interrupt_enable(false);
  hal_interrupt_connect(nullptr, nullptr);
}

bool PlLink::initialise_dma() {
  using Channel = drivers::AxiDmaConfig::Channel;
  const bool image =
      image_.initialise({drivers::addresses::dma_image(), Channel::memory_to_stream}, burst_bytes_);
  const bool binary = binary_.initialise(
      {drivers::addresses::dma_binary(), Channel::stream_to_memory}, burst_bytes_);
  return image && binary;
}

bool PlLink::recover() {
  control(control::rst);
  const bool ready = initialise_dma();
  control(0);
  return ready;
}

void PlLink::control(std::uint32_t packet) {
  packet_ = packet;
  control_gpio_.write(packet);
}

void PlLink::on_alarm(void* self) {
  PlLink& link = *static_cast<PlLink*>(self);
  link.timer_.clear_alarm();
  link.alarm_ = true;
}

bool PlLink::wait_for(const BurstChain& chain, std::uint64_t timeout) {
  alarm_ = false;
  timer_.set_alarm(timer_.now() + timeout);
  apps::sleep_until([&] { return chain.is_over() || alarm_; });
  timer_.clear_alarm();
  return chain.is_over();
}

Status PlLink::upload(std::uint32_t bus_address, std::uint32_t bytes, std::uint64_t timeout) {
  const marker::FunctionScope scope(marker::Function::upload);
  control(control::wr_en);
  image_.start(bus_address, bytes);
  const bool over = wait_for(image_, timeout);
  control(0);
  if (image_.failed()) return Status::upload_error;
  return over ? Status::ok : Status::upload_timeout;
}

void PlLink::prepare_frame(std::uint32_t bus_address, std::uint32_t bytes) {
  // `ena` is low before the reset: still high after it, it would start a frame. Without the reset
  // the old end word would end the new frame at once.
  control(0);
  control(control::rst);
  control(0);
  // The last packet completes just before the end word: its interrupt would only delay that.
  binary_.start(bus_address, bytes, BurstChain::LastInterrupt::waits);
}

void PlLink::start_frame() {
  control(control::ena);
}

Status PlLink::receive_features(marker::WordStore& words, std::uint64_t timeout) {
  const marker::FunctionScope scope(marker::Function::receive);
  const std::uint64_t deadline = timer_.now() + timeout;
  std::uint32_t last = 0;  // what the feature register holds after a reset
  words.clear();
  for (;;) {
    const hal_poll_result poll =
        feature_gpio_.poll_until_changed(last, poll_cycles, polls_per_look);
    if (!poll.changed) {
      if (timer_.now() > deadline) return Status::feature_timeout;
      continue;
    }
    last = poll.value;
    words.push(last);
    marker::work(marker::Work::words_received, 1);
    if (last == marker_logic::WordFormat::end_of_frame) return Status::ok;
    if (words.lost() > 0) return Status::too_many_features;
    control(packet_ ^ control::ready);
  }
}

Status PlLink::await_binary_image(std::uint64_t timeout) {
  const marker::FunctionScope scope(marker::Function::receive);
  binary_.release_last();
  const bool over = wait_for(binary_, timeout);
  if (binary_.failed()) return Status::binary_error;
  return over ? Status::ok : Status::binary_timeout;
}

}  // namespace hybrid
