// Images, folders, videos, scenes and camera files that cannot be used.
#include <boost/test/unit_test.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "command_line.h"

using namespace negative;

namespace {

cv::Mat picture(int width = 640, int height = 480) {
  cv::Mat grey(height, width, CV_8UC1);
  cv::RNG(3).fill(grey, cv::RNG::UNIFORM, 0, 256);
  return grey;
}

struct Inputs : CommandLine {
  void write(const std::string& name, const cv::Mat& image = picture()) const {
    BOOST_TEST_REQUIRE(cv::imwrite(*this / name, image));
  }

  void write_video(const std::string& name, int width, int height) const {
    cv::VideoWriter writer(*this / name, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 25,
                           {width, height}, false);
    for (int i = 0; i < 3; ++i) writer.write(picture(width, height));
  }

  /// The first bytes of a good file, alone and after a good input.
  void part_refused(const std::string& whole, std::size_t bytes) const {
    const std::string part = "part" + std::filesystem::path(whole).extension().string();
    kit::write_part(*this / whole, *this / part, bytes);
    run_refuses({part}, {part});
    run_refuses({"z1.0", part}, {part});
    std::filesystem::remove(*this / part);
  }

  std::size_t size(const std::string& name) const {
    return std::filesystem::file_size(*this / name);
  }

