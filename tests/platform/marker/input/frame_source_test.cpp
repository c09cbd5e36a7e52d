#include <marker/input/frame_source.h>

#include <opencv2/videoio.hpp>

#include <marker/scene/renderer.h>
#include <marker/scene/scene.h>

#include "image_kit.h"
#include "temporary_files.h"

using namespace platform;
using namespace platform::input;
using namespace input_test;
using kit::TemporaryFolder;

namespace {

std::vector<InputFrame> all(FrameSource& source) {
  std::vector<InputFrame> frames;
  while (const SharedFrame frame = source.next()) frames.push_back(*frame);
  BOOST_TEST(!source.next(), "frames after the last one");
  return frames;
}

std::vector<std::string> names(FrameSource& source) {
  std::vector<std::string> result;
  for (const InputFrame& frame : all(source)) result.push_back(frame.name);
  return result;
}

InputOptions small_frames() {
  InputOptions options;
  options.size = {64, 32};
  return options;
}

using Names = std::vector<std::string>;

/// A motion-JPEG video of flat pictures; false if OpenCV has no encoder.
bool write_video(const std::string& path, int frames) {
  cv::VideoWriter writer(path, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 10, cv::Size(64, 32));
  for (int i = 0; i < frames; ++i) writer << cv::Mat(32, 64, CV_8UC3, cv::Scalar::all(10 + 40 * i));
  return writer.isOpened();
}

}  // namespace

BOOST_AUTO_TEST_SUITE(frame_source)

BOOST_AUTO_TEST_CASE(no_input_is_the_demo_scene) {
  const auto source = open_inputs({}, {});
  BOOST_TEST(*source->size() == 1u);
  const std::vector<InputFrame> frames = all(*source);
  BOOST_TEST_REQUIRE(frames.size() == 1u);
  BOOST_TEST(frames[0].name == "demo");
  BOOST_TEST(frames[0].truth.has_value());
  BOOST_TEST(source->warnings().empty());
}

BOOST_AUTO_TEST_CASE(a_scene_brings_its_picture_camera_and_truth) {
  const auto source = open_inputs({"z1.0"}, {});
  const InputFrame frame = *source->next();
  const Scene scene = make_scene("z1.0");
  BOOST_TEST(frame.image.pixels == render(scene).pixels);
  BOOST_TEST(frame.camera.fx == 381.36);
  BOOST_TEST(frame.truth->marker_id == scene.marker_id);
  BOOST_TEST(frame.truth->corners_px[2].x == ground_truth(scene).corners_px[2].x);
}

BOOST_AUTO_TEST_CASE(a_group_is_all_its_scenes) {
  const auto source = open_inputs({"yaw"}, small_frames());
  BOOST_TEST(names(*source) == (Names{"yaw0", "yaw15", "yaw30", "yaw45", "yaw60"}));
}

BOOST_AUTO_TEST_CASE(a_folder_is_sorted_naturally_and_only_its_images_count) {
  const TemporaryFolder folder;
  for (const char* name : {"b10.png", "b9.png", "a.pgm", "b09.png", "C.PNG", ".hidden.png"}) {
    cv::imwrite(folder / name, pattern(64, 32));
  }
  kit::write_file(folder / "notes.txt", "not an image");
  std::filesystem::create_directory(folder / "more.png.d");
  const auto source = open_inputs({folder.path()}, small_frames());
  BOOST_TEST(*source->size() == 5u);
  BOOST_TEST(names(*source) == (Names{"C.PNG", "a.pgm", "b09.png", "b9.png", "b10.png"}));
}

BOOST_AUTO_TEST_CASE(natural_order_is_total) {
  BOOST_TEST(natural_less("a9", "a10"));
  BOOST_TEST(!natural_less("a10", "a9"));
  BOOST_TEST(natural_less("a", "a1"));
  BOOST_TEST(natural_less("a09", "a9"));
  BOOST_TEST(!natural_less("a9", "a09"));
  BOOST_TEST(natural_less("frame99999999999999999998", "frame99999999999999999999"));
  BOOST_TEST(!natural_less("x", "x"));
  BOOST_TEST(natural_less("1b2", "1b10"));
}

