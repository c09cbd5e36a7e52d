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
#include <result/verdict.h>
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
/// Real numbers are rounded to these decimal places, then written as the shortest text that reads
/// back as the same double:
///
///   | Key                                          | Unit   | Places |
///   |----------------------------------------------|--------|--------|
///   | figures of a unit                            |        | 9      |
///   | time_us, latency_us (6 places are 1 ps)      | us     | 6      |
///   | fps                                          | 1/s    | 6      |
///   | power: w, total_w, rails; power_w            | W      | 12     |
///   | mj, energy_mj, energy_per_frame_mj           | mJ     | 12     |
///   | ambient_c, junction_c                        | C      | 6      |
///   | frequency_mhz, fmax_mhz                      | MHz    | 6      |
///   | margin_percent                               | %      | 3      |
///   | bram36                                       |        | 1      |
///   | provenance.wall_time_s                       | s      | 3      |
///
/// What an application adds has places of its own (facts::UnitExtra::add_members).
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

using Json = nlohmann::ordered_json;

/// `value` with that many decimal places: what result.json holds. Never -0. The table is at
/// ResultWriter.
double rounded(double value, int places);

/// One element of `frames`.
Json to_json(const facts::UnitReport& frame);
Json to_json(const facts::Summary& summary, const facts::Work& work);
/// `camera`: how the program kept up with its rate.
Json camera_json(const facts::CameraReport& camera, const facts::Summary& summary);
/// The keys of `time_us` in the order of the flow; `part_of` names the stage that contains one.
Json stages_json(const facts::Summary& summary);
Json to_json(const facts::Limit& limit, const facts::Work& work);
Json to_json(const facts::ProgramEnd& end);
Json to_json(const facts::Provenance& provenance);

/// Of result.json.
constexpr int result_schema = 1;

/// Adds what ran.
void add_run(Json& json, const facts::RunFacts& facts);

/// Adds how it went.
void add_end(Json& json, const facts::RunFacts& facts, const std::vector<std::string>& warnings);

/// Adds what is behind the frames: summary, verdict, power, resources, timing, clocks.
void add_figures(Json& json, const facts::RunFacts& facts, const facts::Summary& summary);

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

/// `energy_mj` of a frame: the total first.
Json energy_json(const std::vector<facts::GroupEnergy>& energy);
/// `power_w` of the summary.
Json power_summary_json(const facts::PowerReport& power);

Json to_json(const facts::PowerReport& power);
Json to_json(const facts::ResourceReport& resources);
Json to_json(const facts::TimingReport& timing);
Json to_json(const facts::ClockReport& clocks);
/// `feasible`, and by part `holds` ("yes", "no", "unknown") and what else is known.
Json to_json(const Verdict& verdict);

/// Places of watts and millijoules: sums of what is in the file hold to 1e-9.
constexpr int energy_places = 12;

}  // namespace platform::result
