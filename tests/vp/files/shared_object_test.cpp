#include <vp/file.h>

#include <boost/test/unit_test.hpp>

namespace {

std::string problem(const std::string& said) {
  return vp::load_problem("/tmp/mine.so", said);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(shared_object)

BOOST_AUTO_TEST_CASE(the_loader_s_words_become_ours) {
  BOOST_TEST(problem("/tmp/mine.so: undefined symbol: _Z4findv") ==
             "nothing defines '_Z4findv', which it calls: link what does");
  BOOST_TEST(problem("/tmp/mine.so: undefined symbol: find, version ONE") ==
             "nothing defines 'find', which it calls: link what does");
  BOOST_TEST(problem("libfind.so.1: cannot open shared object file: No such file or directory") ==
             "it needs the library 'libfind.so.1', which is not found");
  BOOST_TEST(problem("/tmp/mine.so: cannot open shared object file: Permission denied") ==
             "Permission denied");
  BOOST_TEST(problem("/tmp/mine.so: invalid ELF header") ==
             "it is no shared object for this machine: build it as one");
  BOOST_TEST(problem("libfind.so: wrong ELF class: ELFCLASS32") ==
             "it needs 'libfind.so', which is no shared object for this machine: build it as one");
  BOOST_TEST(problem("/lib/libstdc++.so.6: version `GLIBCXX_3.4.99' not found (required by "
                     "/tmp/mine.so)") ==
             "it was built against a newer '/lib/libstdc++.so.6': build it on this machine");
}

BOOST_AUTO_TEST_CASE(what_nobody_knows_is_passed_on) {
  BOOST_TEST(problem("something new") == "something new");
}

BOOST_AUTO_TEST_SUITE_END()
