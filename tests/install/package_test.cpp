// The CMake package itself: it can be moved, asks for what it needs, and keeps the layers apart.
#include <boost/test/unit_test.hpp>

#include <filesystem>

#include "installation.h"

using namespace install_test;

namespace {

namespace fs = std::filesystem;

const Installation& installed() {
  return Installation::get();
}

/// The configuration of a project that only asks for the package.
kit::Outcome find_package(const std::string& request) {
  const kit::TemporaryFolder folder;
  kit::write_file(folder / "CMakeLists.txt",
                  "cmake_minimum_required(VERSION 3.25)\nproject(asks LANGUAGES CXX)\n"
                  "find_package(markervp " +
                      request + ")\nmessage(STATUS \"version ${markervp_VERSION}\")\n");
  static unsigned asked = 0;
  return installed().configure(folder.path(), "asks" + std::to_string(++asked));
}

}  // namespace

BOOST_AUTO_TEST_SUITE(package)

BOOST_AUTO_TEST_CASE(no_file_of_cmake_names_the_folders_of_the_build) {
  unsigned files = 0;
  for (const char* folder : {"lib/cmake", "share"}) {
    for (const auto& entry : fs::recursive_directory_iterator(installed() / folder)) {
      if (!entry.is_regular_file()) continue;
      ++files;
      const std::string text = kit::read_file(entry.path());
      BOOST_TEST(!contains(text, MARKERVP_BUILD), entry.path());
      BOOST_TEST(!contains(text, MARKERVP_SOURCE), entry.path());
    }
  }
  BOOST_TEST(files > 10u);
}

BOOST_AUTO_TEST_CASE(requests_that_it_refuses) {
  const kit::Outcome component = find_package("REQUIRED COMPONENTS programms");
  BOOST_TEST(component.exit_code != 0);
  BOOST_TEST(contains(component.err, "no component 'programms'"), component.err);
  BOOST_TEST(contains(component.err, "programs, models, designs, rtl"), component.err);
  const kit::Outcome version = find_package("99.0 REQUIRED");
  BOOST_TEST(version.exit_code != 0);
  BOOST_TEST(contains(version.err, "compatible with requested version \"99.0\""), version.err);
}

BOOST_AUTO_TEST_CASE(both_components_are_the_default) {
  const kit::Outcome found = find_package("REQUIRED");
  BOOST_TEST(found.exit_code == 0, found.err);
  BOOST_TEST(contains(found.out, "version 0."), found.out);
}

BOOST_AUTO_TEST_CASE(a_program_does_not_see_the_simulator) {
  installed().build(project("programs"), "programs");
  const kit::Outcome outcome = installed().build_target("programs", "sees_platform");
  BOOST_TEST(outcome.exit_code != 0);
  BOOST_TEST(contains(outcome.out + outcome.err, "vp/clock.h"), outcome.out);
}

BOOST_AUTO_TEST_SUITE_END()
