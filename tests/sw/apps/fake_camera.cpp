#include "fake_camera.h"

#include <blob_stream.h>
#include <hal/hal.h>

#include <cstring>

namespace {

constexpr std::uint32_t control_gpio = 0x4120'0000;
constexpr std::uint32_t acknowledge = 0xF8F0'010C;
constexpr std::uint32_t timer = 0xF8F0'0200;
constexpr std::uint32_t dmacr = 0x30, dmasr = 0x34, address = 0x48, length = 0x58;

void add_checksum(std::vector<std::uint32_t>& words) {
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i + 1 < words.size(); ++i) sum = blob_stream::add_to_sum(sum, words[i]);
  words.back() = blob_stream::checked_word(sum, words.back() & blob_stream::threshold_mask);
}

}  // namespace

FakeCamera::FakeCamera() {
  fake_hal::reset();
  auto& s = fake_hal::state();
  s.record_accesses = false;
  s.xparameters = {{"AXI_DMA_0_SG_LENGTH_WIDTH", 21}, {"AXI_DMA_1_SG_LENGTH_WIDTH", 18}};
  connect(picture_);
  connect(packet_);
  s.on_write[control_gpio] = [this](std::uint32_t packet) { control(packet); };
  s.on_read[acknowledge] = [this]() -> std::uint32_t {
    if (alarm_pending()) return 27;
    return packet_.interrupt() ? 62 : 1023;
  };
  s.interrupt_pending = [this] { return alarm_pending() || packet_.interrupt(); };
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
  const auto picture_status = s.on_read[picture_.base + dmasr];
  s.on_read[picture_.base + dmasr] = [this, picture_status] {
    if (picture_due_ && polls_left_-- == 0) send_picture();
    return picture_status();
  };
}

void FakeCamera::add_image(std::uint32_t width, std::uint32_t height) {
  auto& s = fake_hal::state();
  s.frames.push_back({static_cast<std::uint32_t>(s.frames.size()),
                      width,
                      height,
                      nullptr,
                      0,
                      381.36,
                      381.36,
                      width / 2.0,
                      height / 2.0,
                      HAL_LENS_BROWN_CONRADY,
                      {},
                      HAL_RESPONSE_LINEAR,
                      nullptr});
}

void FakeCamera::Engine::take(const std::uint8_t* data, std::size_t size, std::size_t missing) {
  for (std::size_t i = 0; i < size - missing && i < length; ++i) {
    fake_hal::memory(address + static_cast<std::uint32_t>(i)) = data[i];
  }
  if (size - missing > length) return fail(0x10);  // DMAIntErr: the packet is too long
  length = static_cast<std::uint32_t>(size - missing);
  complete();
}

void FakeCamera::connect(Engine& engine) {
  auto& s = fake_hal::state();
  Engine* const e = &engine;
  s.on_read[e->base + dmacr] = [e] { return e->dmacr; };
  s.on_write[e->base + dmacr] = [this, e](std::uint32_t value) {
    if (value & 4) {
      *e = Engine{e->base};
      if (reset_hangs) e->dmacr = 4;
      ++resets;
      return;
    }
    if (value & 1) e->dmasr &= ~1u;
    e->dmacr = value;
  };
  s.on_read[e->base + dmasr] = [e] { return e->dmasr; };
  s.on_write[e->base + dmasr] = [e](std::uint32_t value) { e->dmasr &= ~(value & 0x7000); };
  s.on_write[e->base + address] = [e](std::uint32_t value) { e->address = value; };
  s.on_read[e->base + length] = [e] { return e->length; };
  s.on_write[e->base + length] = [e](std::uint32_t value) {
    e->length = value;
    if (!(e->dmacr & 1)) return;
    e->armed = true;
    e->dmasr &= ~2u;
  };
}

void FakeCamera::control(std::uint32_t packet) {
  const std::uint32_t risen = packet & ~control_;
  control_ = packet;
  if (packet & 2) {
    ++logic_resets;
    under_way_ = picture_due_ = false;
  }
  if (risen & 1) trigger();
}

void FakeCamera::trigger() {
  ++triggers;
  published_at_trigger.push_back(fake_hal::state().publications.size());
  picture_addresses.push_back(picture_.address);
  // A frame for which an engine is not armed is dropped whole.
  under_way_ = picture_.armed && packet_.armed;
}

/// All of a frame comes while the program sleeps, but for a picture that is late.
void FakeCamera::send() {
  under_way_ = false;
  picture_due_ = !is_wrong() || sends_picture;
  polls_left_ = picture_delay;
  if (picture_due_ && picture_delay == 0) send_picture();
  if (!is_wrong() || sends_packet) send_packet();
}

void FakeCamera::send_picture() {
  picture_due_ = false;
  if (is_wrong() && picture_error != 0) return picture_.fail(picture_error);
  const CameraFrame& frame = triggers <= frames.size() ? frames[triggers - 1] : frames.back();
  picture_.take(frame.picture.data(), frame.picture.size(), is_wrong() ? picture_bytes_short : 0);
}

void FakeCamera::send_packet() {
  if (is_wrong() && packet_error != 0) return packet_.fail(packet_error);
  const CameraFrame& frame = triggers <= frames.size() ? frames[triggers - 1] : frames.back();
  std::vector<std::uint32_t> words = frame.packet;
  if (words.size() >= blob_stream::trailer_words) {
    words[words.size() - blob_stream::trailer_words] =
        triggers - 1 + (is_wrong() ? number_offset : 0);
    if (checksum) add_checksum(words);
    if (is_wrong() && wrong_bit) words[*wrong_bit / 32] ^= 1u << (*wrong_bit % 32);
  }
  std::vector<std::uint8_t> bytes(words.size() * 4);
  std::memcpy(bytes.data(), words.data(), bytes.size());
  packet_.take(bytes.data(), bytes.size(), 0);
}

void FakeCamera::idle() {
  counter_ += 100;
  if (under_way_) send();
  if (!fake_hal::state().interrupt_pending() && timer_control_ == 7 && counter_ < alarm_) {
    counter_ = alarm_;
  }
}
