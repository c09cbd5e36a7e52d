// The template's program for the chip: built from the package, booted in QEMU.
#include <boost/test/unit_test.hpp>

#include "installation.h"

using namespace install_test;

namespace {

struct Chip {
  /// Configures the package's chip project for the program in `folder`, in beside(`name`).
  kit::Outcome configure(const std::string& folder, const std::string& name) const {
    return installed.run(MARKERVP_CMAKE,
                         {"-S", installed / "share/markervp/chip", "-B", installed.beside(name),
                          "-G", MARKERVP_GENERATOR, "-DMARKERVP_CHIP_PROGRAM=" + folder});
  }
  kit::Outcome boot(const std::string& elf) const {
    return installed.run("/usr/bin/timeout", {"60",           MARKERVP_QEMU_SYSTEM_ARM,
                                              "-icount",      "shift=1,sleep=off",
                                              "-M",           "xilinx-zynq-a9",
                                              "-m",           "512M",
                                              "-display",     "none",
                                              "-monitor",     "none",
                                              "-serial",      "null",
                                              "-serial",      "stdio",
                                              "-semihosting", "-no-reboot",
                                              "-kernel",      elf});
  }

  const Installation& installed = Installation::get();
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(chip, Chip)

BOOST_AUTO_TEST_CASE(the_template) {
  const kit::Outcome made = configure(installed / "share/markervp/examples/04_own_program", "chip");
  BOOST_TEST_REQUIRE(made.exit_code == 0, made.out << made.err);
  const kit::Outcome built = installed.run(MARKERVP_CMAKE, {"--build", installed.beside("chip")});
  BOOST_TEST_REQUIRE(built.exit_code == 0, built.out << built.err);
  const kit::Outcome run = boot(installed.beside("chip/bin/first.elf"));
  BOOST_TEST(run.exit_code == 0, run.err);
  // How fast QEMU's timers count is its own affair.
  for (const char* line : {"hello from the processing system", "interrupt 1 after ",
                           "interrupt 3 after ", "chip: ended with 0"}) {
    BOOST_TEST(contains(run.out, line), run.out);
  }
}

BOOST_AUTO_TEST_CASE(a_folder_that_is_no_program) {
  const kit::Outcome nowhere = configure(installed.beside("nowhere"), "chip_nowhere");
  BOOST_TEST(nowhere.exit_code != 0);
  BOOST_TEST(contains(nowhere.err, "nowhere/CMakeLists.txt"), nowhere.err);
  const kit::Outcome none = configure("", "chip_none");
  BOOST_TEST(none.exit_code != 0);
  BOOST_TEST(contains(none.err, "-DMARKERVP_CHIP_PROGRAM=FOLDER"), none.err);
  const kit::Outcome platform =
      configure(installed / "share/markervp/examples/10_own_platform", "chip_platform");
  BOOST_TEST(platform.exit_code != 0);
  BOOST_TEST(contains(platform.err, "the models are for the virtual platform"), platform.err);
}

BOOST_AUTO_TEST_SUITE_END()
