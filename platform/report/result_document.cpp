#include <report/result_document.h>

#include <report/result_parts.h>

namespace platform::report {

void ResultDocument::add(const FrameReport& frame) {
  frames_.push_back(to_json(frame));
  summary_.add(frame);
}

void ResultDocument::finish(const RunFacts& facts, const Provenance&,
                            const std::vector<std::string>& warnings) {
  json_ = Json::object();
  json_["schema"] = result_schema;
  add_run(json_, facts);
  add_end(json_, facts, warnings);
  json_["frames"] = std::move(frames_);
  add_figures(json_, facts, summary_);
}

}  // namespace platform::report
