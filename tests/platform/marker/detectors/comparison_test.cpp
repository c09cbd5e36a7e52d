// Truth, judgement and score of what detectors saw.
#include <marker/detectors/comparison.h>

#include <boost/test/unit_test.hpp>

#include "input_error.h"
#include "temporary_files.h"

using namespace platform;
using namespace platform::detectors;
using Verdict = Judgement::Verdict;

namespace {

std::array<PixelPoint, 4> square(double x, double y, double side = 40) {
  return {{{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}}};
}

std::array<PixelPoint, 4> turned(const std::array<PixelPoint, 4>& corners) {
  return {corners[1], corners[2], corners[3], corners[0]};
}

ImageTruth one_marker() {
  return {{{{7, square(100, 100), Pose{}}}}, {}};
}

std::vector<Verdict> verdicts(const ImageTruth& truth, const std::vector<SeenMarker>& seen) {
  std::vector<Verdict> result;
  for (const Judgement& marker : judge(truth, seen)) result.push_back(marker.verdict);
  return result;
}

using Verdicts = std::vector<Verdict>;

Comparison two_images() {
  Comparison comparison;
  comparison.dictionary = "4x4_250";
  comparison.images = {{"a.png", one_marker()}, {"b.png", one_marker()}};
  Pose pose;
  pose.translation = {0, 0, 1.002};
  comparison.detectors = {
      {"ours", "our design", {{{7, square(100, 103), pose}}, {}}, 5, HardwareFigures{250, 4, 7}},
      {"theirs", "a library", {{{7, square(100, 101), {}}}, {{9, square(0, 0), {}}}}, 3, {}}};
  return comparison;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(comparison)

BOOST_AUTO_TEST_CASE(a_marker_is_found_where_it_is) {
  BOOST_TEST((verdicts(one_marker(), {{7, square(101, 99), {}}}) == Verdicts{Verdict::found}));
  BOOST_TEST((verdicts(one_marker(), {}) == Verdicts{Verdict::missed}));
}

BOOST_AUTO_TEST_CASE(another_id_another_place_another_orientation_and_a_second_time_are_false) {
  const Verdicts both{Verdict::wrong, Verdict::missed};
  BOOST_TEST((verdicts(one_marker(), {{8, square(100, 100), {}}}) == both));
  BOOST_TEST((verdicts(one_marker(), {{7, square(111, 100), {}}}) == both));
  BOOST_TEST((verdicts(one_marker(), {{7, turned(square(100, 100)), {}}}) == both));
  const SeenMarker right{7, square(100, 100), {}};
  BOOST_TEST((verdicts(one_marker(), {right, right}) == Verdicts{Verdict::found, Verdict::wrong}));
}

BOOST_AUTO_TEST_CASE(without_truth_nothing_is_judged_but_ids_that_cannot_be) {
  const std::vector<SeenMarker> seen{{3, square(0, 0), {}}, {200, square(50, 0), {}}};
  BOOST_TEST((verdicts({}, seen) == Verdicts{Verdict::unjudged, Verdict::unjudged}));
  BOOST_TEST(
      (verdicts({{}, std::set<int>{3}}, seen) == Verdicts{Verdict::unjudged, Verdict::wrong}));
}

BOOST_AUTO_TEST_CASE(errors_are_the_means_of_what_was_found) {
  const Comparison compared = two_images();
  const Score ours = score(compared, compared.detectors[0]);
  BOOST_TEST(ours.seen == 1u);
  BOOST_TEST(ours.found == 1u);
  BOOST_TEST(ours.markers.value() == 2u);
  BOOST_TEST(ours.wrong.value() == 0u);
  BOOST_TEST(ours.corner_px.mean() == 3.0);
  BOOST_TEST(ours.translation_mm.mean() == 2.0, boost::test_tools::tolerance(1e-9));
  const Score theirs = score(compared, compared.detectors[1]);
  BOOST_TEST(theirs.wrong.value() == 1u);
  BOOST_TEST(theirs.corner_px.max() == 1.0);
  BOOST_TEST(theirs.translation_mm.count() == 0u, "it tells no pose");
}

BOOST_AUTO_TEST_CASE(what_nobody_knows_has_no_column) {
  Comparison compared = two_images();
  BOOST_TEST(markdown_text(compared).find("| corner, px |") != std::string::npos);
  for (Image& image : compared.images) image.truth = {};
  const std::string text = markdown_text(compared);
  BOOST_TEST(text.find("corner, px") == std::string::npos, text);
  BOOST_TEST(text.find("found") == std::string::npos, text);
  BOOST_TEST(text.find("| `ours` | 1 | 250.0 | 4.000 | 7.00 | 5.00 |") != std::string::npos, text);
  BOOST_TEST(!score(compared, compared.detectors[0]).wrong.has_value());
}

BOOST_AUTO_TEST_CASE(tables_have_a_line_each) {
  const Comparison compared = two_images();
  BOOST_TEST(detections_csv(compared) ==
             "detector,image,id,verdict,corner_px,translation_mm,rotation_deg\n"
             "ours,a.png,7,found,3.000000,2.000000,0.000000\n"
             "ours,b.png,7,missed,,,\n"
             "theirs,a.png,7,found,1.000000,,\n"
             "theirs,b.png,9,false,,,\n"
             "theirs,b.png,7,missed,,,\n");
  const std::string scores = scores_csv(compared);
  BOOST_TEST(scores.find("\ntheirs,2,1,2,1,1.000000,1.000000,,,,,,3.000000\n") != std::string::npos,
             scores);
}

BOOST_AUTO_TEST_CASE(the_time_of_this_computer_stands_apart) {
  Comparison one = two_images(), other = two_images();
  other.detectors[1].host_ms = 1000;
  result::Json a = to_json(one), b = to_json(other);
  BOOST_TEST((a != b));
  a.erase("host_ms");
  b.erase("host_ms");
  BOOST_TEST((a == b));
  BOOST_TEST(a["detectors"][0]["kind"] == "design");
  BOOST_TEST(a["detectors"][1]["kind"] == "library");
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE(truth)

BOOST_AUTO_TEST_CASE(what_is_written_is_read_again) {
  const kit::TemporaryFolder folder;
  const Scene scene = make_scene("roll30");
  Truth truth;
  truth.add("roll30.png", scene);
  kit::write_file(folder / Truth::file_name, truth.json());
  const Truth read = Truth::of_folder(folder.path());
  const std::vector<TrueMarker> markers = read.of("roll30.png").markers.value();
  BOOST_TEST_REQUIRE(markers.size() == 1u);
  const GroundTruth known = ground_truth(scene);
  BOOST_TEST(markers[0].id == known.marker_id);
  BOOST_TEST((*markers[0].corners_px)[2].x == known.corners_px[2].x,
             boost::test_tools::tolerance(1e-6));
  BOOST_TEST(translation_error_mm(*markers[0].pose, known.pose) < 1e-6);
  BOOST_TEST(rotation_error_deg(*markers[0].pose, known.pose) < 1e-6);
  BOOST_TEST(!read.of("other.png").markers.has_value());
}

BOOST_AUTO_TEST_CASE(all_markers_of_a_scene_are_in_it) {
  const std::vector<TrueMarker> markers = *truth_of(make_scene("z2.0@markers=3")).markers;
  BOOST_TEST_REQUIRE(markers.size() == 3u);
  for (int i = 0; i < 3; ++i) BOOST_TEST(markers[static_cast<std::size_t>(i)].id == i);
  BOOST_TEST(truth_of(make_scene("z2.0@squares=3")).markers->size() == 1u,
             "plain squares are none");
}

BOOST_AUTO_TEST_CASE(a_folder_without_file_knows_nothing) {
  const kit::TemporaryFolder folder;
  BOOST_TEST(Truth::of_folder(folder.path()).empty());
}

BOOST_AUTO_TEST_CASE(corners_poses_and_lists_may_be_missing) {
  const kit::TemporaryFolder folder;
  kit::write_file(folder / "t.json",
                  R"({"schema": 1, "ids": [1, 2], "images": {"a.png": [{"id": 5}], "b.png": []}})");
  const Truth truth = Truth::read(folder / "t.json");
  BOOST_TEST(truth.of("a.png").markers.value()[0].id == 5);
  BOOST_TEST(truth.of("b.png").markers.value().empty());
  BOOST_TEST(truth.of("c.png").ids.value().count(2) == 1u);
}

BOOST_AUTO_TEST_CASE(a_damaged_file_is_refused_with_the_image) {
  const kit::TemporaryFolder folder;
  const auto refused = [&](const std::string& json, const std::string& why) {
    kit::write_file(folder / "t.json", json);
    const std::string said = input_error([&] { Truth::read(folder / "t.json"); });
    BOOST_TEST(said.find(why) != std::string::npos, said << " lacks " << why);
  };
  refused("[]", "\"schema\": 1");
  refused(R"({"schema": 2})", "\"schema\": 1");
  refused(R"({"schema": 1, "images": {"a.png": [{}]}})", "image \"a.png\"");
  refused(R"({"schema": 1, "images": {"a.png": [{"id": 1, "corners_px": [[1, 2]]}]}})",
          "image \"a.png\"");
  refused(R"({"schema": 1, "images": {"a.png": [{"id": 1, "pose": {"rotation":
            [[1, 0, 0], [0, 2, 0], [0, 0, 1]], "translation_m": [0, 0, 1]}}]}})",
          "rotation");
  refused("{", "not JSON");
  BOOST_TEST(input_error([&] { Truth::read(folder / "none.json"); }).find("none.json") !=
             std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
