#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ps {

/// What a processor has done ahead of the simulation time, in order: stretches of time, and the
/// functions it entered and left between them.
class Timeline {
 public:
  enum class Kind : std::uint8_t {
    work,    ///< time passes; an interrupt may come in between
    access,  ///< the rest of a bus access: an interrupt waits for its end
    enter,   ///< enters `function`
    leave,   ///< leaves the function entered last
  };
  struct Segment {
    Kind kind;
    std::uint32_t function;
    std::uint64_t ps;
  };

  bool empty() const { return next_ == segments_.size(); }
  std::size_t size() const { return segments_.size() - next_; }
  /// The time of all segments.
  std::uint64_t total_ps() const { return total_ps_; }
  const Segment& front() const { return segments_[next_]; }

  void push(Kind kind, std::uint64_t ps, std::uint32_t function = 0) {
    segments_.push_back({kind, function, ps});
    total_ps_ += ps;
  }
  /// `ps` of the first segment have passed.
  void pass(std::uint64_t ps) {
    segments_[next_].ps -= ps;
    total_ps_ -= ps;
  }
  /// The first segment is over.
  void pop() {
    total_ps_ -= segments_[next_].ps;
    if (++next_ == segments_.size()) {
      segments_.clear();
      next_ = 0;
    }
  }

 private:
  std::vector<Segment> segments_;
  std::size_t next_ = 0;
  std::uint64_t total_ps_ = 0;
};

}  // namespace ps
