// The detector of the design `improved`.
#include "driver.h"

#include <marker/board_pose.h>
#include <marker/marker_detector.h>
#include <marker/pose_filter.h>

#include <blob_stream.h>

#include <cmath>
#include <memory>
#include <vector>

namespace calibration {
namespace {

const marker::Camera camera{381.36, 381.36, 100, 70};

marker::MarkerDetector detector;
marker::Detections detections;

/// Static as on the chip.
marker::CodeBook& book_of(Random& random) {
  static std::vector<std::unique_ptr<marker::CodeBook>> books;
  if (books.empty()) {
    for (const char* name : {"4x4_250", "5x5_1000", "6x6_250", "7x7_100", "apriltag_36h11"}) {
      books.push_back(std::make_unique<marker::CodeBook>());
      books.back()->open(*marker::find_dictionary(name));
    }
  }
  return *books[random.below(static_cast<std::uint32_t>(books.size()))];
}

/// Blobs that are refused for their size.
std::vector<std::uint32_t> small_blobs(Random& random, std::uint32_t width, std::uint32_t height) {
  std::vector<std::uint32_t> words;
  const std::uint32_t count = 1 + random.below(30);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t x = random.below(width - 8), y = random.below(height - 8);
    const std::uint32_t near = blob_stream::point(x, y), far = blob_stream::point(x + 5, y + 5);
    words.insert(words.end(), {near, near, far, far, far, near, near, near});
  }
  return words;
}

/// The extremes of a square at any angle.
marker::Extremes random_extremes(Random& random) {
  const auto x = static_cast<std::int32_t>(random.between(50, 100));
  const auto y = static_cast<std::int32_t>(random.between(50, 100));
  const auto side = static_cast<std::int32_t>(random.between(8, 20));
  const auto lean = static_cast<std::int32_t>(side * random.unit());
  return {{{x + lean, y},
           {x + lean + side, y},
           {x + lean + side, y + lean},
           {x + side, y + lean + side},
           {x + side, y + lean + side},
           {x, y + side + lean},
           {x, y + side},
           {x, y + side - lean}}};
}

void measure_blob_check(Random& random, const marker::GreyImage& image) {
  const std::vector<std::uint32_t> words = small_blobs(random, image.width, image.height);
  const marker::BlobList blobs{
      words.data(), static_cast<std::uint32_t>(words.size() / blob_stream::words_per_blob)};
  std::vector<marker::Extremes> extremes(1 + random.below(20));
  for (marker::Extremes& e : extremes) e = random_extremes(random);
  std::vector<marker::Quad> quads(extremes.size());
  detector.open(*marker::find_dictionary("4x4_250"), {});
  measure(
      "blob_check",
      [&] {
        detector.find_markers({image, {camera}}, blobs, detections);
        for (std::size_t i = 0; i < extremes.size(); ++i) {
          marker::largest_quad(extremes[i], quads[i]);
        }
      },
      [&] {
        Checksum sum;
        sum.add(detections.blobs);
        for (const marker::Quad& quad : quads) sum.add(quad);
        return sum;
      });
}

/// As a blob's extremes would have it.
marker::Quad guess_of(Random& random, const marker::Quad& square) {
  // Squares are listed as top left, top right, bottom left, bottom right.
  marker::Quad guess{square[0], square[1], square[3], square[2]};
  for (marker::Point& p : guess) {
    p.x += random.unit() - 0.5;
    p.y += random.unit() - 0.5;
  }
  return guess;
}

}  // namespace

