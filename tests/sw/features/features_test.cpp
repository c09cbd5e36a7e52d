// FAST, threshold and grouping on the PS give what the PL gives, corner by corner and blob by blob.
#include <marker/blob_grouping.h>
#include <marker/fast.h>
#include <marker/threshold.h>
#include <marker/work.h>
#include <pl/blob_detection/core.h>
#include <pl/corner_detection/core.h>
#include <pl/global_threshold/core.h>

#include <boost/test/unit_test.hpp>
#include <memory>

#include "fake_hal.h"
#include "pictures.h"

namespace packet = marker::packet;

namespace {

using Words = std::vector<std::uint32_t>;

struct Fixture {
  Fixture() { fake_hal::reset(); }
};

/// They are as large as on the chip: not for the stack.
struct Detectors {
  marker::CornerDetector corners;
  marker::BlobGrouping blobs;
  marker::AdaptiveThreshold threshold;
  marker::FeatureSet features;
};

marker::GreyImage grey(const Picture& picture) {
  return {picture.image.data(), picture.geometry.width, picture.geometry.height};
}

Words corners_of_ps(Detectors& detectors, const Picture& picture, std::uint32_t threshold) {
  detectors.features.clear();
  detectors.corners.detect(grey(picture), threshold, detectors.features);
  Words words;
  for (std::uint32_t i = 0; i < detectors.features.corner_count; ++i) {
    words.push_back(packet::encode(detectors.features.corners[i], picture.geometry.words()));
  }
  return words;
}

/// As many as the PS has room for.
Words corners_of_pl(const Picture& picture, std::uint32_t threshold) {
  pl::CornerFrame frame(picture.geometry, threshold);
  std::vector<pl::StampedWord> corners;
  frame.detect(picture.image.data(), corners);
  Words words;
  for (const pl::StampedWord& corner : corners) {
    if (words.size() < marker::max_corners) words.push_back(corner.word);
  }
  return words;
}

struct Blobs {
  Words words;
  std::uint32_t overflow;
};

Blobs blobs_of_ps(Detectors& detectors, const Picture& picture, const Words& binary,
                  const marker::BlobOptions& options) {
  detectors.features.clear();
  detectors.blobs.detect({binary.data(), picture.geometry.width, picture.geometry.height, false},
                         options, detectors.features);
  Blobs blobs{{}, detectors.blobs.label_overflow()};
  for (std::uint32_t i = 0; i < detectors.features.blob_count; ++i) {
    blobs.words.push_back(
        packet::encode_start(detectors.features.blobs[i], picture.geometry.words()));
    blobs.words.push_back(
        packet::encode_end(detectors.features.blobs[i], picture.geometry.words()));
  }
  return blobs;
}

Blobs blobs_of_pl(const Picture& picture, const Words& binary, const marker::BlobOptions& options) {
  pl::BlobFrame frame(picture.geometry, options.labels, options.minimum_side);
  std::vector<pl::StampedBlob> found;
  frame.begin();
  frame.advance(binary.data(), picture.geometry.pixels(), found);
  frame.finish(found);
  Blobs blobs{{}, frame.overflow()};
  for (const pl::StampedBlob& blob : found) {
    if (blobs.words.size() == 2 * marker::max_blobs) break;
    blobs.words.push_back(blob.start);
    blobs.words.push_back(blob.end);
  }
  return blobs;
}

void check_blobs(Detectors& detectors, const Picture& picture, const Words& binary,
                 const marker::BlobOptions& options) {
  BOOST_TEST_CONTEXT(options.labels << " labels, " << options.minimum_side << " px") {
    const Blobs ps = blobs_of_ps(detectors, picture, binary, options);
    const Blobs pl = blobs_of_pl(picture, binary, options);
    BOOST_TEST(ps.words == pl.words, boost::test_tools::per_element());
    BOOST_TEST(ps.overflow == pl.overflow);
  }
}

/// The binary image by the PL's rule, and that the PS has the same, and the same next threshold.
Words check_threshold(Detectors& detectors, const Picture& picture) {
  pl::ThresholdFrame frame(picture.geometry);
  frame.begin(picture.image.data());
  frame.advance(picture.geometry.pixels());
  Words binary(frame.words().size());
  detectors.threshold.reset();
  BOOST_TEST(detectors.threshold.value() == 127u);
  detectors.threshold.binarise(grey(picture), binary.data());
  BOOST_TEST((binary == frame.words()));
  BOOST_TEST(detectors.threshold.value() == frame.end());
  return binary;
}

void check(Detectors& detectors, const Picture& picture) {
  BOOST_TEST_CONTEXT(picture.name << ' ' << picture.geometry.width << 'x'
                                  << picture.geometry.height) {
    for (const std::uint32_t threshold : {0u, 30u, 254u}) {
      BOOST_TEST(corners_of_ps(detectors, picture, threshold) == corners_of_pl(picture, threshold),
                 boost::test_tools::per_element());
    }
    const Words binary = check_threshold(detectors, picture);
    check_blobs(detectors, picture, binary, {});
    check_blobs(detectors, picture, binary, {4, 1});
    check_blobs(detectors, picture, binary, {16, 3});
    check_blobs(detectors, picture, binary, {1024, 1});
  }
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(features, Fixture)

BOOST_AUTO_TEST_CASE(scenes_give_the_features_of_the_pl) {
  const auto detectors = std::make_unique<Detectors>();
  for (const Picture& picture : scenes()) check(*detectors, picture);
}

BOOST_AUTO_TEST_CASE(any_picture_gives_the_features_of_the_pl) {
  const auto detectors = std::make_unique<Detectors>();
  for (const pl::Geometry& size : small_sizes()) {
    for (const Picture& picture : patterns(size)) check(*detectors, picture);
  }
}

BOOST_AUTO_TEST_CASE(large_pictures_fit) {
  const auto detectors = std::make_unique<Detectors>();
  for (const pl::Geometry& size : {pl::Geometry{1024, 512}, {1920, 1080}}) {
    for (const Picture& picture : patterns(size)) check(*detectors, picture);
  }
}

BOOST_AUTO_TEST_CASE(labels_run_out_as_in_the_pl) {
  const auto detectors = std::make_unique<Detectors>();
  const pl::Geometry size{640, 64};
  const Picture picture{"stripes", size, harness::stripes(640, 64)};
  const Words binary = check_threshold(*detectors, picture);
  BOOST_TEST(blobs_of_pl(picture, binary, {}).overflow > 0u);
  check_blobs(*detectors, picture, binary, {});
}

BOOST_AUTO_TEST_CASE(work_is_counted) {
  const auto detectors = std::make_unique<Detectors>();
  const Picture picture{"rectangle", {64, 64}, harness::one_rectangle(64, 64, 16, 16, 47, 47)};
  Words binary(64 * 2);
  detectors->corners.detect(grey(picture), 30, detectors->features);
  detectors->threshold.binarise(grey(picture), binary.data());
  detectors->blobs.detect({binary.data(), 64, 64, false}, {}, detectors->features);
  const auto count = [](marker::Work item) {
    return fake_hal::state().work[static_cast<std::uint32_t>(item)];
  };
  using marker::Work;
  BOOST_TEST(count(Work::corner_pixels) == 58u * 58u);
  BOOST_TEST(count(Work::corner_rows) == 58u);
  BOOST_TEST(count(Work::corner_survivors) == 4u * 9u, "three by three in each corner");
  BOOST_TEST(count(Work::corners_found) == 4u);
  BOOST_TEST(count(Work::threshold_pixels) == 64u * 64u);
  BOOST_TEST(count(Work::blob_pixels) == 64u * 64u);
  BOOST_TEST(count(Work::blob_dark) == 32u * 32u);
  BOOST_TEST(count(Work::blob_runs) == 32u);
  BOOST_TEST(count(Work::blob_labels) == 1u);
  BOOST_TEST(count(Work::blobs_ended) == 1u);
}

BOOST_AUTO_TEST_SUITE_END()
