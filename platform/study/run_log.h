#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <result/metrics.h>
#include <study/manifest.h>
#include <study/point.h>
#include <study/store.h>

namespace platform::study {

/// One computation of a point: what differs between hosts and times, and so stays out of the
/// point's file.
struct RunEntry {
  std::string key;
  // Nothing more is known where the process was killed before it told.
  std::optional<double> wall_s;
  std::optional<double> cpu_s;  ///< of the platform's run itself
  int attempt = 1;
  std::string engine;
  std::string host;
  std::string date;  ///< its end, UTC

  bool told() const { return wall_s.has_value(); }
};

/// Appends to runs/HOST-PROCESS.log: who computed which point, when, and its outcome. From these
/// logs a sweep of a million points is read in seconds, which its points' files are not.
///
/// A log begins with a line "markervp_runs VERSION ENGINE HOST"; records follow, of one of two
/// kinds. Names and values of metrics stand there once; a point has the values that differ.
class RunLog {
 public:
  /// `engine`: "local", "slurm"; is in the entries.
  explicit RunLog(const Store& store, const std::string& engine = "");
  ~RunLog();
  RunLog(const RunLog&) = delete;
  RunLog& operator=(const RunLog&) = delete;

  /// The point's file is written. Throws vp::OutputError.
  void add(const std::string& key, double wall_s, double cpu_s, int attempt,
           const Outcome& outcome);
  /// A point of which nobody told who computed it. Throws vp::OutputError.
  void add_untold(const std::string& key, const Outcome& outcome);

 private:
  void add_point(const std::string& key, std::optional<double> wall_s, double cpu_s, int attempt,
                 const Outcome& outcome);
  /// Position in bases_ of one with the same names, which is in the log.
  std::uint32_t base_of(const result::Metrics& metrics);
  void append(const std::string& body);
  void write(const std::string& bytes);
  void open();

  const Store& store_;
  std::string engine_;
  std::string host_;
  std::string path_;
  int file_ = -1;  ///< from the first entry on
  std::vector<result::Metrics> bases_;
};

/// A file as it is: any change shows.
struct FileMark {
  std::int64_t time_ns = 0;
  std::uint64_t size = 0;
  bool operator==(const FileMark& other) const {
    return time_ns == other.time_ns && size == other.size;
  }
};

/// What the logs of a folder say. Of a point they count as long as its file is as it was when it
/// was logged, by size and time; else the file is read.
class RunLogs {
  struct File;

 public:
  explicit RunLogs(const Store& store);
  ~RunLogs();
  RunLogs(const RunLogs&) = delete;
  RunLogs& operator=(const RunLogs&) = delete;

  /// Reads what was logged since.
  void refresh();

  /// Bytes of a log that were read together, since points that follow each other mostly stand so.
  /// Who asks for one point after another keeps one, in one thread.
  class Block {
   private:
    friend class RunLogs;
    std::string_view view(const File& file, std::uint64_t offset, std::size_t size);

    const File* file_ = nullptr;
    std::uint64_t offset_ = 0;
    std::string bytes_;
  };

  /// How much of an outcome: `facts` is all but the metrics, which take the longest.
  enum class Want { facts, all };
  /// None: the logs do not know the point's file as it is.
  std::optional<Outcome> logged(const std::string& key, Want want, Block& block) const;
  std::optional<Outcome> logged(const std::string& key) const;
  /// The metrics of a point that has an outcome(), whose file is not looked at again if a log has
  /// them.
  result::Metrics metrics(const std::string& key, Block& block) const;
  /// From the logs or from the point's file; none: there is no such point. Throws vp::InputError
  /// for a file that is damaged or was changed.
  std::optional<Outcome> outcome(const std::string& key, Block& block) const;
  std::optional<Outcome> outcome(const std::string& key) const;

  /// Logs the points at hand whose process was killed before it told. Throws vp::OutputError.
  void complete(const Manifest& manifest);

  /// Calls visit(entry) for all computations, log by log. A point that nobody told of comes each
  /// time that it was found.
  void visit(const std::function<void(const RunEntry&)>& visit) const;

 private:
  struct Record {
    FileMark mark;
    Outcome outcome;
  };
  struct Place {
    std::int64_t time_ns;  ///< of the point's file
    std::uint64_t offset;
    std::uint32_t file;
    std::uint32_t size;
  };

  void scan(std::uint32_t number);
  /// The last one of a point.
  std::optional<Record> record(const std::string& key, Want want, Block& block) const;

  Store store_;
  std::vector<std::unique_ptr<File>> files_;
  /// By a hash of the key, which the record has whole.
  std::unordered_map<std::size_t, Place> places_;
};

}  // namespace platform::study
