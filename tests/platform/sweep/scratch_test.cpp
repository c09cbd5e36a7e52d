#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>

#include <sweep/scratch.h>

#include "sweep_kit.h"
#include "temporary_files.h"

using platform::sweep::Scratch;

namespace {

namespace fs = std::filesystem;

std::ptrdiff_t entries(const std::string& folder) {
  const fs::directory_iterator all(folder);
  return std::distance(begin(all), end(all));
}

/// A process that has its folders, and is killed.
void leave_folder(const std::string& parent) {
  const pid_t process = ::fork();
  if (process == 0) {
    Scratch scratch(1, parent);
    fs::create_directory(scratch.take());
    ::raise(SIGKILL);
  }
  ::waitpid(process, nullptr, 0);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(scratch)

BOOST_AUTO_TEST_CASE(it_is_gone_with_its_owner) {
  const kit::TemporaryFolder folder;
  {
    Scratch scratch(2, folder.path());
    const std::string first = scratch.take();
    BOOST_TEST(first != scratch.take());
    fs::create_directory(first);
    BOOST_TEST(entries(folder.path()) == 1);
  }
  BOOST_TEST(entries(folder.path()) == 0);
}

BOOST_AUTO_TEST_CASE(what_a_killed_process_left_goes_with_the_next) {
  const kit::TemporaryFolder folder;
  leave_folder(folder.path());
  BOOST_TEST(entries(folder.path()) == 1);
  const Scratch next(1, folder.path());
  BOOST_TEST(entries(folder.path()) == 1);
  leave_folder(folder.path());
  BOOST_TEST(entries(folder.path()) == 2);
}

BOOST_AUTO_TEST_CASE(what_is_in_use_stays) {
  const kit::TemporaryFolder folder;
  Scratch first(1, folder.path());
  fs::create_directory(first.take());
  fs::create_directory(folder / "mine");
  const Scratch second(1, folder.path());
  BOOST_TEST(entries(folder.path()) == 3);
}

BOOST_AUTO_TEST_SUITE_END()
