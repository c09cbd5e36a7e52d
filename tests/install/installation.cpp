#include "installation.h"

#include <boost/test/unit_test.hpp>

#include <filesystem>
#include <stdexcept>

namespace install_test {

namespace {

void must_work(const kit::Outcome& outcome, const std::string& what) {
  if (outcome.exit_code == 0) return;
  throw std::runtime_error(what + " failed:\n" + outcome.out + outcome.err);
}

}  // namespace

const Installation& Installation::get() {
  static const Installation installation;
  return installation;
}

Installation::Installation() {
  must_work(run(MARKERVP_CMAKE, {"--install", MARKERVP_BUILD, "--prefix", folder_ / "first"}),
            "cmake --install");
  std::filesystem::rename(folder_ / "first", folder_ / "prefix");
}

kit::Outcome Installation::markervp(const Words& arguments) const {
  return run(*this / "bin/markervp", arguments);
}

kit::Outcome Installation::run(const std::string& program, const Words& arguments) const {
  return kit::run_process(program, arguments, folder_.path());
}

nlohmann::ordered_json Installation::result(const std::string& name, const Words& more) const {
  Words arguments{"run", "--output", name, "--no-pictures", "--no-report"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const kit::Outcome outcome = markervp(arguments);
  BOOST_TEST_REQUIRE(outcome.exit_code == 0, outcome.err);
  BOOST_TEST(!contains(outcome.err, "warning"), outcome.err);
  BOOST_TEST(!contains(outcome.err, "error"), outcome.err);
  return nlohmann::ordered_json::parse(kit::read_file(beside(name + "/result.json")));
}

kit::Outcome Installation::configure(const std::string& source, const std::string& name,
                                     const Words& more) const {
  Words arguments{"-S",
                  source,
                  "-B",
                  beside(name),
                  "-G",
                  MARKERVP_GENERATOR,
                  "-DCMAKE_CXX_COMPILER=" MARKERVP_COMPILER,
                  "-DCMAKE_PREFIX_PATH=" + (*this / "")};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run(MARKERVP_CMAKE, arguments);
}

void Installation::build(const std::string& source, const std::string& name) const {
  if (std::filesystem::exists(beside(name))) return;
  must_work(configure(source, name), "configuration of " + source);
  must_work(run(MARKERVP_CMAKE, {"--build", beside(name)}), "build of " + source);
}

kit::Outcome Installation::build_target(const std::string& name, const std::string& target) const {
  return run(MARKERVP_CMAKE, {"--build", beside(name), "--target", target});
}

std::string project(const std::string& name) {
  return MARKERVP_SOURCE "/tests/install/" + name;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

void check_refused(const kit::Outcome& outcome, const Words& parts) {
  BOOST_TEST(outcome.exit_code == 2);
  BOOST_TEST(outcome.out == "");
  BOOST_TEST(outcome.err.find('\n') + 1 == outcome.err.size(), outcome.err);
  for (const std::string& part : parts) {
    BOOST_TEST(contains(outcome.err, part), "'" << part << "' is not in: " << outcome.err);
  }
}

}  // namespace install_test