BOOST_AUTO_TEST_CASE(several_inputs_follow_each_other_and_repeat) {
  const TemporaryFolder folder;
  cv::imwrite(folder / "p.png", pattern(64, 32));
  InputOptions options = small_frames();
  options.repeat = 2;
  const auto source = open_inputs({"z1.0", folder / "p.png"}, options);
  BOOST_TEST(*source->size() == 4u);
  const std::vector<InputFrame> frames = all(*source);
  BOOST_TEST_REQUIRE(frames.size() == 4u);
  BOOST_TEST(frames[2].name == "z1.0");
  BOOST_TEST(frames[2].image.pixels == frames[0].image.pixels);
  BOOST_TEST(frames[2].truth.has_value());
  BOOST_TEST(!frames[3].truth.has_value());
  options.limit = 3;
  const auto limited = open_inputs({"z1.0", folder / "p.png"}, options);
  BOOST_TEST(*limited->size() == 3u);
  BOOST_TEST(names(*limited) == (Names{"z1.0", "p.png", "z1.0"}));
}

BOOST_AUTO_TEST_CASE(a_video_gives_its_pictures_one_by_one) {
  const TemporaryFolder folder;
  const std::string path = folder / "clip.avi";
  BOOST_TEST_REQUIRE(write_video(path, 3));
  InputOptions options = small_frames();
  options.repeat = 2;
  const auto source = open_inputs({path}, options);
  BOOST_TEST(!source->size().has_value());
  const std::vector<InputFrame> frames = all(*source);
  BOOST_TEST_REQUIRE(frames.size() == 6u);
  BOOST_TEST(frames[2].name == "clip.avi#2");
  BOOST_TEST(frames[3].name == "clip.avi#0");
  for (int i = 0; i < 3; ++i) BOOST_TEST(std::abs(frames[i].image.at(30, 15) - (10 + 40 * i)) <= 3);
  BOOST_TEST(frames[5].image.pixels == frames[2].image.pixels);
}

BOOST_AUTO_TEST_CASE(a_colon_in_the_name_of_a_video_is_no_protocol) {
  const TemporaryFolder folder;
  BOOST_TEST_REQUIRE(write_video(folder / "clip.avi", 2));
  std::filesystem::rename(folder / "clip.avi", folder / "12:30.avi");
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  const auto source = open_inputs({"12:30.avi"}, small_frames());
  BOOST_TEST(names(*source) == (Names{"12:30.avi#0", "12:30.avi#1"}));
  std::filesystem::current_path(before);
}

BOOST_AUTO_TEST_CASE(a_video_that_ends_early_is_warned_of) {
  const TemporaryFolder folder;
  BOOST_TEST_REQUIRE(write_video(folder / "clip.avi", 40));
  kit::write_part(folder / "clip.avi", folder / "part.avi",
                  std::filesystem::file_size(folder / "clip.avi") / 2);
  const auto source = open_inputs({folder / "part.avi"}, small_frames());
  const std::size_t count = names(*source).size();
  BOOST_TEST(count > 0u);
  BOOST_TEST(count < 40u);
}

BOOST_AUTO_TEST_CASE(fitting_adapts_the_camera) {
  const TemporaryFolder folder;
  cv::imwrite(folder / "big.png", pattern(1280, 960));
  InputOptions options;
  CHECK_REFUSED(open_inputs({folder / "big.png"}, options), "use --fit crop or --fit scale");
  options.fit = Fit::scale;
  InputFrame frame = *open_inputs({folder / "big.png"}, options)->next();
  BOOST_TEST(frame.image.width == 640);
  BOOST_TEST(frame.camera.fx == 381.36);
  options.fit = Fit::crop;
  frame = *open_inputs({folder / "big.png"}, options)->next();
  BOOST_TEST(frame.camera.fx == 2 * 381.36);
  BOOST_TEST(frame.camera.cx == 320.0);
  const auto source = open_inputs({folder / "big.png"}, options);
  source->next();
  BOOST_TEST_REQUIRE(source->notes().size() == 1u);
  BOOST_TEST(contains(source->notes()[0], "75 % of each is cut off"));
}

