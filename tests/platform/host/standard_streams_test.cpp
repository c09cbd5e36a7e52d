#include <host/process.h>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <boost/test/unit_test.hpp>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iostream>
#include <sstream>

#include <vp/file.h>

using namespace platform;

namespace {

std::string complaint(const std::function<void()>& work) {
  try {
    work();
  } catch (const vp::OutputError& error) {
    return error.what();
  }
  return "";
}

constexpr const char* full =
    "cannot write 'standard output': No space left on device; make room, or write less";

/// What check_standard_output() says in a process that did `work` with it.
std::string complaint_of_process(const char* standard_output, const std::function<void()>& work) {
  int ends[2];
  BOOST_REQUIRE(::pipe(ends) == 0);
  std::cout.flush();
  std::fflush(stdout);
  const pid_t child = ::fork();
  if (child == 0) {
    const int out = ::open(standard_output, O_WRONLY | O_CLOEXEC);
    ::dup2(out, STDOUT_FILENO);
    work();
    const std::string text = complaint(host::check_standard_output);
    const bool told = ::write(ends[1], text.data(), text.size()) >= 0;
    ::_exit(told ? 0 : 1);
  }
  ::close(ends[1]);
  std::string text(1000, '\0');
  text.resize(static_cast<std::size_t>(::read(ends[0], text.data(), text.size())));
  ::close(ends[0]);
  ::waitpid(child, nullptr, 0);
  return text;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(standard_streams)

BOOST_AUTO_TEST_CASE(a_stream_that_lost_something_is_noticed) {
  std::ofstream out("/dev/full");
  out << "text";
  BOOST_TEST(complaint([&] { host::check_written(out); }) == full);
  std::ostringstream good;
  good << "text";
  BOOST_TEST(complaint([&] { host::check_written(good); }) == "");
}

BOOST_AUTO_TEST_CASE(what_printf_lost_is_noticed) {
  const auto print = [] { std::printf("text"); };
  BOOST_TEST(complaint_of_process("/dev/full", print) == full);
  BOOST_TEST(complaint_of_process("/dev/null", print) == "");
}

/// Otherwise the first file that is opened gets what is printed.
BOOST_AUTO_TEST_CASE(closed_descriptors_are_filled) {
  BOOST_TEST(complaint_of_process("/dev/null", [] {
               ::close(STDOUT_FILENO);
               host::fill_standard_descriptors();
               if (::open("/dev/null", O_WRONLY) == STDOUT_FILENO) ::_exit(1);
               std::printf("text");
             }) == "cannot write 'standard output': Bad file descriptor");
}

BOOST_AUTO_TEST_SUITE_END()
