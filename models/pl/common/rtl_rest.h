#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace pl {

/// Finds out when RTL has come to rest: an edge of each clock with the same inputs has left its
/// whole state as it was, so all further ones will. It takes a copy of the state, less often the
/// larger it is and the longer the RTL works on by itself.
class RtlRest {
 public:
  RtlRest(std::size_t state_bytes, std::size_t clocks)
      : state_(state_bytes), all_clocks_((1u << clocks) - 1), look_at_(first_look()) {}

  void inputs_changed() {
    same_ = 0;
    look_at_ = first_look();
  }
  /// Behind each edge: whether reached() is to be asked.
  bool due() { return ++same_ >= look_at_; }
  /// Whether no further edge would change anything. `risen`: the clocks of this one, a bit for
  /// each.
  bool reached(const void* state, unsigned risen) {
    if (same_ == look_at_) {
      std::memcpy(state_.data(), state, state_.size());
      clocks_seen_ = 0;
      return false;
    }
    if (std::memcmp(state_.data(), state, state_.size()) != 0) {
      look_at_ = 2 * same_;
      return false;
    }
    clocks_seen_ |= risen;
    return clocks_seen_ == all_clocks_;
  }

 private:
  /// A copy takes less than the clocks before it.
  std::uint64_t first_look() const { return 2 + state_.size() / 256; }

  std::vector<unsigned char> state_;
  unsigned all_clocks_, clocks_seen_ = 0;  ///< whose edges have changed nothing since the copy
  std::uint64_t same_ = 0;                 ///< edges since an input changed
  std::uint64_t look_at_;
};

}  // namespace pl