BOOST_AUTO_TEST_CASE(the_camera_file_counts_for_pictures_and_scenes) {
  const TemporaryFolder folder;
  cv::imwrite(folder / "p.png", pattern(64, 32));
  InputOptions options = small_frames();
  options.camera = CalibratedCamera{
      "c.yaml", {64, 32, 50, 51, 33, 17}, true, marker::LensModel::brown_conrady, {0.1}};
  const auto source = open_inputs({folder / "p.png", "z1.0"}, options);
  BOOST_TEST(source->next()->camera.fy == 51.0);
  const InputFrame scene = *source->next();
  BOOST_TEST(scene.camera.cx == 33.0);
  BOOST_TEST(scene.truth->corners_px[0].x == 33.0, "the axis passes through the marker's corner");
  BOOST_TEST_REQUIRE(source->warnings().size() == 2u);
  BOOST_TEST(contains(source->warnings()[0], "lens distortion, which scenes are drawn without"));
  BOOST_TEST(contains(source->warnings()[1], "lens distortion, which this design"));
  BOOST_TEST_REQUIRE(source->notes().size() == 1u);
  BOOST_TEST(contains(source->notes()[0], "scenes are drawn as camera file 'c.yaml' says"));
  BOOST_TEST(scene.camera.distortion[0] == 0, "scenes are drawn without a lens");
  options.corrects_lens = true;
  const auto corrected = open_inputs({folder / "p.png"}, options);
  BOOST_TEST(corrected->next()->camera.distortion[0] == 0.1);
  BOOST_TEST(corrected->warnings().empty());
  // r (1 - r^2) is greatest at r = 0.577, and 0.385 there; the corners are at 0.74.
  options.camera->distortion = {-1};
  BOOST_TEST(contains(open_inputs({folder / "p.png"}, options)->warnings()[0],
                      "folds back: no marker is found beyond 19 px from the middle"));
  options.camera->distortion = {};
  options.camera->oddities = {"has entries that are not read: focus"};
  const auto odd = open_inputs({folder / "p.png"}, options);
  BOOST_TEST_REQUIRE(odd->warnings().size() == 1u);
  BOOST_TEST(odd->warnings()[0] == "camera file 'c.yaml' has entries that are not read: focus");
  options.camera->oddities = {};
  options.camera->has_size = false;
  options.camera->camera.cx = 55;
  const auto another = open_inputs({folder / "p.png"}, options);
  another->next();
  BOOST_TEST_REQUIRE(another->warnings().size() == 1u);
  BOOST_TEST(contains(another->warnings()[0], "principal point far from the middle"));
  BOOST_TEST(contains(another->notes()[0], "says no image size"));
  options.camera->has_size = true;
  options.camera->camera.width = 65;
  CHECK_REFUSED(open_inputs({folder / "p.png"}, options), "is for images of 65x32 px, not 64x32");
  CHECK_REFUSED(open_inputs({"z1.0"}, options), "is for images of 65x32 px, not 64x32");
}

BOOST_AUTO_TEST_CASE(pictures_without_a_camera_are_warned_of) {
  const TemporaryFolder folder;
  cv::imwrite(folder / "p.png", pattern(64, 32));
  BOOST_TEST(open_inputs({folder / "p.png"}, small_frames())->warnings().size() == 1u);
}

