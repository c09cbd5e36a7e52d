#include "driver.h"

#include <apps/hybrid/pl_link.h>
#include <marker/blob_grouping.h>
#include <marker/blob_packet.h>
#include <marker/fast.h>
#include <marker/marker_search.h>
#include <marker/posit.h>
#include <marker/threshold.h>

#include <vector>

namespace calibration {
namespace {

constexpr std::uint32_t corner_threshold = 30;

// As large as on the chip, and static as there.
marker::CornerDetector corner_detector;
marker::BlobGrouping blob_grouping;
marker::FeatureSet features;
marker::CandidateList candidates;
marker::WordStore words;
hybrid::PlLink link;
std::vector<std::uint32_t> binary;

Checksum of_features() {
  Checksum sum;
  for (std::uint32_t i = 0; i < features.corner_count; ++i) {
    const marker::Corner& c = features.corners[i];
    sum.add(marker::packet::encode(c));
  }
  for (std::uint32_t i = 0; i < features.blob_count; ++i) {
    sum.add(marker::packet::encode_start(features.blobs[i]));
    sum.add(marker::packet::encode_end(features.blobs[i]));
  }
  return sum;
}

void find_binary(const marker::GreyImage& image) {
  binary.assign(std::size_t{image.width} * image.height / marker::pixels_per_word, 0);
  marker::AdaptiveThreshold threshold;
  threshold.binarise(image, binary.data());
}

marker::Corner random_corner(Random& random) {
  return {static_cast<std::uint16_t>(random.below(640)),
          static_cast<std::uint16_t>(random.below(480)),
          static_cast<std::uint16_t>(random.below(1024)),
          static_cast<marker::Direction>(random.below(4)), 0};
}

marker::BoundingBox random_box(Random& random, std::uint32_t number) {
  const std::uint32_t width = 24 + random.below(200), height = 24 + random.below(200);
  const std::uint32_t x = random.below(640 - width), y = random.below(480 - height);
  return {static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y),
          static_cast<std::uint16_t>(x + width), static_cast<std::uint16_t>(y + height),
          static_cast<std::uint16_t>(number)};
}

/// Features as of a picture: boxes, most with their four corners, and corners anywhere.
void random_features(Random& random) {
  features.clear();
  const std::uint32_t boxes = 1 + random.below(20);
  for (std::uint32_t i = 0; i < boxes; ++i) features.push(random_box(random, i));
  using marker::Direction;
  for (std::uint32_t i = 0; i < boxes; ++i) {
    const marker::BoundingBox box = features.blobs[i];
    if (random.below(4) == 0) continue;
    const std::uint16_t strength = static_cast<std::uint16_t>(100 + random.below(800));
    features.push(marker::Corner{box.sx, box.sy, strength, Direction::north, 0});
    features.push(marker::Corner{box.ex, box.sy, strength, Direction::east, 0});
    features.push(marker::Corner{box.sx, box.ey, strength, Direction::west, 0});
    features.push(marker::Corner{box.ex, box.ey, strength, Direction::south, 0});
  }
  const std::uint32_t others = random.below(60);
  for (std::uint32_t i = 0; i < others; ++i) features.push(random_corner(random));
}

}  // namespace

void measure_features(Random& random, std::uint32_t width, std::uint32_t height) {
  const Scene scene(random, width, height);
  const marker::GreyImage image = scene.image();
  flush_caches();  // the camera wrote the image behind their back
  features.clear();
  measure(
      "corner_detection", [&] { corner_detector.detect(image, corner_threshold, features); },
      of_features);
  binary.assign(std::size_t{width} * height / marker::pixels_per_word, 0);
  marker::AdaptiveThreshold threshold;
  measure(
      "threshold", [&] { threshold.binarise(image, binary.data()); },
      [&] {
        Checksum sum;
        sum.add(binary.data(), binary.size() * sizeof binary[0]);
        sum.add(threshold.value());
        return sum;
      });
  const marker::BinaryImage dark{binary.data(), width, height, false};
  measure(
      "blob_detection", [&] { blob_grouping.detect(dark, {}, features); }, of_features);
}

