#include "rtl_objects.h"

#include <boost/test/unit_test.hpp>
#include <filesystem>
#include <stdexcept>

namespace {

namespace fs = std::filesystem;

void plant(const Bug& bug, const std::string& file) {
  std::string text = kit::read_file(file);
  const std::size_t at = text.find(bug.right);
  if (at == std::string::npos)
    throw std::runtime_error(std::string(bug.name) + ": " + file + " has no '" + bug.right + "'");
  for (std::size_t from = at; from != std::string::npos;
       from = text.find(bug.right, from + std::string(bug.wrong).size()))
    text.replace(from, std::string(bug.right).size(), bug.wrong);
  kit::write_file(file, text);
}

}  // namespace

void check_port(const Bug& bug, const std::string& failure) {
  const std::size_t ports = failure.find(": ", failure.find(", at "));
  BOOST_TEST_REQUIRE(ports != std::string::npos, bug.name << ": " << failure);
  BOOST_TEST(failure.compare(ports + 2, std::string(bug.port).size(), bug.port) == 0,
             bug.name << ": " << failure);
}

RtlObjects::RtlObjects(const std::vector<Object>& objects) {
  std::string project =
      "cmake_minimum_required(VERSION 3.25)\nproject(bugs LANGUAGES CXX)\n"
      "include(\"" MARKERVP_SOURCE "/cmake/MarkervpRtl.cmake\")\n";
  for (const Object& object : objects) project += copy(object);
  kit::write_file(folder_ / "CMakeLists.txt", project);
  cmake({"-S", ".", "-B", "build", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Debug",
         "-DCMAKE_CXX_FLAGS_DEBUG="});
  cmake({"--build", "build"});
}

void RtlObjects::cmake(const std::vector<std::string>& arguments) const {
  const kit::Outcome outcome = kit::run_process(MARKERVP_CMAKE, arguments, folder_.path());
  if (outcome.exit_code != 0) throw std::runtime_error(outcome.out + outcome.err);
}

/// Copies the RTL of an IP and what several share, plants the bug; gives the words that build it.
std::string RtlObjects::copy(const Object& object) const {
  const fs::path models(MARKERVP_SOURCE "/models/pl");
  const fs::path folder(folder_ / object.name);
  fs::copy(models / object.ip / "rtl", folder);
  fs::copy(models / "common/rtl", folder);
  if (object.bug) plant(*object.bug, folder / object.bug->file);
  return "file(GLOB sources " + object.name + "/*.sv)\nmarkervp_add_rtl(" + object.name + " IP " +
         object.ip + " TOP " + object.ip + " SOURCES ${sources}" +
         (object.parameters.empty() ? "" : " PARAMETERS " + object.parameters) + ")\n";
}
