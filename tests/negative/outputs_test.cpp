// Places where nothing can be written.
#include <boost/test/unit_test.hpp>

#include "command_line.h"

using namespace negative;

BOOST_FIXTURE_TEST_SUITE(outputs, CommandLine)

BOOST_AUTO_TEST_CASE(output_folder) {
  kit::write_file(*this / "taken", "a file");
  refuses({"run", "--output", "taken"}, {"output folder 'taken'", "--output"});
  refuses({"run", "--output", "taken/below"}, {"output folder 'taken/below'", "--output"});
  refuses({"run", "--output", "/proc/markervp"}, {"output folder '/proc/markervp'"});
  refuses({"run", "--output", std::string(300, 'n')}, {"output folder"});
}

BOOST_AUTO_TEST_CASE(trace_file) {
  std::filesystem::create_directory(*this / "folder.vcd");
  run_refuses({"--trace", "folder.vcd"}, {"cannot write trace 'folder.vcd'", "Is a directory"});
  run_refuses({"--trace", "missing/a.vcd"},
              {"missing/a.vcd", "No such file or directory", "folder that exists"});
  run_refuses({"--trace", "/proc/a.vcd"}, {"/proc/a.vcd"});
  run_refuses({"--trace", std::string(300, 'n') + ".vcd"}, {"nnn.vcd"});
  kit::write_file(*this / "taken", "a file");
  run_refuses({"--trace", "taken/a.vcd"}, {"taken/a.vcd"});
}

/// Noticed before anything runs, though the name is longer only while the file is written.
BOOST_AUTO_TEST_CASE(names_that_are_too_long) {
  const std::string name(250, 'n');
  run_refuses({"--trace", name + ".vcd"}, {"cannot write trace", "name too long"});
  refuses({"validate", "--markdown", name, "--output", "out"}, {"name too long"});
  write_image(name + ".pgm");
  const kit::Outcome outcome = start({"run", name + ".pgm", "--quiet"});
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  BOOST_TEST(std::filesystem::exists(*this / ("out/0000_" + name.substr(0, 200) + ".png")));
}

/// The folder is there and writable, but not what has to go into it. A check in front cannot know.
BOOST_AUTO_TEST_CASE(a_result_that_cannot_be_written_in_the_end) {
  std::filesystem::create_directories(*this / "out/result.json/in_the_way");
  const kit::Outcome outcome = start({"run", "z1.0", "--quiet", "--no-pictures"});
  BOOST_TEST(outcome.exit_code == 2);
  check_one_line(outcome.err, {"out/result.json"});
  BOOST_TEST(std::distance(std::filesystem::directory_iterator(*this / "out"), {}) == 1,
             "no temporary files are left");
}

BOOST_AUTO_TEST_CASE(a_picture_that_cannot_be_written) {
  std::filesystem::create_directories(*this / "out/0000_z1.0.png/in_the_way");
  const kit::Outcome outcome = start({"run", "z1.0", "--quiet"});
  BOOST_TEST(outcome.exit_code == 2);
  check_one_line(outcome.err, {"0000_z1.0.png"});
}

/// An error leaves what an earlier run wrote.
BOOST_AUTO_TEST_CASE(old_results_stay) {
  BOOST_TEST(start({"run", "z1.0", "--quiet"}).exit_code == 0);
  run_refuses({"z1.00"}, {"z1.00"});
  run_refuses({"z1.0", "--set", "pl.widht=1"}, {"pl.widht"});
  BOOST_TEST(std::filesystem::exists(*this / "out/result.json"));
}

BOOST_AUTO_TEST_SUITE_END()
