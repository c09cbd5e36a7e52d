#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <boost/test/unit_test.hpp>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <ostream>
#include <utility>

#include <host/process.h>
#include <vp/error.h>
#include <vp/file.h>

#include "temporary_files.h"

using platform::host::Child;
using platform::host::ChildEnd;

BOOST_AUTO_TEST_SUITE(child)

BOOST_AUTO_TEST_CASE(tells_exit_code_and_what_was_printed) {
  Child child([](std::ostream& out, std::ostream& err) {
    out << std::string(100'000, 'x');
    err << "careful\n";
    return 1;
  });
  const ChildEnd end = child.wait();
  BOOST_TEST(end.exit_code == 1);
  BOOST_TEST(end.signal == 0);
  BOOST_TEST(end.out == std::string(100'000, 'x'));
  BOOST_TEST(end.err == "careful\n");
}

BOOST_AUTO_TEST_CASE(an_error_gives_its_exit_code_and_one_line) {
  Child input([](std::ostream&, std::ostream&) -> int { throw vp::InputError("no\nimage"); });
  const ChildEnd wrong = input.wait();
  BOOST_TEST(wrong.exit_code == 2);
  BOOST_TEST(wrong.err == "markervp: no image\n");
  Child protocol([](std::ostream&, std::ostream&) -> int { throw vp::ProtocolError("late"); });
  BOOST_TEST(protocol.wait().exit_code == 3);
  Child strange([](std::ostream&, std::ostream&) -> int { throw 42; });
  BOOST_TEST(strange.wait().exit_code == 3);
}

BOOST_AUTO_TEST_CASE(a_crash_stays_in_the_child) {
  Child child([](std::ostream&, std::ostream&) -> int {
    ::signal(SIGABRT, SIG_DFL);
    std::abort();
  });
  const ChildEnd end = child.wait();
  BOOST_TEST(end.exit_code == -1);
  BOOST_TEST(end.signal == SIGABRT);
}

// Also one that does not hear: in the middle of a long call, or with a handler of its own.
BOOST_AUTO_TEST_CASE(ends_after_a_parent_that_was_killed) {
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);
  int ends[2];
  BOOST_TEST_REQUIRE(::pipe(ends) == 0);
  const pid_t parent = ::fork();
  if (parent == 0) {
    Child child([&](std::ostream&, std::ostream&) -> int {
      ::signal(SIGTERM, SIG_IGN);
      const pid_t self = ::getpid();
      static_cast<void>(!::write(ends[1], &self, sizeof self));
      for (volatile unsigned turns = 0;; turns = turns + 1) continue;
    });
    child.wait();
    ::_exit(0);
  }
  pid_t process = 0;
  BOOST_TEST_REQUIRE(::read(ends[0], &process, sizeof process) == ssize_t{sizeof process});
  ::kill(parent, SIGKILL);
  BOOST_TEST(::waitpid(parent, nullptr, 0) == parent);
  int status = 0;
  BOOST_TEST(::waitpid(process, &status, 0) == process);  // else the test does not end
  BOOST_TEST(WIFEXITED(status));
  BOOST_TEST(WEXITSTATUS(status) == platform::host::interrupted);
  for (const int end : ends) ::close(end);
  ::prctl(PR_SET_CHILD_SUBREAPER, 0);
}

BOOST_AUTO_TEST_CASE(ends_with_its_object) {
  pid_t process = 0;
  {
    Child child([](std::ostream&, std::ostream&) {
      ::pause();
      return 0;
    });
    const Child moved(std::move(child));
    process = moved.pid();
    BOOST_TEST(!moved.ended());
    BOOST_TEST(::kill(process, 0) == 0);
  }
  BOOST_TEST(::kill(process, 0) != 0);
}

BOOST_AUTO_TEST_CASE(its_part_files_go_with_it) {
  const kit::TemporaryFolder folder;
  {
    const Child child([&](std::ostream&, std::ostream&) {
      platform::host::prepare_signals();
      const vp::OutputFile file(folder / "picture", vp::OutputFile::By::name);
      vp::write_file(file.part(), "half");
      vp::write_file(folder / "begun", "");
      while (true) ::pause();
      return 0;
    });
    while (!std::filesystem::exists(folder / "begun")) ::usleep(1000);
    BOOST_TEST(folder.entries().size() == 2u);
  }
  BOOST_TEST(folder.entries() == std::vector<std::string>{"begun"});
}

BOOST_AUTO_TEST_CASE(what_does_not_hear_is_ended) {
  const kit::TemporaryFolder folder;
  pid_t process = 0;
  {
    const Child child([&](std::ostream&, std::ostream&) {
      std::signal(SIGTERM, SIG_IGN);
      vp::write_file(folder / "deaf", "");
      while (true) ::pause();
      return 0;
    });
    process = child.pid();
    while (!std::filesystem::exists(folder / "deaf")) ::usleep(1000);
  }
  BOOST_TEST(::kill(process, 0) != 0);
}

BOOST_AUTO_TEST_CASE(two_run_side_by_side) {
  Child first([](std::ostream& out, std::ostream&) {
    out << 1;
    return 0;
  });
  Child second([](std::ostream& out, std::ostream&) {
    out << 2;
    return 0;
  });
  BOOST_TEST(second.wait().out == "2");
  BOOST_TEST(first.wait().out == "1");
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_FIXTURE_TEST_SUITE(command, kit::TemporaryFolder)

BOOST_AUTO_TEST_CASE(tells_how_it_ended_and_what_it_printed) {
  const platform::host::CommandEnd end =
      platform::host::run_command({"sh", "-c", "echo out; echo err >&2; exit 3"});
  BOOST_TEST(end.exit_code == 3);
  BOOST_TEST(end.out == "out\nerr\n");
  BOOST_TEST(platform::host::run_command({"sh", "-c", "kill -9 $$"}).exit_code == -1);
  BOOST_TEST(platform::host::run_command({"no-such-command"}).exit_code ==
             platform::host::no_such_command);
}

/// A pipe without reader ends it, though we ignore that signal.
BOOST_AUTO_TEST_CASE(signals_have_their_usual_effect_in_it) {
  auto* const handler = std::signal(SIGPIPE, SIG_IGN);
  BOOST_TEST(platform::host::run_command({"sh", "-c", "kill -PIPE $$; echo alive"}).exit_code ==
             -1);
  std::signal(SIGPIPE, handler);
}

BOOST_AUTO_TEST_SUITE_END()
