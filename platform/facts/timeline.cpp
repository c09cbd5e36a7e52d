#include <facts/timeline.h>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace platform::facts {

namespace {

constexpr int process = 1;

/// Names come from programs: anything may stand in them.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) < 0x20) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

/// ps as us, without binary fractions in between.
std::string exact_us(std::uint64_t ps) {
  return fmt::format("{}.{:06}", ps / 1'000'000, ps % 1'000'000);
}

std::string brief_us(std::uint64_t ps) {
  const std::uint64_t ns = (ps + 500) / 1000;
  return fmt::format("{}.{:03}", ns / 1000, ns % 1000);
}

void add_event(std::string& out, const std::string& event) {
  if (out.back() != '[') out += ',';
  out += '\n';
  out += event;
}

/// "[a,b,c]" of what `write` makes of each item.
template <class Items, class Write>
std::string list(const Items& items, Write write) {
  std::string out = "[";
  for (const auto& item : items) {
    if (out.size() > 1) out += ',';
    out += write(item);
  }
  return out + ']';
}

}  // namespace

std::uint32_t Timeline::name(const std::string& text) {
  const auto known = std::find(names.begin(), names.end(), text);
  if (known == names.end()) {
    names.push_back(text);
    return static_cast<std::uint32_t>(names.size() - 1);
  }
  return static_cast<std::uint32_t>(std::distance(names.begin(), known));
}

std::string trace_event_json(const Timeline& timeline) {
  std::string out = "{\"displayTimeUnit\":\"ns\",\"traceEvents\":[";
  add_event(out, fmt::format(R"({{"ph":"M","pid":{},"name":"process_name",)"
                             R"("args":{{"name":"markervp"}}}})",
                             process));
  for (std::size_t i = 0; i < timeline.tracks.size(); ++i) {
    const Timeline::Track& track = timeline.tracks[i];
    const std::size_t thread = i + 1;
    add_event(out, fmt::format(R"({{"ph":"M","pid":{},"tid":{},"name":"thread_name",)"
                               R"("args":{{"name":{}}}}})",
                               process, thread, quoted(track.group + ": " + track.name)));
    add_event(out, fmt::format(R"({{"ph":"M","pid":{},"tid":{},"name":"thread_sort_index",)"
                               R"("args":{{"sort_index":{}}}}})",
                               process, thread, thread));
    for (const Timeline::Span& span : track.spans) {
      add_event(
          out,
          fmt::format(R"({{"ph":"X","pid":{},"tid":{},"ts":{},"dur":{},"name":{},"cat":{}}})",
                      process, thread, exact_us(span.start_ps), exact_us(span.length_ps),
                      quoted(timeline.names[span.name]), span.critical ? "\"critical\"" : "\"\""));
    }
  }
  for (const Timeline::Counter& counter : timeline.counters) {
    const std::string name = quoted(counter.name + ", " + counter.unit);
    for (const Timeline::Point& point : counter.points) {
      add_event(out, fmt::format(R"({{"ph":"C","pid":{},"ts":{},"name":{},"args":{{"value":{}}}}})",
                                 process, exact_us(point.ps), name, point.value));
    }
  }
  return out + "\n]}\n";
}

std::string page_json(const Timeline& timeline) {
  const auto span = [](const Timeline::Span& s) {
    return fmt::format("[{},{},{},{:d}]", brief_us(s.start_ps), brief_us(s.length_ps), s.name,
                       s.critical);
  };
  const auto point = [](const Timeline::Point& p) {
    return fmt::format("[{},{}]", brief_us(p.ps), p.value);
  };
  return fmt::format(
      R"({{"names":{},"tracks":{},"counters":{},"frames":{},"handshakes":{}}})",
      list(timeline.names, quoted),
      list(timeline.tracks,
           [&](const Timeline::Track& t) {
             return fmt::format(R"({{"group":{},"name":{},"spans":{}}})", quoted(t.group),
                                quoted(t.name), list(t.spans, span));
           }),
      list(timeline.counters,
           [&](const Timeline::Counter& c) {
             return fmt::format(R"({{"name":{},"unit":{},"limit":{},"points":{}}})", quoted(c.name),
                                quoted(c.unit), c.limit, list(c.points, point));
           }),
      list(timeline.frames,
           [](const Timeline::Frame& f) {
             return fmt::format(R"({{"index":{},"start":{},"end":{}}})", f.index,
                                brief_us(f.start_ps), brief_us(f.end_ps));
           }),
      list(timeline.handshakes, [&](const Timeline::Handshake& h) {
        std::string meanings;
        for (const auto& [word, text] : h.meanings)
          meanings += fmt::format(R"({}"{}":{})", meanings.empty() ? "" : ",", word, quoted(text));
        return fmt::format(R"({{"name":{},"signals":{},"meanings":{{{}}}}})", quoted(h.name),
                           list(h.signals,
                                [&](const Timeline::Handshake::Line& l) {
                                  return fmt::format(R"({{"name":{},"bits":{},"points":{}}})",
                                                     quoted(l.name), l.bits, list(l.points, point));
                                }),
                           meanings);
      }));
}

}  // namespace platform::facts
