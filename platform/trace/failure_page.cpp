#include <trace/failure_page.h>

#include <trace/clock_choice.h>
#include <vp/frame_gate.h>
#include <vp/text.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace platform::trace {

namespace {

using Paths = std::vector<std::string>;

bool has_word(std::string_view path, const std::vector<const char*>& words) {
  const std::string leaf = vp::lower(leaf_of(path));
  return std::any_of(words.begin(), words.end(),
                     [&](const char* word) { return leaf.find(word) != std::string::npos; });
}

/// The bit that is called a clock and is nearest to a signal; empty if there is no such bit.
Paths clock_near(const TraceFile& file, const std::string& path) {
  Paths found;
  for (std::uint32_t i = 0; i < file.paths().size(); ++i) {
    const std::string& candidate = file.paths()[i];
    if (!may_be_clock(candidate, file.variable(i))) continue;
    if (found.empty() || nearness(path, candidate) > nearness(path, found.front()))
      found = {candidate};
  }
  return found;
}

void append(SaveFile& page, const TraceFile& file, const char* title, const Paths& paths) {
  if (paths.empty()) return;
  SaveFile::Line line;
  line.path = title;
  line.title = true;
  page.lines.push_back(line);
  for (SaveFile::Line& one : save_lines(file, paths)) page.lines.push_back(std::move(one));
}

}  // namespace

SaveFile failure_page(const TraceFile& file, const CheckResult& result) {
  const Check& check = *result.check;
  Paths asked;
  for (const vp::Expression* expression : {&check.first, &check.second}) {
    for (const std::string& name : expression->names()) {
      const std::string& path = file.paths()[vp::find_path(name, file.paths(), "")];
      if (std::find(asked.begin(), asked.end(), path) == asked.end()) asked.push_back(path);
    }
  }
  constexpr std::size_t most = 16;
  Paths buffers, others, clock;
  if (!asked.empty()) clock = clock_near(file, asked.front());
  for (const std::string& path : file.paths()) {
    const auto is_beside = [&](const std::string& one) { return scope_of(one) == scope_of(path); };
    const bool listed = std::find(asked.begin(), asked.end(), path) != asked.end() ||
                        std::find(clock.begin(), clock.end(), path) != clock.end();
    if (listed || std::none_of(asked.begin(), asked.end(), is_beside)) continue;
    Paths& to = has_word(path, {"count", "level", "fill", "depth", "overflow", "full", "empty"})
                    ? buffers
                    : others;
    if (to.size() < most) to.push_back(path);
  }
  constexpr std::uint64_t ps_per_s = 1'000'000'000'000, cycles_around = 100;
  const std::uint64_t margin_ps = cycles_around * ps_per_s / check.clock_hz;
  const std::uint64_t before_ps = margin_ps + check.limit_ps;
  SaveFile page;
  page.comment = check.name + ": " + check.text;
  append(page, file, "Check", asked);
  append(page, file, "Clock", clock);
  append(page, file, "Buffers", buffers);
  append(page, file, "Beside", others);
  page.marker_ps = result.first_ps;
  page.start_ps = result.first_ps > before_ps ? result.first_ps - before_ps : 0;
  page.end_ps = result.first_ps + margin_ps;
  page.timescale_fs = file.reader().timescale_fs();
  return page;
}

}  // namespace platform::trace
