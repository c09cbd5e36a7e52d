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

/// libtiff decodes them to black, and only says so.
BOOST_AUTO_TEST_CASE(tiff_files_that_cannot_be_decompressed_are_refused) {
  const TemporaryFolder folder;
  constexpr int none = 1, lzw = 5, deflate = 8;
  for (const int compression : {lzw, deflate}) {
    const std::string path = folder / "a.tiff";
    cv::imwrite(path, pattern(48, 32), {cv::IMWRITE_TIFF_COMPRESSION, compression});
    std::string bytes = kit::read_file(path);
    constexpr std::size_t data = 8, length = 40;
    bytes.replace(data, length, length, '\x55');
    kit::write_file(path, bytes);
    CHECK_REFUSED(read_image(path), "is damaged or truncated");
  }
  const std::string path = folder / "unknown.tiff";
  cv::imwrite(path, pattern(48, 32), {cv::IMWRITE_TIFF_COMPRESSION, none});
  std::string bytes = kit::read_file(path);
  const std::size_t tag = bytes.find(std::string("\x03\x01\x03\0\x01\0\0\0\x01\0", 10));
  BOOST_TEST_REQUIRE(tag != bytes.npos);
  bytes.replace(tag + 8, 2, "\xE7\x03");  // 999
  kit::write_file(path, bytes);
  CHECK_REFUSED(read_image(path), "is damaged or truncated");
  // What can be decompressed is read after that as before.
  cv::imwrite(path, pattern(48, 32), {cv::IMWRITE_TIFF_COMPRESSION, lzw});
  check_same_as_opencv(path);
}

BOOST_AUTO_TEST_CASE(tiff_samples_of_other_sizes_are_refused_by_kind) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.tiff";
  cv::imwrite(path, pattern(48, 32));
  const std::string whole = kit::read_file(path);
  const std::size_t tag = whole.find(std::string("\x02\x01\x03\0\x01\0\0\0\x08\0", 10));
  BOOST_TEST_REQUIRE(tag != whole.npos);
  for (const char bits : {2, 4, 12, 32}) {
    std::string bytes = whole;
    bytes[tag + 8] = bits;
    kit::write_file(path, bytes);
    CHECK_REFUSED(read_image(path),
                  "is a TIFF with samples of " + std::to_string(int{bits}) + " bits: save it");
  }
}

/// 10 bits of a camera, for example.
BOOST_AUTO_TEST_CASE(samples_of_a_pgm_are_shares_of_its_maximum) {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& content) {
    kit::write_file(folder / "a.pgm", content);
    return read_image(folder / "a.pgm")->pixels;
  };
  const auto is = [](const std::vector<std::uint8_t>& pixels, std::vector<std::uint8_t> expected) {
    return pixels == expected;
  };
  BOOST_TEST(is(read(std::string("P5 3 1 1023\n\0\0\x02\0\x03\xFF", 18)), {0, 128, 255}));
  BOOST_TEST(is(read(std::string("P5 3 1 100\n\0\x32\x64", 14)), {0, 128, 255}));
  BOOST_TEST(is(read(std::string("P5 2 1 1\n\0\x01", 11)), {0, 255}));
  BOOST_TEST(is(read(std::string("P5 2 1 65535\n\x80\0\xFF\xFF", 17)), {128, 255}));
  CHECK_REFUSED(read(std::string("P5 2 1 100\n\x64\x65", 13)), "is damaged");
  CHECK_REFUSED(read("P5 2 1 0\n\x64\x65"), "its brightest sample is 0: it must be 1 to 65535");
  CHECK_REFUSED(read("P5 1 1 65536\n\x64\x65\x64"), "its brightest sample is 65536: it must be");
  CHECK_REFUSED(read("P2 2 1 100\n50 100\n"), "is 100: save it with 255 or 65535");
  CHECK_REFUSED(read("P6 1 1 1023\n\x01\x01\x01\x01\x01\x01"), "is 1023: save it with 255");
  BOOST_TEST(is(read("P2 2 1 255\n50 255\n"), {50, 255}));
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
