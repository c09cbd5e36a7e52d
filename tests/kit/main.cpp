// The entry point of every test program. SystemC owns main() by default; tests elaborate many times
// in one process.
#define BOOST_TEST_NO_MAIN
#include <boost/test/unit_test.hpp>

/// libsystemc refers to sc_main; no test enters through it.
extern "C" int sc_main(int, char**) {
  return 1;
}

int main(int argc, char* argv[]) {
  return boost::unit_test::unit_test_main([] { return true; }, argc, argv);
}
