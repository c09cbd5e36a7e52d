// The commands of docs/traces.md do what is there, in its order.
#include <boost/test/unit_test.hpp>

#include <algorithm>
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
        BOOST_TEST(outcome.out.find("FAIL no_feature_lost at 19.88667 ms") != std::string::npos);
      }
    }
  }
  for (const char* file :
       {"traces/system/demo.vcd", "out/end.vcd", "out/features.vcd", "out/inside.vcd",
        "out/lost.vcd", "small.vcd", "small.vcd.failed.gtkw", "small.vcd.gtkwave/system.gtkw"}) {
    BOOST_TEST(fs::exists(*this / file), file);
  }
  // The windows are where the demo has its frame.
  for (const char* file : {"out/end.vcd", "out/features.vcd", "out/inside.vcd", "out/lost.vcd"}) {
    const std::string trace = kit::read_file(*this / file);
    BOOST_TEST(std::count(trace.begin(), trace.end(), '#') > 100, file);
  }
  // The page of the whole system has its marker where the end word appears.
  const std::string page = kit::read_file(MARKERVP_SOURCE "/traces/system/demo.gtkw");
  std::smatch marker;
  BOOST_TEST_REQUIRE(std::regex_search(page, marker, std::regex("\n\\*-[0-9.]+ ([0-9]+) ")));
  const std::string trace = kit::read_file(*this / "traces/system/demo.vcd");
  const std::size_t instant = trace.find("\n#" + marker[1].str() + "\n");
  BOOST_TEST_REQUIRE(instant != std::string::npos);
  BOOST_TEST(trace.substr(instant, trace.find("\n#", instant + 1) - instant)
                 .find("\nb" + std::string(32, '1') + " ") != std::string::npos);
  BOOST_TEST(kit::read_file(*this / "overflow.svg") ==
             kit::read_file(MARKERVP_SOURCE "/docs/images/overflow.svg"));
}

BOOST_AUTO_TEST_SUITE_END()
