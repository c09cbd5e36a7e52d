#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace platform::facts {

/// What happened when, on the first frames of a run: intervals by engine, and levels that change.
/// Plain values; recorded by the simulation.
struct Timeline {
  struct Span {
    std::uint64_t start_ps = 0;
    std::uint64_t length_ps = 0;
    std::uint32_t name = 0;  ///< index into `names`
    bool critical = false;   ///< a shorter one would make the frame shorter
  };
  /// Spans of one engine, by start. Two of them nest or do not touch.
  struct Track {
    std::string group;  ///< "Frame", "PL", "DMA", "Interrupts", "PS"
    std::string name;   ///< "Sensor input"
    std::vector<Span> spans;
  };
  struct Point {
    std::uint64_t ps = 0;
    double value = 0;  ///< from then on
  };
  struct Counter {
    std::string name;  ///< "Word buffer"
    std::string unit;  ///< "words"
    double limit = 0;  ///< what it can be at most; 0: none
    std::vector<Point> points;
  };
  /// How signals hand something over, change by change.
  struct Handshake {
    struct Line {
      std::string name;
      std::uint32_t bits = 1;
      std::vector<Point> points;
    };
    std::string name;
    std::vector<Line> signals;
    std::map<std::uint64_t, std::string> meanings;  ///< what the words say
  };
  struct Frame {
    std::uint32_t index = 0;
    std::uint64_t start_ps = 0, end_ps = 0;
  };

  std::vector<std::string> names;
  std::vector<Track> tracks;
  std::vector<Counter> counters;
  std::vector<Frame> frames;
  std::vector<Handshake> handshakes;

  bool empty() const { return frames.empty(); }
  /// Index of a name, added if it is new.
  std::uint32_t name(const std::string& text);
};

/// Chrome's trace format, for ui.perfetto.dev: a thread for each track, a counter for each level.
/// Times in us with 6 decimal places (1 ps).
std::string trace_event_json(const Timeline& timeline);

/// The same for the page: {"names": […], "tracks": [{"group", "name", "spans": [[start us, length
/// us, name, critical]…]}], "counters": [{"name", "unit", "limit", "points": [[us, value]…]}],
/// "frames": [{"index", "start", "end"}], "handshakes": [{"name", "signals": [{"name", "bits",
/// "points": [[us, value]…]}], "meanings": {"word": "sample 5"}}]}, with 3 decimal places (1 ns).
std::string page_json(const Timeline& timeline);

}  // namespace platform::facts
