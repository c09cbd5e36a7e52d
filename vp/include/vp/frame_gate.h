#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <vp/expression.h>
#include <vp/wave_paths.h>
#include <vp/wave_writer.h>

namespace vp {

/// Which frames a trace keeps.
struct FrameTrigger {
  Expression condition;                ///< a frame in which it comes true is kept
  std::string frame = "ps.cpu.frame";  ///< the signal whose changes begin a frame
  unsigned frames_before = 0;          ///< frames kept before such a frame
  /// Bytes of changes held until a frame is judged; about 4 a change. The oldest are given up.
  std::size_t buffer = std::size_t{256} << 20;
  bool expected = true;  ///< it is reported if it never comes true
};

/// A writer before another one that passes on the frames in which something happens. In between
/// the file has a pause: everything is x there.
class FrameGate final : public WaveWriter {
 public:
  FrameGate(std::unique_ptr<WaveWriter> target, FrameTrigger trigger);
  ~FrameGate() override;

  /// The trigger needs these signals, by their paths of all there are, whatever else is traced.
  /// Throws InputError for a name that fits no signal or several.
  std::vector<std::string> needed(const std::vector<std::string>& paths) const;

  Id add(std::string_view path, Kind kind, unsigned width) override;
  /// Throws InputError for a trigger on signals that were not added.
  void begin(std::uint64_t ps, const std::vector<std::uint64_t>& values) override;
  void begin_written(std::uint64_t ps, const WrittenValues& values) override;
  bool begun() const override { return begun_; }
  void set_time(std::uint64_t ps) override;
  void change(Id id, std::uint64_t bits) override;
  void change_digits(Id id, std::string_view digits) override;
  void change_text(Id id, std::string_view text) override;
  void pause() override;
  void resume(const std::vector<std::uint64_t>& values) override;
  bool failed() const override { return target_->failed(); }
  void close(std::uint64_t end_ps) override;

  /// Frames that were kept, and bytes of changes that were given up because the buffer was full.
  std::uint64_t kept() const { return kept_; }
  std::uint64_t lost_bytes() const { return lost_bytes_; }

 private:
  /// All values at its beginning, and the changes since.
  struct Chunk {
    std::uint64_t start_ps;
    std::vector<std::uint64_t> values;
    std::vector<std::string> texts;
    std::vector<unsigned char> changes;
  };
  struct Frame {
    std::deque<Chunk> chunks;
    std::uint64_t end_ps = 0;
  };
  class Values;

  void end_instant();
  void end_frame(std::uint64_t ps);
  void open_chunk(Frame& frame);
  void keep_within_buffer();
  void put(std::uint64_t number);
  void put_time();
  void play(const Frame& frame);
  void play(const Chunk& chunk);

  std::unique_ptr<WaveWriter> target_;
  FrameTrigger trigger_;
  std::vector<std::string> paths_;
  std::vector<Kind> kinds_;
  Id frame_id_ = 0;
  std::vector<char> watched_;  ///< by id: the frame signal or in the condition
  bool begun_ = false;
  bool watched_changed_ = false;
  bool triggered_ = false;
  bool written_ = false;  ///< the target has begun
  std::uint64_t time_ps_ = 0;
  std::uint64_t chunk_time_ps_ = 0;  ///< of the last change in the open chunk
  std::uint64_t target_ps_ = 0;      ///< up to where the target was written
  std::vector<std::uint64_t> values_, before_;
  std::vector<std::string> texts_;
  std::deque<Frame> frames_;  ///< the last one is running
  std::size_t held_ = 0;
  std::uint64_t kept_ = 0;
  std::uint64_t lost_bytes_ = 0;
};

/// Chooses signals by their hierarchical names.
///
/// A list of patterns, each with `+` (take, the default) or `-` (leave out) before it; the last one
/// that matches a name decides. In a pattern `*` and `?` stand for any characters and one character
/// within a level, `**` as a whole level represents any number of levels. A pattern without these
/// that names a module takes everything below it. If the first pattern is a `-`, everything else is
/// taken. No pattern at all: everything.
///
///     zynq.pl.**, -zynq.pl.axi_dma_0, +zynq.pl.axi_dma_0.mm2s_*
class TraceFilter {
 public:
  TraceFilter() = default;
  /// Each element may itself hold several patterns, separated by commas or blanks.
  /// Throws InputError for a malformed pattern.
  TraceFilter(const std::vector<std::string>& patterns);

  bool selects(std::string_view path) const;

  /// Throws InputError if a `+` pattern matches none of `paths`, or if nothing of them is selected;
  /// the message tells what there is instead. `hidden`: paths that another trace level shows.
  void check(const std::vector<std::string>& paths, const std::vector<std::string>& hidden) const;
  void check(const WavePaths& paths) const;

 private:
  struct Pattern {
    std::string text;  ///< as the user wrote it
    bool take;
    bool subtree;  ///< no wildcard: a module represents what is below it
    std::vector<std::string> levels;
  };
  static Pattern parse(std::string_view text);
  static bool matches(const Pattern& pattern, std::string_view path);
  static std::string suggestion(const Pattern& pattern, const std::vector<std::string>& paths);

  std::vector<Pattern> patterns_;
};

/// The place in `paths` of a signal that a user wrote: its whole path, or the end of one path only
/// ("feature_overflow"). Throws InputError that begins with `where` and names what is near.
std::uint32_t find_path(const std::string& name, const std::vector<std::string>& paths,
                        const std::string& where = "");
std::uint32_t find_path(const std::string& name, const WavePaths& paths,
                        const std::string& where = "");

}  // namespace vp
