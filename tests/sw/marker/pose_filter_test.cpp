#include <marker/pose_filter.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <memory>
#include <random>

#include "fake_hal.h"
#include "views.h"

using marker::BoardPose;
using marker::BoardPoses;
using marker::Detections;
using marker::PoseFilter;
using marker::PoseMotion;
using marker::PoseTrack;
using views::angle_between;
using views::rotation_of;
using views::translation_of;
using views::turn;

namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

constexpr double frame_time = 3.1e-3;  // s, of `improved`
constexpr marker::PoseFilterOptions usual{2, 10};

/// A pose known as well as that of a marker 2 m away.
struct View {
  double turn = 1e-3, shift = 0.5e-3;  ///< deviations, rad and m

  BoardPose of(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation) const {
    BoardPose pose{{}, {}, {}, 2};
    Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(pose.rotation.data()) = rotation;
    Eigen::Vector3d::Map(pose.translation.data()) = translation;
    for (unsigned i = 0; i < 6; ++i) {
      const double deviation = i < 3 ? turn : shift;
      pose.covariance[7 * i] = deviation * deviation;
    }
    return pose;
  }
};

BoardPoses only(const BoardPose& pose) {
  BoardPoses poses{true, pose, pose};
  poses.other.chi_squared = 1e6;
  return poses;
}

/// A small turn about the camera's axes and a shift, from one pose to the other.
Vector6d between(const BoardPose& from, const BoardPose& to) {
  const Eigen::AngleAxisd angle(rotation_of(to) * rotation_of(from).transpose());
  Vector6d result;
  result << angle.angle() * angle.axis(), translation_of(to) - translation_of(from);
  return result;
}

/// A marker that turns and moves steadily, and what a camera makes of it.
struct Moving {
  std::mt19937 random{7};
  View view;
  Eigen::Vector3d start{0.1, -0.2, 2}, velocity{0.3, 0.1, -0.5}, turn_rate{0.2, -0.6, 1};

  BoardPose at(double time) const {
    const Eigen::AngleAxisd turned(turn_rate.norm() * time, turn_rate.normalized());
    return view.of(turned * turn(20, 30, 10), start + time * velocity);
  }
  BoardPose seen(double time) {
    std::normal_distribution<double> normal;
    const auto noise = [&](double deviation) -> Eigen::Vector3d {
      return {deviation * normal(random), deviation * normal(random), deviation * normal(random)};
    };
    const Eigen::Vector3d w = noise(view.turn);
    const BoardPose truth = at(time);
    return view.of(Eigen::AngleAxisd(w.norm(), w.normalized()) * rotation_of(truth),
                   translation_of(truth) + noise(view.shift));
  }
};

struct Fixture {
  Fixture() { fake_hal::reset(); }
};

/// Static memory on the chip, all zero.
std::unique_ptr<PoseFilter> usual_filter() {
  auto filter = std::make_unique<PoseFilter>();
  filter->open(usual);
  return filter;
}

