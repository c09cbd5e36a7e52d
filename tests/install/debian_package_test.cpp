// The Debian package: what scripts/package makes, unpacked into a folder, runs from there.
#include <boost/test/unit_test.hpp>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "installation.h"

using namespace install_test;

namespace {

namespace fs = std::filesystem;

/// Made once and unpacked below root().
class DebianPackage {
 public:
  static const DebianPackage& get() {
    static const DebianPackage package;
    return package;
  }

  std::string operator/(const std::string& path) const { return folder_ / ("root/" + path); }
  kit::Outcome run(const std::string& program, const Words& arguments) const {
    return kit::run_process(program, arguments, folder_.path());
  }
  /// A field of its control file.
  std::string field(const std::string& name) const {
    return run("/usr/bin/dpkg-deb", {"--field", file_, name}).out;
  }

 private:
  DebianPackage() {
    must_work({"--build", MARKERVP_BUILD, "--target", "manual"}, MARKERVP_CMAKE);
    must_work({"--config", MARKERVP_BUILD "/CPackConfig.cmake", "-B", folder_ / "made"},
              MARKERVP_CPACK);
    for (const auto& entry : fs::directory_iterator(folder_ / "made")) {
      if (entry.path().extension() == ".deb") file_ = entry.path();
    }
    must_work({"--extract", file_, folder_ / "root"}, "/usr/bin/dpkg-deb");
  }

  void must_work(const Words& arguments, const std::string& program) const {
    const kit::Outcome outcome = run(program, arguments);
    if (outcome.exit_code != 0)
      throw std::runtime_error(program + " failed:\n" + outcome.out + outcome.err);
  }

  kit::TemporaryFolder folder_;
  std::string file_;
};

}  // namespace

BOOST_AUTO_TEST_SUITE(debian_package)

BOOST_AUTO_TEST_CASE(it_runs_from_where_it_was_unpacked) {
  const DebianPackage& package = DebianPackage::get();
  const kit::Outcome outcome =
      package.run(package / "usr/bin/markervp", {"run", "demo", "--output", package / "out"});
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  BOOST_TEST(contains(kit::read_file(package / "out/result.json"), "\"frames\""));
  const kit::Outcome sweep =
      package.run(package / "usr/bin/markervp", {"sweep", "pixel-clock", "--dry-run"});
  BOOST_TEST(sweep.exit_code == 0, sweep.err);
}

BOOST_AUTO_TEST_CASE(it_says_what_it_needs) {
  const std::string needed = DebianPackage::get().field("Depends");
  for (const char* library : {"libsystemc", "libopencv-core", "libyaml-cpp"})
    BOOST_TEST(contains(needed, library), needed);
}

BOOST_AUTO_TEST_CASE(every_command_has_a_manual_page) {
  const DebianPackage& package = DebianPackage::get();
  const std::string help = package.run(package / "usr/bin/markervp", {"--help"}).out;
  unsigned pages = 0;
  for (const auto& entry : fs::directory_iterator(package / "usr/share/man/man1")) {
    const std::string page = entry.path().filename().string();
    BOOST_TEST(fs::file_size(entry.path()) > 200u, page);
    if (page == "markervp.1.gz") continue;
    const std::string command = page.substr(9, page.size() - 9 - 5);  // markervp-COMMAND.1.gz
    BOOST_TEST(contains(help, "\n  " + command + " "), page);
    ++pages;
  }
  for (const char* command : {"run", "sweep", "trace", "power"}) {
    const std::string path = package / ("usr/share/man/man1/markervp-" + std::string(command));
    BOOST_TEST(fs::exists(path + ".1.gz"), path);
  }
  BOOST_TEST(pages > 15u);
}

BOOST_AUTO_TEST_CASE(shells_and_cmake_find_their_part) {
  const DebianPackage& package = DebianPackage::get();
  for (const char* path : {"usr/share/bash-completion/completions/markervp",
                           "usr/lib/cmake/markervp/markervpConfig.cmake",
                           "usr/include/markervp/vp/vp/clock.h", "usr/lib/libmarkervp_vp.a"})
    BOOST_TEST(fs::exists(package / path), path);
}

BOOST_AUTO_TEST_CASE(its_bill_of_materials_names_libraries_and_packages_of_the_page) {
  const DebianPackage& package = DebianPackage::get();
  const std::string script = MARKERVP_SOURCE "/scripts/sbom";
  const kit::Outcome outcome = package.run(script, {MARKERVP_BUILD});
  BOOST_TEST_REQUIRE(outcome.exit_code == 0, outcome.err);
  const auto bill = nlohmann::json::parse(outcome.out);
  BOOST_TEST(bill["bomFormat"] == "CycloneDX");
  std::map<std::string, std::string> found;
  for (const auto& component : bill["components"]) {
    BOOST_TEST(component["version"] != "");
    found[component["name"]] = component["purl"];
  }
  BOOST_TEST(found["nlohmann-json3-dev"].find("pkg:deb/debian/nlohmann-json3-dev@") == 0u);
  BOOST_TEST(found["libstdc++6"].find("pkg:deb/debian/") == 0u);
  BOOST_TEST(found["echarts"].find("pkg:npm/echarts@") == 0u);
  BOOST_TEST(found.count("playwright-core") == 0u);
  const kit::Outcome nothing = package.run(script, {package / "no-build"});
  BOOST_TEST(nothing.exit_code == 1);
  BOOST_TEST(contains(nothing.err, "build it first"), nothing.err);
}

BOOST_AUTO_TEST_SUITE_END()
