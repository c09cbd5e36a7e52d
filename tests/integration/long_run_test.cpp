// A run of any length takes the memory of a short one.
#include <boost/test/unit_test.hpp>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <string>

#include "executable.h"
#include "sanitized.h"

using namespace integration;

namespace {

/// The most memory that a run took, in KiB; of it alone, whatever ran before.
long largest_kib(const Workplace& place, const std::string& frames) {
  const pid_t process = ::fork();
  if (process == 0) {
    const kit::Outcome outcome =
        place.run({"z1.0", "--repeat", frames, "--no-pictures", "--no-report", "--quiet"});
    rusage usage{};
    ::getrusage(RUSAGE_CHILDREN, &usage);
    kit::write_file(place / "kib", std::to_string(usage.ru_maxrss));
    ::_exit(outcome.exit_code);
  }
  int status = 0;
  ::waitpid(process, &status, 0);
  BOOST_TEST_REQUIRE((WIFEXITED(status) && WEXITSTATUS(status) == 0));
  return std::stol(kit::read_file(place / "kib"));
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(long_runs, Workplace)

// What is kept of a frame in result.json alone would be 700 KiB more; as objects several times
// that.
BOOST_AUTO_TEST_CASE(frames_leave_nothing_in_memory) {
  const long few_kib = largest_kib(*this, "100"), many_kib = largest_kib(*this, "700");
  BOOST_TEST(result()["frames"].size() == 700u);
  if (!kit::is_sanitized)
    BOOST_TEST(many_kib < few_kib + 1024, many_kib << " KiB after " << few_kib);
}

BOOST_AUTO_TEST_SUITE_END()
