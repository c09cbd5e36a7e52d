#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <pl/common/geometry.h>
#include <pl/common/rtl_pins.h>
#include <vp/clock.h>

namespace pl {

/// Numbers that are the same on each machine.
class StimulusRandom {
 public:
  explicit StimulusRandom(std::uint64_t seed) : state_(seed) {}
  std::uint32_t next() {
    state_ = state_ * 6'364'136'223'846'793'005u + 1'442'695'040'888'963'407u;
    return static_cast<std::uint32_t>(state_ >> 32);
  }
  /// 0 to `limit` - 1.
  std::uint32_t below(std::uint32_t limit) {
    return static_cast<std::uint32_t>(std::uint64_t{next()} * limit >> 32);
  }
  bool one_in(std::uint32_t n) { return below(n) == 0; }
  /// At most `most`, at least 1, each order of magnitude as often as the others.
  std::uint32_t magnitude(std::uint32_t most) {
    std::uint32_t limit = 4;
    while (limit < most && below(3) != 0) limit *= 4;
    return 1 + below(std::min(limit, most));
  }

 private:
  std::uint64_t state_;
};

/// What drives some of the inputs of an IP that a bench has alone. It is called on each edge of the
/// clock of these inputs.
class Stimulus {
 public:
  virtual ~Stimulus() = default;
  virtual void edge() = 0;
};

/// The stimuli of the inputs of one clock.
class PinDriver final : public vp::Clocked {
 public:
  PinDriver(sc_core::sc_module_name name, vp::Clock& clk) : Clocked(name, clk) {}
  void add(std::unique_ptr<Stimulus> stimulus) { stimuli_.push_back(std::move(stimulus)); }

 private:
  void edge() override {
    for (const auto& stimulus : stimuli_) stimulus->edge();
  }

  std::vector<std::unique_ptr<Stimulus>> stimuli_;
};

/// An input of the IP.
class Pin {
 public:
  /// Throws std::logic_error if the IP has no such input that is a port.
  Pin(const IpPorts& ports, const std::string& name);
  void set(std::uint64_t value) const { input_->write(value); }
  std::uint64_t get() const { return input_->read(); }
  unsigned bits() const { return input_->bits; }

 private:
  const IpPorts::Input* input_;
};

/// What all stimuli of a bench share: what they do now, which lasts for some thousand clocks.
struct StimulusMood {
  StimulusRandom random{20'240'607};
  /// Clocks between two resets, about; 0: none come.
  std::uint32_t reset_every = 0;
  std::uint32_t longest_frame = 1, longest_gap = 1;  ///< in clocks
  bool whole_frames = false;  ///< all are as long as they can be, unless a reset cuts them
  bool sweeps = false;        ///< frames are short, and each gap is a clock longer than the last
  /// Most of the clocks between two of a stream's, an event's or a level's changes.
  std::uint32_t longest_wait = 1;
};

/// Changes the mood. It comes first among the stimuli.
class MoodSwings final : public Stimulus {
 public:
  MoodSwings(StimulusMood& mood, std::uint32_t frame_clocks)
      : mood_(mood), frame_clocks_(frame_clocks) {}

 private:
  void edge() override;

  StimulusMood& mood_;
  const std::uint32_t frame_clocks_;
  std::uint32_t left_ = 1;
};

/// Resets of a clock, of a few, and long ones, at any moment; the first one at once. `system`: the
/// input of a system reset, which comes with some of them; its name may be empty.
class Resets final : public Stimulus {
 public:
  Resets(StimulusMood& mood, const IpPorts& ports, const std::string& reset,
         const std::string& system, std::uint32_t shortest);

 private:
  void edge() override;

  StimulusMood& mood_;
  std::vector<Pin> resets_;  ///< that of the system second, if there is one
  const std::uint32_t shortest_;
  bool is_first_ = true;
  std::uint32_t left_;
};

/// Frames pixel by pixel, whole, or cut at any moment; the next one comes soon, or later. They end
/// with a reset.
class Raster final : public Stimulus {
 public:
  struct Rules {
    std::string valid, x, y;               ///< inputs; x and y may be empty
    bool only_whole = false;               ///< only a reset cuts a frame
    std::uint32_t gap = 1;                 ///< clocks that lie between two frames at least
    std::function<bool()> may_begin = {};  ///< besides; null: at any time
  };
  using Picture = std::vector<std::uint8_t>;

  /// `pictures`: of the size that `geometry` says; they live longer than this.
  Raster(StimulusMood& mood, const IpPorts& ports, const Geometry& geometry, Rules rules,
         const std::vector<Picture>& pictures);

 private:
  void edge() override;
  void begin();
  void show();
  void end();

