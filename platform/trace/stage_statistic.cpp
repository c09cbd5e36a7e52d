// The stages of our programs, from the functions that run: the same stages as in result.json. The
// software's own stamps lie a reading of the timer beside the edges seen here.
#include <trace/statistics.h>

#include <algorithm>
#include <optional>

namespace platform::trace {

namespace {

using Time = std::optional<std::uint64_t>;

/// When the stages of a frame begin and end.
struct Stages {
  std::uint64_t number = 0;
  Time upload, upload_end;
  bool receives = false;  ///< features came from the PL
  Time extraction, extraction_end;
  Time evaluation, evaluation_end;
  Time pose, end;
};

double between(const Time& from, const Time& to) {
  return from && to && *to > *from ? static_cast<double>(*to - *from) / ps_per_us : 0;
}

class StageStatistic final : public Statistic {
 public:
  StageStatistic(Replay& replay, TraceFile& file, const Vocabulary& words)
      : replay_(replay), functions_(words.functions) {
    const auto follow = [&](const std::string& path) -> std::optional<Replay::Slot> {
      const int variable = file.find(path);
      if (variable < 0) return std::nullopt;
      return replay.watch(static_cast<std::uint32_t>(variable));
    };
    frame_ = follow("ps.cpu.frame");
    results_ = follow("ps.cpu.results");
    start_ = follow(words.start);
    name_ = follow("ps.cpu.function_name");
    table_.name = "stages";
    table_.title = "Stages of each frame";
    table_.columns = {"frame",      "upload_us",     "feature_extraction_us",
                      "receive_us", "evaluation_us", "identification_us",
                      "pose_us",    "latency_us"};
  }
  bool found() const override {
    return frame_ && results_ && name_ && !functions_.evaluation.empty();
  }

  void instant(std::uint64_t ps) override {
    if (!found()) return;
    // The result of a frame and the next frame come in one instant.
    if (begun_ && rises(*results_)) finish_frame(ps);
    if (rises(*frame_)) {
      begun_ = true;
      now_ = {};
      now_.number = replay_.bits(*frame_) - 1;
    }
    if (start_ && rises(*start_) && !now_.extraction) now_.extraction = ps;
    const std::string& name = replay_.text(*name_);
    if (name == running_) return;
    running_ = name;
    enter(name, ps);
  }
  void finish(std::uint64_t) override {}
  void report(std::vector<Table>& tables) const override { tables.push_back(table_); }

 private:
  bool rises(Replay::Slot slot) const {
    return replay_.known(slot) && replay_.was_known(slot) &&
           replay_.bits(slot) > replay_.bits_before(slot);
  }
  /// From now on function `name` runs; "": none that is annotated.
  void enter(const std::string& name, std::uint64_t ps);
  void finish_frame(std::uint64_t ps);

  Replay& replay_;
  const Vocabulary::Functions& functions_;
  std::optional<Replay::Slot> frame_, results_, start_, name_;
  Table table_;
  Stages now_;
  bool begun_ = false;
  std::string running_;
};

void StageStatistic::enter(const std::string& name, std::uint64_t ps) {
  const auto note = [&](Time& time) {
    if (!time) time = ps;
  };
  const bool out = name.empty();
  if (name == functions_.upload) note(now_.upload);
  if (out && now_.upload) note(now_.upload_end);
  if (name == functions_.capture) note(now_.extraction);
  if (name == functions_.receive) now_.receives = true;
  if (out && now_.receives) note(now_.extraction_end);
  if (name == functions_.evaluation) {
    note(now_.extraction_end);
    note(now_.evaluation);
    return;
  }
  const auto& search = functions_.search;
  const bool searches = std::find(search.begin(), search.end(), name) != search.end();
  if (now_.evaluation && (out || searches)) note(now_.evaluation_end);
  if (name == functions_.pose) note(now_.pose);
}

void StageStatistic::finish_frame(std::uint64_t ps) {
  now_.end = ps;
  const Time& search_end = now_.pose ? now_.pose : now_.end;
  const double columns[] = {between(now_.upload, now_.upload_end),
                            between(now_.extraction, now_.extraction_end),
                            between(now_.extraction_end, now_.evaluation),
                            between(now_.evaluation, now_.evaluation_end),
                            between(now_.evaluation_end, search_end),
                            between(now_.pose, now_.end),
                            between(now_.extraction, now_.end)};
  table_.rows.emplace_back();
  table_.rows.back().emplace_back(now_.number);
  for (const double column : columns) table_.rows.back().emplace_back(column);
  begun_ = false;
}

}  // namespace

std::unique_ptr<Statistic> stage_statistic(Replay& replay, TraceFile& file,
                                           const Vocabulary& words) {
  return std::make_unique<StageStatistic>(replay, file, words);
}

}  // namespace platform::trace
