#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <vp/error.h>
#include <vp/file.h>

#include <boost/test/unit_test.hpp>
#include <csignal>
#include <fstream>
#include <thread>

#include "input_error.h"
#include "temporary_files.h"

using vp::InputFile;

namespace {

std::string refusal(const std::string& path, std::uint64_t most = vp::largest_by_hand) {
  return input_error([&] { vp::read_text(path, "text", most); });
}

struct Files : kit::TemporaryFolder {
  std::string file(const std::string& bytes) const {
    kit::write_file(*this / "file", bytes);
    return *this / "file";
  }
  std::string pipe() const {
    BOOST_TEST_REQUIRE(::mkfifo((*this / "pipe").c_str(), 0600) == 0);
    return *this / "pipe";
  }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(input_file, Files)

BOOST_AUTO_TEST_CASE(files_are_read_whole) {
  for (const std::size_t size : {0, 1, 65'535, 65'536, 65'537, 1'000'000}) {
    const std::string bytes(size, 'x');
    BOOST_TEST((vp::read_text(file(bytes), "text") == bytes), size);
  }
  BOOST_TEST(vp::read_text(file(std::string("a\0b", 3)), "text").size() == 3u);
}

/// Files of the kernel say that they are empty.
BOOST_AUTO_TEST_CASE(a_file_larger_than_it_says_is_read) {
  BOOST_TEST(!vp::read_text("/proc/self/status", "text").empty());
}

BOOST_AUTO_TEST_CASE(size_is_bounded) {
  const std::uint64_t most = 1 << 20;
  BOOST_TEST(vp::read_text(file(std::string(most, 'x')), "text", most).size() == most);
  BOOST_TEST(refusal(file(std::string(most + 1, 'x')), most) ==
             "cannot read text '" + (*this / "file") +
                 "': it is larger than 1 MiB, which no file of this kind is");
  const std::string hole = file("");
  std::filesystem::resize_file(hole, std::uint64_t{1} << 40);
  BOOST_TEST(refusal(hole).find("larger than 4 MiB") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(what_is_no_file_is_refused) {
  BOOST_TEST(refusal("/nowhere/a") == "cannot read text '/nowhere/a': No such file or directory");
  BOOST_TEST(refusal(path()) == "cannot read text '" + path() + "': it is a folder: name a file");
  for (const std::string device : {"/dev/zero", "/dev/null", "/dev/urandom"}) {
    BOOST_TEST(refusal(device) == "cannot read text '" + device + "': it is a device: name a file");
  }
}

BOOST_AUTO_TEST_CASE(a_pipe_is_read_to_its_end) {
  const std::string name = pipe();
  std::thread writer([&] {
    std::ofstream out(name, std::ios::binary);
    out << std::string(200'000, 'x') << std::flush;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    out << "end";
  });
  const std::string text = vp::read_text(name, "text");
  writer.join();
  BOOST_TEST(text.size() == 200'003u);
  BOOST_TEST(text.substr(200'000) == "end");
}

BOOST_AUTO_TEST_CASE(a_pipe_without_end_is_refused) {
  const std::string name = pipe();
  std::thread writer([&] {
    std::signal(SIGPIPE, SIG_IGN);
    std::ofstream out(name, std::ios::binary);
    while (out << std::string(1 << 16, 'x')) continue;
  });
  const std::string text = refusal(name);
  writer.join();
  BOOST_TEST(text.find("larger than 4 MiB") != std::string::npos, text);
}

/// With and without a writer at its other end.
BOOST_AUTO_TEST_CASE(a_silent_pipe_is_given_up) {
  const std::string name = pipe();
  InputFile silent(name, "text");
  char byte = 0;
  const auto soon = [] { return InputFile::HostClock::now() + std::chrono::milliseconds(20); };
  BOOST_TEST(input_error([&] { silent.read(&byte, 1, soon()); }) ==
             "cannot read text '" + name +
                 "': it is a pipe, and its end did not come within 10 s: name a file");
  const int writer = ::open(name.c_str(), O_WRONLY | O_NONBLOCK);
  BOOST_TEST(::write(writer, "a", 1) == 1);
  BOOST_TEST(silent.read(&byte, 1, soon()) == 1u);
  BOOST_TEST(input_error([&] { silent.read(&byte, 1, soon()); }).find("it is a pipe") !=
             std::string::npos);
  ::close(writer);
  BOOST_TEST(silent.read(&byte, 1, soon()) == 0u);
}

BOOST_AUTO_TEST_SUITE_END()