void measure_detector(Random& random, std::uint32_t width, std::uint32_t height, bool cold) {
  // Few quadrilaterals differ more than they cost: two pictures make a measurement.
  const Scene scenes[] = {{random, width, height}, {random, width, height}};
  if (!cold) measure_blob_check(random, scenes[0].image());
  marker::Lens lens{camera};
  if (random.below(2) == 0) {
    lens.k1 = 0.1 * (random.unit() - 0.5);
    lens.p1 = 0.01 * (random.unit() - 0.5);
  }
  struct Candidate {
    marker::GreyImage image;
    marker::Quad guess;
    marker::QuadFit fit;
    marker::CodeBook::Match match;
  };
  std::vector<Candidate> candidates;
  for (const Scene& scene : scenes) {
    for (const marker::Quad& square : scene.squares()) {
      candidates.push_back({scene.image(), guess_of(random, square), {}, {}});
    }
  }
  if (cold) flush_caches();
  measure(
      cold ? "quad_fit_cold" : "quad_fit",
      [&] {
        for (Candidate& c : candidates) c.fit = marker::fit_quad({c.image, lens}, c.guess, once());
      },
      [&] {
        Checksum sum;
        for (const Candidate& c : candidates) {
          sum.add(c.fit.refusal);
          sum.add(c.fit.ideal);
        }
        return sum;
      });
  const marker::CodeBook& book = book_of(random);
  // What was refused is read as the guess has it, so that every picture has codes.
  for (Candidate& c : candidates) {
    if (c.fit.refusal == marker::Refusal::none) continue;
    c.fit.ideal = c.guess;
    c.fit.dark = 20;
    c.fit.bright = 229;
  }
  measure(
      cold ? "code_reading_cold" : "code_reading",
      [&] {
        for (Candidate& c : candidates) {
          const marker::CellLook look =
              marker::look_at_cells({c.image, {camera}}, c.fit.ideal, book.dictionary().cells);
          const marker::CellReading reading = marker::read_cells(look, c.fit.dark, c.fit.bright);
          c.match = book.look_up(reading.word);
        }
      },
      [&] {
        Checksum sum;
        for (const Candidate& c : candidates) {
          sum.add(c.match.id);
          sum.add(c.match.rotation);
        }
        return sum;
      });
}

void measure_board_pose(Random& random) {
  std::vector<marker::SeenMarker> seen(1 + random.below(8));
  std::vector<std::array<double, 64>> covariances(seen.size());
  const marker::GridBoard board{4, 4, 0.1, 0.03, 0};
  // A board seen aslant: its plane leans, without trigonometry.
  const double lean = random.unit() - 0.5, turn = random.unit() - 0.5, far = 1 + random.unit();
  const double a = 1 / std::sqrt(1 + lean * lean), b = 1 / std::sqrt(1 + turn * turn);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    board.find(static_cast<std::uint32_t>(i), seen[i].places);
    for (unsigned k = 0; k < 4; ++k) {
      const marker::Place& p = seen[i].places[k];
      const double u = (p[0] - turn * p[1]) * b, v = (p[1] + turn * p[0]) * b;
      const double x = u * a, z = far + u * a * lean;
      seen[i].corners[k] = {camera.fx * x / z + camera.cx + 0.05 * random.unit(),
                            camera.fy * v / z + camera.cy + 0.05 * random.unit()};
    }
    covariances[i] = marker::independent_corners(0.01 + 0.02 * random.unit());
  }
  marker::BoardPoses poses{};
  measure(
      "board_pose",
      [&] {
        for (std::size_t i = 0; i < seen.size(); ++i)
          seen[i].weights = marker::weights_of(covariances[i]);
        poses = marker::estimate_board_pose(seen.data(), static_cast<std::uint32_t>(seen.size()),
                                            camera);
      },
      [&] {
        Checksum sum;
        sum.add(poses.best.rotation);
        sum.add(poses.best.translation);
        return sum;
      });
}

void measure_pose_filter(Random& random) {
  // A marker that moves steadily, and now and then is somewhere else. Each frame's other pose is
  // the likelier one in some.
  struct Frame {
    double time;
    marker::BoardPoses poses;
  };
  std::vector<Frame> frames(2 + random.below(12));
  const double speed = random.between(-1, 1);
  double x = random.unit();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    x += 0.01 * speed;
    if (random.below(5) == 0) x += 1;
    marker::BoardPose pose{{1, 0, 0, 0, 1, 0, 0, 0, 1}, {x + 0.001 * random.unit(), 0, 2}, {}, 2};
    for (unsigned k = 0; k < 6; ++k) pose.covariance[7 * k] = 1e-6 * (1 + random.unit());
    frames[i] = {0.01 * static_cast<double>(i), {true, pose, pose}};
    if (random.below(3) == 0) frames[i].poses.best.translation[1] += 0.1 * random.unit();
    if (random.below(3) == 0) frames[i].poses.other.chi_squared = 1e6;
  }
  marker::PoseTrack track{};
  measure(
      "pose_filter",
      [&] {
        for (Frame& frame : frames) track.follow(frame.poses, frame.time, {2, 10});
      },
      [&] {
        Checksum sum;
        for (const Frame& frame : frames) {
          sum.add(frame.poses.best.rotation);
          sum.add(frame.poses.best.translation);
          sum.add(frame.poses.best.covariance);
        }
        return sum;
      });
}

}  // namespace calibration
