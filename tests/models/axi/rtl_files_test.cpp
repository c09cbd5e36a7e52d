// What RTL reads into memories: found when it is built, and a part of the object.
#include <axi/rtl_part.h>
#include <child_process.h>
#include <simulation.h>
#include <temporary_files.h>
#include <vp/clock.h>
#include <boost/test/unit_test.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

/// The words of four clocks in a row, the first of them at address 0.
template <class T>
std::vector<T> words_of(const std::string& file) {
  kit::Simulation simulation;
  vp::ClockScheduler scheduler("scheduler");
  vp::Clock clock("clock", scheduler, 100'000'000);
  axi::RtlPart part("part", file, {{"clk", &clock}});
  auto& output = part.output<T>(fs::path(file).stem() == "roms" ? "words" : "word");
  sc_core::sc_start(sc_core::sc_time(10, sc_core::SC_NS));
  std::vector<T> words;
  for (int i = 0; i < 4; ++i) {
    sc_core::sc_start(sc_core::sc_time(10, sc_core::SC_NS));
    words.push_back(output.get());
  }
  return words;
}

/// What CMake says of a source, and its exit code.
kit::Outcome configure(const std::string& source,
                       const std::vector<std::pair<std::string, std::string>>& files) {
  const kit::TemporaryFolder folder;
  kit::write_file(folder / "CMakeLists.txt",
                  "cmake_minimum_required(VERSION 3.25)\nproject(files LANGUAGES CXX)\n"
                  "include(\"" MARKERVP_SOURCE
                  "/cmake/MarkervpRtl.cmake\")\n"
                  "markervp_add_rtl(own TOP own SOURCES rtl/" +
                      source + ")\n");
  for (const auto& [name, text] : files) {
    fs::create_directories(fs::path(folder / name).parent_path());
    kit::write_file(folder / name, text);
  }
  return kit::run_process(MARKERVP_CMAKE, {"-S", ".", "-B", "build", "-G", "Ninja"}, folder.path());
}

void check_refused(const kit::Outcome& outcome, const std::vector<std::string>& parts) {
  std::string said = outcome.err;
  for (std::size_t at = 0; (at = said.find_first_of("\n ", at)) != said.npos;) {
    const std::size_t end = said.find_first_not_of("\n ", at);
    said.replace(at, end == said.npos ? end : end - at, " ");
    ++at;
  }
  BOOST_TEST(outcome.exit_code != 0);
  for (const std::string& part : parts)
    BOOST_TEST(said.find(part) != said.npos, said << " without " << part);
}

const std::string own =
    "module own(input clk, input [1:0] at, output reg [7:0] word);\n"
    "  reg [7:0] words[0:3];\n"
    "  initial $readmemh(\"./rom.dat\", words);\n"
    "  always @(posedge clk) word <= words[at];\nendmodule\n";

}  // namespace

BOOST_AUTO_TEST_SUITE(rtl_files)

BOOST_AUTO_TEST_CASE(memories_have_their_words_wherever_the_object_is) {
  const std::vector<std::uint32_t> words{0x02100102, 0x04200304, 0x06300506, 0x08400708};
  BOOST_TEST(words_of<std::uint32_t>(MARKERVP_ROMS_RTL) == words, boost::test_tools::per_element());

  const kit::TemporaryFolder folder;
  fs::copy(MARKERVP_ROMS_RTL, folder / "roms.so");
  const fs::path before = fs::current_path();
  kit::write_file(folder / "even.dat", "aa\nbb\ncc\ndd\n");
  fs::current_path(folder.path());
  const auto moved = words_of<std::uint32_t>(folder / "roms.so");
  fs::current_path(before);
  BOOST_TEST(moved == words, "another file of that name, where it runs, is not taken");
}

#ifdef MARKERVP_TEXT_ROM_RTL
BOOST_AUTO_TEST_CASE(memories_of_vhdl_have_their_words) {
  const std::vector<std::uint8_t> words{0x10, 0x20, 0x30, 0x40};
  BOOST_TEST(words_of<std::uint8_t>(MARKERVP_TEXT_ROM_RTL) == words,
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(a_file_that_vhdl_lacks_is_refused_with_its_line) {
  std::string text = kit::read_file(MARKERVP_SOURCE "/tests/models/axi/rtl/text_rom.vhd");
  for (std::size_t at; (at = text.find("text_rom")) != text.npos;) text.replace(at, 8, "own");
  check_refused(configure("own.vhd", {{"rtl/own.vhd", text}}),
                {"own.vhd:15:", "there is no file './bits.mem' beside the source"});
}
#endif

BOOST_AUTO_TEST_CASE(a_file_that_is_nowhere_is_refused_with_its_line) {
  check_refused(configure("own.v", {{"rtl/own.v", own}, {"rom.dat", "1 2 3 4\n"}}),
                {"rtl/own.v:3: there is no file './rom.dat' beside the source"});
}

BOOST_AUTO_TEST_CASE(files_of_one_name_that_differ_are_refused) {
  check_refused(configure("own.v", {{"rtl/own.v", own},
                                    {"rtl/a/rom.dat", "1 2 3 4\n"},
                                    {"rtl/b/rom.dat", "1 2 3 5\n"}}),
                {"rtl/own.v:3: './rom.dat' may be '", "/a/rom.dat' or '", "which differ"});
  const kit::Outcome same = configure(
      "own.v",
      {{"rtl/own.v", own}, {"rtl/a/rom.dat", "1 2 3 4\n"}, {"rtl/b/rom.dat", "1 2 3 4\n"}});
  BOOST_TEST(same.exit_code == 0, same.err);
}

BOOST_AUTO_TEST_SUITE_END()
