#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <result/metrics.h>
#include <study/outcome.h>
#include <study/point.h>
#include <study/store.h>

namespace platform::study {

/// Appends what a process computes to a file that is its own, runs/HOST-PROCESS.shard. A record is
/// written at once: a process that is killed leaves whole ones, and half of one at most. Nothing is
/// ever changed in a shard (shard_format.h has its bytes; Shards reads them).
class Shard {
 public:
  /// The points are of `origins`. `engine`: "local", "slurm".
  Shard(const Store& store, const Origins& origins, std::string engine);
  ~Shard();
  Shard(const Shard&) = delete;
  Shard& operator=(const Shard&) = delete;

  /// Its file is made with the first point. Throws vp::OutputError.
  void add(const Point& point, const Outcome& outcome);

 private:
  /// Numbers of records that others refer to, in the shard from here on.
  std::uint32_t origin_of(const Point& point);
  std::uint32_t figures_like(const result::Metrics& metrics);
  void append(const std::string& body);
  void write(const std::string& bytes);
  void open();

  const Store& store_;
  const Origins& origins_;
  std::string engine_;
  std::string path_;
  int file_ = -1;                                                       ///< from the first point on
  std::map<std::pair<std::size_t, std::size_t>, std::uint32_t> known_;  ///< by family and inputs
  std::vector<result::Metrics> figures_;
};

}  // namespace platform::study
