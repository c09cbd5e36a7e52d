// Places where nothing can be written.
#include <sys/stat.h>
#include <sys/sysmacros.h>

#include <boost/test/unit_test.hpp>
#include <thread>

#include "command_line.h"

using namespace negative;

namespace {

namespace fs = std::filesystem;

/// The options of `run` that name a file.
const Words file_options{"--timeline", "--log-bus", "--register-coverage", "--trace"};

/// A device on which no byte finds room; of our own where we may make one: a program that destroys
/// it does not destroy the machine's.
std::string full_device(const CommandLine& place) {
  const std::string own = place / "full.vcd";
  const bool made = ::mknod(own.c_str(), S_IFCHR | 0666, makedev(1, 7)) == 0;
  if (made && std::ofstream(own)) return own;
  fs::remove(own);
  return "/dev/full";
}

Words run_with(const std::string& option, const std::string& file) {
  return {"run", "z1.0", "--quiet", "--no-pictures", "--no-report", option, file};
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(outputs, CommandLine)

BOOST_AUTO_TEST_CASE(output_folder) {
  kit::write_file(*this / "taken", "a file");
  refuses({"run", "--output", "taken"}, {"output folder 'taken'", "--output"});
  refuses({"run", "--output", "taken/below"}, {"output folder 'taken/below'", "--output"});
  refuses({"run", "--output", "/proc/markervp"}, {"output folder '/proc/markervp'"});
  refuses({"run", "--output", std::string(300, 'n')}, {"output folder"});
}

BOOST_AUTO_TEST_CASE(trace_file) {
  fs::create_directory(*this / "folder.vcd");
  run_refuses({"--trace", "folder.vcd"}, {"cannot write 'folder.vcd'", "Is a directory"});
  run_refuses({"--trace", "missing/a.vcd"},
              {"missing/a.vcd", "No such file or directory", "folder that exists"});
  run_refuses({"--trace", "/proc/a.vcd"}, {"/proc/a.vcd"});
  run_refuses({"--trace", std::string(300, 'n') + ".vcd"}, {"nnn.vcd"});
  kit::write_file(*this / "taken", "a file");
  run_refuses({"--trace", "taken/a.vcd"}, {"taken/a.vcd"});
}

/// Noticed before anything runs.
BOOST_AUTO_TEST_CASE(names_that_are_too_long) {
  const std::string name(250, 'n'), longer(256, 'n');
  run_refuses({"--trace", longer + ".vcd"}, {"cannot write", "name too long"});
  refuses({"validate", "--markdown", longer, "--output", "out"}, {"name too long"});
  write_image(name + ".pgm");
  const kit::Outcome outcome = start({"run", name + ".pgm", "--quiet"});
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  BOOST_TEST(std::filesystem::exists(*this / ("out/0000_" + name.substr(0, 200) + ".png")));
}

BOOST_AUTO_TEST_CASE(a_result_that_cannot_be_written) {
  fs::create_directories(*this / "out/result.json/in_the_way");
  run_refuses({"z1.0", "--no-pictures"}, {"out/result.json", "Is a directory"});
}

BOOST_AUTO_TEST_CASE(a_picture_that_cannot_be_written) {
  fs::create_directories(*this / "out/0000_z1.0.png/in_the_way");
  const kit::Outcome outcome = start({"run", "z1.0", "--quiet"});
  BOOST_TEST(outcome.exit_code == 2);
  check_one_line(outcome.err, {"0000_z1.0.png"});
}

/// An error leaves what an earlier run wrote.
BOOST_AUTO_TEST_CASE(old_results_stay) {
  BOOST_TEST(start({"run", "z1.0", "--quiet"}).exit_code == 0);
  run_refuses({"z1.00"}, {"z1.00"});
  run_refuses({"z1.0", "--set", "pl.widht=1"}, {"pl.widht"});
  BOOST_TEST(fs::exists(*this / "out/result.json"));
}

BOOST_AUTO_TEST_CASE(a_full_device_is_told_and_stays_a_device) {
  const std::string device = full_device(*this);
  for (const std::string& option : file_options) {
    BOOST_TEST_CONTEXT(option) {
      const kit::Outcome outcome = start(run_with(option, device));
      BOOST_TEST(outcome.exit_code == 2);
      check_one_line(outcome.err, {"cannot write '" + device + "'", "No space left on device"});
      BOOST_TEST(fs::is_character_file(device));
      // A trace that cannot be written ends the run before its first frame.
      BOOST_TEST(fs::exists(*this / "out/result.json") == (option != "--trace"));
      BOOST_TEST(!contains(outcome.out, device), outcome.out);
      fs::remove_all(*this / "out");
    }
  }
}

BOOST_AUTO_TEST_CASE(links_are_followed) {
  fs::create_directory(*this / "far");
  for (const std::string& option : file_options) {
    BOOST_TEST_CONTEXT(option) {
      kit::write_file(*this / "far/file.vcd", "earlier");
      fs::create_symlink("far/file.vcd", *this / "link.vcd");
      BOOST_TEST(start(run_with(option, "link.vcd")).exit_code == 0);
      BOOST_TEST(fs::is_symlink(*this / "link.vcd"));
      BOOST_TEST(kit::read_file(*this / "far/file.vcd") != "earlier");
      BOOST_TEST(std::distance(fs::directory_iterator(*this / "far"), {}) == 1);
      fs::remove(*this / "link.vcd");
    }
  }
  fs::create_symlink("../far/result", *this / "out/link");
  fs::rename(*this / "out/link", *this / "out/result.json");
  BOOST_TEST(start({"run", "z1.0", "--quiet", "--no-pictures", "--no-report"}).exit_code == 0);
  BOOST_TEST(fs::is_symlink(*this / "out/result.json"));
  BOOST_TEST(contains(kit::read_file(*this / "far/result"), "z1.0"));
}

BOOST_AUTO_TEST_CASE(a_page_goes_through_a_link_or_pipe) {
  BOOST_TEST(start({"run", "z1.0", "--quiet", "--no-pictures"}).exit_code == 0);
  if (!fs::exists(*this / "out/report.html")) return;  // a build without Node.js
  kit::write_file(*this / "target", "earlier");
  fs::create_symlink("target", *this / "link");
  BOOST_TEST(start({"report", "out", "out", "-o", "link"}).exit_code == 0);
  BOOST_TEST(fs::is_symlink(*this / "link"));
  const std::string page = kit::read_file(*this / "target");
  BOOST_REQUIRE(::mkfifo((*this / "pipe").c_str(), 0600) == 0);
  std::string read;
  std::thread reader([&] { read = kit::read_file(*this / "pipe"); });
  const kit::Outcome outcome = start({"report", "out", "out", "-o", "pipe"});
  reader.join();
  BOOST_TEST(outcome.exit_code == 0);
  BOOST_TEST((read == page));
}

BOOST_AUTO_TEST_CASE(pipes_are_written_to_their_readers) {
  for (const std::string& option : file_options) {
    BOOST_TEST_CONTEXT(option) {
      const std::string pipe = *this / "pipe.vcd";
      BOOST_REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
      std::string read;
      std::thread reader([&] { read = kit::read_file(pipe); });
      const kit::Outcome outcome = start(run_with(option, pipe));
      reader.join();
      BOOST_TEST(outcome.exit_code == 0);
      BOOST_TEST(fs::is_fifo(pipe));
      fs::remove(pipe);
      BOOST_TEST(start(run_with(option, pipe)).exit_code == 0);
      BOOST_TEST((read == kit::read_file(pipe)));
      fs::remove(pipe);
    }
  }
}

BOOST_AUTO_TEST_CASE(two_outputs_into_one_file) {
  run_refuses({"z1.0", "--timeline", "a.vcd", "--trace", "./a.vcd"}, {"two outputs", "a.vcd"});
  BOOST_TEST(start({"run", "z1.0", "--quiet", "--timeline", "/dev/null", "--log-bus", "/dev/null"})
                 .exit_code == 0);
}

BOOST_AUTO_TEST_CASE(a_full_standard_output) {
  BOOST_TEST(
      shell("\"$markervp\" run z1.0 --quiet --trace a.vcd --trace-window 6ms:6.01ms").exit_code ==
      0);
  kit::write_file(*this / "s.yaml",
                  "parameters: {ps.fclk_clk1.frequency: [40 MHz, 50 MHz]}\n"
                  "objectives: [max summary.fps.mean, min summary.latency_us.mean]");
  for (const char* command : {"--help",
                              "--version",
                              "run z1.0",
                              "run z1.0 --quiet",
                              "scenes",
                              "scenes roll",
                              "scenes --names",
                              "config",
                              "map",
                              "map axi_dma_0 --registers",
                              "map --markdown",
                              "map --xparameters",
                              "power",
                              "power --markdown",
                              "completion bash",
                              "report out",
                              "compare out out",
                              "trace list a.vcd",
                              "trace stats a.vcd",
                              "trace diff a.vcd a.vcd",
                              "trace cut a.vcd b.vcd",
                              "trace saif a.vcd a.saif",
                              "trace plot a.vcd pl.control_block.ena",
                              "trace gtkw a.vcd",
                              "sweep --list",
                              "sweep s.yaml --dry-run",
                              "sweep s.yaml",
                              "pareto out/s",
                              "sensitivity out/s"}) {
    BOOST_TEST_CONTEXT(command) {
      const std::string call = std::string("\"$markervp\" ") + command;
      const kit::Outcome good = shell(call);
      BOOST_TEST(good.exit_code == 0, good.err);
      BOOST_TEST(good.out != "", "the command prints something");
      const kit::Outcome full = shell(call + " > /dev/full");
      BOOST_TEST(full.exit_code == 2);
      BOOST_TEST(contains(full.err, "cannot write 'standard output': No space left on device"),
                 full.err);
    }
  }
}

/// Nor may a file that is opened later become the standard output.
BOOST_AUTO_TEST_CASE(no_standard_output) {
  const kit::Outcome outcome = shell("exec \"$markervp\" run z1.0 --no-pictures >&-");
  BOOST_TEST(outcome.exit_code == 2);
  BOOST_TEST(contains(outcome.err, "cannot write 'standard output': Bad file descriptor"),
             outcome.err);
  BOOST_TEST(kit::read_file(*this / "out/result.json").front() == '{');
}

BOOST_AUTO_TEST_SUITE_END()
