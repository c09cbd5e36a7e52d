#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ps {

/// What a processor has done ahead of the simulation time, in order: stretches of work, and the
/// functions it entered and left between them.
class Timeline {
 public:
  enum class Kind : std::uint8_t {
    work,   ///< time passes; an interrupt may come in between
    enter,  ///< enters `function`
    leave,  ///< leaves the function entered last
  };
  struct Segment {
    Kind kind = Kind::work;
    std::uint32_t function = 0;
    std::uint64_t ps = 0;
  };

  bool empty() const { return next_ == segments_.size(); }
  std::size_t size() const { return segments_.size() - next_; }
  /// The time of all segments.
  std::uint64_t total_ps() const { return total_ps_; }
  const Segment& front() const { return segments_[next_]; }

  void push(Kind kind, std::uint64_t ps, std::uint32_t function = 0) {
    Segment& segment = segments_.emplace_back();
    segment.kind = kind;
    segment.function = function;
    segment.ps = ps;
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
