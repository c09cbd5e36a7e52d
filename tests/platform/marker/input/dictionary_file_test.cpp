#include <marker/input/dictionary_file.h>

#include <opencv2/aruco/dictionary.hpp>
#include <string>
#include <vector>

#include "image_kit.h"
#include "temporary_files.h"

using namespace platform::input;
using namespace input_test;
using kit::TemporaryFolder;

namespace {

OwnDictionary read(const std::string& text, const std::string& name = "rover.yml") {
  const TemporaryFolder folder;
  kit::write_file(folder / name, text);
  return read_dictionary_file(folder / name);
}

std::string why(const std::string& text, const std::string& name = "rover.yml") {
  return refusal([&] { read(text, name); });
}

bool says(const std::string& message, const std::string& part) {
  return message.rfind("dictionary '", 0) == 0 && message.find(part) != std::string::npos;
}

/// A text with one part in place of another.
std::string with(std::string text, const std::string& part, const std::string& other) {
  const std::size_t at = text.find(part);
  BOOST_TEST_REQUIRE(at != std::string::npos);
  return text.replace(at, part.size(), other);
}

const std::string storage =
    "%YAML:1.0\n---\nnmarkers: 2\nmarkersize: 3\nmaxCorrectionBits: 1\nmarker_0: \"011111111\"\n"
    "marker_1: \"110001010\"\n";

/// A family of version 3 with 3 × 3 cells inside of a border two cells wide, its bits by quadrant.
const std::string family =
    "#include \"apriltag.h\" /* codedata[9] = {1} */\nstatic uint64_t codedata[2] = {\n"
    "   0x0ffUL, // not 0x1ff\n   0x00000000000001a4UL\n};\napriltag_family_t *tag9_create()\n{\n"
    "   tf->ncodes = 2;\n   tf->codes = codedata;\n   tf->nbits = 9;\n"
    "   tf->bit_x = calloc(9, sizeof(uint32_t));\n"
    "   tf->bit_x[0] = 2;\n   tf->bit_y[0] = 2;\n   tf->bit_x[1] = 3;\n   tf->bit_y[1] = 2;\n"
    "   tf->bit_x[2] = 4;\n   tf->bit_y[2] = 2;\n   tf->bit_x[3] = 4;\n   tf->bit_y[3] = 3;\n"
    "   tf->bit_x[4] = 4;\n   tf->bit_y[4] = 4;\n   tf->bit_x[5] = 3;\n   tf->bit_y[5] = 4;\n"
    "   tf->bit_x[6] = 2;\n   tf->bit_y[6] = 4;\n   tf->bit_x[7] = 2;\n   tf->bit_y[7] = 3;\n"
    "   tf->bit_x[8] = 3;\n   tf->bit_y[8] = 3;\n   tf->width_at_border = 7;\n"
    "   tf->reversed_border = false;\n}\n";

}  // namespace

BOOST_AUTO_TEST_SUITE(dictionary_file)

BOOST_AUTO_TEST_CASE(as_opencv_writes_it) {
  const std::vector<std::uint64_t> words{0b100000000, 0b001110101};
  for (const std::string& text :
       {storage,
        std::string("<?xml version=\"1.0\"?>\n<opencv_storage>\n<tags><nmarkers>2</nmarkers>"
                    "<markersize>3</markersize><marker_0>\"011111111\"</marker_0>"
                    "<marker_1>\"110001010\"</marker_1></tags>\n</opencv_storage>\n"),
        std::string("{\"nmarkers\": 2, \"markersize\": 3, \"marker_0\": \"011111111\", "
                    "\"marker_1\": \"110001010\"}")}) {
    const OwnDictionary own = read(text);
    BOOST_TEST(own.name == "rover");
    BOOST_TEST(own.cells == 3u);
    BOOST_TEST(own.border == 0u);
    BOOST_TEST(own.distance == 2u);
    BOOST_TEST(own.words == words, boost::test_tools::per_element());
    BOOST_TEST(as_dictionary(own).words == own.words.data());
  }
}

