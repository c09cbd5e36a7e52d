#include "fake_platform.h"

#include <hal/hal.h>

namespace {

constexpr std::uint32_t control_gpio = 0x4120'0000;
constexpr std::uint32_t feature_gpio = 0x4121'0000;
constexpr std::uint32_t acknowledge = 0xF8F0'010C;
constexpr std::uint32_t timer = 0xF8F0'0200;

}  // namespace

FakePlatform::FakePlatform() {
  fake_hal::reset();
  auto& s = fake_hal::state();
  s.record_accesses = false;
  connect(image_dma_);
  connect(binary_dma_);
  s.on_write[control_gpio] = [this](std::uint32_t packet) { control(packet); };
  s.on_read[feature_gpio] = [this] {
    counter_ += 1000;
    serve_binary();
    if (feature_wanted_ && running_ && !words_.empty()) {
      feature_ = words_.front();
      words_.pop_front();
      feature_wanted_ = false;
    }
    return feature_;
  };
  s.on_read[acknowledge] = [this]() -> std::uint32_t {
    if (alarm_pending()) return 27;
    if (image_dma_.interrupt()) return 61;
    return binary_dma_.interrupt() ? 62 : 1023;
  };
  s.interrupt_pending = [this] {
    return alarm_pending() || image_dma_.interrupt() || binary_dma_.interrupt();
  };
  s.on_idle = [this] { idle(); };
  s.on_read[timer] = [this] { return static_cast<std::uint32_t>(counter_ += 100); };
  s.on_read[timer + 4] = [this] { return static_cast<std::uint32_t>(counter_ >> 32); };
  s.on_write[timer + 0x08] = [this](std::uint32_t value) { timer_control_ = value; };
  s.on_write[timer + 0x10] = [this](std::uint32_t value) {
    alarm_ = (alarm_ & ~0xFFFF'FFFFull) | value;
  };
  s.on_write[timer + 0x14] = [this](std::uint32_t value) {
    alarm_ = (alarm_ & 0xFFFF'FFFFull) | static_cast<std::uint64_t>(value) << 32;
  };
}

void FakePlatform::add_frame(std::uint32_t width, std::uint32_t height) {
  auto& s = fake_hal::state();
  const hal_dma_buffer buffer = hal_dma_allocate(width * height, 32);
  for (std::uint32_t i = 0; i < width * height; ++i) {
    static_cast<std::uint8_t*>(buffer.data)[i] = static_cast<std::uint8_t>(i * 7 + i / 251);
  }
  s.frames.push_back({static_cast<std::uint32_t>(s.frames.size()),
                      width,
                      height,
                      static_cast<const std::uint8_t*>(buffer.data),
                      buffer.bus_address,
                      381.36,
                      381.36,
                      width / 2.0,
                      height / 2.0,
                      HAL_LENS_BROWN_CONRADY,
                      {},
                      HAL_RESPONSE_LINEAR,
                      nullptr});
}

void FakePlatform::connect(Engine& engine) {
  auto& s = fake_hal::state();
  Engine* const e = &engine;
  s.on_read[e->base + e->control] = [e] { return e->dmacr; };
  s.on_write[e->base + e->control] = [this, e](std::uint32_t value) {
    if (value & 4) {
      e->dmacr = reset_hangs ? 4 : 0;
      e->dmasr = 1;
      e->armed = 0;
      ++resets;
      return;
    }
    if (value & 1) e->dmasr &= ~1u;
    e->dmacr = value;
  };
  s.on_read[e->base + e->status] = [e] { return e->dmasr; };
  s.on_write[e->base + e->status] = [e](std::uint32_t value) { e->dmasr &= ~(value & 0x7000); };
  s.on_write[e->base + e->address] = [e](std::uint32_t value) { e->address_value = value; };
  s.on_write[e->base + e->length] = [e](std::uint32_t value) {
    if (!(e->dmacr & 1)) return;
    e->armed = value;
    e->dmasr &= ~2u;
  };
}

void FakePlatform::control(std::uint32_t packet) {
  controls.push_back(packet);
  const std::uint32_t changed = packet ^ packet_;
  packet_ = packet;
  if (packet & 2) {
    feature_ = 0;
    running_ = false;
    words_.clear();
    return;
  }
  if (changed & packet & 1) {
    ++frames;
    running_ = true;
    sent_packets_ = 0;
    words_.assign(features.begin(), features.end());
    if (sends_end_word) words_.push_back(0xFFFF'FFFF);
    feature_wanted_ = true;
  }
  if (changed & 0xC) feature_wanted_ = true;
}

void FakePlatform::serve_image() {
  if (image_dma_.armed == 0 || image.size() / 128 >= image_bursts) {
    if (image_dma_.armed != 0 && dma_error != 0) image_dma_.fail(dma_error);
    return;
  }
  const bool stored = packet_ & 0x10;
  for (std::uint32_t i = 0; i < image_dma_.armed && stored; ++i) {
    image.push_back(fake_hal::memory(image_dma_.address_value + i));
  }
  image_dma_.armed = 0;
  image_dma_.complete();
}

void FakePlatform::serve_binary() {
  if (!running_ || binary_dma_.armed == 0 || (sent_packets_ + 1) * 32 > binary.size()) return;
  if (sent_packets_ >= binary_packets) {
    if (dma_error != 0) binary_dma_.fail(dma_error);
    return;
  }
  for (std::uint32_t i = 0; i < 128; ++i) {
    fake_hal::memory(binary_dma_.address_value + i) =
        static_cast<std::uint8_t>(binary[sent_packets_ * 32 + i / 4] >> i % 4 * 8);
  }
  ++sent_packets_;
  binary_dma_.armed = 0;
  binary_dma_.complete();
}

void FakePlatform::idle() {
  counter_ += 100;
  serve_image();
  serve_binary();
  if (!fake_hal::state().interrupt_pending() && timer_control_ == 7 && counter_ < alarm_) {
    counter_ = alarm_;
  }
}
