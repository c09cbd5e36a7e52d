#include <trace/statistics.h>

#include <algorithm>

#include <vp/error.h>
#include <vp/text.h>

namespace platform::trace {

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
  std::vector<std::string> names = file.paths();
  const std::size_t count = names.size();
  if (names.size() > shown) names.resize(shown);
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
  collector.all.push_back(frame_statistic(replay, file, words));
  collector.all.push_back(stage_statistic(replay, file, words));
  collector.all.push_back(link_statistic(replay, file, options));
  collector.all.push_back(buffer_statistic(replay, file, words));
  collector.all.push_back(interrupt_statistic(replay, file, words));
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

}  // namespace platform::trace
