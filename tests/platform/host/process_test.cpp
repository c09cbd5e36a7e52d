#include <host/process.h>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <boost/test/unit_test.hpp>
#include <cerrno>
#include <csignal>
#include <functional>

#include <vp/file.h>

#include "temporary_files.h"

namespace {

/// How a process ended that did `work`, as waitpid() tells it.
int status_of(const std::function<void()>& work) {
  const pid_t child = ::fork();
  if (child == 0) {
    const rlimit no_core{0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core);
    work();
    ::_exit(0);
  }
  int status = -1;
  ::waitpid(child, &status, 0);
  return status;
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(ending, kit::TemporaryFolder)

BOOST_AUTO_TEST_CASE(a_signal_removes_part_files_and_ends_the_process) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) {
    const int status = status_of([&] {
      // As a terminal leaves them, whatever started this test.
      std::signal(signal, SIG_DFL);
      platform::host::prepare_signals();
      const vp::OutputFile file(*this / "a", vp::OutputFile::By::name);
      ::raise(signal);
    });
    if (signal == SIGQUIT) {
      BOOST_TEST((WIFSIGNALED(status) && WTERMSIG(status) == signal));
    } else {
      BOOST_TEST((WIFEXITED(status) && WEXITSTATUS(status) == platform::host::interrupted));
    }
    BOOST_TEST(entries().empty());
  }
}

BOOST_AUTO_TEST_CASE(what_was_ignored_stays_ignored) {
  const int status = status_of([] {
    std::signal(SIGHUP, SIG_IGN);
    platform::host::prepare_signals();
    ::raise(SIGHUP);
  });
  BOOST_TEST((WIFEXITED(status) && WEXITSTATUS(status) == 0));
}

BOOST_AUTO_TEST_CASE(a_pipe_without_reader_and_a_limit_are_errors) {
  const int status = status_of([&] {
    platform::host::prepare_signals();
    int ends[2];
    if (::pipe(ends) != 0) ::_exit(1);
    ::close(ends[0]);
    if (::write(ends[1], "x", 1) >= 0 || errno != EPIPE) ::_exit(2);
    const rlimit limit{10, 10};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    try {
      vp::write_file(*this / "a", std::string(100, 'x'));
      ::_exit(3);
    } catch (const vp::OutputError&) {
    }
  });
  BOOST_TEST((WIFEXITED(status) && WEXITSTATUS(status) == 0), WEXITSTATUS(status));
}

BOOST_AUTO_TEST_SUITE_END()
