#include <apps/algorithms/self_test.h>

#include <cstring>

#include <apps/common/message.h>
#include <hal/hal.h>
#include <marker/feature_set.h>
#include <marker/marker_search.h>

namespace algorithms {

namespace {

/// Takes the text apart, word by word and line by line.
class Reader {
 public:
  Reader(const char* begin, const char* end) : at_(begin), end_(end) {}

  bool is_done() const { return at_ == end_; }
  char letter() { return is_done() ? 0 : *at_++; }

  /// A number of the given base after spaces; 0 digits are a mistake.
  std::uint32_t number(unsigned base) {
    while (peek() == ' ') ++at_;
    std::uint32_t value = 0;
    unsigned digits = 0;
    for (unsigned digit; (digit = digit_of(peek())) < base; ++digits, ++at_) {
      value = value * base + digit;
    }
    if (digits == 0) well_formed_ = false;
    return value;
  }

  /// The count of "xN" at the line's end, else 1.
  std::uint32_t repetitions() {
    while (peek() == ' ') ++at_;
    if (peek() != 'x') return 1;
    ++at_;
    return number(10);
  }

  void skip_line() {
    while (!is_done() && *at_ != '\n') ++at_;
    if (!is_done()) ++at_;
  }

  bool is_well_formed() const { return well_formed_; }

 private:
  char peek() const { return is_done() ? '\n' : *at_; }
  static unsigned digit_of(char character) {
    if (character >= '0' && character <= '9') return static_cast<unsigned>(character - '0');
    if (character >= 'a' && character <= 'f') return static_cast<unsigned>(character - 'a' + 10);
    return 16;
  }

