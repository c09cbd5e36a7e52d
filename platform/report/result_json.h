#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include <report/result.h>
#include <report/result_writer.h>
#include <report/summary.h>
#include <report/verdict.h>

namespace platform::report {

using Json = nlohmann::ordered_json;

/// `value` with that many decimal places: what result.json holds. Never -0. The table stands at
/// ResultWriter.
double rounded(double value, int places);

/// One element of `frames`.
Json to_json(const FrameReport& frame);
Json to_json(const Summary& summary);
/// `camera`: how the program kept up with its rate.
Json camera_json(const CameraReport& camera, const Summary& summary);
/// The keys of `time_us` in the order of the flow; `part_of` names the stage that contains one.
Json stages_json(const Summary& summary);
Json to_json(const ProgramEnd& end);
Json to_json(const Provenance& provenance);

/// Of result.json.
constexpr int result_schema = 1;

/// Adds what ran.
void add_run(Json& json, const RunFacts& facts);

/// Adds how it went.
void add_end(Json& json, const RunFacts& facts, const std::vector<std::string>& warnings);

/// Adds what stands behind the frames: summary, verdict, power, resources, timing, clocks.
void add_figures(Json& json, const RunFacts& facts, const Summary& summary);

/// What ResultWriter writes, in memory: member for member result.json as it reads back, without
/// `provenance` and `configuration`, which its maker knows.
class ResultDocument : public ResultSink {
 public:
  using Json = nlohmann::ordered_json;

  void add(const FrameReport& frame) override;
  void finish(const RunFacts& facts, const Provenance& provenance,
              const std::vector<std::string>& warnings) override;

  /// Null until finish().
  const Json& json() const { return json_; }
  Json take() { return std::move(json_); }

 private:
  Json frames_ = Json::array();
  Json json_;
};

/// `energy_mj` of a frame: the total first.
Json energy_json(const std::vector<GroupEnergy>& energy);
/// `power_w` of the summary.
Json power_summary_json(const PowerReport& power);

Json to_json(const PowerReport& power);
Json to_json(const ResourceReport& resources);
Json to_json(const TimingReport& timing);
Json to_json(const ClockReport& clocks);
/// `feasible`, and by part `holds` ("yes", "no", "unknown") and what else is known.
Json to_json(const Verdict& verdict);

/// Places of watts and millijoules: sums of what stands in the file hold to 1e-9.
constexpr int energy_places = 12;

}  // namespace platform::report
