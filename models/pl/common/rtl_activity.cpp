#include <pl/common/rtl_activity.h>

#include <algorithm>
#include <cstdlib>
#include <string>

namespace pl {

namespace {

/// So many bytes are compared in the time of an edge of RTL of that size, or less.
constexpr std::uint64_t bytes_an_edge = 512;

std::uint64_t differing_bits(const unsigned char* a, const unsigned char* b, std::size_t bytes) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < bytes; i += 8) {
    std::uint64_t x = 0, y = 0;
    const std::size_t some = std::min<std::size_t>(8, bytes - i);
    std::memcpy(&x, a + i, some);
    std::memcpy(&y, b + i, some);
    if (x != y) sum += static_cast<std::uint64_t>(__builtin_popcountll(x ^ y));
  }
  return sum;
}

}  // namespace

RtlActivity::RtlActivity(const RtlObject& rtl) : rtl_(rtl) {
  const RtlDescriptor& descriptor = rtl.descriptor();
  if (descriptor.state_bytes == 0) return;
  for (std::uint32_t i = 0; i < descriptor.note_count; ++i) {
    if (std::string(descriptor.notes[i].what) == "signals")
      bits_ = std::strtoull(descriptor.notes[i].text, nullptr, 10);
  }
  const auto* state = static_cast<const unsigned char*>(rtl.state());
  for (std::uint32_t i = 0; i < descriptor.port_count; ++i) {
    const auto* place = static_cast<const unsigned char*>(rtl.pin(i));
    if (place < state || place >= state + descriptor.state_bytes) continue;
    pins_.push_back({static_cast<std::size_t>(place - state), (descriptor.ports[i].bits + 7) / 8});
  }
}

void RtlActivity::begin() {
  if (bits_ == 0 || left_ != 0) return;
  before_.resize(rtl_.descriptor().state_bytes);
  left_ = 2;
}

vp::IpEstimate::Foreign::Toggles RtlActivity::toggles() {
  return {bits_, [this] { begin(); }, [this] { return changes_; }, [this] { return busy_clocks_; }};
}

/// At the edge before a comparison a copy is taken.
void RtlActivity::look() {
  if (left_ == 0) {
    const std::uint64_t changed = changed_bits();
    const double share = static_cast<double>(changed) / (usual_rate * static_cast<double>(bits_));
    changes_ += static_cast<double>(changed * edges_);
    busy_clocks_ += std::min(1.0, share) * static_cast<double>(edges_);
    edges_ = 0;
    plan();
  }
  if (left_ == 1) std::memcpy(before_.data(), rtl_.state(), before_.size());
}

/// 1 to twice the mean less 1.
void RtlActivity::plan() {
  const std::uint64_t mean = 1 + before_.size() / bytes_an_edge;
  random_ ^= random_ << 13;
  random_ ^= random_ >> 17;
  random_ ^= random_ << 5;
  left_ = 1 + random_ % (2 * mean - 1);
}

std::uint64_t RtlActivity::changed_bits() const {
  const auto* state = static_cast<const unsigned char*>(rtl_.state());
  std::uint64_t sum = differing_bits(before_.data(), state, before_.size());
  for (const Pin& pin : pins_)
    sum -= differing_bits(before_.data() + pin.offset, state + pin.offset, pin.bytes);
  return sum;
}

}  // namespace pl
