#include <host/command.h>

#include <boost/test/unit_test.hpp>
#include <csignal>

#include "temporary_files.h"

using namespace platform;

BOOST_FIXTURE_TEST_SUITE(command, kit::TemporaryFolder)

BOOST_AUTO_TEST_CASE(tells_how_it_ended_and_what_it_printed) {
  const host::CommandEnd end = host::run_command({"sh", "-c", "echo out; echo err >&2; exit 3"});
  BOOST_TEST(end.exit_code == 3);
  BOOST_TEST(end.out == "out\nerr\n");
  BOOST_TEST(host::run_command({"sh", "-c", "kill -9 $$"}).exit_code == -1);
  BOOST_TEST(host::run_command({"no-such-command"}).exit_code == host::no_such_command);
}

/// A pipe without reader ends it, though we ignore that signal.
BOOST_AUTO_TEST_CASE(signals_have_their_usual_effect_in_it) {
  auto* const handler = std::signal(SIGPIPE, SIG_IGN);
  BOOST_TEST(host::run_command({"sh", "-c", "kill -PIPE $$; echo alive"}).exit_code == -1);
  std::signal(SIGPIPE, handler);
}

BOOST_AUTO_TEST_CASE(a_plot_is_there_whole_or_not_at_all) {
  const std::string file = *this / "it's a plot.svg";
  const host::CommandEnd end = host::draw_with_gnuplot(file, "set terminal svg\nplot x\n");
  if (end.exit_code == host::no_such_command) {
    BOOST_TEST_MESSAGE("gnuplot is not installed: nothing to test");
    return;
  }
  BOOST_TEST(end.exit_code == 0);
  BOOST_TEST(entries() == std::vector<std::string>{"it's a plot.svg"});
  BOOST_TEST(kit::read_file(file).find("</svg>") != std::string::npos);
  BOOST_TEST(host::draw_with_gnuplot(*this / "b.svg", "set terminal svg\nplot (\n").exit_code != 0);
  BOOST_TEST(entries().size() == 1u);
}

BOOST_AUTO_TEST_SUITE_END()
