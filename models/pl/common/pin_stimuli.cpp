#include <pl/common/pin_stimuli.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include <pl/common/lanes.h>

namespace pl {

namespace {

std::vector<Pin> pins(const IpPorts& ports, const std::vector<std::string>& names) {
  std::vector<Pin> result;
  for (const std::string& name : names) {
    if (!name.empty()) result.emplace_back(ports, name);
  }
  return result;
}

std::function<vp::SignalBase*()> output(const IpPorts& ports, const std::string& name) {
  for (const IpPorts::Output& output : ports.outputs) {
    if (output.name == name) return output.port;
  }
  throw std::logic_error("there is no output " + name);
}

bool has_input(const IpPorts& ports, const std::string& name) {
  return std::any_of(ports.inputs.begin(), ports.inputs.end(),
                     [&](const IpPorts::Input& input) { return input.name == name; });
}

/// `pixel` and its neighbours.
std::vector<Pin> lanes(const IpPorts& ports, std::uint32_t pixels) {
  std::vector<std::string> names{"pixel"};
  for (std::uint32_t lane = 1; lane < pixels; ++lane) names.push_back(lane_name("pixel", lane));
  return pins(ports, names);
}

}  // namespace

Pin::Pin(const IpPorts& ports, const std::string& name) {
  const auto input = std::find_if(
      ports.inputs.begin(), ports.inputs.end(),
      [&](const IpPorts::Input& input) { return input.name == name && input.write != nullptr; });
  if (input == ports.inputs.end()) throw std::logic_error("there is no input " + name);
  input_ = &*input;
}

namespace {

/// Clocks between two ends of frames: what the logic does behind a frame takes less.
constexpr std::uint32_t longest_sweep = 360, swept_frame = 12;

}  // namespace

void MoodSwings::edge() {
  if (--left_ > 0) return;
  StimulusRandom& random = mood_.random;
  mood_.longest_gap = std::array{3u, 40u, 350u, 1'500u}[random.below(4)];
  mood_.longest_wait = std::array{1u, 3u, 12u, 40u, 400u}[random.below(5)];
  const std::uint32_t kind = random.below(24);
  // Whole frames now and then, and resets deep in them.
  mood_.whole_frames = kind == 0;
  if (mood_.whole_frames) {
    left_ = 20'000 + random.below(frame_clocks_ / 2 + 1);
    mood_.longest_frame = frame_clocks_;
    mood_.reset_every = std::array{0u, 9'000u, 9'000u}[random.below(3)];
    return;
  }
  mood_.sweeps = kind == 1;
  if (mood_.sweeps) {
    left_ = longest_sweep * (longest_sweep / 2 + swept_frame);
    mood_.longest_frame = swept_frame;
    mood_.reset_every = 0;
    return;
  }
  left_ = 500 + random.below(6'000);
  mood_.reset_every = std::array{0u, 0u, 30u, 200u, 1'500u}[random.below(5)];
  mood_.longest_frame = std::array{6u, 80u, 1'000u, 9'000u}[random.below(4)];
}

Resets::Resets(StimulusMood& mood, const IpPorts& ports, const std::string& reset,
               const std::string& system, std::uint32_t shortest)
    : mood_(mood), resets_(pins(ports, {reset, system})), shortest_(shortest) {
  left_ = std::max(8u, shortest);
}

void Resets::edge() {
  StimulusRandom& random = mood_.random;
  if (is_first_) {
    is_first_ = false;
    for (const Pin& pin : resets_) pin.set(1);
  } else if (left_ > 0) {
    if (--left_ > 0) return;
    for (const Pin& pin : resets_) pin.set(0);
  } else if (mood_.reset_every != 0 && random.one_in(mood_.reset_every)) {
    left_ = shortest_ + (random.one_in(2) ? 0 : random.below(random.one_in(3) ? 60 : 5));
    resets_.front().set(1);
    if (resets_.size() > 1) resets_.back().set(random.one_in(3));
  }
}

Raster::Raster(StimulusMood& mood, const IpPorts& ports, const Geometry& geometry, Rules rules,
               const std::vector<Picture>& pictures)
    : mood_(mood),
      geometry_(geometry),
      rules_(std::move(rules)),
      pictures_(pictures),
      reset_(ports, "rst"),
      valid_(ports, rules_.valid),
      place_(pins(ports, {rules_.x, rules_.y})),
      pixels_(lanes(ports, geometry.pixels_per_clock)) {}

void Raster::edge() {
  if (reset_.get() != 0) {
    if (running_) end();
    gap_ = std::min(gap_, mood_.random.magnitude(40));
    if (rules_.only_whole) gap_ = std::max(gap_, 2u);
  } else if (running_) {
    clock_ < length_ ? show() : end();
  } else if (gap_ > 0) {
    --gap_;
  } else if (!rules_.may_begin || rules_.may_begin()) {
    begin();
  }
}

void Raster::begin() {
  StimulusRandom& random = mood_.random;
  running_ = true;
  clock_ = 0;
  length_ = rules_.only_whole || mood_.whole_frames
                ? geometry_.clocks()
                : random.magnitude(std::min(mood_.longest_frame, geometry_.clocks()));
  if (mood_.sweeps && !rules_.only_whole) length_ = std::min(swept_frame, geometry_.clocks());
  picture_ = &pictures_[random.below(static_cast<std::uint32_t>(pictures_.size()))];
  from_ = random.below(geometry_.height) * geometry_.width;
  dark_ = static_cast<std::uint8_t>(20 + random.below(210));
  valid_.set(1);
  show();
}

void Raster::show() {
  const std::uint32_t first = clock_++ * geometry_.pixels_per_clock;
  for (std::uint32_t lane = 0; lane < pixels_.size(); ++lane) {
    const std::uint8_t level = (*picture_)[(from_ + first + lane) % geometry_.pixels()];
    const Pin& pin = pixels_[lane];
    pin.set(pin.bits() == 1 ? level <= dark_ : level);
  }
  if (place_.empty()) return;
  place_[0].set(first % geometry_.width);
  place_[1].set(first / geometry_.width);
}

void Raster::end() {
  running_ = false;
  valid_.set(0);
  swept_ = mood_.sweeps ? (swept_ + 1) % longest_sweep : 0;
  gap_ = rules_.gap - 1 + (mood_.sweeps ? swept_ : mood_.random.below(mood_.longest_gap));
}

Levels::Levels(StimulusMood& mood, const IpPorts& ports, const std::string& name,
               std::uint32_t shortest, std::function<void()> rises)
    : mood_(mood), pin_(ports, name), shortest_(shortest), rises_(std::move(rises)) {}

void Levels::edge() {
  if (--left_ > 0) return;
  StimulusRandom& random = mood_.random;
  left_ = shortest_ - 1 + random.magnitude(4 * mood_.longest_wait);
  const std::uint32_t mask = pin_.bits() >= 32 ? ~0u : (1u << pin_.bits()) - 1;
  const bool toggles = pin_.bits() == 1;
  pin_.set(toggles ? pin_.get() ^ 1 : random.next() & mask);
  if (toggles && pin_.get() != 0 && rises_) rises_();
}

Pulses::Pulses(StimulusMood& mood, const IpPorts& ports, const std::string& pulse,
               const std::vector<std::string>& words)
    : mood_(mood), reset_(ports, "rst"), pulse_(ports, pulse), words_(pins(ports, words)) {}

void Pulses::edge() {
  const bool comes = reset_.get() == 0 && --left_ == 0;
  if (left_ == 0) left_ = mood_.random.magnitude(mood_.longest_wait);
  pulse_.set(comes);
  if (!comes) return;
  for (const Pin& word : words_) word.set(mood_.random.next());
}

Toggles::Toggles(StimulusMood& mood, const IpPorts& ports, const std::string& toggle,
                 const std::string& seen, const std::vector<std::string>& words)
    : mood_(mood),
      reset_(ports, "rst"),
      toggle_(ports, toggle),
      seen_(output(ports, seen)),
      words_(pins(ports, words)) {}

void Toggles::edge() {
  if (reset_.get() != 0) return toggle_.set(0);
  if (seen_()->bits() != toggle_.get() || --left_ > 0) return;
  left_ = mood_.random.magnitude(mood_.longest_wait);
  toggle_.set(toggle_.get() ^ 1);
  for (const Pin& word : words_) word.set(mood_.random.next());
}

void Readiness::edge() {
  StimulusRandom& random = mood_.random;
  if (mood_.whole_frames && mood_.reset_every == 0) return ready_.set(1);  // the longest packets
  if (--left_ == 0) {
    share_ = std::array{0u, 0u, 8u, 32u, 128u, 224u, 256u, 256u}[random.below(8)];
    left_ = random.magnitude(4'000);
  }
  ready_.set(random.below(256) < share_);
}

Packets::Packets(StimulusMood& mood, const IpPorts& ports, const std::string& stream, bool resets)
    : mood_(mood),
      reset_(ports, "rst"),
      valid_(ports, stream + "_tvalid"),
      data_(ports, stream + "_tdata"),
      ready_(output(ports, stream + "_tready")),
      resets_(resets) {
  if (has_input(ports, stream + "_tlast")) last_.emplace_back(ports, stream + "_tlast");
}

void Packets::edge() {
  StimulusRandom& random = mood_.random;
  if (resets_ && reset_.get() != 0) {
    valid_.set(0);
    for (const Pin& last : last_) last.set(0);
    left_ = 1;
    waits_ = 8;
    return;
  }
  if (valid_.get() != 0) {
    if (ready_()->bits() == 0) return;
    valid_.set(0);
    if (--left_ == 0) {
      left_ = random.magnitude(200);
      gap_ = mood_.longest_wait - 1;
      waits_ = random.below(mood_.longest_gap);
    } else {
      waits_ = random.below(gap_ + 1);
    }
  }
  if (waits_ > 0) {
    --waits_;
    for (const Pin& last : last_) last.set(0);
    return;
  }
  valid_.set(1);
  data_.set(random.next());
  for (const Pin& last : last_) last.set(left_ == 1);
}

namespace {

/// Clocks in which more blobs come than a packet may have, 8191.
constexpr std::uint32_t longest_packet = 8 * 8'250;

}  // namespace

BlobFrames::BlobFrames(StimulusMood& mood, const IpPorts& ports)
    : mood_(mood),
      reset_(ports, "rst"),
      frame_(ports, "frame_ena"),
      number_(ports, "frame_number"),
      threshold_(ports, "threshold"),
      idle_(ports, "idle"),
      blob_(ports, "blob_out"),
      overflow_(ports, "label_overflow") {
  for (int i = 0; i < 8; ++i) extremes_.emplace_back(ports, "extreme_" + std::to_string(i));
}

void BlobFrames::edge() {
  if (reset_.get() != 0) return reset();
  move_frame();
  move_blobs();
  idle_.set(frame_.get() == 0 && flush_left_ == 0);
}

void BlobFrames::reset() {
  for (const Pin* pin : {&frame_, &blob_, &overflow_}) pin->set(0);
  idle_.set(1);
  frame_left_ = flush_left_ = 0;
  gap_ = mood_.random.magnitude(40);
}

// The next frame may begin while blobs of this one leave.
void BlobFrames::move_frame() {
  StimulusRandom& random = mood_.random;
  if (flush_left_ > 0) --flush_left_;
  if (frame_left_ > 0) {
    if (--frame_left_ > 0) return;
    frame_.set(0);
    flush_left_ = random.magnitude(400) - 1;
    gap_ = random.below(mood_.longest_gap);
    if (random.below(2) == 0) threshold_.set(random.below(256));
  } else if (gap_ > 0) {
    --gap_;
  } else {
    const bool is_long = mood_.whole_frames && mood_.reset_every == 0;
    frame_left_ =
        is_long ? longest_packet : random.magnitude(std::min(mood_.longest_frame, 9'000u));
    frame_.set(1);
    number_.set(number_.get() + 1 + random.below(2));
    spacing_ = is_long ? 8 : 7 + random.magnitude(mood_.longest_wait);
    blob_in_ = random.magnitude(40);
  }
}

void BlobFrames::move_blobs() {
  StimulusRandom& random = mood_.random;
  const bool may = frame_.get() != 0 || flush_left_ > 0;
  const bool comes = may && blob_in_ > 0 && --blob_in_ == 0;
  blob_.set(comes);
  if (may && random.one_in(60)) overflow_.set(overflow_.get() + random.magnitude(20));
  if (!comes) return;
  for (const Pin& extreme : extremes_) extreme.set(random.next());
  // Few come while another one is sent, and none right behind it.
  if (mood_.whole_frames) {
    blob_in_ = spacing_;
  } else {
    blob_in_ =
        random.one_in(20) ? 1 + random.magnitude(8) : spacing_ + random.below(2) * random.below(9);
  }
}

}  // namespace pl
