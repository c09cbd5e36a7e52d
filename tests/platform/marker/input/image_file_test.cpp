#include <marker/input/image_file.h>

#include <opencv2/imgproc.hpp>

#include "image_kit.h"
#include "temporary_files.h"

using namespace platform::input;
using namespace input_test;
using kit::TemporaryFolder;

namespace {

/// What OpenCV itself makes of the file.
cv::Mat expected(const std::string& path) {
  return cv::imread(path, cv::IMREAD_GRAYSCALE);
}

void check_same_as_opencv(const std::string& path) {
  const auto image = read_image(path);
  BOOST_TEST_REQUIRE(image.has_value(), path);
  BOOST_TEST(same(*image, expected(path)), path << " differs from OpenCV's reading");
  const auto size = inspect_image(path);
  BOOST_TEST_REQUIRE(size.has_value(), path);
  BOOST_TEST(size->width == image->width, path);
  BOOST_TEST(size->height == image->height, path);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(image_file)

BOOST_AUTO_TEST_CASE(every_format_gives_the_pixels_of_opencv) {
  const TemporaryFolder folder;
  for (const char* name : {"g.png", "g.pgm", "g.bmp", "g.tiff", "g.jpg", "g.webp", "g.jp2"}) {
    cv::imwrite(folder / name, pattern(48, 32));
    check_same_as_opencv(folder / name);
  }
}

BOOST_AUTO_TEST_CASE(colour_alpha_and_16_bits_become_grey_as_in_opencv) {
  const TemporaryFolder folder;
  cv::imwrite(folder / "colour.png", pattern(48, 32, CV_8UC3));
  cv::imwrite(folder / "colour.jpg", pattern(48, 32, CV_8UC3));
  cv::imwrite(folder / "colour.ppm", pattern(48, 32, CV_8UC3));
  cv::imwrite(folder / "alpha.png", pattern(48, 32, CV_8UC4));
  cv::imwrite(folder / "deep.png", pattern(48, 32, CV_16UC1));
  cv::imwrite(folder / "deep.pgm", pattern(48, 32, CV_16UC1));
  cv::imwrite(folder / "bits.png", pattern(48, 32) > 128, {cv::IMWRITE_PNG_BILEVEL, 1});
  for (const std::string& name : folder.entries()) check_same_as_opencv(folder / name);
}

BOOST_AUTO_TEST_CASE(floating_point_samples_are_shares_of_white_or_levels) {
  const TemporaryFolder folder;
  const cv::Mat levels = pattern(48, 32);
  const auto write = [&](const char* name, int depth, double scale, double shift = 0) {
    cv::Mat floating;
    levels.convertTo(floating, depth, scale, shift);
    cv::imwrite(folder / name, floating);
    return folder / name;
  };
  BOOST_TEST(same(*read_image(write("shares.tiff", CV_32F, 1.0 / 255)), levels));
  BOOST_TEST(same(*read_image(write("wide.tiff", CV_64F, 1.0 / 255)), levels));
  BOOST_TEST(same(*read_image(write("levels.tiff", CV_32F, 1)), levels));
  for (const std::string& path :
       {write("bright.tiff", CV_32F, 2), write("dark.tiff", CV_32F, 1, -1),
        write("endless.tiff", CV_32F, 1e308 * 10)}) {
    CHECK_REFUSED(read_image(path), "no grey levels: they must be 0 to 1, or 0 to 255");
  }
}

BOOST_AUTO_TEST_CASE(a_camera_is_refused_with_a_way_to_its_pictures) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("/dev/null", folder / "video7");
  CHECK_REFUSED(read_image(folder / "video7"),
                "video7 -frames:v 100 -f yuv4mpegpipe - | markervp run -");
  std::filesystem::create_symlink("/dev/null", folder / "other");
  CHECK_REFUSED(read_image(folder / "other"), "it is a device, and must be a file");
  BOOST_TEST(!contains(refusal([&] { read_image(folder / "other"); }), "ffmpeg"));
}

/// Codecs call them damaged, or give the first picture alone.
BOOST_AUTO_TEST_CASE(images_that_are_not_read_are_refused_by_kind) {
  const TemporaryFolder folder;
  const auto refuses = [&](const char* name, const char* problem) {
    CHECK_REFUSED(read_image(folder / name), problem);
    CHECK_REFUSED(inspect_image(folder / name), problem);
  };
  cv::imwritemulti(folder / "pages.tiff", std::vector<cv::Mat>{pattern(48, 32), pattern(48, 32)});
  refuses("pages.tiff", "is a TIFF with several pages: save each");
  const std::string vp8x("VP8X\x0A\0\0\0\x02\0\0\0\x2F\0\0\x1F\0\0", 18);
  kit::write_file(folder / "moves.webp", "RIFF" + std::string("\x16\0\0\0", 4) + "WEBP" + vp8x);
  refuses("moves.webp", "is an animated WebP: save its pictures one by one");
  cv::imwrite(folder / "a.png", pattern(48, 32));
  std::string png = kit::read_file(folder / "a.png");
  const std::string control(
      "\0\0\0\x08"
      "acTL"
      "\0\0\0\x01\0\0\0\0",
      16);
  png.insert(33, control + std::string("\xB4\x2D\xE9\xA0", 4));
  kit::write_file(folder / "moves.png", png);
  refuses("moves.png", "is an animated PNG: save its pictures one by one");
}

BOOST_AUTO_TEST_CASE(plain_files_hold_the_pixels_exactly) {
  const TemporaryFolder folder;
  const cv::Mat picture = pattern(640, 480);
  cv::imwrite(folder / "a.png", picture);
  kit::write_file(folder / "a.pgm",
                  "P5\n# a comment\n640 480\n255\n" +
                      std::string(reinterpret_cast<const char*>(picture.ptr()), picture.total()));
  BOOST_TEST(same(*read_image(folder / "a.png"), picture));
  BOOST_TEST(same(*read_image(folder / "a.pgm"), picture));
}

BOOST_AUTO_TEST_CASE(missing_empty_and_unreadable_files_are_refused) {
  const TemporaryFolder folder;
  kit::write_file(folder / "empty.png", "");
  CHECK_REFUSED(read_image(folder / "missing.png"), "No such file");
  CHECK_REFUSED(read_image(folder / "empty.png"), "is empty");
  CHECK_REFUSED(read_image(folder.path()), "cannot be read");
}

BOOST_AUTO_TEST_CASE(truncated_files_are_refused_at_any_length) {
  const TemporaryFolder folder;
  for (const char* name :
       {"a.png", "a.pgm", "a.bmp", "a.tiff", "a.jpg", "a.webp", "a.jp2", "a.ppm"}) {
    const std::string whole = folder / name;
    cv::imwrite(whole, pattern(64, 64, std::string(name) == "a.ppm" ? CV_8UC3 : CV_8UC1));
    const std::size_t size = std::filesystem::file_size(whole);
    for (const std::size_t kept : {size - 20, size * 9 / 10, size / 2, size / 4}) {
      const std::string part = folder / (std::string("part_") + name);
      kit::write_part(whole, part, kept);
      CHECK_REFUSED(read_image(part), part);
      CHECK_REFUSED(inspect_image(part), part);
    }
  }
}

BOOST_AUTO_TEST_CASE(damage_inside_is_refused) {
  const TemporaryFolder folder;
  cv::imwrite(folder / "a.png", pattern(64, 64));
  cv::imwrite(folder / "a.jpg", pattern(64, 64), {cv::IMWRITE_JPEG_RST_INTERVAL, 1});
  std::string png = kit::read_file(folder / "a.png");
  png[png.size() / 2] ^= 0x10;
  kit::write_file(folder / "b.png", png);
  CHECK_REFUSED(read_image(folder / "b.png"), "checksum of its part 'IDAT'");
  // Without its middle the JPEG still has its end marker.
  const std::string jpeg = kit::read_file(folder / "a.jpg");
  kit::write_file(folder / "b.jpg",
                  jpeg.substr(0, jpeg.size() / 2) + jpeg.substr(jpeg.size() - 30));
  CHECK_REFUSED(read_image(folder / "b.jpg"), "damaged or truncated");
}

BOOST_AUTO_TEST_CASE(images_without_pixels_are_refused) {
  const TemporaryFolder folder;
  kit::write_file(folder / "zero.pgm", "P5 0 480 255\n");
  CHECK_REFUSED(inspect_image(folder / "zero.pgm"), "its size is zero");
  cv::imwrite(folder / "a.png", pattern(8, 8));
  std::string png = kit::read_file(folder / "a.png");
  // Width 0, with the checksum of that header.
  const std::string header("\0\0\0\0\0\0\0\x08\x08\0\0\0\0\xED\xA4\x9E\x04", 17);
  png.replace(16, header.size(), header);
  kit::write_file(folder / "zero.png", png);
  CHECK_REFUSED(inspect_image(folder / "zero.png"), "zero.png");
}

BOOST_AUTO_TEST_CASE(a_file_that_is_no_image_is_none) {
  const TemporaryFolder folder;
  kit::write_file(folder / "text.png", "this is a text, whatever its name says\n");
  BOOST_TEST(!read_image(folder / "text.png").has_value());
}

BOOST_AUTO_TEST_SUITE_END()
