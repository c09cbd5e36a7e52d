#include <cli/run_child.h>
#include <signal.h>
#include <unistd.h>

#include <boost/test/unit_test.hpp>
#include <cstdlib>
#include <ostream>
#include <utility>

#include <vp/error.h>

using platform::cli::ChildEnd;
using platform::cli::RunChild;

BOOST_AUTO_TEST_SUITE(run_child)

BOOST_AUTO_TEST_CASE(tells_exit_code_and_what_was_printed) {
  RunChild child([](std::ostream& out, std::ostream& err) {
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
  RunChild input([](std::ostream&, std::ostream&) -> int { throw vp::InputError("no\nimage"); });
  const ChildEnd wrong = input.wait();
  BOOST_TEST(wrong.exit_code == 2);
  BOOST_TEST(wrong.err == "markervp: no image\n");
  RunChild protocol([](std::ostream&, std::ostream&) -> int { throw vp::ProtocolError("late"); });
  BOOST_TEST(protocol.wait().exit_code == 3);
  RunChild strange([](std::ostream&, std::ostream&) -> int { throw 42; });
  BOOST_TEST(strange.wait().exit_code == 1);
}

BOOST_AUTO_TEST_CASE(a_crash_stays_in_the_child) {
  RunChild child([](std::ostream&, std::ostream&) -> int {
    ::signal(SIGABRT, SIG_DFL);
    std::abort();
  });
  const ChildEnd end = child.wait();
  BOOST_TEST(end.exit_code == -1);
  BOOST_TEST(end.signal == SIGABRT);
}

BOOST_AUTO_TEST_CASE(ends_with_its_object) {
  pid_t process = 0;
  {
    RunChild child([](std::ostream&, std::ostream&) {
      ::pause();
      return 0;
    });
    const RunChild moved(std::move(child));
    process = moved.pid();
    BOOST_TEST(!moved.ended());
    BOOST_TEST(::kill(process, 0) == 0);
  }
  BOOST_TEST(::kill(process, 0) != 0);
}

BOOST_AUTO_TEST_CASE(two_run_side_by_side) {
  RunChild first([](std::ostream& out, std::ostream&) {
    out << 1;
    return 0;
  });
  RunChild second([](std::ostream& out, std::ostream&) {
    out << 2;
    return 0;
  });
  BOOST_TEST(second.wait().out == "2");
  BOOST_TEST(first.wait().out == "1");
}

BOOST_AUTO_TEST_SUITE_END()
