#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <facts/result.h>
#include <facts/summary.h>
#include <host/output_folder.h>
#include <result/members.h>
#include <vp/file.h>
#include <nlohmann/json.hpp>

namespace platform::result {

/// Where a run's results go, frame by frame and in the end.
class ResultSink {
 public:
  virtual ~ResultSink() = default;

  virtual void add(const facts::UnitReport& frame) = 0;
  /// `warnings` are those of the whole run.
  virtual void finish(const facts::RunFacts& facts, const facts::Provenance& provenance,
                      const std::vector<std::string>& warnings) = 0;

  const facts::Summary& summary() const { return summary_; }

 protected:
  facts::Summary summary_;
};

/// Writes `result.json`, schema 1, in memory that does not grow with the number of frames: frames
/// wait in a file without a name until the header is known. The result appears under its name when
/// finish() has written all of it, not before. Room for it is reserved as frames come: if the disk
/// becomes full, the frames until then can still be written.
///
/// Its members are declared in result_members.h. Real numbers are rounded to the decimal places
/// that are declared with them, then written as the shortest text that reads back as the same
/// double.
class ResultWriter : public ResultSink {
 public:
  /// Throws vp::OutputError if the disk has no room for a result. `folder` outlives this.
  explicit ResultWriter(host::OutputFolder& folder);
  ~ResultWriter() override;

  /// Throws vp::OutputError if the file cannot be written, as finish() does. A frame that failed is
  /// left out.
  void add(const facts::UnitReport& frame) override;
  void finish(const facts::RunFacts& facts, const facts::Provenance& provenance,
              const std::vector<std::string>& warnings) override;

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  host::OutputFolder& folder_;
  vp::OutputFile file_;
  std::unique_ptr<std::FILE, Close> frames_;
  std::uint64_t bytes_ = 0;  ///< of whole frames in it
};

/// One element of `frames`.
Json to_json(const facts::UnitReport& unit);

/// What ResultWriter writes, in memory: member for member result.json as it reads back, without
/// `provenance` and `configuration`, which its maker knows.
class ResultDocument : public ResultSink {
 public:
  using Json = nlohmann::ordered_json;

  void add(const facts::UnitReport& frame) override;
  void finish(const facts::RunFacts& facts, const facts::Provenance& provenance,
              const std::vector<std::string>& warnings) override;

  /// Null until finish().
  const Json& json() const { return json_; }
  Json take() { return std::move(json_); }

 private:
  Json frames_ = Json::array();
  Json json_;
};

}  // namespace platform::result
