// The command `compare-detectors`, and `scenes --output`, which feeds it.
#include <boost/test/unit_test.hpp>

#include <filesystem>
#include <nlohmann/json.hpp>

#include <marker/picture/picture.h>
#include <marker/scene/grey_image.h>

#include "child_process.h"
#include "temporary_files.h"

namespace {

using Json = nlohmann::json;

struct Terminal {
  int run(const std::vector<std::string>& arguments) {
    const kit::Outcome outcome = kit::run_process(MARKERVP_EXECUTABLE, arguments, folder.path());
    out = outcome.out;
    err = outcome.err;
    return outcome.exit_code;
  }
  int compare(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "compare-detectors");
    arguments.insert(arguments.end(), {"-o", "found"});
    return run(arguments);
  }
  std::string file(const std::string& name) { return kit::read_file(folder / name); }
  Json result() { return Json::parse(file("found/detectors.json")); }
  Json of(const std::string& detector) {
    const Json all = result();
    for (const Json& entry : all["detectors"])
      if (entry["name"] == detector) return entry;
    return {};
  }
  bool refused(const std::string& why) {
    return err.rfind("markervp: ", 0) == 0 && err.find(why) != std::string::npos;
  }

  kit::TemporaryFolder folder;
  std::string out, err;
};

void write_image(const std::string& path, int width, int height) {
  const auto size = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  kit::write_file(
      path, platform::picture::encode_png({width, height, std::vector<std::uint8_t>(size, 128)}));
}

/// Two markers of a dictionary of one's own, 5 × 5 cells, 1 = white.
const std::string own_words[] = {"1101100101011101010011011", "0110111100100110111010001"};

