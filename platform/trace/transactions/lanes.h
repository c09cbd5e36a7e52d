#pragma once

#include <trace/transactions/transactions.h>
#include <vp/file.h>
#include <vp/wave_writer.h>

#include <cstdint>
#include <map>
#include <memory>
#include <queue>
#include <string>
#include <utility>
#include <vector>

namespace platform::trace {

/// Puts transactions that overlap side by side: each into the first lane of its bus and operation
/// that is free.
class Lanes {
 public:
  using Group = std::pair<std::uint32_t, std::string>;  ///< interface, operation
  struct Place {
    std::size_t lane = 0;  ///< of the group, from 0
    bool is_new = false;
    std::uint64_t from_ps = 0, to_ps = 0;
  };

  explicit Lanes(const Survey& survey) : survey_(survey) {}

  /// What is open lasts to the end of the trace.
  Place add(const Transaction& transaction);
  /// How many lanes each group has needed.
  std::map<Group, std::size_t> counts() const;
  /// "tb.dut.m_axi.read_1": lanes count from 1 for people.
  std::string name(const Group& group, std::size_t lane) const;

 private:
  const Survey& survey_;
  std::map<Group, std::vector<std::uint64_t>> free_from_;  ///< by lane
};

/// "0x1000 4 beats OKAY": a transaction in a viewer.
std::string lane_text(const Transaction& transaction);

/// Writes transactions as Chrome's trace events, for ui.perfetto.dev: a process for each bus, a
/// thread for each lane, a counter of how many are outstanding.
class PerfettoLanes {
 public:
  /// Throws vp::OutputError.
  PerfettoLanes(const std::string& file, const Survey& survey);
  void add(const Transaction& transaction);
  /// Gives the file its name. Throws vp::OutputError.
  void close();

 private:
  void event(const std::string& text);
  void count(std::uint32_t interface, std::uint64_t until_ps);

  const Survey& survey_;
  vp::OutputFile file_;
  Lanes lanes_;
  bool any_ = false;
  std::map<Lanes::Group, std::vector<std::size_t>> threads_;  ///< numbers, by lane
  std::size_t next_thread_ = 1;
  std::vector<std::priority_queue<std::uint64_t, std::vector<std::uint64_t>, std::greater<>>>
      ends_;  ///< of what is outstanding, by interface
};

/// Writes transactions as texts of a VCD or FST, a signal for each lane, for GTKWave and others.
class WaveLanes {
 public:
  /// `lanes`: how many each group needs, from a first reading. Throws vp::OutputError, and
  /// vp::InputError for names that the format cannot hold.
  WaveLanes(const std::string& file, const Survey& survey,
            const std::map<Lanes::Group, std::size_t>& lanes);
  void add(const Transaction& transaction);
  /// Throws vp::OutputError.
  void close();

 private:
  struct Change {
    std::uint64_t ps;
    std::uint64_t order;  ///< of two at one time in one lane the later one counts
    vp::WaveWriter::Id id;
    std::string text;
    bool operator>(const Change& other) const {
      return ps != other.ps ? ps > other.ps : order > other.order;
    }
  };
  void write_until(std::uint64_t ps);

  const Survey& survey_;
  Lanes lanes_;
  std::unique_ptr<vp::WaveWriter> writer_;
  std::map<Lanes::Group, std::vector<vp::WaveWriter::Id>> ids_;
  std::priority_queue<Change, std::vector<Change>, std::greater<>> changes_;
  std::uint64_t written_ps_ = 0, order_ = 0;
};

}  // namespace platform::trace
