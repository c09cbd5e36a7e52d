#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include <trace/statistics.h>

// The stages of our programs, from the functions that run: the same stages as in result.json. The
// software's own stamps lie a reading of the timer beside the edges seen here.

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
  StageStatistic(Replay& replay, const Vocabulary& words)
      : replay_(replay), functions_(words.functions) {
    frame_ = replay.follow("ps.cpu.frame");
    results_ = replay.follow("ps.cpu.results");
    start_ = replay.follow(words.start);
    name_ = replay.follow("ps.cpu.function_name");
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

std::unique_ptr<Statistic> stage_statistic(Replay& replay, const Vocabulary& words) {
  return std::make_unique<StageStatistic>(replay, words);
}

namespace {

struct Function {
  std::uint64_t calls = 0;
  std::uint64_t self_ps = 0;
};

struct Frame {
  std::uint64_t number = 0;  ///< as in result.json
  std::uint64_t taken_ps = 0;
  std::optional<std::uint64_t> start_ps, end_ps;
  std::optional<std::uint64_t> upload_ps, upload_end_ps;
  std::uint64_t words = 0;
  std::vector<std::uint64_t> of_kind;  ///< words, by kind
  std::vector<std::uint64_t> lost;     ///< by counter
  std::map<std::string, Function> functions;
};

class FrameStatistic final : public Statistic {
 public:
  FrameStatistic(Replay& replay, const Vocabulary& words) : replay_(replay), words_(words) {
    frame_ = replay.follow("ps.cpu.frame");
    results_ = replay.follow("ps.cpu.results");
    start_ = replay.follow(words.start);
    feature_ = replay.follow(words.word);
    function_ = replay.follow("ps.cpu.function");
    name_ = replay.follow("ps.cpu.function_name");
    for (const auto& loss : words.losses) counters_.push_back(replay.follow(loss.path));
  }
  bool found() const override { return frame_ || results_ || function_; }

  void instant(std::uint64_t ps) override {
    pass_function(ps);
    // The result of a frame and the next frame come in one instant.
    if (results_ && rises(*results_) && !frames_.empty()) finish_frame(frames_.back(), ps);
    if (frame_ && (rises(*frame_) || (!started_ && value(*frame_) > 0))) begin(ps);
    started_ = true;
    if (frames_.empty()) begin(ps);
    Frame& frame = frames_.back();
    if (start_ && rises(*start_) && !frame.start_ps) frame.start_ps = ps;
    if (feature_ && changes(*feature_)) count_word(frame, value(*feature_));
  }
  void finish(std::uint64_t ps) override {
    if (started_ && !frames_.empty()) add_time(ps);
  }
  void report(std::vector<Table>& tables) const override;

 private:
  std::uint64_t value(Replay::Slot slot) const {
    return replay_.known(slot) ? replay_.bits(slot) : 0;
  }
  bool changes(Replay::Slot slot) const {
    return replay_.known(slot) && replay_.was_known(slot) &&
           replay_.bits(slot) != replay_.bits_before(slot);
  }
  bool rises(Replay::Slot slot) const {
    return changes(slot) && replay_.bits(slot) > replay_.bits_before(slot);
  }

  void begin(std::uint64_t ps) {
    Frame frame;
    const std::uint64_t taken = frame_ ? value(*frame_) : frames_.size() + 1;
    frame.number = taken == 0 ? 0 : taken - 1;
    frame.taken_ps = ps;
    frame.of_kind.resize(words_.word_kinds.size());
    frames_.push_back(std::move(frame));
  }
  void count_word(Frame& frame, std::uint64_t word) {
    if (word == 0) return;  // what a reset shows
    ++frame.words;
    for (std::size_t i = 0; i < words_.word_kinds.size(); ++i)
      frame.of_kind[i] += words_.word_kinds[i].counts(word) ? 1 : 0;
  }
  void finish_frame(Frame& frame, std::uint64_t ps) {
    frame.end_ps = ps;
    frame.lost.clear();
    for (const auto& counter : counters_) frame.lost.push_back(counter ? value(*counter) : 0);
  }
  void pass_function(std::uint64_t ps) {
    if (!function_) return;
    if (!frames_.empty()) add_time(ps);
    function_ps_ = ps;
    const std::uint64_t number = value(*function_);
    if (number == running_) return;
    running_ = number;
    running_name_ = name_ ? replay_.text(*name_) : "function " + std::to_string(number);
    if (frames_.empty()) return;
    Frame& frame = frames_.back();
    if (number != 0) ++frame.functions[running_name_].calls;
    if (running_name_ == words_.functions.upload && !frame.upload_ps) frame.upload_ps = ps;
    if (number == 0 && frame.upload_ps && !frame.upload_end_ps) frame.upload_end_ps = ps;
  }
  void add_time(std::uint64_t ps) {
    if (running_ != 0) frames_.back().functions[running_name_].self_ps += ps - function_ps_;
  }

  Replay& replay_;
  const Vocabulary& words_;
  std::optional<Replay::Slot> frame_, results_, start_, feature_, function_, name_;
  std::vector<std::optional<Replay::Slot>> counters_;
  std::vector<Frame> frames_;
  bool started_ = false;
  std::uint64_t running_ = 0;
  std::string running_name_;
  std::uint64_t function_ps_ = 0;
};

void FrameStatistic::report(std::vector<Table>& tables) const {
  Table summary{
      "summary", "Frames", {"frames", "fps_mean", "latency_mean_us", "latency_max_us"}, {}, false};
  Table frames{
      "frames", "Each frame", {"frame", "taken_us", "start_us", "end_us", "latency_us"}, {}, false};
  Table functions{"functions",
                  "Software: time inside each function, without those it calls",
                  {"frame", "function", "entries", "self_us"},
                  {},
                  false};
  if (feature_) {
    for (const auto& kind : words_.word_kinds) frames.columns.push_back(kind.column);
    frames.columns.emplace_back("feature_words");
  }
  for (std::size_t i = 0; i < counters_.size(); ++i) {
    if (counters_[i]) frames.columns.push_back(words_.losses[i].name);
  }
  double sum_ps = 0, most_ps = 0, busy_ps = 0;
  std::uint64_t complete = 0;
  // As the run's report counts: from result to result, over frames that the software gave up, the
  // uploads excluded.
  std::optional<std::uint64_t> since_ps;
  std::uint64_t upload_ps = 0;
  for (const Frame& frame : frames_) {
    const bool any = frame.end_ps || !frame.functions.empty();
    if (!any || (frame_ && frame.taken_ps == 0 && !frame.end_ps)) continue;
    for (const auto& [name, function] : frame.functions) {
      functions.rows.push_back(
          {frame.number, name, function.calls, static_cast<double>(function.self_ps) / ps_per_us});
    }
    const std::uint64_t start = frame.start_ps.value_or(frame.taken_ps);
    if (since_ps && frame.upload_end_ps) upload_ps += *frame.upload_end_ps - *frame.upload_ps;
    if (!since_ps) since_ps = start;
    if (frame.end_ps) {
      const auto latency = static_cast<double>(*frame.end_ps - start);
      ++complete;
      sum_ps += latency;
      most_ps = std::max(most_ps, latency);
      busy_ps += static_cast<double>(*frame.end_ps - *since_ps - upload_ps);
      since_ps = frame.end_ps;
      upload_ps = 0;
      std::vector<Table::Cell> row = {frame.number, static_cast<double>(frame.taken_ps) / ps_per_us,
                                      static_cast<double>(start) / ps_per_us,
                                      static_cast<double>(*frame.end_ps) / ps_per_us,
                                      latency / ps_per_us};
      if (feature_) {
        row.insert(row.end(), frame.of_kind.begin(), frame.of_kind.end());
        row.emplace_back(frame.words);
      }
      for (std::size_t i = 0; i < counters_.size(); ++i) {
        if (counters_[i]) row.emplace_back(frame.lost[i]);
      }
      frames.rows.push_back(std::move(row));
    }
  }
  if (complete > 0) {
    const double mean = sum_ps / static_cast<double>(complete);
    summary.rows.push_back({complete, ps_per_s * static_cast<double>(complete) / busy_ps,
                            mean / ps_per_us, most_ps / ps_per_us});
  }
  tables.push_back(std::move(summary));
  tables.push_back(std::move(frames));
  tables.push_back(std::move(functions));
}

}  // namespace

std::unique_ptr<Statistic> frame_statistic(Replay& replay, const Vocabulary& words) {
  return std::make_unique<FrameStatistic>(replay, words);
}

}  // namespace platform::trace
