#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <sweep/engine.h>
#include <sweep/point_message.h>
#include <sweep/work_queue.h>

namespace platform::sweep {

/// The list of points that a sweep's processes work on.
struct PointList {
  const Store& store;
  const Manifest& manifest;
  const std::vector<std::size_t>& positions;  ///< in the manifest, by item
  const RunPoint& run;
};

/// Computes points in a process of its own: writes their files and tells of them.
class PointWorker {
 public:
  /// Tells into the pipe `pipe`.
  PointWorker(const PointList& list, WorkQueue& queue, std::uint32_t slot, int pipe);

  /// Computes at most so many points.
  void work(std::uint32_t most);
  /// Computes one that was taken from the queue before.
  void work_on(std::size_t item);

 private:
  /// Whether the process is as it was before.
  bool complete(std::size_t item);
  PointMessage compute(std::size_t item);
  void compute_claimed(const PlannedPoint& point, PointMessage& message);
  void finish(const PointRecord& record, PointMessage& message);
  void tell(const PointMessage& message);

  const PointList& list_;
  WorkQueue& queue_;
  std::uint32_t slot_;
  int pipe_;
  MetricsReader metrics_;
  MessageWriter writer_;
  bool clean_ = true;  ///< no run ended badly
};

}  // namespace platform::sweep
