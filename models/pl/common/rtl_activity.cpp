#include <pl/common/rtl_activity.h>

#include <algorithm>
#include <bitset>
#include <cstdlib>
#include <string>

namespace pl {

namespace {

/// So many bytes of state are copied and compared in an edge, on average: a few per cent of its
/// time.
constexpr std::uint64_t bytes_an_edge = 64;

std::uint64_t word_of(const unsigned char* bytes) {
  std::uint64_t word = 0;
  std::memcpy(&word, bytes, sizeof word);
  return word;
}

}  // namespace

RtlActivity::RtlActivity(const RtlObject& rtl) : rtl_(rtl) {
  const RtlDescriptor& descriptor = rtl.descriptor();
  if (descriptor.state_bytes == 0) return;
  for (std::uint32_t i = 0; i < descriptor.note_count; ++i) {
    if (std::string(descriptor.notes[i].what) == "signals")
      bits_ = std::strtoull(descriptor.notes[i].text, nullptr, 10);
  }
  counted_.assign(descriptor.state_bytes / sizeof(std::uint64_t), ~std::uint64_t{0});
  const auto* state = static_cast<const unsigned char*>(rtl.state());
  auto* counted = reinterpret_cast<unsigned char*>(counted_.data());
  for (std::uint32_t i = 0; i < descriptor.port_count; ++i) {
    const auto* place = static_cast<const unsigned char*>(rtl.pin(i));
    const std::size_t bytes = (descriptor.ports[i].bits + 7) / 8;
    if (place < state || place + bytes > state + descriptor.state_bytes) continue;
    std::memset(counted + (place - state), 0, bytes);
  }
}

void RtlActivity::begin() {
  if (bits_ == 0 || left_ != 0) return;
  before_.resize(counted_.size() * sizeof(std::uint64_t));
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
  const unsigned char* before = before_.data();
  std::uint64_t sum = 0;
  for (const std::uint64_t counted : counted_) {
    const std::uint64_t changed = (word_of(before) ^ word_of(state)) & counted;
    if (changed != 0) sum += std::bitset<64>(changed).count();
    before += sizeof changed;
    state += sizeof changed;
  }
  return sum;
}

}  // namespace pl