  const char* at_;
  const char* end_;
  bool well_formed_ = true;
};

}  // namespace

bool read_golden(const GoldenText& text, marker::WordStore& words, std::uint32_t* binary) {
  Reader reader(text.begin, text.end);
  std::uint32_t count = 0;
  words.clear();
  while (!reader.is_done()) {
    const char kind = reader.letter();
    if (kind == 'C' || kind == 'B' || kind == 'T') reader.number(10);  // the clock
    if (kind == 'C') words.push(reader.number(16));
    if (kind == 'B') {
      words.push(reader.number(16));
      words.push(reader.number(16));
    }
    if (kind == 'T') {
      const std::uint32_t word = reader.number(16);
      for (std::uint32_t left = reader.repetitions(); left > 0; --left) {
        if (count == binary_words) return false;
        binary[count++] = word;
      }
    }
    reader.skip_line();
  }
  words.push(marker_logic::WordFormat::end_of_frame);
  return reader.is_well_formed() && count == binary_words && words.lost() == 0;
}

namespace {

using apps::Message;

/// The camera of the scenes (thesis chapter 5).
constexpr marker::Camera camera{381.36, 381.36, width / 2.0, height / 2.0};
constexpr std::uint32_t canonical_width = 60;
/// Never good enough: all iterations are made, so that rounding has time to show.
constexpr marker::PositOptions all_iterations{0.30, 0.0, 100};

void bits(Message& message, double value) {
  std::uint64_t pattern = 0;
  static_assert(sizeof pattern == sizeof value, "IEEE 754 double");
  std::memcpy(&pattern, &value, sizeof pattern);
  message.text(" ");
  for (int shift = 60; shift >= 0; shift -= 4) {
    const char digit[] = {"0123456789abcdef"[(pattern >> shift) & 0xF], 0};
    message.text(digit);
  }
}

template <class Values>
void print_doubles(const char* name, const Values& values) {
  Message message;
  message.text("  ").text(name);
  unsigned in_line = 0;
  for (const double value : values) {
    if (in_line++ == 4) {  // a line holds 128 characters
      message.write();
      message.text("  ").text(name);
      in_line = 1;
    }
    bits(message, value);
  }
  message.write();
}

void print_quad(const char* name, const marker::Quad& quad) {
  print_doubles(name, std::array<double, 8>{quad[0].x, quad[0].y, quad[1].x, quad[1].y, quad[2].x,
                                            quad[2].y, quad[3].x, quad[3].y});
}

void print_identification(const marker::Identification& identity) {
  Message()
      .text("  identity ")
      .number(identity.found)
      .text(" id ")
      .number(identity.id)
      .text(" rotation ")
      .number(identity.rotation)
      .text(" border ")
      .number(identity.border)
      .text(" code ")
      .hexadecimal(identity.code)
      .write();
}

void print_pose(const marker::Pose& pose) {
  Message().text("  pose ").number(pose.valid).text(" iterations ").number(pose.iterations).write();
  print_doubles("R", pose.rotation);
  print_doubles("T", pose.translation);
  print_doubles("error", std::array<double, 2>{pose.reprojection_px, pose.reprojection_mm});
}

void print_rectification(const marker::Quad& corners, const marker::BinaryImage& image) {
  const marker::Homography h = marker::make_homography(corners, canonical_width);
  print_doubles("homography",
                std::array<double, 8>{h.h1, h.h2, h.u1, h.h4, h.h5, h.v1, h.h7, h.h8});
  if (!h.valid) return;
  marker::CellCounts cells{};
  marker::rectify(image, h, canonical_width, cells);
  for (const auto& row : cells.dark) {
    Message message;
    message.text("  cells");
    for (const std::uint32_t dark : row) message.text(" ").number(dark);
    message.write();
  }
}

marker::BinaryImage image_of(const hal_dma_buffer& binary) {
  return {static_cast<const std::uint32_t*>(binary.data), width, height, true};
}

}  // namespace

bool SelfTest::prepare() {
  constexpr std::size_t bytes = binary_words * sizeof(std::uint32_t);
  if (binary_.data == nullptr) binary_ = hal_dma_allocate(bytes, 128);
  return binary_.data != nullptr;
}

bool SelfTest::run(const GoldenText& text) {
  if (!prepare() || !read_golden(text, words_, static_cast<std::uint32_t*>(binary_.data))) {
    Message().text("algorithms: ").text(text.name).text(": no memory, or no golden frame").write();
    return false;
  }
  hal_cache_flush(binary_.data, binary_.size);
  marker::decode(words_.words.data(), words_.stored(), {width, height}, features_);
  marker::evaluate_features(features_, {}, candidates_);
  Message().text("algorithms: ").text(text.name).write();
  print_features();
  for (std::uint32_t i = 0; i < candidates_.count; ++i) print_candidate(i);
  print_marker();
  return true;
}

void SelfTest::print_features() const {
  Message()
      .text("  words ")
      .number(words_.count)
      .text(" corners ")
      .number(features_.corner_count)
      .text(" blobs ")
      .number(features_.blob_count)
      .text(" malformed ")
      .number(features_.malformed)
      .text(" candidates ")
      .number(candidates_.count)
      .write();
}

void SelfTest::print_candidate(std::uint32_t index) const {
  const marker::Candidate& candidate = candidates_.candidates[index];
  Message message;
  message.text(" candidate ").number(index).text(" blob ").number(candidate.blob).text(" corners");
  for (const std::uint16_t corner : candidate.corners) message.text(" ").number(corner);
  message.write();
  const marker::Quad corners = marker::candidate_corners(features_, candidate);
  const marker::BinaryImage image = image_of(binary_);
  print_rectification(corners, image);
  print_identification(marker::identify_candidate(image, corners, canonical_width));
  const marker::Quad clockwise = marker::marker_corners(corners, index % 4);
  print_quad("corners", clockwise);
  print_pose(marker::estimate_pose(clockwise, camera, all_iterations));
}

/// What the system itself would report.
void SelfTest::print_marker() const {
  const marker::FoundMarker marker =
      marker::find_first_marker(features_, candidates_, image_of(binary_), canonical_width);
  Message()
      .text(" marker ")
      .number(marker.found)
      .text(" candidate ")
      .number(marker.candidate)
      .text(" examined ")
      .number(marker.examined)
      .write();
  if (!marker.found) return;
  print_identification(marker.identity);
  print_quad("corners", marker.corners);
  print_pose(marker::estimate_pose(marker.corners, camera, {}));
}

}  // namespace algorithms
