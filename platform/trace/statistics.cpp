#include <algorithm>

#include <trace/statistics.h>
#include <vp/error.h>
#include <vp/text.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <map>
#include <optional>
#include <utility>

// The stages of our programs, from the functions that run: the same stages as in result.json. The
// software's own stamps lie a reading of the timer beside the edges seen here.

namespace platform::trace {

namespace {

constexpr int places = 3;

std::string shown(const Table::Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* whole = std::get_if<std::uint64_t>(&cell)) return std::to_string(*whole);
  return vp::format_fixed(std::get<double>(cell), places);
}

/// To six places, as in result.json.
double rounded(double value) {
  constexpr double scale = 1e6;
  return std::round(value * scale) / scale;
}

std::string quoted(const std::string& text) {
  return text.find_first_of(",\"\n") == std::string::npos ? text : quoted_cell(text);
}

void append(std::string& line, const std::string& cell, std::size_t width, bool left) {
  const std::string blanks(width - cell.size(), ' ');
  line += left ? cell + blanks : blanks + cell;
}

std::string as_text(const Table& table) {
  std::vector<std::size_t> widths;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    std::size_t width = table.columns[c].size();
    for (const auto& row : table.rows) width = std::max(width, shown(row[c]).size());
    widths.push_back(width);
  }
  const auto is_left = [&](std::size_t c) {
    return std::holds_alternative<std::string>(table.rows.front()[c]);
  };
  std::string text = table.title + "\n";
  const auto add_line = [&](const auto& cell_of) {
    std::string line = "  ";
    for (std::size_t c = 0; c < widths.size(); ++c) {
      if (c > 0) line += "  ";
      append(line, cell_of(c), widths[c], is_left(c));
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  };
  add_line([&](std::size_t c) { return table.columns[c]; });
  for (const auto& row : table.rows) add_line([&](std::size_t c) { return shown(row[c]); });
  return text;
}

}  // namespace

std::string quoted_cell(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

std::string json_text(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string tables_as_text(const std::vector<Table>& tables) {
  std::string text;
  for (const Table& table : tables) {
    if (table.rows.empty() || table.detail) continue;
    text += (text.empty() ? "" : "\n") + as_text(table);
  }
  return text;
}

std::string tables_as_json(const std::vector<Table>& tables) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const Table& table : tables) {
    auto& rows = json[table.name] = nlohmann::ordered_json::array();
    for (const auto& row : table.rows) {
      nlohmann::ordered_json object;
      for (std::size_t c = 0; c < row.size(); ++c) {
        auto& value = object[table.columns[c]];
        if (const auto* text = std::get_if<std::string>(&row[c])) {
          value = *text;
        } else if (const auto* whole = std::get_if<std::uint64_t>(&row[c])) {
          value = *whole;
        } else {
          value = rounded(std::get<double>(row[c]));
        }
      }
      rows.push_back(std::move(object));
    }
  }
  return json.dump(2) + "\n";
}

std::string tables_as_csv(const std::vector<Table>& tables) {
  std::string text;
  for (const Table& table : tables) {
    if (table.rows.empty()) continue;
    text += (text.empty() ? "" : "\n") + table.name + "\n" + vp::join(table.columns, ",") + "\n";
    for (const auto& row : table.rows) {
      for (std::size_t c = 0; c < row.size(); ++c) {
        const auto* real = std::get_if<double>(&row[c]);
        text += (c > 0 ? "," : "") + (real ? vp::format_fixed(*real, 6) : quoted(shown(row[c])));
      }
      text += "\n";
    }
  }
  return text;
}

namespace {

struct Collector : Replay::Listener {
  std::vector<std::unique_ptr<Statistic>> all;
  bool instant(std::uint64_t ps) override {
    for (const auto& each : all) each->instant(ps);
    return true;
  }
};

[[noreturn]] void refuse(const TraceFile& file, const Vocabulary& words) {
  constexpr std::size_t shown = 4;
  const std::size_t count = file.paths().size();
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(count, shown); ++i) names.push_back(file.paths()[i]);
  throw vp::InputError(
      "trace '" + file.name() +
      "' has nothing that markervp knows: no link (….tvalid and ….tready), no buffer "
      "(" +
      (words.buffers.empty() ? "none is known" : words.buffers.front().count + ", …") +
      "), no interrupt, no ps.cpu.frame or ps.cpu.function; "
      "its " +
      std::to_string(count) + " signals are " + vp::join(names, ", ") +
      (count > shown ? ", …" : "") + "; name them with --map");
}

}  // namespace

std::vector<Table> statistics(TraceFile& file, const Vocabulary& words,
                              const StatisticsOptions& options) {
  Replay replay(file);
  Collector collector;
  collector.all.push_back(frame_statistic(replay, words));
  collector.all.push_back(stage_statistic(replay, words));
  collector.all.push_back(link_statistic(replay, file, options));
  collector.all.push_back(buffer_statistic(replay, words));
  collector.all.push_back(interrupt_statistic(replay, words));
  auto& all = collector.all;
  all.erase(std::remove_if(all.begin(), all.end(), [](const auto& s) { return !s->found(); }),
            all.end());
  if (all.empty()) refuse(file, words);
  replay.run(collector);
  std::vector<Table> tables;
  for (const auto& each : all) {
    each->finish(replay.last_ps());
    each->report(tables);
  }
  return tables;
}

namespace {

using Time = std::optional<std::uint64_t>;

/// When the stages of a frame begin and end.
struct Stages {
  std::uint64_t number = 0;
  Time upload, upload_end;
  bool receives = false;  ///< features came from the PL
  Time extraction, extraction_end;
  Time evaluation, evaluation_end;
  Time last, end;
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
    table_.columns = {"frame",         "upload_us",         "feature_extraction_us", "receive_us",
                      "evaluation_us", "identification_us", functions_.last_column,  "latency_us"};
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
  if (name == functions_.last) note(now_.last);
}

void StageStatistic::finish_frame(std::uint64_t ps) {
  now_.end = ps;
  const Time& search_end = now_.last ? now_.last : now_.end;
  const double columns[] = {between(now_.upload, now_.upload_end),
                            between(now_.extraction, now_.extraction_end),
                            between(now_.extraction_end, now_.evaluation),
                            between(now_.evaluation, now_.evaluation_end),
                            between(now_.evaluation_end, search_end),
                            between(now_.last, now_.end),
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
