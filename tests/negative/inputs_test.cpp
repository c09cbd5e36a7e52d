// Images, folders, videos, scenes and camera files that cannot be used.
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

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

  /// A good image that is refused when `edit` has changed its bytes.
  template <typename Edit>
  void too_large(const std::string& name, Edit edit) const {
    write(name);
    std::string bytes = kit::read_file(*this / name);
    edit(bytes);
    kit::write_file(*this / name, bytes);
    run_refuses({name}, {name, "more pixels than 8192x8192"});
    run_refuses({name, "--fit", "scale"}, {name, "more pixels than 8192x8192"});
  }

  void make_fifo(const std::string& name) const {
    BOOST_TEST_REQUIRE(::mkfifo((*this / name).c_str(), 0600) == 0);
  }

  /// A file of 1 TiB that occupies no more than its beginning.
  void write_gigantic(const std::string& name, const std::string& beginning) const {
    kit::write_file(*this / name, beginning);
    std::filesystem::resize_file(*this / name, std::uintmax_t{1} << 40);
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

/// A number of `size` bytes, the lowest one first.
std::string little_endian(std::uint32_t value, std::size_t size = 4) {
  std::string bytes;
  for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(value >> 8 * i);
  return bytes;
}

std::string big_endian(std::uint32_t value, std::size_t size = 4) {
  const std::string bytes = little_endian(value, size);
  return {bytes.rbegin(), bytes.rend()};
}

/// Replaces what is `offset` bytes after `mark`.
void replace_after(std::string& bytes, const std::string& mark, std::ptrdiff_t offset,
                   const std::string& with) {
  const std::size_t at = bytes.find(mark);
  BOOST_TEST_REQUIRE(at != std::string::npos);
  bytes.replace(at + mark.size() + static_cast<std::size_t>(offset), with.size(), with);
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

/// A few bytes that claim the memory of the machine.
BOOST_AUTO_TEST_CASE(absurd_sizes) {
  constexpr std::uint32_t side = 100'000;
  too_large("a.png", [](std::string& bytes) {
    replace_after(bytes, "IHDR", 0, big_endian(side) + big_endian(side));
    replace_after(bytes, "IHDR", 8, std::string("\x08\0\0\0\0", 5) + big_endian(0x8D395414));
  });
  too_large("b.jpg", [](std::string& bytes) {
    replace_after(bytes, "\xFF\xC0", 3, big_endian(65000, 2) + big_endian(65000, 2));
  });
  too_large("c.bmp", [](std::string& bytes) {
    bytes.replace(18, 8, little_endian(10'000) + little_endian(10'000));
  });
  too_large("d.tiff", [](std::string& bytes) {
    for (const char tag : {'\x00', '\x01'}) {  // ImageWidth, ImageLength: SHORT becomes LONG
      const std::string number{tag, '\x01'};
      const std::string one{'\0', '\x01', '\0', '\0', '\0'};
      replace_after(bytes, number + '\x03' + one, 0, little_endian(side));
      replace_after(bytes, number + '\x03' + one, -6, "\x04");
    }
  });
  too_large("e.webp", [](std::string& bytes) {
    replace_after(bytes, "VP8L", 5, "\xFF\xFF\xFF");
    replace_after(bytes, "VP8L", 8, std::string(1, static_cast<char>(bytes[24] | 0x0F)));
  });
  too_large("f.jp2", [](std::string& bytes) {
    replace_after(bytes, "ihdr", 0, big_endian(side) + big_endian(side));
    replace_after(bytes, "\xFF\x51", 4, big_endian(side) + big_endian(side));
  });
  kit::write_file(*this / "g.ppm", "P6\n100000 100000\n255\n");
  run_refuses({"g.ppm"}, {"g.ppm", "more pixels than 8192x8192"});
  kit::write_file(*this / "h.y4m", "YUV4MPEG2 W10000 H10000 F25:1 Ip A1:1 C420jpeg\nFRAME\n");
  run_refuses({"h.y4m"}, {"video 'h.y4m'", "more pixels than 8192x8192"});
}

/// A pass over all pixels of a progressive JPEG takes 10 ms and ten bytes of the file.
BOOST_AUTO_TEST_CASE(endless_passes) {
  BOOST_TEST_REQUIRE(cv::imwrite(*this / "good.jpg", picture(), {cv::IMWRITE_JPEG_PROGRESSIVE, 1}));
  std::string bytes = kit::read_file(*this / "good.jpg");
  const std::size_t last = bytes.rfind("\xFF\xDA");
  const std::string pass = bytes.substr(last, bytes.size() - last - 2);
  for (int i = 0; i < 200; ++i) bytes.insert(last, pass);
  kit::write_file(*this / "bad.jpg", bytes);
  run_refuses({"bad.jpg"}, {"bad.jpg", "passes"});
}

BOOST_AUTO_TEST_CASE(what_is_no_regular_file) {
  make_fifo("pipe.png");
  run_refuses({"pipe.png"}, {"pipe.png", "a FIFO"});
  run_refuses({"/dev/zero"}, {"/dev/zero", "a device"});
  const int descriptor = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string socket = *this / "socket.png";
  socket.copy(address.sun_path, sizeof address.sun_path - 1);
  BOOST_TEST_REQUIRE(
      ::bind(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
  run_refuses({"socket.png"}, {"socket.png", "a socket"});
  ::close(descriptor);
  std::filesystem::create_symlink("loop.png", *this / "loop.png");
  run_refuses({"loop.png"}, {"loop.png", "symbolic links"});
}

BOOST_AUTO_TEST_CASE(what_is_no_regular_file_in_a_folder) {
  std::filesystem::create_directory(*this / "mixed");
  write("mixed/1.png");
  const std::string odd = *this / "mixed/2.png";
  make_fifo("mixed/2.png");
  run_refuses({"mixed"}, {"2.png", "a FIFO"});
  for (const char* target : {"2.png", "gone.png", "/dev/zero", "."}) {
    std::filesystem::remove(odd);
    std::filesystem::create_symlink(target, odd);
    run_refuses({"mixed"}, {"2.png", "cannot be read"});
  }
}

BOOST_AUTO_TEST_CASE(gigantic_files) {
  write_gigantic("a.png", std::string("\x89PNG\r\n\x1A\n", 8));
  run_refuses({"a.png"}, {"a.png", "512 MiB"});
  write_gigantic("b.bmp", "BM");
  run_refuses({"b.bmp"}, {"b.bmp", "512 MiB"});
  write_gigantic("c.dat", "");
  run_refuses({"c.dat"}, {"c.dat", "neither an image nor a video"});
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

/// Playlists name other files and addresses, which are not opened.
BOOST_AUTO_TEST_CASE(videos_that_name_other_files) {
  make_fifo("pipe.avi");
  kit::write_file(*this / "a.avi", "ffconcat version 1.0\nfile pipe.avi\n");
  kit::write_file(*this / "b.m3u8",
                  "#EXTM3U\n#EXT-X-TARGETDURATION:10\n#EXTINF:9,\npipe.avi\n#EXT-X-ENDLIST\n");
  kit::write_file(*this / "c.sdp",
                  "v=0\no=- 0 0 IN IP4 127.0.0.1\ns=x\nc=IN IP4 127.0.0.1\nt=0 0\n"
                  "m=video 5004 RTP/AVP 26\n");
  for (const char* file : {"a.avi", "b.m3u8", "c.sdp"}) {
    run_refuses({file}, {file, "neither an image nor a video"});
  }
}

/// What codecs say of a damaged picture between good ones goes nowhere.
BOOST_AUTO_TEST_CASE(a_damaged_video_is_quiet) {
  write_video("whole.avi", 640, 480);
  std::string bytes = kit::read_file(*this / "whole.avi");
  const std::size_t pictures = bytes.find("movi");
  const std::size_t second = bytes.find("00dc", bytes.find("00dc", pictures) + 4);
  bytes.replace(second + 1000, 3000, std::string(3000, '\xFF'));
  kit::write_file(*this / "bad.avi", bytes);
  const kit::Outcome outcome = start({"run", "bad.avi", "--quiet", "--no-pictures"});
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  check_one_line(outcome.err, {"warning: no --camera"});
}

BOOST_AUTO_TEST_CASE(camera_files) {
  run_refuses({"z1.0", "--camera", "missing.yaml"}, {"missing.yaml"});
  run_refuses({"z1.0", "--camera", "."}, {"'.'"});
  camera_refused("", {"empty"});
  camera_refused("just words\n", {"no entries in YAML"});
  camera_refused("camera_matrix: [1, 2\n", {"is not YAML"});
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
