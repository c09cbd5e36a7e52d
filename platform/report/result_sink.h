#pragma once

#include <string>
#include <vector>

#include <report/result.h>
#include <report/summary.h>

namespace platform::report {

/// Where a run's results go, frame by frame and in the end.
class ResultSink {
 public:
  virtual ~ResultSink() = default;

  virtual void add(const FrameReport& frame) = 0;
  /// `warnings` are those of the whole run.
  virtual void finish(const RunFacts& facts, const Provenance& provenance,
                      const std::vector<std::string>& warnings) = 0;

  const Summary& summary() const { return summary_; }

 protected:
  Summary summary_;
};

}  // namespace platform::report