void measure_decode(Random& random) {
  random_features(random);
  std::vector<std::uint32_t> list;
  const std::uint32_t corners = random.below(features.corner_count + 1);
  for (std::uint32_t i = 0; i < corners; ++i) {
    list.push_back(marker::packet::encode(features.corners[i]));
  }
  for (std::uint32_t i = 0; i < features.blob_count; ++i) {
    list.push_back(marker::packet::encode_start(features.blobs[i]));
    list.push_back(marker::packet::encode_end(features.blobs[i]));
  }
  list.push_back(marker_logic::WordFormat::end_of_frame);
  const auto count = static_cast<std::uint32_t>(list.size());
  measure(
      "decode", [&] { marker::decode(list.data(), count, marker::packet::usual_format, features); },
      of_features);
}

void measure_packet_sum(Random& random) {
  std::vector<std::uint32_t> packet(3 + 8 * random.below(60));
  for (std::uint32_t& word : packet) word = random.below(1u << 31);
  flush_caches();  // the logic wrote it behind their back
  std::uint32_t value = 0;
  measure(
      "packet_sum",
      [&] { value = marker::packet_sum(packet.data(), static_cast<std::uint32_t>(packet.size())); },
      [&] {
        Checksum sum;
        sum.add(value);
        return sum;
      });
}

void measure_evaluation(Random& random) {
  random_features(random);
  measure(
      "evaluation", [&] { marker::evaluate_features(features, {}, candidates); },
      [&] {
        Checksum sum;
        for (std::uint32_t i = 0; i < candidates.count; ++i) {
          for (const std::uint16_t corner : candidates.candidates[i].corners) sum.add(corner);
        }
        return sum;
      });
}

void measure_identification(Random& random, std::uint32_t width, std::uint32_t height, bool cold) {
  const Scene scene(random, width, height);
  const marker::GreyImage image = scene.image();
  find_binary(image);
  const marker::BinaryImage dark{binary.data(), image.width, image.height, cold};
  constexpr std::uint32_t widths[] = {24, 36, 48, 60};
  const std::uint32_t canonical_width = widths[random.below(4)];
  std::vector<marker::Quad> quads = scene.squares();
  if (random.below(3) == 0) {
    for (marker::Quad& quad : quads) {
      for (marker::Point& point : quad) point.x += random.between(-6, 6);
    }
  }
  std::vector<marker::Identification> found(quads.size());
  if (cold) flush_caches();
  measure(
      cold ? "identification_cold" : "identification",
      [&] {
        for (std::size_t i = 0; i < quads.size(); ++i) {
          found[i] = marker::identify_candidate(dark, quads[i], canonical_width);
        }
      },
      [&] {
        Checksum sum;
        for (const marker::Identification& identity : found) {
          sum.add(identity.id);
          sum.add(identity.code);
          sum.add(identity.rotation);
        }
        return sum;
      });
}

void measure_pose(Random& random) {
  const marker::Camera camera{381.36, 381.36, 320, 240};
  marker::PositOptions options;
  options.stop = 0.25 * (1 + random.below(12));
  // A square seen from the side: any quadrilateral will do.
  const double x = random.between(50, 500), y = random.between(50, 350),
               side = 30 + 80 * random.unit();
  const auto corner = [&](double u, double v) {
    return marker::Point{x + side * u + 6 * random.unit(), y + side * v + 6 * random.unit()};
  };
  const marker::Quad corners = {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
  marker::Pose pose{};
  measure(
      "pose", [&] { pose = marker::estimate_pose(corners, camera, options); },
      [&] {
        Checksum sum;
        sum.add(pose.rotation);
        sum.add(pose.translation);
        sum.add(pose.iterations);
        return sum;
      });
}

void measure_hardware(Random& random) {
  std::vector<std::uint32_t> list;
  const std::uint32_t count = 1 + random.below(100);
  for (std::uint32_t i = 0; i < count; ++i)
    list.push_back(marker::packet::encode(random_corner(random)));
  list.push_back(marker_logic::WordFormat::end_of_frame);
  link.initialise(marker_logic::usual_burst_words * marker_logic::bytes_per_word);
  Devices::show(list);
  measure(
      "receive", [&] { link.receive_features(words, 1000); },
      [&] {
        Checksum sum;
        sum.add(words.words.data(), words.stored() * sizeof words.words[0]);
        return sum;
      });
  const std::uint32_t interrupts = 10 + random.below(100);
  link.prepare_frame(0x1000'0000, 128 * 300);
  measure(
      "interrupt", [&] { Devices::interrupt(interrupts); },
      [&] {
        Checksum sum;
        sum.add(link.binary_packets());
        return sum;
      });
}

}  // namespace calibration
