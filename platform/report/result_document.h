#pragma once

#include <nlohmann/json.hpp>
#include <utility>

#include <report/result_sink.h>

namespace platform::report {

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

}  // namespace platform::report