  StimulusMood& mood_;
  const Geometry geometry_;
  const Rules rules_;
  const std::vector<Picture>& pictures_;
  const Pin reset_, valid_;
  std::vector<Pin> place_;   ///< x and y
  std::vector<Pin> pixels_;  ///< that come on a clock
  bool running_ = false;
  std::uint32_t clock_ = 0, length_ = 0;  ///< of the frame that runs
  std::uint32_t gap_ = 4;                 ///< clocks until the next one
  std::uint32_t swept_ = 0;               ///< the last gap of a sweep
  const Picture* picture_ = nullptr;
  std::uint32_t from_ = 0;  ///< pixel of the picture that comes first
  std::uint8_t dark_ = 0;   ///< where pixels have a bit: the brightest dark level
};

/// A level that lasts for a while, or a word that changes now and then.
class Levels final : public Stimulus {
 public:
  /// `shortest`: clocks. `rises`: called when the level does; null: nothing is.
  Levels(StimulusMood& mood, const IpPorts& ports, const std::string& name,
         std::uint32_t shortest = 1, std::function<void()> rises = {});

 private:
  void edge() override;

  StimulusMood& mood_;
  const Pin pin_;
  const std::uint32_t shortest_;
  const std::function<void()> rises_;
  std::uint32_t left_ = 1;
};

/// A pulse of a clock, and the words beside it.
class Pulses final : public Stimulus {
 public:
  Pulses(StimulusMood& mood, const IpPorts& ports, const std::string& pulse,
         const std::vector<std::string>& words);

 private:
  void edge() override;

  StimulusMood& mood_;
  const Pin reset_, pulse_;
  std::vector<Pin> words_;
  std::uint32_t left_ = 1;
};

/// A toggle beside words, as the clock crossing drives them: the next one when the last was seen.
class Toggles final : public Stimulus {
 public:
  Toggles(StimulusMood& mood, const IpPorts& ports, const std::string& toggle,
          const std::string& seen, const std::vector<std::string>& words);

 private:
  void edge() override;

  StimulusMood& mood_;
  const Pin reset_, toggle_;
  const std::function<vp::SignalBase*()> seen_;
  std::vector<Pin> words_;
  std::uint32_t left_ = 1;
};

/// The ready of a stream's slave: there, away, or at random, until FIFOs are full, nearly full and
/// empty.
class Readiness final : public Stimulus {
 public:
  Readiness(StimulusMood& mood, const IpPorts& ports, const std::string& ready)
      : mood_(mood), ready_(ports, ready) {}

 private:
  void edge() override;

  StimulusMood& mood_;
  const Pin ready_;
  std::uint32_t share_ = 256;  ///< of clocks, in 256
  std::uint32_t left_ = 1;
};

/// Packets of all lengths from a stream's master. `resets`: a reset withdraws what waits.
class Packets final : public Stimulus {
 public:
  Packets(StimulusMood& mood, const IpPorts& ports, const std::string& stream, bool resets);

 private:
  void edge() override;

  StimulusMood& mood_;
  const Pin reset_, valid_, data_;
  std::vector<Pin> last_;
  const std::function<vp::SignalBase*()> ready_;
  const bool resets_;
  std::uint32_t left_ = 1;   ///< words of the packet
  std::uint32_t waits_ = 0;  ///< clocks until the next word
  std::uint32_t gap_ = 0;    ///< most clocks between two words of the packet
};

/// Values that are written down, a row an edge; then the last ones stay.
class Recorded final : public Stimulus {
 public:
  using Row = std::vector<std::uint64_t>;  ///< a value for each pin
  using Set = std::function<void(std::uint64_t)>;

  /// `rows` lives longer than this.
  Recorded(std::vector<Set> pins, const std::vector<Row>& rows)
      : pins_(std::move(pins)), rows_(rows) {}

 private:
  void edge() override {
    if (at_ == rows_.size()) return;
    for (std::size_t i = 0; i < pins_.size(); ++i) pins_[i](rows_[at_][i]);
    ++at_;
  }

  const std::vector<Set> pins_;
  const std::vector<Row>& rows_;
  std::size_t at_ = 0;
};

/// What the labelling says of a frame: blobs, its end, pixels without a label; and the camera.
class BlobFrames final : public Stimulus {
 public:
  BlobFrames(StimulusMood& mood, const IpPorts& ports);

 private:
  void edge() override;
  void reset();
  void move_frame();
  void move_blobs();

  StimulusMood& mood_;
  const Pin reset_, frame_, number_, threshold_, idle_, blob_, overflow_;
  std::vector<Pin> extremes_;
  std::uint32_t frame_left_ = 0, gap_ = 4;
  std::uint32_t flush_left_ = 0;  ///< clocks behind the frame until all blobs have left
  std::uint32_t blob_in_ = 8, spacing_ = 8;
};

}  // namespace pl