std::unique_ptr<Detections> frame_of(const std::vector<std::pair<int, BoardPoses>>& markers) {
  auto found = std::make_unique<Detections>();
  for (const auto& [id, poses] : markers) {
    marker::Detection& detection = found->markers[found->count++];
    detection.marker.id = static_cast<std::uint16_t>(id);
    detection.pose = poses;
  }
  return found;
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(pose_filter, Fixture)

BOOST_AUTO_TEST_CASE(the_first_pose_stays_as_it_is) {
  PoseTrack track{};
  Moving marker;
  BoardPoses poses = only(marker.seen(0));
  const BoardPose seen = poses.best;
  const PoseMotion motion = track.follow(poses, 0, usual);
  BOOST_TEST(motion.frames == 1u);
  for (const double speed : motion.velocity) BOOST_TEST(speed == 0);
  BOOST_TEST(poses.best.rotation == seen.rotation);
  BOOST_TEST(poses.best.translation == seen.translation);
  BOOST_TEST(poses.best.covariance == seen.covariance);
}

// Two frames say where it goes, by hand: known as well as nothing before, the second pose counts
// almost alone, and the speed is the way over the time.
BOOST_AUTO_TEST_CASE(two_frames_tell_the_speed) {
  PoseTrack track{};
  const View view;
  BoardPoses first = only(view.of(turn(0, 0, 0), {0, 0, 2}));
  BoardPoses second = only(view.of(turn(0, 0, 0.5), {0.01, 0, 2}));
  track.follow(first, 0, usual);
  const PoseMotion motion = track.follow(second, 0.01, usual);
  BOOST_TEST(motion.frames == 2u);
  BOOST_TEST(std::abs(motion.velocity[0] - 1) < 0.01);
  BOOST_TEST(std::abs(motion.turn_rate[2] - 0.5 / 0.01 * views::pi / 180) < 0.02);
  BOOST_TEST(std::abs(second.best.translation[0] - 0.01) < 1e-6);
  // Known a little better than from the second frame alone.
  BOOST_TEST(second.best.covariance[21] < first.best.covariance[21]);
  BOOST_TEST(second.best.covariance[21] > 0.99 * first.best.covariance[21]);
}

// What the filter says is nearer to the truth than what the frames say, and it knows by how much.
BOOST_AUTO_TEST_CASE(steady_motion_is_known_better) {
  PoseTrack track{};
  Moving marker;
  Vector6d seen_squares = Vector6d::Zero(), led_squares = Vector6d::Zero();
  double surprise = 0;
  PoseMotion motion{};
  constexpr int frames = 3000, settled = 100;
  for (int i = 0; i < frames; ++i) {
    const double time = i * frame_time;
    BoardPoses poses = only(marker.seen(time));
    const Vector6d seen_off = between(marker.at(time), poses.best);
    motion = track.follow(poses, time, usual);
    if (i < settled) continue;
    const Vector6d off = between(marker.at(time), poses.best);
    seen_squares += seen_off.cwiseAbs2();
    led_squares += off.cwiseAbs2();
    const Matrix6d covariance = Eigen::Map<const Matrix6d>(poses.best.covariance.data());
    BOOST_REQUIRE((covariance - covariance.transpose()).norm() < 1e-6 * covariance.norm());
    surprise += off.dot(covariance.ldlt().solve(off)) / (frames - settled);
  }
  BOOST_TEST(motion.frames == 3000u);
  for (unsigned i = 0; i < 6; ++i)
    BOOST_TEST(led_squares[i] < 0.4 * seen_squares[i], "coordinate " << i);
  // Six coordinates: six, if the motion were as restless as the options say. It is steadier.
  BOOST_TEST(surprise < 6.5);
  BOOST_TEST(surprise > 1);
  for (unsigned i = 0; i < 3; ++i) {
    BOOST_TEST(std::abs(motion.velocity[i] - marker.velocity[i]) < 0.06);
    BOOST_TEST(std::abs(motion.turn_rate[i] - marker.turn_rate[i]) < 0.15);
  }
}

// A motion as restless as the options say: then the covariance is right.
BOOST_AUTO_TEST_CASE(the_covariance_is_that_of_the_errors) {
  PoseTrack track{};
  const View view;
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  double x = 0, speed = 0.4, surprise = 0, squares = 0, stated = 0;
  constexpr int frames = 4000, settled = 100;
  for (int i = 0; i < frames; ++i) {
    BoardPoses poses = only(view.of(turn(0, 0, 0), {x + view.shift * normal(random), 0, 2}));
    track.follow(poses, i * frame_time, usual);
    const double off = poses.best.translation[0] - x;
    if (i >= settled) {
      squares += off * off;
      stated += poses.best.covariance[21];
      surprise += off * off / poses.best.covariance[21] / (frames - settled);
    }
    const double acceleration = usual.acceleration * normal(random);
    x += speed * frame_time + acceleration * frame_time * frame_time / 2;
    speed += acceleration * frame_time;
  }
  BOOST_TEST(surprise > 0.85);
  BOOST_TEST(surprise < 1.15);
  BOOST_TEST(squares < 0.3 * (frames - settled) * view.shift * view.shift);
}

BOOST_AUTO_TEST_CASE(a_jump_begins_anew) {
  PoseTrack track{};
  Moving marker;
  for (int i = 0; i < 20; ++i) {
    BoardPoses poses = only(marker.seen(i * frame_time));
    BOOST_TEST(track.follow(poses, i * frame_time, usual).frames == i + 1u);
  }
  marker.start.x() += 0.1;
  BoardPoses poses = only(marker.seen(20 * frame_time));
  const BoardPose seen = poses.best;
  const PoseMotion motion = track.follow(poses, 20 * frame_time, usual);
  BOOST_TEST(motion.frames == 1u);
  BOOST_TEST(poses.best.translation == seen.translation);
  BOOST_TEST(poses.best.rotation == seen.rotation);
  BOOST_TEST(poses.best.covariance == seen.covariance);
}

// After so long a time it may be anywhere: the pose seen counts alone, though it is far off.
BOOST_AUTO_TEST_CASE(after_a_long_time_the_frame_counts) {
  PoseTrack track{};
  const View view;
  for (int i = 0; i < 20; ++i) {
    BoardPoses poses = only(view.of(turn(0, 0, 0), {0, 0, 2}));
    track.follow(poses, i * frame_time, usual);
  }
  BoardPoses poses = only(view.of(turn(0, 0, 0), {0.5, 0, 2}));
  const PoseMotion motion = track.follow(poses, 10, usual);
  BOOST_TEST(motion.frames == 21u);
  BOOST_TEST(std::abs(poses.best.translation[0] - 0.5) < 1e-6);
}

// A frame that favours the wrong one of a plane's two poses by a little.
BOOST_AUTO_TEST_CASE(the_pose_that_moves_on_is_the_right_one) {
  PoseTrack track{};
  const View view;
  const BoardPose right = view.of(turn(0, 12, 0), {0, 0, 4});
  BoardPose wrong = view.of(turn(0, -12, 0), {0, 0, 4});
  for (int i = 0; i < 10; ++i) {
    BoardPoses poses{true, right, wrong};
    poses.other.chi_squared = 3;
    track.follow(poses, i * frame_time, usual);
  }
  BoardPoses poses{true, wrong, right};
  poses.best.chi_squared = 1;
  const PoseMotion motion = track.follow(poses, 10 * frame_time, usual);
  BOOST_TEST(motion.frames == 11u);
  BOOST_TEST(angle_between(rotation_of(poses.best), rotation_of(right)) < 0.1);
  BOOST_TEST(poses.best.chi_squared == 2);
  // One that the corners exclude does not come back, however well it would fit the motion.
  BoardPoses excluded{true, wrong, right};
  excluded.other.chi_squared = 1e6;
  BOOST_TEST(track.follow(excluded, 11 * frame_time, usual).frames == 1u);
}

// NaN is no number to go on with.
BOOST_AUTO_TEST_CASE(a_pose_that_is_none_does_no_harm) {
  PoseTrack track{};
  const View view;
  BoardPoses poses = only(view.of(turn(0, 0, 0), {0, 0, 2}));
  track.follow(poses, 0, usual);
  BoardPoses none = poses;
  none.best.covariance.fill(std::nan(""));
  track.follow(none, frame_time, usual);
  BoardPoses next = only(view.of(turn(0, 0, 0), {0, 0, 2}));
  BOOST_TEST(track.follow(next, 2 * frame_time, usual).frames == 1u);
  BOOST_TEST(next.best.translation[2] == 2);
}

BOOST_AUTO_TEST_CASE(each_id_moves_for_itself) {
  const auto filter = usual_filter();
  const View view;
  for (int i = 0; i < 5; ++i) {
    const double x = 0.001 * i;
    const auto found = frame_of({{3, only(view.of(turn(0, 0, 0), {x, 0, 2}))},
                                 {999, only(view.of(turn(0, 0, 0), {1 - x, 0, 2}))}});
    filter->follow(*found, i * frame_time);
    BOOST_TEST(found->markers[0].motion.frames == i + 1u);
    BOOST_TEST(found->markers[1].motion.frames == i + 1u);
    BOOST_TEST((i == 0 || found->markers[0].motion.velocity[0] > 0.1));
    BOOST_TEST((i == 0 || found->markers[1].motion.velocity[0] < -0.1));
  }
}

BOOST_AUTO_TEST_CASE(nobody_knows_which_of_two_with_an_id_it_was) {
  const auto filter = usual_filter();
  const View view;
  const BoardPoses here = only(view.of(turn(0, 0, 0), {0, 0, 2})),
                   there = only(view.of(turn(0, 0, 0), {0.0001, 0, 2}));
  filter->follow(*frame_of({{5, here}}), 0);
  const auto two = frame_of({{5, there}, {5, here}});
  filter->follow(*two, frame_time);
  BOOST_TEST(two->markers[0].motion.frames == 0u);
  BOOST_TEST(two->markers[0].pose.best.translation == there.best.translation);
  BOOST_TEST(two->markers[1].pose.best.translation == here.best.translation);
  // The next frame with one continues from the last that had one.
  const auto one = frame_of({{5, here}});
  filter->follow(*one, 2 * frame_time);
  BOOST_TEST(one->markers[0].motion.frames == 2u);
}

BOOST_AUTO_TEST_CASE(a_board_moves_as_a_whole) {
  const auto filter = usual_filter();
  Moving board;
  for (int i = 0; i < 3; ++i) {
    const auto found = std::make_unique<Detections>();
    found->board = only(board.seen(i * frame_time));
    filter->follow(*found, i * frame_time);
    BOOST_TEST(found->board_motion.frames == i + 1u);
  }
  const auto unseen = std::make_unique<Detections>();
  filter->follow(*unseen, 3 * frame_time);
  BOOST_TEST(unseen->board_motion.frames == 0u);
}

BOOST_AUTO_TEST_SUITE_END()