  void camera_refused(const std::string& text, const Words& parts) const {
    kit::write_file(*this / "camera.yaml", text);
    Words all{"camera.yaml"};
    all.insert(all.end(), parts.begin(), parts.end());
    run_refuses({"z1.0", "--camera", "camera.yaml"}, all);
  }
};

/// A ROS calibration with this camera matrix.
std::string calibration(const std::string& matrix, const std::string& more = "") {
  return "camera_matrix:\n  rows: 3\n  cols: 3\n  data: [" + matrix + "]\n" + more;
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(inputs, Inputs)

BOOST_AUTO_TEST_CASE(unknown_names) {
  run_refuses({"z1.00"}, {"'z1.00'", "did you mean the scene 'z1.0'?"});
  run_refuses({"pich30"}, {"'pich30'", "'pitch30'"});
  run_refuses({"demo", "missing.png"}, {"'missing.png'"});
  run_refuses({"missing/photo.png"}, {"'missing/photo.png'"});
  run_refuses({""}, {"''"});
  run_refuses({"/dev/null"}, {"'/dev/null'"});
  run_refuses({std::string(300, 'n')}, {"nnn"});
  run_refuses({"z1.0", "--camera", std::string(300, 'n')}, {"nnn"});
  run_refuses({"z1.0", "--config", std::string(300, 'n')}, {"nnn"});
}

BOOST_AUTO_TEST_CASE(files_that_are_no_images) {
  kit::write_file(*this / "empty.png", "");
  run_refuses({"empty.png"}, {"empty.png", "empty"});
  kit::write_file(*this / "notes.txt", "just text\n");
  run_refuses({"notes.txt"}, {"notes.txt", "neither an image nor a video"});
  kit::write_file(*this / "text.jpg", "just text\n");
  run_refuses({"text.jpg"}, {"text.jpg"});
  std::filesystem::create_directory(*this / "folder.png");
  run_refuses({"folder.png"}, {"folder.png", "no images"});
  run_refuses({"z1.0", "demo", "notes.txt"}, {"notes.txt"});
}

BOOST_AUTO_TEST_CASE(truncated_images) {
  write("grey.png");
  write("colour.png", cv::Mat(480, 640, CV_8UC3, cv::Scalar(1, 2, 3)));
  write("whole.jpg");
  write("whole.pgm");
  write("whole.bmp");
  for (const char* file : {"grey.png", "colour.png", "whole.jpg", "whole.pgm", "whole.bmp"}) {
    for (const std::size_t bytes :
         {std::size_t{2}, std::size_t{9}, std::size_t{40}, size(file) / 2, size(file) - 1}) {
      part_refused(file, bytes);
    }
  }
}

BOOST_AUTO_TEST_CASE(damaged_images) {
  write("good.png");
  std::string bytes = kit::read_file(*this / "good.png");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 0x55);
  kit::write_file(*this / "bad.png", bytes);
  run_refuses({"bad.png"}, {"bad.png"});
  run_refuses({"good.png", "bad.png"}, {"bad.png"});
}

BOOST_AUTO_TEST_CASE(sizes) {
  kit::write_file(*this / "zero.pgm", "P5\n0 480\n255\n");
  run_refuses({"zero.pgm"}, {"zero.pgm"});
  kit::write_file(*this / "zero2.pgm", "P5\n640 0\n255\n");
  run_refuses({"zero2.pgm", "--fit", "scale"}, {"zero2.pgm"});
  kit::write_file(*this / "huge.pgm", "P5\n999999999 999999999\n255\n");
  run_refuses({"huge.pgm"}, {"huge.pgm"});
  write("small.png", picture(320, 240));
  run_refuses({"small.png"}, {"small.png", "320x240", "640x480", "--fit crop", "--fit scale"});
  run_refuses({"small.png", "--fit", "crop"}, {"small.png", "too small to crop", "--fit scale"});
  write("tall.jpg", picture(480, 640));
  run_refuses({"z1.0", "tall.jpg"}, {"tall.jpg", "480x640", "--fit"});
  run_refuses({"tall.jpg", "--fit", "crop"}, {"tall.jpg", "too small to crop"});
}

BOOST_AUTO_TEST_CASE(folders) {
  std::filesystem::create_directories(*this / "none/below");
  write("none/below/a.png");
  run_refuses({"none"}, {"'none'", "no images"});
  std::filesystem::create_directory(*this / "mixed");
  write("mixed/1.png");
  kit::write_file(*this / "mixed/2.png", "just text\n");
  run_refuses({"mixed"}, {"2.png"});
  write("mixed/2.png", picture(320, 240));
  run_refuses({"mixed"}, {"2.png", "320x240"});
}

BOOST_AUTO_TEST_CASE(videos_without_frames) {
  kit::write_file(*this / "text.avi", "just text\n");
  run_refuses({"text.avi"}, {"text.avi"});
  kit::write_file(*this / "empty.avi", "");
  run_refuses({"empty.avi"}, {"empty.avi", "empty"});
  write_video("whole.avi", 640, 480);
  for (const std::size_t bytes : {12u, 200u, 2000u}) part_refused("whole.avi", bytes);
  write_video("small.avi", 320, 240);
  run_refuses({"small.avi"}, {"small.avi", "320x240", "--fit"});
}

BOOST_AUTO_TEST_CASE(camera_files) {
  run_refuses({"z1.0", "--camera", "missing.yaml"}, {"missing.yaml"});
  run_refuses({"z1.0", "--camera", "."}, {"'.'"});
  camera_refused("", {"empty"});
  camera_refused("just words\n", {"malformed"});
  camera_refused("camera_matrix: [1, 2\n", {"malformed"});
  camera_refused("image_width: 640\nimage_height: 480\n", {"camera_matrix"});
  camera_refused(calibration("1, 2, 3"), {"3x3"});
  camera_refused(calibration("0, 0, 320, 0, 380, 240, 0, 0, 1"), {"fx, fy > 0"});
  camera_refused(calibration("-380, 0, 320, 0, 380, 240, 0, 0, 1"), {"fx, fy > 0"});
  camera_refused(calibration(".nan, 0, 320, 0, 380, 240, 0, 0, 1"), {"camera_matrix"});
  camera_refused(calibration("380, 5, 320, 0, 380, 240, 0, 0, 1"), {"skew"});
  camera_refused(calibration("380, 0, 320, 0, 380, 240, 0, 0, 1", "image_width: 640\n"),
                 {"image_height"});
  camera_refused(
      calibration("380, 0, 320, 0, 380, 240, 0, 0, 1", "image_width: 800\nimage_height: 600\n"),
      {"800x600", "640x480"});
  camera_refused("%YAML:1.0\n---\ncamera_matrix: !!opencv-matrix\n   rows: 3\n", {});
  camera_refused("<?xml version=\"1.0\"?>\n<opencv_storage><camera_matrix>\n", {});
  camera_refused("{ \"camera_matrix\": [", {});
  write("photo.png");
  run_refuses({"photo.png", "--camera", "photo.png"}, {"photo.png"});
}

/// The images that these tests cut and damage are good themselves.
BOOST_AUTO_TEST_CASE(what_is_right_is_accepted) {
  write("a.png");
  write("b.jpg");
  write("c.pgm");
  write("d.bmp");
  write("e.png", cv::Mat(480, 640, CV_8UC3, cv::Scalar(1, 2, 3)));
  write_video("f.avi", 640, 480);
  const kit::Outcome outcome = start(
      {"run", "a.png", "b.jpg", "c.pgm", "d.bmp", "e.png", "f.avi", "--quiet", "--no-pictures"});
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  BOOST_TEST(contains(outcome.out, "8 frames"), outcome.out);
}

BOOST_AUTO_TEST_SUITE_END()