/// One of them, inside of a border two cells wide, 18 px a cell.
std::string drawn(const std::string& word) {
  platform::GreyImage image{640, 480, std::vector<std::uint8_t>(std::size_t{640} * 480, 220)};
  for (std::size_t y = 0; y < 9 * 18; ++y) {
    for (std::size_t x = 0; x < 9 * 18; ++x) {
      const std::size_t row = y / 18 - 2, column = x / 18 - 2;
      const bool is_code = row < 5 && column < 5;
      if (!is_code || word[row * 5 + column] == '0') image.pixels[(y + 100) * 640 + x + 200] = 30;
    }
  }
  return platform::picture::encode_png(image);
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(compare_detectors, Terminal)

BOOST_AUTO_TEST_CASE(all_that_take_the_images_are_compared_with_the_truth_of_the_scenes) {
  BOOST_TEST(compare({"z1.0", "roll30", "--markdown", "page/table.md"}) == 0, err);
  for (const char* name : {"thesis", "ps-only", "improved", "opencv", "opencv-subpix",
                           "opencv-apriltag", "apriltag3"}) {
    BOOST_TEST_CONTEXT(name) {
      BOOST_TEST(of(name)["found"] == 2);
      BOOST_TEST(of(name)["markers"] == 2);
      BOOST_TEST(double(of(name)["corner_px"]) < 2);
    }
  }
  BOOST_TEST(result()["left_out"][0]["design"] == "hd");
  BOOST_TEST(double(of("improved")["corner_px"]) < double(of("opencv-subpix")["corner_px"]));
  BOOST_TEST(double(of("improved")["chip_fps"]) > double(of("thesis")["chip_fps"]));
  BOOST_TEST(!of("opencv").contains("chip_fps"));
  BOOST_TEST(
      out.find("hd                left out: it takes images of 1280x720 px") != std::string::npos,
      out);
  BOOST_TEST(file("page/table.md").find("| `improved` | 2 |") != std::string::npos);
  BOOST_TEST(file("found/report.html").find("\"improved\"") != std::string::npos);
  BOOST_TEST(run({"report", "found"}) == 0, err);
}

BOOST_AUTO_TEST_CASE(the_same_again_but_for_the_time_of_this_computer) {
  BOOST_TEST(compare({"z1.0", "--design", "improved", "--no-report"}) == 0, err);
  Json first = result();
  const std::string detections = file("found/detections.csv");
  BOOST_TEST(compare({"z1.0", "--design", "improved", "--no-report"}) == 0, err);
  Json second = result();
  first.erase("host_ms");
  second.erase("host_ms");
  BOOST_TEST((first == second));
  BOOST_TEST(file("found/detections.csv") == detections);
}

BOOST_AUTO_TEST_CASE(each_of_several_markers_is_judged) {
  BOOST_TEST(compare({"z2.0@markers=10", "--design", "improved", "--no-report"}) == 0, err);
  BOOST_TEST(of("improved")["markers"] == 10);
  BOOST_TEST(of("improved")["found"] == 10);
  BOOST_TEST(of("improved")["false"] == 0);
  BOOST_TEST(double(of("improved")["translation_mm"]) < 5);
}

// A design that is not ready for an image finds nothing in it, and the comparison says why.
BOOST_AUTO_TEST_CASE(images_that_a_design_dropped_are_told) {
  const std::string many = "z2.5@markers=15";
  BOOST_TEST(compare({many, many, many, many, "--design", "improved", "--no-report"}) == 0, err);
  const std::string usual = of("improved")["description"];
  BOOST_TEST(usual.find("dropped") == std::string::npos);
  BOOST_TEST(compare({many, many, many, many, "--design", "improved", "--no-report", "--set",
                      "camera.rate=320 fps"}) == 0,
             err);
  const std::string told = of("improved")["description"];
  BOOST_TEST(told == usual + "; dropped 2 of 4 images, which came at 320 a second");
  BOOST_TEST(out.find(told) != std::string::npos, out);
}

BOOST_AUTO_TEST_CASE(a_folder_brings_its_truth) {
  BOOST_TEST(run({"scenes", "z1.0@noise=0.02", "-o", "noisy"}) == 0, err);
  BOOST_TEST(out == "wrote 1 image and truth.json in noisy\n");
  BOOST_TEST(compare({"noisy", "--design", "improved"}) == 0, err);
  BOOST_TEST(of("improved")["found"] == 1);
  BOOST_TEST(double(of("improved")["corner_px"]) < 0.1);
  BOOST_TEST(result()["images"] == Json::array({"z1.0@noise=0.02.png"}));

  // The same image without: no errors are reported, and nothing is called false.
  BOOST_TEST(run({"scenes", "z1.0", "-o", "plain"}) == 0, err);
  std::filesystem::remove(folder / "plain/truth.json");
  BOOST_TEST(compare({"plain", "--design", "improved"}) == 0, err);
  BOOST_TEST(of("improved")["seen"] == 1);
  for (const char* key : {"found", "false", "corner_px"}) BOOST_TEST(!of("improved").contains(key));

  // IDs that cannot be in it.
  kit::write_file(folder / "ids.json", R"({"schema": 1, "ids": [77]})");
  BOOST_TEST(compare({"plain", "--design", "improved", "--truth", "ids.json"}) == 0, err);
  BOOST_TEST(of("improved")["false"] == 1);
}

// The designs and the libraries look for the same ones.
BOOST_AUTO_TEST_CASE(markers_of_ones_own_are_found_by_all) {
  kit::write_file(folder / "own.yml", "nmarkers: 2\nmarkersize: 5\nmarker_0: \"" + own_words[0] +
                                          "\"\nmarker_1: \"" + own_words[1] + "\"\n");
  kit::write_file(folder / "a.png", drawn(own_words[1]));
  kit::write_file(folder / "truth.json", R"({"schema": 1, "images": {"a.png": [{"id": 1}]}})");
  std::vector<std::string> own{"a.png", "--set", "sw.dictionary_file=own.yml", "--no-report"};
  const auto with = [&](const std::string& setting) {
    std::vector<std::string> arguments = own;
    arguments.insert(arguments.end(), {"--set", setting});
    return arguments;
  };
  BOOST_TEST(compare(with("sw.border_bits=2")) == 0, err);
  BOOST_TEST(result()["dictionary"] == "own");
  for (const char* name : {"improved", "careful", "opencv", "opencv-subpix", "apriltag3"})
    BOOST_TEST(of(name)["found"] == 1, name);
  BOOST_TEST(of("thesis").is_null(), "it reads no others");
  BOOST_TEST(compare(with("sw.border_bits=1")) == 0, err);
  BOOST_TEST(of("improved")["seen"] == 0);
  own.insert(own.end(), {"--design", "improved"});
  BOOST_TEST(compare(with("sw.border_bits=3")) == 2);
  BOOST_TEST(refused("a border of 3 cells around codes of 5x5"), err);
  BOOST_TEST(compare(with("sw.dictionary=4x4_50")) == 2);
  BOOST_TEST(refused("sw.dictionary and sw.dictionary_file are both set"), err);
  kit::write_file(folder / "own.yml", "nmarkers: 2\nmarkersize: 5\nmarker_0: \"" + own_words[0] +
                                          "\"\nmarker_1: \"" + own_words[0] + "\"\n");
  BOOST_TEST(compare(own) == 2);
  BOOST_TEST(refused("markers 0 and 1 are the same one"), err);
  BOOST_TEST(compare({"a.png", "--design", "improved", "--set", "sw.dictionary_file=own"}) == 2);
  BOOST_TEST(refused("'own' has no extension: give its name one"), err);
}

BOOST_AUTO_TEST_CASE(images_of_another_size_are_for_the_designs_that_take_them) {
  write_image(folder / "big.png", 1280, 720);
  BOOST_TEST(compare({"big.png"}) == 0, err);
  BOOST_TEST(of("hd")["seen"] == 0);
  BOOST_TEST(of("improved").is_null());
  BOOST_TEST(compare({"big.png", "--fit", "scale", "--design", "improved"}) == 0, err);
  BOOST_TEST(of("improved")["seen"] == 0);
}

BOOST_AUTO_TEST_CASE(another_dictionary_leaves_out_who_cannot_read_it) {
  BOOST_TEST(compare({"z1.0", "--set", "sw.dictionary=apriltag_36h11", "--no-report"}) == 0, err);
  BOOST_TEST(result()["dictionary"] == "apriltag_36h11");
  BOOST_TEST(of("thesis").is_null());
  BOOST_TEST(of("improved")["found"] == 0);
  BOOST_TEST(of("apriltag3")["found"] == 0);
}

BOOST_AUTO_TEST_CASE(bad_input_is_refused) {
  std::filesystem::create_directory(folder / "empty");
  std::filesystem::create_directory(folder / "broken");
  kit::write_file(folder / "broken/a.png", "no image");
  write_image(folder / "small.png", 64, 48);
  kit::write_file(folder / "truth.json", "{}");
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{}, "INPUT is required"},
      {{"empty"}, "folder 'empty' has no images"},
      {{"broken"}, "broken/a.png"},
      {{"small.png"}, "no design takes images of 64x48 px: use --fit"},
      {{"nowhere"}, "no scene, image, folder or video named 'nowhere'"},
      {{"z1.0", "--design", "thesos"}, "did you mean 'thesis'?"},
      {{"z1.0", "--set", "pl.no_such=1"}, "pl.no_such"},
      {{"z1.0", "--truth", "truth.json"}, "\"schema\": 1"},
      {{"z1.0", "--markdown", "small.png/page.md"}, "small.png"}};
  for (const auto& [arguments, why] : cases) {
    BOOST_TEST(compare(arguments) == 2);
    BOOST_TEST(refused(why), err << " lacks " << why);
  }
  BOOST_TEST(run({"scenes", "-o", "x"}) == 2);
  BOOST_TEST(refused("name a scene or a group"), err);
  BOOST_TEST(run({"scenes", "small.png", "-o", "x"}) == 2);
}

BOOST_AUTO_TEST_SUITE_END()
