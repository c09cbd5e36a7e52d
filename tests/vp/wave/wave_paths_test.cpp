// Paths are kept as differences; what comes out is what went in.
#include <vp/wave_paths.h>
#include <boost/test/unit_test.hpp>

#include <string>
#include <vector>

#include "wave_kit.h"

BOOST_AUTO_TEST_SUITE(wave_paths)

BOOST_AUTO_TEST_CASE(paths_come_out_as_they_went_in) {
  std::vector<std::string> paths = {"",
                                    "a",
                                    "a",
                                    "ab",
                                    "",
                                    "b.\xC3\xA4",
                                    std::string(70'000, 'x'),
                                    std::string(70'000, 'x') + "y"};
  for (unsigned i = 0; i < 1000; ++i)
    paths.push_back("top.u_" + std::to_string(i * 7919 % 1000) + ".clk");
  vp::WavePaths kept;
  BOOST_TEST(kept.empty());
  BOOST_TEST((kept.begin() == kept.end()));
  for (const std::string& path : paths) kept.push_back(path);
  BOOST_TEST(kept.size() == paths.size());
  BOOST_TEST((kept.all() == paths));
  for (std::size_t i = 0; i < paths.size(); ++i) BOOST_TEST(kept[i] == paths[i]);
}

BOOST_AUTO_TEST_CASE(a_path_has_another_name) {
  vp::WavePaths kept;
  for (const char* path : {"top.a", "top.ab", "top.abc"}) kept.push_back(path);
  BOOST_TEST(!kept.is_renamed());
  kept.rename(1, "ours");
  BOOST_TEST(kept.is_renamed());
  BOOST_TEST(kept[0] == "top.a");
  BOOST_TEST(kept[1] == "ours");
  BOOST_TEST(kept[2] == "top.abc");
  BOOST_TEST((kept.all() == std::vector<std::string>{"top.a", "ours", "top.abc"}));
}

BOOST_AUTO_TEST_CASE(each_of_many_names_is_found) {
  constexpr unsigned count = 5000;
  const kit::TemporaryFolder folder;
  std::string text = "$timescale 1ps $end\n";
  for (unsigned i = 0; i < count; ++i) {
    const std::string number = std::to_string(i);
    text += "$scope module s" + number + " $end $var wire 1 n" + number + " q $end $upscope $end\n";
  }
  kit::write_file(folder / "t.vcd", text + "$enddefinitions $end\n#0\n");
  const vp::WaveReader reader(folder / "t.vcd");
  for (unsigned i = 0; i < count; ++i) {
    const auto place = reader.place_of("s" + std::to_string(i) + ".q");
    BOOST_REQUIRE(place == std::int64_t{i});
    BOOST_TEST(reader.paths()[i] == "s" + std::to_string(i) + ".q");
  }
  BOOST_TEST(reader.place_of("s5000.q") == -1);
  BOOST_TEST(reader.place_of("") == -1);
  BOOST_TEST(reader.find("s1.q")->net == 1u);
}

BOOST_AUTO_TEST_SUITE_END()
