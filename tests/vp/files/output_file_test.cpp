#include <vp/file.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <boost/test/unit_test.hpp>
#include <csignal>
#include <cstring>
#include <functional>
#include <thread>

#include "file_size_limit.h"
#include "temporary_files.h"

namespace fs = std::filesystem;
using vp::OutputFile;

namespace {

std::string output_error(const std::function<void()>& work) {
  try {
    work();
  } catch (const vp::OutputError& error) {
    return error.what();
  }
  return "";
}

using By = OutputFile::By;

/// Writes `text` in one of the two ways.
void write(const std::string& path, By by, const std::string& text) {
  OutputFile file(path, by);
  by == By::bytes ? file.write(text) : kit::write_file(file.part(), text);
  file.commit();
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(output_file, kit::TemporaryFolder)

BOOST_AUTO_TEST_CASE(a_file_appears_whole_or_not_at_all) {
  for (const By by : {By::bytes, By::name}) {
    { OutputFile file(*this / "a", by); }
    BOOST_TEST(entries().empty());
    write(*this / "a", by, "text");
    BOOST_TEST(entries() == std::vector<std::string>{"a"});
    BOOST_TEST(kit::read_file(*this / "a") == "text");
    fs::remove(*this / "a");
  }
}

BOOST_AUTO_TEST_CASE(an_earlier_file_stays_until_the_new_one_is_whole) {
  kit::write_file(*this / "a", "earlier");
  ::chmod((*this / "a").c_str(), 0640);
  OutputFile file(*this / "a");
  file.write(std::string(1'000'000, 'x'));
  BOOST_TEST(kit::read_file(*this / "a") == "earlier");
  file.commit();
  BOOST_TEST(kit::read_file(*this / "a") == std::string(1'000'000, 'x'));
  BOOST_TEST((fs::status(*this / "a").permissions() == fs::perms(0640)), "its access rights stay");
  BOOST_TEST(entries().size() == 1u);
}

BOOST_AUTO_TEST_CASE(small_and_large_pieces_keep_their_order) {
  std::string all;
  OutputFile file(*this / "a");
  for (std::size_t i = 0; i < 300; ++i) {
    const std::string piece(i * i, static_cast<char>('a' + i % 26));
    file.write(piece);
    all += piece;
  }
  file.commit();
  BOOST_TEST((kit::read_file(*this / "a") == all));
}

BOOST_AUTO_TEST_CASE(links_are_followed_and_stay) {
  fs::create_directory(*this / "far");
  kit::write_file(*this / "far/target", "earlier");
  fs::create_symlink("far/target", *this / "link");
  fs::create_symlink("link", *this / "link to link");
  fs::create_symlink("far/new", *this / "dangling");
  for (const By by : {By::bytes, By::name}) {
    write(*this / "link to link", by, "text");
    write(*this / "dangling", by, "new");
    for (const char* name : {"link", "link to link", "dangling"})
      BOOST_TEST(fs::is_symlink(*this / name), name);
    BOOST_TEST(kit::read_file(*this / "far/target") == "text");
    BOOST_TEST(kit::read_file(*this / "far/new") == "new");
    BOOST_TEST(std::distance(fs::directory_iterator(*this / "far"), {}) == 2);
    fs::remove(*this / "far/new");
    kit::write_file(*this / "far/target", "earlier");
  }
  fs::create_symlink("circle", *this / "circle");
  BOOST_TEST(output_error([&] { OutputFile file(*this / "circle"); }) ==
             "cannot write '" + (*this / "circle") + "': Too many levels of symbolic links");
}

BOOST_AUTO_TEST_CASE(a_pipe_is_written_in_place) {
  const std::string pipe = *this / "pipe";
  BOOST_REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  std::string read;
  std::thread reader([&] { read = kit::read_file(pipe); });
  vp::write_file(pipe, std::string(200'000, 'x'));
  reader.join();
  BOOST_TEST((read == std::string(200'000, 'x')));
  BOOST_TEST(fs::is_fifo(pipe));
}

BOOST_AUTO_TEST_CASE(a_pipe_without_reader_is_an_error) {
  const std::string pipe = *this / "pipe";
  BOOST_REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  auto* const handler = std::signal(SIGPIPE, SIG_IGN);
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  OutputFile file(pipe);
  ::close(reader);
  file.write("text");
  BOOST_TEST(output_error([&] { file.commit(); }) == "cannot write '" + pipe + "': Broken pipe");
  std::signal(SIGPIPE, handler);
}

BOOST_AUTO_TEST_CASE(a_full_device_is_written_in_place) {
  const std::string expected =
      "cannot write '/dev/full': No space left on device; make room, or write less";
  BOOST_TEST(output_error([] { vp::write_file("/dev/full", "text"); }) == expected);
  BOOST_TEST(output_error([] { vp::write_file_durably("/dev/full", "text"); }) == expected);
  BOOST_TEST(fs::is_character_file("/dev/full"));
  vp::write_file_durably("/dev/null", "text");
  BOOST_TEST(fs::is_character_file("/dev/null"));
}

/// "/dev/stdout" is what the process has open, in a shell's file too: nothing is replaced.
BOOST_AUTO_TEST_CASE(a_descriptor_of_the_process_is_used_as_it_is) {
  const int open = ::open((*this / "a").c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  BOOST_REQUIRE(::write(open, "first ", 6) == 6);
  vp::write_file("/proc/self/fd/" + std::to_string(open), "second ");
  BOOST_REQUIRE(::write(open, "third", 5) == 5);
  ::close(open);
  BOOST_TEST(kit::read_file(*this / "a") == "first second third");
}

BOOST_AUTO_TEST_CASE(a_full_disk_leaves_what_was_there) {
  kit::write_file(*this / "a", "earlier");
  const kit::FileSizeLimit limit(100'000);
  OutputFile file(*this / "a");
  for (int i = 0; i < 1000; ++i) file.write(std::string(1000, 'x'));
  BOOST_TEST(file.failed());
  BOOST_TEST(output_error([&] { file.commit(); }) ==
             "cannot write '" + (*this / "a") + "': File too large; make room, or write less");
  BOOST_TEST(kit::read_file(*this / "a") == "earlier");
  BOOST_TEST(entries().size() == 1u);
}

BOOST_AUTO_TEST_CASE(room_can_be_reserved) {
  const kit::FileSizeLimit limit(100'000);
  OutputFile file(*this / "a");
  file.reserve(90'000);
  BOOST_TEST(output_error([&] { file.reserve(200'000); }) != "");
  file.write("text");
  file.commit();
  struct stat facts {};
  ::stat((*this / "a").c_str(), &facts);
  BOOST_TEST(facts.st_size == 4);
  BOOST_TEST(facts.st_blocks * 512 < 20'000, "what was not needed is given back");
}

BOOST_AUTO_TEST_CASE(what_cannot_be_written_is_refused_at_once) {
  const std::string advice = "; name a file in a folder that exists and may be written";
  const auto both = [&](const std::string& path, int reason) {
    BOOST_TEST(vp::output_problem(path) == reason);
    BOOST_TEST(output_error([&] { OutputFile file(path); }) ==
               "cannot write '" + path + "': " + std::strerror(reason) + advice);
  };
  both(*this / "missing/a", ENOENT);
  both("", ENOENT);
  both(path(), EISDIR);
  both("/dev/null/a", ENOTDIR);
  both(*this / std::string(300, 'n'), ENAMETOOLONG);
  BOOST_TEST(vp::output_problem(*this / "a") == 0);
  BOOST_TEST(entries().empty());
  vp::write_file(*this / std::string(255, 'n'),
                 "a long name has no longer one while it is written");
  vp::write_file(*this / std::string(255, 'n'), "again");
  BOOST_TEST(entries().size() == 1u);
}

BOOST_AUTO_TEST_CASE(a_killed_process_leaves_nothing) {
  const pid_t child = ::fork();
  if (child == 0) {
    OutputFile file(*this / "a");
    file.write(std::string(200'000, 'x'));
    ::raise(SIGKILL);
  }
  ::waitpid(child, nullptr, 0);
  BOOST_TEST(entries().empty());
}

BOOST_AUTO_TEST_CASE(part_files_are_removed_by_their_own_process_only) {
  const OutputFile file(*this / "a", By::name);
  const vp::PartFile other(*this / "b");
  kit::write_file(other.path(), "text");
  BOOST_TEST(entries().size() == 2u);
  const pid_t child = ::fork();
  if (child == 0) {
    vp::remove_part_files();
    ::_exit(0);
  }
  ::waitpid(child, nullptr, 0);
  BOOST_TEST(entries().size() == 2u);
  vp::remove_part_files();
  BOOST_TEST(entries().empty());
}

BOOST_AUTO_TEST_SUITE_END()