BOOST_AUTO_TEST_CASE(bad_inputs_are_refused_before_the_first_frame) {
  const TemporaryFolder folder;
  const InputOptions options = small_frames();
  cv::imwrite(folder / "good.png", pattern(64, 32));
  kit::write_part(folder / "good.png", folder / "half.png", 60);
  kit::write_file(folder / "text.dat", std::string(5000, 'x'));
  kit::write_file(folder / "clip.avi", std::string("RIFF\x10\0\0\0AVI LIST", 16));
  std::filesystem::create_directory(folder / "nothing");
  CHECK_REFUSED(open_inputs({"z1.0", folder / "half.png"}, options), "is truncated");
  CHECK_REFUSED(open_inputs({folder / "missing.png"}, options),
                "no scene, image, folder or video named");
  CHECK_REFUSED(open_inputs({"squars15"}, options), "did you mean the scene 'squares15'?");
  CHECK_REFUSED(open_inputs({folder / "text.dat"}, options), "neither an image nor a video");
  CHECK_REFUSED(open_inputs({folder / "clip.avi"}, options), "clip.avi'");
  CHECK_REFUSED(open_inputs({folder / "nothing"}, options), "has no images");
  CHECK_REFUSED(open_inputs({folder.path()}, options), "is truncated");
  CHECK_REFUSED(open_inputs({"/dev/null"}, options), "is a device");
}

BOOST_AUTO_TEST_CASE(a_video_without_frames_is_refused) {
  const TemporaryFolder folder;
  BOOST_TEST_REQUIRE(write_video(folder / "clip.avi", 0));
  CHECK_REFUSED(open_inputs({folder / "clip.avi"}, small_frames()), "clip.avi'");
}

BOOST_AUTO_TEST_CASE(a_sequence_is_the_pictures_of_a_video) {
  const TemporaryFolder folder;
  for (const char* name :
       {"f_0009.png", "f_0010.png", "f_0008.png", "f_008.png", "f_x.png", "f_10000.png"})
    cv::imwrite(folder / name, pattern(64, 32));
  const auto source = open_inputs({folder / "f_%04d.png"}, small_frames());
  const std::vector<InputFrame> frames = all(*source);
  BOOST_TEST_REQUIRE(frames.size() == 4u);
  BOOST_TEST(frames[0].name == "f_0008.png");
  BOOST_TEST(frames[3].name == "f_10000.png");
  BOOST_TEST(!frames[0].settles_after(nullptr), "shown once, as a video");
  BOOST_TEST(contains(source->warnings()[0], "f_0011.png' is missing"), source->warnings()[0]);
  BOOST_TEST(names(*open_inputs({folder / "f_%03d.png"}, small_frames())) ==
             (Names{"f_008.png", "f_10000.png"}));
}

BOOST_AUTO_TEST_CASE(a_sequence_without_files_is_refused) {
  const TemporaryFolder folder;
  CHECK_REFUSED(open_inputs({folder / "f_%04d.png"}, small_frames()), "f_0000.png for example");
  CHECK_REFUSED(open_inputs({"/no/such/folder/%d.png"}, small_frames()), "cannot be read");
  CHECK_REFUSED(open_inputs({folder / "f_%s.png"}, small_frames()), "no scene, image, folder");
  cv::imwrite(folder / "%d.png", pattern(64, 32));
  BOOST_TEST(names(*open_inputs({folder / "%d.png"}, small_frames())) == Names{"%d.png"});
}

BOOST_AUTO_TEST_CASE(pgm_images_one_behind_the_other_are_a_video) {
  const TemporaryFolder folder;
  const std::string head = "P5\n# of a camera\n64 32\n255\n";
  std::string stream;
  for (const char level : {'\x10', '\x20', '\x30'}) stream += head + std::string(64 * 32, level);
  kit::write_file(folder / "stream", stream);
  const auto source = open_inputs({folder / "stream"}, small_frames());
  const std::vector<InputFrame> frames = all(*source);
  BOOST_TEST_REQUIRE(frames.size() == 3u);
  BOOST_TEST(frames[2].name == "stream#2");
  BOOST_TEST(frames[2].image.pixels[0] == 0x30);
  BOOST_TEST(frames[2].image.pixels.size() == 64u * 32u);
  stream.pop_back();
  kit::write_file(folder / "stream", stream);
  CHECK_REFUSED(all(*open_inputs({folder / "stream"}, small_frames())), "truncated");
}

BOOST_AUTO_TEST_SUITE_END()
