#include <vp/text.h>

#include <boost/test/unit_test.hpp>
#include <clocale>
#include <limits>

BOOST_AUTO_TEST_SUITE(text)

BOOST_AUTO_TEST_CASE(edit_distance_counts_edits_and_swaps) {
  BOOST_TEST(vp::edit_distance("", "") == 0u);
  BOOST_TEST(vp::edit_distance("", "abc") == 3u);
  BOOST_TEST(vp::edit_distance("abc", "") == 3u);
  BOOST_TEST(vp::edit_distance("clock", "clock") == 0u);
  BOOST_TEST(vp::edit_distance("clokc", "clock") == 1u);
  BOOST_TEST(vp::edit_distance("detecton", "detection") == 1u);
  BOOST_TEST(vp::edit_distance("kitten", "sitting") == 3u);
}

BOOST_AUTO_TEST_CASE(nearest_match_finds_a_misspelling) {
  const std::vector<std::string> names{"clocked", "tlm"};
  BOOST_TEST(vp::nearest_match("clokced", names) == "clocked");
  BOOST_TEST(vp::nearest_match("tml", names) == "tlm");
  BOOST_TEST(vp::nearest_match("tlm", names) == "tlm");
}

BOOST_AUTO_TEST_CASE(nearest_match_looks_at_the_whole_path_first) {
  const std::vector<std::string> paths{"ps.threshold", "pl.corner_detection.threshold",
                                       "pl.corner_detection.window"};
  BOOST_TEST(vp::nearest_match("pl.corner_detecton.threshold", paths) ==
             "pl.corner_detection.threshold");
}

BOOST_AUTO_TEST_CASE(nearest_match_finds_the_last_part_in_another_place) {
  const std::vector<std::string> paths{"pl.blob_detection.contrast",
                                       "pl.corner_detection.threshold"};
  BOOST_TEST(vp::nearest_match("threshold", paths) == "pl.corner_detection.threshold");
  BOOST_TEST(vp::nearest_match("treshold", paths) == "pl.corner_detection.threshold");
  BOOST_TEST(vp::nearest_match("zynq.fabric.something.threshold", paths) ==
             "pl.corner_detection.threshold");
}

BOOST_AUTO_TEST_CASE(nearest_match_takes_the_nearer_path_of_equal_last_parts) {
  const std::vector<std::string> paths{"ps.ddr_controller.latency", "pl.axi_interconnect.latency"};
  BOOST_TEST(vp::nearest_match("axi_interconnect_of_the_pl.latency", paths) ==
             "pl.axi_interconnect.latency");
}

BOOST_AUTO_TEST_CASE(nearest_match_finds_nothing_far_away) {
  BOOST_TEST(vp::nearest_match("resolution", {"clocked", "tlm"}) == "");
  BOOST_TEST(vp::nearest_match("xy", {"ab"}) == "");
  BOOST_TEST(vp::nearest_match("anything", {}) == "");
  BOOST_TEST(vp::nearest_match("", {"tlm"}) == "");
}

/// With the matrix of each pair it took minutes.
BOOST_AUTO_TEST_CASE(nearest_match_of_a_very_long_word_is_quick) {
  const std::vector<std::string> paths(1000, "pl.corner_detection.threshold");
  BOOST_TEST(vp::nearest_match(std::string(4 << 20, 'x'), paths) == "");
}

BOOST_AUTO_TEST_CASE(equally_near_ones_give_the_first) {
  BOOST_TEST(vp::nearest_match("port_c", {"port_b", "port_a"}) == "port_b");
}

BOOST_AUTO_TEST_CASE(split_and_join) {
  const std::vector<std::string> parts{"a", "", "b"};
  BOOST_TEST(vp::split("a..b", '.') == parts);
  BOOST_TEST(vp::split("", '.').size() == 1u);
  BOOST_TEST(vp::join(parts, ", ") == "a, , b");
  BOOST_TEST(vp::join({}, ", ") == "");
  BOOST_TEST(vp::one_of({}) == "");
  BOOST_TEST(vp::one_of({"a"}) == "a");
  BOOST_TEST(vp::one_of({"a", "b"}) == "a or b");
  BOOST_TEST(vp::one_of({"a", "b", "c"}) == "a, b or c");
}

BOOST_AUTO_TEST_CASE(control_characters_are_shown) {
  BOOST_TEST(vp::visible("a\n!b\t\x1b[2J\x7f\r") == R"(a\n!b\t\x1b[2J\x7f\x0d)");
  BOOST_TEST(vp::visible("\u009b1m \u202egpj \u2066 \u2028") ==
             R"(\x9b1m \u202egpj \u2066 \u2028)");
  BOOST_TEST(vp::visible(std::string("\0", 1)) == R"(\x00)");
  for (const char* text : {"", "50 MHz, 2 µs – “½” √ 画像", "\xe2\x80", "\xff\xc2", R"(a\nb)"})
    BOOST_TEST(vp::visible(text) == text);
  BOOST_TEST(vp::visible_lines("a\nb\r\n") == "a\nb\\x0d\n");
}

BOOST_AUTO_TEST_CASE(trim_takes_white_space_from_the_ends_only) {
  BOOST_TEST(vp::trim(" \ta b\r\n") == "a b");
  BOOST_TEST(vp::trim("  ") == "");
  BOOST_TEST(vp::trim("") == "");
}

BOOST_AUTO_TEST_CASE(fixed_numbers_have_the_stated_decimals) {
  BOOST_TEST(vp::format_fixed(12.3, 2) == "12.30");
  BOOST_TEST(vp::format_fixed(-0.001, 2) == "0.00");
  BOOST_TEST(vp::format_fixed(-0.5, 1) == "-0.5");
  BOOST_TEST(vp::format_fixed(1e20, 0) == "100000000000000000000");
  BOOST_TEST(vp::format_fixed(2.5, 0) == "2");  // ties to even, as IEEE-754 rounds
  BOOST_TEST(vp::format_fixed(std::numeric_limits<double>::max(), 3).size() == 313u);
}

BOOST_AUTO_TEST_CASE(numbers_do_not_depend_on_the_locale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  const char* german = std::setlocale(LC_ALL, "de_DE.UTF-8");
  BOOST_TEST(vp::format_fixed(1234.5, 1) == "1234.5");
  if (german == nullptr) BOOST_TEST_MESSAGE("no German locale here: tested in the C locale only");
  std::setlocale(LC_ALL, before.c_str());
}

BOOST_AUTO_TEST_CASE(letters_of_ascii_only) {
  BOOST_TEST(vp::lower("S00_AXI \u00C4") == "s00_axi \u00C4");
  BOOST_TEST(vp::upper("s00_axi \u00E4") == "S00_AXI \u00E4");
}

BOOST_AUTO_TEST_CASE(ends_of_texts) {
  BOOST_TEST(vp::ends_with("aresetn", "resetn"));
  BOOST_TEST(vp::ends_with("aresetn", ""));
  BOOST_TEST(!vp::ends_with("aresetn", "reset"));
  BOOST_TEST(!vp::ends_with("n", "aresetn"));
}

BOOST_AUTO_TEST_SUITE_END()
