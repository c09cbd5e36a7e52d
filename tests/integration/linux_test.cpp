// Unmodified Linux applications: /dev/mem, /dev/uioN, u-dma-buf.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <filesystem>

#include "executable.h"
#include "linux_place.h"

using namespace integration;

namespace {

struct Linux : LinuxPlace {
  kit::Outcome start(const std::string& application, const Arguments& arguments,
                     const Arguments& options = {}) const {
    Arguments all{"--linux", MARKERVP_APPLICATIONS + application, "--no-report"};
    all.insert(all.end(), options.begin(), options.end());
    all.push_back("--");
    all.insert(all.end(), arguments.begin(), arguments.end());
    return run(all);
  }
  /// It must end with 0 and warn of nothing.
  kit::Outcome works(const std::string& application, const Arguments& arguments,
                     const Arguments& options = {}) const {
    const kit::Outcome outcome = start(application, arguments, options);
    BOOST_TEST(outcome.exit_code == 0, application << ": " << outcome.out << outcome.err);
    BOOST_TEST(outcome.err == "");
    return outcome;
  }
  const Arguments loop_options{"--design", MARKERVP_LOOP_DESIGN, "--set",
                               "linux.uio=axi_dma_0, axi_dma_0.s2mm_introut, my-buttons=buttons"};
  /// A case of works.c, in the design with a DMA engine that copies.
  void loops(const std::string& what) const {
    for (const std::string application : {"works_0", "works", "works_2"})
      works(application, {what}, loop_options);
  }
};

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// The result without what tells of this very run.
std::string lasting(Json result) {
  result.erase("provenance");
  return result.dump();
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(linux_applications, Linux)

BOOST_AUTO_TEST_CASE(the_example_of_gpio) {
  const kit::Outcome outcome = works("gpio", {}, {"--log-bus", "bus.log"});
  BOOST_TEST(contains(outcome.out, "4 blinks in 4.1 ms, output 00000000\n"), outcome.out);
  const std::string log = kit::read_file(*this / "bus.log");
  BOOST_TEST(contains(log, "cpu  write  0x41200000  axi_gpio_0.GPIO_DATA  0x00000100  OK"));
  BOOST_TEST(result()["program_end"]["exit_code"] == 0);
}

BOOST_AUTO_TEST_CASE(the_example_of_features_finds_the_square_at_both_fidelities) {
  const kit::Outcome tlm = works("features", {});
  BOOST_TEST(contains(tlm.out, "linux: /dev/uio0 is axi_dma_0, interrupt 61, at 0x40400000\n"));
  BOOST_TEST(contains(tlm.out, "linux: /dev/uio2 is axi_gpio_0, no interrupt, at 0x41200000\n"));
  BOOST_TEST(contains(tlm.out, "linux: /dev/udmabuf0 has 1048576 bytes at 0x10"));
  for (const std::string corner : {"(200, 120)", "(359, 120)", "(200, 279)", "(359, 279)"})
    BOOST_TEST(contains(tlm.out, "corner at " + corner + "\n"), tlm.out);
  BOOST_TEST(contains(tlm.out, "\n4 corners and 1 blobs "), tlm.out);
  const Json end = result()["program_end"];
  works("features", {}, {"--fidelity", "clocked"});
  BOOST_TEST(result()["program_end"] == end);
}

BOOST_AUTO_TEST_CASE(each_run_is_the_same_run) {
  std::vector<std::string> seen;
  for (const std::string log : {"1.log", "2.log"}) {
    const kit::Outcome outcome = works("features", {}, {"--log-bus", log});
    seen.push_back(outcome.out.substr(0, outcome.out.find("wrote ")) + lasting(result()) +
                   kit::read_file(*this / log));
  }
  BOOST_TEST((seen[0] == seen[1]));
}

BOOST_AUTO_TEST_CASE(each_kind_of_access) {
  for (const std::string application : {"works_0", "works", "works_2"}) {
    const kit::Outcome outcome = start(application, {"accesses"});
    BOOST_TEST(outcome.exit_code == 0, outcome.out);
    BOOST_TEST(contains(outcome.err, "a write of 2 bytes to 0xFFFC0008: "), outcome.err);
    BOOST_TEST(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    works(application, {"strings"});
  }
}

BOOST_AUTO_TEST_CASE(sysfs) {
  loops("tree");
}

BOOST_AUTO_TEST_CASE(the_device_tree) {
  loops("device_tree");
}

BOOST_AUTO_TEST_CASE(dma_through_a_cached_buffer_and_an_interrupt) {
  loops("cached_loop");
  loops("stream_loop");
}

BOOST_AUTO_TEST_CASE(ways_to_wait) {
  loops("waiting");
}

BOOST_AUTO_TEST_CASE(interrupts_of_a_copy) {
  loops("copied");
}

BOOST_AUTO_TEST_CASE(ways_to_a_device_file) {
  std::filesystem::create_directory(*this / "links");
  const kit::Outcome outcome = works("paths", {*this / "links"});
  BOOST_TEST(contains(outcome.out, "linux: /dev/uio7 is not there"), outcome.out);
}

/// Nothing of what a shell sets is needed.
BOOST_AUTO_TEST_CASE(an_empty_environment) {
  std::filesystem::create_directory(*this / "links");
  const kit::Outcome outcome =
      kit::run_process("/usr/bin/env",
                       {"-i", MARKERVP_EXECUTABLE, "run", "--linux", MARKERVP_APPLICATIONS "paths",
                        "--no-report", "--", *this / "links"},
                       path());
  BOOST_TEST(outcome.exit_code == 0, outcome.out << outcome.err);
}

/// AddressSanitizer reports its findings, and those of the platform are as they were.
BOOST_AUTO_TEST_CASE(an_application_with_a_sanitizer) {
  const auto sanitized = [this](const std::string& name) {
    const std::string file = *this / name;
    const kit::Outcome built = kit::run_process(
        MARKERVP_C_COMPILER,
        {"-g", "-fsanitize=address", MARKERVP_APPLICATION_SOURCES + name + ".c", "-o", file},
        path());
    BOOST_TEST_REQUIRE(built.exit_code == 0, built.err);
    return file;
  };
  const auto start = [this](const std::string& file, const Arguments& options,
                            const Arguments& arguments) {
    Arguments all{"--linux", file, "--no-report"};
    all.insert(all.end(), options.begin(), options.end());
    all.push_back("--");
    all.insert(all.end(), arguments.begin(), arguments.end());
    return run(all);
  };
  const std::string works = sanitized("works");
  for (const std::string what : {"tree", "strings", "cached_loop", "waiting", "copied", "times"}) {
    const kit::Outcome outcome = start(works, loop_options, {what});
    BOOST_TEST(outcome.exit_code == 0, what << ": " << outcome.out << outcome.err);
    BOOST_TEST(outcome.err == "");
  }
  const std::string mistakes = sanitized("mistakes");
  kit::Outcome outcome = start(mistakes, {}, {"beyond_an_array"});
  BOOST_TEST(outcome.exit_code == 1);
  BOOST_TEST(contains(outcome.err, "AddressSanitizer: heap-buffer-overflow"), outcome.err);
  outcome = start(mistakes, {}, {"null_pointer"});
  BOOST_TEST(outcome.exit_code == 1);
  BOOST_TEST(contains(outcome.err, "AddressSanitizer: SEGV on unknown address"), outcome.err);
  outcome = start(mistakes, {}, {"unmapped"});
  BOOST_TEST(outcome.exit_code == 3, outcome.err);
  BOOST_TEST(contains(outcome.err, "data abort: write to 0x50000000"), outcome.err);
}

BOOST_AUTO_TEST_CASE(the_memory_is_the_one_that_the_engine_sees) {
  loops("memory");
}

BOOST_AUTO_TEST_CASE(time_is_simulated) {
  for (const std::string application : {"works_0", "works", "works_2"})
    BOOST_TEST(contains(works(application, {"times"}).out, "1006"));
}

BOOST_AUTO_TEST_CASE(its_own_handlers_and_masks) {
  for (const std::string application : {"works_0", "works", "works_2"}) {
    const kit::Outcome outcome = start(application, {"signals"});
    BOOST_TEST(contains(outcome.err, "ended with exit code 5"), outcome.out << outcome.err);
  }
}

BOOST_AUTO_TEST_CASE(an_application_in_cpp) {
  works("works_cpp", {});
  const kit::Outcome outcome = start("works_cpp", {"wrong"});
  BOOST_TEST(contains(outcome.err, "where the device has no register"), outcome.err);
  BOOST_TEST(contains(outcome.err, "works_cpp.cpp:"), outcome.err);
}

BOOST_AUTO_TEST_CASE(a_script_by_its_interpreter) {
  const std::string python = "/usr/bin/python3";
  BOOST_TEST_REQUIRE(std::filesystem::exists(python));
  kit::write_file(*this / "script.py",
                  "import mmap, os, struct, time\n"
                  "gpio = mmap.mmap(os.open('/dev/mem', os.O_RDWR), 4096, offset=0x41200000)\n"
                  "gpio[4:8] = struct.pack('<I', 0)\n"
                  "gpio[0:4] = struct.pack('<I', 0x100)\n"
                  "start = time.monotonic()\n"
                  "time.sleep(0.001)\n"
                  "print(struct.unpack('<I', gpio[0:4]), f'{time.monotonic() - start:.4f}')\n"
                  "print(sorted(os.listdir('/sys/class/uio')))\n");
  const kit::Outcome outcome = run({"--linux", python, "--no-report", "script.py"});
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  BOOST_TEST(contains(outcome.out, "(256,) 0.0010\n['uio0', 'uio1', 'uio2', 'uio3']\n"),
             outcome.out);
}

BOOST_AUTO_TEST_CASE(arguments_and_exit_code) {
  const kit::Outcome outcome = start("works", {"x", "-v", "two words", "5"});
  BOOST_TEST(outcome.exit_code == 1);
  BOOST_TEST(contains(outcome.out, "no line end, exit code 5\n"), outcome.out);
  BOOST_TEST(contains(outcome.err, "program 'works' ended with exit code 5"), outcome.err);
  BOOST_TEST(result()["program_end"]["exit_code"] == 5);
}

BOOST_AUTO_TEST_CASE(parameters) {
  const kit::Outcome outcome =
      works("gpio", {}, {"--set", "linux.udmabufs=2", "--set", "linux.udmabuf_size=64 KiB"});
  BOOST_TEST(contains(outcome.out, "/dev/udmabuf1 has 65536 bytes"), outcome.out);
  const kit::Outcome fixed =
      works("gpio", {}, {"--set", "linux.udmabuf_address=0x18000000", "--set", "linux.udmabufs=2"});
  BOOST_TEST(contains(fixed.out, "/dev/udmabuf1 has 1048576 bytes at 0x18100000"), fixed.out);
  const auto end = [this] { return result()["program_end"]["time_us"].get<double>(); };
  const double usual = end();
  works("gpio", {}, {"--set", "linux.wake_up=20000 cycles"});
  // 8 sleeps, 10000 cycles of 1.5 ns more each.
  BOOST_TEST(end() - usual >= 119.0);
  BOOST_TEST(end() - usual <= 121.0);
}

BOOST_AUTO_TEST_CASE(history_names_the_line) {
  works("gpio", {});
  const kit::Outcome outcome = kit::run_process(
      MARKERVP_EXECUTABLE, {"history", "out", "--register", "axi_gpio_0.GPIO_TRI"}, path());
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  BOOST_TEST(
      contains(outcome.out, "write  0x41200004  axi_gpio_0.GPIO_TRI  0x00000000  OK  pc 0x"));
  BOOST_TEST(contains(outcome.out, "gpio.c:35)"), outcome.out);
}

BOOST_AUTO_TEST_CASE(the_map_shows_where_interrupts_are) {
  const kit::Outcome outcome = kit::run_process(MARKERVP_EXECUTABLE, {"map"}, path());
  BOOST_TEST(contains(outcome.out, "       62  pl.axi_dma_1.s2mm_introut        /dev/uio1\n"),
             outcome.out);
}

BOOST_AUTO_TEST_SUITE_END()