// Its members, which programs wrote before it had writeDictionary(): the last byte is not full.
BOOST_AUTO_TEST_CASE(the_bytes_of_opencvs_own_dictionaries) {
  for (const int which : {cv::aruco::DICT_4X4_50, cv::aruco::DICT_5X5_50, cv::aruco::DICT_7X7_50}) {
    const auto theirs = cv::aruco::getPredefinedDictionary(which);
    cv::FileStorage out(".yml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
    out << "MarkerSize" << theirs->markerSize << "ByteList" << theirs->bytesList;
    const std::string text = out.releaseAndGetString();
    const OwnDictionary own = read(text);
    const marker::Dictionary& known = marker::dictionaries[static_cast<std::size_t>(which)];
    BOOST_TEST(own.cells == known.cells);
    BOOST_TEST(own.distance == known.distance);
    BOOST_TEST(own.words == std::vector<std::uint64_t>(known.words, known.words + known.size),
               boost::test_tools::per_element());
    BOOST_TEST(says(why(with(text, "MarkerSize: ", "MarkerSize: 6 #")), "bytes a marker"));
  }
  const std::string bytes =
      "MarkerSize: 3\nByteList: !!opencv-matrix\n   rows: 1\n   cols: 2\n   dt: \"4u\"\n"
      "   data: [ 127, 1, 221, 1, 255, 0, 119, 1 ]\n";
  BOOST_TEST(read(bytes).words.front() == 0b100000000u);
  BOOST_TEST(says(why(with(bytes, "255, 0", "255, 1")), "the turns of marker 0"));
  BOOST_TEST(says(why(with(bytes, "255, 0", "256, 0")), "bytes a marker"));
}

BOOST_AUTO_TEST_CASE(a_family_of_apriltags) {
  const OwnDictionary own = read(family, "tag9.c");
  BOOST_TEST(own.border == 2u);
  BOOST_TEST(own.cells == 3u);
  // The first bit is the top left cell, the last the middle; 1 = white.
  BOOST_TEST(own.words[0] == 0b100000000u);
  BOOST_TEST(own.words[1] == 0b001110011u);
  const std::string old =
      "apriltag_family_t *tf = calloc(1, sizeof(apriltag_family_t));\n   tf->black_border = 1;\n"
      "   tf->d = 3;\n   tf->ncodes = 2;\n   tf->codes = calloc(2, sizeof(uint64_t));\n"
      "   tf->codes[0] = 0x00000000000000ffUL;\n   tf->codes[1] = 0x000000000000018aUL;\n";
  const std::vector<std::uint64_t> words{0b100000000, 0b001110101};
  BOOST_TEST(read(old, "tag9.c").words == words, boost::test_tools::per_element());
  BOOST_TEST(read(old, "tag9.c").border == 1u);
  BOOST_TEST(says(why(with(old, "codes[1] =", "codes[2] =")), "no codes[1]"));
  BOOST_TEST(says(why(with(old, "0x000000000000018a", "0x200")), "more than its cells' bits"));
  BOOST_TEST(says(why(with(old, "tf->d = 3", "tf->d = 8")), "8 cells a side: 3 to 7 are read"));
}

BOOST_AUTO_TEST_CASE(families_that_have_cells_outside_of_their_border) {
  const std::string reason = "no square inside of a black border";
  for (const auto& [part, other] : std::vector<std::pair<std::string, std::string>>{
           {"bit_x[0] = 2", "bit_x[0] = -2"},
           {"bit_x[0] = 2", "bit_x[0] = 3"},
           {"bit_y[8] = 3", "bit_y[8] = 5"},
           {"bit_y[8] = 3", "bit_y[9] = 3"},
           {"bit_y[8] = 3;", "bit_y[8] = 9223372036854775807;"},
           {"width_at_border = 7", "width_at_border = 9"},
           {"width_at_border = 7", "width_at_border = 4"}}) {
    BOOST_TEST(says(why(with(family, part, other)), reason), other);
  }
  BOOST_TEST(
      says(why(with(family, "ncodes = 2", "ncodes = 3")), "2 codes, although 'ncodes' is 3"));
}

BOOST_AUTO_TEST_CASE(distances_are_those_of_known_dictionaries) {
  for (const marker::Dictionary& known : marker::dictionaries) {
    if (known.size > 300) continue;
    std::string text = "markersize: " + std::to_string(known.cells) +
                       "\nnmarkers: " + std::to_string(known.size) + "\n";
    for (std::uint32_t id = 0; id < known.size; ++id) {
      text += "marker_" + std::to_string(id) + ": \"";
      for (std::uint32_t cell = known.cells * known.cells; cell-- > 0;)
        text += (known.words[id] >> cell & 1U) != 0 ? '0' : '1';
      text += "\"\n";
    }
    BOOST_TEST(read(text).distance == known.distance, known.name);
  }
  // The first row of two is black: half a turn makes the other one of it, and the second one
  // itself.
  BOOST_TEST(read("markersize: 3\nnmarkers: 1\nmarker_0: \"000111000\"\n").distance == 1u);
}

BOOST_AUTO_TEST_CASE(markers_that_cannot_be_told_apart) {
  BOOST_TEST(says(why(with(storage, "110001010", "011111111")),
                  "markers 0 and 1 are the same one, or one is the other turned"));
  BOOST_TEST(says(why(with(storage, "110001010", "110111111")), "their distance is 0"));
  BOOST_TEST(says(why(with(storage, "110001010", "000000000")), "marker 1 is black all over"));
}

BOOST_AUTO_TEST_CASE(files_that_are_no_dictionary) {
  std::string many = "nmarkers: 1025\nmarkersize: 7\n";
  for (unsigned id = 0; id < 1025; ++id) {
    std::string bits(49, '1');
    for (unsigned bit = 0; bit < 11; ++bit) bits[bit] = (id >> bit & 1U) != 0 ? '1' : '0';
    many += "marker_" + std::to_string(id) + ": \"" + bits + "\"\n";
  }
  for (const auto& [text, reason] : std::vector<std::pair<std::string, std::string>>{
           {"", "no entries in YAML, XML or JSON"},
           {"just words", "no entries in YAML, XML or JSON"},
           {std::string("a\0b", 3), "no text"},
           {"a: 1\n", "no entry 'markersize': give what OpenCV's"},
           {with(storage, "nmarkers: 2", "nmarkers: 3"), "no entry 'marker_2'"},
           {with(storage, "nmarkers: 2", "nmarkers: 1"), "'marker_1', although 'nmarkers' is 1"},
           {with(storage, "nmarkers: 2", "nmarkers: -1"), "'nmarkers' is no number"},
           {with(storage, "nmarkers: 2", "nmarkers: [2, 3]"), "'nmarkers' is no number"},
           {"nmarkers: 0\nmarkersize: 5\n", "no words"},
           {with(storage, "markersize: 3", "markersize: 2"), "2 cells a side: 3 to 7 are read"},
           {with(storage, "markersize: 3", "markersize: 2.5"), "'markersize' is no number"},
           {with(storage, "110001010", "11000101"), "'marker_1' is not 9 times 0 or 1"},
           {with(storage, "110001010", "11000101x"), "'marker_1' is not 9 times 0 or 1"},
           {storage + "more:\n  nmarkers: 2\n", "more than one entry 'nmarkers'"},
           {many, "1025 words: a program has room for 1024"}}) {
    BOOST_TEST(says(why(text), reason), reason);
  }
  BOOST_TEST(
      refusal([] { read_dictionary_file("/nowhere/a.yml"); }).find("cannot read dictionary") == 0u);
}

BOOST_AUTO_TEST_SUITE_END()
