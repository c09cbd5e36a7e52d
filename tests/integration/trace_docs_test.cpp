// The commands of docs/traces.md do what stands there, in its order.
#include <boost/test/unit_test.hpp>

#include <filesystem>
#include <regex>

#include "executable.h"

namespace {

namespace fs = std::filesystem;

/// All commands that begin with the path of our program: lines of blocks, and `code` in sentences.
std::vector<std::string> commands_of(const std::string& page) {
  static const std::regex command("(^|`)(build/release/bin/markervp [^`\n]+)",
                                  std::regex::multiline);
  std::vector<std::string> commands;
  for (std::sregex_iterator match(page.begin(), page.end(), command), end; match != end; ++match) {
    commands.push_back((*match)[2]);
  }
  return commands;
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(trace_docs, integration::Workplace)

BOOST_AUTO_TEST_CASE(every_command_of_the_page_works) {
  fs::create_directories(*this / "build/release/bin");
  fs::create_symlink(MARKERVP_EXECUTABLE, *this / "build/release/bin/markervp");
  fs::create_directories(*this / "traces/system");
  fs::copy(MARKERVP_SOURCE "/traces/checks", *this / "traces/checks", fs::copy_options::recursive);
  const auto commands = commands_of(kit::read_file(MARKERVP_SOURCE "/docs/traces.md"));
  BOOST_TEST_REQUIRE(commands.size() >= 10u);
  for (const std::string& command : commands) {
    BOOST_TEST_CONTEXT(command) {
      const kit::Outcome outcome = kit::run_process("/bin/sh", {"-c", command}, path());
      // The check finds what the page looks for.
      const bool finds = command.find("trace check") != std::string::npos;
      BOOST_TEST(outcome.exit_code == (finds ? 1 : 0), outcome.err);
      if (finds) {
        BOOST_TEST(outcome.out.find("FAIL no_feature_lost at 15.48931 ms") != std::string::npos);
      }
    }
  }
  for (const char* file :
       {"traces/system/demo.vcd", "out/end.vcd", "out/features.vcd", "out/inside.vcd",
        "out/lost.vcd", "small.vcd", "small.vcd.failed.gtkw", "system.gtkw"}) {
    BOOST_TEST(fs::exists(*this / file), file);
  }
  BOOST_TEST(kit::read_file(*this / "overflow.svg") ==
             kit::read_file(MARKERVP_SOURCE "/docs/images/overflow.svg"));
}

BOOST_AUTO_TEST_SUITE_END()
