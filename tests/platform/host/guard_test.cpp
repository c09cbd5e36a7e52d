#include <host/guard.h>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <boost/test/unit_test.hpp>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include <host/process.h>
#include <vp/error.h>

#include "temporary_files.h"

namespace {

namespace fs = std::filesystem;
using platform::host::ProcessTree;
using platform::host::ScratchFolder;

/// Becomes a shell that runs `script`.
ProcessTree::Become shell(const std::string& script) {
  return [script] {
    ::execlp("sh", "sh", "-c", script.c_str(), nullptr);
    return errno;
  };
}

/// What is to come of itself.
bool comes(const std::function<bool()>& condition) {
  for (int i = 0; i < 1000 && !condition(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return condition();
}

struct Folder : kit::TemporaryFolder {
  Folder() { ::setenv("TMPDIR", (*this / "").c_str(), 1); }
  ~Folder() { ::unsetenv("TMPDIR"); }

  bool has(const std::string& name) const { return fs::exists(*this / name); }
  /// A shell and what it leaves behind, in a session of its own; each writes its number to a file
  /// of `name`. They would run for ever.
  std::string endless(const std::string& name) const {
    const std::string self = *this / name, other = *this / (name + "_session");
    return "echo $$ > " + self + "; (setsid sh -c 'echo $$ > " + other + ".new; mv " + other +
           ".new " + other + "; sleep 1000; true' &); sleep 1000; true";
  }
  bool runs(const std::string& name) const {
    const int process = std::atoi(kit::read_file(*this / name).c_str());
    return process > 0 && ::kill(process, 0) == 0;
  }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(guards, Folder)

BOOST_AUTO_TEST_CASE(a_command_and_its_end) {
  BOOST_TEST(WEXITSTATUS(ProcessTree(shell("exit 7")).wait()) == 7);
  BOOST_TEST(WTERMSIG(ProcessTree(shell("kill -TERM $$")).wait()) == SIGTERM);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_started) {
  try {
    const ProcessTree none([] { return ENOEXEC; });
    BOOST_FAIL("it started");
  } catch (const std::system_error& error) {
    BOOST_TEST(error.code().value() == ENOEXEC);
  }
}

BOOST_AUTO_TEST_CASE(no_signal_is_ignored_or_blocked) {
  std::signal(SIGPIPE, SIG_IGN);
  sigset_t hang_up;
  ::sigemptyset(&hang_up);
  ::sigaddset(&hang_up, SIGHUP);
  ::sigprocmask(SIG_BLOCK, &hang_up, nullptr);
  BOOST_TEST(WTERMSIG(ProcessTree(shell("kill -PIPE $$; exit 0")).wait()) == SIGPIPE);
  BOOST_TEST(WTERMSIG(ProcessTree(shell("kill -HUP $$; exit 0")).wait()) == SIGHUP);
  ::sigprocmask(SIG_UNBLOCK, &hang_up, nullptr);
  std::signal(SIGPIPE, SIG_DFL);
}

BOOST_AUTO_TEST_CASE(nothing_outlives_the_object) {
  {
    const ProcessTree tree(shell(endless("tree")));
    BOOST_TEST_REQUIRE(comes([&] { return has("tree_session"); }));
    BOOST_TEST(runs("tree"));
    BOOST_TEST(runs("tree_session"));
  }
  BOOST_TEST(!runs("tree"));
  BOOST_TEST(!runs("tree_session"));
}

BOOST_AUTO_TEST_CASE(the_end_of_a_process_that_lost_its_parent_is_noted) {
  ProcessTree tree(shell("(sh -c 'echo $$ > " + (*this / "orphan") + "; sleep 0.1; exit 9' &)"));
  BOOST_TEST(tree.wait() == 0);
  std::optional<ProcessTree::End> end;
  BOOST_TEST_REQUIRE(comes([&] {
    if (!end) end = tree.next_end();
    return end.has_value();
  }));
  BOOST_TEST(end->process == std::atoi(kit::read_file(*this / "orphan").c_str()));
  BOOST_TEST(WEXITSTATUS(end->status) == 9);
}

BOOST_AUTO_TEST_CASE(a_scratch_folder_goes_with_its_object) {
  fs::path path;
  {
    const ScratchFolder folder("test");
    path = folder.path();
    kit::write_file(folder / "file", "text");
    BOOST_TEST((path.filename().string().rfind("markervp-test-", 0) == 0));
  }
  BOOST_TEST(!fs::exists(path));
}

BOOST_AUTO_TEST_CASE(where_no_scratch_folder_can_be_made_the_place_is_named) {
  const auto refuses = [&](const std::string& place) {
    ::setenv("TMPDIR", place.c_str(), 1);
    BOOST_CHECK_EXCEPTION(ScratchFolder("test"), vp::HostError, [&](const vp::HostError& error) {
      const std::string text = error.what();
      return text.find("for temporary files in '" + place + "' (") != text.npos &&
             text.find("let TMPDIR name one that takes files") != text.npos;
    });
  };
  refuses(*this / "none");
  refuses("/proc");
}

/// Whatever ends a process, even what it cannot see.
BOOST_AUTO_TEST_CASE(a_scratch_link_goes_with_its_object_and_takes_no_name) {
  const kit::TemporaryFolder folder;
  const std::string path = folder / "link";
  {
    const platform::host::ScratchLink link("target", path);
    BOOST_TEST(std::filesystem::read_symlink(path) == "target");
    BOOST_CHECK_EXCEPTION(
        platform::host::ScratchLink("other", path), std::system_error,
        [](const std::system_error& error) { return error.code() == std::errc::file_exists; });
    BOOST_TEST(std::filesystem::read_symlink(path) == "target");
  }
  BOOST_TEST(!std::filesystem::is_symlink(path));
  BOOST_CHECK_EXCEPTION(platform::host::ScratchLink("target", folder / "none/link"),
                        std::system_error, [](const std::system_error& error) {
                          return error.code() == std::errc::no_such_file_or_directory;
                        });
}

BOOST_AUTO_TEST_CASE(nothing_outlives_the_process) {
  for (const int signal : {SIGKILL, SIGINT, SIGTERM, SIGHUP, SIGSEGV}) {
    const std::string name = "tree" + std::to_string(signal);
    const pid_t process = ::fork();
    if (process == 0) {
      platform::host::prepare_signals();
      std::signal(SIGSEGV, SIG_DFL);
      ::dup2(::open("/dev/null", O_WRONLY), STDERR_FILENO);
      const ScratchFolder folder("test");
      kit::write_file(folder / "file", "text");
      platform::host::run_command({"sh", "-c", endless(name)}, folder.path());
      ::_exit(1);
    }
    BOOST_TEST_REQUIRE(comes([&] { return has(name + "_session"); }));
    BOOST_TEST(runs(name));
    ::kill(process, signal);
    ::waitpid(process, nullptr, 0);
    BOOST_TEST(comes([&] { return !runs(name) && !runs(name + "_session"); }));
    BOOST_TEST(comes([&] {
      const std::vector<std::string> left = entries();
      return std::none_of(left.begin(), left.end(), [](const std::string& file) {
        return file.find("markervp-test-") != std::string::npos;
      });
    }));
  }
}

/// Killed while it makes one, too.
BOOST_AUTO_TEST_CASE(no_scratch_folder_is_left_at_any_moment) {
  constexpr int times = 40;
  constexpr timespec step{0, 100'000};
  for (int i = 0; i < times; ++i) {
    const pid_t process = ::fork();
    if (process == 0) {
      const ScratchFolder folder("test");
      while (true) ::pause();
    }
    for (int wait = 0; wait < i; ++wait) ::nanosleep(&step, nullptr);
    ::kill(process, SIGKILL);
    ::waitpid(process, nullptr, 0);
  }
  BOOST_TEST(comes([&] {
    const std::vector<std::string> left = entries();
    return std::none_of(left.begin(), left.end(), [](const std::string& file) {
      return file.find("markervp-test-") != std::string::npos;
    });
  }));
}

/// Who reads our output does not wait for a guard.
BOOST_AUTO_TEST_CASE(a_guard_holds_nothing_open) {
  int ends[2];
  BOOST_TEST_REQUIRE(::pipe(ends) == 0);
  const ProcessTree tree([&] {
    ::close(ends[1]);
    return shell("sleep 1000")();
  });
  ::close(ends[1]);
  char byte = 0;
  BOOST_TEST(::read(ends[0], &byte, 1) == 0);
  ::close(ends[0]);
}

BOOST_AUTO_TEST_SUITE_END()
